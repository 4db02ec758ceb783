//! `area` of a level: the measured area function of its tip, from a file or by coefficients.

use serde::Serialize;
use std::io::Read;
use std::path::PathBuf;

use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::node::Value;
use super::section::{KeyValue, section};
use super::source::Source;
use super::value::ValueAt;
use crate::measurements;
use crate::units::Units;
use percoat_common::measure::Measure;
use percoat_common::plain;
use percoat_core::counterbody::{MeasuredTip, TipError};

/// Largest file of an area function, bytes.
const LONGEST: u64 = 16 << 20;

section! {
    /// Coefficients of an area function.
    pub struct CoefficientsSection = AREA {
        /// C₀ to C₈ of A = C₀h² + C₁h + C₂h^½ + C₃h^¼ + … + C₈h^(1/128) (Oliver and Pharr), some or all
        pub coefficients: Vec<f64> =
            Key::new(&[Form::List { of: &Form::Number(Range::Coordinate), count: [1, 9] }], "[24.5, 0.2]")
                .unit(Unit::AreaCoefficient)
                .rule("A rises over the `depths`"),
        /// least and largest depth of the calibration, between which they hold
        pub depths: [f64; 2] =
            Key::new(&[Form::Tuple("two depths [least, largest]", &[Form::Number(Range::Size); 2])], "[0.05, 1.0]")
                .unit(Unit::Length),
        /// unit of length of the coefficients: A in its square, h in it
        pub unit: Option<String> = Key::new(&[Form::Text("a unit of length")], "\"nm\"")
            .otherwise("the case's own")
            .rule("needs `units.length`"),
    }
}

/// The area function of a tip, as a case has it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum AreaSection {
    /// By coefficients.
    Coefficients(CoefficientsSection),
    /// A table of depths and areas, by the path of its file.
    File(String),
}

impl KeyValue for AreaSection {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match &value.node.value {
            Value::Text(path) => Ok(Self::File(path.clone())),
            _ => CoefficientsSection::read(value).map(Self::Coefficients),
        }
    }
}

impl AreaSection {
    /// The section with the absolute path of its file.
    pub(super) fn located(self, source: &Source) -> Self {
        match self {
            Self::File(name) => Self::File(source.path(&name).map_or(name, |path| path.to_string_lossy().into_owned())),
            coefficients => coefficients,
        }
    }

    /// The tip of the area function that is `written` in the case; `length` is the unit of the case's lengths, if any.
    pub(super) fn tip(
        &self,
        written: &ValueAt<'_>,
        source: &Source,
        length: Option<&str>,
    ) -> Result<MeasuredTip, Refusal> {
        match self {
            Self::Coefficients(section) => section.tip(written, length),
            Self::File(name) => of_file(name, written, source, length),
        }
    }
}

impl CoefficientsSection {
    fn tip(&self, written: &ValueAt<'_>, length: Option<&str>) -> Result<MeasuredTip, Refusal> {
        let table = written.table()?;
        let in_case = match (&self.unit, table.optional("unit")) {
            (Some(unit), Some(value)) => times(unit, &value, length)?,
            _ => 1.0,
        };
        // A length h of the case is k h in the unit of the coefficients: C (k h)ᵖ there is C kᵖ⁻² hᵖ here.
        let powers = (0..).map(|k| if k == 0 { 2.0 } else { 0.5f64.powi(k - 1) });
        let converted = |(c, power): (&f64, f64)| c * in_case.powf(power - 2.0);
        let coefficients: Vec<f64> = self.coefficients.iter().zip(powers).map(converted).collect();
        MeasuredTip::from_coefficients(&coefficients, self.depths).map_err(|error| {
            let key = if matches!(error, TipError::Range(_)) { "depths" } else { "coefficients" };
            let span = table.optional(key).map_or(table.span, |value| value.node.span);
            Refusal::new(span, format!("`{}`: {error}", table.path(key)), "no area function of a tip").help(
                "give depths between which the area rises; other units of length change the coefficients (`unit`)",
            )
        })
    }
}

/// The length of the case in another unit, which is that of a `value`.
fn times(unit: &str, value: &ValueAt<'_>, length: Option<&str>) -> Result<f64, Refusal> {
    let unit = Measure::like(unit, Measure::METRE).ok_or_else(|| value.refuse("a unit of length, as nm or µm"))?;
    let of_case = length.and_then(|length| Measure::like(length, Measure::METRE));
    of_case.and_then(|of_case| of_case.convert(1.0, unit)).ok_or_else(|| {
        let message = format!("`{}` needs the unit of the case's lengths to be converted to", value.path);
        Refusal::new(value.node.span, message, "converted to what?")
            .help("add [units] with length = \"µm\" or another, or convert the coefficients")
    })
}

fn of_file(name: &str, written: &ValueAt<'_>, source: &Source, length: Option<&str>) -> Result<MeasuredTip, Refusal> {
    let path = source.path(name).unwrap_or_else(|| PathBuf::from(name));
    let shown = plain::path(&path);
    let refuse = |what: String| {
        Refusal::new(written.node.span, format!("`{}`: {what}", written.path), "this file").help(
            "needed: a table with columns `depth` and `area`, as `depth_nm,area_nm2`; a path is relative to the case file",
        )
    };
    let mut bytes = Vec::new();
    let (reader, _) = source.open(name).map_err(|error| refuse(format!("cannot read {shown}: {error}")))?;
    reader
        .take(LONGEST + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| refuse(format!("cannot read {shown}: {error}")))?;
    if bytes.len() as u64 > LONGEST {
        return Err(refuse(format!("{shown} is longer than 16 MiB: it is no area function")));
    }
    let units = Units::unknown().named(length, None);
    measurements::tip(&measurements::text(&bytes), &units).map_err(|fault| refuse(format!("{shown}: {fault}")))
}
