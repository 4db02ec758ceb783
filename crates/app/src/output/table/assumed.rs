//! Assumptions of largest stresses and limit loads, in sentences below their tables.

use super::text::lines;
use percoat_case::case::suggestions::joined;
use percoat_case::case::{Case, LibraryStrength, failures_of};
use percoat_core::body::{Bodies, Durability, HalfSpace, MeanStress, Strength};
use percoat_draw::number::short;
use serde_json::{Value, json};

/// The mean lateral stress in the largest stresses and limit loads, in a sentence; with the axis of lines, where it is known.
fn mean_stress(mean: MeanStress, line: Option<usize>) -> String {
    match mean {
        MeanStress::HalfSpace => {
            "stresses with stress.mean = \"half-space\": the lateral stress under p̄ is that in the centre of a wide loaded disc"
                .to_owned()
        }
        MeanStress::Line => format!(
            "stresses with stress.mean = \"line\": the lateral stress under p̄ is that under lines far apart{}, in plane strain",
            line.map_or("", |axis| [" along a₁", " along a₂"][axis])
        ),
        _ => {
            "stresses with stress.mean = \"confined\": the lateral stress under p̄ is that without mean lateral strain".to_owned()
        }
    }
}

/// Sentence on what a counterbody without moduli means for utilisations and limit loads.
const RIGID: &str = "the indenters are rigid: elastic ones press less sharply, may fail themselves, and lead to other \
                     limits; a section [counterbody] with `young` and `poisson`, or `material`, makes them elastic";

/// Assumptions of the largest stresses and limit loads of a case.
#[derive(Debug, Clone)]
pub struct Assumptions {
    /// The mean lateral stress; `None` of an isolated contact, which has none.
    pub mean: Option<MeanStress>,
    /// The axis of the cell along which the surface is constant, where it is known to be.
    pub line: Option<usize>,
    /// Whether indenters or a topography are rigid; a given pressure has none.
    pub rigid: bool,
    /// Names of the materials without a strength.
    pub untested: Vec<String>,
    /// The strengths that are numbers of the library, in sentences.
    pub library: Vec<String>,
    /// For which part of failures passes are stated, in a sentence; `None` where laws of fatigue have no scatter.
    pub scatter: Option<String>,
}

impl Assumptions {
    /// Assumptions of a case.
    pub fn of(case: &Case) -> Self {
        let (problem, keys) = (case.problem(), json!(case));
        Self {
            mean: problem.cell().surroundings().per_cell(case.mean_stress()),
            line: problem.loaded_by().line(),
            rigid: problem.has_rigid_counterbody(),
            untested: untested(problem.bodies()),
            library: library_strengths(&keys),
            scatter: scatter(&keys),
        }
    }

    /// A sentence for each that matters; `with_strength`: beside strengths.
    pub fn sentences(&self, with_strength: bool) -> Vec<String> {
        let mean = self.mean.map(|mean| mean_stress(mean, self.line));
        let rigid = (with_strength && self.rigid).then(|| RIGID.to_owned());
        let without_strength = self.without_strength().filter(|_| with_strength);
        let library = self.library.iter().filter(|_| with_strength).cloned();
        [mean, without_strength, rigid].into_iter().flatten().chain(library).chain(self.scatter.clone()).collect()
    }

    /// The materials without a strength, in a sentence; `None` where all have one.
    pub fn without_strength(&self) -> Option<String> {
        (!self.untested.is_empty()).then(|| {
            format!("no strength is given for {}: failure there is not checked", joined(&self.untested, "and"))
        })
    }

    /// The sentences in lines of at most `width` letters.
    pub(super) fn lines(&self, with_strength: bool, width: usize) -> String {
        self.sentences(with_strength).iter().map(|sentence| lines(sentence, width)).collect()
    }
}

/// For which part of failures the laws of fatigue of a serialised case state passes, in a sentence; `None` without a scatter.
pub fn scatter(case: &Value) -> Option<String> {
    let parts: Vec<String> = failures_of(case).into_iter().map(|part| format!("{} %", short(100.0 * part))).collect();
    (!parts.is_empty()).then(|| {
        format!(
            "passes to damage are those after which {} of many specimens have failed (`weibull_slope`)",
            joined(&parts, "or")
        )
    })
}

