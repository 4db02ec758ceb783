//! Results of a search for the largest stresses, and their errors.

use super::contender::{CoarserField, Contender, Contenders, NearSurface, stated};
use super::crest::Crest;
use super::field::StressField;
use super::measure::StressMeasure;
use super::peak::Peak;
use super::tensor::StressState;
use crate::body::{HalfSpace, InterfaceId, StrainLife, Strength};

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
    pub fn extend(&mut self, others: &Self) {
        let pairs = |lists: &mut Vec<Contenders>, others: &[Contenders]| {
            lists.iter_mut().zip(others).for_each(|(list, other)| list.extend(other));
        };
        pairs(&mut self.materials, &others.materials);
        pairs(&mut self.faces, &others.faces);
        self.interfaces.iter_mut().zip(&others.interfaces).for_each(|((_, list), (_, other))| list.extend(other));
    }
}

/// Conditions under which measures are followed beyond the window of an isolated contact.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Following {
    /// Strengths of the materials, from the surface down.
    pub strengths: Vec<Strength>,
    /// Lives by strain of the materials, from the surface down.
    pub lives: Vec<Option<StrainLife>>,
    /// The largest stress that is faint, a pressure.
    pub faint: f64,
    /// Depth below which stresses lie deep, a length.
    pub depth: f64,
}

impl Following {
    /// Whether a strength is judged by a measure at a peak.
    fn is_judged(&self, peak: Peak, measure: StressMeasure) -> bool {
        let strength = self.strengths.get(peak.material.number - 1);
        match measure {
            StressMeasure::Delamination(_) => true,
            StressMeasure::Tension => strength.is_some_and(|strength| strength.tensile.is_some()),
            StressMeasure::Mises => strength.is_some_and(|strength| strength.yielding.is_some()),
            StressMeasure::HorizontalStrain(_) | StressMeasure::Compression(_) => {
                let life = self.lives.get(peak.material.number - 1).copied().flatten();
                life.is_some_and(|life| measure.is_of_life(life))
            }
            StressMeasure::Tau1 | StressMeasure::Opening | StressMeasure::Shear | StressMeasure::Strain(_) => false,
        }
    }

    /// Whether a larger value of a measure is looked for outside of the window on whose `border` stresses have the largest size, a pressure,
    /// where it is not faint: from a value that is no larger than that at rest, or lies on the border, unless it is faint and deep and no strength is judged by it.
    fn goes_on(&self, contender: &Contender, measure: StressMeasure, [rest, border]: [f64; 2]) -> bool {
        let Peak { value, position: [_, _, z], .. } = contender.peak;
        let is_followed =
            || value >= self.faint * measure.per_stress() || z <= self.depth || self.is_judged(contender.peak, measure);
        border > self.faint && (value <= rest || contender.is_still_on(border) && is_followed())
    }
}

/// The largest size of stresses on the border of the last window in which a measure was looked for, a pressure.
fn border(contenders: &Contenders, measure: StressMeasure) -> Option<f64> {
    contenders.iter().rev().find(|(of, _)| *of == measure).map(|(_, last)| last.border)
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
    /// Largest ringing of stresses on the surface beside jumps of a given pressure, a pressure; zero under a contact.
    pub ringing: f64,
    /// Whether the waves of the pressure are known, so that below the surface the samples leave nothing open.
    pub is_exact_below: bool,
    /// Stress that waves left out may add, over the stresses.
    pub left_out: f64,
    /// The states at rest of each material, which those around an isolated contact approach far away; none of a periodic system.
    pub at_rest: Vec<StressState>,
    /// Conditions under which measures are followed beyond the window of an isolated contact; `None` of a periodic
    /// system.
    pub following: Option<Following>,
    /// Contenders in the windows around that of an isolated contact, from the inner one outward.
    pub around: Vec<Self>,
}

impl FoundStresses {
    /// The largest of some contenders by a measure; `None` where it was not sought.
    pub fn stated(&self, contenders: &Contenders, measure: StressMeasure) -> Option<Peak> {
        let peak = stated(contenders, measure, self.shallow_depth)?;
        let beyond = self.beyond(contenders, peak, measure).unwrap_or(f64::NEG_INFINITY);
        Some(Peak { error: peak.error.map(|error| error.max(beyond - peak.value)), ..peak })
    }

