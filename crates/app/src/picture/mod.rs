//! Pictures in the style of a journal: charts and fields, as PNG, SVG or PDF files.
//!
//! A picture is one column (85 mm) or two columns wide, its letters 6 to 8 points high, its typeface embedded. It is drawn on a
//! sheet measured in points ([`Canvas`]), which is written as pixels or as lines.
//!
//! Meaning of the lines, in every picture and in Python's `percoat.plot`:
//!
//! - **dashed**: what the results are compared with: an indenter alone, the bare body, a closed form, another method, the limit of
//!   failure;
//! - dotted: a value marked on an axis, the hole of a ring, and a third kind of curve beside thick and thin ones;
//! - thin and solid: borders (interfaces, the unit cell, zero), and the second kind of many curves;
//! - bars and bands: the estimated errors; no line leads through noise (`error_bars`).
//!
//! Pictures:
//!
//! - Any curves: [`Chart`], and [`Figure`] for several charts side by side.
//! - The part of the surface that a map shows: [`view`].
//! - A solved load step ([`Snapshot`]): [`pressure`](pressure()), [`contact`](contact()), [`profiles`](profiles());
//!   what hardness has pressed in: [`indentation`](indentation()).
//! - Its surfaces under frictional heat: [`temperature`](temperature()).
//! - Its partial slip: [`slip`](slip()), and the loop of all steps: [`slip_loop`].
//! - Surfaces that adhere: [`approach`], force and area over the penetration.
//! - Bodies that creep: [`creep`](creep()), load, penetration and contact over time.
//! - Its stresses under a line ([sections](percoat_core::stress::VerticalSection)): [`section`](section()), [`lines`](lines()).
//! - The steps of a run: [`load_curves`](load_curves()); of a search for limit loads: [`utilisations`](utilisations()).
//! - Damage below the surface: [`damage`](damage()); what is left of a body pass after pass: [`course`](course()).
//! - The rows of a sweep: [`sweep`](sweep()): curves over a key, maps over two; of uncertain keys: [`uncertainty`](uncertainty()).
//! - Measured curves and what was found by them: [`identification`](identification()), [`unloading`](unloading()),
//!   [`retraction`](retraction()).
//! - Localized against spectral: [`comparison`](comparison()).
//! - A topography before anything is solved: [`spectrum`](spectrum()).

mod adhesion;
mod between_rows;
mod comparison;
mod contact;
mod creep;
mod file;
mod identification;
mod indentation;
mod labels;
mod life;
mod lines;
mod load_curves;
mod outline;
mod pressure;
mod profiles;
mod retraction;
mod section;
mod shown_depths;
mod signed_values;
mod slip;
mod snapshot;
mod spectrum;
mod sweep;
mod temperature;
mod tiling;
mod uncertainty;
mod unloading;
mod utilisations;
mod window;
mod zoom;

pub use percoat_draw::{Axis, Canvas, Chart, Curve, Figure, Format, Ink, Label, Scale, Style};

pub use adhesion::approach;
pub use comparison::comparison;
pub use contact::contact;
pub use creep::creep;
pub use file::write;
pub use identification::identification;
pub use indentation::indentation;
pub use life::{course, damage};
pub use lines::lines;
pub use load_curves::load_curves;
pub use pressure::pressure;
pub use profiles::profiles;
pub use retraction::retraction;
pub use section::section;
pub use slip::{slip, slip_loop};
pub use snapshot::Snapshot;
pub use spectrum::spectrum;
pub use sweep::sweep;
pub use temperature::temperature;
pub use uncertainty::uncertainty;
pub use unloading::unloading;
pub use utilisations::utilisations;
pub use window::{View, Window};
pub use zoom::view;
