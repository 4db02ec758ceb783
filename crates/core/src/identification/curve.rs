//! The indentation curve of a model: δ(P) and its derivatives by parameters, at nodes in ln P, and between them.
//!
//! Each node has a window of its own, which its contact fills by [`FILLED`]: a contact in free space does not depend on
//! the window, so that all nodes have as many samples across the contact. ln δ is smooth in ln P for one indenter of
//! any shape: it is interpolated at Chebyshev nodes.

use crate::counterbody::Indenters;
use crate::lattice::{Cell, Lattice};
use crate::load::Load;
use crate::notation::number;
use crate::problem::Problem;
use crate::spectral::{AdhesiveError, Settings, Solver, Stop};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Part of its window that the diameter of a contact takes up.
const FILLED: f64 = 0.7;
/// Parts with which a window is kept.
const KEPT: [f64; 2] = [0.55, 0.85];
/// Largest number of windows tried for a load.
const TRIALS: usize = 40;
/// Samples along a side on which windows are tried.
const COARSE: usize = 32;
/// Nodes for a load alone, and more for each factor e of the loads.
const NODES: [f64; 2] = [4.0, 0.9];
/// Most nodes of a curve, whose loads are solved at the same time.
pub const MOST_NODES: usize = 12;

/// Why a model has no indentation curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// Not one indenter alone.
    #[error(
        "an indentation curve is that of one indenter alone: lattice.kind = \"isolated\" with a single level and a single site"
    )]
    NotAlone,
    /// Friction couples the pressure to its traction.
    #[error("friction that couples to the pressure has no tangent: leave out [friction]")]
    Coupled,
    /// Surfaces that adhere, of which loading and unloading are no curve of their own.
    #[error(
        "loading and unloading are fitted without adhesion: take the curve of drawing off (--segment retraction), or leave out [adhesion]"
    )]
    Adheres,
    /// Surfaces that do not adhere.
    #[error("a curve of drawing off is that of surfaces that adhere: add [adhesion] with a work and a range")]
    NoAdhesion,
    /// A grid that does not resolve the tension.
    #[error(transparent)]
    Adhesive(#[from] AdhesiveError),
    /// A state on the way off that is not solved.
    #[error("the contact at the penetration {} is not solved: {}", number(*.0), .1)]
    NotFollowed(f64, Stop),
    /// A load that is not solved.
    #[error("the contact under the force {} is not solved: {}", number(*.0), .1)]
    NotSolved(f64, Stop),
}

/// A node of a curve.
#[derive(Debug, Clone)]
struct Node {
    penetration: f64,
    /// Derivatives of δ by the parameters, lengths.
    derivatives: Vec<f64>,
    /// Radius of a disc of the area in contact, a length.
    radius: f64,
    /// Largest pressure; the mean one where that under a tip is infinite.
    peak: f64,
    /// Estimated relative error of the discretisation.
    error: Option<f64>,
}

/// The indentation curve of a model.
#[derive(Debug, Clone)]
pub struct IndentationCurve {
    /// ln P at the nodes.
    places: Vec<f64>,
    nodes: Vec<Node>,
}

/// A model at values of its parameters, and its difference quotients by each: weights and problems.
pub struct Perturbed {
    pub problem: Problem,
    pub quotients: Vec<Vec<(f64, Problem)>>,
}

impl IndentationCurve {
    /// The curve for loads between two forces. `windows` are those of the nodes of an earlier curve, or of any size, and are updated.
    pub fn new(
        model: &Perturbed,
        [least, most]: [f64; 2],
        points: usize,
        settings: Settings,
        windows: &mut Vec<f64>,
    ) -> Result<Self, CurveError> {
        check(&model.problem)?;
        let places = places([least.ln(), most.ln()]);
        let (side, are_known) = (model.problem.cell().vectors()[0][0], !windows.is_empty());
        windows.resize(places.len(), side);
        let solved: Result<Vec<Node>, CurveError> = places
            .par_iter()
            .zip(windows.par_iter_mut())
            .map(|(place, window)| {
                node(model, place.exp(), [points, if are_known { points } else { COARSE }], settings, window)
            })
            .collect();
        Ok(Self { places, nodes: solved? })
    }

    /// δ under a force, a length, and its derivatives.
    pub fn at(&self, force: f64) -> (f64, Vec<f64>) {
        let weights = self.weights(force.ln());
        let interpolated = |of: &dyn Fn(&Node) -> f64| -> f64 {
            weights.iter().zip(&self.nodes).map(|(weight, node)| weight * of(node)).sum()
        };
        let penetration = interpolated(&|node| node.penetration.ln()).exp();
        let count = self.nodes.first().map_or(0, |node| node.derivatives.len());
        let derivative = |k: usize| penetration * interpolated(&|node| node.derivatives[k] / node.penetration);
        (penetration, (0..count).map(derivative).collect())
    }

