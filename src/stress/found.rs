//! What a search for the largest stresses has found, and the errors of it.

use super::contender::{CoarserField, Contender, Contenders, NearSurface, stated};
use super::crest::Crest;
use super::field::StressField;
use super::measure::StressMeasure;
use super::peak::Peak;
use super::tensor::StressState;
use crate::body::{HalfSpace, InterfaceId, Strength};
use crate::lattice::Cell;

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

    /// Adds no contenders for the maxima of a material, of its faces and of the interface below it.
    pub fn add_none(&mut self, half_space: &HalfSpace, material: usize) {
        let is_layer = material <= half_space.layers().len();
        self.materials.push(Vec::new());
        self.faces.extend(vec![Vec::new(); 1 + usize::from(is_layer)]);
        if is_layer {
            self.interfaces.push((half_space.interface_id(material), Vec::new()));
        }
    }

    /// Adds the contenders for the same maxima elsewhere.
    fn extend(&mut self, others: &Self) {
        let pairs = |own: &mut Vec<Contenders>, others: &[Contenders]| {
            own.iter_mut().zip(others).for_each(|(own, other)| own.extend(other));
        };
        pairs(&mut self.materials, &others.materials);
        pairs(&mut self.faces, &others.faces);
        self.interfaces.iter_mut().zip(&others.interfaces).for_each(|((_, own), (_, other))| own.extend(other));
    }
}

/// How far measures are followed beyond the window of an isolated contact. Those by which strengths are judged are followed as far as they can be
/// larger.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Following {
    /// Strengths of the materials, from the surface down.
    pub strengths: Vec<Strength>,
    /// The largest stress that is not followed where it lies deep, a pressure.
    pub most: f64,
    /// Depth below which stresses lie deep, a length.
    pub depth: f64,
    /// The force on the contact.
    pub force: f64,
    pub window: Cell,
}

impl Following {
    /// Whether a strength is judged by a measure at a peak.
    fn is_judged(&self, peak: Peak, measure: StressMeasure) -> bool {
        let strength = self.strengths.get(peak.material.number - 1);
        match measure {
            StressMeasure::Delamination(_) => true,
            StressMeasure::Tension => strength.is_some_and(|own| own.tensile.is_some()),
            StressMeasure::Mises => strength.is_some_and(|own| own.yielding.is_some()),
            StressMeasure::Tau1 | StressMeasure::Opening | StressMeasure::Shear => false,
        }
    }

    /// Whether a measure is not followed: a small one that lies deep.
    fn is_faint(&self, peak: Peak, measure: StressMeasure) -> bool {
        peak.value < self.most && peak.position[2] > self.depth && !self.is_judged(peak, measure)
    }

    /// The error of a peak on the border of the window, P/z² of the force P at its depth z, a pressure: on a bare body twice the largest stress there; `None` of a peak that is
    /// followed, or not on the border.
    fn bound(&self, peak: Peak, measure: StressMeasure) -> Option<f64> {
        let [x, y, z] = peak.position;
        (self.is_faint(peak, measure) && is_on_border(&self.window, [x, y])).then(|| self.force / (z * z))
    }
}

/// Part of a side of a window that counts as its border.
const BORDER: f64 = 0.05;

fn is_on_border(window: &Cell, place: [f64; 2]) -> bool {
    window.fractions(place).iter().any(|s| !(BORDER..=1.0 - BORDER).contains(s))
}

/// The contenders for the measures that were sought, and what their errors depend on.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct FoundStresses {
    pub contenders: ContenderLists,
    /// The largest tension on the surface; `None` where contact has no edge or it was not sought.
    pub crest: Option<Crest>,
    /// Samples along the radius of a disc as large as the smallest contact spot.
    pub resolution: f64,
    /// Depth down to which stresses vary fast from sample to sample, a length.
    pub shallow_depth: f64,
    /// How far stresses on the surface may ring beside jumps of a given pressure, a pressure; zero under a contact.
    pub ringing: f64,
    /// Whether the waves of the pressure are known, so that below the surface the samples leave nothing open.
    pub is_exact_below: bool,
    /// Stress that waves left out may add, over the stresses.
    pub left_out: f64,
    /// The states at rest of each material, which those around an isolated contact approach far away; none of a periodic system.
    pub at_rest: Vec<StressState>,
    /// How far measures are followed beyond the window of an isolated contact; `None` of a periodic system.
    pub following: Option<Following>,
    /// Contenders in the windows around that of an isolated contact, from the inner one outward.
    pub around: Vec<Self>,
}

