//! Stresses around the window of an isolated contact.
//!
//! The pressure ends in the window, its field does not: stiff layers bend, and tension at the surface or lift-off of an interface may be
//! largest several contact radii away. So the search goes on in windows each twice as wide as the one before, outside of that one. There
//! the short waves of the pressure have decayed: with m the least distance from loaded samples to the window before, the waves
//!
//! φ(q) P(**q**),  φ = ½ erfc(β(q/q₁ − 1)),  q₁ = 2ββ′/m
//!
//! leave e^{−β′²} of the stresses, and a grid of some hundred samples holds them, however wide the window is.
//!
//! **Where it ends.** Beyond half the size of the contact and what its [stiff layers reach](crate::body::HalfSpace::bending_reach)
//! measures of stress only approach those of a body at rest. The search ends in the first window that is as wide and on whose border no
//! measure is larger than both, inside and at rest. Where one at rest is larger, as σ_zz = 0 than a compression, the error covers it.

use super::far_field::FarField;
#[cfg(any(feature = "cli", test))]
use super::far_tables::FarTables;
use super::field::StressField;
use super::found::FoundStresses;
use super::measure::Sought;
use super::series::Series;
use super::tensor::StressState;
use super::window_waves::window_waves;
use crate::body::HalfSpace;
#[cfg(any(feature = "cli", test))]
use crate::body::InteriorTable;
use crate::lattice::{Cell, Grid};
use crate::numeric::fourier::fast_points;
use std::f64::consts::PI;
use std::sync::Arc;

/// β: ½ erfc β = 1e-5 is left at both ends of the cut.
const STEEPNESS: f64 = 3.0;
/// β′: e^{−β′²} = 4e-4 of the short waves reaches the hole.
const REMOTENESS: f64 = 2.8;
/// Largest number of windows around that of the contact: the last one is 4096 times as wide.
const MOST_WINDOWS: u32 = 12;
/// Largest number of samples along a side of a square window, of another as many in all; it suffices for a contact that fills nine tenths
/// of its own.
const MOST_POINTS: f64 = 512.0;
/// Part of a side of a window that counts as its border.
const BORDER: f64 = 0.05;
/// Half the size of the contact, times this, is the distance beyond which its stresses decay on a bare body.
const CONTACT_REACH: f64 = 0.5;

/// The pressure on the grid of the window of an isolated contact.
#[derive(Debug)]
pub(super) struct LoadedWindow {
    grid: Arc<Grid>,
    /// One value per sample, a₂ fastest.
    pressure: Vec<f64>,
    extent: Extent,
}

/// Size of a window and of what is loaded in it.
#[derive(Debug)]
struct Extent {
    /// Sides along x and y, lengths.
    sides: [f64; 2],
    /// Samples along the sides.
    points: [usize; 2],
    /// Half the size along x and y of the rectangle around the middle that holds all loaded samples, lengths.
    half_size: [f64; 2],
}

impl LoadedWindow {
    pub fn new(grid: &Arc<Grid>, pressure: &[f64]) -> Self {
        let mut half_size = [0.0f64; 2];
        for (index, _) in pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
            let place = grid.cell().point(grid.fractions(index));
            half_size.iter_mut().zip(place).for_each(|(half, x)| *half = half.max(x.abs()));
        }
        let extent = Extent { sides: sides(grid.cell()), points: grid.points(), half_size };
        Self { grid: Arc::clone(grid), pressure: pressure.to_vec(), extent }
    }
}

impl Extent {
    /// Sides of the window around it of a number; 0 is the window itself.
    fn sides(&self, number: u32) -> [f64; 2] {
        self.sides.map(|side| 2f64.powi(number as i32) * side)
    }

    /// The least distance from loaded samples to the border of the window of a number, a length; a spacing at least.
    fn margin(&self, number: u32) -> f64 {
        let sides = self.sides(number);
        let margin =
            |axis: usize| (0.5 * sides[axis] - self.half_size[axis]).max(self.sides[axis] / self.points[axis] as f64);
        margin(0).min(margin(1))
    }

    /// Distance from the load from which on stresses only decay, a length.
    fn reach(&self, half_space: &HalfSpace) -> f64 {
        half_space.bending_reach() + CONTACT_REACH * self.half_size[0].max(self.half_size[1])
    }

    /// The wavenumber q₁ of the cut in the window of a number from 1, and the samples along its sides that hold the waves up to twice
    /// as much; no more than [`MOST_POINTS`] allow, or those of the pressure itself.
    fn cut(&self, number: u32) -> (f64, [usize; 2]) {
        let wanted = 2.0 * STEEPNESS * REMOTENESS / self.margin(number - 1);
        let sides = self.sides(number);
        let finest = self.points.map(|points| points << number);
        let needed = sides.map(|side| 2.0 * wanted * side / PI);
        let part = (MOST_POINTS / (needed[0] * needed[1]).sqrt()).min(1.0);
        let points = [0, 1].map(|axis| {
            // One number for contacts of about the same size, so that loads share their tables.
            let shared = 2f64.powf((2.0 * (0.5 * part * needed[axis]).log2()).ceil() / 2.0);
            (2 * fast_points(shared.ceil() as usize)).min(finest[axis])
        });
        let held = [0, 1].map(|axis| match points[axis] == finest[axis] {
            true => f64::INFINITY,
            false => 0.5 * PI * points[axis] as f64 / sides[axis],
        });
        (wanted.min(held[0]).min(held[1]), points)
    }
}

