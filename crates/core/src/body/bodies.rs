//! Two elastic bodies in contact: under one pressure their displacements add, wave by wave.
//!
//! A counterbody that is elastic has layers and a substrate of its own. Both surfaces bear the same pressure p, and where the
//! counterbody slides the body bears the traction +μp**e** and the counterbody −μp**e**. Each displaces into itself, so that the
//! gap opens by the sum of both displacements,
//!
//! ŵ = [(C₁ + C₂) − iμ cos θ (K₁ − K₂)] p̂,
//!
//! with C and K of the [`SurfaceResponse`](super::SurfaceResponse) of the body (1) and of the counterbody (2), θ between the
//! wavevector and **e**. A rigid counterbody has C₂ = K₂ = 0; like bodies do not couple. At an edge of contact only the materials at
//! the surfaces count: 1/E* = 1/E₁* + 1/E₂*, and Dundurs' β.

use super::{Durability, HalfSpace, Layer, LayeredResponse, Material, MaterialError, Side, SurfaceResponse};
use std::fmt;
use std::sync::Arc;

/// The body, and the counterbody where it is elastic.
#[derive(Debug, Clone, PartialEq)]
pub struct Bodies {
    body: HalfSpace,
    counterbody: Option<HalfSpace>,
    /// Durability of a rigid counterbody.
    rigid: Durability,
}

impl From<HalfSpace> for Bodies {
    /// A body under a rigid counterbody.
    fn from(body: HalfSpace) -> Self {
        Self { body, counterbody: None, rigid: Durability::default() }
    }
}

impl From<&HalfSpace> for Bodies {
    /// A copy of a body under a rigid counterbody.
    fn from(body: &HalfSpace) -> Self {
        body.clone().into()
    }
}

impl From<&Self> for Bodies {
    /// A copy.
    fn from(bodies: &Self) -> Self {
        bodies.clone()
    }
}

impl Bodies {
    /// A body under an elastic counterbody, each from its own surface inward.
    pub fn elastic(body: HalfSpace, counterbody: HalfSpace) -> Self {
        let (body, counterbody) = (body.on_side(Side::Body), Some(counterbody.on_side(Side::Counterbody)));
        Self { body, counterbody, rigid: Durability::default() }
    }

    /// The bodies with hardness and wear of a rigid counterbody; an elastic one has its own.
    ///
    /// # Errors
    /// [`MaterialError`] for a hardness that is not positive, and for a coefficient of wear below zero.
    pub fn with_rigid_durability(self, durability: Durability) -> Result<Self, MaterialError> {
        Ok(Self { rigid: durability.check()?, ..self })
    }

    /// Durability of the surface of one side.
    pub fn surface_durability(&self, side: Side) -> Durability {
        match (side, &self.counterbody) {
            (Side::Body, _) => self.body.surface_durability(),
            (Side::Counterbody, None) => self.rigid,
            (Side::Counterbody, Some(counterbody)) => counterbody.surface_durability(),
        }
    }

    /// Hardness of the softer surface, which no pressure exceeds, and whose it is; `None` where neither has one, and the body where
    /// both are equal.
    pub fn hardness(&self) -> Option<(f64, Side)> {
        let of = |side: Side| self.surface_durability(side).hardness.map(|hardness| (hardness, side));
        match (of(Side::Body), of(Side::Counterbody)) {
            (Some(body), Some(counterbody)) => Some(if counterbody.0 < body.0 { counterbody } else { body }),
            (body, counterbody) => body.or(counterbody),
        }
    }

    /// Coefficient of wear of a surface, one over a pressure; 0 where none is given.
    pub fn wear(&self, side: Side) -> f64 {
        self.surface_durability(side).wear.unwrap_or(0.0)
    }

