//! The search for the largest stresses of each material and each face.
//!
//! 1. **Planes** at depths that are denser towards the faces of each material: the largest sample of each is a candidate.
//!    A plane has as many points as the waves that reach its depth need, and is processed row by row.
//! 2. **Faces**: the maximum is searched between the samples of the plane, at constant depth.
//! 3. **Inside** a material each local maximum over the depths, faces included, that comes near the best plane is the start of
//!    a search by the exact sum over the waves ([`super::climb`]). A search that ends on a face belongs to that face.
//!
//! Within two samples of the surface, where the series converges slowly, the largest sample of the pressure's own grid is taken
//! without a search.

use super::constants::{EQUAL_BY_SYMMETRY, MISSED_BY_SAMPLES, RISE_BETWEEN_PLANES};
use super::contender::{Contender, Contenders};
use super::crest::Crest;
use super::field::{REACH, StressField};
use super::found::{ContenderLists, FoundStresses};
use super::maxima::Maxima;
use super::measure::{Sought, StressMeasure};
use super::peak::Peak;
use super::plane_search::{Candidate, PlaneSamples, SEARCH_REACH};
use super::strain::Compliance;
use super::tensor::StressState;
use crate::body::{Depth, Layer};

/// Parameters that the searches in all materials share.
#[derive(Clone, Copy)]
struct Search<'a> {
    /// The smallest and the largest contact radius, lengths.
    radii: [f64; 2],
    sought: Sought,
    /// The largest values on the surface.
    crests: &'a [(StressMeasure, Crest)],
    /// Whether the search goes on, called between planes and between climbs.
    goes_on: &'a dyn Fn() -> bool,
}

/// The largest samples of a plane.
#[derive(Debug)]
struct SearchedPlane {
    samples: PlaneSamples,
    /// Contenders on the plane, where it is a face; none inside a material.
    on_face: Contenders,
}

impl SearchedPlane {
    fn candidate(&self, measure: StressMeasure) -> &Candidate {
        &of_measure(&self.samples.best, measure).expect("every plane was searched for it").1
    }
}

fn of_measure<T>(all: &[(StressMeasure, T)], measure: StressMeasure) -> Option<&(StressMeasure, T)> {
    all.iter().find(|(of, _)| *of == measure)
}

impl StressField {
    /// Maxima over all materials, faces and interfaces. `radii`: the smallest and the largest contact radius (or half the
    /// width of a contact), lengths.
    pub fn maxima(&self, radii: [f64; 2]) -> Maxima {
        self.maxima_while(radii, &|| true).expect("a search that nothing interrupts ends")
    }

    /// Maxima over all materials, faces and interfaces; `None` when `goes_on`, called between planes and between searches,
    /// returns false. `radii` as in [`Self::maxima`].
    pub fn maxima_while(&self, radii: [f64; 2], goes_on: &dyn Fn() -> bool) -> Option<Maxima> {
        let strains = self.strains || Sought::Strengths.strains(self.half_space());
        self.found_everywhere(radii, Sought::All { strains }, goes_on).map(Maxima::new)
    }

    /// The contenders for what is `sought` in the cell or the window, in those materials, and on those interfaces below them, that are `wanted`;
    /// `None` when `goes_on` returns false.
    pub(super) fn found(
        &self,
        radii: [f64; 2],
        sought: Sought,
        wanted: &[[bool; 2]],
        goes_on: &dyn Fn() -> bool,
    ) -> Option<FoundStresses> {
        let compliances = self.half_space().materials().map(Compliance::from);
        let lives = self.half_space().durabilities().map(|durability| durability.strain_life);
        let measures = self.half_space().strengths().zip(lives).zip(compliances);
        let mut measures: Vec<Vec<StressMeasure>> =
            measures.map(|(judged, compliance)| sought.in_material(judged, compliance)).collect();
        measures.iter_mut().for_each(|measures| measures.retain(|measure| self.has(*measure)));
        let of_surface = &measures[0];
        // The jump of a pressure is that of stresses, not of what stands for strains.
        let is_plain = of_surface.is_empty() || self.has_hole() || self.stands_for_strains();
        let crests = if is_plain { Vec::new() } else { self.crests_of(of_surface) };
        let (search, mut contenders) = (Search { radii, sought, crests: &crests, goes_on }, ContenderLists::default());
        for ((material, measures), wanted) in (1..).zip(&measures).zip(wanted) {
            match wanted {
                [false, false] => contenders.add_none(self.half_space(), material),
                [false, true] => {
                    self.add_contenders(material, &[], &search, &mut contenders)?;
                    // The upper face of the layer.
                    contenders.faces.push(Vec::new());
                }
                [true, _] => {
                    let faces = contenders.faces.len() + 1 + usize::from(material <= self.half_space().layers().len());
                    self.add_contenders(material, measures, &search, &mut contenders)?;
                    // Where nothing is sought in the material its faces have no contenders.
                    contenders.faces.resize(faces, Vec::new());
                }
            }
        }
        Some(FoundStresses {
            contenders,
            crest: of_measure(&crests, StressMeasure::Tension).map(|&(_, crest)| crest),
            resolution: self.regions().least_resolution(),
            shallow_depth: self.shallow_depth(),
            ringing: self.regions().ringing(),
            is_exact_below: self.regions().is_exact(),
            ..FoundStresses::default()
        })
    }

