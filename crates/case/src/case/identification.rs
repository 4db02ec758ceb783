//! Numbers of a case from a measured indentation curve: which are free, how they are searched for, and the case with the values found.

use super::model::CASE;
use super::{Case, CaseError, Document};
use crate::measurements::{Curves, Segment};
use percoat_common::plain;
use percoat_core::identification::{
    Estimate, FromRetraction, FromUnloading, Identification, IdentificationError, Instrument, Listener, Model,
    Parameter, Quantity, UnloadingModel,
};
use percoat_core::problem::Problem;
use percoat_core::run::Sampling;
use serde_json::{Value, json};

/// Names of a zero that was missed, and of the compliance of the frame, among the parameters.
const OFFSET: &str = "offset";
const FRAME: &str = "frame_compliance";
/// Name of the factor of the stiffness among what is known.
const BETA: &str = "beta";
/// Keys of numbers by which what is found is differentiated where they are taken as known.
const KNOWN: [&str; 12] = [
    "radius",
    "tip_radius",
    "half_angle",
    "slope",
    "coefficient",
    "exponent",
    "thickness",
    "young",
    "shear_ratio",
    "poisson",
    "tangential_stiffness",
    "normal_stiffness",
];
/// Most samples along a side of a window: its contact takes up two thirds of them, and leaves some 1e-4 of the penetration.
const MOST_POINTS: usize = 96;

/// Why a number of a case cannot be free.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotFree {
    /// No number is.
    #[error("nothing is to be found: name a key as layers.0.young, or `{OFFSET}` or `{FRAME}`")]
    Nothing,
    /// A name that is there twice.
    #[error("`{}` is there twice", plain::line(.0))]
    Twice(String),
    /// A name that is that of no number above 0.
    #[error(
        "the case has no number above 0 at `{}`: name a key as layers.0.young, layers.0.thickness, substrate.young or \
         levels.0.radius, layers counted from 0, or `{OFFSET}` or `{FRAME}`",
        plain::line(.0)
    )]
    NoNumber(String),
}

/// Why what is known beside the case is not.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotKnown {
    /// A text that is none of a name and a number.
    #[error(
        "`{}` is no `{OFFSET}=LENGTH`, `{FRAME}=LENGTH PER FORCE` or `{BETA}=FACTOR`, a number in the units of the case",
        plain::line(.0)
    )]
    NoValue(String),
    /// A name that is there twice.
    #[error("`{}` is there twice", plain::line(.0))]
    Twice(String),
    /// A factor of the stiffness where no stiffness is measured.
    #[error(
        "`{BETA}` is the factor of the stiffness of unloading, which other segments do not have: leave it out, or take the segment of unloading"
    )]
    Beta,
    /// A factor of the stiffness that is none.
    #[error("`{BETA}` must be above 0, not {0}: 1 for round tips, 1.034 for a triangle (King)")]
    Factor(f64),
}

/// Numbers known beside the case: additions of the instrument, and the factor β of the stiffness of unloading.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Known {
    /// Known additions of the instrument.
    pub instrument: Instrument,
    /// β of the tip; `None` where it is not given: 1.
    pub beta: Option<f64>,
}

impl Known {
    /// Known numbers, from texts `offset=0.0025`, `frame_compliance=1e-4` and `beta=1.034`, in the units of the case.
    ///
    /// # Errors
    /// [`NotKnown`] for other texts, and for a name that is there twice.
    pub fn of(texts: &[String]) -> Result<Self, NotKnown> {
        let [mut offset, mut frame, mut beta] = [None; 3];
        for text in texts {
            let none = || NotKnown::NoValue(text.clone());
            let (name, value) = text.split_once('=').ok_or_else(none)?;
            let value = value.trim().parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(none)?;
            let number = match name.trim() {
                OFFSET => &mut offset,
                FRAME => &mut frame,
                BETA => &mut beta,
                _ => return Err(none()),
            };
            if number.replace(value).is_some() {
                return Err(NotKnown::Twice(name.trim().to_owned()));
            }
        }
        if let Some(beta) = beta.filter(|beta| *beta <= 0.0) {
            return Err(NotKnown::Factor(beta));
        }
        let instrument = Instrument { offset: offset.unwrap_or(0.0), frame_compliance: frame.unwrap_or(0.0) };
        Ok(Self { instrument, beta })
    }

    /// Known numbers for curves of a segment.
    ///
    /// # Errors
    /// [`NotKnown::Beta`] for a factor of the stiffness where the segment is none of unloading.
    pub fn for_segment(self, segment: Segment) -> Result<Self, NotKnown> {
        match (self.beta, segment) {
            (Some(_), Segment::Whole | Segment::Loading | Segment::Retraction) => Err(NotKnown::Beta),
            _ => Ok(self),
        }
    }
}

/// Parameters found by measured curves.
#[derive(Debug, Clone, PartialEq)]
pub enum Found {
    /// By the points of loading.
    Loading(Identification),
    /// By the stiffness of unloading.
    Unloading(FromUnloading),
    /// By the forces of drawing off.
    Retraction(FromRetraction),
}

