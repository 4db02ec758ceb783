//! `identification.json` and `identification.csv`: parameters found from measured indentation curves, and the fit.

use super::head::{Head, with_head};
use super::json::{Unreadable, indented, read_back};
use super::number::{number, with_error};
use super::table::Table;
use super::unloading::{UnloadingRecord, unloaded};
use percoat_case::case::{Case, Found};
use percoat_case::measurements::{Curves, Taken};
use percoat_case::units::Units;
use percoat_core::identification::{
    Doubt, Estimate, FromRetraction, FromUnloading, Identification, LEVEL, Measurement, Missing, Retraction,
    Sensitivity, Trial,
};
use percoat_core::notation::WIDE;
use percoat_core::run::tip::outside;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fmt::Write;

with_head! {
    /// The content of `identification.json`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct IdentificationFile {
        parameters: Vec<FoundParameter>,
        correlation: Vec<Vec<f64>>,
        points: usize,
        degrees_of_freedom: usize,
        rms_residual: f64,
        reduced_chi_square: Option<f64>,
        model_error: Option<f64>,
        contact_radii: [f64; 2],
        curves: Vec<CurveRecord>,
        unloading: Option<UnloadingRecord>,
        /// Of a curve of drawing off the least force of the fit; `None` of others.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pull_off: Option<f64>,
        sensitivities: Vec<KnownNumber>,
        /// Warnings about the fit, a sentence each.
        pub warnings: Vec<String>,
        steps: usize,
    }
}

/// A measured curve: its points that were fitted, and the root mean square of measured minus fitted penetrations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct CurveRecord {
    name: String,
    points: usize,
    rms_residual: f64,
}

/// A number that was taken as known, and the derivatives of the parameters by it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct KnownNumber {
    name: String,
    value: f64,
    derivatives: Vec<f64>,
}

/// A parameter in the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct FoundParameter {
    name: String,
    start: f64,
    value: f64,
    standard_error: f64,
    interval_95: [f64; 2],
}

impl IdentificationFile {
    /// The record of what was found with a factor β by measured curves; `case` has the values found.
    pub fn new(measured: &Taken, (found, beta): (&Found, f64), case: &Case, warnings: &[String]) -> Self {
        let parameter = |estimate: &Estimate| FoundParameter {
            name: estimate.parameter.name.clone(),
            start: estimate.parameter.start,
            value: estimate.value,
            standard_error: estimate.error,
            interval_95: estimate.interval,
        };
        let known = |sensitivity: &Sensitivity| KnownNumber {
            name: sensitivity.fixed.name.clone(),
            value: sensitivity.fixed.start,
            derivatives: sensitivity.derivatives.clone(),
        };
        let unloading = match (&measured.curves, found) {
            (Curves::Unloading(unloadings), Found::Unloading(found)) => {
                Some(UnloadingRecord::new(unloadings, (found, beta), case.problem().bodies()))
            }
            _ => None,
        };
        let (correlation, sensitivities, contact_radii) = match found {
            Found::Loading(found) => (&found.correlation, &found.sensitivities, found.radii),
            Found::Unloading(found) => (&found.correlation, &found.sensitivities, found.radii),
            Found::Retraction(found) => (&found.correlation, &Vec::new(), found.radii),
        };
        let (points, degrees_of_freedom, rms_residual, reduced_chi_square, model_error, steps) = match found {
            Found::Loading(found) => {
                let Identification { fitted, freedom, rms, reduced_chi_square, model_error, steps, .. } = found;
                (fitted.len(), *freedom, *rms, *reduced_chi_square, *model_error, *steps)
            }
            Found::Unloading(found) => {
                let FromUnloading { contacts, freedom, rms, reduced_chi_square, model_error, steps, .. } = found;
                (contacts.len(), *freedom, *rms, *reduced_chi_square, Some(*model_error), *steps)
            }
            Found::Retraction(found) => {
                let FromRetraction { fitted, freedom, rms, model_error, steps, .. } = found;
                (fitted.len(), *freedom, *rms, None, Some(*model_error), *steps)
            }
        };
        let Head { percoat, title, case: keys, units } = Head::of(case);
        Self {
            percoat,
            title,
            case: keys,
            units,
            parameters: found.estimates().iter().map(parameter).collect(),
            correlation: correlation.clone(),
            points,
            degrees_of_freedom,
            rms_residual,
            reduced_chi_square,
            model_error,
            contact_radii,
            curves: curves(measured, found),
            unloading,
            pull_off: if let Found::Retraction(found) = found { Some(found.pull_off) } else { None },
            sensitivities: sensitivities.iter().map(known).collect(),
            warnings: warnings.to_vec(),
            steps,
        }
    }

