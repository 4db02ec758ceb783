//! The case file: the input of percoat, checked once, with every default resolved.
//!
//! A [`Case`] is read from TOML ([`Case::read`]), changed by overrides `KEY=VALUE`, and converted to the core's types: its problem,
//! and the run that solves it. Faults are refused with their line ([`CaseError`]).
//!
//! One file a section: lattice, levels (with `area_function`), surface, layers (with the substrate, `durability`, `interface` and `grading`), elastic counterbody, load (with a `given` pressure), grid, solver,
//! friction, tangential, adhesion, motion, heat, time, units, stress, localized, life; `model` has them all. Each field of a section is a key, declared once (`section`); `keys`
//! makes of them the texts of `percoat explain` and the schema; `identification` lets numbers be free; `materials` is the library. A [`Document`] is parsed to a tree (`node`) once, changed by `overrides`,
//! and read strictly (`reader`, `value`). [`feasibility`] refuses what cannot be solved and warns of implausible numbers.
//!
//! ```
//! use percoat_case::case::{Case, embedded};
//! let source = embedded::source(embedded::DEFAULT).expect("the default case is embedded");
//! let case = Case::read(&source, &["load.mean_pressure=0.01".to_owned()]).expect("a valid case");
//! assert_eq!(case.load.values(), [0.01]);
//! ```

mod adhesion;
mod area_function;
mod composite_hardness;
mod counterbody;
mod document;
mod durability;
mod elastic_counterbody;
pub mod embedded;
mod error;
pub mod feasibility;
mod friction;
mod given;
mod grading;
mod grid;
mod half_space;
mod heat;
mod identification;
mod interface;
mod keys;
mod kind;
mod lattice;
mod layers;
mod levels;
mod life;
mod load;
mod localized;
mod lookup;
mod material_keys;
mod material_names;
mod materials;
mod measures;
mod model;
mod motion;
mod named_pipes;
mod node;
mod number;
mod overrides;
mod plain_toml;
mod reader;
mod relaxation;
mod section;
mod solver;
mod source;
mod span;
mod stress;
pub mod suggestions;
mod surface;
mod tangential;
#[cfg(test)]
mod tests;
mod time;
mod units;
mod value;
mod writer;

pub use adhesion::{AdhesionSection, TensionLaw};
pub use area_function::{AreaSection, CoefficientsSection};
pub use composite_hardness::CompositeHardnessSection;
pub use document::Document;
pub use durability::{EnduranceSection, FatigueSection, failures_of};
pub use elastic_counterbody::CounterbodySection;
pub use error::CaseError;
pub use feasibility::single_contact::foreseen;
pub use feasibility::sublayers::sublayer_error;
pub use feasibility::{plausibility, resources};
pub use friction::FrictionSection;
pub use given::{DiscsSection, GivenSection, Pressures};
pub use grading::{Grading, Law};
pub use grid::Points;
pub use half_space::half_space;
pub use heat::{HeatSection, PartitionValue};
pub use identification::{Found, IdentificationTask, Known, NotFree, NotKnown};
pub use interface::{InterfaceSection, InterfaceStrengthSection, InterfaceWord, SpringSection};
pub use keys::{Explanation, NamedKey, UnknownKey, explain, overview, schema, table as key_table};
pub use kind::kind_of;
pub use lattice::{LatticeKind, LatticeSection};
pub use layers::{LayerSection, Rigid, SubstrateSection};
pub use levels::{LevelSection, ShapeKind};
pub use life::LifeSection;
pub use load::{LoadSection, Steps};
pub use localized::LocalizedSection;
pub use lookup::{NoCase, find};
pub use materials::{
    Certainty, LibraryMaterial, LibraryStrength, MaterialsError, Property, UnknownMaterial, library, materials_of_file,
};
pub use measures::NoLoad;
pub use model::Case;
pub use motion::MotionSection;
pub use named_pipes::Pipes;
pub use number::NoRange;
pub use overrides::{given_twice, parts};
pub use relaxation::{ConstantWord, RelaxationSection};
pub use source::{PhysicalSizes, Source};
pub use stress::{CutSection, Origin, StressSection, Toward};
pub use surface::{ORIENTATION, RandomSection, Sides, Stage, SurfaceSection, Taper, Treated, WantedChannel};
pub use tangential::{Component, History, PathSection, RollingSection, TangentialSection};
pub use time::TimeSection;
pub use units::UnitsSection;
pub use writer::written;
