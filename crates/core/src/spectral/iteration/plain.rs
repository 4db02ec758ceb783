//! The preconditioned method in plain lines and double precision, line by line as the head of `preconditioned` has it: its
//! documentation, and the twin that its fused loops are tested against.

use super::bounds::Bounds;
use super::inner_iteration::{Continuation, MAX_BACKTRACK, MAX_BACKTRACKS, MIN_BACKTRACK, Variant};
use super::preconditioned::OUTER_REDUCTION;
use crate::load::Control;
use crate::spectral::LayeredOperator;
use crate::spectral::extension::{DECAY, FADE, WIDTH};
use crate::spectral::operator::{ElasticOperator, TractionUpdate, Workspace};

type Field = Vec<f64>;

/// A contact problem on one grid, `points` = [N₁, N₂].
pub(super) struct Plain {
    pub points: [usize; 2],
    /// A, and its symmetric part C.
    pub body: LayeredOperator,
    pub symmetric: LayeredOperator,
    /// f ≥ 0, a length.
    pub initial_gap: Field,
    pub load: Control,
    pub bounds: Bounds,
    pub variant: Variant,
}

/// The iteration before: t′, r′ − mean on I′, and ⟨r′, z′⟩.
struct Last {
    direction: Field,
    residual: Field,
    norm: f64,
}

impl Plain {
    /// Pressure after each iteration from the pressure `p`, and the length τ of its step.
    pub fn iterates(&mut self, mut p: Field, iterations: usize) -> Vec<(Field, f64)> {
        let lagged = self.variant.traction == TractionUpdate::Lagged;
        let share = if lagged { 1.0 / (1.0 + self.body.coupling().powi(2)) } else { 1.0 };
        let (mut last, mut all) = (None, Vec::new());
        p.iter_mut().for_each(|p| *p = self.bounds.project(*p));
        let (mut g, mut penetration) = self.gap(&p);
        let (mut energy, mut measure) = (self.energy(&p), f64::INFINITY);
        for number in 0..iterations {
            // 1. The gap, afresh: under a lagged traction once the criteria have fallen since it was.
            let now = self.measure(&p, &g, penetration, energy);
            if !lagged || number == 0 || now < share * OUTER_REDUCTION * measure {
                (g, penetration) = self.gap(&p);
                energy = self.energy(&p);
                measure = self.measure(&p, &g, penetration, energy);
                g.iter_mut().for_each(|g| *g *= share);
            }
            // 3. Active set I and residual r on it, without its mean under load control.
            let active: Vec<bool> = p.iter().zip(&g).map(|(&p, &g)| self.bounds.is_active(p, g)).collect();
            let r = self.without_mean(&on(&active, &g), &active);
            // 4. Direction t = z + βt′ with z = M r.
            let z = self.preconditioned(&r, &active);
            let z = self.without_mean(&z, &active);
            let norm = dot(&r, &z);
            let beta = last.as_ref().map_or(0.0, |last: &Last| ((norm - dot(&last.residual, &z)) / last.norm).max(0.0));
            let mut t = z;
            if let Some(last) = last.as_ref().filter(|_| beta > 0.0) {
                let before = self.without_mean(&on(&active, &last.direction), &active);
                t.iter_mut().zip(before).for_each(|(t, before)| *t += beta * before);
            }
            // 5. Step d.
            let tau = dot(&g, &t) / dot(&t, &self.displacement(&t));
            let (d, restart) = self.step(&p, &g, (&t, tau, beta), &active, number == 0);
            p = p.iter().zip(&d).map(|(p, d)| self.bounds.project(p + d)).collect();
            last = (!restart).then_some(Last { direction: t, residual: r, norm });
            // 1. The gap by its change.
            let change = self.displacement(&d);
            g.iter_mut().zip(change).for_each(|(g, change)| *g += change);
            if self.load.is_mean_pressure() {
                let shift = self.mean(&p, &g);
                g.iter_mut().for_each(|g| *g -= shift);
                penetration += shift;
            }
            all.push((p.clone(), tau));
        }
        all
    }

