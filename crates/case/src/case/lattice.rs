//! `[lattice]`: the cell, and the sites of each level.

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::levels::LevelSection;
use super::reader::TableAt;
use super::section::{Words, demanded, section, words};
use super::surface::Sides;
use percoat_core::lattice::{Cell, Lattice, LatticeError};

const COORDINATE: Form = Form::Number(Range::Coordinate);
const VECTOR: Form = Form::Tuple("a vector [x, y]", &[COORDINATE; 2]);

words! {
    /// Kinds of lattices.
    pub enum LatticeKind {
        /// Triangular; its cell is a rhombus of 60°.
        Hexagonal = "hexagonal",
        /// Square; its cell is a square.
        Square = "square",
        /// Any cell.
        Oblique = "oblique",
        /// No lattice: one contact in a window, with nothing around it.
        Isolated = "isolated",
    }
}

section! {
    /// The section `[lattice]`.
    #[derive(Copy)]
    pub struct LatticeSection = LATTICE, misplaced [
        ("a1", "the cell of a hexagonal or square lattice follows from `period`"),
        ("a2", "the cell of a hexagonal or square lattice follows from `period`"),
        ("period", "the cell of an oblique lattice is given by `a1` and `a2`, the window of an isolated contact by `size`"),
        ("size", "`size` is that of the window of an isolated contact"),
    ] {
        /// lattice of equilateral triangles, of squares, or any cell; or one isolated contact in a window, with nothing around it
        pub kind: LatticeKind = Key::new(&[Form::Word(LatticeKind::WORDS)], "\"hexagonal\""),
        /// the distance of neighbouring indenters whatever their level
        pub period: Option<f64> = Key::new(&[Form::Number(Range::Size)], "1.0")
            .unit(Unit::Length)
            .of(&["hexagonal", "square"])
            .rule("with `sites` and with a surface: the side of the cell"),
        /// a cell vector
        pub a1: Option<[f64; 2]> = Key::new(&[VECTOR], "[1.0, 0.0]")
            .unit(Unit::Length)
            .of(&["oblique"])
            .rule("not parallel to `a2`"),
        /// a cell vector
        pub a2: Option<[f64; 2]> = Key::new(&[VECTOR], "[0.25, 1.5]")
            .unit(Unit::Length)
            .of(&["oblique"])
            .rule("not parallel to `a1`"),
        /// the sides of the window around the contact, whose middle is the origin
        pub size: Option<Sides> = Key::new(&[Form::Number(Range::Size), Form::Tuple("two of them, [w1, w2]", &[Form::Number(Range::Size); 2])], "2.0")
            .unit(Unit::Length)
            .of(&["isolated"])
            .rule("contact must stay inside; at the same spacing of the samples nothing else depends on it"),
    }
}

/// Most indenters a cell can hold.
const MOST_INDENTERS: usize = 10_000;

/// Least sine of the angle between the cell vectors: a narrower cell has a better basis.
const SINE: f64 = 1e-3;

impl LatticeSection {
    /// A square or rectangular cell with these sides, lengths.
    pub(super) fn rectangle([side1, side2]: [f64; 2]) -> Self {
        let (square, oblique) = (LatticeKind::Square, LatticeKind::Oblique);
        match side1 == side2 {
            true => Self { kind: square, period: Some(side1), a1: None, a2: None, size: None },
            false => Self { kind: oblique, period: None, a1: Some([side1, 0.0]), a2: Some([0.0, side2]), size: None },
        }
    }

    /// The cell of side `period`, or of the vectors `a1` and `a2`, or the window.
    pub(super) fn cell(&self) -> Result<Cell, LatticeError> {
        match self.kind {
            LatticeKind::Hexagonal => Cell::hexagonal(demanded(self.period)),
            LatticeKind::Square => Cell::square(demanded(self.period)),
            LatticeKind::Oblique => Cell::new(demanded(self.a1), demanded(self.a2)),
            LatticeKind::Isolated => Cell::window(demanded(self.size).0),
        }
    }

