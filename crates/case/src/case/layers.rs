//! `[[layers]]` and `[substrate]`: the coated half-space, or layers on a rigid base.

use super::durability::{FATIGUE, FatigueSection, durability};
use super::error::Refusal;
use super::grading::{GRADING, Grading, LAYERS};
use super::heat;
use super::interface::{INTERFACE_STRENGTH, InterfaceSection, InterfaceStrengthSection, SPRING};
use super::keys::{Form, Key, Range, Unit};
use super::material_keys::material_section;
use super::material_names::distinct;
use super::reader::TableAt;
use super::relaxation::RelaxationSection;
use super::section::{KeyValue, ReadTable, demanded};
use super::value::ValueAt;
use percoat_core::body::{
    HalfSpace, Interface, InterfaceStrength, Layer, Material, MaterialError, Name, Relaxation, Strength,
};
use serde::Serialize;

pub(super) const SIZE: Form = Form::Number(Range::Size);
pub(super) const POISSON: Form = Form::Number(Range::between(0.0, 0.5));

/// Keys that a rigid base does not have, beside `young`; the last two are those of a surface.
const BELOW: &[&str] = &[
    "poisson",
    "material",
    "name",
    "relaxation",
    "conductivity",
    "diffusivity",
    "expansion",
    "yield_strength",
    "tensile_strength",
    "fatigue",
    "endurance",
    "strain_life",
    "hardness",
    "wear",
];
/// Keys that a rigid counterbody does not have, beside `young`.
pub(super) const ELASTIC: &[&str] = BELOW.split_at(BELOW.len() - 2).0;
pub(super) const RIGID: Key =
    Key::new(&[Form::Boolean], "true").otherwise("elastic").omitted_as_nothing().instead_of("young");

/// Whether a substrate is a rigid base.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(transparent)]
pub struct Rigid(pub bool);

impl KeyValue for Rigid {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        value.boolean().map(Self)
    }

    fn of(table: &TableAt<'_>, key: &str) -> Result<Self, Refusal> {
        table.optional(key).map_or(Ok(Self::default()), |value| Self::read(&value))
    }

    fn is_nothing(&self) -> bool {
        !self.0
    }
}

material_section! {
    /// One section of `[[layers]]`, from the surface down.
    pub struct LayerSection = LAYER, rules consistent {
        /// the thickness of the layer
        pub thickness: f64 = Key::new(&[SIZE], "0.5").unit(Unit::Length),
        /// shear modulus over that of the substrate, χ
        pub shear_ratio: Option<f64> = Key::new(&[SIZE], "2.0"),
        /// Young's modulus
        pub young: Option<f64> = Key::new(&[SIZE], "300.0").unit(Unit::Pressure).instead_of("shear_ratio"),
        /// Poisson's ratio
        pub poisson: Option<f64> = Key::new(&[POISSON], "0.25"),
        /// moduli that change with depth, `poisson` included; the layer is divided into bonded sublayers
        pub graded: Option<Grading> =
            Key::new(&[Form::Table(&GRADING)], "{ young = [4.0, 1.0], poisson = [0.2, 0.3] }")
                .instead_of("young")
                .and_of(&["shear_ratio", "poisson"]),
        /// the interface below the layer; a table is a spring
        pub interface: InterfaceSection =
            Key::new(&[Form::Word(InterfaceSection::WORDS), Form::Table(&SPRING)], "{ tangential_stiffness = 10.0 }")
                .default("\"bonded\""),
        /// equi-biaxial residual stress, positive in tension
        pub residual_stress: f64 = Key::new(&[Form::Number(Range::Coordinate)], "-2.0")
            .unit(Unit::Pressure)
            .default("0")
            .omitted_as_nothing(),
    }
    {
        /// strengths of the interface below the layer
        pub interface_strength: Option<InterfaceStrengthSection> =
            Key::new(&[Form::Table(&INTERFACE_STRENGTH)], "{ normal = 0.5, shear = 0.8 }")
                .otherwise("never reached")
                .rule("at least one of normal and shear"),
        /// thermal resistance of the interface below the layer, a temperature per power and area
        pub thermal_resistance: f64 = heat::RESISTANCE,
        /// fatigue of the interface below the layer by the range of its shear stress in a pass; not of a frictionless one
        pub interface_fatigue: Option<FatigueSection> =
            Key::new(&[Form::Table(&FATIGUE)], "{ amplitude = 0.2, passes = 1e6, exponent = 8 }").otherwise("no fatigue"),
    }
}

