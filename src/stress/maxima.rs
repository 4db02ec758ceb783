//! Where coating and substrate are stressed most: the largest principal shear stress τ₁, the largest tension σ₁ and the
//! largest stress of von Mises in each material and on each of its faces, and the largest tension and shear that each
//! interface carries.
//!
//! They are searched plane by plane and refined; on the surface itself, where the series converges slowly, the largest
//! values are those of the [`Crest`]s.
//!
//! Each is the largest of several contenders: of a material the values on its faces, near the surface and at each local
//! maximum inside, where each depth has one place: that of its largest sample. All of them have errors of their own, and so the
//! largest value has an error that covers those of its rivals.

use super::constants::SHALLOW;
use super::contender::{CoarserField, Contender, Contenders, stated};
use super::crest::Crest;
use super::field::StressField;
use super::measure::{MATERIAL_MEASURES, StressMeasure};
use super::peak::Peak;

/// Maxima over a material or a face.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Extremes {
    /// Largest principal shear stress τ₁.
    #[cfg_attr(feature = "serde", serde(rename = "max_tau1"))]
    pub tau1: Peak,
    /// Largest principal stress σ₁; negative where nothing is in tension.
    #[cfg_attr(feature = "serde", serde(rename = "max_tension"))]
    pub tension: Peak,
    /// Largest stress of von Mises.
    #[cfg_attr(feature = "serde", serde(rename = "max_mises"))]
    pub mises: Peak,
}

/// What an interface carries at most.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Carried {
    /// The interface, from 1: the lower face of that layer.
    pub interface: usize,
    /// Largest σ_zz; negative where nothing opens it.
    #[cfg_attr(feature = "serde", serde(rename = "max_normal"))]
    pub normal: Peak,
    /// Largest shear √(σ_xz² + σ_yz²).
    #[cfg_attr(feature = "serde", serde(rename = "max_shear"))]
    pub shear: Peak,
    /// Largest part that it bears of what it can, where a strength is given; the value is no pressure but a number.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub delamination: Option<Peak>,
}

/// All maxima of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Maxima {
    /// Over each material, faces included, from the surface down.
    pub materials: Vec<Extremes>,
    /// Over each face: the surface, then both sides of each interface.
    pub faces: Vec<Extremes>,
    /// What each interface carries, from the surface down.
    pub interfaces: Vec<Carried>,
    /// The largest tension on the surface with its uncertainty; `None` where contact has no edge.
    pub crest: Option<Crest>,
    /// What the maxima are the largest of.
    contenders: ContenderLists,
    /// Samples along the radius of a disc as large as the smallest contact spot.
    pub resolution: f64,
    /// Distance between neighbouring samples, a length.
    pub spacing: f64,
}

/// All that contends for the maxima, in their order.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct ContenderLists {
    pub materials: Vec<Contenders>,
    pub faces: Vec<Contenders>,
    /// The interface, from 1, and what contends on it.
    pub interfaces: Vec<(usize, Contenders)>,
}

impl ContenderLists {
    fn each(&mut self) -> impl Iterator<Item = &mut (StressMeasure, Contender)> {
        let interfaces = self.interfaces.iter_mut().map(|(_, contenders)| contenders);
        self.materials.iter_mut().chain(&mut self.faces).chain(interfaces).flatten()
    }
}

impl Maxima {
    pub(super) fn new(contenders: ContenderLists, crest: Option<Crest>, resolution: f64, spacing: f64) -> Self {
        let none =
            Self { materials: vec![], faces: vec![], interfaces: vec![], crest, contenders, resolution, spacing };
        none.stated()
    }

    /// States the maxima of what was found.
    fn stated(mut self) -> Self {
        let apart = SHALLOW * self.spacing;
        let extremes = |contenders: &Contenders| {
            let [tau1, tension, mises] = MATERIAL_MEASURES.map(|measure| {
                stated(contenders, measure, apart).expect("each material and each face has one of each")
            });
            Extremes { tau1, tension, mises }
        };
        self.materials = self.contenders.materials.iter().map(extremes).collect();
        self.faces = self.contenders.faces.iter().map(extremes).collect();
        let carried = |(interface, contenders): &(usize, Contenders)| {
            let strength = contenders.iter().map(|(measure, _)| *measure).find(StressMeasure::is_delamination);
            Some(Carried {
                interface: *interface,
                normal: stated(contenders, StressMeasure::Opening, apart)?,
                shear: stated(contenders, StressMeasure::Shear, apart)?,
                delamination: strength.and_then(|measure| stated(contenders, measure, apart)),
            })
        };
        self.interfaces = self.contenders.interfaces.iter().filter_map(carried).collect();
        self
    }

    /// Estimated relative error of the largest tension on the surface; by this grid alone before errors are known from a
    /// coarser one, 0 where contact has no edge.
    pub fn surface_error(&self) -> f64 {
        let surface = self.contenders.faces.first().into_iter().flatten();
        let own = surface
            .filter(|(of, _)| *of == StressMeasure::Tension)
            .find_map(|(_, own)| Some((own.crest?, own.peak.error)));
        own.map_or(0.0, |(crest, error)| error.map_or_else(|| crest.error(None), |error| error / crest.scale))
    }

    /// The same with the estimated error of each.
    ///
    /// Each contender has its own: 1.6 times the change of this very contender from the next `coarser` grid, which at second
    /// order is three times the error, and what n samples along the radius of the smallest spot leave open of the size of the
    /// stress: 0.015 n⁻² for τ₁, von Mises and shears, 0.01 n⁻² for what opens an interface, 0.1 n⁻² for a tension, within two
    /// samples of the surface 0.2 n⁻¹. The size of the stress is √(Σσᵢⱼ²) of what the waves of the pressure cause at the place:
    /// mean and residual stresses do not depend on the grid. For a stress on the surface the error is what its [`Crest`] says of
    /// itself. That they hold is shown in `tests/library/stated_errors.rs`.
    ///
    /// The error of a maximum is the largest value plus error of all that contend for it, less the value: no less than the
    /// value's own.
    #[must_use]
    pub fn with_errors(self, coarser: &StressField) -> Self {
        self.with_errors_while(coarser, &|| true).expect("a search that nothing interrupts ends")
    }

    /// The same, unless `goes_on`, called between contenders, says no.
    #[must_use]
    pub fn with_errors_while(mut self, coarser: &StressField, goes_on: &dyn Fn() -> bool) -> Option<Self> {
        let (coarser, resolution, near) = (CoarserField::new(coarser), self.resolution, SHALLOW * self.spacing);
        let mut known: Vec<(StressMeasure, Contender)> = Vec::new();
        for (measure, contender) in self.contenders.each() {
            // What wins on a face contends in its material too.
            let same = known.iter().find(|(of, other)| {
                of == measure
                    && (other.peak.position, other.peak.material) == (contender.peak.position, contender.peak.material)
            });
            contender.peak.error = match same {
                Some((_, same)) => same.peak.error,
                None if !goes_on() => return None,
                None => Some(contender.error(*measure, &coarser, resolution, near)),
            };
            known.push((*measure, *contender));
        }
        Some(self.stated())
    }
}