    /// The bodies without hardness: elastic under any pressure.
    #[must_use]
    pub fn without_hardness(&self) -> Self {
        let (body, counterbody) = (self.body.without_hardness(), self.counterbody.as_ref());
        let counterbody = counterbody.map(HalfSpace::without_hardness);
        Self { body, counterbody, rigid: Durability { hardness: None, ..self.rigid } }
    }

    /// The bodies with another body in the place of the first.
    #[must_use]
    pub fn with_body(&self, body: HalfSpace) -> Self {
        let body = match self.counterbody {
            Some(_) => body.on_side(Side::Body),
            None => body,
        };
        Self { body, ..self.clone() }
    }

    /// Whether a material or an interface has a law of fatigue, a life by strain among them.
    pub fn tire(&self) -> bool {
        self.tire_by_stress() || self.last_by_strain()
    }

    /// Whether a material or an interface has a law of fatigue by its stress.
    pub fn tire_by_stress(&self) -> bool {
        let tires = |body: &HalfSpace| {
            body.durabilities().any(|durability| durability.fatigue.is_some())
                || body.layers().iter().any(|layer| layer.interface_fatigue().is_some())
        };
        self.each().any(tires)
    }

    /// Whether a material has endurance limits.
    pub fn have_endurance(&self) -> bool {
        self.each().flat_map(HalfSpace::durabilities).any(|durability| durability.endurance.is_some())
    }

    /// Whether a material has a life by strain.
    pub fn last_by_strain(&self) -> bool {
        self.each().flat_map(HalfSpace::durabilities).any(|durability| durability.strain_life.is_some())
    }

    /// The body.
    pub fn body(&self) -> &HalfSpace {
        &self.body
    }

    /// The counterbody; `None` where it is rigid.
    pub fn counterbody(&self) -> Option<&HalfSpace> {
        self.counterbody.as_ref()
    }

    /// The body, then the counterbody where it is elastic.
    pub fn each(&self) -> impl Iterator<Item = &HalfSpace> {
        [&self.body].into_iter().chain(&self.counterbody)
    }

    /// The half-space on one side; the body where the side has none.
    pub fn on(&self, side: Option<Side>) -> &HalfSpace {
        self.counterbody.as_ref().filter(|_| side == Some(Side::Counterbody)).unwrap_or(&self.body)
    }

    /// Whether a material of either relaxes.
    pub fn relax(&self) -> bool {
        self.each().any(HalfSpace::relaxes)
    }

    /// Whether neither has layers.
    pub fn is_bare(&self) -> bool {
        self.each().all(|body| body.layers().is_empty())
    }

    /// Compliance C₁ + C₂ = ŵ/p̂ at the wavenumber q > 0 (1/length): a length per pressure.
    pub fn compliance(&self, wavenumber: f64) -> f64 {
        self.each().map(|body| body.response().compliance(wavenumber)).sum()
    }

    /// Layer correction T = ½ E* q (C₁ + C₂) at the wavenumber q > 0 (1/length), with E* of [`Self::contact_modulus`]; 1 for
    /// bodies without layers.
    pub fn correction(&self, wavenumber: f64) -> f64 {
        let correction = self.body.response().correction(wavenumber);
        let Some(counterbody) = &self.counterbody else { return correction };
        let [first, second] = [&self.body, counterbody].map(unit_compliance);
        (first * correction + second * counterbody.response().correction(wavenumber)) / (first + second)
    }

    /// Compliance at the wavenumber q > 0 (1/length) with the given [correction](Self::correction).
    pub(super) fn compliance_of(&self, correction: f64, wavenumber: f64) -> f64 {
        match &self.counterbody {
            None => self.body.response().compliance_of(correction, wavenumber),
            Some(_) => self.surface_compliance() * correction / wavenumber,
        }
    }

