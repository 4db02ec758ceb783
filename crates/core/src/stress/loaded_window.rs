//! The traction in the window of an isolated contact, and the windows around it in which its stresses are searched, each twice as wide as the
//! one before: [`super::surroundings`].

use super::far_tables::FarTables;
use super::far_tables::sides;
use super::traction::Traction;
use crate::body::HalfSpace;
use crate::body::InteriorTable;
use crate::lattice::Cell;
use crate::numeric::fourier::fast_points;
use std::f64::consts::PI;

/// β: ½ erfc β = 1e-5 is left at both ends of the cut.
const STEEPNESS: f64 = 3.0;
/// β′: e^{−β′²} = 4e-4 of the short waves reaches the hole.
const REMOTENESS: f64 = 2.8;
/// Largest number of windows around that of the contact: the last one is 4096 times as wide.
pub(super) const MOST_WINDOWS: u32 = 12;
/// Largest number of samples along a side of a square window before it is rounded up, of another as many in all; it suffices for a contact that fills nine tenths
/// of its own.
const MOST_POINTS: f64 = 512.0;
/// Half the size of the contact, times this, is the distance beyond which its stresses decay on a bare body.
const CONTACT_REACH: f64 = 0.5;

/// The shorter side of the window, times this, is deep.
const DEEP: f64 = 4.0;

/// The traction on the grid of the window of an isolated contact.
#[derive(Debug)]
pub(super) struct LoadedWindow {
    pub traction: Traction<'static>,
    pub extent: Extent,
    /// Distance from the load from which on stresses only decay, a length.
    pub reach: f64,
}

/// Size of a window and of what is loaded in it.
#[derive(Debug)]
pub(super) struct Extent {
    /// Sides along x and y, lengths.
    sides: [f64; 2],
    /// Samples along the sides.
    points: [usize; 2],
    /// Half the size along x and y of the rectangle around the middle that holds all loaded samples, lengths.
    half_size: [f64; 2],
}

impl LoadedWindow {
    pub fn new(traction: Traction<'static>, half_space: &HalfSpace) -> Self {
        let (grid, mut half_size) = (traction.grid(), [0.0f64; 2]);
        for index in (0..grid.len()).filter(|&index| traction.is_loaded(index)) {
            let place = grid.cell().point(grid.fractions(index));
            half_size.iter_mut().zip(place).for_each(|(half, x)| *half = half.max(x.abs()));
        }
        let extent = Extent { sides: sides(grid.cell()), points: grid.points(), half_size };
        let reach = extent.reach(half_space);
        Self { traction, extent, reach }
    }
}

impl Extent {
    /// Sides of the window around it of a number; 0 is the window itself.
    pub fn sides(&self, number: u32) -> [f64; 2] {
        self.sides.map(|side| 2f64.powi(number as i32) * side)
    }

    /// The least distance from loaded samples to the border of the window of a number, a length; a spacing at least.
    pub fn margin(&self, number: u32) -> f64 {
        let sides = self.sides(number);
        let margin =
            |axis: usize| (0.5 * sides[axis] - self.half_size[axis]).max(self.sides[axis] / self.points[axis] as f64);
        margin(0).min(margin(1))
    }

    /// The smallest and the largest size in which stresses vary in the window of a number from 1, lengths: the distance from the load, and that or
    /// half its size.
    pub fn radii(&self, number: u32) -> [f64; 2] {
        let margin = self.margin(number - 1);
        [margin, margin.max(self.half_size[0]).max(self.half_size[1])]
    }

    /// Stress that the waves left out of the window of a number from 1 may add at the border of the one before it, over the stresses there.
    pub fn left_out(&self, number: u32) -> f64 {
        let (most, _) = self.cut(number);
        (-(self.margin(number - 1) * most / (2.0 * STEEPNESS)).powi(2)).exp()
    }

    /// Distance from the load from which on stresses only decay, a length.
    pub fn reach(&self, half_space: &HalfSpace) -> f64 {
        half_space.bending_reach() + CONTACT_REACH * self.half_size[0].max(self.half_size[1])
    }

    /// Depth below which faint measures are not followed, a length: four windows.
    pub fn deep(&self) -> f64 {
        DEEP * self.sides[0].min(self.sides[1])
    }

    /// The wavenumber q₁ of the cut in the window of a number from 1, and the samples along its sides that hold the waves up to twice
    /// as much; no more than [`MOST_POINTS`] allow, or those of the pressure itself.
    pub fn cut(&self, number: u32) -> (f64, [usize; 2]) {
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

/// The smooth cut φ at a wavenumber over that of the cut.
pub(super) fn passed(ratio: f64) -> f64 {
    0.5 * libm::erfc(STEEPNESS * (ratio - 1.0))
}

/// Memory of what is far from an isolated contact, bytes: of the far field in its window, and of the search around it as far as stiff
/// layers make it go, where contact fills half of the window. 0 of a periodic cell.
pub fn bytes_far(cell: Cell, half_space: &HalfSpace, slides: bool) -> usize {
    /// Bytes of a sample of the series: its wave, and the rows of a plane.
    const SAMPLE: usize = 92;
    let Some(sides) = cell.window_sides() else { return 0 };
    let extent = Extent { sides, points: [1 << 20; 2], half_size: sides.map(|side| 0.25 * side) };
    let reach = extent.reach(half_space);
    let numbers = (1..=MOST_WINDOWS).take_while(|number| extent.margin(number - 1) < reach);
    let (mut tables, mut largest) = (0, 0);
    for number in numbers {
        let (_, [n1, n2]) = extent.cut(number);
        // Waves of the series on the grid and on the coarser one of the error; a wave and its conjugate count once,
        // four share their shell.
        let samples = 4 * n1 * n2;
        let shells = 2 * samples / 8;
        let wide = Cell::window(extent.sides(number)).map_or(0, |wide| FarTables::bytes(wide, half_space, slides));
        tables += wide + InteriorTable::bytes(half_space, slides, |_| shells);
        largest = largest.max(SAMPLE * samples);
    }
    FarTables::bytes(cell, half_space, slides) + tables + largest
}
