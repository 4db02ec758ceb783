//! The elastic operator as the iteration uses it: pressure on the samples of a grid → normal displacement of the surface.
//!
//! A body is an implementation of [`ElasticOperator`]; the iteration calls nothing else of it. Fields pass
//! through `ByRows`.

use super::by_rows::{ByRows, ResultRows, rows_of, rows_to};
use crate::lattice::Surroundings;
use crate::numeric::aligned::Aligned;
use crate::numeric::lanes::Real;
use crate::numeric::rows::RowBlocks;

/// Memory that convolutions work in, for any number of grids in turn.
#[derive(Debug, Default)]
pub struct Workspace {
    memory: Aligned<f64>,
}

impl Workspace {
    /// `size` numbers, allocated anew where there are fewer so far.
    pub(super) fn of(&mut self, size: usize) -> &mut [f64] {
        if self.memory.len() < size {
            self.memory = Aligned::new(size);
        }
        &mut self.memory[..size]
    }
}

/// Pressure to which the traction of coupled friction belongs while the pressure changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TractionUpdate {
    /// The present one: the traction is updated in every step.
    Updated,
    /// The last one in double precision: the traction lags behind.
    Lagged,
}

/// Parts into which a strongly coupled operator A = C + B is split: its magnitude M = |A|, wave by wave, and the resolvent (A + M)⁻¹.
pub trait SkewParts {
    /// Symmetric and positive operator M.
    type Magnitude: ElasticOperator;

    /// The magnitude M.
    fn magnitude(&mut self) -> &mut Self::Magnitude;

    /// w → (A + M)⁻¹ w in place. Where displacements have zero mean it is treated like a component of the least wavenumber.
    fn resolve(&mut self, field: &mut [f64], workspace: &mut Workspace);
}

/// Linear elastic operator A of a body on a grid: w = A p. C is its symmetric part; without coupled friction A = C.
///
/// In periodic [surroundings](Surroundings) w has zero mean and C is positive on pressures without mean, unless a uniform pressure
/// displaces by a [mean compliance](Self::mean_compliance): where that is positive, C is positive on all pressures, and contact bears any
/// penetration. Otherwise contact is complete from the mean of the initial gap on. C⁻¹ is exact. In free space C is positive on all
/// pressures, and what stands for C⁻¹ is only near to it: good for a preconditioner, not for a bound.
///
/// Pressures and displacements that count are in double precision; what only leads to them is in single precision, in units
/// in which C at the least wavenumber is one.
pub trait ElasticOperator {
    /// Magnitude and resolvent under a skew part.
    type Parts: SkewParts;
    /// Result in either precision.
    type Rows<'a, T: Real>: ResultRows<T>
    where
        Self: 'a;

    /// The blocks of the rows that sources and sinks belong to.
    fn blocks(&self) -> RowBlocks;

    /// Surroundings of the samples.
    fn surroundings(&self) -> Surroundings {
        Surroundings::Periodic
    }

    /// C at the least wavenumber, a length per pressure: the unit of single precision.
    fn unit(&self) -> f64;

    /// w under a uniform pressure, over the pressure, in periodic surroundings; 0 where w has zero mean.
    fn mean_compliance(&self) -> f64 {
        0.0
    }

    /// Largest |C⁻¹(A − C)|, by which the part of coupled friction exceeds or falls below the symmetric one; 0 without it.
    fn coupling(&self) -> f64;

    /// Convolutions so far; one in single precision counts half.
    fn convolutions(&self) -> f64;

