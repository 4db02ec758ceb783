//! Refusal of loads that the surfaces cannot bear: with p ≤ H everywhere the mean pressure stays below the hardness H, too.

use super::super::error::Refusal;
use super::super::load::LoadSection;
use super::super::node::Value;
use super::super::reader::TableAt;
use crate::notation::number;
use crate::plain::float;
use crate::problem::Problem;

/// Refuses the first mean pressure that reaches the hardness of the softer surface, and the first force that does on the cell or
/// the window. A given pressure presses nothing in.
pub(in crate::case) fn bears(load: &LoadSection, section: &TableAt<'_>, problem: &Problem) -> Result<(), Refusal> {
    let (Some((hardness, side)), None) = (problem.bodies().hardness(), &load.given) else { return Ok(()) };
    let cell = problem.cell();
    let pressures = load.mean_pressures(cell.area()).unwrap_or_default();
    let Some(index) = pressures.iter().position(|pressure| *pressure >= hardness) else { return Ok(()) };
    let value = section.value(load.quantity())?;
    let span = match &value.node.value {
        Value::List(items) => items[index].span,
        _ => value.node.span,
    };
    let (most, size) = match (load.force.is_some(), cell.is_isolated()) {
        (false, _) => (format!("a mean pressure below {}", float(hardness)), ""),
        (true, false) => (format!("a force below {} on the cell", number(hardness * cell.area())), ""),
        (true, true) => {
            (format!("a force below {} on the window", number(hardness * cell.area())), ", a larger window")
        }
    };
    let message = format!(
        "`{}` = {}: no solution: the surface of the {side}, of hardness {}, bears {most}",
        value.path,
        float(load.values()[index]),
        float(hardness)
    );
    let help = format!("give a lower load{size} or a larger `hardness`, which stands in place of that of a `material`");
    Err(Refusal::new(span, message, "too large").help(help))
}
