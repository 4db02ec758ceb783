//! Largest stresses of coating and substrate: principal shear stress τ₁, tension σ₁ and von Mises stress in each material and
//! on each of its faces, tension and shear on each interface. With [`StressFields::with_strains`](super::StressFields::with_strains)
//! also the largest strains in each material and on each of its faces.
//!
//! Maxima are searched plane by plane and refined; on the surface itself, where the series converges slowly, the largest
//! values are those of the [`Crest`]s.
//!
//! Each maximum is the largest of several contenders: in a material the values on its faces, near the surface and at each local
//! maximum inside, found from the largest sample of each depth. Each contender has its own error, and the error of the maximum
//! covers those of its rivals.

use super::contender::Contenders;
use super::crest::Crest;
use super::field::StressField;
use super::found::FoundStresses;
use super::measure::{MATERIAL_MEASURES, StressMeasure};
use super::peak::Peak;
use crate::body::InterfaceId;
use crate::quantity::quantities;
use serde::{Deserialize, Serialize};

quantities! {
    /// Largest stresses and strains of a material or a face; strains are `None` where none were asked for.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct Extremes {
        /// Largest principal shear stress τ₁.
        #[serde(rename = "max_tau1")]
        pub tau1: Peak = Pressure "largest shear stress" "τ₁" code "max_tau1" short "τ₁",
        /// Largest principal stress σ₁; negative where all of it is in compression.
        #[serde(rename = "max_tension")]
        pub tension: Peak = Pressure "largest tension" "σ₁" code "max_tension" short "tension",
        /// Largest von Mises stress.
        #[serde(rename = "max_mises")]
        pub mises: Peak = Pressure "largest von Mises" "σᵥ" code "max_mises" short "von Mises",
        /// Largest principal strain ε₁.
        #[serde(rename = "max_strain", default, skip_serializing_if = "Option::is_none")]
        pub strain: Option<Peak> = Strain "largest strain" "ε₁" code "max_strain" short "strain",
        /// Largest normal strain of the horizontal directions; negative where all of them are in compression.
        #[serde(rename = "max_horizontal_strain", default, skip_serializing_if = "Option::is_none")]
        pub horizontal_strain: Option<Peak> = Strain "largest horizontal strain" "ε_h" code "max_horizontal_strain" short "horizontal strain",
        /// Largest compression along z, −ε_zz: positive in compression.
        #[serde(rename = "max_vertical_compression", default, skip_serializing_if = "Option::is_none")]
        pub compression: Option<Peak> = Strain "largest vertical compression" "−ε_zz" code "max_vertical_compression" short "compression",
    }
    table ExtremesQuantities as EXTREMES;
}

quantities! {
    /// Largest stresses that an interface carries.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct Carried {
        /// The interface.
        #[serde(flatten)]
        pub interface: InterfaceId,
        /// Largest σ_zz; negative where all of the interface is in compression.
        #[serde(rename = "max_normal")]
        pub normal: Peak = Pressure "largest tension" "σ" code "max_normal" short "tension",
        /// Largest shear √(σ_xz² + σ_yz²).
        #[serde(rename = "max_shear")]
        pub shear: Peak = Pressure "largest shear" "τ" code "max_shear" short "shear",
        /// Largest utilisation of the interface's strength, dimensionless; `None` without a strength.
        #[serde(skip)]
        pub delamination: Option<Peak>,
    }
    table CarriedQuantities as CARRIED;
}

impl Extremes {
    /// Every peak that there is, in the order of [`EXTREMES`].
    pub fn peaks(&self) -> impl Iterator<Item = Peak> {
        let Self { tau1, tension, mises, strain, horizontal_strain, compression } = *self;
        let strains = [strain, horizontal_strain, compression].into_iter().flatten();
        [tau1, tension, mises].into_iter().chain(strains)
    }

    /// Every peak that there is, to be changed.
    pub(crate) fn peaks_mut(&mut self) -> impl Iterator<Item = &mut Peak> {
        let Self { tau1, tension, mises, strain, horizontal_strain, compression } = self;
        let strains = [strain, horizontal_strain, compression].into_iter().flatten();
        [tau1, tension, mises].into_iter().chain(strains)
    }
}

impl Carried {
    /// Every peak of a stress, in the order of [`CARRIED`].
    pub fn peaks(&self) -> [Peak; 2] {
        let Self { normal, shear, .. } = *self;
        [normal, shear]
    }
}