    /// The content of the file.
    pub fn to_json(&self) -> String {
        indented(self)
    }
}

/// The records of measured curves.
fn curves(measured: &Taken, found: &Found) -> Vec<CurveRecord> {
    let names = measured.names.iter().cloned();
    let sizes: Vec<(usize, f64)> = match (&measured.curves, found) {
        (Curves::Loading(curve), Found::Loading(found)) => {
            curve.lengths().iter().copied().zip(found.rms_of_curves.iter().copied()).collect()
        }
        (Curves::Unloading(unloadings), _) => {
            unloadings.iter().map(|unloading| (unloading.forces.len(), unloading.rms)).collect()
        }
        (Curves::Retraction(curve), Found::Retraction(found)) => vec![(curve.forces().len(), found.rms)],
        _ => Vec::new(),
    };
    names.zip(sizes).map(|(name, (points, rms_residual))| CurveRecord { name, points, rms_residual }).collect()
}

/// The content of `identification.csv`: a line for each measured point, the fit and its standard error by that of the parameters, and the index of
/// its curve; of unloadings the fitted points with their power law.
pub fn fitted(measured: &Taken, found: &Found) -> String {
    let (measured, found) = match (&measured.curves, found) {
        (Curves::Loading(measured), Found::Loading(found)) => (measured, found),
        (Curves::Unloading(unloadings), _) => return unloaded(unloadings),
        (Curves::Retraction(curve), Found::Retraction(found)) => return drawn_off(curve, found),
        _ => return String::new(),
    };
    let mut text = "force,penetration,fitted,fitted_error,curve\n".to_owned();
    let points = measured.forces().iter().zip(measured.penetrations()).zip(&found.fitted).zip(&found.band);
    for (index, (((force, penetration), fitted), band)) in points.enumerate() {
        let curve = measured.curve_of(index);
        writeln!(text, "{force},{penetration},{fitted},{band},{curve}").expect("a String takes any text");
    }
    text
}

/// The content of `identification.csv` for a curve of drawing off, whose fitted values are forces.
fn drawn_off(measured: &Retraction, found: &FromRetraction) -> String {
    let mut text = "force,penetration,fitted_force,fitted_force_error\n".to_owned();
    let points = measured.forces().iter().zip(measured.penetrations()).zip(&found.fitted).zip(&found.band);
    for (((force, penetration), fitted), band) in points {
        writeln!(text, "{force},{penetration},{fitted},{band}").expect("a String takes any text");
    }
    text
}

/// Why what was found from a curve of drawing off may not hold, a sentence each.
pub fn doubts_of_retraction(found: &FromRetraction) -> Vec<String> {
    let pattern = found.pattern.as_ref().map(|pattern| {
        format!(
            "the residuals are not scatter: along the way they have {} runs of one sign where scatter has {:.1}; the model does not hold, nor do the \
             standard errors: free `offset` or `frame_compliance`, or look for drift, a wrong radius or another law of the tension",
            pattern.runs, pattern.expected
        )
    });
    pattern.into_iter().collect()
}

/// A trial of the search in words, in lengths or forces of the case.
pub fn trial(case: &Case, trial: Trial) -> String {
    let (units, force) = (case.units(), case.units().force());
    let unit = if trial.is_of_forces { &force } else { units.length() };
    let residual = trial.rms.map(|rms| unit.with_unit(rms, number));
    format!("trial {}, residual {}", trial.number, residual.unwrap_or("unknown: no contact is solved there".to_owned()))
}

/// The text of `percoat identify`, by the content of its file.
pub fn identified(file: &IdentificationFile, units: &Units, width: usize) -> String {
    let mut text = format!("{}\n\n", file.found().fitted(width));
    text += &file.correlations().into_iter().map(|line| line + "\n").collect::<String>();
    if let Some(table) = file.by_known() {
        text += &format!("\n{}\n\n", table.fitted(width));
    }
    for table in file.of_curves(units) {
        text += &format!("{}\n\n", table.fitted(width));
    }
    text + &file.fit(units).into_iter().map(|line| line + "\n").collect::<String>()
}