    /// Coupling over compliance, (K₁ − K₂)/(C₁ + C₂), at the wavenumber q > 0 (1/length).
    pub fn coupling_ratio(&self, wavenumber: f64) -> f64 {
        let Some(counterbody) = &self.counterbody else { return self.body.response().coupling_ratio(wavenumber) };
        let of =
            |response: &Arc<LayeredResponse>| [response.compliance(wavenumber), response.coupling_ratio(wavenumber)];
        let [[c1, ratio1], [c2, ratio2]] = [self.body.response(), counterbody.response()].map(of);
        (c1 * ratio1 - c2 * ratio2) / (c1 + c2)
    }

    /// Response of both surfaces at the wavenumber q > 0 (1/length): C, L and S are sums, K = K₁ − K₂, since the counterbody is the mirror
    /// image of a body and bears −p and −**q**. The displacement in the plane is that of the body less that of the counterbody.
    pub fn surface(&self, wavenumber: f64) -> SurfaceResponse {
        let body = self.body.response().surface(wavenumber);
        let Some(counterbody) = &self.counterbody else { return body };
        let above = counterbody.response().surface(wavenumber);
        SurfaceResponse {
            normal: body.normal + above.normal,
            coupling: body.coupling - above.coupling,
            along: body.along + above.along,
            across: body.across + above.across,
        }
    }

    /// Compliance times wavenumber of the materials at the surfaces, Σ(1 − ν)/G = 2/E*; one over a pressure.
    pub fn surface_compliance(&self) -> f64 {
        self.each().map(unit_compliance).sum()
    }

    /// Thickness of the thinnest layer at a surface, a length; `None` without layers.
    pub fn thinnest_first_layer(&self) -> Option<f64> {
        self.each().filter_map(|body| body.layers().first()).map(Layer::thickness).reduce(f64::min)
    }

    /// Contact modulus E* of the materials at the surfaces, 1/E* = 1/E₁* + 1/E₂*, a pressure.
    pub fn contact_modulus(&self) -> f64 {
        composite(self.each().map(HalfSpace::surface_material))
    }

    /// Contact modulus E* of the substrates, by which waves longer than all layers are thick displace, a pressure; `None` where no
    /// substrate is elastic.
    pub fn substrate_modulus(&self) -> Option<f64> {
        let elastic: Vec<Material> = self.each().filter_map(|body| body.substrate().material()).collect();
        (!elastic.is_empty()).then(|| composite(elastic.into_iter()))
    }

    /// [Displacement under a uniform pressure](HalfSpace::mean_compliance) of both together, a length per pressure: on a periodic
    /// cell the mean of w is this times p̄. Zero where no body has a rigid base.
    pub fn mean_compliance(&self) -> f64 {
        self.each().map(HalfSpace::mean_compliance).sum()
    }

    /// [Displacement under a uniform shear traction](HalfSpace::mean_shear_compliance) of both together, a length per pressure. Zero where
    /// no body has a rigid base.
    pub fn mean_shear_compliance(&self) -> f64 {
        self.each().map(HalfSpace::mean_shear_compliance).sum()
    }

    /// Whether a body has a rigid base.
    pub fn has_rigid_base(&self) -> bool {
        self.each().any(|body| body.substrate().is_rigid())
    }

    /// Dundurs' β of the materials at the surfaces,
    /// [(1 − 2ν₁)/G₁ − (1 − 2ν₂)/G₂] / (2[(1 − ν₁)/G₁ + (1 − ν₂)/G₂]); (1 − 2ν)/(2(1 − ν)) under a rigid counterbody.
    pub fn dundurs_beta(&self) -> f64 {
        let tangential = |material: Material| (1.0 - 2.0 * material.poisson()) / material.shear();
        let body = self.body.surface_material();
        match &self.counterbody {
            None => (1.0 - 2.0 * body.poisson()) / (2.0 * (1.0 - body.poisson())),
            Some(counterbody) => {
                (tangential(body) - tangential(counterbody.surface_material())) / (2.0 * self.surface_compliance())
            }
        }
    }
}

/// (1 − ν)/G of the material at the surface: compliance times wavenumber of a bare half-space, one over a pressure.
fn unit_compliance(half_space: &HalfSpace) -> f64 {
    let material = half_space.surface_material();
    (1.0 - material.poisson()) / material.shear()
}

