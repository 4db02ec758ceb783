//! `[lattice]`: the cell, and where the indenters of each level stand in it.

use serde::Serialize;

use super::error::Refusal;
use super::levels::LevelSection;
use super::limits;
use super::reader::Section;
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

const PERIOD: &str = "the distance of neighbouring indenters whatever their level";

impl LatticeSection {
    pub(super) fn read(section: &Section<'_>) -> Result<Self, Refusal> {
        const VECTORS: &str = "the cell of a hexagonal or square lattice follows from `period`";
        const NO_PERIOD: &str = "the cell of an oblique lattice is given by `a1` and `a2`";
        let kind = section.required("kind", "\"hexagonal\", \"square\" or \"oblique\"")?;
        let period = || {
            section.only(&["kind", "period"], &[("a1", VECTORS), ("a2", VECTORS)])?;
            limits::size(&section.required("period", PERIOD)?)
        };
        match kind.choice(&[("hexagonal", 0), ("square", 1), ("oblique", 2)])? {
            0 => Ok(Self::Hexagonal { period: period()? }),
            1 => Ok(Self::Square { period: period()? }),
            _ => {
                section.only(&["kind", "a1", "a2"], &[("period", NO_PERIOD)])?;
                let vector = |key| section.required(key, "a cell vector [x, y]")?.pair("a vector [x, y]");
                Ok(Self::Oblique { a1: vector("a1")?, a2: vector("a2")? })
            }
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
    section: &Section<'_>,
    levels: &[LevelSection],
    level_sections: &[Section<'_>],
) -> Result<Lattice, Refusal> {
    let given = levels.iter().position(|level| level.sites.is_some());
    let absent = levels.iter().position(|level| level.sites.is_none());
    if let (Some(given), Some(absent)) = (given, absent) {
        let message = format!("`levels[{absent}].sites` is missing, while `levels[{given}]` has its sites");
        return Err(Refusal::new(level_sections[absent].place(), message, "no `sites` in this level")
            .help("give every level its sites, or none"));
    }
    let mut count = 0;
    for (section, level) in level_sections.iter().zip(levels) {
        count += level.sites.as_ref().map_or(1, Vec::len);
        if count > MOST_INDENTERS {
            let message =
                format!("the cell must hold at most {MOST_INDENTERS} indenters: with `levels` up to here {count}");
            return Err(Refusal::new(section.place(), message, "too many sites"));
        }
    }
    limits::cell(lattice, section)?;
    lattice.build(levels).map_err(|error| match error {
        LatticeError::NoStandardSites { .. } if matches!(lattice, LatticeSection::Oblique { .. }) => {
            Refusal::new(level_sections[0].place(), "`levels[0].sites` is missing", "no `sites` in this level")
                .help("an oblique cell has no standard sites: give each level its own, in fractions of a1, a2: sites = [[0.0, 0.0]]")
        }
        LatticeError::NoStandardSites { lattice, levels, standard } => {
            let place = level_sections.last().map_or(section.place(), Section::place);
            let message = format!("`levels`: a {lattice} lattice has standard sites for {standard} levels, not {levels}");
            Refusal::new(place, message, format!("received {levels} [[levels]]"))
                .help("or give every level its own, in fractions of the cell's vectors: sites = [[0.0, 0.0]]")
        }
        LatticeError::NoSite(level) | LatticeError::SharedSite(_, level) => {
            let place = level_sections[level - 1].optional("sites").map_or(section.place(), |sites| sites.place());
            let fault = match error {
                LatticeError::SharedSite(other, _) if other == level => "two of them are the same place".to_owned(),
                LatticeError::SharedSite(other, _) => format!("`levels[{}]` has one at the same place", other - 1),
                other => other.to_string(),
            };
            Refusal::new(place, format!("`levels[{}].sites`: {fault}", level - 1), "these sites")
                .help("the cell is periodic: fractions that differ by integers are one place")
        }
        LatticeError::FlatCell(..) => flat(section, &error),
    })
}

/// The cell of a case with a surface, or what is wrong with it.
pub(super) fn build_cell(lattice: &LatticeSection, section: &Section<'_>) -> Result<Cell, Refusal> {
    limits::cell(lattice, section)
}

pub(super) fn flat(section: &Section<'_>, error: &LatticeError) -> Refusal {
    match section.optional("a2") {
        Some(a2) => Refusal::new(a2.place(), format!("`{}`: {error}", a2.path()), "no cell")
            .help("give two vectors that are not parallel"),
        None => Refusal::new(section.place(), format!("`{}`: {error}", section.path("period")), "no cell")
            .help("choose a unit in which the period is not as small or large"),
    }
}