fn sides(window: Cell) -> [f64; 2] {
    let [a1, a2] = window.vectors();
    [a1[0], a2[1]]
}

/// Memory of the search around a window of which contact fills half, bytes.
#[cfg(any(feature = "cli", test))]
pub(crate) fn bytes_around(window: Cell, half_space: &HalfSpace, slides: bool) -> usize {
    /// Bytes of a sample of the series: its wave, and the rows of a plane.
    const SAMPLE: usize = 92;
    let sides = sides(window);
    let extent = Extent { sides, points: [1 << 20; 2], half_size: sides.map(|side| 0.25 * side) };
    let reach = extent.reach(half_space);
    let numbers = (1..=MOST_WINDOWS).take_while(|number| extent.margin(number - 1) < reach);
    let (mut tables, mut largest) = (0, 0);
    for number in numbers {
        let (_, [n1, n2]) = extent.cut(number);
        // Of the series, on the grid and on the coarser one of the error; a wave and its conjugate count once, four share their shell.
        let samples = 4 * n1 * n2;
        let shells = 2 * samples / 8;
        let wide = Cell::window(extent.sides(number)).map_or(0, |wide| FarTables::bytes(wide, half_space, slides));
        tables += wide + InteriorTable::bytes(half_space, slides, |_| shells);
        largest = largest.max(SAMPLE * samples);
    }
    tables + largest
}

impl StressField {
    /// The field in the window of a number from 1 around an isolated contact, outside of the window of the number before it; `None` of
    /// a periodic system.
    pub(super) fn around(&self, number: u32) -> Option<Self> {
        let loaded = self.loaded.as_ref()?;
        let (most, points) = loaded.extent.cut(number);
        let [window, hole] = [number, number - 1].map(|number| Cell::window(loaded.extent.sides(number)));
        let (window, hole) = (window.expect("multiples of a window are windows"), hole.ok()?);
        let grid = Arc::new(Grid::new(window, points).expect("a window has samples"));
        let (tables, traction) = (self.tables().around(), Some(self.traction()).filter(|_| self.slides()));
        let series_grid = tables.series_grid(&grid);
        let waves = Arc::clone(series_grid.waves());
        let mut coefficients = window_waves(&waves, series_grid.cell(), &loaded.grid, &loaded.pressure, self.discs());
        for (c, &shell) in coefficients.iter_mut().zip(waves.shells()) {
            *c *= 0.5 * libm::erfc(STEEPNESS * (waves.wavenumbers()[shell as usize] / most - 1.0));
        }
        let far_tables = tables.far(window, self.half_space(), traction);
        let far = FarField::new(far_tables, &loaded.grid, &loaded.pressure, self.discs(), series_grid.cell());
        Some(self.outside(hole, [grid, series_grid], Series::of_waves(waves, coefficients), far))
    }

    /// What the waves that are left out may add at the border of the hole, over the stresses there.
    fn left_out(&self, number: u32) -> f64 {
        let Some(loaded) = &self.loaded else { return 0.0 };
        let (most, _) = loaded.extent.cut(number);
        (-(loaded.extent.margin(number - 1) * most / (2.0 * STEEPNESS)).powi(2)).exp()
    }

    /// The contenders for what is `sought` in the cell, or in the window of an isolated contact and around it as far as larger values
    /// may lie; `None` when `goes_on` returns false.
    pub(super) fn found_everywhere(
        &self,
        radii: [f64; 2],
        sought: Sought,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<FoundStresses> {
        let all = vec![true; self.materials()];
        let mut found = self.found(radii, sought, &all, goes_on)?;
        let Some(loaded) = &self.loaded else { return Some(found) };
        found.at_rest = (1..=self.materials()).map(|material| self.at_rest(material)).collect();
        let (extent, reach) = (&loaded.extent, loaded.extent.reach(self.half_space()));
        let mut window = self.grid().cell();
        for number in 1..=MOST_WINDOWS {
            let wanted = match extent.margin(number - 1) < reach {
                true => all.clone(),
                false => found.largest_on_border(|place| is_on_border(&window, place)),
            };
            if !wanted.contains(&true) {
                break;
            }
            let wide = self.around(number)?;
            let mut around = wide.found([extent.margin(number - 1); 2], sought, &wanted, goes_on)?;
            (around.resolution, around.is_exact_below) = (found.resolution, found.is_exact_below);
            around.left_out = self.left_out(number);
            found.around.push(around);
            window = wide.grid().cell();
        }
        Some(found)
    }

    /// The state without load in a material.
    pub(super) fn at_rest(&self, material: usize) -> StressState {
        let residual = self.half_space().residual_stresses().nth(material - 1).unwrap_or(0.0);
        StressState { xx: residual, yy: residual, ..StressState::default() }
    }
}

fn is_on_border(window: &Cell, place: [f64; 2]) -> bool {
    window.fractions(place).iter().any(|s| !(BORDER..=1.0 - BORDER).contains(s))
}
