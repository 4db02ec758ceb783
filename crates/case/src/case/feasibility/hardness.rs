//! Refusal of loads that the surfaces cannot bear: with p ≤ H everywhere the mean pressure stays below the hardness H, too.

use super::super::error::Refusal;
use super::super::load::LoadSection;
use super::super::node::Value;
use super::super::reader::TableAt;
use crate::words::AroundWords;
use percoat_common::plain::float;
use percoat_core::notation::number;
use percoat_core::problem::Problem;

/// Refuses the first mean pressure that reaches the hardness of the softer surface, and the first force that does on the cell or
/// the window; and a given pressure that exceeds it somewhere. One that is the hardness is borne: it displaces elastically.
pub(in crate::case) fn bears(load: &LoadSection, section: &TableAt<'_>, problem: &Problem) -> Result<(), Refusal> {
    let Some((hardness, side)) = problem.largest_hardness() else { return Ok(()) };
    if let Some(given) = problem.given_pressure() {
        if given.highest() <= hardness {
            return Ok(());
        }
        let value = section.value("pressure")?;
        let message = format!(
            "`{}` reaches {}, more than the surface of the {side}, of hardness {}, bears",
            value.path,
            number(given.highest()),
            float(hardness)
        );
        let help = "give a lower pressure or a larger `hardness`, which stands in place of that of a `material`";
        return Err(Refusal::new(value.node.span, message, "too large").help(help));
    }
    let cell = problem.cell();
    let pressures = load.mean_pressures(cell.area()).unwrap_or_default();
    let Some(index) = pressures.iter().position(|pressure| *pressure >= hardness) else { return Ok(()) };
    let value = section.value(load.quantity())?;
    let span = match &value.node.value {
        Value::List(items) => items[index].span,
        _ => value.node.span,
    };
    let words = AroundWords::of(cell.surroundings());
    let (most, size) = match load.force {
        None => (format!("a mean pressure below {}", float(hardness)), ""),
        Some(_) => {
            let most = format!("a force below {} on the {}", number(hardness * cell.area()), words.cell);
            (most, words.more_room)
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

#[cfg(test)]
mod tests {
    use crate::case::{Case, Source};

    /// A given pressure may be the hardness, and no more; a mean pressure of contact stays below it.
    #[test]
    fn a_given_pressure_up_to_the_hardness_is_borne() {
        let with = |pressure: f64| {
            let text = format!(
                "lattice={{kind=\"isolated\",size=3}}\nload={{pressure={{disc=[[0,0,0.5]],value={pressure}}}}}\n\
                 substrate={{young=1,poisson=0.3,hardness=0.5}}"
            );
            Case::read(&Source { name: "case".to_owned(), text, ..Source::default() }, &[])
        };
        let borne = with(0.5).unwrap();
        assert!(borne.problem().bodies().hardness().is_some() && borne.problem().hardness().is_none());
        assert!(with(0.500001).unwrap_err().to_string().contains("of hardness 0.5, bears"));
    }
}