/// Largest stresses of a stress field.
#[derive(Debug, Clone, PartialEq)]
pub struct Maxima {
    /// Largest stresses of each material, faces included, from the surface down.
    pub materials: Vec<Extremes>,
    /// Largest stresses of each face: the surface, then both sides of each interface.
    pub faces: Vec<Extremes>,
    /// Largest stresses that each interface carries, from the surface down.
    pub interfaces: Vec<Carried>,
    /// The largest tension on the surface with its uncertainty; `None` where contact has no edge.
    pub crest: Option<Crest>,
    /// Samples along the radius of a disc as large as the smallest contact spot.
    pub resolution: f64,
    found: FoundStresses,
}

impl Maxima {
    /// The maxima of what a search for all measures has found.
    pub(super) fn new(found: FoundStresses) -> Self {
        let extremes = |contenders: &Contenders| {
            let [tau1, tension, mises] = MATERIAL_MEASURES
                .map(|measure| found.stated(contenders, measure).expect("each material and each face has one of each"));
            let strain = |is_kind: fn(&StressMeasure) -> bool| found.stated_of(contenders, is_kind);
            Extremes {
                tau1,
                tension,
                mises,
                strain: strain(|measure| matches!(measure, StressMeasure::Strain(_))),
                horizontal_strain: strain(|measure| matches!(measure, StressMeasure::HorizontalStrain(_))),
                compression: strain(|measure| matches!(measure, StressMeasure::Compression(_))),
            }
        };
        let everywhere = found.everywhere();
        let materials = everywhere.materials.iter().map(extremes).collect();
        let faces = everywhere.faces.iter().map(extremes).collect();
        let carried = |(interface, contenders): &(InterfaceId, Contenders)| {
            Some(Carried {
                interface: *interface,
                normal: found.stated(contenders, StressMeasure::Opening)?,
                shear: found.stated(contenders, StressMeasure::Shear)?,
                delamination: found.stated_of(contenders, StressMeasure::is_delamination),
            })
        };
        let interfaces = everywhere.interfaces.iter().filter_map(carried).collect();
        Self { materials, faces, interfaces, crest: found.crest, resolution: found.resolution, found }
    }

    /// Estimated relative error of the largest tension on the surface; without [`Self::with_errors`] from this grid alone; 0 where
    /// contact has no edge.
    pub fn surface_error(&self) -> f64 {
        let surface = self.found.contenders.faces.first().into_iter().flatten();
        let tension = surface
            .filter(|(of, _)| *of == StressMeasure::Tension)
            .find_map(|(_, contender)| Some((contender.crest?, contender.peak.error)));
        tension.map_or(0.0, |(crest, error)| error.map_or_else(|| crest.error(None), |error| error / crest.scale))
    }

    /// The maxima with their estimated errors.
    ///
    /// The error of a contender is 1.6 times the change of its value from the next `coarser` grid, which at second order is
    /// three times the error, plus a part of the size of the stress that n samples along the radius of the smallest spot leave
    /// open: 0.015 n⁻² for τ₁, von Mises and shears, 0.01 n⁻² for the opening stress of an interface, 0.1 n⁻² for a tension and strains, within
    /// two samples of the surface 0.2 n⁻¹. The size of the stress is √(Σσᵢⱼ²) of the stresses of the waves at the position: mean and
    /// residual stresses do not depend on the grid. For a stress on the surface the error is that of its [`Crest`]; beside a jump of a
    /// given pressure the waves of the grid ring, and within two samples of the surface 0.09 of the largest jump is added, less with the depth. Under discs, whose
    /// waves are known, 10⁻⁵ takes the place of the parts that fall with n⁻².
    /// `tests/library/stated_errors.rs` shows that these errors hold.
    ///
    /// The error of a maximum is the largest value plus error of its contenders, less the value: no less than the
    /// value's own error.
    #[must_use]
    pub fn with_errors(self, coarser: &StressField) -> Self {
        self.with_errors_while(coarser, &|| true).expect("a search that nothing interrupts ends")
    }

    /// The maxima with their estimated errors; `None` when `goes_on`, called between contenders, returns false.
    #[must_use]
    pub fn with_errors_while(self, coarser: &StressField, goes_on: &dyn Fn() -> bool) -> Option<Self> {
        self.found.with_errors(coarser, goes_on).map(Self::new)
    }
}
