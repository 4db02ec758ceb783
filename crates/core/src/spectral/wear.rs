//! Wear by implicit steps: Archard's law ∂h/∂s = k p on both bodies while the counterbody slides along **e**.
//!
//! The counterbody wears where it presses, Δh_c = k_c Δs p. The body is swept, so that every point of it meets all pressures on its line
//! along **e**: Δh_b = k_b Δs ⟨p⟩ with the mean along **e** ([`sliding_mean`](super::sliding_mean)). With the pressure at the **end** of
//! the step Δs (Euler's implicit method) both depths add to the gap,
//!
//! g = C p + f + k_c Δs p + k_b Δs ⟨p⟩ − δ:
//!
//! contact with the compliance Ĉ(**q**) + k_c Δs + k_b Δs \[**q**·**e** = 0\], the wave **q** = 0 included. It is symmetric and
//! positive, so that a step of any length is stable, has one solution, and has its certificate. Afterwards f ← f + Δh_c + Δh_b: with the
//! compliance of the bodies alone the same pressure solves the contact of the worn surfaces. The error of a step is O(Δs²), that of a path
//! O(Δs); [paths](crate::run::WearPath) are made of such steps and of [wear by known pressures](Solver::wear_by), and err by O(Δs²).
//!
//! In complete contact a wave of the pressure falls by 1/(1 + kΔs/Ĉ) in each step, and → e^{−ks/Ĉ}.
//!
//! For the step alone the operators of all grids have this [local compliance](LocalCompliance) beside that of the bodies ([`Wearing`]): they
//! know nothing of wear.

use super::grid_level::GridLevel;
use super::local_compliance::LocalCompliance;
use super::sliding_mean::{SlidingMean, vector_along};
use super::wear_error::WearError;
use super::worn::Worn;
use super::{Progress, Solver, Step};
use crate::body::Side;
use crate::lattice::{Cell, Grid, Surroundings};
use crate::load::Load;
use crate::problem::Problem;
use std::ops::ControlFlow;

/// Coefficients of wear of both bodies and the direction of sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wear {
    body: f64,
    counterbody: f64,
    direction: [f64; 2],
    stroke: Option<f64>,
}

impl Wear {
    /// Wear with the coefficients k_b ≥ 0 of the `body` and k_c ≥ 0 of the `counterbody`, one over a pressure, while the counterbody
    /// slides in a `direction` of any length.
    ///
    /// # Errors
    /// [`WearError::Coefficient`] and [`WearError::Direction`] for values out of range.
    pub fn new(body: f64, counterbody: f64, direction: [f64; 2]) -> Result<Self, WearError> {
        if let Some(wrong) = [body, counterbody].into_iter().find(|k| !(k.is_finite() && *k >= 0.0)) {
            return Err(WearError::Coefficient(wrong));
        }
        let length = direction[0].hypot(direction[1]);
        if !(length.is_finite() && length > 0.0) {
            return Err(WearError::Direction(direction));
        }
        Ok(Self { body, counterbody, direction, stroke: None })
    }

    /// Wear of the surfaces of a problem by their own coefficients, along the direction of its friction, or along x without any.
    pub fn of(problem: &Problem) -> Self {
        let [body, counterbody] = [Side::Body, Side::Counterbody].map(|side| problem.bodies().wear(side));
        Self { body, counterbody, direction: problem.direction(), stroke: None }
    }

    /// Wear by an isolated contact that goes to and fro over a `stroke` L, a length: while it slides Δs, each point of its track is
    /// passed Δs/L times, and is worn by k_b (Δs/L) ∫p dx along the track. Without it L is the width of the window along the
    /// direction of sliding, over which the track goes.
    ///
    /// # Errors
    /// [`WearError::Stroke`] unless it is positive and finite.
    pub fn with_stroke(self, stroke: f64) -> Result<Self, WearError> {
        if !(stroke.is_finite() && stroke > 0.0) {
            return Err(WearError::Stroke(stroke));
        }
        Ok(Self { stroke: Some(stroke), ..self })
    }

    /// Coefficient of one surface, one over a pressure.
    pub fn coefficient(&self, side: Side) -> f64 {
        match side {
            Side::Body => self.body,
            Side::Counterbody => self.counterbody,
        }
    }

    /// Stroke of an isolated contact, a length; `None` where it is the width of the window.
    pub fn stroke(&self) -> Option<f64> {
        self.stroke
    }

    /// Stroke by which points of a track are passed, a length; `None` on a periodic cell, which is passed once in each period.
    pub(crate) fn stroke_on(&self, cell: Cell) -> Option<f64> {
        match cell.surroundings() {
            Surroundings::Periodic => None,
            Surroundings::FreeSpace => self.stroke,
        }
    }

