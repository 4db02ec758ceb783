//! Compliance of the surfaces at very many wavenumbers: the layer correction T, and the coupling over the compliance, as short
//! series.
//!
//! T varies with ln q on the scale of one, whatever the layers: on a panel, one of the eight equal parts between a power of
//! two and the next, a Chebyshev series of few terms holds it to rounding. Outside the panels whose
//! series is accurate the compliance is computed from the layers directly.

use super::{Bodies, SurfaceResponse};
use crate::numeric::chebyshev::{Chebyshev, inside, place};
use crate::numeric::parallel;

/// Terms of a series.
const TERMS: usize = 12;
/// Places in a panel, from −1 to 1, at which its series is compared with the function.
const PROBES: [f64; 4] = [-0.97, -0.41, 0.37, 0.95];
/// Largest relative error of an accepted series at the probes.
const SERIES_TOLERANCE: f64 = 1e-14;
/// Bits of a wavenumber below its exponent and the three bits that number the eighth of an octave.
const PANEL_SHIFT: u32 = 49;

/// Compliances of one body or of two in contact within a range of wavenumbers.
#[derive(Debug)]
pub(crate) struct Compliances<'a> {
    bodies: &'a Bodies,
    corrections: Panels,
    ratios: Panels,
}

/// Series of a function of the wavenumber, on the panels where one is accurate.
#[derive(Debug, Default)]
struct Panels {
    /// Number of the first panel.
    first: u64,
    series: Vec<Option<Chebyshev<TERMS>>>,
}

impl Panels {
    /// Series of a function that is to be evaluated `times` between two wavenumbers, as far as that is less work; errors are
    /// relative to the function or, where that is smaller, to `scale`.
    fn new([least, most]: [f64; 2], times: usize, scale: f64, function: impl Fn(f64) -> f64 + Sync) -> Self {
        let (first, end) = (panel(least), panel(most) + 1);
        let count = (end - first) as usize;
        let series = |index: usize| {
            let ends = [0, 1].map(|k| f64::from_bits((first + index as u64 + k) << PANEL_SHIFT));
            let within = |x: f64| function(place(ends, x));
            let series = Chebyshev::of(within);
            let is_accurate = |&x: &f64| {
                let value = within(x);
                (series.at(x) - value).abs() < SERIES_TOLERANCE * value.abs().max(scale)
            };
            PROBES.iter().all(is_accurate).then_some(series)
        };
        // Few wavenumbers are not worth it.
        let pays = 2 * count * (TERMS + PROBES.len()) < times;
        Self { first, series: parallel::map(if pays { count } else { 0 }, series) }
    }

    fn at(&self, wavenumber: f64) -> Option<f64> {
        let number = panel(wavenumber);
        let series = self.series.get(number.wrapping_sub(self.first) as usize)?.as_ref()?;
        Some(series.at(inside([0, 1].map(|k| f64::from_bits((number + k) << PANEL_SHIFT)), wavenumber)))
    }
}

impl<'a> Compliances<'a> {
    /// Compliances to be evaluated `times` between the wavenumbers `least` and `most` (1/length); others take longer.
    pub fn new(bodies: &'a Bodies, [least, most]: [f64; 2], times: usize) -> Self {
        // Bare half-spaces need no help.
        let times = if bodies.is_bare() { 0 } else { times };
        let corrections = Panels::new([least, most], times, 0.0, |q| bodies.correction(q));
        Self { bodies, corrections, ratios: Panels::default() }
    }

    /// Compliances with series of the [coupling ratio](Self::coupling_ratio) too.
    pub fn coupled(bodies: &'a Bodies, [least, most]: [f64; 2], times: usize) -> Self {
        let uncoupled = Self::new(bodies, [least, most], times);
        let times = if bodies.is_bare() { 0 } else { times };
        Self { ratios: Panels::new([least, most], times, 1.0, |q| bodies.coupling_ratio(q)), ..uncoupled }
    }

    /// Displacement under a uniform pressure, a length per pressure: 0 where displacements have zero mean.
    pub fn mean(&self) -> f64 {
        self.bodies.mean_compliance()
    }

    /// Compliance ŵ/p̂ at the wavenumber q > 0 (1/length): a length per pressure.
    pub fn at(&self, wavenumber: f64) -> f64 {
        match self.corrections.at(wavenumber) {
            Some(correction) => self.bodies.compliance_of(correction, wavenumber),
            None => self.bodies.compliance(wavenumber),
        }
    }

