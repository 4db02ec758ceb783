//! Retardation of layered bodies: the modes of their compliance, wave by wave.
//!
//! The compliance C(k, s) of a wave is rational in s. Its poles lie where the layers can move without a load: at s = −1/θ with θ between
//! the shortest relaxation time τ of a material and the longest τ G(∞)/G(0), since beyond these all moduli are positive. C and ∂C/∂s are
//! computed from the layers at some iω a decade around these times, with [dual numbers](Dual) for moduli, and the [modes](RetardationModes)
//! from them. Waves share nothing but the frequencies: there are any number of materials and terms, and times may cross from one wave to
//! the next.
//!
//! Two elastic bodies have the modes of the sum of their compliances.

use super::modes::RetardationModes;
use super::states::Sample;
use crate::body::{Bodies, HalfSpace, Interface, Layer, LayeredResponse, Material, Moduli};
use crate::numeric::dual::Dual;
use crate::numeric::number::Number;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// Frequencies a decade, and decades of them beyond the shortest and the longest time.
const PER_DECADE: f64 = 4.0;
const BEYOND: f64 = 0.5;
/// Wavenumber times the thickness of the first layer from which on a wave does not reach below it, by e^{−2kh} in double precision.
const BARE: f64 = 20.0;
/// Laplace variable times the shortest time at which no relaxation has begun.
const GLASSY: f64 = 1e20;

/// Bodies at the frequencies at which their compliance is sampled.
#[derive(Debug, Clone)]
pub struct Retardation<'a> {
    bodies: &'a Bodies,
    /// Places s = iω, ascending, each with the responses of the bodies; none where all materials are elastic.
    places: Vec<(Dual, Vec<LayeredResponse<Dual>>)>,
    /// Laplace variable of bodies that have not begun to relax, with their responses.
    glassy: (f64, Vec<LayeredResponse>),
}

impl<'a> Retardation<'a> {
    /// Retardation of bodies whose materials relax.
    pub fn new(bodies: &'a Bodies) -> Self {
        let times = times(bodies);
        let frequencies = times.map_or(Vec::new(), |times| frequencies(times, PER_DECADE, BEYOND));
        let at = |frequency: f64| {
            let place = Dual::variable(Complex64::new(0.0, frequency));
            (place, responses(bodies, place))
        };
        let glassy = times.map_or(0.0, |[shortest, _]| GLASSY / shortest);
        Self { bodies, places: frequencies.into_iter().map(at).collect(), glassy: (glassy, responses(bodies, glassy)) }
    }

    /// Modes of the wavenumber k > 0, one over a length.
    pub fn modes(&self, wavenumber: f64) -> RetardationModes {
        let sampled =
            |(place, responses): &(Dual, Vec<LayeredResponse<Dual>>)| sample(*place, compliance(responses, wavenumber));
        let samples: Vec<Sample> = self.places.iter().map(sampled).collect();
        RetardationModes::through(compliance(&self.glassy.1, wavenumber), &samples)
    }

    /// Modes of many wavenumbers k > 0, each one over a length. Waves that do not reach below the first layers have those of one of them, with
    /// amplitudes as 1/k.
    pub fn modes_of(&self, wavenumbers: &[f64]) -> Vec<RetardationModes> {
        let thinnest = self.bodies.thinnest_first_layer();
        let least = wavenumbers.iter().copied().fold(f64::INFINITY, f64::min);
        let bare = thinnest.map_or(least, |thickness| BARE / thickness);
        let common = wavenumbers.iter().any(|k| *k >= bare).then(|| self.modes(bare));
        let modes = |&wavenumber: &f64| match &common {
            Some(common) if wavenumber >= bare => common.scaled(bare / wavenumber),
            _ => self.modes(wavenumber),
        };
        wavenumbers.par_iter().map(modes).collect()
    }

    /// Modes of a uniform pressure without mean lateral strain: Σ h/M(s) of layers on a rigid base. Zero where all substrates are elastic,
    /// whose infinite mean displacement is left out.
    pub fn mean_modes(&self) -> RetardationModes {
        if !self.bodies.has_rigid_base() {
            return RetardationModes::default();
        }
        let samples: Vec<Sample> = self.places.iter().map(|&(place, _)| sample(place, self.mean(place))).collect();
        RetardationModes::through(self.mean(self.glassy.0), &samples)
    }

    /// Mean compliance at the Laplace variable s.
    fn mean<N: Number>(&self, place: N) -> N {
        self.bodies.each().fold(N::default(), |sum, body| {
            let moduli: Vec<Moduli<N>> = body.materials().map(|material| material.moduli_at(place)).collect();
            sum + mean(body, &moduli)
        })
    }

