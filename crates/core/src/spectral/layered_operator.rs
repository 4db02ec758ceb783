//! The operator of layered half-spaces by convolutions: pressure on the samples of a grid → normal surface displacement.
//!
//! - On a periodic cell ŵ = C p̂, or C(1 − iT) p̂ under coupled friction, and the inverse is exact (`periodic_operator`).
//! - In free space w is the convolution with a [kernel](super::free_space), of which the transform H, or H − iG, is multiplied with on a
//!   padded grid; the C⁻¹ of the window repeated periodically stands for the inverse (`free_space`).
//!
//! The surfaces themselves may give way too for a while ([`LocalCompliance`]).

use super::by_rows::ByRows;
use super::convolution::Convolved;
use super::local_compliance::LocalCompliance;
use super::multiplier::{Action, Multiplier, SkewPart, SkewRatio};
use super::operator::{ElasticOperator, TractionUpdate, Workspace};
use super::resolvent::Resolvent;
use super::transforms::{Transforms, in_place};
use crate::lattice::Surroundings;
use crate::numeric::lanes::Real;
use crate::numeric::rows::RowBlocks;

/// Displacement operator of a layered half-space, or of two in contact, on a grid, with its inverse.
#[derive(Debug)]
pub struct LayeredOperator {
    transforms: Transforms,
    /// C, or the transform H of a kernel.
    compliance: Multiplier,
    /// Skew part that coupled friction adds.
    skew: Option<Skew>,
    /// Largest |C⁻¹(A − C)| without a local compliance.
    coupling: f64,
    /// Least part of the compliance of a wave that swelling by frictional heat leaves; 1 without heat.
    left: f64,
    /// Transforms and compliance of the window repeated periodically, of which the inverse is taken in free space; `None` on a periodic
    /// cell.
    repeated: Option<(Transforms, Multiplier)>,
    /// Compliance at the least wavenumber, and under a uniform pressure.
    unit: f64,
    mean: f64,
    softened: Softened,
    /// Parts of the operator under a strong skew part, once they were asked for.
    resolvent: Option<Box<Resolvent<Self>>>,
    convolutions: f64,
}

/// Skew part of an operator under coupled friction.
#[derive(Debug)]
pub(super) enum Skew {
    /// T: C(1 − iT).
    Ratio(SkewRatio),
    /// G: H − iG.
    Part(SkewPart),
}

/// Values that a local compliance has changed.
#[derive(Debug, Default)]
struct Softened {
    /// Compliance under a uniform pressure.
    mean: f64,
    /// Ratios T of before, by their index in the table.
    ratios: Vec<(usize, f64)>,
}

impl LayeredOperator {
    /// Operator of transforms and the multiplier between them, whose compliance at the least wavenumber is `unit`, on a periodic cell, where
    /// displacements have zero mean.
    pub(super) fn of(transforms: Transforms, compliance: Multiplier, unit: f64) -> Self {
        let (skew, repeated, softened) = (None, None, Softened::default());
        let (mean, coupling, convolutions, resolvent) = (0.0, 0.0, 0.0, None);
        let left = 1.0;
        Self { transforms, compliance, skew, coupling, left, repeated, unit, mean, softened, resolvent, convolutions }
    }

    /// The operator whose displacement under a uniform pressure is `mean` times that.
    pub(super) fn with_mean(self, mean: f64) -> Self {
        Self { mean, ..self }
    }

    /// The operator in free space, where the inverse is that of the window repeated periodically.
    pub(super) fn in_window(self, transforms: Transforms, compliance: Multiplier) -> Self {
        Self { repeated: Some((transforms, compliance)), ..self }
    }

    /// The operator under friction that couples, with its skew part and the largest |C⁻¹(A − C)|.
    pub(super) fn coupled(self, skew: Skew, coupling: f64) -> Self {
        Self { skew: Some(skew), coupling, ..self }
    }

    /// The operator of which swelling by heat leaves a part of the compliance of a wave at least.
    pub(super) fn with_left(self, left: f64) -> Self {
        Self { left, ..self }
    }

