//! Nested grids: each load step is solved from the coarsest grid up, each solution starting the next finer one.
//!
//! Between load steps every grid keeps its pressure. A finer grid starts from its own last pressure plus the
//! interpolated **change** of the next coarser one, so that what a step leaves alone is never interpolated twice. The
//! baseline method works on the finest grid alone, as published.

use crate::field;
use crate::fourier::fast_points;
use crate::grid::Grid;
use crate::lattice::LatticeError;
use crate::layered::TransferFunction;
use crate::material::HalfSpace;
use crate::operator::Operator;
use crate::solver::{self, Certificate, Control, Method, Progress, Report, Settings, State, StopReason};
use crate::texture::{Interpolation, Surface, Texture, resample};
use std::fmt;

/// No grid has fewer points along a vector, unless the finest one has.
const COARSEST: usize = 24;

/// Samples of a contact that is no wider than the spacing: an apex between samples may press the four around it with any
/// load from zero on.
const UNRESOLVED: usize = 4;

/// A contact problem on its nested grids, with all it needs from step to step.
#[derive(Debug)]
pub struct Hierarchy {
    /// From the finest to the coarsest.
    nests: Vec<Nest>,
    settings: Settings,
    transfer: TransferFunction,
    contact_modulus: f64,
    levels: usize,
}

/// A solved grid as readings see it; fields hold one value per sample, a₂ fastest.
#[derive(Debug, Clone, Copy)]
pub struct Contact<'a> {
    /// The grid.
    pub grid: &'a Grid,
    /// The counterbody's surface on it.
    pub texture: &'a Texture,
    /// Number of levels: 0 for a topography.
    pub levels: usize,
    /// Compliance of the layered half-space.
    pub transfer: &'a TransferFunction,
    /// Contact modulus E* of the material at the surface, a pressure.
    pub contact_modulus: f64,
    /// Pressure p ≥ 0.
    pub pressure: &'a [f64],
    /// Gap g, a length.
    pub gap: &'a [f64],
    /// Penetration δ, a length.
    pub penetration: f64,
}

#[derive(Debug)]
struct Nest {
    texture: Texture,
    operator: Operator,
    state: State,
}

/// A solved load step on the finest grid; fields hold one value per sample, a₂ fastest.
#[derive(Debug, Clone)]
pub struct Solution {
    /// Pressure p ≥ 0.
    pub pressure: Vec<f64>,
    /// Displacement w into the body with zero mean, a length.
    pub displacement: Vec<f64>,
    /// Gap g = w + f − δ, a length.
    pub gap: Vec<f64>,
    /// Penetration δ, from the mean plane of the deformed surface to the highest apex: the additional displacement w_a.
    pub penetration: f64,
    /// How the finest grid's solution was reached.
    pub report: Report,
    /// What the pressure proves about itself.
    pub certificate: Certificate,
    /// Convolutions on all grids, as equivalents of the finest one.
    pub convolutions: f64,
}

impl Hierarchy {
    /// Grids of `points` = [N₁, N₂] and their coarser companions for `surface` on `half_space`.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn new(
        surface: &Surface,
        half_space: &HalfSpace,
        points: [usize; 2],
        settings: Settings,
    ) -> Result<Self, LatticeError> {
        let transfer = TransferFunction::new(half_space);
        let nest = |points| -> Result<Nest, LatticeError> {
            let grid = Grid::new(surface.cell(), points)?;
            Ok(Nest {
                texture: surface.sample(&grid),
                operator: Operator::new(&grid, &transfer),
                state: State::new(vec![0.0; grid.len()]),
            })
        };
        let nests = nested_points(points, settings.method).into_iter().map(nest).collect::<Result<_, _>>()?;
        let contact_modulus = half_space.surface_material().contact_modulus();
        Ok(Self { nests, settings, transfer, contact_modulus, levels: surface.levels() })
    }

    /// The finest grid.
    pub fn grid(&self) -> &Grid {
        self.nests[0].operator.grid()
    }

    /// The counterbody's surface on the finest grid.
    pub fn texture(&self) -> &Texture {
        &self.nests[0].texture
    }

    /// Contact modulus E* of the material at the surface, a pressure.
    pub fn contact_modulus(&self) -> f64 {
        self.contact_modulus
    }

    /// Number of levels: 0 for a topography.
    pub fn levels(&self) -> usize {
        self.levels
    }

    /// `solution` on the finest grid as readings see it.
    pub fn contact<'a>(&'a self, solution: &'a Solution) -> Contact<'a> {
        self.nests[0].contact(self, &solution.pressure, &solution.gap, solution.penetration)
    }

    /// The last step as the coarser grids have solved it on the way, from the next coarser one on; none for the
    /// baseline method.
    pub fn coarser(&self) -> impl Iterator<Item = Contact<'_>> {
        self.nests[1..].iter().map(|nest| {
            let State { pressure, gap, penetration, .. } = &nest.state;
            nest.contact(self, pressure, gap, *penetration)
        })
    }

    /// Penetration at which contact becomes complete: the mean of f on the finest grid, a length.
    pub fn full_contact_penetration(&self) -> f64 {
        self.texture().mean()
    }

    /// Least mean pressure of complete contact on the finest grid: max of C⁻¹(f − mean f).
    ///
    /// It grows with the grid for shapes with ridges, whose complete contact takes an infinite pressure.
    pub fn full_contact_pressure(&mut self) -> f64 {
        let Nest { texture, operator, .. } = &mut self.nests[0];
        let mean = texture.mean();
        let deviation: Vec<f64> = texture.shape.iter().map(|f| f - mean).collect();
        let mut pressure = vec![0.0; deviation.len()];
        operator.precondition(&deviation, &mut pressure);
        -field::least(pressure.len(), |i| -pressure[i])
    }

    /// Solves the next load step, starting from the last one. `callback` hears of the iterations on the finest grid.
    pub fn solve(&mut self, control: Control, callback: &mut dyn FnMut(Progress)) -> Solution {
        let finest = self.grid().len() as f64;
        let coarsest = self.nests.len() - 1;
        let mut convolutions = 0.0;
        let mut change: Option<([usize; 2], Vec<f64>)> = None;
        for index in (1..=coarsest).rev() {
            let nest = &mut self.nests[index];
            let before = nest.state.pressure.clone();
            convolutions += nest.solve(change, control, &self.settings, &mut |_| ()).1 / finest;
            let mut rise = before;
            field::update(&mut rise, |i, p| nest.state.pressure[i] - p);
            change = Some((nest.operator.grid().points(), rise));
        }
        let nest = &mut self.nests[0];
        let (mut report, work) = nest.solve(change, control, &self.settings, callback);
        if report.stop == StopReason::Converged && matches!(control, Control::Penetration(_)) && !nest.is_resolved() {
            report.stop = StopReason::Unresolved;
        }
        let Nest { texture, operator, state } = nest;
        let mut displacement = vec![0.0; texture.shape.len()];
        let certificate = Certificate::new(operator, &texture.shape, control, state, &mut displacement);
        let solution = Solution {
            pressure: state.pressure.clone(),
            displacement,
            gap: state.gap.clone(),
            penetration: state.penetration,
            report,
            certificate,
            convolutions: convolutions + work / finest + 1.0,
        };
        if !report.stop.solved() {
            // A spoilt solution is no start for the next step.
            self.nests.iter_mut().for_each(|nest| nest.state.pressure.fill(0.0));
        }
        solution
    }
}