    /// Largest relative error of modes of the wavenumber k > 0, one over a length, against the layers themselves: at real s and at iω, ten a
    /// decade from three decades before the shortest to three beyond the longest time.
    pub fn misfit(&self, wavenumber: f64, modes: &RetardationModes) -> f64 {
        let places = times(self.bodies).map_or(Vec::new(), |times| frequencies(times, 10.0, 3.0));
        let all = places.into_iter().flat_map(|s| [Complex64::new(s, 0.0), Complex64::new(0.0, s)]);
        let error = |s: Complex64| {
            let exact = compliance(&responses(self.bodies, s), wavenumber);
            (modes.at(s) - exact).norm() / exact.norm()
        };
        all.map(error).fold(0.0, f64::max)
    }
}

/// Shortest and longest retardation time that bodies can have, times: the least τ of a material, and the largest τ times its G(∞)/G(0); `None`
/// where all materials are elastic.
pub fn times(bodies: &Bodies) -> Option<[f64; 2]> {
    let of = |material: Material| {
        let relaxation = material.relaxation()?;
        let ratio = 1.0 + relaxation.instantaneous() / material.shear();
        let times = relaxation.terms().iter().map(|term| [term.time, term.time * ratio]);
        times.reduce(widened)
    };
    bodies.each().flat_map(HalfSpace::materials).filter_map(of).reduce(widened)
}

/// The least interval that holds two.
fn widened([short, long]: [f64; 2], [least, most]: [f64; 2]) -> [f64; 2] {
    [short.min(least), long.max(most)]
}

/// Responses of the bodies at the Laplace variable s, one over a time.
pub(super) fn responses<N: Number>(bodies: &Bodies, s: N) -> Vec<LayeredResponse<N>> {
    bodies.each().map(|body| body.response_at(s)).collect()
}

/// Frequencies between one over the longest and one over the shortest time and some decades beyond, ascending.
fn frequencies([shortest, longest]: [f64; 2], per_decade: f64, beyond: f64) -> Vec<f64> {
    let decades = (longest / shortest).log10() + 2.0 * beyond;
    let count = (decades * per_decade).ceil();
    let frequency = |k: usize| 10f64.powf(decades * k as f64 / count - beyond) / longest;
    (0..=count as usize).map(frequency).collect()
}

fn sample(place: Dual, compliance: Dual) -> Sample {
    Sample { place: place.value, value: compliance.value, slope: compliance.slope }
}

/// Compliance of bodies together.
pub(super) fn compliance<N: Number>(responses: &[LayeredResponse<N>], wavenumber: f64) -> N {
    responses.iter().fold(N::default(), |sum, response| sum + response.compliance(wavenumber))
}

