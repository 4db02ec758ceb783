//! Limit loads.

use super::step::steps_of;
use super::stress::criterion;
use super::unreadable::{Unreadable, read};
use crate::run::{At, Limit, Limits};
use serde::Deserialize;
use serde_json::Value;

/// The limit loads of `limit.json`, without what is shown of the first and how a refinement ended.
///
/// # Errors
/// [`Unreadable`] with what is not as this version writes it.
pub fn limits_of(file: &Value) -> Result<Limits, Unreadable> {
    let keys: LimitsKeys = read("limit loads", file)?;
    let limits = keys.limits.iter().map(|limit| {
        let criterion = criterion(limit.criterion.as_str(), limit.material, limit.interface);
        let at = limit.at();
        criterion.zip(at).map(|(criterion, at)| Limit { criterion, at }).ok_or_else(|| Unreadable {
            what: format!("the limit of {}", limit.criterion),
            reason: format!("reached {:?} is not known with these keys", limit.reached),
        })
    });
    Ok(Limits {
        limits: limits.collect::<Result<_, _>>()?,
        steps: steps_of(file)?,
        shown: None,
        complete: keys.complete_contact.unwrap_or(f64::INFINITY),
        change: keys.change,
        end: None,
        warnings: keys.warnings,
    })
}

#[derive(Deserialize)]
struct LimitsKeys {
    warnings: Vec<String>,
    complete_contact: Option<f64>,
    change: Option<f64>,
    limits: Vec<LimitKeys>,
}

#[derive(Deserialize)]
struct LimitKeys {
    criterion: String,
    material: Option<usize>,
    interface: Option<usize>,
    mean_pressure: Option<f64>,
    error: Option<f64>,
    interval: Option<[Option<f64>; 2]>,
    x: Option<f64>,
    y: Option<f64>,
    z: Option<f64>,
    reached: String,
    below: Option<f64>,
    up_to: Option<f64>,
    utilisation: Option<f64>,
    utilisation_error: Option<f64>,
    utilisation_at: Option<f64>,
}

impl LimitKeys {
    fn at(&self) -> Option<At> {
        let sizes = [self.mean_pressure, self.error, self.below, self.up_to, self.utilisation_at];
        if sizes.into_iter().flatten().any(|size| size < 0.0) {
            return None;
        }
        let position = || Some([self.x?, self.y?, self.z?]);
        // An end that is null is infinite.
        let interval = || Some(self.interval?.map(|end| end.unwrap_or(f64::INFINITY)));
        let error = self.utilisation_error;
        Some(match (self.reached.as_str(), self.below, self.up_to) {
            ("undecided", _, Some(up_to)) => {
                let (utilisation, at) = (self.utilisation?, self.utilisation_at?);
                At::Undecided { from: interval()?[0], up_to, utilisation, error, at, position: position()? }
            }
            (_, Some(mean_pressure), _) => {
                // What is infinite is written as null.
                At::Below {
                    mean_pressure,
                    utilisation: self.utilisation.unwrap_or(f64::INFINITY),
                    position: position()?,
                }
            }
            (_, _, Some(up_to)) => At::Never { up_to, utilisation: self.utilisation?, error, at: self.utilisation_at? },
            ("by residual stress alone", ..) => At::Rest,
            ("under a tip however small the load", ..) => At::Tip { position: position()? },
            ("under load", ..) => {
                let (mean_pressure, error) = (self.mean_pressure?, self.error);
                At::Load { mean_pressure, error, interval: interval()?, position: position()? }
            }
            _ => return None,
        })
    }
}