impl IdentificationFile {
    /// Table of the parameters with their errors.
    pub fn found(&self) -> Table {
        let head = ["parameter", "start", "value", "95 % interval", "relative"];
        let row = |found: &FoundParameter| {
            let [low, high] = found.interval_95.map(number);
            let relative = found.standard_error / found.value.abs();
            vec![
                found.name.clone(),
                number(found.start),
                if relative > WIDE { number(found.value) } else { with_error(found.value, Some(found.standard_error)) },
                format!("{low} to {high}"),
                match relative {
                    wide if wide.is_finite() && wide > WIDE => format!("more than {:.0} %", 100.0 * WIDE),
                    _ if relative.is_finite() => format!("± {:.2} %", 100.0 * relative),
                    _ => String::new(),
                },
            ]
        };
        Table::new(&head, self.parameters.iter().map(row).collect(), 1)
    }

    /// The correlations of the parameters, a line for each pair.
    pub fn correlations(&self) -> Vec<String> {
        let pairs = (0..self.parameters.len()).flat_map(|k| (0..k).map(move |other| (other, k)));
        let line = |(other, k): (usize, usize)| {
            let names = [other, k].map(|k| self.parameters[k].name.as_str());
            format!("correlation of {} and {}: {:+.3}", names[0], names[1], self.correlation[k][other])
        };
        pairs.map(line).collect()
    }

    /// The derivatives of the parameters by what was taken as known, in the units of the case; `None` without any.
    pub fn by_known(&self) -> Option<Table> {
        let parameters = self.parameters.iter().map(|found| format!("d {}", found.name));
        let head: Vec<String> =
            ["by what was taken as known", "value"].map(str::to_owned).into_iter().chain(parameters).collect();
        let row = |known: &KnownNumber| {
            let numbers = std::iter::once(known.value).chain(known.derivatives.iter().copied()).map(number);
            std::iter::once(known.name.clone()).chain(numbers).collect()
        };
        let rows: Vec<Vec<String>> = self.sensitivities.iter().map(row).collect();
        (!rows.is_empty()).then(|| Table::new(&head, rows, 1))
    }

    /// Whether it is of unloading.
    pub fn is_of_unloading(&self) -> bool {
        self.unloading.is_some()
    }

    /// Tables of the curves: of several loadings their residuals, of unloadings what was measured and the contacts.
    pub fn of_curves(&self, units: &Units) -> Vec<Table> {
        let names: Vec<&str> = self.curves.iter().map(|curve| curve.name.as_str()).collect();
        if let Some(unloading) = &self.unloading {
            return unloading.tables(&names, units).into();
        }
        if names.len() < 2 {
            return Vec::new();
        }
        let largest = self.curves.iter().map(|curve| curve.rms_residual).fold(0.0, f64::max);
        let unit = units.length().prefixed(largest);
        let head = ["curve".to_owned(), "points".to_owned(), unit.headed("residual")];
        let row = |curve: &CurveRecord| {
            vec![curve.name.clone(), curve.points.to_string(), number(unit.shown(curve.rms_residual))]
        };
        vec![Table::new(&head, self.curves.iter().map(row).collect(), 1)]
    }

    /// How well the model fits, in lines.
    pub fn fit(&self, units: &Units) -> Vec<String> {
        let length = units.length();
        if let Some(unloading) = &self.unloading {
            return self.fit_of_unloading(unloading, units);
        }
        let [least, most] = self.contact_radii.map(|radius| length.with_unit(radius, number));
        if let Some(pull_off) = self.pull_off {
            let force = |x: f64| units.force().with_unit(x, number);
            let error = self.model_error.unwrap_or(0.0);
            return vec![
                format!(
                    "{} points, residual {} (root mean square); contact radii {least} to {most}",
                    self.points,
                    force(self.rms_residual)
                ),
                format!("pull-off of the fit {}; error of its forces by the grid: {error:.1e}", force(pull_off)),
            ];
        }
        let mut lines = vec![format!(
            "{} points, residual {} (root mean square); contact radii {least} to {most}",
            self.points,
            length.with_unit(self.rms_residual, number)
        )];
        if let Some(chi) = self.reduced_chi_square {
            lines.push(format!("reduced chi-square {chi:.2}, about 1 where model and deviations hold"));
        }
        if let Some(error) = self.model_error {
            lines.push(format!("error of the computed penetrations by the grid: {error:.1e} at most"));
        }
        lines
    }

