//! The keys of a sweep that a picture has as axes.

use crate::sweep::Row;
use percoat_draw::axis::log_spaced;
use percoat_draw::label::Label;
use percoat_draw::scale::Scale;

/// Values of a key from which on two of them make a map.
const SIDE: usize = 3;

/// The keys of a sweep along the axes of a picture.
pub struct Keys {
    /// Index and values of the one with most numbers.
    pub along: (usize, Vec<f64>),
    /// Index and values of a second one, where only these two keys change and every pair occurs.
    pub pair: Option<(usize, Vec<f64>)>,
    /// The names of all keys.
    pub names: Vec<Label>,
}

impl Keys {
    /// The keys of the rows with their `names`, one each.
    pub fn of(rows: &[Row], names: Vec<Label>) -> Option<Self> {
        let count = rows.first()?.settings.len().min(names.len());
        let numbers = |index: usize| -> Vec<f64> {
            let values = rows.iter().map(|row| number(row, index)).collect::<Option<Vec<f64>>>();
            let mut values = values.unwrap_or_default();
            values.sort_by(f64::total_cmp);
            values.dedup();
            values
        };
        let mut all: Vec<(usize, Vec<f64>)> = (0..count).map(|index| (index, numbers(index))).collect();
        let is_pair = all.len() == 2 && all.iter().all(|(_, values)| values.len() >= SIDE);
        let is_full = is_pair && all.iter().map(|(_, values)| values.len()).product::<usize>() == rows.len();
        all.retain(|(_, values)| values.len() > 1);
        // The first of those with most values goes along.
        let longest = (0..all.len()).rev().max_by_key(|&at| all[at].1.len())?;
        let along = all.swap_remove(longest);
        let pair = all.pop().filter(|_| is_full);
        Some(Self { along, pair, names })
    }
}

/// Spread as they are.
pub fn scale(values: &[f64]) -> Scale {
    if log_spaced(values) { Scale::Log } else { Scale::Linear }
}

/// The value of a key, if it is a number.
pub fn number(row: &Row, index: usize) -> Option<f64> {
    row.settings.get(index)?.1.parse::<f64>().ok().filter(|value| value.is_finite())
}
