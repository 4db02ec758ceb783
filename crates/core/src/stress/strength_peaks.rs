//! The largest stresses by which the strengths of a body are judged, without those that no strength limits.

use super::contender::Contenders;
use super::field::StressField;
use super::found::FoundStresses;
use super::measure::{Sought, StressMeasure};
use super::peak::Peak;

/// Largest stresses of a body by which its strengths are judged; `None` where it has none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StrengthPeaks {
    /// σ₁ in each material with a tensile strength, from the surface down.
    pub tension: Vec<Option<Peak>>,
    /// Von Mises in each material with a yield strength, from the surface down.
    pub mises: Vec<Option<Peak>>,
    /// The strain that counts in each material with a life by strain, from the surface down.
    pub strain: Vec<Option<Peak>>,
    /// Utilisation of each interface with a strength, from the surface down.
    pub delamination: Vec<Option<Peak>>,
}

impl StrengthPeaks {
    fn new(found: &FoundStresses) -> Self {
        let contenders = found.everywhere();
        let of = |measure: StressMeasure| {
            let stated = |contenders: &Contenders| found.stated(contenders, measure);
            contenders.materials.iter().map(stated).collect()
        };
        let [tension, mises] = [StressMeasure::Tension, StressMeasure::Mises].map(of);
        let materials = contenders.materials.iter();
        let strain = materials.map(|all| found.stated_of(all, StressMeasure::is_counted_strain)).collect();
        let interfaces = contenders.interfaces.iter();
        let delamination =
            interfaces.map(|(_, contenders)| found.stated_of(contenders, StressMeasure::is_delamination)).collect();
        Self { tension, mises, strain, delamination }
    }

    /// Every peak.
    pub fn each(&mut self) -> impl Iterator<Item = &mut Peak> {
        let Self { tension, mises, strain, delamination } = self;
        tension.iter_mut().chain(mises).chain(strain).chain(delamination).flatten()
    }
}

impl StressField {
    /// The largest stresses by which strengths are judged, those of [`Self::maxima`], with errors by the `coarser` field; `None` when
    /// `goes_on`, called many times, returns false. `radii` as in [`Self::maxima`].
    pub(crate) fn strength_peaks_while(
        &self,
        radii: [f64; 2],
        coarser: Option<&Self>,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<StrengthPeaks> {
        let found = self.found_everywhere(radii, Sought::Strengths, goes_on)?;
        let found = match coarser {
            Some(coarser) => found.with_errors(coarser, goes_on)?,
            None => found,
        };
        Some(StrengthPeaks::new(&found))
    }
}