material_section! {
    /// The section `[substrate]`.
    pub struct SubstrateSection = SUBSTRATE, rules elastic_or_rigid, misplaced [
        ("shear_ratio", "`shear_ratio` relates a layer to the substrate, whose modulus is `young`")
    ] {
        /// Young's modulus
        pub young: Option<f64> = Key::new(&[SIZE], "210.0").unit(Unit::Pressure),
        /// Poisson's ratio
        pub poisson: Option<f64> = Key::new(&[POISSON], "0.3"),
    }
    {
        /// whether it is a rigid base, without the keys of a material; the interface of the last layer joins it to the base
        pub rigid: Rigid = RIGID.and_of(BELOW),
    }
}

/// Refuses a rigid base with keys of a material, and an elastic substrate without moduli.
fn elastic_or_rigid(substrate: &SubstrateSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    modulus_or_rigid(substrate.rigid.0, BELOW, section)
}

/// Refuses what is rigid with `young` or one of the `keys` of a material, and what is elastic without moduli.
pub(super) fn modulus_or_rigid(is_rigid: bool, keys: &[&str], section: &TableAt<'_>) -> Result<(), Refusal> {
    if !is_rigid {
        ["young", "poisson"].into_iter().try_for_each(|key| section.value(key).map(drop))?;
        return heat::consistent(section);
    }
    let Some(value) = ["young"].iter().chain(keys).find_map(|key| section.optional(key)) else { return Ok(()) };
    let message = format!("`{}` has no meaning: `{}` = true has no material", value.path, section.path("rigid"));
    Err(Refusal::new(value.node.span, message, "not of a rigid base").help("remove it, or `rigid`"))
}

/// Refuses interface strengths without a number, fatigue of an interface that transmits no shear, and a layer without either a
/// modulus and Poisson's ratio or `graded`.
fn consistent(layer: &LayerSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    if let Some(InterfaceStrengthSection { shear: None, normal, friction }) = layer.interface_strength
        && (normal.is_none() || friction > 0.0)
    {
        let refusal = section.value("interface_strength")?.refuse_form();
        return Err(refusal.help(match friction > 0.0 {
            true => "`friction` adds to the shear strength `shear`: give it, or leave `friction` out",
            false => "at least one of normal and shear; the one left out is never reached",
        }));
    }
    if let Some(value) = section.optional("interface_fatigue")
        && layer.interface.interface() == Interface::Frictionless
    {
        let message = format!("`{}` has no meaning: a frictionless interface transmits no shear", value.path);
        return Err(
            Refusal::new(value.node.span, message, "never loaded").help("remove it, or give another `interface`")
        );
    }
    if layer.graded.is_some() {
        let uniform = ["shear_ratio", "young", "poisson", "relaxation"];
        let other = uniform.into_iter().find_map(|key| Some((key, section.optional(key)?)));
        return other.map_or(Ok(()), |(key, value)| Err(section.both(["graded", key], value.node.span)));
    }
    section.one_of(["shear_ratio", "young"])?;
    section.value("poisson")?;
    heat::consistent(section)
}

impl SubstrateSection {
    /// Material without a name; `None` for a rigid base.
    fn material(&self) -> Option<Result<Material, MaterialError>> {
        let relaxation = relaxed(self.relaxation.as_ref());
        let conducts = heat::conduction([self.conductivity, self.diffusivity, self.expansion]).ok().flatten();
        let material = || Material::from_young(demanded(self.young), demanded(self.poisson));
        (!self.rigid.0).then(|| Ok(material()?.with_relaxation(relaxation).with_conduction(conducts)))
    }

    /// The half-space of these layers on its material.
    fn under(&self, layers: Vec<Layer>, material: Material) -> Result<HalfSpace, MaterialError> {
        let strength = Strength { yielding: self.yield_strength, tensile: self.tensile_strength };
        let durability = durability(self.hardness, self.wear, self.fatigue, self.endurance, self.strain_life)?;
        HalfSpace::new(layers, material).with_substrate_strength(strength)?.with_substrate_durability(durability)
    }
}