    /// How well the model fits the stiffness of unloadings, in lines.
    fn fit_of_unloading(&self, unloading: &UnloadingRecord, units: &Units) -> Vec<String> {
        let length = units.length();
        let [least, most] = self.contact_radii.map(|radius| length.with_unit(radius, number));
        let [low, high] = unloading.epsilons().map(number);
        let many =
            if unloading.len() == 1 { "1 unloading".to_owned() } else { format!("{} unloadings", unloading.len()) };
        let residual = match self.degrees_of_freedom {
            0 => "as many as parameters, so that the model meets each stiffness".to_owned(),
            _ => format!("residual {} of P/S (root mean square)", length.with_unit(self.rms_residual, number)),
        };
        let mut lines = vec![format!("{many}, {residual}; contact radii {least} to {most}, ε {low} to {high}")];
        if let Some(chi) = self.reduced_chi_square {
            lines.push(format!("reduced chi-square {chi:.2}, about 1 where model and errors hold"));
        }
        lines.extend(unloading.notes(units));
        lines
    }

    /// Reads the content of `identification.json`.
    ///
    /// # Errors
    /// [`Unreadable`] with the key that is not as this version writes it.
    pub fn read(file: &Value) -> Result<Self, Unreadable> {
        read_back(file)
    }
}

/// Why values and standard errors of a fit may not hold, a sentence each; `case` has the values found.
pub fn doubts(measured: &Measurement, found: &Identification, case: &Case) -> Vec<String> {
    let units = case.units();
    let told = found.doubts.iter().map(|raised| doubt(raised, found, &units));
    let level = case.problem().levels().first();
    let beyond_tip = level.and_then(|level| outside("the tip", level.shape(), found.radii));
    told.chain(beyond_hardness(measured, found, case)).chain(beyond_tip).collect()
}

fn doubt(doubt: &Doubt, found: &Identification, units: &Units) -> String {
    let length = |x: f64| units.length().with_unit(x, number);
    match doubt {
        Doubt::Systematic(pattern) => format!(
            "the residuals are not scatter: over the force they have {} runs of one sign where scatter has {:.1} (chance makes such a pattern in \
             fewer than 1 of {:.0} curves); the model does not hold, nor do the standard errors: leave out the larger forces where something \
             yields, free `offset` or `frame_compliance`, or look for drift and a wrong fixed number",
            pattern.runs,
            pattern.expected,
            0.5 / LEVEL
        ),
        Doubt::Offset(missing) => {
            let size = format!("{} ± {}", length(missing.value), length(missing.error));
            format!("the zero of the penetration seems to be off by {size}: {}", with_it(missing, found, "offset"))
        }
        Doubt::FrameCompliance(missing) => {
            let unit = match (units.force().name(), units.length().name()) {
                (Some(force), Some(length)) => format!("\u{a0}{length}/{force}"),
                _ => String::new(),
            };
            let size = format!("{}{unit}", with_error(missing.value, Some(missing.error)));
            format!("the frame seems to have a compliance of {size}: {}", with_it(missing, found, "frame_compliance"))
        }
        Doubt::NoDerivative(underivable) => format!(
            "what was found has no derivative by {}, which the model does not allow to vary: {}; how an error of it affects the result is unknown",
            underivable.names.join(", "),
            underivable.reason
        ),
    }
}

/// Sentence on what a number of the instrument would change, and how it is freed.
fn with_it(missing: &Missing, found: &Identification, name: &str) -> String {
    let names = found.estimates.iter().map(|estimate| estimate.parameter.name.as_str());
    let changed: Vec<String> =
        names.zip(&missing.estimates).map(|(name, value)| format!("{name} about {}", number(*value))).collect();
    format!(
        "with it {}; free `{name}`, or state it as known (`--known {name}=…`, in Python `known`), if it is not the model that fails",
        changed.join(" and ")
    )
}

/// Warning that the elastic fit exceeds the hardness of a surface, and from which force on; `None` without a hardness, and below it.
fn beyond_hardness(measured: &Measurement, found: &Identification, case: &Case) -> Option<String> {
    let (hardness, side) = case.problem().bodies().hardness()?;
    let points = measured.forces().iter().zip(&found.peaks);
    let beyond: Vec<f64> = points.filter(|(_, peak)| **peak > hardness).map(|(force, _)| *force).collect();
    let least = beyond.iter().copied().reduce(f64::min)?;
    let most = found.peaks.iter().copied().fold(0.0, f64::max);
    let units = case.units();
    let [hardness, most] = [hardness, most].map(|pressure| units.pressure().with_unit(pressure, number));
    Some(format!(
        "the pressure of the elastic fit exceeds the hardness {hardness} of the {side} in {} of {} points, from the force {} on, up to {most}: it \
         yields there, and the fit takes it for elastic; leave these points out",
        beyond.len(),
        measured.forces().len(),
        units.force().with_unit(least, number)
    ))
}
