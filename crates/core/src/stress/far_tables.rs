//! Stresses of an isolated contact: the waves that the periodic series lacks, and their amplitudes, which no pressure changes.
//!
//! The waves are those of cells each twice as large as the one before, with smooth cuts between them; their amplitudes are tabulated
//! at the nodes of polynomials in depth, see [`super::far_field`].

use super::depth_response::DepthResponse;
use super::tensor::StressState;
use super::traction::ShearForm;
use crate::body::{Amplitudes, Antiplane};
use crate::body::{Depth, HalfSpace, InteriorTable, REACH};
use crate::lattice::waves::Waves;
use crate::lattice::{Cell, Grid, LatticeError};
use crate::numeric::chebyshev::{nodes, place};
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// β: ½ erfc β = 2e-7 is left at both ends of a cut.
const STEEPNESS: f64 = 3.6;
/// β′: e^{−β′²} = 1e-6 of a part reaches the images.
const REMOTENESS: f64 = 3.7;
/// Number of cells, each twice as large as the one before: the last one has 2⁻²² of the least wavenumber.
const CELLS: usize = 22;
/// Nodes of the polynomials along a side as long as the shorter one; by the distance of the images they leave 10⁻⁷ of the difference.
const ACROSS: usize = 10;
/// Nodes more along the longer side for each shorter side that it is longer: the images are as close beside all of it.
const MORE_ACROSS: f64 = 8.0;
/// Largest number of nodes of the polynomials in depth.
const DOWN: usize = 8;
/// Depth below the upper face of an elastic substrate, over the longer side of the window or the depth of that face, whichever gives
/// more, down to which the field is tabulated.
const DEEPEST: [f64; 2] = [4.0, 3.0];
/// Part of the difference that the polynomials over an interval of depth leave, by the distance of the images.
const LEFT_IN_DEPTH: f64 = 1e-7;
/// Part of a wave that polynomials over the window or over an interval of depth leave, where fewer suffice than the
/// images need.
const LEFT_OF_WAVE: f64 = 1e-9;
/// Components: six stresses and three displacements.
pub(super) const COMPONENTS: usize = 9;

/// The smooth cut.
fn cut(ratio: f64) -> f64 {
    0.5 * libm::erfc(STEEPNESS * (ratio - 1.0))
}

/// The waves of one cell with their weights.
#[derive(Debug)]
pub(super) struct Part {
    pub cell: Cell,
    pub waves: Arc<Waves>,
    /// Weight of each shell.
    pub weights: Vec<f64>,
    /// Numbers of nodes along x and y that its waves need, and the phases of the waves there.
    pub counts: [usize; 2],
    pub phases: [NodePhases; 2],
    interiors: InteriorTable,
}

/// Phases e^{2πiκs} of waves κ at nodes, which have the fractions s of a cell.
#[derive(Debug)]
pub(super) struct NodePhases {
    /// The lowest κ.
    first: i32,
    /// Cosines of all κ, then the sines, at each node.
    values: Vec<[Vec<f64>; 2]>,
}

impl NodePhases {
    /// Phases of the waves of some ranges of κ.
    fn new(ranges: &[Range<i32>], nodes: impl Iterator<Item = f64>) -> Self {
        let first = ranges.iter().map(|range| range.start).min().unwrap_or(0);
        let last = ranges.iter().map(|range| range.end).max().unwrap_or(0);
        let at = |s: f64| {
            let phase = |k: i32| (TAU * (f64::from(k) * s).fract()).sin_cos();
            let (sines, cosines) = (first..last).map(phase).unzip();
            [cosines, sines]
        };
        Self { first, values: nodes.map(at).collect() }
    }

    /// Cosines and sines at a node, from κ on.
    pub fn from(&self, node: usize, kappa: i32) -> [&[f64]; 2] {
        let start = (kappa - self.first) as usize;
        self.values[node].each_ref().map(|values| &values[start..])
    }

    /// Bytes of the phases of `count` waves at some nodes.
    fn bytes(count: usize, nodes: usize) -> usize {
        2 * count * nodes * size_of::<f64>()
    }
}

/// Responses of each part at the nodes in depth that its waves need.
pub(super) type Responses = Vec<Vec<DepthResponse>>;