    /// Refuses a direction along which a body cannot wear.
    ///
    /// # Errors
    /// [`WearError::Oblique`] in a window unless the direction is along a side.
    pub fn check(&self, cell: Cell) -> Result<(), WearError> {
        vector_along(cell, self.direction).map(|_| ())
    }

    /// Direction of sliding, of any length.
    pub fn direction(&self) -> [f64; 2] {
        self.direction
    }

    /// Compliance of the surfaces of a grid that wear over a `distance` Δs of sliding: k_b Δs under the mean along the path, times the
    /// width of the window over the stroke around an isolated contact, and k_c Δs under the pressure of a sample.
    pub(super) fn compliance(&self, distance: f64, grid: &Grid) -> Result<LocalCompliance, WearError> {
        let body = self.body * distance;
        let on_lines = if body > 0.0 {
            let mean = SlidingMean::new(grid, self.direction)?;
            Some((body * passes(self, grid), mean))
        } else {
            None
        };
        Ok(LocalCompliance::new(grid.points(), on_lines, self.counterbody * distance))
    }
}

/// A solver whose surfaces wear: while this lives its operators have the local compliance of the step.
struct Wearing<'a>(&'a mut Solver);

impl<'a> Wearing<'a> {
    /// Adds a compliance to the operator of each grid.
    fn new(solver: &'a mut Solver, compliances: &[LocalCompliance]) -> Self {
        solver.levels.iter_mut().zip(compliances).for_each(|(level, compliance)| level.operator().soften(compliance));
        Self(solver)
    }
}

impl Drop for Wearing<'_> {
    fn drop(&mut self) {
        self.0.levels.iter_mut().for_each(|level| level.operator().restore());
    }
}

/// Width of the window along the path over the stroke of an isolated contact; 1 on a periodic cell.
fn passes(wear: &Wear, grid: &Grid) -> f64 {
    let [a1, a2] = grid.cell().vectors();
    match wear.stroke_on(grid.cell()) {
        Some(stroke) => {
            let along = if wear.direction[0].abs() > wear.direction[1].abs() { a1 } else { a2 };
            along[0].hypot(along[1]) / stroke
        }
        None => 1.0,
    }
}

impl Solver {
    /// Slides a `distance` Δs under a load in one implicit step, by which both surfaces wear, and returns the contact of the worn
    /// surfaces at the end of the step.
    ///
    /// Every grid wears by its own pressure. The [initial gap](crate::Surface::initial_gap) of the step, and of what is solved after it, is
    /// that of the worn surfaces, measured from where these touch first: a penetration δ counts at the start of the step from the first
    /// touch of the surfaces as they are, and the [penetration](Step::penetration) of the step from that of the worn ones, which lies
    /// deeper by what [`Worn::recession`] has grown. The [certificate](Step::certificate) is that of the contact with the compliance of
    /// the step. A step that is not [solved](super::Stop::solved) wears nothing.
    ///
    /// # Errors
    /// [`WearError`] for a distance that is negative or not finite, a direction that the window does not allow, and a given pressure.
    pub fn wear(&mut self, load: Load, wear: &Wear, distance: f64) -> Result<Step, WearError> {
        self.wear_with_progress(load, wear, distance, &mut |_| ControlFlow::Continue(()))
    }

