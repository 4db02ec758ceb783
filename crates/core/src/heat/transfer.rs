//! Conduction of heat into a layered body, wave by wave.
//!
//! A flux q̂e^{ik·x} into the surface, steady in the frame of its source, warms the surface by T̂ = q̂/Z. In each material
//! T″ = s²T with s of [`ThermalRate`], and the flux is −λT′. Going up from the substrate, Z = λs at its surface; across an interface of the
//! thermal resistance R, where the flux is continuous and the temperature falls by Rq, and through a layer of the thickness h
//!
//! 1/Z ← 1/Z + R,  Z ← λs (Z + λs t)/(λs + Z t),  t = tanh sh
//!
//! (with the reflection ρ = (λs − Z)/(λs + Z): λs(1 − ρe^{−2sh})/(1 + ρe^{−2sh})). T and q are carried as a pair, so that a base at given
//! temperature (1/Z = 0) and one that insulates (Z = 0) are no exceptions. Re s > 0 keeps arg Z in the quadrant of arg s², where sums do not
//! cancel: neither thin nor thick layers lose digits. Going down, the flux that comes through scales each pair.
//!
//! The wave **k** = 0 is left out: the steady mean temperature of a half-space is infinite. Temperatures have zero mean over a period, and
//! bulk temperatures are given. A rigid base is held at the bulk temperature, and there too the mean is left out.
//!
//! Source of the recursion: composite walls under periodic temperatures, H. S. Carslaw & J. C. Jaeger, *Conduction of Heat in Solids*,
//! 2nd ed. (1959), chapter III.

use super::HeatedBody;
use super::conducting_material::ConductingMaterial;
use super::exponentials::{decay, tanh};
use super::temperature_wave::TemperatureWave;
use super::thermal_rate::ThermalRate;
use crate::body::Conduction;
use crate::numeric::number::Number;
use rustfft::num_complex::Complex64;

/// Temperature and flux over λs of a material at one height, up to a common factor.
type Pair = [Complex64; 2];

impl HeatedBody {
    /// Temperature of the surface over the flux into it, 1/Z, at the wavevector **k** ≠ 0 (1/length): a temperature per power and area.
    pub fn surface_temperature(&self, wavevector: [f64; 2]) -> Complex64 {
        let ([temperature, flux], unit) = self.surface_pair(wavevector, |_, _| ());
        temperature.over(flux * unit)
    }

    /// Temperature at all depths under a flux of the wavevector **k** ≠ 0 (1/length).
    pub fn temperature_wave(&self, wavevector: [f64; 2]) -> TemperatureWave {
        let count = self.conductions().len();
        let mut lower = Vec::with_capacity(count);
        self.surface_pair(wavevector, |rate, pair| lower.push((rate, pair)));
        let thicknesses = self.half_space().layers().iter().map(|layer| layer.thickness()).chain([f64::INFINITY]);
        let (mut flux, mut top) = (Complex64::from(1.0), 0.0);
        let material = |((conduction, (rate, pair)), thickness): ((&Conduction, (ThermalRate, Pair)), f64)| {
            let conductivity = conduction.conductivity();
            let arriving = raised(pair, rate, thickness)[1] * rate.rate * conductivity;
            let scale = flux.over(arriving);
            let once = decay(rate.rate * thickness);
            let shading = (once * 2.0).over(once * once + 1.0);
            flux = pair[1] * scale * rate.rate * conductivity * shading;
            let faces = [top, top + thickness];
            top += thickness;
            ConductingMaterial { rate, conductivity, faces, thickness, lower: pair.map(|part| part * scale) }
        };
        let materials = self.conductions().iter().zip(lower.into_iter().rev()).zip(thicknesses).map(material).collect();
        TemperatureWave::of(materials)
    }

    /// Pair at the surface, and λs there. Calls `lower` with the rate and the pair of the substrate at its upper face, then of each layer at
    /// its lower face, from the substrate up.
    fn surface_pair(&self, wavevector: [f64; 2], mut lower: impl FnMut(ThermalRate, Pair)) -> (Pair, Complex64) {
        let rate_in = |conduction: &Conduction| ThermalRate::new(wavevector, self.velocity(), conduction);
        let (layers, one) = (self.half_space().layers(), Complex64::from(1.0));
        // A rigid base takes any flux at its temperature.
        let (mut pair, mut unit) = ([Complex64::default(), one], one);
        if let Some(substrate) = self.conductions().get(layers.len()) {
            let rate = rate_in(substrate);
            (pair, unit) = ([one; 2], rate.rate * substrate.conductivity());
            lower(rate, pair);
        }
        for ((layer, resistance), conduction) in layers.iter().zip(self.resistances()).zip(self.conductions()).rev() {
            let (rate, flux) = (rate_in(conduction), pair[1] * unit);
            unit = rate.rate * conduction.conductivity();
            pair = warmed([pair[0], flux], *resistance, unit);
            lower(rate, pair);
            pair = raised(pair, rate, layer.thickness());
        }
        (pair, unit)
    }
}

