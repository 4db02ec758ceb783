//! The plane waves of a grid, in rows of the first Brillouin zone of its samples.
//!
//! A real field is its mean and Re Σ c e^{i**q**·**x**} over waves **q** = κ₁**b**₁ + κ₂**b**₂, one of each pair ±**q**:
//! κ₂ > 0, or κ₂ = 0 and κ₁ > 0. The zone is convex, so that each κ₂ has one interval of κ₁, a **row**. On its border a
//! Fourier component has several shortest aliases: each is a wave with an equal part of the coefficient, so that
//! factors that depend on the direction are averaged over them and keep the symmetry of the lattice.
//!
//! Waves of equal wavenumber form a **shell**: the response of a layered half-space to a wave depends on its shell alone.

use super::cell::norm;
use super::zone::BrillouinZone;
use std::f64::consts::TAU;

/// Largest relative difference of wavenumbers within one shell, and of the lengths of tied aliases.
pub(crate) const WAVENUMBER_TOLERANCE: f64 = 1e-11;
/// Relative distance from the border of the zone within which aliases may be tied.
pub(super) const BORDER_TOLERANCE: f64 = 1e-9;
/// Largest number of rows per sample along the sides: beyond it most rows of a skewed cell are empty.
const MAX_ROWS_PER_SAMPLE: f64 = 4.0;

/// All waves of a grid except the mean.
#[derive(Debug)]
pub(crate) struct Waves {
    /// Rows, in ascending κ₂.
    rows: Vec<WaveRow>,
    /// **b**₁, from a wave to the next one of its row, 1/length.
    step: [f64; 2],
    /// Numbers of the waves that share a Fourier component with tied aliases, each with its part; 0 for waves just outside the zone.
    parts: Vec<(usize, f64)>,
    /// Index of the shell of each wave.
    shells: Vec<u32>,
    /// Wavenumbers of the shells, ascending, 1/length.
    wavenumbers: Vec<f64>,
}

/// Waves of one κ₂, in ascending κ₁.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WaveRow {
    /// κ₂.
    pub across: i32,
    /// κ₁ of the first wave.
    pub first: i32,
    /// Wavevector of the first wave, 1/length.
    pub origin: [f64; 2],
    /// Number of the first wave among all waves.
    pub start: usize,
    /// Number of waves in the row.
    pub len: usize,
}

impl Waves {
    /// Waves of the samples with this zone.
    pub fn new(zone: &BrillouinZone) -> Self {
        let [step, _] = zone.cell().reciprocal();
        let (mut rows, mut parts, mut count) = (Vec::new(), Vec::new(), 0);
        for (across, [first, last]) in intervals(zone) {
            let len = (last - first + 1) as usize;
            // The middle wave is a shortest alias, whose wavevector from the zone is exact to rounding.
            let middle = first + (last - first) / 2;
            let tied = zone.tied_wavevectors(component(zone, [middle, across]), WAVENUMBER_TOLERANCE);
            let Some((_, q)) = tied.into_iter().find(|(index, _)| *index == [middle, across]) else { continue };
            let back = f64::from(middle - first);
            let row =
                WaveRow { across, first, origin: [q[0] - back * step[0], q[1] - back * step[1]], start: count, len };
            for k in 0..len {
                let index = [first + k as i32, across];
                if zone.on_border(row.at(k, step), BORDER_TOLERANCE) {
                    let tied = zone.tied_wavevectors(component(zone, index), WAVENUMBER_TOLERANCE);
                    let part =
                        if tied.iter().any(|(alias, _)| *alias == index) { 1.0 / tied.len() as f64 } else { 0.0 };
                    parts.push((count + k, part));
                }
            }
            rows.push(row);
            count += len;
        }
        let (shells, wavenumbers) = shells(&rows, step, count);
        Self { rows, step, parts, shells, wavenumbers }
    }

    /// The waves in shells of one wavenumber and one |**k**·**e**| for a unit vector **e**, and that of each shell, 1/length: the response of a
    /// body that is passed along **e** depends on both.
    pub fn passed_along(&self, [x, y]: [f64; 2]) -> (Self, Vec<f64>) {
        let along = |row: &WaveRow, k: usize| {
            let [kx, ky] = row.at(k, self.step);
            (x * kx + y * ky).abs()
        };
        let along: Vec<f64> = self.rows.iter().flat_map(|row| (0..row.len).map(|k| along(row, k))).collect();
        let mut order: Vec<u32> = (0..along.len() as u32).collect();
        let key = |number: u32| (self.shells[number as usize], along[number as usize]);
        order.sort_unstable_by(|&a, &b| {
            let ((one, first), (other, second)) = (key(a), key(b));
            one.cmp(&other).then(first.total_cmp(&second))
        });
        let (mut shells, mut wavenumbers, mut components) = (vec![0; along.len()], Vec::new(), Vec::new());
        let mut last = None;
        for number in order {
            let (shell, component) = key(number);
            let wavenumber = self.wavenumbers[shell as usize];
            let is_known = last
                .is_some_and(|(of, at): (u32, f64)| of == shell && component - at <= WAVENUMBER_TOLERANCE * wavenumber);
            if !is_known {
                last = Some((shell, component));
                wavenumbers.push(wavenumber);
                components.push(component);
            }
            shells[number as usize] = wavenumbers.len() as u32 - 1;
        }
        let (rows, parts) = (self.rows.clone(), self.parts.clone());
        (Self { rows, step: self.step, parts, shells, wavenumbers }, components)
    }

