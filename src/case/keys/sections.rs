//! The whole case.

use super::body::{LAYER, LAYERS, SUBSTRATE};
use super::counterbody::{LATTICE, LEVELS, SURFACE};
use super::key::{Form, Key, Keys};
use super::run::{FRICTION, GRID, LOAD, SOLVER, UNITS};
use super::stress::{LOCALIZED, STRESS};

/// Paths of the tables within the case that have a key.
pub(in crate::case) fn homes(name: &str) -> Vec<String> {
    let tables = CASE.tables("").into_iter().skip(1);
    tables.filter(|(_, keys)| keys.get(name).is_some()).map(|(path, _)| path).collect()
}

/// The whole case.
pub(in crate::case) static CASE: Keys = Keys::new(&[
    Key::new("title", "what the case is", &[Form::Text("a text of one line")], "\"three levels in contact\"")
        .default("\"\""),
    Key::new(
        "lattice",
        "the cell, and with it the places of the indenters",
        &[Form::Table(&LATTICE)],
        "{ kind = \"hexagonal\", period = 1.0 }",
    )
    .otherwise("needed, unless `surface` says how large the cell is"),
    Key::new(
        "levels",
        "indenters of one shape and height, one section `[[levels]]` a level",
        &[Form::Sections(&LEVELS, 200)],
        "[{ shape = \"paraboloid\", radius = 0.8, height = 0.0 }]",
    ),
    Key::new(
        "surface",
        "one period of any topography",
        &[Form::Table(&SURFACE)],
        "{ heights = \"surface.npy\", period = 10.0 }",
    )
    .instead_of("levels"),
    Key::new(
        "layers",
        "the coating, one section `[[layers]]` a layer from the surface down",
        &[Form::Sections(&LAYER, LAYERS)],
        "[{ thickness = 0.5, shear_ratio = 2.0, poisson = 0.2 }]",
    )
    .otherwise("uncoated")
    .rule("sublayers of graded layers count among the 200"),
    Key::new("substrate", "what the coating lies on", &[Form::Table(&SUBSTRATE)], "{ young = 1.0, poisson = 0.3 }"),
    Key::new("load", "what is prescribed, one value a load step", &[Form::Table(&LOAD)], "{ mean_pressure = 0.01 }"),
    Key::new("grid", "samples of the cell", &[Form::Table(&GRID)], "{ points = 256 }").otherwise("its defaults"),
    Key::new(
        "solver",
        "how the contact problem is solved, and how far",
        &[Form::Table(&SOLVER)],
        "{ method = \"polonsky-keer\" }",
    )
    .otherwise("its defaults"),
    Key::new("friction", "the indenters slide", &[Form::Table(&FRICTION)], "{ coefficient = 0.3 }")
        .otherwise("they do not slide"),
    Key::new(
        "units",
        "names for axes, tables and captions; numbers are not converted",
        &[Form::Table(&UNITS)],
        "{ length = \"µm\", pressure = \"GPa\" }",
    )
    .otherwise("no names"),
    Key::new(
        "stress",
        "stresses that are wanted",
        &[Form::Table(&STRESS)],
        "{ planes = [0.0, 0.5], mean = \"half-space\" }",
    )
    .otherwise("no stresses"),
    Key::new(
        "localized",
        "circles of the localized method, for `compare`",
        &[Form::Table(&LOCALIZED)],
        "{ indenters = [7, 37] }",
    )
    .otherwise("its defaults"),
]);
