//! Charts and maps in the style of a journal, as PNG, SVG or PDF files. No physics.
//!
//! A picture is one column (85 mm) or two columns wide, its letters 6 to 8 points high, its typeface embedded. It is drawn on a
//! sheet measured in points ([`Canvas`]), which is written as pixels or as lines.

pub mod axis;
pub mod bar;
pub mod canvas;
pub mod chart;
pub mod colour;
pub mod contour;
pub mod curve;
pub mod error_bars;
mod file;
pub mod frame;
pub mod label;
mod legend;
mod letters;
pub mod map;
pub mod number;
mod paper;
mod raster;
pub mod scale;
pub mod sheet;
pub mod text;
pub mod ticks;
mod typeface;
mod vector;

pub use axis::Axis;
pub use canvas::Canvas;
pub use chart::{Chart, Figure};
pub use curve::{Curve, Ink, Style};
pub use file::Format;
pub use label::Label;
pub use scale::Scale;
pub use vector::base64;