    /// Adds the contenders for some `measures` in a material and on its faces, and on the interface below it; `None` when the search
    /// does not go on.
    fn add_contenders(
        &self,
        material: usize,
        measures: &[StressMeasure],
        search: &Search<'_>,
        all: &mut ContenderLists,
    ) -> Option<()> {
        let Search { radii, sought, crests, goes_on } = *search;
        let strength = self.half_space().layers().get(material - 1).map(Layer::interface_strength);
        let mut tractions = strength.map_or(Vec::new(), |strength| sought.on_interface(strength));
        tractions.retain(|measure| self.has(*measure));
        let mut depths = self.search_depths(material, radii);
        if measures.is_empty() {
            // Nothing is sought but on the interface.
            depths = depths.into_iter().next_back().filter(|_| !tractions.is_empty()).into_iter().collect();
        }
        self.read_ahead(depths.iter().map(|&z| Depth { z, material }));
        let plane = |index: usize| {
            let is_interface = index + 1 == depths.len();
            let tractions = tractions.iter().filter(|_| is_interface);
            let wanted: Vec<StressMeasure> = measures.iter().chain(tractions).copied().collect();
            let depth = Depth { z: depths[index], material };
            let is_face = depth.z == self.half_space().faces(material).0 || strength.is_some() && is_interface;
            let crests = if depth == Depth::SURFACE { crests } else { &[] };
            goes_on().then(|| self.search_plane(depth, radii[0], &wanted, is_face, crests))
        };
        let planes: Vec<SearchedPlane> = (0..depths.len()).map(plane).collect::<Option<_>>()?;
        let is_overall = |contender: &&(StressMeasure, Contender)| !contender.0.is_of_interface();
        let mut contenders: Contenders =
            planes.iter().flat_map(|plane| plane.on_face.iter().filter(is_overall)).copied().collect();
        let mut inside: Contenders = Vec::new();
        for &measure in measures {
            let found = self.inside(&planes, &depths, measure, goes_on)?;
            inside.extend(found.into_iter().map(|inside| (measure, inside)));
        }
        // A search from inside that ends on a face, higher than the values along the face, contends on the face too.
        let faces = planes.iter().zip(&depths).filter(|(plane, _)| !plane.on_face.is_empty());
        all.faces.extend(faces.map(|(plane, &depth)| {
            let is_there = |(_, other): &&(StressMeasure, Contender)| {
                depth > 0.0 && (other.peak.position[2] - depth).abs() <= 1e-9 * depth
            };
            let along = plane.on_face.iter().filter(is_overall);
            along.chain(inside.iter().filter(is_there)).copied().collect::<Contenders>()
        }));
        contenders.extend(inside);
        let border = planes.iter().map(|plane| plane.samples.border).fold(0.0, f64::max);
        contenders.iter_mut().for_each(|(_, contender)| *contender = contender.in_window(self.grid().cell(), border));
        all.materials.push(contenders);
        if strength.is_some() {
            let lower = planes.last().map(|plane| plane.on_face.clone()).unwrap_or_default();
            let interface = self.half_space().interface_id(material);
            all.interfaces.push((interface, lower.into_iter().filter(|contender| !is_overall(&contender)).collect()));
        }
        Some(())
    }