impl LayerSection {
    /// Number of its homogeneous sublayers; 1 without `graded`.
    pub fn sublayers(&self) -> usize {
        self.graded.map_or(1, |graded| graded.sublayers)
    }

    fn stiffness_key(&self) -> &'static str {
        match (&self.graded, self.young) {
            (Some(_), _) => "graded",
            (None, Some(_)) => "young",
            (None, None) => "shear_ratio",
        }
    }

    /// Materials from the upper face down, one a sublayer.
    fn materials(&self, substrate: Option<Material>) -> Result<Vec<Material>, MaterialError> {
        if let Some(graded) = self.graded {
            return graded.materials(substrate).collect();
        }
        let poisson = demanded(self.poisson);
        let material = match self.young {
            Some(young) => Material::from_young(young, poisson),
            None => Material::from_shear(demanded(self.shear_ratio) * demanded(substrate).shear(), poisson),
        };
        material.map(|material| vec![material])
    }

    /// The layer, or its sublayers from the upper one down, bonded to each other; the last one has the lower face of
    /// the layer. The material has this `name`.
    fn build(&self, name: Option<&str>, substrate: Option<Material>) -> Result<Vec<Layer>, MaterialError> {
        let materials = self.materials(substrate)?;
        let count = materials.len();
        let layer_strength = Strength { yielding: self.yield_strength, tensile: self.tensile_strength };
        let lower =
            self.interface_strength.as_ref().map_or(InterfaceStrength::default(), InterfaceStrengthSection::strength);
        let durability = durability(self.hardness, self.wear, self.fatigue, self.endurance, self.strain_life)?;
        let fatigue = self.interface_fatigue.map(|section| section.fatigue()).transpose()?;
        let layer = |(index, material): (usize, Material)| {
            let (interface, strength, fatigue) = if index + 1 == count {
                (self.interface.interface(), lower, fatigue)
            } else {
                (Interface::Bonded, InterfaceStrength::default(), None)
            };
            let name = name.map(|name| match count {
                1 => Name::new(name),
                _ => Name::new(&format!("{name}, sublayer {} of {count}", index + 1)),
            });
            let conducts = heat::conduction([self.conductivity, self.diffusivity, self.expansion]).ok().flatten();
            let material = material.with_relaxation(relaxed(self.relaxation.as_ref())).with_conduction(conducts);
            let resistance = if index + 1 == count { self.thermal_resistance } else { 0.0 };
            Layer::new(material.with_name(name), self.thickness / count as f64, interface)?
                .with_residual_stress(self.residual_stress)?
                .with_strengths(layer_strength, strength)?
                .with_durability(durability, fatigue)
                .map(|layer| layer.with_thermal_resistance(resistance).unwrap_or(layer))
        };
        materials.into_iter().enumerate().map(layer).collect()
    }

    /// A layer with twice the sublayers, where it is graded.
    fn refined(&self) -> Self {
        Self { graded: self.graded.map(|graded| graded.of(2 * graded.sublayers)), ..self.clone() }
    }
}

/// The relaxation of a section, which has been checked; `None` of an elastic material.
fn relaxed(section: Option<&RelaxationSection>) -> Option<Relaxation> {
    section.and_then(|section| section.relaxation().ok())
}

/// The body of a case, and the sections of its layers.
pub(super) struct Body<'a> {
    pub(super) layers: Vec<LayerSection>,
    pub(super) substrate: SubstrateSection,
    pub(super) half_space: HalfSpace,
    pub(super) sections: Vec<TableAt<'a>>,
}

/// Reads `[[layers]]` and `[substrate]`.
pub(super) fn read<'a>(root: &TableAt<'a>) -> Result<Body<'a>, Refusal> {
    let sections = root.sections("layers")?;
    let layers: Vec<LayerSection> = sections.iter().map(LayerSection::read_table).collect::<Result<_, _>>()?;
    let substrate_section = root.required_section("substrate")?;
    let substrate = SubstrateSection::read_table(&substrate_section)?;
    build_body(layers, sections, substrate, &substrate_section)
}

