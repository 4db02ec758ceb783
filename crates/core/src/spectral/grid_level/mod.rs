//! One of the nested grids of a problem: surface, operator and unknowns.
//!
//! `load_step`: a load solved on the grid; `given_pressure`: a load whose pressure is given.

mod given_pressure;
mod load_step;

use super::hysteresis::bound;
use super::iteration::{AdmissibleSet, Bounds, Unknowns, Working};
use super::operator::Workspace;
use super::{Contact, Hysteresis, LayeredOperator, MotionLoss, Tangent};
use crate::body::CompositeHardness;
use crate::counterbody::Surface;
use crate::kind::ContactKind;
use crate::lattice::Grid;
use crate::numeric::array::samples;
use crate::numeric::sums;
use crate::problem::Problem;
use ndarray::Array2;
use std::sync::Arc;

/// Most samples, per indenter, of a contact that is no wider than the spacing: an apex between samples may press the four
/// around it with any load from zero on.
const MAX_UNRESOLVED: usize = 4;

/// Permanent indentation: the surface without it, and the depths, lengths, one per sample, a₂ fastest.
pub(super) type Indented = (Arc<Surface>, Arc<Vec<f64>>);

/// A problem on one grid.
#[derive(Debug)]
pub(super) struct GridLevel {
    surface: Arc<Surface>,
    /// The surface before any load has pressed it in, with the depths that earlier loads have; `None` before.
    indented: Option<Indented>,
    /// The surface without the displacement that opens its gap; `None` where nothing does.
    flat: Option<Arc<Surface>>,
    largest_gap: f64,
    /// Whether contact may occur, one value per sample; `None`: everywhere.
    mask: Option<Vec<bool>>,
    /// Bounds of the pressure, 0 ≤ p ≤ H with the hardness of the softer surface; without that, and under a given pressure, p ≥ 0.
    bounds: Bounds,
    /// Law by which the hardness follows from the penetration; `None` where one holds at any.
    composite: Option<CompositeHardness>,
    operator: LayeredOperator,
    kind: ContactKind,
    /// A given pressure with the mean 1, one value per sample; `None` where contact is solved.
    given: Option<Vec<f64>>,
    unknowns: Unknowns,
    /// E* of the materials at the surfaces.
    modulus: f64,
}

/// The next coarser grid before and after its part of a load step.
pub(super) struct Coarser {
    pub grid: Arc<Grid>,
    pub before: Unknowns,
    pub after: Unknowns,
}

impl GridLevel {
    /// The problem on the grid of a surface; of its frictional heat the body has a `share`.
    pub fn new(problem: &Problem, surface: Surface, share: f64) -> Self {
        let (grid, bodies) = (surface.grid(), problem.bodies());
        let operator = LayeredOperator::of_problem(problem, grid, share);
        let given = problem.given_pressure().map(|given| {
            let (pressure, mean) = (given.on(grid), given.force() / grid.cell().area());
            pressure.into_iter().map(|p| p / mean).collect()
        });
        Self {
            unknowns: Unknowns::new(grid.len()),
            largest_gap: surface.largest(),
            indented: None,
            flat: None,
            mask: None,
            bounds: Bounds::up_to(problem.hardness().map_or(f64::INFINITY, |(hardness, _)| hardness)),
            composite: problem.composite_hardness().copied(),
            operator,
            kind: problem.kind(),
            given,
            modulus: bodies.contact_modulus(),
            surface: Arc::new(surface),
        }
    }

    /// [N₁, N₂].
    pub fn points(&self) -> [usize; 2] {
        self.surface.grid().points()
    }

    /// The counterbody's surface on the grid.
    pub fn surface(&self) -> &Arc<Surface> {
        &self.surface
    }

    /// Unknowns of the last load.
    pub fn unknowns(&self) -> &Unknowns {
        &self.unknowns
    }

    /// Sets the unknowns from which the next load starts.
    pub fn set_unknowns(&mut self, unknowns: Unknowns) {
        if let Some(composite) = &self.composite {
            self.bounds = Bounds::up_to(composite.at(unknowns.penetration));
        }
        self.unknowns = unknowns;
    }

    /// Drops the pressure of earlier loads.
    pub fn forget(&mut self) {
        self.unknowns = Unknowns::new(self.surface.grid().len());
    }