    /// The largest value that a measure may have beyond the last window in which it was looked for: that of the body at rest under the largest
    /// stresses on the border; `None` in a periodic system, and where a `peak` inside is larger than at rest.
    fn beyond(&self, contenders: &Contenders, peak: Peak, measure: StressMeasure) -> Option<f64> {
        let rest = self.at_rest.get(peak.material.number - 1)?;
        let (at_rest, border) = (measure.of(rest), border(contenders, measure)?);
        let is_at_peak =
            |contender: &Contender| contender.peak.position == peak.position && contender.peak.value == peak.value;
        let is_on_border = || {
            contenders
                .iter()
                .any(|(of, contender)| *of == measure && is_at_peak(contender) && contender.is_still_on(border))
        };
        (peak.value <= at_rest || is_on_border()).then(|| at_rest + measure.rise(rest, border))
    }

    /// The contenders in the window and around it.
    pub fn everywhere(&self) -> ContenderLists {
        let mut all = self.contenders.clone();
        self.around.iter().for_each(|around| all.extend(&around.contenders));
        all
    }

    /// Whether a larger value of a measure is looked for outside of the last window, in each material and on the
    /// interface below it.
    pub fn may_be_larger_outside(&self) -> Vec<[bool; 2]> {
        let (everywhere, Some(following)) = (self.everywhere(), &self.following) else { return Vec::new() };
        let is_there = |contenders: &Contenders| {
            contenders.iter().any(|(measure, contender)| {
                let rest =
                    self.at_rest.get(contender.peak.material.number - 1).map_or(f64::INFINITY, |rest| measure.of(rest));
                let border = border(contenders, *measure).unwrap_or(0.0);
                let is_largest =
                    || contenders.iter().all(|(of, other)| of != measure || other.peak.value <= contender.peak.value);
                following.goes_on(contender, *measure, [rest, border]) && is_largest()
            })
        };
        let of_interface =
            |number: usize| everywhere.interfaces.get(number).is_some_and(|(_, contenders)| is_there(contenders));
        let materials = everywhere.materials.iter().enumerate();
        materials.map(|(number, contenders)| [is_there(contenders), of_interface(number)]).collect()
    }

    /// The largest of some contenders by the measure of a kind, which has the strength or the compliance of their place; `None` where it
    /// was not sought.
    pub fn stated_of(&self, contenders: &Contenders, is_kind: fn(&StressMeasure) -> bool) -> Option<Peak> {
        let measure = contenders.iter().map(|(measure, _)| *measure).find(is_kind)?;
        self.stated(contenders, measure)
    }

    /// The results with the errors of all contenders, see [`Maxima::with_errors`](super::maxima::Maxima::with_errors);
    /// `None` when `goes_on`, called between contenders, returns false.
    pub fn with_errors(mut self, coarser: &StressField, goes_on: &dyn Fn() -> bool) -> Option<Self> {
        let mut of_crests: Vec<StressMeasure> = Vec::new();
        for (measure, contender) in self.contenders.each() {
            if contender.crest.is_some() && !of_crests.contains(measure) {
                of_crests.push(*measure);
            }
        }
        let beside = CoarserField::new(coarser, &of_crests);
        let has_strains = self.contenders.each().any(|(measure, _)| !coarser.has(*measure));
        let hookean = has_strains.then(|| coarser.hookean()).flatten();
        let beside_strains = hookean.as_ref().map(|field| CoarserField::new(field, &[]));
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
                    let beside = beside_strains.as_ref().filter(|_| !coarser.has(*measure)).unwrap_or(&beside);
                    Some(contender.error(*measure, beside, resolution, surface) + left_out)
                }
            };
            known.push((*measure, *contender));
        }
        for (number, around) in (1..).zip(&mut self.around) {
            let Some(coarser) = coarser.around(number) else { break };
            *around = std::mem::take(around).with_errors(coarser, goes_on)?;
        }
        Some(self)
    }
}