/// Tables that do not depend on the pressure: the waves of all cells, and their amplitudes at the nodes in depth.
#[derive(Debug)]
pub struct FarTables {
    pub(super) window: Cell,
    pub(super) half_space: HalfSpace,
    form: ShearForm,
    /// Numbers of nodes along x and y.
    pub(super) counts: [usize; 2],
    pub(super) parts: Vec<Part>,
    /// Intervals of depth with their responses.
    pub(super) segments: Vec<(Interval, OnceLock<Responses>)>,
}

/// An interval of depth in one material, lengths.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interval {
    pub material: usize,
    pub ends: [f64; 2],
    /// Largest number of nodes.
    pub nodes: usize,
}

impl FarTables {
    /// Tables for a window on a half-space, under pressures and tangential tractions of a form.
    pub fn new(window: Cell, half_space: &HalfSpace, form: ShearForm) -> Result<Self, LatticeError> {
        let sides = sides(window);
        let shorter = sides[0].min(sides[1]);
        let limit = |number: usize| limit(shorter, number);
        let (half_space, counts) = (half_space.clone(), counts(sides));
        let mut parts = Vec::new();
        for number in 0..CELLS {
            let (cell_sides, points) = part(sides, number);
            let cell = Cell::window(cell_sides)?;
            let waves = Arc::clone(Grid::new(cell, points)?.waves());
            let weight = |&q: &f64| match number {
                0 => -cut(q / limit(0)),
                _ if number + 1 == CELLS => cut(q / limit(number - 1)),
                _ => cut(q / limit(number - 1)) - cut(q / limit(number)),
            };
            let weights = waves.wavenumbers().iter().map(weight).collect();
            let interiors =
                InteriorTable::new(Arc::clone(half_space.response()), waves.wavenumbers(), form != ShearForm::None);
            let counts = part_counts(sides, number);
            let rows = waves.rows_within(waves.wavenumbers().len());
            let ranges: [Vec<Range<i32>>; 2] = [
                rows.iter().map(|row| row.first..row.first + row.len as i32).collect(),
                rows.iter().map(|row| row.across..row.across + 1).collect(),
            ];
            let phases = [0, 1].map(|axis| {
                let part_of_cell = sides[axis] / cell.vectors()[axis][axis];
                let fraction = |x| 0.5 * x * part_of_cell + 0.5;
                NodePhases::new(&ranges[axis], nodes(counts[axis]).into_iter().map(fraction))
            });
            parts.push(Part { cell, waves, weights, counts, phases, interiors });
        }
        let intervals = intervals(&half_space, sides).into_iter();
        let segments = intervals.map(|interval| (interval, OnceLock::new())).collect();
        Ok(Self { window, half_space, form, counts, parts, segments })
    }

    /// The responses in an interval of depth, by its number, computed when it is first read.
    pub(super) fn responses(&self, number: usize) -> &Responses {
        let (interval, known) = &self.segments[number];
        if known.get().is_none() {
            let sides = sides(self.window);
            let of_part = |(number, part): (usize, &Part)| {
                let count = interval.nodes_of(highest(sides[0].min(sides[1]), number));
                nodes(count).into_iter().map(|x| self.response(part, interval.depth(x))).collect()
            };
            // Not within the lock: threads that wait for it would be those that work on it.
            let _ = known.set(self.parts.iter().enumerate().map(of_part).collect());
        }
        known.get().expect("it has been set")
    }

    /// Memory of the tables of a window on a half-space, and of the fields of one load, bytes at most.
    pub fn bytes(window: Cell, half_space: &HalfSpace, slides: bool) -> usize {
        let sides = sides(window);
        let intervals = intervals(half_space, sides);
        // A wave and its mirror image along x have one wavenumber, in a square four waves.
        let together = if sides[0] == sides[1] { 4 } else { 2 };
        let response = size_of::<Amplitudes>() + size_of::<f64>();
        let sliding = if slides { size_of::<Amplitudes>() + size_of::<Antiplane>() } else { 0 };
        let of_part = |number: usize| {
            let (_, [n1, n2]) = part(sides, number);
            // A wave and its conjugate count once; the longest waves have fewer partners.
            let waves = n1 * n2 / 2;
            let shells = waves / together + n1 + n2;
            let interiors = InteriorTable::bytes(half_space, slides, |_| shells);
            let highest = highest(sides[0].min(sides[1]), number);
            let depths: usize = intervals.iter().map(|interval| interval.nodes_of(highest)).sum();
            let [along, across] = part_counts(sides, number);
            let phases = NodePhases::bytes(n1 + 1, along) + NodePhases::bytes(n2 / 2 + 1, across);
            phases
                + waves * (size_of::<Complex64>() + size_of::<u32>())
                + shells * depths * (response + sliding)
                + interiors
        };
        let [n1, n2] = counts(sides);
        let depths: usize = intervals.iter().map(|interval| interval.nodes).sum();
        (0..CELLS).map(of_part).sum::<usize>() + depths * n1 * n2 * COMPONENTS * size_of::<f64>()
    }