impl Found {
    /// The parameters.
    pub fn estimates(&self) -> &[Estimate] {
        match self {
            Self::Loading(found) => &found.estimates,
            Self::Unloading(found) => &found.estimates,
            Self::Retraction(found) => &found.estimates,
        }
    }

    /// Steps of the search.
    pub fn steps(&self) -> usize {
        match self {
            Self::Loading(found) => found.steps,
            Self::Unloading(found) => found.steps,
            Self::Retraction(found) => found.steps,
        }
    }
}

/// The task of `percoat identify`: free numbers of a case, from a measured curve.
#[derive(Debug)]
pub struct IdentificationTask<'a> {
    document: &'a Document<'a>,
    case: &'a Case,
    parameters: Vec<Parameter>,
    /// Numbers that are taken as known, and by which what is found is differentiated.
    fixed: Vec<Parameter>,
    /// Numbers known beside the case, 0 where free.
    known: Known,
}

impl<'a> IdentificationTask<'a> {
    /// The task for the numbers at these keys, and for `offset` and `frame_compliance`. The case is that of the document; the numbers in
    /// it are the starts.
    ///
    /// # Errors
    /// [`NotFree`] for names that are none of a number of the case above 0, for one that is there twice, and without any.
    pub fn new(document: &'a Document<'a>, case: &'a Case, free: &[String]) -> Result<Self, NotFree> {
        if free.is_empty() {
            return Err(NotFree::Nothing);
        }
        let (whole, mut parameters) = (json!(case), Vec::<Parameter>::new());
        for name in free.iter().map(|name| name.trim()) {
            if parameters.iter().any(|parameter| parameter.name == name) {
                return Err(NotFree::Twice(name.to_owned()));
            }
            let (quantity, start) = match name {
                OFFSET => (Quantity::Offset, 0.0),
                FRAME => (Quantity::FrameCompliance, 0.0),
                key => {
                    let value = whole.pointer(&format!("/{}", key.replace('.', "/"))).and_then(Value::as_f64);
                    let start = value.filter(|value| *value > 0.0);
                    let range = CASE.range(key);
                    range
                        .zip(start)
                        .map(|(range, start)| (range.quantity(), start))
                        .ok_or_else(|| NotFree::NoNumber(key.to_owned()))?
                }
            };
            parameters.push(Parameter { name: name.to_owned(), quantity, start });
        }
        let mut fixed = Vec::new();
        for section in ["levels", "layers", "substrate", "counterbody"] {
            collect(&whole[section], section, &mut fixed);
        }
        for (name, quantity) in [(OFFSET, Quantity::Offset), (FRAME, Quantity::FrameCompliance)] {
            fixed.push(Parameter { name: name.to_owned(), quantity, start: 0.0 });
        }
        fixed.retain(|parameter| parameters.iter().all(|free| free.name != parameter.name));
        Ok(Self { document, case, parameters, fixed, known: Known::default() })
    }

    /// The task with what is known; where it is free as well, the search starts from it.
    #[must_use]
    pub fn with_known(mut self, Known { instrument, beta }: Known) -> Self {
        for parameter in self.parameters.iter_mut().chain(&mut self.fixed) {
            match parameter.quantity {
                Quantity::Offset => parameter.start = instrument.offset,
                Quantity::FrameCompliance => parameter.start = instrument.frame_compliance,
                _ => {}
            }
        }
        let known = |quantity: Quantity, of: f64| {
            if self.parameters.iter().any(|parameter| parameter.quantity == quantity) { 0.0 } else { of }
        };
        let instrument = Instrument {
            offset: known(Quantity::Offset, instrument.offset),
            frame_compliance: known(Quantity::FrameCompliance, instrument.frame_compliance),
        };
        self.known = Known { instrument, beta };
        self
    }

    /// The case whose numbers are searched for.
    pub fn case(&self) -> &Case {
        self.case
    }

    /// Finds the values by measured curves, and the case with them. `progress` is called with each trial; `Break` ends the search.
    ///
    /// # Errors
    /// [`IdentificationError`].
    pub fn find(
        &self,
        measured: &Curves,
        progress: &mut Listener<'_>,
    ) -> Result<(Found, Case), IdentificationError<CaseError>> {
        let parameters = self.parameters_of(measured);
        let problem = |values: &[f64]| -> Result<Problem, CaseError> {
            Ok(self.with(&parameters, values)?.problem().without_hardness())
        };
        let asked = (&parameters[..], &self.fixed[..]);
        let instrument = self.known.instrument;
        let found = match measured {
            Curves::Loading(curve) => {
                let model = Model { problem: &problem, points: points(self.case), settings: self.case.solver };
                let curve = curve.clone().with_instrument(instrument);
                Found::Loading(Identification::with_fixed(&model, asked, &curve, progress)?)
            }
            Curves::Unloading(unloadings) => {
                let model = UnloadingModel { problem: &problem, instrument, beta: self.beta() };
                Found::Unloading(FromUnloading::new(&model, asked, unloadings, progress)?)
            }
            Curves::Retraction(curve) => {
                let model = Model { problem: &problem, points: points(self.case), settings: self.case.solver };
                Found::Retraction(FromRetraction::new(&model, &parameters, (curve, instrument), progress)?)
            }
        };
        let values: Vec<f64> = found.estimates().iter().map(|estimate| estimate.value).collect();
        let best = self.with(&parameters, &values).map_err(IdentificationError::Model)?;
        Ok((found, best))
    }