    /// g = A p + f − δ, and δ.
    fn gap(&mut self, p: &[f64]) -> (Field, f64) {
        let mut w = p.to_vec();
        self.body.displace(&mut w, &mut Workspace::default());
        let g: Field = w.iter().zip(&self.initial_gap).map(|(w, f)| w + f).collect();
        let penetration = match self.load {
            Control::MeanPressure(_) => self.mean(p, &g),
            Control::Penetration(given) => given,
        };
        (g.into_iter().map(|g| g - penetration).collect(), penetration)
    }

    /// A change of w: by A with an updated traction, by C with a lagged one.
    fn displacement(&mut self, change: &[f64]) -> Field {
        let mut field = change.to_vec();
        let operator =
            if self.variant.traction == TractionUpdate::Updated { &mut self.body } else { &mut self.symmetric };
        operator.displace(&mut field, &mut Workspace::default());
        field
    }

    /// M r = P_I Eᵀ C⁻¹ E r, or P_I C⁻¹ r.
    fn preconditioned(&mut self, r: &[f64], active: &[bool]) -> Field {
        let continued = self.variant.continuation == Continuation::Fading;
        let indicator: Field = active.iter().map(|&active| f64::from(u8::from(active))).collect();
        let weight = self.smoothed(&indicator).into_iter().zip(active).map(|(c, &active)| {
            let (decay, fade) = (f64::from(DECAY), f64::from(FADE));
            if active || !continued { 0.0 } else { decay * c / (c * c + fade * fade) }
        });
        let weight: Field = weight.collect();
        // E r = r + W S r.
        let mut y: Field = r.iter().zip(&weight).zip(self.smoothed(r)).map(|((r, w), near)| r + w * near).collect();
        self.symmetric.symmetric_pressure(&mut y, &mut Workspace::default());
        // Eᵀ y = y + S W y.
        let back = self.smoothed(&y.iter().zip(&weight).map(|(y, w)| y * w).collect::<Field>());
        on(active, &y.iter().zip(back).map(|(y, back)| y + back).collect::<Field>())
    }

    /// The step d from p along −t, and whether the next direction has to start anew.
    fn step(
        &mut self,
        p: &[f64],
        g: &[f64],
        (t, mut tau, beta): (&[f64], f64, f64),
        active: &[bool],
        is_first: bool,
    ) -> (Field, bool) {
        for backtracks in 0.. {
            let mut end: Field = p.iter().zip(t).map(|(p, t)| p - tau * t).collect();
            let is_clipped = end.iter().zip(p).any(|(&end, &p)| {
                self.bounds.clamp(end) != end && !(self.bounds.is_full(p) && self.bounds.is_full(end))
            });
            end.iter_mut().for_each(|p| *p = self.bounds.project(*p));
            if let (Control::MeanPressure(mean), true) = (self.load, is_clipped || backtracks > 0) {
                let total = mean * p.len() as f64;
                if !end.iter().any(|&p| self.bounds.is_full(p)) {
                    let scale = total / end.iter().sum::<f64>();
                    end.iter_mut().for_each(|p| *p *= scale);
                }
                if end.iter().any(|&p| self.bounds.is_nearly_full(p)) {
                    end = self.shifted_to(total, p, t, tau, active);
                }
            }
            let d: Field = end.iter().zip(p).map(|(end, p)| end - p).collect();
            // The change of the energy is ⟨g, d⟩ + ½⟨d, Cd⟩.
            let (slope, curvature) = (dot(g, &d), dot(&d, &self.displacement(&d)));
            let part = -slope / curvature;
            match backtracks {
                0 if !is_clipped => return (d, false),
                _ if is_first || slope + 0.5 * curvature <= 0.0 => return (d, false),
                MAX_BACKTRACKS if slope < 0.0 => return (d.into_iter().map(|d| part * d).collect(), false),
                _ if slope >= 0.0 && beta > 0.0 => return (vec![0.0; p.len()], true),
                MAX_BACKTRACKS => break,
                _ => tau *= part.clamp(MIN_BACKTRACK, MAX_BACKTRACK),
            }
        }
        panic!("no step lowers the energy");
    }

    /// The mean of g by which δ moves: with the weights p, and p(1 − p/H) where any sample is full; between the gaps inside and outside
    /// contact where no sample is free.
    fn mean(&self, p: &[f64], g: &[f64]) -> f64 {
        let is_full = p.iter().any(|&p| self.bounds.is_full(p));
        let weights: Field = p.iter().map(|&p| if is_full { self.bounds.weight(p) } else { p }).collect();
        match weights.iter().sum::<f64>() {
            sum if sum > 0.0 => dot(&weights, g) / sum,
            _ => self.bounds.between(p.iter().copied().zip(g.iter().copied())),
        }
    }

