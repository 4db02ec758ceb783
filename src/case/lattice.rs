//! `[lattice]`: the cell, and where the indenters of each level stand in it.

use serde::Serialize;

use super::error::Refusal;
use super::levels::LevelSection;
use super::reader::TableAt;
use crate::lattice::{Cell, Lattice, LatticeError};

/// The section `[lattice]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum LatticeSection {
    /// Triangular lattice; its cell is a rhombus of 60°.
    Hexagonal {
        /// Distance of neighbouring indenters whatever their level, a length. With explicit sites and with a
        /// surface: the side of the cell.
        period: f64,
    },
    /// Square lattice.
    Square {
        /// As for the hexagonal one.
        period: f64,
    },
    /// Any cell.
    Oblique {
        /// First cell vector [x, y], lengths.
        a1: [f64; 2],
        /// Second cell vector [x, y], lengths.
        a2: [f64; 2],
    },
}

/// Most indenters a cell can hold.
const MOST_INDENTERS: usize = 10_000;

/// The cell's sine, at least: a narrower one is a basis that nobody needs.
const SINE: f64 = 1e-3;

impl LatticeSection {
    pub(super) fn read(section: &TableAt<'_>) -> Result<Self, Refusal> {
        let kind = section.value("kind")?.word()?;
        section.only()?;
        let period = || section.value("period")?.number();
        let vector = |key| section.value(key)?.numbers();
        match kind {
            "hexagonal" => Ok(Self::Hexagonal { period: period()? }),
            "square" => Ok(Self::Square { period: period()? }),
            _ => Ok(Self::Oblique { a1: vector("a1")?, a2: vector("a2")? }),
        }
    }

    /// The cell whose side is the period, or the one given.
    pub(super) fn cell(&self) -> Result<Cell, LatticeError> {
        match *self {
            Self::Hexagonal { period } => Cell::hexagonal(period),
            Self::Square { period } => Cell::square(period),
            Self::Oblique { a1, a2 } => Cell::new(a1, a2),
        }
    }

    /// The lattice of the levels: their own sites, or the standard ones.
    pub(super) fn build(&self, levels: &[LevelSection]) -> Result<Lattice, LatticeError> {
        let sites: Option<Vec<_>> = levels.iter().map(|level| level.sites.clone()).collect();
        match (sites, *self) {
            (Some(sites), _) => Lattice::new(self.cell()?, sites),
            (None, Self::Hexagonal { period }) => Lattice::hexagonal(period, levels.len()),
            (None, Self::Square { period }) => Lattice::square(period, levels.len()),
            (None, Self::Oblique { .. }) => {
                Err(LatticeError::NoStandardSites { lattice: "oblique", levels: levels.len(), standard: "none" })
            }
        }
    }
}

/// The lattice of the case, or what is wrong with it at the line where it stands.
pub(super) fn build(
    lattice: &LatticeSection,
    section: &TableAt<'_>,
    levels: &[LevelSection],
    level_sections: &[TableAt<'_>],
) -> Result<Lattice, Refusal> {
    let given = levels.iter().position(|level| level.sites.is_some());
    let absent = levels.iter().position(|level| level.sites.is_none());
    if let (Some(given), Some(absent)) = (given, absent) {
        let message = format!("`levels[{absent}].sites` is missing, while `levels[{given}]` has its sites");
        return Err(Refusal::new(level_sections[absent].place, message, "no `sites` in this level")
            .help("give every level its sites, or none"));
    }
    let mut count = 0;
    for (section, level) in level_sections.iter().zip(levels) {
        count += level.sites.as_ref().map_or(1, Vec::len);
        if count > MOST_INDENTERS {
            let message =
                format!("the cell must hold at most {MOST_INDENTERS} indenters: with `levels` up to here {count}");
            return Err(Refusal::new(section.place, message, "too many sites"));
        }
    }
    build_cell(lattice, section)?;
    lattice.build(levels).map_err(|error| match error {
        LatticeError::NoStandardSites { .. } if matches!(lattice, LatticeSection::Oblique { .. }) => {
            Refusal::new(level_sections[0].place, "`levels[0].sites` is missing", "no `sites` in this level")
                .help("an oblique cell has no standard sites: give each level its own, in fractions of a1, a2: sites = [[0.0, 0.0]]")
        }
        LatticeError::NoStandardSites { lattice, levels, standard } => {
            let place = level_sections.last().map_or(section.place, |section| section.place);
            let message = format!("`levels`: a {lattice} lattice has standard sites for {standard} levels, not {levels}");
            Refusal::new(place, message, format!("received {levels} [[levels]]"))
                .help("or give every level its own, in fractions of the cell's vectors: sites = [[0.0, 0.0]]")
        }
        LatticeError::NoSite(level) | LatticeError::SharedSite(_, level) => {
            let place = level_sections[level - 1].optional("sites").map_or(section.place, |sites| sites.node.place);
            let fault = match error {
                LatticeError::SharedSite(other, _) if other == level => "two of them are the same place".to_owned(),
                LatticeError::SharedSite(other, _) => format!("`levels[{}]` has one at the same place", other - 1),
                other => other.to_string(),
            };
            Refusal::new(place, format!("`levels[{}].sites`: {fault}", level - 1), "these sites")
                .help("the cell is periodic: fractions that differ by integers are one place")
        }
        LatticeError::FlatCell(..) | LatticeError::NoPoints(..) | LatticeError::Site(_) => flat(section, &error),
    })
}

/// The cell, whose reduced basis is no more than a few thousand of its own vectors away, or what is wrong with it.
pub(super) fn build_cell(lattice: &LatticeSection, section: &TableAt<'_>) -> Result<Cell, Refusal> {
    let cell = lattice.cell().map_err(|error| flat(section, &error))?;
    let [[x1, y1], [x2, y2]] = cell.vectors();
    if cell.area() < SINE * x1.hypot(y1) * x2.hypot(y2) {
        return Err(flat(section, &LatticeError::FlatCell([x1, y1], [x2, y2])));
    }
    Ok(cell)
}

fn flat(section: &TableAt<'_>, error: &LatticeError) -> Refusal {
    match section.optional("a2") {
        Some(a2) => Refusal::new(a2.node.place, format!("`{}`: {error}", a2.path), "no cell")
            .help("give two vectors that are not parallel"),
        None => Refusal::new(section.place, format!("`{}`: {error}", section.path("period")), "no cell")
            .help("choose a unit in which the period is not as small or large"),
    }
}