    /// Factor β of the stiffness.
    pub fn beta(&self) -> f64 {
        self.known.beta.unwrap_or(1.0)
    }

    /// The parameters for measured curves: each of several has a zero of its own, `offset.0`, `offset.1`, ….
    fn parameters_of(&self, measured: &Curves) -> Vec<Parameter> {
        let curves = match measured {
            Curves::Loading(curve) if curve.lengths().len() > 1 => curve.lengths().len(),
            _ => return self.parameters.clone(),
        };
        let each = |parameter: &Parameter| match parameter.quantity {
            Quantity::Offset => {
                let of = |curve: usize| Parameter {
                    name: format!("{OFFSET}.{curve}"),
                    quantity: Quantity::OffsetOf(curve),
                    start: parameter.start,
                };
                (0..curves).map(of).collect()
            }
            _ => vec![parameter.clone()],
        };
        self.parameters.iter().flat_map(each).collect()
    }

    /// The case with these values of parameters, and of the fixed numbers where there are more values.
    fn with(&self, parameters: &[Parameter], values: &[f64]) -> Result<Case, CaseError> {
        let of_case = |(parameter, _): &(&Parameter, &f64)| {
            matches!(parameter.quantity, Quantity::Positive | Quantity::Bounded(_))
        };
        let free = parameters.iter().chain(&self.fixed).zip(values).filter(of_case);
        let settings: Vec<String> = free.map(|(parameter, value)| format!("{}={value:e}", parameter.name)).collect();
        self.document.changed(&settings)
    }
}

/// Adds the numbers of a part of a serialised case at `path` that have a key of [`KNOWN`], each with its path.
fn collect(part: &Value, path: &str, fixed: &mut Vec<Parameter>) {
    let mut visit = |name: &str, value: &Value| {
        let path = format!("{path}.{name}");
        match (value.as_f64().filter(|_| KNOWN.contains(&name)), CASE.range(&path)) {
            (Some(start), Some(range)) => {
                let quantity = range.quantity();
                if start > 0.0 || matches!(quantity, Quantity::Bounded(_)) {
                    fixed.push(Parameter { name: path, quantity, start });
                }
            }
            _ => collect(value, &path, fixed),
        }
    };
    match part {
        Value::Object(entries) => entries.iter().for_each(|(name, value)| visit(name, value)),
        Value::Array(items) => items.iter().enumerate().for_each(|(index, value)| visit(&index.to_string(), value)),
        _ => {}
    }
}

/// Samples along a side of the windows in which the contacts of a case are solved.
pub(super) fn points(case: &Case) -> usize {
    match case.grid {
        Sampling::Points([n1, n2]) => n1.max(n2).min(MOST_POINTS),
        Sampling::Accuracy(_) => MOST_POINTS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::embedded;

    fn quantity(case: &str, key: &str) -> Result<Quantity, NotFree> {
        let source = embedded::source(case).unwrap();
        let document = Document::new(&source, &[]).unwrap();
        let case = document.case().unwrap();
        IdentificationTask::new(&document, &case, &[key.to_owned()]).map(|task| task.parameters[0].quantity)
    }

    #[test]
    fn how_a_number_is_searched_follows_from_the_range_of_its_key() {
        let bounded = Ok(Quantity::Bounded([0.0, 0.5]));
        for key in ["layers.0.poisson", "substrate.poisson"] {
            assert_eq!(quantity("dlc-on-steel", key), bounded, "{key}");
        }
        for key in ["layers.1.thickness", "layers.0.young", "substrate.young"] {
            assert_eq!(quantity("dlc-on-steel", key), Ok(Quantity::Positive), "{key}");
        }
        assert_eq!(quantity("fig2", "levels.0.radius"), Ok(Quantity::Positive));
        assert_eq!(quantity("fig2", "offset"), Ok(Quantity::Offset));
        // A whole number, a text, a table, an item that is not there, and no key.
        for key in
            ["localized.elements", "title", "layers", "layers.0", "layers.7.young", "layers.young", "poisson", ""]
        {
            assert_eq!(quantity("fig2", key), Err(NotFree::NoNumber(key.to_owned())), "{key}");
        }
    }

    #[test]
    fn something_is_to_be_found_and_nothing_twice() {
        let source = embedded::source("fig2").unwrap();
        let document = Document::new(&source, &[]).unwrap();
        let case = document.case().unwrap();
        let refused = |free: &[&str]| {
            let free: Vec<String> = free.iter().map(|&name| name.to_owned()).collect();
            IdentificationTask::new(&document, &case, &free).map(drop)
        };
        assert_eq!(refused(&[]), Err(NotFree::Nothing));
        assert_eq!(refused(&["offset", " offset"]), Err(NotFree::Twice("offset".to_owned())));
    }
}