    /// Wavenumbers of the shells, ascending, 1/length.
    pub fn wavenumbers(&self) -> &[f64] {
        &self.wavenumbers
    }

    /// Number of shells with wavenumbers up to `most`.
    pub fn shells_up_to(&self, most: f64) -> usize {
        self.wavenumbers.partition_point(|&q| q <= most)
    }

    /// **b**₁, from a wave to the next one of its row, 1/length.
    pub fn step(&self) -> [f64; 2] {
        self.step
    }

    /// Index of the shell of each wave.
    pub fn shells(&self) -> &[u32] {
        &self.shells
    }

    /// The rows restricted to waves of the first `count` shells: intervals again, by convexity.
    pub fn rows_within(&self, count: usize) -> Vec<WaveRow> {
        let [x, y] = self.step;
        let cut = |row: &WaveRow| {
            let shells = &self.shells[row.start..row.start + row.len];
            let within = |shell: &u32| (*shell as usize) < count;
            // Wavenumbers increase on both sides of the wave nearest to the origin.
            let nearest = -(row.origin[0] * x + row.origin[1] * y) / (x * x + y * y);
            let nearest = (nearest.round().max(0.0) as usize).min(row.len - 1);
            if !within(&shells[nearest]) {
                return None;
            }
            let skipped = shells[..nearest].partition_point(|shell| !within(shell));
            let last = nearest + shells[nearest..].partition_point(within) - 1;
            Some(WaveRow {
                first: row.first + skipped as i32,
                origin: row.at(skipped, self.step),
                start: row.start + skipped,
                len: last + 1 - skipped,
                ..*row
            })
        };
        self.rows.iter().filter_map(cut).collect()
    }

    /// Coefficient of each wave: its part of the `coefficient` of the Fourier component (k₁, k₂), any integers.
    pub fn coefficients<T: Copy + std::ops::Mul<f64, Output = T>>(
        &self,
        coefficient: impl Fn([i32; 2]) -> T,
    ) -> Vec<T> {
        let indices = self.rows.iter().flat_map(|row| (0..row.len).map(|k| [row.first + k as i32, row.across]));
        let mut all: Vec<T> = indices.map(coefficient).collect();
        for &(number, part) in &self.parts {
            all[number] = all[number] * part;
        }
        all
    }
}

impl WaveRow {
    /// Wavevector of the row's wave number k, 1/length; `step` is that from a wave to the next.
    pub fn at(&self, k: usize, step: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + k as f64 * step[0], self.origin[1] + k as f64 * step[1]]
    }
}

/// The Fourier component of a wave.
fn component(zone: &BrillouinZone, index: [i32; 2]) -> [usize; 2] {
    [0, 1].map(|axis| index[axis].rem_euclid(zone.points()[axis] as i32) as usize)
}

/// First and last κ₁ in the zone, its border included, for each κ₂ ≥ 0 that has any.
fn intervals(zone: &BrillouinZone) -> Vec<(i32, [i32; 2])> {
    let [b1, b2] = zone.cell().reciprocal();
    let facets = zone.facets();
    let [r1, r2, _] = facets;
    let most = 0.5 * (norm(r1) + norm(r2)) * norm(zone.cell().vectors()[1]) / TAU;
    let [n1, n2] = zone.points();
    if most > MAX_ROWS_PER_SAMPLE * (n1 + n2 + 16) as f64 {
        return skewed(zone);
    }
    let interval = |across: i32| {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for g in facets {
            let along = b1[0] * g[0] + b1[1] * g[1];
            let offset = f64::from(across) * (b2[0] * g[0] + b2[1] * g[1]);
            let reach = 0.5 * (1.0 + BORDER_TOLERANCE) * (g[0] * g[0] + g[1] * g[1]);
            if along.abs() > 1e-12 * norm(b1) * norm(g) {
                let (one, other) = ((-reach - offset) / along, (reach - offset) / along);
                (low, high) = (low.max(one.min(other)), high.min(one.max(other)));
            } else if offset.abs() > reach {
                high = f64::NEG_INFINITY;
            }
        }
        let low = if across == 0 { low.max(1.0) } else { low };
        (low.ceil() <= high.floor()).then(|| (across, [low.ceil() as i32, high.floor() as i32]))
    };
    (0..=most.ceil() as i32).filter_map(interval).collect()
}

