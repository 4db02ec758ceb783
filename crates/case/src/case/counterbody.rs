//! The counterbody of a case: levels of indenters on their lattice, or a surface; or a given pressure.

use super::error::Refusal;
use super::feasibility::magnitude;
use super::given;
use super::lattice::{self, LatticeSection};
use super::levels::LevelSection;
use super::reader::TableAt;
use super::source::Source;
use super::surface::{self, Around, SurfaceSection};
use crate::case::section::ReadTable;
use percoat_core::counterbody::{Indenters, Level, LoadedBy};
use percoat_core::run::Sampling;

/// The counterbody of a case, with the sections from which it is read: levels on a lattice, or a surface.
pub(super) struct CounterbodySections<'a> {
    pub(super) levels: Vec<LevelSection>,
    pub(super) lattice: LatticeSection,
    /// The section that gives the cell: `[lattice]`, or `[surface]` with a size of its own.
    pub(super) cell_section: TableAt<'a>,
    pub(super) grid_section: TableAt<'a>,
    /// A surface with its grid; `None` for levels and a given pressure.
    pub(super) surface: Option<(SurfaceSection, Sampling)>,
    /// Warnings about the file of a surface or of a given pressure.
    pub(super) doubts: Vec<String>,
    pub(super) loaded_by: LoadedBy,
}

/// The levels of indenters, the surface, or the given pressure.
pub(super) fn read<'a>(root: &TableAt<'a>, source: &Source) -> Result<CounterbodySections<'a>, Refusal> {
    if let Some((pressure, doubts)) = given::read(root, source, length_unit(root)?.as_deref())? {
        let cell_section = root.required_section("lattice")?;
        return Ok(CounterbodySections {
            levels: Vec::new(),
            lattice: LatticeSection::read_table(&cell_section)?,
            cell_section,
            grid_section: root.section_or_empty("grid")?,
            surface: None,
            doubts,
            loaded_by: pressure.into(),
        });
    }
    let length = length_unit(root)?;
    let level_sections = root.sections("levels")?;
    let read = level_sections.iter().map(|table| LevelSection::read_in(table, source, length.as_deref()));
    let (levels, built): (Vec<LevelSection>, Vec<Level>) = read.collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
    let surface_section = match (&level_sections[..], root.section("surface")?) {
        ([], Some(section)) => Some(section),
        ([_, ..], None) => None,
        ([_, ..], Some(section)) => return Err(root.both(["levels", "surface"], section.span)),
        ([], None) => {
            root.required_section("lattice")?;
            let refusal = Refusal::new(root.span, "the case has neither [[levels]] nor [surface]", "none up to here");
            return Err(refusal.help(format!("add a level, for example\n{}", root.example("levels"))));
        }
    };
    let grid_section = root.section_or_empty("grid")?;
    let lattice_section = root.section("lattice")?;
    if let Some(section) = surface_section {
        let (lattice, grid) = (lattice_section.clone(), grid_section.clone());
        let around = Around { source, lattice, grid, length };
        let read = surface::read(&section, &around)?;
        return Ok(CounterbodySections {
            levels,
            lattice: read.lattice,
            cell_section: lattice_section.unwrap_or(section),
            grid_section,
            surface: Some((read.section, read.sampling)),
            doubts: read.doubts,
            loaded_by: read.topography.into(),
        });
    }
    let cell_section = root.required_section("lattice")?;
    let lattice_section = LatticeSection::read_table(&cell_section)?;
    let lattice = lattice::build(&lattice_section, &cell_section, &levels, &level_sections)?;
    magnitude::profiles(&built, &level_sections, lattice.cell())?;
    // Both were checked key by key.
    let loaded_by = Indenters::new(lattice, built)
        .map(LoadedBy::from)
        .map_err(|error| Refusal::new(cell_section.span, format!("`lattice`: {error}"), "no counterbody"))?;
    Ok(CounterbodySections {
        levels,
        lattice: lattice_section,
        cell_section,
        grid_section,
        surface: None,
        doubts: Vec::new(),
        loaded_by,
    })
}

/// `units.length`, where the case names its units.
fn length_unit(root: &TableAt<'_>) -> Result<Option<String>, Refusal> {
    let length = root.section("units")?.and_then(|units| units.optional("length"));
    length.map(|length| length.name().map(str::to_owned)).transpose()
}
