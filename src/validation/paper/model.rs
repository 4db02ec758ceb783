//! The model of a figure: a case of the paper, with changes, and the methods that answer it.

use super::apart::{self, Law};
use crate::case::{Case, embedded};
use crate::exact::Coating;
use crate::indenter::{Level, Shape, drops};
use crate::localized::{self, CircleRadius, LevelReading, Localized, Setup, Stop};
use crate::observables::{LevelObservables, Observables};
use crate::refinement::balanced_points;
use crate::solver::Control;
use crate::texture::Surface;
use crate::validation::steps::Steps;
use crate::validation::{Data, StudyError};
use std::sync::OnceLock;

/// A case with one coating whose substrate has E₂ = 1, and one indenter of each level in its cell.
#[derive(Debug)]
pub struct Model {
    case: Case,
    law: OnceLock<Law>,
}

/// One level's indenters as isolated paraboloids.
#[derive(Debug, Clone, Copy)]
pub struct Indenter {
    /// Radius of curvature r_m, a length.
    pub curvature: f64,
    /// Drop d_m, a length.
    pub drop: f64,
}

/// What a method says of one indenter of a level.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LevelAnswer {
    /// Force on it.
    pub load: f64,
    /// Its peak pressure.
    pub peak: f64,
    /// Its contact radius √(area/π); none for merged contacts and without contact.
    pub radius: Option<f64>,
}

/// What a method says of a load step.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Penetration = additional displacement w_a, a length.
    pub penetration: f64,
    /// From the highest level down.
    pub levels: Vec<LevelAnswer>,
}

/// A way to answer a model.
struct Method {
    /// Suffix of its columns.
    name: &'static str,
    solve: fn(&Model, f64, usize) -> Result<Answer, StudyError>,
}

/// Indenters in the circles and elements across the largest contact of the localized column.
const INDENTERS: usize = 37;
const ELEMENTS: usize = 48;

/// Every method that the tables of the figures compare.
const METHODS: [Method; 3] = [
    Method {
        name: "spectral",
        solve: |model, mean_pressure, points| Ok(model.steps(points)?.loaded(mean_pressure)?.into()),
    },
    Method { name: "localized", solve: |model, mean_pressure, _| model.localized(mean_pressure, INDENTERS, ELEMENTS) },
    Method { name: "apart", solve: |model, mean_pressure, _| apart::solve(model, mean_pressure) },
];

impl Model {
    /// The embedded case `name`, changed by `overrides`, each `KEY=VALUE`.
    pub fn new(name: &str, overrides: &[&str]) -> Result<Self, StudyError> {
        let source = embedded::source(name).ok_or_else(|| format!("no embedded case {name}"))?;
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let case = Case::read(&source, &overrides).map_err(|error| error.render(false))?;
        Ok(Self { case, law: OnceLock::new() })
    }

    /// The case.
    pub fn case(&self) -> &Case {
        &self.case
    }

    /// Load steps on `points` × `points` samples.
    pub fn steps(&self, points: usize) -> Result<Steps, StudyError> {
        Steps::of(&self.case, points)
    }

    /// Load steps on a grid as dense along both cell vectors as `points` are along the side of a rhombus of that area.
    pub fn steps_as_dense(&self, points: usize) -> Result<Steps, StudyError> {
        let cell = self.case.surface().cell();
        let side = (cell.area() / 0.75f64.sqrt()).sqrt();
        let shorter = cell.vectors().map(|a| a[0].hypot(a[1])).into_iter().fold(f64::INFINITY, f64::min);
        let along = balanced_points(&cell, (points as f64 * shorter / side).round() as usize);
        Steps::new(self.case.surface(), self.case.half_space(), along)
    }

    /// Area of the cell.
    pub fn area(&self) -> f64 {
        self.case.surface().cell().area()
    }

    /// Side of the cell, the length that contacts are small against.
    pub fn period(&self) -> f64 {
        self.area().sqrt()
    }

    /// Distance l of neighbouring indenters in the three-fold arrangement of three levels.
    pub fn distance(&self) -> f64 {
        (self.area() / (1.5 * 3f64.sqrt())).sqrt()
    }

    /// Thickness h of the coating, a length.
    pub fn thickness(&self) -> f64 {
        self.case.half_space().interface_depths()[0]
    }