    /// Least part of the compliance of a wave that swelling by frictional heat leaves, 1 without heat: no steady state is unique from 0 down.
    pub fn left_by_heat(&self) -> f64 {
        self.left
    }

    /// Convolutions so far; one in single precision counts half.
    pub fn convolutions(&self) -> f64 {
        self.convolutions + self.resolvent.as_ref().map_or(0.0, |parts| parts.convolutions())
    }

    /// The largest part |C⁻¹(A − C)| that coupling adds to the operator A, on a periodic cell |T|, without a local
    /// compliance; 0 without coupling.
    pub fn coupling(&self) -> f64 {
        self.coupling
    }

    /// p → w: displacement into the body (a length), from pressure and the traction that goes with it; on a periodic cell with zero mean
    /// unless a body has a rigid base.
    pub fn displacement(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        // On the threads that share the work, where no pass has to wake them.
        rayon::scope(|_| self.displace(field, workspace));
    }

    /// p → w in single precision, as iterations use it for changes.
    pub fn displacement_single(&mut self, field: &mut [f32], workspace: &mut Workspace) {
        self.convolutions += 0.5;
        in_place(&self.transforms.single, self.multiplied(1.0), &self.compliance, field, workspace);
    }

    /// The operator's symmetric part C in the place of the operator, for as long as `use_of` runs.
    pub(super) fn symmetric<R>(&mut self, use_of: impl FnOnce(&mut Self) -> R) -> R {
        let (skew, coupling) = (self.skew.take(), std::mem::take(&mut self.coupling));
        let result = use_of(self);
        (self.skew, self.coupling) = (skew, coupling);
        result
    }

    /// w → p: the pressure that displaces so. Where displacements have zero mean it is treated like a component of the least
    /// wavenumber. In free space it is that of the window repeated periodically, without friction.
    pub fn pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        let action = match &self.skew {
            Some(Skew::Ratio(ratio)) => Action::DivideSkewed(1.0, ratio),
            _ => Action::Divide(1.0),
        };
        let (transforms, compliance) = self.inverse();
        in_place(&transforms.double, action, compliance, field, workspace);
        self.convolutions += 1.0;
    }

    /// Adds a local compliance, in the place of one before. What the traction of coupled friction displaces stays as
    /// it is.
    pub(super) fn soften(&mut self, local: &LocalCompliance) {
        self.restore();
        let points = self.transforms.double.points();
        let lines = if self.repeated.is_some() { local.of_lines_padded(points) } else { local.of_lines() };
        add(local, lines, &self.transforms, &mut self.compliance);
        if let Some((transforms, compliance)) = &mut self.repeated {
            add(local, local.of_lines(), transforms, compliance);
        }
        let ratios = match &mut self.skew {
            Some(Skew::Ratio(ratio)) => ratio.keep_part(&self.compliance),
            _ => Vec::new(),
        };
        self.softened = Softened { mean: local.mean(), ratios };
    }

    /// Takes off a local compliance: the operator is that of before, bit for bit.
    pub(super) fn restore(&mut self) {
        self.resolvent = None;
        let Softened { ratios, .. } = std::mem::take(&mut self.softened);
        self.compliance.restore();
        if let Some((_, compliance)) = &mut self.repeated {
            compliance.restore();
        }
        if let Some(Skew::Ratio(ratio)) = &mut self.skew {
            ratio.restore(&ratios);
        }
    }

    /// Numbers of the tables of compliance.
    #[cfg(test)]
    pub(super) fn numbers(&self) -> usize {
        self.compliance.len() + self.repeated.as_ref().map_or(0, |(_, compliance)| compliance.len())
    }

    /// Multiplication with the compliance and a common factor, and with what coupled friction adds.
    fn multiplied(&self, factor: f64) -> Action<'_> {
        match &self.skew {
            None => Action::Multiply(factor),
            Some(Skew::Ratio(ratio)) => Action::MultiplySkewed(factor, ratio),
            Some(Skew::Part(part)) => Action::MultiplyComplex(factor, part),
        }
    }

    /// Transforms and compliance of which the inverse is taken.
    fn inverse(&self) -> (&Transforms, &Multiplier) {
        self.repeated
            .as_ref()
            .map_or((&self.transforms, &self.compliance), |(transforms, compliance)| (transforms, compliance))
    }
}

