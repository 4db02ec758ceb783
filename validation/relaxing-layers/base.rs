//! A rigid base for one that is much stiffer than the layer.

use super::setup::{HERTZ, POISSON, RATIO, Slide, layer};
use super::statement::Statement;
use crate::moving::setup::{Stack, Stuff};
use crate::{Check, Data, Outcome, StudyError};

/// Modulus of the base over the relaxed one of the layer.
const STIFFER: [f64; 3] = [10.0, 100.0, 1000.0];
/// Thickness and way, over a₀.
const THICKNESS: f64 = 1.0;
const WAY: f64 = 0.3;
/// Friction and peak change by less than this on the base that is a thousand times as stiff.
const RIGID: f64 = 0.01;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new("bases", &["stiffer", "friction", "error", "peak", "peak_error"]);
    let slide = Slide::square(12.0, 128, WAY);
    let rigid = slide.over(layer(Some(THICKNESS * HERTZ), POISSON, RATIO)?)?;
    data.rows.push(vec![f64::INFINITY, rigid.friction[0], rigid.friction[1], rigid.peak[0], rigid.peak[1]]);
    for stiffer in STIFFER {
        let sheet = Stuff::relaxing(1.0, POISSON, RATIO);
        let body = Stack::coated(sheet, THICKNESS * HERTZ, Stuff::elastic(stiffer, POISSON)).half_space()?;
        let slid = slide.over(body)?;
        data.rows.push(vec![stiffer, slid.friction[0], slid.friction[1], slid.peak[0], slid.peak[1]]);
    }
    let off = |row: usize, column: usize| (data.rows[row][column] / data.rows[0][column] - 1.0).abs();
    let order = |column: usize| (off(2, column) / off(3, column)).log10();
    Statement::new("a rigid base stands for a much stiffer one")
        .says(Check::at_most("change of friction on a base 1000 times as stiff", off(3, 1), RIGID))
        .says(Check::at_most("change of the peak on a base 1000 times as stiff", off(3, 3), RIGID))
        .says(Check::order("order of the change of friction", order(1), 1.0, 0.2))
        .says(Check::order("order of the change of the peak", order(3), 1.0, 0.2))
        .judge(outcome, quick);
    outcome.data.push(data);
    Ok(())
}