    /// Young's modulus E₁ of the coating, in units of E₂.
    pub fn coating_young(&self) -> f64 {
        self.case.half_space().surface_material().young()
    }

    /// The coating for the closed forms.
    pub fn coating(&self) -> Result<Coating, StudyError> {
        let body = self.case.half_space();
        let (coating, substrate) = (body.surface_material(), body.substrate());
        let chi = coating.shear() / substrate.shear();
        Ok(Coating::new(chi, [coating.poisson(), substrate.poisson()], self.thickness())?)
    }

    /// The law of one paraboloid of R = 1 on the coating.
    pub fn law(&self) -> Result<&Law, StudyError> {
        if self.law.get().is_none() {
            // Another thread may have been first: the same law.
            let _ = self.law.set(Law::new(&self.coating()?, self.period())?);
        }
        self.law.get().ok_or_else(|| "no law".into())
    }

    /// The indenters, one a level.
    pub fn indenters(&self) -> Result<Vec<Indenter>, StudyError> {
        let Surface::Indenters { levels, .. } = self.case.surface() else { return Err("no indenters".into()) };
        let indenter = |(level, drop): (&Level, f64)| match level.shape() {
            Shape::Paraboloid { radius } => Ok(Indenter { curvature: radius, drop }),
            other => Err(format!("{other} is no paraboloid").into()),
        };
        levels.iter().zip(drops(levels)).map(indenter).collect()
    }

    /// The paper's method with load-balanced circles: the system and its solution.
    pub fn localized_solution(
        &self,
        mean_pressure: f64,
        indenters: usize,
        elements: usize,
    ) -> Result<(Localized, localized::Solution), StudyError> {
        let Surface::Indenters { lattice, levels } = self.case.surface() else { return Err("no indenters".into()) };
        let system = Localized::new(lattice, levels, self.case.half_space(), indenters);
        let setup = Setup { indenters, elements, radius: CircleRadius::LoadBalanced, mutual_effect: true };
        let solution = system.solve(Control::MeanPressure(mean_pressure), &setup);
        if solution.stop != Stop::Converged {
            return Err(format!("localized solution at {mean_pressure}: {}", solution.stop).into());
        }
        Ok((system, solution))
    }

    /// The same as an answer.
    pub fn localized(&self, mean_pressure: f64, indenters: usize, elements: usize) -> Result<Answer, StudyError> {
        let (system, solution) = self.localized_solution(mean_pressure, indenters, elements)?;
        let level = |level: LevelReading| LevelAnswer {
            load: level.load,
            peak: level.max_pressure,
            radius: Some(level.contact_radius).filter(|_| level.load > 0.0),
        };
        let levels = system.observe(&solution).into_iter().map(level).collect();
        Ok(Answer { penetration: solution.penetration, levels })
    }

    /// Without mutual effect under the nominal pressure.
    pub fn apart(&self, mean_pressure: f64) -> Result<Answer, StudyError> {
        apart::solve(self, mean_pressure)
    }

    /// Every method's answer at one load: a row a level, `<quantity>_<method>` a column.
    pub fn methods(&self, name: &'static str, mean_pressure: f64, points: usize) -> Result<Data, StudyError> {
        let answers: Result<Vec<Answer>, _> =
            METHODS.iter().map(|method| (method.solve)(self, mean_pressure, points)).collect();
        let answers = answers?;
        let quantities = ["load", "peak", "radius", "penetration"];
        let columns =
            METHODS.iter().flat_map(|method| quantities.map(|quantity| format!("{quantity}_{}", method.name)));
        let rows = (0..answers[0].levels.len()).map(|m| {
            let values = answers.iter().flat_map(|answer| {
                let level = answer.levels[m];
                [level.load, level.peak, level.radius.unwrap_or(0.0), answer.penetration]
            });
            std::iter::once((m + 1) as f64).chain(values).collect()
        });
        Ok(Data { name, columns: std::iter::once("level".to_owned()).chain(columns).collect(), rows: rows.collect() })
    }
}

impl From<Observables> for Answer {
    fn from(found: Observables) -> Self {
        let level = |level: &LevelObservables| LevelAnswer {
            load: level.load,
            peak: level.max_pressure,
            radius: level.contact_radius,
        };
        Self { penetration: found.penetration, levels: found.levels.iter().map(level).collect() }
    }
}
