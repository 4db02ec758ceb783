//! The operator of layered half-spaces: pressure on the cell → normal surface displacement.
//!
//! ŵ(q) = C(q) p̂(q) with the layered compliance C(q) at the shortest alias of each grid wavevector; its inverse makes the
//! preconditioner. Both are diagonal in Fourier space. Under coupled friction the traction μ p **e** displaces too,
//!
//! ŵ = (C − iμK cos θ) p̂ = C(1 − iT) p̂,  T = μ (K/C) cos θ,
//!
//! θ between **q** and **e**: a skew part, which is odd in **q**, so that tied aliases are averaged and what is its own
//! conjugate has none.
//!
//! The mean displacement of a half-space is infinite and left out; that of layers on a rigid base is the mean pressure times
//! [`Bodies::mean_compliance`].

use super::by_rows::{ByRows, ResultRows, rows_of, rows_to};
use super::convolution::{Convolution, Convolved};
use super::multiplier::{Action, Multiplier, SkewRatio};
use super::operator::{ElasticOperator, TractionUpdate, Workspace};
use super::wear::GridWear;
use crate::body::{Bodies, Compliances};
use crate::friction::Friction;
use crate::lattice::Grid;
use crate::numeric::lanes::Real;
use crate::numeric::rows::RowBlocks;

/// Displacement operator of a layered half-space, or of two in contact, on a grid, with its inverse.
#[derive(Debug)]
pub struct LayeredOperator {
    double: Convolution<f64>,
    single: Convolution<f32>,
    compliance: Multiplier,
    /// T, and the largest |T|, under coupled friction.
    skew: Option<(SkewRatio, f64)>,
    /// Compliance at the least wavenumber, and under a uniform pressure.
    unit: f64,
    mean: f64,
    worn: AddedWear,
    convolutions: f64,
}

/// What a step of wear has added.
#[derive(Debug, Default)]
struct AddedWear {
    /// Compliance under a uniform pressure.
    mean: f64,
    /// Ratios T of before, by their index in the table.
    ratios: Vec<(usize, f64)>,
}

impl LayeredOperator {
    /// Operator of the bodies on a grid, without friction.
    pub fn new(grid: &Grid, bodies: impl Into<Bodies>) -> Self {
        Self::combined(grid, &[(1.0, &bodies.into())])
    }

    /// Σ wᵢ Cᵢ of several bodies, without friction.
    pub(super) fn combined(grid: &Grid, bodies: &[(f64, &Bodies)]) -> Self {
        let own = bodies.iter().map(|(weight, own)| (*weight, Compliances::new(own, range(grid), grid.len() / 2)));
        let compliances: Vec<(f64, Compliances<'_>)> = own.collect();
        Self::with(grid, &compliances)
    }

    /// Operator of the bodies on a grid, the counterbody sliding with `friction`.
    pub fn sliding(grid: &Grid, bodies: impl Into<Bodies>, friction: &Friction) -> Self {
        let bodies = bodies.into();
        let [x, y] = friction.traction();
        if !friction.couples() {
            return Self::new(grid, bodies);
        }
        let compliances = Compliances::coupled(&bodies, range(grid), grid.len() / 2);
        let compliances = [(1.0, compliances)];
        let own = Self::with(grid, &compliances);
        let [(_, compliances)] = compliances;
        let ratio = |component| match grid.mean_direction(component) {
            [0.0, 0.0] => 0.0,
            [nx, ny] => (x * nx + y * ny) * compliances.coupling_ratio(grid.wavenumber(component)),
        };
        let skew = own.double.skew_ratio(|[k1, k2], values| {
            values.iter_mut().zip(k2..).for_each(|(value, k2)| *value = ratio([k1, k2]));
        });
        let largest = skew.largest();
        Self { skew: Some((skew, largest)), ..own }
    }

    /// Σ wᵢ Cᵢ of several compliances.
    fn with(grid: &Grid, compliances: &[(f64, Compliances<'_>)]) -> Self {
        let (double, single) = (Convolution::new(grid.points()), Convolution::new(grid.points()));
        let at = |k: f64| compliances.iter().map(|(weight, own)| weight * own.at(k)).sum::<f64>();
        let unit = at(grid.least_wavenumber());
        let mean: f64 = compliances.iter().map(|(weight, own)| weight * own.mean()).sum();
        // Where displacements have zero mean the inverse must stay positive: it takes the mean for a component of the least
        // wavenumber.
        let compliance = double.multiplier(grid.cell().is_rectangular(), |first, values| {
            grid.wavenumbers(first, values);
            if first == [0, 0] {
                values[0] = grid.least_wavenumber();
            }
            match compliances {
                [(1.0, own)] => own.replace(values),
                _ => values.iter_mut().for_each(|k| *k = at(*k)),
            }
            if first == [0, 0] && mean != 0.0 {
                values[0] = mean;
            }
        });
        let compliance = if mean != 0.0 { compliance } else { compliance.dropping_mean() };
        Self { double, single, compliance, skew: None, unit, mean, worn: AddedWear::default(), convolutions: 0.0 }
    }

    /// Convolutions so far; one in single precision counts half.
    pub fn convolutions(&self) -> f64 {
        self.convolutions
    }

    /// The largest part |T| that coupling adds to the operator, without the compliance of a step of wear; 0 without coupling.
    pub fn coupling(&self) -> f64 {
        self.skew.as_ref().map_or(0.0, |&(_, largest)| largest)
    }

    /// p → w: displacement into the body (a length), with zero mean unless a body has a rigid base, from pressure and the traction that goes with it.
    pub fn displacement(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        // On the threads that share the work, where no pass has to wake them.
        rayon::scope(|_| self.displace(field, workspace));
    }

    /// p → w in single precision, as iterations use it for changes.
    pub fn displacement_single(&mut self, field: &mut [f32], workspace: &mut Workspace) {
        self.convolutions += 0.5;
        let action = self.multiplied(1.0);
        in_place(&self.single, action, &self.compliance, field, workspace);
    }

    /// w → p: the pressure that displaces so. Where displacements have zero mean it is treated like a component of the least
    /// wavenumber.
    pub fn pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        let action = self.skew.as_ref().map_or(Action::Divide(1.0), |(ratio, _)| Action::DivideSkewed(1.0, ratio));
        in_place(&self.double, action, &self.compliance, field, workspace);
    }

    /// Adds the compliance k_c Δs of every wave and k_b Δs of those constant along the path of a step of wear. What the traction of
    /// coupled friction displaces stays as it is.
    pub(super) fn add_wear(&mut self, wear: &GridWear) {
        self.remove_wear();
        let index = self.double.indices();
        let along = wear.along().into_iter().filter_map(|(component, value)| Some((index(component)?, value)));
        self.compliance.add(wear.uniform(), &along.collect::<Vec<_>>());
        let ratios = self.skew.as_mut().map(|(skew, _)| skew.keep_part(&self.compliance)).unwrap_or_default();
        self.worn = AddedWear { mean: wear.mean(), ratios };
    }

    /// Takes off the compliance of a step of wear: the operator is that of before, bit for bit.
    pub(super) fn remove_wear(&mut self) {
        let AddedWear { ratios, .. } = std::mem::take(&mut self.worn);
        self.compliance.restore();
        if let Some((skew, _)) = &mut self.skew {
            skew.restore(&ratios);
        }
    }

    /// Multiplication with the compliance and a common factor, and with 1 − iT under coupled friction.
    fn multiplied(&self, factor: f64) -> Action<'_> {
        self.skew.as_ref().map_or(Action::Multiply(factor), |(ratio, _)| Action::MultiplySkewed(factor, ratio))
    }
}

impl ElasticOperator for LayeredOperator {
    type Rows<'a, T: Real> = Convolved<'a, T>;