impl ElasticOperator for LayeredOperator {
    type Parts = Resolvent<Self>;
    type Rows<'a, T: Real> = Convolved<'a, T>;

    fn blocks(&self) -> RowBlocks {
        self.transforms.double.blocks()
    }

    fn surroundings(&self) -> Surroundings {
        if self.repeated.is_some() { Surroundings::FreeSpace } else { Surroundings::Periodic }
    }

    fn unit(&self) -> f64 {
        self.unit + self.softened.mean
    }

    fn mean_compliance(&self) -> f64 {
        match self.surroundings() {
            Surroundings::Periodic => self.mean + self.softened.mean,
            Surroundings::FreeSpace => 0.0,
        }
    }

    fn coupling(&self) -> f64 {
        self.coupling
    }

    fn convolutions(&self) -> f64 {
        self.convolutions()
    }

    fn split<'a>(&self, workspace: &'a mut Workspace) -> (&'a mut [f64], &'a mut [f32]) {
        let ([n1, n2], (inverse, _)) = (self.blocks().points(), self.inverse());
        let single = self.transforms.single.memory().max(inverse.single.memory());
        let double = self.transforms.double.memory().max(inverse.double.memory());
        // A tile of few columns in single precision has as many bytes as one in double precision.
        let (memory, rest) = workspace.of(double.max(single + (n1 * n2).div_ceil(2))).split_at_mut(single);
        (memory, &mut bytemuck::cast_slice_mut(rest)[..n1 * n2])
    }

    fn displaced<'a>(&'a mut self, workspace: &'a mut Workspace, pressure: impl ByRows<f64>) -> Convolved<'a, f64> {
        self.convolutions += 1.0;
        let memory = workspace.of(self.transforms.double.memory());
        self.transforms.double.convolve(self.multiplied(1.0), &self.compliance, memory, pressure)
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
        self.transforms.single.convolve(action, &self.compliance, memory, pressure)
    }

    fn preconditioned<'a>(&'a mut self, memory: &'a mut [f64], residual: impl ByRows<f32>) -> Convolved<'a, f32> {
        self.convolutions += 0.5;
        let (transforms, compliance) = self.inverse();
        transforms.single.convolve(Action::Divide(self.unit()), compliance, memory, residual)
    }

    fn symmetric_pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.convolutions += 1.0;
        let (transforms, compliance) = self.inverse();
        in_place(&transforms.double, Action::Divide(1.0), compliance, field, workspace);
    }

    fn whole_pressure(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        self.pressure(field, workspace);
    }

    fn resolvent(&mut self) -> Option<&mut Resolvent<Self>> {
        let Some(Skew::Ratio(skew)) = &self.skew else { return None };
        if self.resolvent.is_none() {
            let magnitude = self.compliance.magnitude(skew);
            let magnitude = Self::of(self.transforms.clone(), magnitude, self.unit()).with_mean(self.mean_compliance());
            let parts = self.compliance.with_magnitude(skew);
            self.resolvent = Some(Box::new(Resolvent::new(magnitude, self.transforms.double.clone(), parts)));
        }
        self.resolvent.as_deref_mut()
    }
}

/// Adds a local compliance, with that of `lines` by its components, to a multiplier of `transforms`.
fn add(local: &LocalCompliance, lines: Vec<([usize; 2], f64)>, transforms: &Transforms, compliance: &mut Multiplier) {
    let index = transforms.double.indices();
    let lines = lines.into_iter().filter_map(|(component, value)| Some((index(component)?, value)));
    compliance.add(local.uniform(), &lines.collect::<Vec<_>>());
}
