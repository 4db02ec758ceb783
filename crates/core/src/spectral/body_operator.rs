//! The operator of the bodies of a problem: on a periodic cell, or in the window of an isolated contact.

use super::free_space::FreeSpaceOperator;
use super::layered_operator::LayeredOperator;
use super::operator::{ElasticOperator, Workspace};
use super::wear::GridWear;
use crate::body::Bodies;
use crate::lattice::Grid;
use crate::problem::Problem;

/// The operator of the bodies: on a periodic cell, or in the window of an isolated contact.
#[derive(Debug)]
pub(super) enum BodyOperator {
    Periodic(Box<LayeredOperator>),
    FreeSpace(Box<FreeSpaceOperator>),
}

impl BodyOperator {
    /// The operator of a problem, with its friction.
    pub fn new(problem: &Problem, grid: &Grid) -> Self {
        let bodies = problem.bodies();
        match (grid.cell().is_isolated(), problem.friction()) {
            (false, Some(friction)) => Self::Periodic(Box::new(LayeredOperator::sliding(grid, bodies, friction))),
            (false, None) => Self::Periodic(Box::new(LayeredOperator::new(grid, bodies))),
            (true, Some(friction)) => Self::FreeSpace(Box::new(FreeSpaceOperator::sliding(grid, bodies, friction))),
            (true, None) => Self::FreeSpace(Box::new(FreeSpaceOperator::new(grid, bodies))),
        }
    }

    /// Σ wᵢ Cᵢ of several bodies, without friction; only for [`Self::displace`].
    pub fn combined(grid: &Grid, bodies: &[(f64, &Bodies)]) -> Self {
        match grid.cell().is_isolated() {
            false => Self::Periodic(Box::new(LayeredOperator::combined(grid, bodies))),
            true => Self::FreeSpace(Box::new(FreeSpaceOperator::combined(grid, bodies))),
        }
    }

    /// p → w in place.
    pub fn displace(&mut self, field: &mut [f64], workspace: &mut Workspace) {
        match self {
            Self::Periodic(operator) => operator.displace(field, workspace),
            Self::FreeSpace(operator) => operator.displace(field, workspace),
        }
    }

    /// Adds the compliance of a step of wear.
    pub fn add_wear(&mut self, wear: &GridWear) {
        match self {
            Self::Periodic(operator) => operator.add_wear(wear),
            Self::FreeSpace(operator) => operator.add_wear(wear),
        }
    }

    /// Takes off the compliance of a step of wear.
    pub fn remove_wear(&mut self) {
        match self {
            Self::Periodic(operator) => operator.remove_wear(),
            Self::FreeSpace(operator) => operator.remove_wear(),
        }
    }

    /// Convolutions so far; one in single precision counts half.
    pub fn convolutions(&self) -> f64 {
        match self {
            Self::Periodic(operator) => operator.convolutions(),
            Self::FreeSpace(operator) => ElasticOperator::convolutions(operator.as_ref()),
        }
    }
}
