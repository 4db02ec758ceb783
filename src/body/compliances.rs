//! Surface compliance at very many wavenumbers: the layer correction T as short series.
//!
//! T varies with ln q on the scale of one, whatever the layers: on a panel, one of the eight equal parts between a power of
//! two and the next, a Chebyshev series of few terms holds it to rounding. What a panel has been seen not to hold is asked of the
//! layers themselves.

use super::TransferFunction;
use crate::numeric::chebyshev::{Chebyshev, inside, place};
use rayon::prelude::*;

/// Terms of a series.
const TERMS: usize = 12;
/// Where a series is held to T, and the relative difference from which on it is not believed.
const PROBES: [f64; 4] = [-0.97, -0.41, 0.37, 0.95];
const BELIEF: f64 = 1e-14;
/// Bits of a number below its exponent and the eighth part.
const BELOW: u32 = 49;

/// Compliances of a half-space within a range of wavenumbers.
#[derive(Debug)]
pub(crate) struct Compliances<'a> {
    transfer: &'a TransferFunction,
    /// Number of the first panel.
    first: u64,
    panels: Vec<Option<Chebyshev<TERMS>>>,
}

impl<'a> Compliances<'a> {
    /// To be asked `times` between the wavenumbers `least` and `most` (1/length); elsewhere it takes longer.
    pub fn new(transfer: &'a TransferFunction, [least, most]: [f64; 2], times: usize) -> Self {
        let (first, end) = (panel(least), panel(most) + 1);
        let count = if transfer.strata.is_empty() { 0 } else { (end - first) as usize };
        // A bare half-space needs no help, and few wavenumbers are not worth it.
        let pays = 2 * count * (TERMS + PROBES.len()) < times;
        let series = |index: usize| {
            let [from, to] = [0, 1].map(|k| f64::from_bits((first + index as u64 + k) << BELOW));
            let correction = |x: f64| transfer.correction(place([from, to], x));
            let series = Chebyshev::of(correction);
            let holds = |&x: &f64| (series.at(x) / correction(x) - 1.0).abs() < BELIEF;
            PROBES.iter().all(holds).then_some(series)
        };
        Self { transfer, first, panels: (0..if pays { count } else { 0 }).into_par_iter().map(series).collect() }
    }

    /// Compliance ŵ/p̂ at the wavenumber q > 0 (1/length): a length per pressure.
    pub fn at(&self, wavenumber: f64) -> f64 {
        let number = panel(wavenumber);
        match self.panels.get(number.wrapping_sub(self.first) as usize) {
            Some(Some(series)) => {
                let ends = [0, 1].map(|k| f64::from_bits((number + k) << BELOW));
                self.transfer.compliance_of(series.at(inside(ends, wavenumber)), wavenumber)
            }
            _ => self.transfer.compliance(wavenumber),
        }
    }
}

/// Number of the panel of a wavenumber: its exponent and eighth part.
fn panel(wavenumber: f64) -> u64 {
    wavenumber.to_bits() >> BELOW
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};

    /// Thin and thick, stiff and soft, incompressible and sliding layers, down to where they are not felt.
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
            let transfer = TransferFunction::new(&HalfSpace::new(stack, material(1.0, 0.3)));
            let compliances = Compliances::new(&transfer, [1e-3, 1e5], usize::MAX);
            let mut worst = 0.0f64;
            for k in 0..20_000 {
                let q = 1e-3 * 1e8f64.powf((f64::from(k) + 0.37) / 20_000.0);
                worst = worst.max((compliances.at(q) / transfer.compliance(q) - 1.0).abs());
            }
            let asked = compliances.panels.iter().filter(|series| series.is_none()).count();
            assert!(worst < 3e-14, "{layers} layers: {worst:e}");
            assert!(10 * asked <= compliances.panels.len(), "{layers} layers: {asked} panels are not held");
            assert_eq!(compliances.at(1e7), transfer.compliance(1e7));
        }
    }
}