/// A body of layers, from its surface inward, on a substrate, each with its section.
pub(super) fn build_body<'a>(
    layers: Vec<LayerSection>,
    sections: Vec<TableAt<'a>>,
    substrate: SubstrateSection,
    substrate_section: &TableAt<'a>,
) -> Result<Body<'a>, Refusal> {
    let half_space = build(&layers, &sections, &substrate, substrate_section)?;
    Ok(Body { layers, substrate, half_space, sections })
}

impl<'a> Body<'a> {
    /// The section of each layer of the half-space.
    pub(super) fn places(&self) -> Vec<&TableAt<'a>> {
        let places = self.layers.iter().zip(&self.sections);
        places.flat_map(|(layer, section)| std::iter::repeat_n(section, layer.sublayers())).collect()
    }
}

/// The half-space of the case, or a refusal at the line of the fault.
fn build(
    layers: &[LayerSection],
    layer_sections: &[TableAt<'_>],
    substrate: &SubstrateSection,
    substrate_section: &TableAt<'_>,
) -> Result<HalfSpace, Refusal> {
    let refuse = |section: &TableAt<'_>, key: &str, error: MaterialError| {
        let span = section.optional(key).map_or(section.span, |value| value.node.span);
        Refusal::new(span, format!("`{}`: {error}", section.path(key)), "this material")
    };
    let base = substrate.material().transpose().map_err(|error| refuse(substrate_section, "young", error))?;
    count(layers, layer_sections)?;
    if base.is_none() {
        layer_sections.iter().try_for_each(|section| without_ratio(section, substrate_section))?;
    }
    let names: Vec<_> = layers.iter().map(|layer| &layer.name).chain([&substrate.name]).map(Option::as_deref).collect();
    let names = distinct(&names);
    let built: Result<Vec<Vec<Layer>>, Refusal> = layers
        .iter()
        .zip(layer_sections)
        .zip(&names)
        .map(|((layer, section), name)| {
            layer.build(name.as_deref(), base).map_err(|error| refuse(section, layer.stiffness_key(), error))
        })
        .collect();
    let Some(base) = base else {
        return HalfSpace::on_rigid_base(built?.concat()).map_err(|error| refuse(substrate_section, "rigid", error));
    };
    let base = base.with_name(names[layers.len()].as_deref().map(Name::new));
    substrate.under(built?.concat(), base).map_err(|error| refuse(substrate_section, "yield_strength", error))
}

/// Refuses a layer on a rigid base whose moduli are stated over those of the substrate.
fn without_ratio(section: &TableAt<'_>, substrate_section: &TableAt<'_>) -> Result<(), Refusal> {
    let graded = section.section("graded")?;
    let ratio = section.optional("shear_ratio").or_else(|| graded?.optional("shear_ratio"));
    let Some(value) = ratio else { return Ok(()) };
    let message =
        format!("`{}` relates to the substrate, and `{}` = true", value.path, substrate_section.path("rigid"));
    Err(Refusal::new(value.node.span, message, "no modulus to relate to").help("give `young` in its place"))
}

/// Refuses more than [`LAYERS`] layers and sublayers, at the layer that exceeds them.
fn count(layers: &[LayerSection], sections: &[TableAt<'_>]) -> Result<(), Refusal> {
    let mut count = 0;
    for (layer, section) in layers.iter().zip(sections) {
        count += layer.sublayers();
        if count > LAYERS {
            let span = section.optional("graded").map_or(section.span, |value| value.node.span);
            let message = format!("`layers` must be at most {LAYERS} layers and sublayers, not {count} up to here");
            return Err(Refusal::new(span, message, "too many").help("give fewer `sublayers`"));
        }
    }
    Ok(())
}

/// The half-space with twice the sublayers in graded layers; `None` without graded layers.
pub(super) fn refined(layers: &[LayerSection], substrate: &SubstrateSection) -> Option<HalfSpace> {
    let base = substrate.material().transpose().ok()?;
    let layers = layers.iter().map(|layer| layer.refined().build(None, base).ok()).collect::<Option<Vec<_>>>()?;
    match base {
        Some(base) => Some(HalfSpace::new(layers.concat(), base)),
        None => HalfSpace::on_rigid_base(layers.concat()).ok(),
    }
}