/// First and last κ₁ for each κ₂ ≥ 0, collected from all components: for skewed cells, where few κ₂ have any.
fn skewed(zone: &BrillouinZone) -> Vec<(i32, [i32; 2])> {
    let [n1, n2] = zone.points();
    let components = (0..n1).flat_map(|k1| (0..n2).map(move |k2| [k1, k2]));
    let aliases = components.flat_map(|component| zone.tied_wavevectors(component, WAVENUMBER_TOLERANCE));
    let mut indices: Vec<[i32; 2]> =
        aliases.map(|([along, across], _)| [across, along]).filter(|&index| index > [0, 0]).collect();
    indices.sort_unstable();
    let rows = indices.chunk_by(|a, b| a[0] == b[0]);
    rows.map(|row| (row[0][0], [row[0][1], row[row.len() - 1][1]])).collect()
}

/// Index of the shell of each wave, and the wavenumbers of the shells.
fn shells(rows: &[WaveRow], step: [f64; 2], count: usize) -> (Vec<u32>, Vec<f64>) {
    let lengths: Vec<f64> = rows.iter().flat_map(|row| (0..row.len).map(|k| norm(row.at(k, step)))).collect();
    // Waves are uniform in the plane: buckets of equal area hold nearly equal numbers.
    let most = lengths.iter().copied().fold(0.0, f64::max);
    let buckets = count / 4 + 1;
    let bucket = |q: f64| (((q / most) * (q / most) * buckets as f64) as usize).min(buckets - 1);
    let mut starts = vec![0u32; buckets + 1];
    lengths.iter().for_each(|&q| starts[bucket(q) + 1] += 1);
    (0..buckets).for_each(|k| starts[k + 1] += starts[k]);
    let mut order = vec![0u32; count];
    let mut next = starts.clone();
    for (number, &q) in (0..).zip(&lengths) {
        let place = &mut next[bucket(q)];
        order[*place as usize] = number;
        *place += 1;
    }
    let (mut shells, mut wavenumbers) = (vec![0; count], Vec::new());
    for bounds in starts.windows(2) {
        let numbers = &mut order[bounds[0] as usize..bounds[1] as usize];
        numbers.sort_unstable_by(|&a, &b| lengths[a as usize].total_cmp(&lengths[b as usize]));
        for &mut number in numbers {
            let q = lengths[number as usize];
            if wavenumbers.last().is_none_or(|last| q > last * (1.0 + WAVENUMBER_TOLERANCE)) {
                wavenumbers.push(q);
            }
            shells[number as usize] = wavenumbers.len() as u32 - 1;
        }
    }
    (shells, wavenumbers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    #[test]
    fn every_component_is_the_whole_of_its_shortest_aliases() {
        let cells = [
            (Cell::square(1.0), [6, 6]),
            (Cell::hexagonal(1.0), [9, 9]),
            (Cell::hexagonal(1.0), [8, 8]),
            (Cell::new([1.0, 0.2], [0.4, 0.9]), [7, 4]),
            (Cell::new([1.0, 0.0], [7.0, 0.3]), [5, 6]),
            (Cell::new([1.0, 0.0], [7000.0, 0.3]), [5, 6]),
            (Cell::square(1.0), [1, 6]),
        ];
        for (cell, [n1, n2]) in cells {
            let zone = BrillouinZone::new(cell.unwrap(), [n1, n2]).unwrap();
            let waves = Waves::new(&zone);
            let parts = waves.coefficients(|_| 1.0);
            let mut whole = vec![0.0; n1 * n2];
            for row in &waves.rows {
                for k in 0..row.len {
                    let index = [row.first + k as i32, row.across];
                    for index in [index, index.map(|k| -k)] {
                        let [k1, k2] = component(&zone, index);
                        whole[k1 * n2 + k2] += parts[row.start + k];
                        let q = row.at(k, waves.step());
                        let least = norm(zone.wavevector([k1, k2]));
                        assert!(parts[row.start + k] == 0.0 || (norm(q) / least - 1.0).abs() < 1e-11);
                        let shell = waves.wavenumbers()[waves.shells()[row.start + k] as usize];
                        assert!((norm(q) / shell - 1.0).abs() < 1.1 * WAVENUMBER_TOLERANCE);
                    }
                }
            }
            assert!(whole[1..].iter().all(|sum| (sum - 1.0).abs() < 1e-12), "{zone:?}: {whole:?}");
        }
    }

    #[test]
    fn a_hexagonal_lattice_has_few_shells_and_a_disc_cuts_rows() {
        let waves = Waves::new(&BrillouinZone::new(Cell::hexagonal(1.0).unwrap(), [48, 48]).unwrap());
        assert!(waves.wavenumbers().len() < 48 * 48 / 8, "{} shells", waves.wavenumbers().len());
        let count = waves.shells_up_to(60.0);
        let within: usize = waves.rows_within(count).iter().map(|row| row.len).sum();
        assert_eq!(within, waves.shells().iter().filter(|&&shell| (shell as usize) < count).count());
    }
}