/// The strengths of a serialised case that are numbers of the library with their kind of test and their range, in sentences; empty
/// without any.
pub fn library_strengths(case: &Value) -> Vec<String> {
    let all = LibraryStrength::of_case(case);
    let unit = case["units"]["pressure"].as_str().unwrap_or_default();
    let of = |strength: &LibraryStrength| {
        let known =
            [strength.what.map(str::to_owned), strength.range.map(|[low, high]| format!("{low} to {high} {unit}"))];
        let known = known.into_iter().flatten().collect::<Vec<_>>().join(", ");
        let known = if known.is_empty() { known } else { format!(" ({known})") };
        format!("{} of {} {} {unit}{known}", strength.key.replace('_', " "), strength.material, strength.value)
    };
    if all.is_empty() {
        return Vec::new();
    }
    let told = all.iter().map(of).collect::<Vec<_>>().join("; ");
    let told =
        format!("strengths of the library, not of your part: {told}; percoat materials NAME states their sources");
    let brittle = all.iter().any(|strength| strength.key == "tensile_strength");
    [Some(told), brittle.then(|| BARS.to_owned())].into_iter().flatten().collect()
}

/// Sentence on what a tensile strength from a bar says of a contact.
pub(in crate::output) const BARS: &str = "tensile strengths of the library are those of test bars, which break at their largest flaw; the small volume under a \
                    contact bears more, so that loads of cracking computed from them are on the safe side";

/// Names of the materials without a strength, an endurance limit or a law of fatigue, each once.
fn untested(bodies: &Bodies) -> Vec<String> {
    let of = |body: &HalfSpace| -> Vec<String> {
        let materials = (1..).zip(body.strengths().zip(body.durabilities()));
        let is_tested = |strength: &Strength, durability: &Durability| {
            let by_stress = strength.yielding.is_some() || strength.tensile.is_some();
            let lasts = durability.fatigue.is_some() || durability.strain_life.is_some();
            by_stress || lasts || durability.endurance.is_some()
        };
        let without = materials.filter(|(_, (strength, durability))| !is_tested(strength, durability));
        without.map(|(number, _)| body.material_id(number).to_string()).collect()
    };
    let mut names: Vec<String> = bodies.each().flat_map(of).collect();
    names.dedup();
    names
}

#[cfg(test)]
mod tests {
    use percoat_core::{HalfSpace, Indenters, Lattice, Level, Load, Material, Problem, Settings, Shape, Solver};

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

#[cfg(test)]
mod sentences {
    use super::*;
    use percoat_core::body::{Endurance, Fatigue, Material};

    #[test]
    fn the_parts_of_failures_are_told_once_each() {
        let law = |failures: Value| json!({ "passes": 1e6, "weibull_slope": 1.5, "failures": failures });
        let case = json!({ "layers": [{ "fatigue": law(json!(null)) }, { "interface_fatigue": law(json!(0.1)) }],
                           "substrate": { "fatigue": law(json!(0.05)) } });
        let told = "passes to damage are those after which 5 % or 10 % of many specimens have failed (`weibull_slope`)";
        assert_eq!(scatter(&case).as_deref(), Some(told));
        assert_eq!(scatter(&json!({ "substrate": { "fatigue": { "passes": 1e6 } } })), None);
    }

    #[test]
    fn a_material_with_a_law_or_a_limit_of_fatigue_is_checked() {
        let of = |durability: Durability| {
            let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
            untested(&Bodies::from(body.with_substrate_durability(durability).unwrap())).len()
        };
        let (law, limits) = (Fatigue::new(0.4, 1e6, 8.0).unwrap(), Endurance::new(0.3, 0.5).unwrap());
        let given = [
            Durability { fatigue: Some(law), ..Durability::default() },
            Durability { endurance: Some(limits), ..Durability::default() },
            Durability { hardness: Some(1.0), ..Durability::default() },
        ];
        assert_eq!(given.map(of), [0, 0, 1]);
    }
}
