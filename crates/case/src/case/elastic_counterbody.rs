//! `[counterbody]`: the body that the indenters or the topography belong to, elastic, or rigid with a hardness or wear.

use super::error::Refusal;
use super::grading::LAYERS;
use super::keys::{Form, Key, Unit};
use super::layers::{self, Body, ELASTIC, LAYER, LayerSection, POISSON, RIGID, Rigid, SIZE, SubstrateSection};
use super::material_keys::material_section;
use super::reader::TableAt;
use super::section::{KeyValue, ReadTable};
use super::value::ValueAt;
use percoat_core::body::{Bodies, Durability, HalfSpace, MaterialError};
use serde::Serialize;

material_section! {
    /// The section `[counterbody]`.
    pub struct CounterbodySection = COUNTERBODY, rules elastic_or_rigid, misplaced [
        ("shear_ratio", "`shear_ratio` relates a layer to its substrate, whose modulus is `young`"),
        ("radius", "the shape of the counterbody stands in [[levels]] or [surface]"),
    ] {
        /// Young's modulus
        pub young: Option<f64> = Key::new(&[SIZE], "210.0").unit(Unit::Pressure),
        /// Poisson's ratio
        pub poisson: Option<f64> = Key::new(&[POISSON], "0.3"),
    }
    {
        /// whether it is rigid: below its coating, whose last layer its interface joins to it, or uncoated with a hardness or wear
        pub rigid: Rigid = RIGID.and_of(ELASTIC),
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

/// Refuses a rigid counterbody with keys of a material, hardness and wear of one below a coating, and an elastic one without
/// moduli.
fn elastic_or_rigid(counterbody: &CounterbodySection, section: &TableAt<'_>) -> Result<(), Refusal> {
    layers::modulus_or_rigid(counterbody.rigid.0, ELASTIC, section)?;
    let of_surface = ["hardness", "wear"].into_iter().find_map(|key| section.optional(key));
    match of_surface.filter(|_| counterbody.rigid.0 && counterbody.is_elastic()) {
        Some(value) => {
            let message =
                format!("`{}` has no meaning: a layer is at the surface of the rigid counterbody", value.path);
            Err(Refusal::new(value.node.span, message, "not at the surface").help("give it to the layers"))
        }
        None => Ok(()),
    }
}

impl CounterbodySection {
    /// Whether anything of it is elastic: itself, or a coating.
    pub fn is_elastic(&self) -> bool {
        !self.rigid.0 || !self.layers.0.is_empty()
    }

    /// Material below the layers, with the keys of a substrate.
    pub fn substrate(&self) -> SubstrateSection {
        SubstrateSection {
            material: self.material.clone(),
            name: self.name.clone(),
            young: self.young,
            poisson: self.poisson,
            relaxation: self.relaxation.clone(),
            conductivity: self.conductivity,
            diffusivity: self.diffusivity,
            expansion: self.expansion,
            yield_strength: self.yield_strength,
            tensile_strength: self.tensile_strength,
            hardness: self.hardness,
            wear: self.wear,
            fatigue: self.fatigue,
            endurance: self.endurance,
            strain_life: self.strain_life,
            rigid: self.rigid,
        }
    }

    /// Durability of the surface of a rigid and uncoated counterbody.
    fn rigid_durability(&self) -> Durability {
        Durability { hardness: self.hardness, wear: self.wear, ..Durability::default() }
    }

    /// Half-space with twice the sublayers in graded layers; `None` without graded layers.
    pub fn refined(&self) -> Option<HalfSpace> {
        layers::refined(&self.layers.0, &self.substrate())
    }
}

/// The section `[counterbody]` with its body.
pub(super) struct Above<'a> {
    pub(super) section: CounterbodySection,
    /// Layers and substrate; `None` of a rigid and uncoated counterbody, which has the durability of its surface alone.
    pub(super) body: Option<Body<'a>>,
}

impl Above<'_> {
    /// Both bodies: the counterbody above `body`.
    pub(super) fn bodies(&self, body: HalfSpace) -> Result<Bodies, MaterialError> {
        match &self.body {
            Some(above) => Ok(Bodies::elastic(body, above.half_space.clone())),
            None => Bodies::from(body).with_rigid_durability(self.section.rigid_durability()),
        }
    }
}

/// Advice on a rigid counterbody that has nothing to say.
const UNCOATED: &str =
    "without [counterbody] it is rigid; a rigid [counterbody] has layers, or a `hardness` or `wear` of its own";

/// Reads `[counterbody]`, with the half-space and the sections of its layers.
pub(super) fn read<'a>(section: &TableAt<'a>) -> Result<Above<'a>, Refusal> {
    let counterbody = CounterbodySection::read_table(section)?;
    if !counterbody.is_elastic() && counterbody.rigid_durability() != Durability::default() {
        return Ok(Above { section: counterbody, body: None });
    }
    let sections = section.sections("layers")?;
    let body = layers::build_body(counterbody.layers.0.clone(), sections, counterbody.substrate(), section)
        .map_err(|refusal| if counterbody.is_elastic() { refusal } else { refusal.help(UNCOATED) })?;
    Ok(Above { section: counterbody, body: Some(body) })
}