    /// [`Self::wear`] with `progress`, called after each iteration on the finest grid; `Break` ends the step as
    /// [interrupted](super::Stop::Interrupted).
    ///
    /// # Errors
    /// [`WearError`] as for [`Self::wear`].
    pub fn wear_with_progress(
        &mut self,
        load: Load,
        wear: &Wear,
        distance: f64,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> Result<Step, WearError> {
        if !(distance.is_finite() && distance >= 0.0) {
            return Err(WearError::Distance(distance));
        }
        if self.problem().kind().is_given {
            return Err(WearError::Given);
        }
        let on_grids = on_grids(self, wear, distance)?;
        let step = Wearing::new(self, &on_grids).0.solve_with_progress(load, progress);
        if !step.report.stop.solved() {
            return Ok(step);
        }
        let (report, convolutions, coarser) = (step.report, step.convolutions, step.coarser.len());
        drop(step);
        self.wear_off(&on_grids, |_, level| level.unknowns().pressure.to_vec(), distance);
        Ok(self.step(load, report, convolutions, coarser))
    }

    /// Takes off all grids what pressures wear, those of a grid by its number.
    pub(super) fn wear_off(
        &mut self,
        on_grids: &[LocalCompliance],
        pressures: impl Fn(usize, &GridLevel) -> Vec<f64>,
        distance: f64,
    ) {
        let mut worn = self.worn.take().unwrap_or_else(|| Worn::none(self.grid()));
        for (number, (level, compliance)) in self.levels.iter_mut().zip(on_grids).enumerate() {
            let depths = compliance.displacements(&pressures(number, level));
            let whole = depths.iter().flatten().cloned().reduce(|all, depth| all + depth);
            let recession = whole.map_or(0.0, |whole| level.wear_by(&whole));
            if number == 0 {
                worn.add(depths, distance, recession);
            }
        }
        self.worn = Some(worn);
    }
}

/// Compliances of wear over a `distance` of sliding on all grids of a solver.
pub(super) fn on_grids(solver: &Solver, wear: &Wear, distance: f64) -> Result<Vec<LocalCompliance>, WearError> {
    solver.levels.iter().map(|level| wear.compliance(distance, level.surface().grid())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::friction::Friction;
    use crate::spectral::LayeredOperator;
    use crate::spectral::by_rows::{ResultRows, rows_of, rows_to};
    use crate::spectral::operator::{ElasticOperator, TractionUpdate, Workspace};

    fn layers() -> Vec<Layer> {
        vec![Layer::new(Material::from_shear(3.0, 0.2).unwrap(), 0.2, Interface::Bonded).unwrap()]
    }

    fn coated() -> HalfSpace {
        HalfSpace::new(layers(), Material::from_shear(1.0, 0.3).unwrap())
    }

    fn on_rigid_base() -> HalfSpace {
        HalfSpace::on_rigid_base(layers()).unwrap()
    }

    fn noise(len: usize) -> Vec<f64> {
        (0..len).map(|k| ((k * k * 7919 + k * 131) % 1009) as f64 / 1009.0).collect()
    }

    fn difference(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
    }

    /// Displacement in double and in single precision.
    fn displaced(operator: &mut impl ElasticOperator, p: &[f64]) -> [Vec<f64>; 2] {
        let (mut workspace, mut double) = (Workspace::default(), p.to_vec());
        operator.displace(&mut double, &mut workspace);
        let single: Vec<f32> = p.iter().map(|&p| p as f32).collect();
        let (blocks, mut w, unit) = (operator.blocks(), vec![0.0f32; p.len()], operator.unit());
        let (memory, _) = operator.split(&mut workspace);
        let rows = operator.displaced_single(TractionUpdate::Updated, memory, rows_of(blocks, &single));
        rows.rows(rows_to(blocks, &mut w));
        [double, w.into_iter().map(|w| unit * f64::from(w)).collect()]
    }

    /// Displacement of the plain operator, with k_c Δs p + k_b Δs ⟨p⟩, and plain again.
    fn check(operator: &mut LayeredOperator, grid: &Grid, wear: &LocalCompliance) {
        let p = noise(grid.len());
        let plain = displaced(operator, &p);
        let (unit, mean) = (operator.unit(), operator.mean_compliance());
        operator.soften(wear);
        let worn = displaced(operator, &p);
        let mut expected = plain[0].clone();
        for depth in wear.displacements(&p).iter().flatten() {
            expected.iter_mut().zip(depth).for_each(|(w, depth)| *w += depth);
        }
        let scale = expected.iter().fold(0.0f64, |most, w| most.max(w.abs()));
        let errors = worn.map(|worn| difference(&worn, &expected) / scale);
        assert!(errors[0] < 2e-15 && errors[1] < 1e-6, "{grid}: {errors:?} with {wear:?}");
        assert!((operator.unit() - unit - wear.mean()).abs() < 1e-14 * operator.unit());
        operator.restore();
        assert_eq!(displaced(operator, &p), plain, "{grid}: not restored");
        assert_eq!((operator.unit(), operator.mean_compliance()), (unit, mean));
    }

    /// Sliding along the path and across, coupled: what the traction displaces is not changed by wear.
    #[test]
    fn a_step_adds_the_depths_that_are_worn_in_it() {
        let cells = [
            (Cell::hexagonal(1.0), [24, 24]),
            (Cell::hexagonal(1.0), [15, 15]),
            (Cell::square(2.0), [17, 20]),
            (Cell::new([1.0, 0.2], [0.4, 0.9]), [14, 9]),
        ];
        for (cell, points) in cells {
            let grid = Grid::new(cell.unwrap(), points).unwrap();
            for parts in [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, -2.0], [1.0, 0.77]] {
                let direction = grid.cell().vector(parts);
                for [body, counterbody] in [[0.0, 1e-3], [0.2, 0.0], [30.0, 0.7], [1e6, 1e5]] {
                    let wear = Wear::new(body, counterbody, direction).unwrap();
                    let wear = wear.compliance(0.5, &grid).unwrap();
                    let friction = Friction::new(0.8, [0.6, -0.8]).unwrap();
                    let bodies = coated();
                    for mut operator in [
                        LayeredOperator::new(&grid, &bodies),
                        LayeredOperator::new(&grid, on_rigid_base()),
                        LayeredOperator::sliding(&grid, &bodies, &friction),
                        LayeredOperator::sliding(&grid, &bodies, &Friction::new(0.8, direction).unwrap()),
                    ] {
                        check(&mut operator, &grid, &wear);
                    }
                }
            }
        }
    }

    /// C⁻¹ with the compliance of wear undoes C with it, on pressures with a mean only on a rigid base.
    #[test]
    fn the_inverse_has_the_compliance_of_wear_too() {
        let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [18, 15]).unwrap();
        let wear = Wear::new(0.4, 0.3, [1.0, 0.0]).unwrap();
        let wear = wear.compliance(1.0, &grid).unwrap();
        for (bodies, mean) in [(coated(), 0.0), (on_rigid_base(), 1.0)] {
            let mut operator = LayeredOperator::new(&grid, bodies);
            operator.soften(&wear);
            let mut p = noise(grid.len());
            let average = p.iter().sum::<f64>() / p.len() as f64;
            p.iter_mut().for_each(|p| *p += mean - average);
            let mut back = p.clone();
            operator.displace(&mut back, &mut Workspace::default());
            operator.symmetric_pressure(&mut back, &mut Workspace::default());
            assert!(difference(&back, &p) < 1e-13, "{:e}", difference(&back, &p));
        }
    }