    /// The largest samples of a plane, and the contenders on a face; on the surface they are the `crests`.
    fn search_plane(
        &self,
        depth: Depth,
        radius: f64,
        measures: &[StressMeasure],
        is_face: bool,
        crests: &[(StressMeasure, Crest)],
    ) -> SearchedPlane {
        let samples = self.candidates(depth, radius, measures);
        let of = |(measure, candidate): &(StressMeasure, Candidate)| {
            let contender = match of_measure(crests, *measure) {
                Some(&(_, crest)) => self.crest_contender(candidate.depth, crest),
                None => {
                    let (best, state) = self.on_face(candidate, *measure);
                    self.contender(&best, state)
                }
            };
            (*measure, contender.in_window(self.grid().cell(), samples.border))
        };
        let on_face = if is_face { samples.best.iter().map(of).collect() } else { Vec::new() };
        SearchedPlane { samples, on_face }
    }

    /// Contenders inside a material: the largest sample near the surface, and the local maxima below; `None` when `goes_on` returns
    /// false.
    fn inside(
        &self,
        planes: &[SearchedPlane],
        depths: &[f64],
        measure: StressMeasure,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<Vec<Contender>> {
        let near = self.shallow_depth();
        let candidate = |index: usize| planes[index].candidate(measure);
        let shallow = (0..depths.len()).filter(|&i| depths[i] < near && planes[i].on_face.is_empty());
        let shallow = shallow.map(candidate).reduce(|a, b| if b.value > a.value { b } else { a });
        let mut all: Vec<Contender> =
            shallow.into_iter().map(|best| self.contender(best, self.state_at(best))).collect();
        let deep: Vec<usize> = (0..depths.len()).filter(|&i| depths[i] >= near).collect();
        let [Some(&first), Some(&last)] = [deep.first(), deep.last()] else { return Some(all) };
        let value = |index: usize| candidate(index).value;
        let best = deep.iter().map(|&i| value(i)).fold(f64::NEG_INFINITY, f64::max);
        let beside =
            |i: usize| [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter(|j| (first..=last).contains(j));
        let is_near = |i: usize| {
            let drop = beside(i).map(|j| value(i) - value(j)).fold(0.0, f64::max);
            value(i) + RISE_BETWEEN_PLANES * drop + MISSED_BY_SAMPLES * best.abs() >= best
        };
        let is_start = |&i: &usize| {
            // The higher one of neighbouring depths beside the same maximum is the start.
            let is_better = |j: usize| value(j) > value(i) && is_near(j) && self.are_beside(candidate(i), candidate(j));
            is_near(i) && !beside(i).any(is_better)
        };
        let top = depths[0].max(near);
        let bottom =
            if self.half_space().faces(candidate(0).depth.material).1.is_finite() { depths[last] } else { f64::MAX };
        for start in deep.iter().copied().filter(is_start) {
            if !goes_on() {
                return None;
            }
            let rise = 0.5 * beside(start).map(|j| (depths[j] - depths[start]).abs()).fold(0.0, f64::max);
            let (climbed, state) = self.local_maximum(candidate(start), rise, [top, bottom], measure);
            let z = climbed.depth.z;
            let is_on_face = [depths[0], bottom].iter().any(|face| (z - face).abs() <= 1e-9 * z);
            let same = |other: &Contender| {
                let Peak { value, position, .. } = other.peak;
                (climbed.value - value).abs() <= EQUAL_BY_SYMMETRY * value.abs()
                    && (z - position[2]).abs() <= 10.0 * EQUAL_BY_SYMMETRY * z
            };
            let of_face = planes.iter().flat_map(|plane| &plane.on_face).filter(|(of, _)| *of == measure);
            let of_face = of_face.filter(|(_, contender)| (contender.peak.position[2] - z).abs() <= 1e-9 * z);
            let is_known =
                is_on_face && of_face.map(|(_, contender)| contender.peak.value).any(|value| value >= climbed.value);
            if !is_known && !all.iter().any(same) {
                all.push(self.contender(&climbed, state));
            } else if let Some(lower) = all.iter_mut().find(|other| same(other) && other.peak.value < climbed.value) {
                *lower = self.contender(&climbed, state);
            }
        }
        Some(all)
    }

    /// Whether the candidates of two planes lie beside the same local maximum, judged by the distance of their samples.
    fn are_beside(&self, one: &Candidate, other: &Candidate) -> bool {
        let cell = self.series_grid().cell();
        let [s, t] = [one, other].map(|candidate| cell.fractions(candidate.place));
        let [x, y] = cell.reduced().nearest([s[0] - t[0], s[1] - t[1]]);
        x.hypot(y) <= 4.0 * one.step.max(other.step)
    }

    /// Value of a measure on this grid at the position of a contender of a finer grid, whose series converges slowly above the
    /// depth `near`.
    pub(super) fn value_beside(&self, contender: &Contender, measure: StressMeasure, near: f64) -> f64 {
        let Peak { position: [x, y, z], material, .. } = contender.peak;
        let (depth, step) = (Depth { z, material: material.number }, self.spacing());
        if z < near {
            let states = self.stresses_at(&self.depth_response(depth, REACH), &self.samples_around([x, y]));
            return states.iter().map(|state| measure.of(state)).fold(f64::NEG_INFINITY, f64::max);
        }
        let start = Candidate { value: f64::NEG_INFINITY, depth, place: [x, y], step: 0.5 * step };
        self.local_maximum(&start, 0.0, [z, z], measure).0.value
    }

    /// The 4 × 4 samples around a point, lengths.
    fn samples_around(&self, place: [f64; 2]) -> Vec<[f64; 2]> {
        let (cell, points) = (self.series_grid().cell(), self.series_grid().points());
        let [s, t] = cell.fractions(place);
        let [i, j] = [s * points[0] as f64, t * points[1] as f64].map(|k| (k + 1e-9).floor());
        let sample = |k: usize| {
            let [i, j] = [i + (k / 4) as f64 - 1.0, j + (k % 4) as f64 - 1.0];
            cell.point([i / points[0] as f64, j / points[1] as f64])
        };
        (0..16).map(sample).collect()
    }

    /// The maximum on a face near a candidate, and the state there: by the exact sum between the samples, or the sample itself
    /// where the series converges slowly.
    fn on_face(&self, candidate: &Candidate, measure: StressMeasure) -> (Candidate, StressState) {
        let z = candidate.depth.z;
        if z < self.shallow_depth() {
            (*candidate, self.state_at(candidate))
        } else {
            self.local_maximum(candidate, 0.0, [z, z], measure)
        }
    }

    fn state_at(&self, candidate: &Candidate) -> StressState {
        self.stresses_at(&self.depth_response(candidate.depth, SEARCH_REACH), &[candidate.place])[0]
    }

    fn contender(&self, candidate: &Candidate, state: StressState) -> Contender {
        let Candidate { value, depth, place: [x, y], .. } = *candidate;
        let peak = Peak {
            value,
            position: [x, y, depth.z],
            material: self.half_space().material_id(depth.material),
            direction: state.s1_direction(),
            error: None,
            rival: None,
        };
        Contender {
            peak,
            crest: None,
            state,
            size: self.size_of_waves(depth, &state),
            border: 0.0,
            is_on_border: false,
        }
    }

    /// The contender of a crest of the surface.
    fn crest_contender(&self, depth: Depth, crest: Crest) -> Contender {
        let Peak { position: [x, y, _], .. } = crest.peak;
        let state = self.stresses_at(&self.depth_response(depth, SEARCH_REACH), &[[x, y]])[0];
        let size = self.size_of_waves(depth, &state);
        Contender { peak: crest.peak, crest: Some(crest), state, size, border: 0.0, is_on_border: false }
    }

    /// √(Σσᵢⱼ²) of a state without its mean and residual stresses, a pressure.
    pub(super) fn size_of_waves(&self, depth: Depth, state: &StressState) -> f64 {
        let mean = self.mean(depth);
        let waves = StressState {
            xx: state.xx - mean.xx,
            yy: state.yy - mean.yy,
            zz: state.zz - mean.zz,
            xy: state.xy - mean.xy,
            xz: state.xz - mean.xz,
            yz: state.yz - mean.yz,
            ..*state
        };
        waves.size()
    }
}
