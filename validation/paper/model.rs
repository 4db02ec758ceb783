//! The model of a figure: a case of the paper, with changes, and the methods that answer it.

use super::apart::{self, Indenter, Law};
use crate::exact::Coating;
use crate::steps::Steps;
use crate::{Data, StudyError};
use percoat_case::case::{Case, embedded};
use percoat_core::comparison::Answer;
use percoat_core::counterbody::{Level, Shape};
use percoat_core::load::Load;
use percoat_core::localized::{self, CircleRadius, Localized, Setup, Stop};
use percoat_core::run::balanced_points;
use percoat_core::spectral::{Settings, Solver};
use std::sync::{Arc, OnceLock};

/// A case with one coating whose substrate has E₂ = 1, and one indenter of each level in its cell.
#[derive(Debug)]
pub struct Model {
    case: Case,
    law: OnceLock<Law>,
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
        solve: |model, mean_pressure, points| Ok((&model.steps(points)?.loaded(mean_pressure)?).into()),
    },
    Method { name: "localized", solve: |model, mean_pressure, _| model.localized(mean_pressure, INDENTERS, ELEMENTS) },
    Method { name: "apart", solve: |model, mean_pressure, _| model.apart(mean_pressure) },
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
        let cell = self.case.problem().cell();
        let side = (cell.area() / 0.75f64.sqrt()).sqrt();
        let shorter = cell.vectors().map(|a| a[0].hypot(a[1])).into_iter().fold(f64::INFINITY, f64::min);
        let along = balanced_points(&cell, (points as f64 * shorter / side).round() as usize);
        Ok(Steps { solver: Solver::new(Arc::clone(self.case.problem()), along, Settings::default())? })
    }

    /// Area of the cell.
    pub fn area(&self) -> f64 {
        self.case.problem().cell().area()
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
        let (coating, substrate) = (body.surface_material(), body.material(2));
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
        let indenters = self.case.problem().indenters().ok_or("no indenters")?;
        let indenter = |(level, drop): (&Level, f64)| match level.shape() {
            Shape::Paraboloid { radius } => Ok(Indenter { curvature: *radius, drop }),
            other => Err(format!("{other} is no paraboloid").into()),
        };
        indenters.levels().iter().zip(indenters.drops()).map(indenter).collect()
    }

    /// The paper's method with load-balanced circles, and its solution.
    pub fn localized_solution(
        &self,
        mean_pressure: f64,
        indenters: usize,
        elements: usize,
    ) -> Result<(Localized, localized::Solution), StudyError> {
        let method = Localized::new(self.case.problem(), indenters)?;
        let setup = Setup { indenters, elements, rule: CircleRadius::LoadBalanced, mutual_effect: true };
        let solution = method.solve(Load::MeanPressure(mean_pressure), &setup);
        if solution.stop != Stop::Converged {
            return Err(format!("localized solution at {mean_pressure}: {}", solution.stop).into());
        }
        Ok((method, solution))
    }

    /// The answer of [`Self::localized_solution`].
    pub fn localized(&self, mean_pressure: f64, indenters: usize, elements: usize) -> Result<Answer, StudyError> {
        Ok((&self.localized_solution(mean_pressure, indenters, elements)?.1).into())
    }

    /// Answer without mutual effect under the nominal pressure.
    pub fn apart(&self, mean_pressure: f64) -> Result<Answer, StudyError> {
        Ok(apart::solve(self.law()?, &self.indenters()?, mean_pressure * self.area(), self.period()))
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
                let level = &answer.levels[m];
                [level.load, level.max_pressure, level.contact_radius.unwrap_or(0.0), answer.penetration]
            });
            std::iter::once((m + 1) as f64).chain(values).collect()
        });
        Ok(Data { name, columns: std::iter::once("level".to_owned()).chain(columns).collect(), rows: rows.collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::CoatedContact;

    #[test]
    fn all_levels_have_one_penetration_and_carry_the_load_together() {
        let model = Model::new("fig3a", &[]).unwrap();
        let found = model.apart(0.008).unwrap();
        let coating = model.coating().unwrap();
        let mut total = 0.0;
        for (level, indenter) in found.levels.iter().zip(model.indenters().unwrap()) {
            let exact = CoatedContact::new(&coating, level.contact_radius.unwrap()).unwrap();
            let penetration = exact.penetration / indenter.curvature + indenter.drop;
            assert!((penetration / found.penetration - 1.0).abs() < 1e-6, "{penetration} {found:?}");
            assert!((exact.load / indenter.curvature / level.load - 1.0).abs() < 1e-6);
            total += exact.load / indenter.curvature;
        }
        assert!((total / (0.008 * 1.5 * 3f64.sqrt()) - 1.0).abs() < 1e-6);
    }
}