    /// Replaces the initial gap: restricts `finer` (f ≥ 0, lengths) to this grid, and gives the restricted one.
    pub fn give_gap(&mut self, finer: Array2<f64>) -> Array2<f64> {
        let gap = self.surface.restricted(&finer);
        self.surface = Arc::new(self.surface.with_initial_gap(gap.clone()));
        self.indented = None;
        self.largest_gap = self.surface.largest();
        self.forget();
        gap
    }

    /// Presses the surface in by these depths, lengths, in the place of those before: the pressure stays as the start of the next load.
    pub fn press_in(&mut self, depths: Arc<Vec<f64>>) {
        let before = self.indented.take();
        let (original, earlier) = match &before {
            Some((original, depths)) => (Arc::clone(original), &depths[..]),
            None => (Arc::clone(&self.surface), &[][..]),
        };
        let rise = |i: usize| depths[i] - earlier.get(i).copied().unwrap_or(0.0);
        sums::update(&mut Arc::make_mut(&mut self.unknowns.gap)[..], |i, g| g + rise(i));
        self.surface = Arc::new(original.opened(&depths));
        self.largest_gap = self.surface.largest();
        self.indented = Some((original, depths));
    }

    /// Least part of the compliance of a wave that swelling by frictional heat leaves; 1 without heat.
    pub fn left_by_heat(&self) -> f64 {
        self.operator.left_by_heat()
    }

    /// Opens the gap by displacements that the next pressure does not cause, lengths sample by sample, in the place of those before, and puts
    /// another operator for that pressure. Contacts keep the surface as it was.
    pub fn open(&mut self, lift: &[f64], operator: LayeredOperator) {
        let original = self.flat.take().unwrap_or_else(|| Arc::clone(&self.surface));
        self.surface = Arc::new(original.opened(lift));
        self.largest_gap = self.surface.largest();
        self.operator = operator;
        self.flat = Some(original);
    }

    /// The operator, which a local compliance may soften for a while.
    pub fn operator(&mut self) -> &mut LayeredOperator {
        &mut self.operator
    }

    /// The permanent depths that the initial gap contains, with the surface before them; `None` without any.
    pub fn indented(&self) -> Option<&Indented> {
        self.indented.as_ref()
    }

    /// Sets the initial gap of another moment, and the permanent depths that it contains.
    pub fn set_surface(&mut self, surface: Arc<Surface>, indented: Option<Indented>) {
        self.indented = indented;
        self.largest_gap = surface.largest();
        self.surface = surface;
    }

    /// Adds worn depths, lengths, to the initial gap under the same pressure, measured from where the surfaces touch first then; returns
    /// by how much farther that is, a length.
    pub fn wear_by(&mut self, depths: &Array2<f64>) -> f64 {
        let least = |gap: &[f64]| sums::least(gap.len(), |i| gap[i]);
        let mut gap = self.surface.initial_gap().to_owned();
        gap += depths;
        let recession = least(samples(&gap)) - least(self.surface.gaps());
        let worn = |surface: &Surface| {
            let mut gap = surface.initial_gap().to_owned();
            gap += depths;
            gap -= recession;
            Arc::new(surface.with_initial_gap(gap))
        };
        self.unknowns.penetration -= recession;
        let indented = self.indented.take().map(|(original, depths)| (worn(&original), depths));
        self.set_surface(worn(&self.surface), indented);
        recession
    }

    /// Confines contact to the nearest samples of a mask on the finest grid.
    pub fn give_mask(&mut self, finest: &Array2<bool>) {
        let (points, from) = (self.points(), [finest.nrows(), finest.ncols()]);
        // ⌊i N/n + ½⌋ mod N.
        let nearest = |axis: usize, i: usize| (2 * i * from[axis] + points[axis]) / (2 * points[axis]) % from[axis];
        let of = |(i, j)| finest[[nearest(0, i), nearest(1, j)]];
        let mask: Vec<bool> = Array2::from_shape_fn(points, of).into_iter().collect();
        self.mask = mask.contains(&false).then_some(mask);
        self.forget();
    }

    /// Whether contact may occur at any sample.
    pub fn has_admissible(&self) -> bool {
        AdmissibleSet::new(self.mask.as_deref()).is_anywhere()
    }

    /// Working memory for this grid and all coarser ones.
    pub fn working_memory(&self) -> Working {
        Working::of_finest(&self.operator)
    }