    /// Largest pressure under a force, the mean one under a tip, whose largest is infinite.
    pub fn peak(&self, force: f64) -> f64 {
        self.weights(force.ln())
            .iter()
            .zip(&self.nodes)
            .map(|(weight, node)| weight * node.peak.ln())
            .sum::<f64>()
            .exp()
    }

    /// Least and largest contact radius, lengths.
    pub fn radii(&self) -> [f64; 2] {
        let radii = || self.nodes.iter().map(|node| node.radius);
        [radii().fold(f64::INFINITY, f64::min), radii().fold(0.0, f64::max)]
    }

    /// Largest estimated relative error of δ by the discretisation; `None` where none is known.
    pub fn error(&self) -> Option<f64> {
        self.nodes.iter().filter_map(|node| node.error).reduce(f64::max)
    }

    /// Weights of the nodes at a place, by the barycentric formula of Chebyshev nodes of the first kind.
    fn weights(&self, x: f64) -> Vec<f64> {
        if let Some(node) = self.places.iter().position(|&place| (place - x).abs() < 1e-13 * (1.0 + x.abs())) {
            return (0..self.places.len()).map(|k| f64::from(u8::from(k == node))).collect();
        }
        let count = self.places.len() as f64;
        let weight = |(k, place): (usize, &f64)| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            sign * (PI * (k as f64 + 0.5) / count).sin() / (x - place)
        };
        let weights: Vec<f64> = self.places.iter().enumerate().map(weight).collect();
        let sum: f64 = weights.iter().sum();
        weights.into_iter().map(|weight| weight / sum).collect()
    }
}

/// Refuses problems of other contacts than that of one indenter alone without coupled friction and adhesion.
pub fn check(problem: &Problem) -> Result<(), CurveError> {
    problem.lone_indenter().ok_or(CurveError::NotAlone)?;
    if problem.friction().is_some_and(crate::friction::Friction::couples) {
        return Err(CurveError::Coupled);
    }
    if problem.adhesion().is_some() {
        return Err(CurveError::Adheres);
    }
    Ok(())
}

/// Chebyshev nodes between two places, which they do not reach.
fn places([least, most]: [f64; 2]) -> Vec<f64> {
    let length = most - least;
    let [alone, more] = NODES;
    let count = if length < 1e-9 { 1 } else { ((alone + more * length).ceil() as usize).min(MOST_NODES) };
    let node = |k: usize| least + 0.5 * length * (1.0 - (PI * (k as f64 + 0.5) / count as f64).cos());
    (0..count).map(node).collect()
}

/// The problem with its indenter in the middle of a square window of another side.
fn in_window(problem: &Problem, side: f64) -> Problem {
    let levels = problem.levels().to_vec();
    let lattice = Cell::window([side; 2]).and_then(|cell| Lattice::new(cell, vec![vec![[0.5; 2]]]));
    let indenters = Indenters::new(lattice.expect("a window of a positive side"), levels);
    Problem::new(indenters.expect("the level of a valid problem"), problem.bodies().clone())
}

/// Solves a load in a window that its contact fills well, and finds the derivatives there; the first window that is tried has
/// `first_points`.
fn node(
    model: &Perturbed,
    force: f64,
    [points, first_points]: [usize; 2],
    settings: Settings,
    window: &mut f64,
) -> Result<Node, CurveError> {
    let mut last = Stop::AtBorder;
    for trial in 0..TRIALS {
        let is_coarse = trial == 0 && first_points < points;
        let points = if is_coarse { first_points } else { points };
        let mut solver =
            Solver::new(in_window(&model.problem, *window), [points; 2], settings).expect("a grid with samples");
        let step = solver.solve(Load::Force(force));
        last = step.report.stop;
        let spacing = *window / points as f64;
        let touching = step.pressure().iter().filter(|p| **p > 0.0).count() as f64;
        let radius = spacing * (touching / PI).sqrt();
        if last == Stop::AtBorder {
            *window *= 1.7;
            continue;
        }
        if !last.solved() || radius < 2.0 * spacing {
            *window *= 0.4;
            continue;
        }
        let part = 2.0 * radius / *window;
        if !(KEPT[0]..KEPT[1]).contains(&part) {
            *window = 2.0 * radius / FILLED;
            continue;
        }
        if is_coarse {
            continue;
        }
        let Some(tangent) = solver.tangent() else { break };
        let derivative = |quotient: &Vec<(f64, Problem)>| {
            let moved: Vec<(f64, Problem)> =
                quotient.iter().map(|(weight, problem)| (*weight, in_window(problem, *window))).collect();
            let all: Vec<(f64, &Problem)> = moved.iter().map(|(weight, problem)| (*weight, problem)).collect();
            tangent.penetration(step.finest(), &all)
        };
        let penetration = step.penetration();
        let reading = step.reading();
        let error = reading.errors.penetration.map(|error| error / penetration);
        let peak = reading.finite_peak().unwrap_or(force / (PI * radius * radius));
        let derivatives = model.quotients.iter().map(derivative).collect();
        return Ok(Node { penetration, derivatives, radius, peak, error });
    }
    Err(CurveError::NotSolved(force, last))
}