    /// The matrix of the kernel with k_c on its diagonal, and of the body the same entry for all pairs of samples on a line.
    #[test]
    fn in_free_space_a_step_adds_the_depths_of_a_groove() {
        for (points, sides) in [([12, 9], [2.0, 1.0]), ([9, 16], [1.0, 1.0])] {
            let grid = Grid::new(Cell::window(sides).unwrap(), points).unwrap();
            for direction in [[1.0, 0.0], [0.0, -2.0]] {
                for (k, stroke) in
                    [([0.0, 1e-3], None), ([0.3, 0.0], None), ([20.0, 0.5], Some(7.0)), ([1e5, 1e6], None)]
                {
                    let wear = Wear::new(k[0], k[1], direction).unwrap();
                    let wear = stroke.map_or(wear, |stroke| wear.with_stroke(stroke).unwrap());
                    let compliance = wear.compliance(0.5, &grid).unwrap();
                    for mut operator in [
                        LayeredOperator::in_free_space(&grid, coated()),
                        LayeredOperator::sliding_in_free_space(
                            &grid,
                            coated(),
                            &Friction::new(0.5, direction).unwrap(),
                        ),
                    ] {
                        check(&mut operator, &grid, &compliance);
                    }
                    // k_b (Δs/L) ∫p dx of a single sample, on its line.
                    let mut p = vec![0.0; grid.len()];
                    p[3 * points[1] + 4] = 2.0;
                    let [body, counterbody] = compliance.displacements(&p);
                    let axis = usize::from(direction[0] == 0.0);
                    let length = stroke.unwrap_or(sides[axis]);
                    let expected = k[0] * 0.5 / length * 2.0 * sides[axis] / points[axis] as f64;
                    for ((i, j), &depth) in body.iter().flat_map(|body| body.indexed_iter()) {
                        let on_line = [j == 4, i == 3][axis];
                        assert!((depth - if on_line { expected } else { 0.0 }).abs() < 1e-14 * expected);
                    }
                    assert!(counterbody.is_none_or(|depth| depth[[3, 4]] == k[1] && depth.sum() == k[1]));
                }
            }
        }
    }

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(Wear::new(-1.0, 0.0, [1.0, 0.0]), Err(WearError::Coefficient(-1.0)));
        assert!(Wear::new(0.0, f64::NAN, [1.0, 0.0]).is_err());
        assert_eq!(Wear::new(0.0, 0.0, [0.0, 0.0]), Err(WearError::Direction([0.0, 0.0])));
        let wear = Wear::new(1.0, 2.0, [1.0, 0.0]).unwrap();
        assert_eq!(wear.with_stroke(0.0), Err(WearError::Stroke(0.0)));
        assert_eq!((wear.coefficient(Side::Body), wear.coefficient(Side::Counterbody)), (1.0, 2.0));
    }
}