    /// Least mean pressure of complete contact: that of the pressure which displaces the surface by mean f − f.
    pub fn full_contact_pressure(&mut self) -> f64 {
        let mean = self.surface.mean();
        let mut pressure: Vec<f64> = self.surface.gaps().iter().map(|f| f - mean).collect();
        // In free space that of the window repeated: a pressure of the order at which contact fills it.
        self.operator.pressure(&mut pressure, &mut Workspace::default());
        -sums::least(pressure.len(), |i| -pressure[i])
    }

    /// The contact of the last load on this grid, under the composite hardness that it has met.
    pub fn contact(&self, problem: &Arc<Problem>) -> Contact {
        let problem = &match self.composite {
            Some(_) => Arc::new(problem.with_surface_hardness(self.bounds.largest())),
            None => Arc::clone(problem),
        };
        let Unknowns { pressure, gap, penetration, .. } = &self.unknowns;
        let indented = self.indented.as_ref().map(|(_, depths)| Arc::clone(depths));
        let surface = self.flat.as_ref().unwrap_or(&self.surface);
        Contact::new(problem, surface, Arc::clone(pressure), Arc::clone(gap), *penetration).after(indented)
    }

    /// The tangent of the last load, see [`Tangent`]; `None` without contact.
    pub fn tangent(&mut self, problem: &Arc<Problem>) -> Option<Tangent> {
        let contact = self.contact(problem);
        self.tangent_of(&contact)
    }

    /// The tangent of a contact on this grid; `None` without contact.
    pub fn tangent_of(&mut self, contact: &Contact) -> Option<Tangent> {
        Tangent::new(&mut self.operator, contact)
    }

    /// Adds to the initial gap of an `original` surface what heat lifts, lengths on the next finer grid or this one; gives what it is on this one.
    pub fn lift(&mut self, original: &Arc<Surface>, finer: &Array2<f64>) -> Array2<f64> {
        let lift = original.restricted(finer);
        let gap = &original.initial_gap() + &lift;
        self.set_surface(Arc::new(original.with_initial_gap(gap)), None);
        lift
    }

    /// Friction by hysteresis of the last load, on this grid and on `coarser` ones; `None` without contact. The certificate becomes the sharper one
    /// of a monotone problem.
    pub fn motion_loss(&mut self, contact: &Contact, coarser: &[Contact]) -> Option<MotionLoss> {
        let finest = Hysteresis::of(contact)?;
        let grids = std::iter::once(finest).chain(coarser.iter().map_while(Hysteresis::of)).collect();
        let loss_tangent = self.operator.coupling();
        if self.given.is_some() {
            return Some(MotionLoss { grids, bound: 0.0, loss_tangent });
        }
        let (working, mask) = (&mut self.working_memory(), self.mask.as_deref());
        let [bound, part] = bound(&mut self.operator, working, mask, (contact, &self.unknowns));
        let gap = &mut self.unknowns.certificate.energy_gap;
        *gap = gap.min(part);
        Some(MotionLoss { grids, bound, loss_tangent })
    }

    /// Whether an isolated contact reaches the border of its window; a given pressure may.
    pub fn reaches_border(&self) -> bool {
        let grid = self.surface.grid();
        let ([n1, n2], pressure) = (grid.points(), &self.unknowns.pressure);
        let rows = || (0..n2).flat_map(|j| [j, (n1 - 1) * n2 + j]);
        let columns = || (0..n1).flat_map(|i| [i * n2, i * n2 + n2 - 1]);
        self.kind.is_indentation() && rows().chain(columns()).any(|index| pressure[index] > 0.0)
    }

    /// Whether contact is wider than the grid's spacing, on the average of the indenters that touch; a given pressure always is.
    pub fn is_resolved(&self) -> bool {
        if self.kind.is_given {
            return true;
        }
        let (owners, pressure) = (self.surface.owners(), &self.unknowns.pressure);
        let (mut pressed, mut indenters) = (0, vec![false; self.surface.sites().len().max(1)]);
        for index in (0..pressure.len()).filter(|&i| pressure[i] > 0.0) {
            pressed += 1;
            indenters[owners.get(index).map_or(0, |&site| site as usize)] = true;
        }
        pressed > MAX_UNRESOLVED * indenters.into_iter().filter(|&touches| touches).count()
    }
}