    /// Whether the tables are those of a window on a half-space under tangential tractions of a form.
    pub fn are_of(&self, window: Cell, half_space: &HalfSpace, form: ShearForm) -> bool {
        self.window == window && self.form == form && self.half_space.response() == half_space.response()
    }

    /// The response of a part at a depth, of the waves that reach it.
    pub(super) fn response(&self, part: &Part, depth: Depth) -> DepthResponse {
        let reached = part.waves.shells_up_to(REACH / depth.z.max(f64::MIN_POSITIVE));
        let wavenumbers = &part.waves.wavenumbers()[..reached];
        DepthResponse::new(&part.interiors, depth, wavenumbers, self.form, StressState::default())
    }
}

/// Sides of a window along x and y, lengths.
pub(super) fn sides(window: Cell) -> [f64; 2] {
    let [a1, a2] = window.vectors();
    [a1[0], a2[1]]
}

/// q_j of the cell of a number around a window with this `shorter` side, 1/length.
fn limit(shorter: f64, number: usize) -> f64 {
    // From the middle of an image to the far side of the window.
    let remote = 2f64.powi(1 + number as i32) * shorter - shorter;
    2.0 * STEEPNESS * REMOTENESS / remote
}

/// Sides of the cell of a number around a window of these sides, and the points of a grid that holds its waves up to twice the limit.
fn part(sides: [f64; 2], number: usize) -> ([f64; 2], [usize; 2]) {
    let cell_sides = sides.map(|side| side * 2f64.powi(1 + number as i32));
    let most = highest(sides[0].min(sides[1]), number);
    (cell_sides, cell_sides.map(|side| 2 * (most * side / TAU).ceil() as usize + 2))
}

/// The highest wavenumber of the cell of a number around a window with this `shorter` side, twice the limit, 1/length.
fn highest(shorter: f64, number: usize) -> f64 {
    2.0 * limit(shorter, number.saturating_sub(1))
}

/// Numbers of nodes along the sides of a window.
fn counts(sides: [f64; 2]) -> [usize; 2] {
    let shorter = sides[0].min(sides[1]);
    sides.map(|side| ACROSS + (MORE_ACROSS * (side / shorter - 1.0)).ceil() as usize)
}

/// Numbers of nodes along the sides of a window that the waves of the cell of a number need.
fn part_counts(sides: [f64; 2], number: usize) -> [usize; 2] {
    let (most, highest) = (counts(sides), highest(sides[0].min(sides[1]), number));
    [0, 1].map(|axis| wave_nodes(0.5 * highest * sides[axis], most[axis]))
}

/// Number of nodes of the polynomials for a wave over an interval, by its phase from the middle to an end; `most` at most.
///
/// The coefficients of T_j in e^{iax} are 2|J_j(a)| ≤ 2(a/2)ʲ/j!; those from N on and what of them the nodes give to the others leave
/// less than 4(a/2)ᴺ/N!, for a < N. Those of e^{ax} are 2I_j(a), the same for small a.
fn wave_nodes(phase: f64, most: usize) -> usize {
    let mut left = 4.0;
    let suffices = |count: &usize| {
        left *= 0.5 * phase / *count as f64;
        left <= LEFT_OF_WAVE && phase <= *count as f64
    };
    (1..most).find(suffices).unwrap_or(most)
}

/// Intervals of depth in all layers, and in a substrate as deep as stresses are searched, for a window of these sides.
fn intervals(half_space: &HalfSpace, sides: [f64; 2]) -> Vec<Interval> {
    let (shorter, longer) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
    let mut all = Vec::new();
    for material in 1..=half_space.material_count() {
        let (mut top, bottom) = half_space.faces(material);
        let bottom = bottom.min(top + (DEEPEST[0] * longer).max(DEEPEST[1] * top));
        while top < bottom {
            // Twice as deep from interval to interval, half the window at least.
            let least = (0.5 * shorter).max(top);
            let next = (top + least).min(bottom);
            // The images are more than twice `least` away from the middle of the interval.
            let ratio = 0.25 * (next - top) / least;
            let nodes = ((LEFT_IN_DEPTH.ln() / ratio.ln()).ceil() as usize).clamp(2, DOWN);
            all.push(Interval { material, ends: [top, next], nodes });
            top = next;
        }
    }
    all
}