    /// The memory of a convolution in double precision in two: that of one in single precision, and a field in single
    /// precision that lasts until the next convolution in double precision.
    fn split<'a>(&self, workspace: &'a mut Workspace) -> (&'a mut [f64], &'a mut [f32]);

    /// w = A p.
    fn displaced<'a>(&'a mut self, workspace: &'a mut Workspace, pressure: impl ByRows<f64>) -> Self::Rows<'a, f64>;

    /// Changes of p → changes of w, in single precision: by A with an updated traction, by C with a lagged one.
    fn displaced_single<'a>(
        &'a mut self,
        traction: TractionUpdate,
        memory: &'a mut [f64],
        pressure: impl ByRows<f32>,
    ) -> Self::Rows<'a, f32>;

    /// The preconditioner C⁻¹, or what is near to it, in single precision; where w has zero mean it is treated like a component of
    /// the least wavenumber.
    fn preconditioned<'a>(&'a mut self, memory: &'a mut [f64], residual: impl ByRows<f32>) -> Self::Rows<'a, f32>;

    /// w → C⁻¹ w in place, in double precision; where w has zero mean it is treated like a component of the least wavenumber. In free
    /// space it is the preconditioner.
    fn symmetric_pressure(&mut self, field: &mut [f64], workspace: &mut Workspace);

    /// w → A⁻¹ w in place, in double precision, where the operator has its [parts](Self::resolvent); where w has zero mean it is treated like a
    /// component of the least wavenumber. Else C⁻¹.
    fn whole_pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.symmetric_pressure(field, workspace);
    }

    /// Magnitude and resolvent of an operator with a skew part; `None` without one, and in free space, where nothing is divided by A.
    fn resolvent(&mut self) -> Option<&mut Self::Parts> {
        None
    }

    /// p → w = A p in place.
    fn displace(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        let blocks = self.blocks();
        self.displaced(workspace, rows_of(blocks, field)).rows(rows_to(blocks, field));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::lattice::{Cell, Grid};
    use crate::load::Control;
    use crate::spectral::LayeredOperator;
    use crate::spectral::iteration::{
        AdmissibleSet, ContactProblem, Method, Report, Settings, Stop, Unknowns, Working,
    };
    use rayon::prelude::*;
    use std::f64::consts::TAU;
    use std::ops::ControlFlow;

    /// A body given by the matrices of A = C and C⁻¹.
    struct Dense {
        blocks: RowBlocks,
        unit: f64,
        compliance: Vec<f64>,
        stiffness: Vec<f64>,
        products: f64,
    }

    struct Product<T> {
        blocks: RowBlocks,
        field: Vec<T>,
    }

    impl<T: Real> ResultRows<T> for Product<T> {
        fn some_rows(mut self, _: impl Fn(usize) -> bool + Sync, sinks: impl ByRows<T>) {
            let blocks = self.blocks.of_mut(&mut self.field).zip(sinks.into_par_iter());
            blocks.for_each(|(rows, mut sink)| rows.for_each(&mut sink));
        }
    }

    impl Dense {
        /// The matrices of a layered half-space, column by column.
        fn of(operator: &mut LayeredOperator, samples: usize) -> Self {
            let mut workspace = Workspace::default();
            let mut columns = |apply: &mut dyn FnMut(&mut LayeredOperator, &mut [f64], &mut Workspace)| {
                let mut column = |k: usize| {
                    let mut column = vec![0.0; samples];
                    column[k] = 1.0;
                    apply(operator, &mut column, &mut workspace);
                    column
                };
                (0..samples).flat_map(&mut column).collect::<Vec<f64>>()
            };
            let compliance = columns(&mut |operator, field, workspace| operator.displacement(field, workspace));
            let stiffness = columns(&mut |operator, field, workspace| operator.pressure(field, workspace));
            Self { blocks: operator.blocks(), unit: operator.unit(), compliance, stiffness, products: 0.0 }
        }

        fn product<T: Real>(&self, matrix: &[f64], factor: f64, sources: impl ByRows<T>) -> Product<T> {
            let [n1, n2] = self.blocks.points();
            let mut field = vec![T::zero(); n1 * n2];
            let blocks = self.blocks.of_mut(&mut field).zip(sources.into_par_iter());
            blocks.for_each(|(rows, mut source)| rows.for_each(&mut source));
            let mut sums = vec![0.0; field.len()];
            for (value, column) in field.iter().zip(matrix.chunks_exact(n1 * n2)) {
                let value = factor * value.double();
                sums.iter_mut().zip(column).for_each(|(sum, entry)| *sum += value * entry);
            }
            Product { blocks: self.blocks, field: sums.into_iter().map(T::rounded).collect() }
        }
    }

    impl ElasticOperator for Dense {
        type Parts = crate::spectral::resolvent::Resolvent<LayeredOperator>;
        type Rows<'a, T: Real> = Product<T>;

        fn blocks(&self) -> RowBlocks {
            self.blocks
        }

        fn unit(&self) -> f64 {
            self.unit
        }

        fn coupling(&self) -> f64 {
            0.0
        }

        fn convolutions(&self) -> f64 {
            self.products
        }

        fn split<'a>(&self, workspace: &'a mut Workspace) -> (&'a mut [f64], &'a mut [f32]) {
            let [n1, n2] = self.blocks.points();
            (&mut [], &mut bytemuck::cast_slice_mut(workspace.of((n1 * n2).div_ceil(2)))[..n1 * n2])
        }

        fn displaced<'a>(&'a mut self, _: &'a mut Workspace, pressure: impl ByRows<f64>) -> Product<f64> {
            self.products += 1.0;
            self.product(&self.compliance, 1.0, pressure)
        }

        fn displaced_single<'a>(
            &'a mut self,
            _: TractionUpdate,
            _: &'a mut [f64],
            pressure: impl ByRows<f32>,
        ) -> Product<f32> {
            self.products += 0.5;
            self.product(&self.compliance, 1.0 / self.unit, pressure)
        }

        fn preconditioned<'a>(&'a mut self, _: &'a mut [f64], residual: impl ByRows<f32>) -> Product<f32> {
            self.products += 0.5;
            self.product(&self.stiffness, self.unit, residual)
        }

        fn symmetric_pressure(&mut self, field: &mut [f64], _: &mut Workspace) {
            self.products += 1.0;
            let pressure = self.product(&self.stiffness, 1.0, rows_of(self.blocks, field));
            pressure.rows(rows_to(self.blocks, field));
        }
    }

    fn solved(operator: &mut impl ElasticOperator, gap: &[f64], load: Control, method: Method) -> (Report, Unknowns) {
        let mut unknowns = Unknowns::new(gap.len());
        let report = ContactProblem {
            working: &mut Working::default(),
            operator,
            initial_gap: gap,
            largest_gap: gap.iter().copied().fold(0.0, f64::max),
            admissible: AdmissibleSet::default(),
            load,
            settings: Settings { method, ..Settings::default() },
            outer: 0,
            progress: &mut |_| ControlFlow::Continue(()),
        }
        .solve(&mut unknowns);
        (report, unknowns)
    }

    /// A coated half-space by its convolutions, and by its assembled matrix as any other body.
    #[test]
    fn the_iteration_solves_with_any_elastic_operator() {
        let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [20, 24]).unwrap();
        let layer = Layer::new(Material::from_shear(4.0, 0.2).unwrap(), 0.1, Interface::Bonded).unwrap();
        let half_space = HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.3).unwrap());
        let mut layered = LayeredOperator::new(&grid, &half_space);
        let mut dense = Dense::of(&mut layered, grid.len());
        let wave = |i: usize| {
            let [s, t] = grid.fractions(i);
            0.01 * (3.0 - (TAU * s).cos() - (TAU * t).cos() - (TAU * (s + t)).cos())
        };
        let gap: Vec<f64> = (0..grid.len()).map(wave).collect();
        for method in [Method::Preconditioned, Method::PolonskyKeer] {
            for load in [Control::MeanPressure(0.02), Control::Penetration(0.01), Control::MeanPressure(2.0)] {
                let before = layered.convolutions();
                let (report, convolved) = solved(&mut layered, &gap, load, method);
                let (other, assembled) = solved(&mut dense, &gap, load, method);
                assert_eq!((report.stop, other.stop), (Stop::Converged, Stop::Converged), "{report}; {other}");
                let peak = convolved.pressure.iter().copied().fold(0.0, f64::max);
                let pairs = convolved.pressure.iter().zip(&*assembled.pressure);
                let error = pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
                assert!(error < 1e-5 * peak, "{method:?}, {load}: {error:e} of {peak}; {report}; {other}");
                assert!(layered.convolutions() > before && dense.convolutions() > 0.0);
            }
        }
    }
}