    /// The lattice of the levels, with their own sites or the standard ones.
    pub(super) fn build(&self, levels: &[LevelSection]) -> Result<Lattice, LatticeError> {
        let sites: Option<Vec<_>> = levels.iter().map(|level| level.sites.clone()).collect();
        match (sites, self.kind) {
            (Some(sites), LatticeKind::Isolated) => {
                // Sites count from the middle of the window.
                let moved = |sites: Vec<[f64; 2]>| sites.into_iter().map(|site| site.map(|s| s + 0.5)).collect();
                Lattice::new(self.cell()?, sites.into_iter().map(moved).collect())
            }
            (None, LatticeKind::Isolated) if levels.len() == 1 => Lattice::new(self.cell()?, vec![vec![[0.5; 2]]]),
            (None, LatticeKind::Isolated) => {
                Err(LatticeError::NoStandardSites { lattice: "isolated", levels: levels.len(), standard: "1" })
            }
            (Some(sites), _) => Lattice::new(self.cell()?, sites),
            (None, LatticeKind::Hexagonal) => Lattice::hexagonal(demanded(self.period), levels.len()),
            (None, LatticeKind::Square) => Lattice::square(demanded(self.period), levels.len()),
            (None, LatticeKind::Oblique) => {
                Err(LatticeError::NoStandardSites { lattice: "oblique", levels: levels.len(), standard: "none" })
            }
        }
    }
}

/// The lattice of the case, or a refusal at the line of the fault.
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
        return Err(Refusal::new(level_sections[absent].span, message, "no `sites` in this level")
            .help("give every level its sites, or none"));
    }
    let mut count = 0;
    for (section, level) in level_sections.iter().zip(levels) {
        count += level.sites.as_ref().map_or(1, Vec::len);
        if count > MOST_INDENTERS {
            let message =
                format!("the cell must hold at most {MOST_INDENTERS} indenters: with `levels` up to here {count}");
            return Err(Refusal::new(section.span, message, "too many sites"));
        }
    }
    build_cell(lattice, section)?;
    if lattice.kind == LatticeKind::Isolated {
        inside(levels, level_sections)?;
    }
    lattice.build(levels).map_err(|error| match error {
        LatticeError::NoStandardSites { .. } if lattice.kind == LatticeKind::Oblique => {
            Refusal::new(level_sections[0].span, "`levels[0].sites` is missing", "no `sites` in this level")
                .help("an oblique cell has no standard sites: give each level its own, in fractions of a1, a2: sites = [[0.0, 0.0]]")
        }
        LatticeError::NoStandardSites { lattice, levels, standard } => {
            let span = level_sections.last().map_or(section.span, |section| section.span);
            let message = format!("`levels`: a {lattice} lattice has standard sites for {standard} levels, not {levels}");
            Refusal::new(span, message, format!("received {levels} [[levels]]"))
                .help("or give every level its own, in fractions of the cell's vectors: sites = [[0.0, 0.0]]")
        }
        LatticeError::NoSite(level) | LatticeError::SharedSite(_, level) => {
            let span = level_sections[level - 1].optional("sites").map_or(section.span, |sites| sites.node.span);
            let fault = match error {
                LatticeError::SharedSite(other, _) if other == level => "two of them are the same place".to_owned(),
                LatticeError::SharedSite(other, _) => format!("`levels[{}]` has one at the same place", other - 1),
                other => other.to_string(),
            };
            Refusal::new(span, format!("`levels[{}].sites`: {fault}", level - 1), "these sites")
                .help("the cell is periodic: fractions that differ by integers are one place")
        }
        LatticeError::FlatCell(..) | LatticeError::NoPoints(..) | LatticeError::Site(_) => flat(section, &error),
    })
}

/// Refuses sites outside of the window of an isolated contact.
fn inside(levels: &[LevelSection], sections: &[TableAt<'_>]) -> Result<(), Refusal> {
    for (index, (level, section)) in levels.iter().zip(sections).enumerate() {
        let outside = level.sites.iter().flatten().find(|site| site.iter().any(|s| s.abs() >= 0.5));
        if let Some([s1, s2]) = outside {
            let span = section.optional("sites").map_or(section.span, |sites| sites.node.span);
            let message = format!("`levels[{index}].sites`: [{s1}, {s2}] is not inside the window");
            return Err(Refusal::new(span, message, "between -0.5 and 0.5")
                .help("sites of an isolated contact are fractions of the window's sides from its middle; or enlarge lattice.size"));
        }
    }
    Ok(())
}

/// The cell, or a refusal of vectors that are nearly parallel or of a size beyond double precision.
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
        Some(a2) => Refusal::new(a2.node.span, format!("`{}`: {error}", a2.path), "no cell")
            .help("give two vectors that are not parallel"),
        None => Refusal::new(section.span, format!("`{}`: {error}", section.path("period")), "no cell")
            .help("choose a unit in which the period is not as small or large"),
    }
}
