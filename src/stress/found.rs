//! What a search for the largest stresses has found, and the errors of it.

use super::constants::SHALLOW;
use super::contender::{CoarserField, Contender, Contenders, NearSurface, stated};
use super::crest::Crest;
use super::field::StressField;
use super::measure::StressMeasure;
use super::peak::Peak;
use crate::body::InterfaceId;

/// Contenders for the maxima, in the order of the maxima.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct ContenderLists {
    pub materials: Vec<Contenders>,
    pub faces: Vec<Contenders>,
    /// Each interface, from 1, with its contenders.
    pub interfaces: Vec<(InterfaceId, Contenders)>,
}

impl ContenderLists {
    fn each(&mut self) -> impl Iterator<Item = &mut (StressMeasure, Contender)> {
        let interfaces = self.interfaces.iter_mut().map(|(_, contenders)| contenders);
        self.materials.iter_mut().chain(&mut self.faces).chain(interfaces).flatten()
    }
}

/// The contenders for the measures that were sought, and what their errors depend on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FoundStresses {
    pub contenders: ContenderLists,
    /// The largest tension on the surface; `None` where contact has no edge or it was not sought.
    pub crest: Option<Crest>,
    /// Samples along the radius of a disc as large as the smallest contact spot.
    pub resolution: f64,
    /// Distance between neighbouring samples, a length.
    pub spacing: f64,
    /// How far stresses on the surface may ring beside jumps of a given pressure, a pressure; zero under a contact.
    pub ringing: f64,
    /// Whether the waves of the pressure are known, so that below the surface the samples leave nothing open.
    pub is_exact_below: bool,
}

impl FoundStresses {
    /// The largest of some contenders by a measure; `None` where it was not sought.
    pub fn stated(&self, contenders: &Contenders, measure: StressMeasure) -> Option<Peak> {
        stated(contenders, measure, SHALLOW * self.spacing)
    }

    /// The largest utilisation of an interface by its contenders; `None` without a strength.
    pub fn delamination(&self, contenders: &Contenders) -> Option<Peak> {
        let measure = contenders.iter().map(|(measure, _)| *measure).find(StressMeasure::is_delamination)?;
        self.stated(contenders, measure)
    }

    /// It with the errors of all contenders, see [`Maxima::with_errors`](super::maxima::Maxima::with_errors); `None` when `goes_on`,
    /// called between contenders, returns false.
    pub fn with_errors(mut self, coarser: &StressField, goes_on: &dyn Fn() -> bool) -> Option<Self> {
        let mut of_crests: Vec<StressMeasure> = Vec::new();
        for (measure, contender) in self.contenders.each() {
            if contender.crest.is_some() && !of_crests.contains(measure) {
                of_crests.push(*measure);
            }
        }
        let coarser = CoarserField::new(coarser, &of_crests);
        let surface =
            NearSurface { depth: SHALLOW * self.spacing, ringing: self.ringing, is_exact_below: self.is_exact_below };
        let resolution = self.resolution;
        let mut known: Vec<(StressMeasure, Contender)> = Vec::new();
        for (measure, contender) in self.contenders.each() {
            // The largest value on a face contends in its material too.
            let same = known.iter().find(|(of, other)| {
                of == measure
                    && (other.peak.position, other.peak.material) == (contender.peak.position, contender.peak.material)
            });
            contender.peak.error = match same {
                Some((_, same)) => same.peak.error,
                None if !goes_on() => return None,
                None => Some(contender.error(*measure, &coarser, resolution, surface)),
            };
            known.push((*measure, *contender));
        }
        Some(self)
    }
}