/// Pair above an interface from the temperature and the flux below it, `unit` = λs above, by numbers of order one.
fn warmed([temperature, flux]: [Complex64; 2], resistance: f64, unit: Complex64) -> Pair {
    let drop = flux * resistance;
    if !drop.is_finite() {
        return [Complex64::from(1.0), Complex64::default()];
    }
    let pair = [temperature + drop, flux.over(unit)];
    let scale = pair[0].size().max(pair[1].size());
    pair.map(|part| part / scale)
}

/// Pair at the upper face of a layer, over cosh sh; in a substrate the pair itself.
fn raised(pair: Pair, rate: ThermalRate, thickness: f64) -> Pair {
    if thickness.is_infinite() {
        return pair;
    }
    let ([a, b], t) = (pair, tanh(rate.rate * thickness));
    [a + b * t, b + a * t]
}

#[cfg(test)]
mod tests {
    use super::super::twin::collocation::Collocation;
    use super::super::twin::stacks::{cases, error};
    use super::*;
    use crate::body::{Depth, HalfSpace, Interface, Layer, Material};
    use crate::numeric::quadrature::gauss;

    /// Rounding of a few dozen operations without cancellation.
    const ROUNDING: f64 = 1e-14;

    fn conduction(conductivity: f64, diffusivity: f64) -> Conduction {
        Conduction::new(conductivity, diffusivity, 1.0).unwrap()
    }

    /// Layers of given thicknesses, on a substrate where there is one more conduction than layers.
    fn body(thicknesses: &[f64], conductions: &[Conduction], resistances: &[f64], velocity: f64) -> HeatedBody {
        let material = Material::from_young(1.0, 0.3).unwrap();
        let layers = thicknesses.iter().map(|&h| Layer::new(material, h, Interface::Bonded).unwrap()).collect();
        let half_space = if conductions.len() > thicknesses.len() {
            HalfSpace::new(layers, material)
        } else {
            HalfSpace::on_rigid_base(layers).unwrap()
        };
        HeatedBody::new(half_space, conductions.to_vec(), resistances.to_vec(), velocity).unwrap()
    }

    fn at(wave: &TemperatureWave, material: usize, z: f64) -> Complex64 {
        wave.at(Depth { z, material })
    }

    fn s(k: [f64; 2], velocity: f64, diffusivity: f64) -> Complex64 {
        Complex64::new(k[0] * k[0] + k[1] * k[1], -k[0] * velocity / diffusivity).sqrt()
    }

    /// e^{−sz}/(λs), whatever of it is called a layer, and layers from 10⁻⁸ to 10³ over k.
    #[test]
    fn a_layer_of_the_substrate_s_own_material_changes_nothing() {
        let mut worst = 0.0f64;
        let same = conduction(2.0, 0.7);
        for (k, velocity) in [([0.3, 0.4], 0.0), ([0.3, 0.4], 5.0), ([-0.5, 0.0], 3e4), ([0.0, 0.5], 9.0)] {
            let s = s(k, velocity, 0.7);
            for h in [2e-8, 1e-3, 0.7, 3.0, 60.0, 2e3] {
                let whole = body(&[h, 2.0 * h], &[same; 3], &[0.0; 2], velocity);
                let wave = whole.temperature_wave(k);
                assert!((wave.surface() - whole.surface_temperature(k)).norm() < ROUNDING * wave.surface().norm());
                for (material, z) in
                    [(1, 0.0), (1, 0.3 * h), (1, h), (2, h), (2, 2.0 * h), (2, 3.0 * h), (3, 3.0 * h), (3, 4.0 * h)]
                {
                    // A relative error ε of the depth changes e^{−sz} by |s|zε.
                    let closed = (-s * z).exp() / (2.0 * s);
                    let bound = ROUNDING * closed.norm() * (1.0 + s.norm() * z) + 1e-300;
                    let found = (at(&wave, material, z) - closed).norm();
                    worst = worst.max(found / bound * ROUNDING);
                    assert!(found < bound, "k {k:?}, v {velocity}, h {h}, z {z}: {found:e}");
                }
            }
        }
    }

    /// 1/Z = coth(sh)/(λs) of a layer that nothing leaves, tanh(sh)/(λs) of one on a base at the bulk temperature.
    #[test]
    fn resistances_insulate() {
        let (upper, lower) = (conduction(2.0, 0.7), conduction(5.0, 3.0));
        let mut worst = 0.0f64;
        for (k, velocity) in [([0.3, 0.4], 0.0), ([0.3, -0.4], 5.0), ([0.4, 0.3], 1e5)] {
            let s = s(k, velocity, 0.7);
            for h in [1e-8, 1e-4, 0.3, 4.0, 900.0] {
                // tanh x is 1 beyond x = 20 and x − x³/3 below 10⁻⁶, in double precision.
                let x = s * h;
                let tanh = if x.re > 20.0 {
                    1.0.into()
                } else if x.norm() < 1e-6 {
                    x
                } else {
                    x.tanh()
                };
                let found = |conductions: &[Conduction], resistance: f64| {
                    body(&[h], conductions, &[resistance], velocity).surface_temperature(k) * 2.0 * s
                };
                let insulated = [&[upper, lower][..], &[upper]].map(|of| found(of, f64::INFINITY) * tanh - 1.0);
                let held = found(&[upper], 0.0) / tanh - 1.0;
                worst = insulated.iter().chain([&held]).fold(worst, |worst, error| worst.max(error.norm()));
                // An interface of the resistance R lets 1/(R Z) of the heat pass.
                for resistance in [1e12, 1e15, 1e305] {
                    let resisting = found(&[upper, lower], resistance) * tanh - 1.0;
                    let passes = 1.0 / (resistance * 2.0 * (s * tanh).norm());
                    assert!(resisting.norm() < 1.01 * passes + ROUNDING, "h {h}, R {resistance:e}: {resisting}");
                }
            }
        }
        assert!(worst < ROUNDING);
    }