    /// min(max(p − τt + λ, 0), H) on I with the λ that makes its sum `total`, by bisection.
    fn shifted_to(&self, total: f64, p: &[f64], t: &[f64], tau: f64, active: &[bool]) -> Field {
        let shifted = |shift: f64| -> Field {
            let end = |((p, t), active): ((&f64, &f64), &bool)| {
                self.bounds.project(p - tau * t + if *active { shift } else { 0.0 })
            };
            p.iter().zip(t).zip(active).map(end).collect()
        };
        // From where all of I is empty to where all of it is full.
        let reach = self.bounds.largest() + t.iter().fold(0.0, |most: f64, t| most.max((tau * t).abs()));
        let [mut low, mut high] = [-reach, reach];
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if shifted(middle).iter().sum::<f64>() < total {
                low = middle
            } else {
                high = middle
            };
        }
        shifted(0.5 * (low + high))
    }

    /// A field on I without its mean there, under load control; as it is under displacement control.
    fn without_mean(&self, field: &[f64], active: &[bool]) -> Field {
        let size = active.iter().filter(|&&active| active).count() as f64;
        let mean = if self.load.is_mean_pressure() { field.iter().sum::<f64>() / size } else { 0.0 };
        on(active, &field.iter().map(|x| x - mean).collect::<Field>())
    }

    /// S: along both axes the mean over 16 samples of the mean over 16.
    fn smoothed(&self, field: &[f64]) -> Field {
        let [n1, n2] = self.points;
        let reach = WIDTH as i64 - 1;
        let weight = |k: i64| (WIDTH as i64 - k.abs()) as f64 / (WIDTH * WIDTH) as f64;
        let along = |field: &[f64], step: [i64; 2]| -> Field {
            let at = |i: usize, k: i64| {
                let row = (i / n2) as i64 + k * step[0];
                let column = (i % n2) as i64 + k * step[1];
                field[row.rem_euclid(n1 as i64) as usize * n2 + column.rem_euclid(n2 as i64) as usize]
            };
            (0..field.len()).map(|i| (-reach..=reach).map(|k| weight(k) * at(i, k)).sum()).collect()
        };
        along(&along(field, [1, 0]), [0, 1])
    }

    /// ½⟨p, Ap⟩.
    fn energy(&mut self, p: &[f64]) -> f64 {
        let mut w = p.to_vec();
        self.body.displace(&mut w, &mut Workspace::default());
        0.5 * dot(p, &w)
    }

    /// 2. The largest of the criteria.
    fn measure(&self, p: &[f64], g: &[f64], penetration: f64, energy: f64) -> f64 {
        let load: f64 = p.iter().sum();
        let least = g.iter().copied().fold(f64::INFINITY, f64::min);
        let least = if self.load.is_mean_pressure() { least } else { least.min(0.0) };
        let outside = p.iter().zip(g).filter(|(p, _)| **p == 0.0).fold(0.0, |least: f64, (_, g)| least.min(*g));
        let away = |(&p, &g): (&f64, &f64)| g.abs() * self.bounds.away(p, g);
        let residual = p.iter().zip(g).map(away).sum::<f64>() / (load * penetration);
        let gap = match p.iter().any(|&p| self.bounds.is_full(p)) {
            false => dot(p, g) - least * load,
            true => {
                let at =
                    |theta: f64| -> f64 { p.iter().zip(g).map(|(&p, &g)| self.bounds.energy_share(p, g, theta)).sum() };
                let below = p.iter().zip(g).filter(|(p, _)| !self.bounds.is_full(**p)).map(|(_, g)| *g);
                at(0.0).min(at(below.fold(0.0, f64::min)))
            }
        };
        residual.max(gap / energy / 20.0).max(-outside / penetration / 10.0)
    }
}