impl Nest {
    fn contact<'a>(
        &'a self,
        hierarchy: &'a Hierarchy,
        pressure: &'a [f64],
        gap: &'a [f64],
        penetration: f64,
    ) -> Contact<'a> {
        let Hierarchy { transfer, contact_modulus, levels, .. } = hierarchy;
        let (grid, texture) = (self.operator.grid(), &self.texture);
        Contact {
            grid,
            texture,
            levels: *levels,
            transfer,
            contact_modulus: *contact_modulus,
            pressure,
            gap,
            penetration,
        }
    }

    /// Whether contact is wider than the grid's spacing, on the average of the indenters that touch.
    fn is_resolved(&self) -> bool {
        let Texture { owner, sites, .. } = &self.texture;
        let (mut pressed, mut indenters) = (0, vec![false; sites.len().max(1)]);
        for index in (0..self.state.pressure.len()).filter(|&i| self.state.pressure[i] > 0.0) {
            pressed += 1;
            indenters[owner.get(index).map_or(0, |&site| site as usize)] = true;
        }
        pressed > UNRESOLVED * indenters.into_iter().filter(|&touches| touches).count()
    }

    /// Solves on this grid after adding the `change` of the next coarser one; also gives convolutions times samples.
    fn solve(
        &mut self,
        change: Option<([usize; 2], Vec<f64>)>,
        control: Control,
        settings: &Settings,
        callback: &mut dyn FnMut(Progress),
    ) -> (Report, f64) {
        let grid = self.operator.grid();
        let (points, samples) = (grid.points(), grid.len() as f64);
        if let Some((from, change)) = change {
            let rise = resample(&change, from, points, Interpolation::on(grid.cell()));
            // A change below the tolerance is none: it would leave traces of pressure around the contact, which no
            // iteration takes away again where none is needed.
            let highest = -field::least(rise.len(), |i| -self.state.pressure[i]);
            let least = settings.tolerance * highest;
            field::update(&mut self.state.pressure, |i, p| if rise[i].abs() > least { p + rise[i] } else { p });
        }
        let before = self.operator.convolutions();
        let Self { texture, operator, state } = self;
        let report = solver::solve(operator, &texture.shape, control, settings, state, callback);
        (report, (operator.convolutions() - before) as f64 * samples)
    }
}

/// Peak of the memory that solving and reading on a finest grid of `points` takes, bytes.
///
/// Per sample of each grid: the solver's 5 fields and 1 flag, the shape and its owner, 2 multipliers and 2 spectra of
/// half the components; of the finest grid also the solution's 3 fields, one for interpolation, and what passes
/// from grid to grid. Per row and column of each grid: what its transforms need.
pub fn memory(points: [usize; 2], method: Method) -> usize {
    let (solver, texture, operator) = (5 * 8 + 1, 8 + 4, 2 * 4 + 2 * 8);
    let (solution, rows) = (4 * 8, 2048);
    // Changes from grid to grid.
    let passing = if method == Method::Preconditioned { 5 * 8 + 4 } else { 0 };
    let of_grid = |[n1, n2]: [usize; 2]| n1 * n2 * (solver + texture + operator) + (n1 + n2) * rows;
    let nested: usize = nested_points(points, method).into_iter().map(of_grid).sum();
    nested + points[0] * points[1] * (solution + passing)
}

impl fmt::Display for Hierarchy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let grids: Vec<String> = self.nests.iter().map(|nest| nest.operator.grid().points()[0].to_string()).collect();
        write!(f, "{}\nnested grids: {} points along a₁", self.grid(), grids.join(", "))
    }
}

/// Points of the nested grids, the finest first. The baseline has one grid.
fn nested_points(finest: [usize; 2], method: Method) -> Vec<[usize; 2]> {
    let coarser = |points: &[usize; 2]| {
        let halved = points.map(|n| fast_points(n.div_ceil(2)));
        (method == Method::Preconditioned && halved.iter().all(|&n| n >= COARSEST)).then_some(halved)
    };
    std::iter::successors(Some(finest), coarser).collect()
}