    /// A thin layer takes up λ₁s₁²h of the flux, Z = λ₂s₂ + λ₁s₁²h, and resists by h/λ₁: both to the first order in h.
    #[test]
    fn thin_layers_are_resistances_and_stores() {
        let (upper, lower) = (conduction(0.02, 0.7), conduction(5.0, 3.0));
        for (k, velocity) in [([0.3, 0.4], 0.0), ([0.3, -0.4], 5.0)] {
            let ([s1, s2], q) = ([0.7, 3.0].map(|diffusivity| s(k, velocity, diffusivity)), 5.0);
            let z = s2 * q;
            let deviation = |h: f64| {
                let found = body(&[h], &[upper, lower], &[0.0], velocity).surface_temperature(k);
                found * z - 1.0 - (z / 0.02 - s1 * s1 * 0.02 / z) * h
            };
            let (one, half) = (deviation(2e-5).norm(), deviation(1e-5).norm());
            // Of the second order: (λ₁s₁²h)(h/λ₁) and its like.
            assert!((one / half - 4.0).abs() < 0.01, "{one:e}, {half:e}");
            assert!(deviation(1e-9).norm() < ROUNDING);
        }
    }

    /// The flux changes by what the source's motion and the wave take along, q(0) − q(h) = λ∫s²T dz, and crosses interfaces unchanged.
    #[test]
    fn no_heat_is_lost() {
        let conductions = [conduction(2.0, 0.7), conduction(0.1, 0.2), conduction(5.0, 3.0)];
        let mut worst = 0.0f64;
        for (k, velocity) in [([0.3, 0.4], 0.0), ([0.9, -0.4], 5.0), ([-0.4, 0.1], 40.0)] {
            let h = [0.6, 0.25];
            let wave = body(&h, &conductions, &[0.0, 3.0], velocity).temperature_wave(k);
            let flux = |material: usize, z: f64| wave.flux(Depth { z, material });
            assert!((flux(1, 0.0) - 1.0).norm() < ROUNDING);
            let mut top = 0.0;
            for (number, h) in h.into_iter().enumerate() {
                let material = number + 1;
                let (lambda, square) = (conductions[number].conductivity(), wave.rate(material).powu(2));
                let taken: Complex64 = gauss(40)
                    .iter()
                    .map(|[x, weight]| {
                        at(&wave, material, top + 0.5 * h * (1.0 + x)) * square * (lambda * 0.5 * h * weight)
                    })
                    .sum();
                let lost = flux(material, top) - flux(material, top + h) - taken;
                let jump = flux(material, top + h) - flux(material + 1, top + h);
                let fall = at(&wave, material, top + h)
                    - at(&wave, material + 1, top + h)
                    - flux(material, top + h) * [0.0, 3.0][number];
                worst = [lost, jump, fall].iter().fold(worst, |worst, error| worst.max(error.norm()));
                top += h;
                let [a, b] = wave.exponentials(material);
                let both = a + b * (-wave.rate(material) * h).exp() - at(&wave, material, top - h);
                assert!(both.norm() < ROUNDING * (a.norm() + b.norm()));
            }
            let mirrored = body(&h, &conductions, &[0.0, 3.0], velocity).surface_temperature(k.map(|k| -k));
            assert_eq!(mirrored.conj(), body(&h, &conductions, &[0.0, 3.0], velocity).surface_temperature(k));
        }
        assert!(worst < ROUNDING);
    }

    #[test]
    fn temperatures_are_those_of_collocation() {
        let mut worst = 0.0f64;
        for (body, k) in cases() {
            let (wave, nodes) = (body.temperature_wave(k), Collocation::new(&body, k).solution());
            let temperature = error(nodes.iter().map(|node| [wave.at(node.depth), node.temperature]));
            let flux = error(nodes.iter().map(|node| [wave.flux(node.depth), node.flux]));
            worst = worst.max(temperature).max(flux);
            // Second derivatives at 21 points lose 21⁴ε = 4e-11.
            assert!(temperature < 4e-11 && flux < 4e-11, "{}, k {k:?}: {temperature:e}, {flux:e}", body.half_space());
        }
    }
}