    /// Replaces wavenumbers > 0 (1/length) by their compliances (lengths per pressure).
    pub fn replace(&self, wavenumbers: &mut [f64]) {
        if self.bodies.is_bare() {
            let bare = self.bodies.compliance(1.0);
            wavenumbers.iter_mut().for_each(|q| *q = bare / *q);
        } else {
            wavenumbers.iter_mut().for_each(|q| *q = self.at(*q));
        }
    }

    /// [Coupling over compliance](Bodies::coupling_ratio) at the wavenumber q > 0 (1/length).
    pub fn coupling_ratio(&self, wavenumber: f64) -> f64 {
        self.ratios.at(wavenumber).unwrap_or_else(|| self.bodies.coupling_ratio(wavenumber))
    }
}

/// Compliances of the surfaces of one body or of two in contact under shear tractions, within a range of wavenumbers.
#[derive(Debug)]
pub(crate) struct ShearCompliances<'a> {
    bodies: &'a Bodies,
    /// kL and kS.
    along: Panels,
    across: Panels,
}

impl<'a> ShearCompliances<'a> {
    /// Compliances to be evaluated `times` between the wavenumbers `least` and `most` (1/length); others take longer.
    pub fn new(bodies: &'a Bodies, [least, most]: [f64; 2], times: usize) -> Self {
        let times = if bodies.is_bare() { 0 } else { times };
        let panels =
            |of: fn(SurfaceResponse) -> f64| Panels::new([least, most], times, 0.0, |k| k * of(bodies.surface(k)));
        Self { bodies, along: panels(|response| response.along), across: panels(|response| response.across) }
    }

    /// Compliances L along the wavevector and S across it at the wavenumber k > 0 (1/length): lengths per pressure.
    pub fn at(&self, wavenumber: f64) -> [f64; 2] {
        match (self.along.at(wavenumber), self.across.at(wavenumber)) {
            (Some(along), Some(across)) => [along / wavenumber, across / wavenumber],
            _ => {
                let response = self.bodies.surface(wavenumber);
                [response.along, response.across]
            }
        }
    }

    /// Displacement under a uniform shear traction, a length per pressure: 0 where displacements have zero mean.
    pub fn mean(&self) -> f64 {
        self.bodies.mean_shear_compliance()
    }
}

/// Number of the panel of a wavenumber: its exponent and eighth part.
fn panel(wavenumber: f64) -> u64 {
    wavenumber.to_bits() >> PANEL_SHIFT
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};

    /// Thin and thick, stiff and soft, incompressible and sliding layers, down to wavelengths that do not reach them.
    #[test]
    fn series_are_the_compliance() {
        let material = |shear, poisson| Material::from_shear(shear, poisson).unwrap();
        let layer = |shear, poisson, h, interface| Layer::new(material(shear, poisson), h, interface).unwrap();
        let spring = Interface::Spring { tangential: 0.3, normal: 40.0 };
        let stacks = [
            vec![],
            vec![layer(1e6, 0.3, 1e-3, Interface::Bonded)],
            vec![layer(1e-6, 0.5, 0.1, Interface::Bonded)],
            vec![layer(50.0, 0.0, 1.0, Interface::Frictionless), layer(0.02, 0.5, 0.01, spring)],
            (1..=20).map(|k| layer(f64::from(k * k % 7) + 0.1, 0.02 * f64::from(k), 0.05, Interface::Bonded)).collect(),
        ];
        for stack in stacks {
            let layers = stack.len();
            let half_space = HalfSpace::new(stack, material(1.0, 0.3));
            let bodies = Bodies::from(half_space);
            let compliances = Compliances::coupled(&bodies, [1e-3, 1e5], usize::MAX);
            let (mut worst, mut worst_ratio) = (0.0f64, 0.0f64);
            for k in 0..20_000 {
                let q = 1e-3 * 1e8f64.powf((f64::from(k) + 0.37) / 20_000.0);
                let mut replaced = [q];
                compliances.replace(&mut replaced);
                for compliance in [compliances.at(q), replaced[0]] {
                    worst = worst.max((compliance / bodies.compliance(q) - 1.0).abs());
                }
                let ratio = bodies.coupling_ratio(q);
                worst_ratio = worst_ratio.max((compliances.coupling_ratio(q) - ratio).abs() / ratio.abs().max(1.0));
            }
            assert!(worst < 3e-14 && worst_ratio < 3e-14, "{layers} layers: {worst:e}, {worst_ratio:e}");
            for series in [&compliances.corrections.series, &compliances.ratios.series] {
                let rejected = series.iter().filter(|series| series.is_none()).count();
                assert!(10 * rejected <= series.len(), "{layers} layers: {rejected} panels without series");
            }
            assert_eq!(compliances.at(1e7), bodies.compliance(1e7));
        }
    }
}