impl Interval {
    /// Number of nodes that waves up to the `highest` wavenumber need. Their functions of depth are e^{±qz} and qz e^{±qz}; the factor
    /// takes one more. Fewer than [`DOWN`] are for phases below 0.2 alone, where the bound of [`wave_nodes`] holds for both.
    fn nodes_of(&self, highest: f64) -> usize {
        self.nodes.min(1 + wave_nodes(0.5 * highest * (self.ends[1] - self.ends[0]), self.nodes))
    }

    /// The depth at x in [−1, 1].
    fn depth(&self, x: f64) -> Depth {
        Depth { z: place(self.ends, x), material: self.material }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, Layer, Material};

    /// Bytes of what a table holds, counted.
    fn held(tables: &FarTables) -> usize {
        let responses = (0..tables.segments.len()).flat_map(|number| tables.responses(number).iter().flatten());
        let amplitudes: usize = responses.map(|response| response.normal.len()).sum();
        let phases = tables.parts.iter().flat_map(|part| &part.phases).flat_map(|axis| axis.values.iter().flatten());
        let phases: usize = phases.map(Vec::len).sum();
        amplitudes * (size_of::<Amplitudes>() + size_of::<f64>()) + phases * size_of::<f64>()
    }

    /// Square and slender windows, one thick layer and many thin ones.
    #[test]
    fn the_memory_stated_holds_the_tables() {
        let material = |shear| Material::from_shear(shear, 0.3).unwrap();
        let layers = |count: usize, h: f64| vec![Layer::new(material(2.0), h, Interface::Bonded).unwrap(); count];
        for (sides, layers) in [([1.0; 2], layers(1, 0.3)), ([3.0, 1.0], layers(8, 0.01)), ([1.0, 6.0], layers(0, 1.0))]
        {
            let (window, half_space) = (Cell::window(sides).unwrap(), HalfSpace::new(layers, material(1.0)));
            let tables = FarTables::new(window, &half_space, ShearForm::None).unwrap();
            let (held, stated) = (held(&tables), FarTables::bytes(window, &half_space, false));
            assert!(held <= stated && stated < 2 * held + 20_000_000, "{sides:?}: {held}, {stated}");
        }
    }

    /// However slender a window is, its memory is stated at once.
    #[test]
    fn the_memory_of_slender_windows_is_stated() {
        let half_space = HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap());
        let of = |side: f64| FarTables::bytes(Cell::window([1.0, side]).unwrap(), &half_space, false);
        assert!(of(10.0) < of(40.0) && of(40.0) < of(1000.0));
    }

    /// However deep thin layers lie below the window: every face of each lies in an interval, of which there is hardly more than one a
    /// layer.
    #[test]
    fn all_layers_are_tabulated_with_one_interval_each_or_few_more() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        for (count, h) in [(120, 0.8), (60, 3.0), (10, 1e-3), (3, 1.9)] {
            let half_space = HalfSpace::new(vec![Layer::new(material, h, Interface::Bonded).unwrap(); count], material);
            let all = intervals(&half_space, [1.0; 2]);
            for number in 1..=count {
                let (top, bottom) = half_space.faces(number);
                let ends: Vec<[f64; 2]> =
                    all.iter().filter(|interval| interval.material == number).map(|interval| interval.ends).collect();
                assert!(ends[0][0] == top && ends[ends.len() - 1][1] == bottom, "{number}: {ends:?}");
            }
            assert!(all.len() <= count + 14, "{count}, {h}: {}", all.len());
        }
    }

    #[test]
    fn few_nodes_suffice_in_thin_layers() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        let layer = |h: f64| Layer::new(material, h, Interface::Bonded).unwrap();
        let half_space = HalfSpace::new(vec![layer(1e-4), layer(0.02), layer(0.4)], material);
        let nodes: Vec<usize> = intervals(&half_space, [1.0, 2.0]).iter().map(|interval| interval.nodes).collect();
        // The last interval is cut off where the table ends.
        assert!(nodes[..4] == [2, 4, 8, 8] && nodes.iter().all(|count| (2..=DOWN).contains(count)), "{nodes:?}");
    }
}