impl FoundStresses {
    /// The largest of some contenders by a measure; `None` where it was not sought.
    pub fn stated(&self, contenders: &Contenders, measure: StressMeasure) -> Option<Peak> {
        let peak = stated(contenders, measure, self.shallow_depth)?;
        // Far away the measure comes arbitrarily near to that of the body at rest.
        let rest = self
            .rest(peak, measure)
            .max(self.following.as_ref().and_then(|own| own.bound(peak, measure)).unwrap_or(f64::NEG_INFINITY));
        Some(Peak { error: peak.error.map(|error| error.max(rest - peak.value)), ..peak })
    }

    /// A measure of the body at rest, in the material of a peak; minus infinity where no load leaves it so.
    fn rest(&self, peak: Peak, measure: StressMeasure) -> f64 {
        self.at_rest.get(peak.material.number - 1).map_or(f64::NEG_INFINITY, |rest| measure.of(rest))
    }

    /// The largest stress found in any material, a pressure.
    pub fn largest(&self) -> f64 {
        let peaks = self.contenders.materials.iter().flatten().map(|(_, contender)| contender.peak.value);
        peaks.filter(|value| value.is_finite()).fold(0.0, f64::max)
    }

    /// The contenders in the window and around it.
    pub fn everywhere(&self) -> ContenderLists {
        let mut all = self.contenders.clone();
        self.around.iter().for_each(|around| all.extend(&around.contenders));
        all
    }

    /// Of each material, with the interface below it, whether larger values of a measure may lie outside of a window: where the largest one
    /// lies on its border, or is no larger than the measure at rest where layers still bend, `bends`: for measures by which strengths are judged,
    /// and for others.
    pub fn may_be_larger_outside(&self, window: &Cell, bends: [bool; 2]) -> Vec<bool> {
        let everywhere = self.everywhere();
        let is_there = |contenders: &Contenders| {
            contenders.iter().any(|(measure, Contender { peak, .. })| {
                let Some(following) = &self.following else { return false };
                let ([x, y, _], is_judged) = (peak.position, following.is_judged(*peak, *measure));
                let is_largest =
                    || contenders.iter().all(|(of, other)| of != measure || other.peak.value <= peak.value);
                let rises = match peak.value > self.rest(*peak, *measure) {
                    true => is_on_border(window, [x, y]),
                    false => bends[usize::from(!is_judged)],
                };
                rises && !following.is_faint(*peak, *measure) && is_largest()
            })
        };
        let of_interface = |number: usize| everywhere.interfaces.get(number).is_some_and(|(_, own)| is_there(own));
        let materials = everywhere.materials.iter().enumerate();
        materials.map(|(number, contenders)| is_there(contenders) || of_interface(number)).collect()
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
        let beside = CoarserField::new(coarser, &of_crests);
        let surface =
            NearSurface { depth: self.shallow_depth, ringing: self.ringing, is_exact_below: self.is_exact_below };
        let (resolution, left_out) = (self.resolution, self.left_out);
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
                None => {
                    let left_out = measure.rise(&contender.state, left_out * contender.size);
                    Some(contender.error(*measure, &beside, resolution, surface) + left_out)
                }
            };
            known.push((*measure, *contender));
        }
        for (number, around) in (1..).zip(&mut self.around) {
            let Some(coarser) = coarser.around(number) else { break };
            *around = std::mem::take(around).with_errors(&coarser, goes_on)?;
        }
        Some(self)
    }
}