/// A field on the active set, 0 elsewhere.
fn on(active: &[bool], field: &[f64]) -> Field {
    field.iter().zip(active).map(|(&x, &active)| if active { x } else { 0.0 }).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::friction::Friction;
    use crate::lattice::{Cell, Grid};
    use crate::spectral::iteration::admissible::AdmissibleSet;
    use crate::spectral::iteration::fields::{Unknowns, Working};
    use crate::spectral::iteration::preconditioned;
    use crate::spectral::iteration::problem::{ContactProblem, Settings};
    use std::f64::consts::TAU;
    use std::ops::ControlFlow;

    /// f of a few long waves, or of all down to the grid with phases at random.
    fn surface([n1, n2]: [usize; 2], is_rough: bool) -> Field {
        let most = if is_rough { n1.min(n2) as i32 / 3 } else { 1 };
        let waves = (0..=most).flat_map(|k1| (-most..=most).map(move |k2| (k1, k2))).filter(|k| *k != (0, 0));
        let height = |i: usize| {
            let (s, t) = ((i / n2) as f64 / n1 as f64, (i % n2) as f64 / n2 as f64);
            let wave = |(number, (k1, k2)): (usize, (i32, i32))| {
                let phase = if is_rough { (number * number * 7919 % 1009) as f64 / 1009.0 } else { 0.0 };
                let amplitude = f64::from(k1 * k1 + k2 * k2).powf(-0.9);
                amplitude * (TAU * (f64::from(k1) * s + f64::from(k2) * t + phase)).cos()
            };
            waves.clone().enumerate().map(wave).sum::<f64>()
        };
        let heights: Field = (0..n1 * n2).map(height).collect();
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        heights.into_iter().map(|height| 0.01 * (highest - height)).collect()
    }

    /// The fused loops against the plain lines, pressure by pressure, in `iterations` under a `load` over the pressure
    /// (or penetration) that displaces by the largest f.
    fn compare(cell: Cell, points: [usize; 2], is_rough: bool, load: Control, friction: f64, variant: Variant) {
        compare_with(cell, points, is_rough, load, friction, variant, f64::INFINITY);
    }

    /// [`compare`] with a hardness, over the pressure that displaces by the largest f.
    fn compare_with(
        cell: Cell,
        points: [usize; 2],
        is_rough: bool,
        load: Control,
        friction: f64,
        variant: Variant,
        hardness: f64,
    ) {
        let iterations = 14;
        let grid = Grid::new(cell, points).unwrap();
        let layer = Layer::new(Material::from_shear(3.0, 0.2).unwrap(), 0.1, Interface::Bonded).unwrap();
        let half_space = HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.3).unwrap());
        let operator = || match friction {
            0.0 => LayeredOperator::new(&grid, &half_space),
            coefficient => {
                LayeredOperator::sliding(&grid, &half_space, &Friction::new(coefficient, [0.8, 0.6]).unwrap())
            }
        };
        let initial_gap = surface(points, is_rough);
        let length = initial_gap.iter().copied().fold(0.0, f64::max);
        let unit = length / operator().unit();
        let load = match load {
            Control::MeanPressure(part) => Control::MeanPressure(part * unit),
            Control::Penetration(part) => Control::Penetration(part * length),
        };
        // More pressure where the surface is higher.
        let mean = if let Control::MeanPressure(mean) = load { mean } else { 0.1 * unit };
        let heights: Field = initial_gap.iter().map(|f| length - f).collect();
        let scale = mean * grid.len() as f64 / heights.iter().sum::<f64>();
        let bounds = Bounds::up_to(hardness * unit);
        let mut start: Field = heights.into_iter().map(|height| scale * height).collect();
        // At most H, and of the mean.
        for _ in 0..200 {
            start.iter_mut().for_each(|p| *p = bounds.clamp(*p));
            let scale = mean * grid.len() as f64 / start.iter().sum::<f64>();
            start.iter_mut().for_each(|p| *p *= scale);
        }
        start.iter_mut().for_each(|p| *p = bounds.clamp(*p));
        let symmetric = LayeredOperator::new(&grid, &half_space);
        let mut plain =
            Plain { points, body: operator(), symmetric, initial_gap: initial_gap.clone(), load, bounds, variant };
        let expected = plain.iterates(start.clone(), iterations);

        // Each iteration rounds a gap of at most the largest f to 2⁻²⁴ of it; C⁻¹ makes of that at most κ such pressures,
        // κ = C(least q)/C(largest q), and each of four fields (r, z, t, C t) is rounded once; the step multiplies by τ. (Under
        // a given penetration τ is large at first: a uniform pressure displaces nothing.)
        let response = half_space.response();
        let condition = response.compliance(grid.least_wavenumber()) / response.compliance(grid.largest_wavenumber());
        let rounding = 4.0 * 2f64.powi(-24) * condition * unit;
        let (mut fused, mut bound) = (operator(), 0.0);
        for (k, (expected, tau)) in (1..).zip(&expected) {
            bound += tau.max(1.0) * rounding;
            let mut unknowns = Unknowns::new(grid.len());
            unknowns.pressure = std::sync::Arc::new(start.clone());
            let mut problem = ContactProblem {
                working: &mut Working::of_finest(&fused),
                operator: &mut fused,
                initial_gap: &initial_gap,
                largest_gap: length,
                admissible: AdmissibleSet::default().within(bounds),
                load,
                settings: Settings { tolerance: 0.0, max_iterations: k, ..Settings::default() },
                outer: 0,
                progress: &mut |_| ControlFlow::Continue(()),
            };
            let report = preconditioned::solve(&mut problem, variant, 0, &mut unknowns);
            assert_eq!(report.iterations, k, "{report}");
            let error = unknowns.pressure.iter().zip(expected).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            let peak = expected.iter().copied().fold(0.0, f64::max);
            let context = format!("{variant:?}, friction {friction}, iteration {k}, τ {tau}");
            println!("{context}: {:e} of the bound, {:e} of the peak", error / bound, error / peak);
            assert!(error < bound, "{context}: {error:e}, bound {bound:e}, peak {peak}");
            assert!(bound < 1e-2 * peak, "too wide a bound: {bound:e} of {peak}");
        }
    }

    const UPDATED: Variant = Variant { continuation: Continuation::Fading, traction: TractionUpdate::Updated };
    const LAGGED: Variant = Variant { continuation: Continuation::Fading, traction: TractionUpdate::Lagged };

    #[test]
    fn smooth_contact_is_iterated_as_in_plain_lines() {
        compare(Cell::square(1.0).unwrap(), [40, 36], false, Control::MeanPressure(0.1), 0.0, UPDATED);
        let without = Variant { continuation: Continuation::Zero, ..UPDATED };
        compare(Cell::square(1.0).unwrap(), [40, 36], false, Control::MeanPressure(0.1), 0.0, without);
    }

    #[test]
    fn rough_contact_is_iterated_as_in_plain_lines() {
        compare(Cell::square(1.0).unwrap(), [48, 48], true, Control::MeanPressure(0.05), 0.0, UPDATED);
    }

    #[test]
    fn contact_on_an_oblique_cell_is_iterated_as_in_plain_lines() {
        let cell = Cell::new([1.0, 0.1], [0.4, 0.8]).unwrap();
        compare(cell, [36, 45], false, Control::MeanPressure(0.2), 0.0, UPDATED);
    }

    #[test]
    fn contact_under_a_given_penetration_is_iterated_as_in_plain_lines() {
        compare(Cell::hexagonal(1.0).unwrap(), [36, 36], false, Control::Penetration(0.2), 0.0, UPDATED);
    }

    #[test]
    fn contact_of_hard_surfaces_is_iterated_as_in_plain_lines() {
        let square = Cell::square(1.0).unwrap();
        for (load, hardness) in [(0.1, 0.3), (0.1, 0.12), (0.3, 0.6)] {
            compare_with(square, [40, 36], false, Control::MeanPressure(load), 0.0, UPDATED, hardness);
        }
        compare_with(square, [48, 48], true, Control::MeanPressure(0.05), 0.0, UPDATED, 0.5);
        compare_with(square, [36, 40], false, Control::MeanPressure(0.1), 0.3, LAGGED, 0.25);
        compare_with(Cell::hexagonal(1.0).unwrap(), [36, 36], false, Control::Penetration(0.2), 0.0, UPDATED, 0.3);
    }

    #[test]
    fn sliding_contact_is_iterated_as_in_plain_lines() {
        for (friction, variant) in [(0.3, UPDATED), (0.3, LAGGED), (0.8, LAGGED)] {
            compare(Cell::square(1.0).unwrap(), [36, 40], false, Control::MeanPressure(0.1), friction, variant);
        }
    }
}
