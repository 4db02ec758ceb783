//! Assumptions of largest stresses and limit loads, in sentences below their tables.

use crate::body::MeanStress;

/// The mean lateral stress in the largest stresses and limit loads, in a sentence.
pub fn mean_stress(mean: MeanStress) -> &'static str {
    match mean {
        MeanStress::HalfSpace => {
            "stresses with stress.mean = \"half-space\": lateral stress under p̄ as in the centre of a wide loaded disc"
        }
        _ => "stresses with stress.mean = \"confined\": lateral stress under p̄ as without mean lateral strain",
    }
}

/// The indenters are rigid in utilisations and limit loads, and the way to treat elastic ones.
///
/// With 1/E\* = 1/E\*₁ + 1/E\*₂ the gap of two bare bodies is that of the body alone under heights times E\*/E\*₁: the same pressure,
/// and the body's own part of the penetration.
pub const RIGID: &str = "the indenters are rigid: elastic ones press less sharply, fail in their own ways, and lead to other limits. For a bare body \
     (E*₁) under bare elastic indenters (E*₂), E* = E/(1 − ν²), divide all heights, also slopes and coefficients, by \
     1 + E*₁/E*₂ and multiply radii by it (like bodies: R → 2R, half the heights): pressures, spots and stresses without friction \
     are then those of the pair, the penetration is the body's part of it; under a coating this is only near to it";

/// The mean lateral stress, and beside strengths the assumption of rigid indenters, in lines of at most `width` letters.
pub(super) fn assumed(mean: MeanStress, with_strength: bool, width: usize) -> String {
    let mut lines = wrapped(mean_stress(mean), width);
    if with_strength {
        lines.extend(wrapped(RIGID, width));
    }
    lines.into_iter().map(|line| line + "\n").collect()
}

/// A sentence in lines of at most so many letters, broken at blanks.
fn wrapped(sentence: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in sentence.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use crate::{HalfSpace, Indenters, Lattice, Level, Load, Material, Problem, Settings, Shape, Solver};

    /// Pressure and penetration under paraboloids of two heights on a bare body.
    fn solved(young: f64, times: f64) -> (Vec<f64>, f64) {
        let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 * times }, height / times).unwrap();
        let indenters = Indenters::new(Lattice::square(1.0, 2).unwrap(), vec![level(0.01), level(0.0)]).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(young, 0.3).unwrap());
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let step =
            Solver::new(Problem::new(indenters, body), [64; 2], settings).unwrap().solve(Load::MeanPressure(0.01));
        let reading = step.reading();
        (step.finest().pressure().iter().copied().collect(), reading.penetration)
    }

    /// Compliances of bare bodies add wave by wave: a pair is a body of 1/(1/E*₁ + 1/E*₂) under rigid indenters.
    #[test]
    fn a_bare_pair_is_a_body_under_flatter_rigid_indenters() {
        for other in [0.25, 1.0, 4.0] {
            // Moduli of one Poisson's ratio, E₁ = 1.
            let (pair, approach) = solved(1.0 / (1.0 + 1.0 / other), 1.0);
            let times = 1.0 + 1.0 / other;
            let (alone, penetration) = solved(1.0, times);
            let peak = pair.iter().copied().fold(0.0, f64::max);
            for (a, b) in pair.iter().zip(&alone) {
                assert!((a - b).abs() < 1e-7 * peak, "{other}: {a} {b}");
            }
            assert!((approach - times * penetration).abs() < 1e-7 * approach, "{other}");
        }
    }
}