/// [Mean compliance](HalfSpace::mean_compliance) of a body with other moduli of its materials.
fn mean<N: Number>(body: &HalfSpace, moduli: &[Moduli<N>]) -> N {
    if !body.substrate().is_rigid() {
        return N::default();
    }
    let add = |sum: N, (layer, &Moduli { shear, poisson }): (&Layer, &Moduli<N>)| {
        let one = N::from(1.0);
        let compression = (one - poisson * 2.0).over(shear * (one - poisson) * 2.0) * layer.thickness();
        match layer.interface() {
            Interface::Spring { normal, .. } => sum + compression + N::from(normal.recip()),
            Interface::Bonded | Interface::Frictionless => sum + compression,
        }
    };
    body.layers().iter().zip(moduli).fold(N::default(), add)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{SPRING, layer, material, one};
    use super::*;
    use crate::body::ConstantModulus;

    /// Two times of C = (1−ν)/(Gk) = [1/G + 3/(3K+G)]/(2k): of 1/G and of 3/(3K+G); one where ν is constant.
    #[test]
    fn a_homogeneous_half_space_has_its_known_times() {
        for (ratio, nu) in [(1.01, 0.3), (2.0, 0.0), (10.0, 0.3), (1e3, 0.45), (10.0, 0.5)] {
            let (shear, k) = (3.0, 0.7);
            let bare = |constant| Bodies::from(HalfSpace::new(vec![], one(material(shear, nu), ratio, constant)));
            // Retardation times that differ by 1 % only are found to 1e-7, others to rounding.
            let near =
                |found: f64, expected: f64| (found / expected - 1.0).abs() < if ratio < 1.1 { 1e-7 } else { 1e-11 };

            let bodies = bare(ConstantModulus::Poisson);
            let retardation = Retardation::new(&bodies);
            let found = retardation.modes(k);
            let relaxed = (1.0 - nu) / (shear * k);
            assert!(found.modes.len() == 1 && near(found.modes[0].time, ratio), "{ratio}, ν {nu}: {found:?}");
            assert!(
                near(found.modes[0].amplitude, relaxed * (1.0 - 1.0 / ratio)) && near(found.glassy, relaxed / ratio)
            );
            assert!(retardation.misfit(k, &found) < 1e-13);

            let bodies = bare(ConstantModulus::Bulk);
            let retardation = Retardation::new(&bodies);
            let found = retardation.modes(k);
            let bulk = 2.0 * shear * (1.0 + nu) / (1.0 - 2.0 * nu);
            let time = (bulk + ratio * shear) / (bulk + shear);
            let amplitude = 1.5 / k * (1.0 / (bulk + shear) - 1.0 / (bulk + ratio * shear));
            let first = (1.0 / shear - 1.0 / (ratio * shear)) / (2.0 * k);
            assert!(near(found.modes[0].time, ratio) && near(found.modes[0].amplitude, first), "{found:?}");
            if nu == 0.5 {
                assert_eq!(found.modes.len(), 1, "incompressible: {found:?}");
            } else {
                // Rounding is that of the whole compliance, of which a small amplitude has a large part.
                let tolerance = if ratio < 1.1 { 1e-6 } else { 1e-11 * found.at(1.0) / amplitude };
                assert!(
                    (found.modes[1].time / time - 1.0).abs() < tolerance && found.modes.len() == 2,
                    "{found:?}, {time}"
                );
                assert!((found.modes[1].amplitude / amplitude - 1.0).abs() < tolerance, "{found:?}, {amplitude}");
            }
            assert!(retardation.misfit(k, &found) < 1e-12, "{:e}", retardation.misfit(k, &found));
        }
    }

    /// M = K + 4G/3 relaxes by (K + 4G(∞)/3)/(K + 4G(0)/3) to 1; springs and elastic layers add to the glassy compliance.
    #[test]
    fn layers_on_a_rigid_base_creep_under_a_uniform_pressure() {
        let soft = one(material(2.0, 0.3), 10.0, ConstantModulus::Bulk);
        let layers = vec![layer(soft, 0.5, SPRING), layer(material(7.0, 0.2), 0.1, Interface::Bonded)];
        let bodies = Bodies::from(HalfSpace::on_rigid_base(layers).unwrap());
        let found = Retardation::new(&bodies).mean_modes();
        let moduli = [2.0, 20.0].map(|shear| 2.0 * 2.0 * 1.3 / (3.0 * 0.4) + 4.0 * shear / 3.0);
        assert!((found.relaxed() / bodies.mean_compliance() - 1.0).abs() < 1e-13);
        assert!(
            found.modes.len() == 1 && (found.modes[0].time * moduli[0] / moduli[1] - 1.0).abs() < 1e-11,
            "{found:?}"
        );
        assert!((found.modes[0].amplitude / (0.5 / moduli[0] - 0.5 / moduli[1]) - 1.0).abs() < 1e-11);
        let bare = Bodies::from(HalfSpace::new(vec![], soft));
        assert_eq!(Retardation::new(&bare).mean_modes(), RetardationModes::default());
    }

    /// Waves around the wavenumber from which on they do not reach below the layer, and those of a bare body.
    #[test]
    fn many_waves_have_the_modes_of_each() {
        let coat = one(material(5.0, 0.4), 4.0, ConstantModulus::Bulk);
        let below = one(material(1.0, 0.3), 9.0, ConstantModulus::Bulk);
        for layers in [vec![], vec![layer(coat, 0.5, SPRING)]] {
            let bodies = Bodies::from(HalfSpace::new(layers, below));
            let (retardation, wavenumbers) = (Retardation::new(&bodies), [0.3, 7.0, 39.0, 41.0, 300.0]);
            for (found, k) in retardation.modes_of(&wavenumbers).iter().zip(wavenumbers) {
                let exact = retardation.modes(k);
                for s in [0.0, 0.01, 0.2, 1.0, 30.0] {
                    assert!((found.at(s) / exact.at(s) - 1.0).abs() < 1e-12, "{bodies}, k {k}, s {s}");
                }
            }
        }
    }

    /// Waves far shorter than the layer is thick know its material alone, far longer ones the substrate's.
    #[test]
    fn short_and_long_waves_have_the_times_of_one_material() {
        for interface in [Interface::Bonded, Interface::Frictionless, SPRING] {
            let coat = one(material(5.0, 0.4), 4.0, ConstantModulus::Poisson);
            let below = one(material(1.0, 0.3), 9.0, ConstantModulus::Poisson);
            let bodies = Bodies::from(HalfSpace::new(vec![layer(coat, 1.0, interface)], below));
            let retardation = Retardation::new(&bodies);
            let short = retardation.modes(100.0);
            assert!(short.modes.len() == 1 && (short.modes[0].time - 4.0).abs() < 1e-10, "{short:?}");
            let long = retardation.modes(1e-6);
            let greatest = long.modes.iter().max_by(|a, b| a.amplitude.total_cmp(&b.amplitude)).unwrap();
            assert!((greatest.time - 9.0).abs() < 1e-4 && greatest.amplitude > 0.999 * (long.relaxed() - long.glassy));
        }
    }
}