    fn blocks(&self) -> RowBlocks {
        self.double.blocks()
    }

    fn unit(&self) -> f64 {
        self.unit + self.worn.mean
    }

    fn mean_compliance(&self) -> f64 {
        self.mean + self.worn.mean
    }

    fn coupling(&self) -> f64 {
        self.coupling()
    }

    fn convolutions(&self) -> f64 {
        self.convolutions
    }

    fn split<'a>(&self, workspace: &'a mut Workspace) -> (&'a mut [f64], &'a mut [f32]) {
        let [n1, n2] = self.blocks().points();
        // Of few columns a tile in single precision has as many bytes as those in double precision.
        let single = self.single.memory();
        let size = self.double.memory().max(single + (n1 * n2).div_ceil(2));
        let (memory, rest) = workspace.of(size).split_at_mut(single);
        (memory, &mut bytemuck::cast_slice_mut(rest)[..n1 * n2])
    }

    fn displaced<'a>(&'a mut self, workspace: &'a mut Workspace, pressure: impl ByRows<f64>) -> Convolved<'a, f64> {
        self.convolutions += 1.0;
        let memory = workspace.of(self.double.memory());
        self.double.convolve(self.multiplied(1.0), &self.compliance, memory, pressure)
    }

    fn displaced_single<'a>(
        &'a mut self,
        traction: TractionUpdate,
        memory: &'a mut [f64],
        pressure: impl ByRows<f32>,
    ) -> Convolved<'a, f32> {
        self.convolutions += 0.5;
        let factor = 1.0 / self.unit();
        let action = match traction {
            TractionUpdate::Updated => self.multiplied(factor),
            TractionUpdate::Lagged => Action::Multiply(factor),
        };
        self.single.convolve(action, &self.compliance, memory, pressure)
    }

    fn preconditioned<'a>(&'a mut self, memory: &'a mut [f64], residual: impl ByRows<f32>) -> Convolved<'a, f32> {
        self.convolutions += 0.5;
        self.single.convolve(Action::Divide(self.unit()), &self.compliance, memory, residual)
    }

    fn symmetric_pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        in_place(&self.double, Action::Divide(1.0), &self.compliance, field, workspace);
    }
}

/// Least and largest wavenumber of a grid.
fn range(grid: &Grid) -> [f64; 2] {
    [grid.least_wavenumber(), grid.largest_wavenumber()]
}

fn in_place<T: Real>(
    convolution: &Convolution<T>,
    action: Action<'_>,
    compliance: &Multiplier,
    field: &mut [T],
    workspace: &mut Workspace,
) {
    let (blocks, memory) = (convolution.blocks(), workspace.of(convolution.memory()));
    rayon::scope(|_| {
        let convolved = convolution.convolve(action, compliance, memory, rows_of(blocks, field));
        convolved.rows(rows_to(blocks, field));
    });
}
