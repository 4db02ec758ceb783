//! `[counterbody]`: the elastic body that the indenters or the topography belong to.

use super::error::Refusal;
use super::grading::LAYERS;
use super::keys::{Form, Key, Unit};
use super::layers::{
    self, Body, LAYER, LayerSection, MATERIAL, NAME, POISSON, RIGID, Rigid, SIZE, SubstrateSection, TENSILE, YIELD,
};
use super::reader::TableAt;
use super::section::{KeyValue, section};
use super::value::ValueAt;
use crate::body::HalfSpace;
use serde::Serialize;

section! {
    /// The section `[counterbody]`.
    pub struct CounterbodySection = COUNTERBODY, rules elastic_or_rigid, misplaced [
        ("shear_ratio", "`shear_ratio` relates a layer to its substrate, whose modulus is `young`"),
        ("radius", "the shape of the counterbody stands in [[levels]] or [surface]"),
    ] {
        /// material of `percoat materials` or of the file `materials`, for moduli, strengths and name that are not given
        pub material: Option<String> = MATERIAL,
        /// name of the material, used in place of its number in tables and pictures
        pub name: Option<String> = NAME,
        /// Young's modulus
        pub young: Option<f64> = Key::new(&[SIZE], "210.0").unit(Unit::Pressure),
        /// Poisson's ratio
        pub poisson: Option<f64> = Key::new(&[POISSON], "0.3"),
        /// yield strength, compared with the von Mises stress
        pub yield_strength: Option<f64> = YIELD,
        /// tensile strength, compared with the largest principal stress
        pub tensile_strength: Option<f64> = TENSILE,
        /// whether it is rigid below its coating, without moduli, name and strengths; the interface of the last layer joins it to the base
        pub rigid: Rigid = RIGID,
        /// its coating, one section `[[counterbody.layers]]` a layer from its surface inward, with the keys of `[[layers]]`
        pub layers: Coating =
            Key::new(&[Form::Sections(&LAYER, LAYERS)], "[{ thickness = 0.5, young = 300.0, poisson = 0.25 }]")
                .otherwise("uncoated")
                .rule("sublayers of graded layers count among the 200")
                .omitted_as_nothing(),
    }
}

/// The layers of a counterbody, from its surface inward.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Coating(pub Vec<LayerSection>);

impl KeyValue for Coating {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        Err(value.refuse_form())
    }

    fn of(table: &TableAt<'_>, key: &str) -> Result<Self, Refusal> {
        table.sections(key)?.iter().map(LayerSection::read_table).collect::<Result<_, _>>().map(Self)
    }

    fn is_nothing(&self) -> bool {
        self.0.is_empty()
    }
}

/// Refuses a rigid base with keys of a material, and an elastic one without moduli.
fn elastic_or_rigid(own: &CounterbodySection, section: &TableAt<'_>) -> Result<(), Refusal> {
    layers::modulus_or_rigid(own.rigid.0, section)
}

impl CounterbodySection {
    /// Its material below the layers.
    pub fn substrate(&self) -> SubstrateSection {
        SubstrateSection {
            material: self.material.clone(),
            name: self.name.clone(),
            young: self.young,
            poisson: self.poisson,
            yield_strength: self.yield_strength,
            tensile_strength: self.tensile_strength,
            rigid: self.rigid,
        }
    }

    /// It with twice the sublayers in graded layers; `None` without graded layers.
    pub fn refined(&self) -> Option<HalfSpace> {
        layers::refined(&self.layers.0, &self.substrate())
    }
}

/// Reads `[counterbody]`, with the half-space and the sections of its layers.
pub(super) fn read<'a>(section: &TableAt<'a>) -> Result<(CounterbodySection, Body<'a>), Refusal> {
    let own = CounterbodySection::read_table(section)?;
    let sections = section.sections("layers")?;
    let body = layers::build_body(own.layers.0.clone(), sections, own.substrate(), section)?;
    Ok((own, body))
}