/// E* of materials in contact; that of one alone, bit for bit.
fn composite(mut materials: impl Iterator<Item = Material>) -> f64 {
    let first = materials.next().map_or(f64::INFINITY, |material| material.contact_modulus());
    materials.fold(first, |modulus, other| 1.0 / (1.0 / modulus + 1.0 / other.contact_modulus()))
}

impl fmt::Display for Bodies {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.body)?;
        self.counterbody
            .iter()
            .try_for_each(|counterbody| write!(f, "\ncounterbody, from its surface inward:\n{counterbody}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Interface;

    fn material(young: f64, poisson: f64) -> Material {
        Material::from_young(young, poisson).unwrap()
    }

    fn bare(young: f64, poisson: f64) -> HalfSpace {
        HalfSpace::new(vec![], material(young, poisson))
    }

    fn coated(young: f64) -> HalfSpace {
        HalfSpace::new(vec![Layer::new(material(young, 0.2), 0.3, Interface::Bonded).unwrap()], material(1.0, 0.3))
    }

    #[test]
    fn bare_bodies_are_one_on_the_composite_modulus() {
        let bodies = Bodies::elastic(bare(1.0, 0.3), bare(1.4, 0.27));
        let modulus = 1.0 / (0.91 / 1.0 + (1.0 - 0.27 * 0.27) / 1.4);
        assert!((bodies.contact_modulus() / modulus - 1.0).abs() < 1e-15 && bodies.is_bare());
        for q in [1e-3, 0.7, 40.0] {
            assert!((bodies.compliance(q) * modulus * q / 2.0 - 1.0).abs() < 1e-14);
            assert!((bodies.correction(q) - 1.0).abs() < 1e-15);
            assert!((bodies.coupling_ratio(q) - bodies.dundurs_beta()).abs() < 1e-15);
        }
    }

    /// Correction and compliance of two coated bodies are the sum of each; exchanged bodies couple the other way, like ones not.
    #[test]
    fn compliances_add_and_couplings_subtract() {
        let [first, second] = [coated(4.0), coated(0.3)];
        let bodies = Bodies::elastic(first.clone(), second.clone());
        let exchanged = Bodies::elastic(second.clone(), first.clone());
        for q in [1e-2, 1.0, 9.0, 100.0] {
            let sum = first.response().compliance(q) + second.response().compliance(q);
            assert!((bodies.compliance(q) / sum - 1.0).abs() < 1e-15);
            assert!((bodies.compliance_of(bodies.correction(q), q) / sum - 1.0).abs() < 1e-14);
            let coupling = first.response().surface(q).coupling - second.response().surface(q).coupling;
            assert!((bodies.coupling_ratio(q) - coupling / sum).abs() < 1e-14);
            assert!((bodies.coupling_ratio(q) + exchanged.coupling_ratio(q)).abs() < 1e-15);
            assert_eq!(Bodies::elastic(first.clone(), first.clone()).coupling_ratio(q), 0.0);
        }
        assert_eq!(Bodies::elastic(first.clone(), first).dundurs_beta(), 0.0);
    }

    /// A counterbody of 1e6 times the modulus is rigid to 1e-6.
    #[test]
    fn a_stiff_counterbody_is_nearly_rigid() {
        let (rigid, stiff) = (Bodies::from(coated(4.0)), Bodies::elastic(coated(4.0), bare(1e6, 0.3)));
        for q in [1e-2, 1.0, 9.0, 100.0] {
            assert!((stiff.compliance(q) / rigid.compliance(q) - 1.0).abs() < 4e-6);
            assert!((stiff.coupling_ratio(q) - rigid.coupling_ratio(q)).abs() < 4e-6);
        }
        assert!((stiff.dundurs_beta() - rigid.dundurs_beta()).abs() < 4e-6);
    }
}
