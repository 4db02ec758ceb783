//! `[time]`: loads that change in time on bodies that creep.

use super::error::Refusal;
use super::keys::{Form, Key, Keys, Range, Unit, measured_in};
use super::load::{LOADS, LoadSection, RANGE, SIGNED, STEPS, Steps};
use super::reader::TableAt;
use super::section::section;
use percoat_core::problem::Problem;
use percoat_core::reading::Criterion;
use percoat_core::run::Times;
use percoat_core::spectral::CreepError;
use std::ops::Bound;

const PAIR: Form = Form::Tuple("a pair [time, load]", &[SIGNED; 2]);
const PAIRS: Form = Form::List { of: &PAIR, count: [1, STEPS] };
const TOLERANCE: Form = Form::Number(Range::Within(Bound::Excluded(0.0), Bound::Included(1.0)));
static TIMES: Keys = Keys::new(&measured_in::<5>(RANGE.all, Unit::Time));

section! {
    /// The section `[time]`: one path of loads.
    pub struct TimeSection = TIME, rules one_path {
        /// mean pressures in time: pairs of a time and of the mean pressure then, which is linear in between; two pairs of one time, and the first pair, are a jump
        pub load: Option<Vec<[f64; 2]>> = Key::new(&[PAIRS], "[[0.0, 0.0], [1.0, 0.05], [100.0, 0.05]]")
            .unit(Unit::Pressure).rule("times ascend, loads are not below 0"),
        /// forces on one cell in time, likewise
        pub force: Option<Vec<[f64; 2]>> = Key::new(&[PAIRS], "[[0.0, 5.0], [100.0, 5.0]]")
            .unit(Unit::Force).rule("times ascend, loads are not below 0").instead_of("load"),
        /// penetrations in time, likewise: the force relaxes
        pub penetration: Option<Vec<[f64; 2]>> = Key::new(&[PAIRS], "[[0.0, 0.01], [100.0, 0.01]]")
            .unit(Unit::Length).rule("times ascend, loads are not below 0").instead_of("force").and_of(&["load"]),
        /// times, beside those of the path, at which a load step is written
        pub times: Option<Steps> =
            Key::new(&[SIGNED, LOADS, Form::Table(&TIMES)], "{ from = 0.01, to = 100.0, steps = 20, spacing = \"log\" }")
                .unit(Unit::Time).otherwise("those of the path"),
        /// largest error of one step in time, beside the largest penetration and pressure so far; above it the step is divided
        pub tolerance: f64 = Key::new(&[TOLERANCE], "1e-4").default("1e-3"),
    }
}

fn one_path(keys: &TimeSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    let (_, value) = section.one_of(["load", "force", "penetration"])?;
    let path = keys.path();
    let refused = |index: usize, what: &str, label: &str| {
        let items = value.list().unwrap_or_default();
        let span = items.get(index).map_or(value.node.span, |item| item.node.span);
        Refusal::new(span, format!("`{}[{index}]` {what}", value.path), label)
    };
    if let Some(index) = path.windows(2).position(|pair| pair[1][0] < pair[0][0]) {
        let what = format!("has the time {}, before that of the pair in front of it", path[index + 1][0]);
        return Err(refused(index + 1, &what, "too early").help("order the pairs by their times"));
    }
    if let Some(index) = path.iter().position(|pair| pair[1] < 0.0) {
        let refusal = refused(index, &format!("has the load {}, below 0", path[index][1]), "draws apart");
        return Err(refusal.help("loads in time press"));
    }
    let [first, last] = [path.first(), path.last()].map(|pair| pair.map_or(0.0, |pair| pair[0]));
    let Some(times) = keys.times.as_ref().map(Steps::values) else { return Ok(()) };
    if times.iter().any(|time| !(first..=last).contains(time)) {
        let value = section.value("times")?;
        let message = format!("`{}` has times outside of the path, which goes from {first} to {last}", value.path);
        return Err(Refusal::new(value.node.span, message, "beyond the path")
            .help("give times within the path, or a longer path"));
    }
    if path.len() + times.len() > STEPS {
        let value = section.value("times")?;
        let message = format!("`{}`: the path and its further times are more than {STEPS}", value.path);
        return Err(Refusal::new(value.node.span, message, "too many").help("give fewer times"));
    }
    Ok(())
}

impl TimeSection {
    /// Pairs of a time and a load.
    fn path(&self) -> &[[f64; 2]] {
        [&self.load, &self.force, &self.penetration].into_iter().flatten().next().map_or(&[], Vec::as_slice)
    }

    /// Pairs of a time and a load, with those at the further times.
    fn told(&self) -> Vec<[f64; 2]> {
        let path = self.path();
        let mut further = self.times.as_ref().map_or(Vec::new(), |times| times.values().to_vec());
        further.retain(|time| !path.iter().any(|pair| pair[0] == *time));
        further.sort_by(f64::total_cmp);
        further.dedup();
        let mut all = path.to_vec();
        for time in further {
            let behind = all.partition_point(|pair| pair[0] < time);
            let [[before, from], [after, to]] = [all[behind - 1], all[behind]];
            all.insert(behind, [time, from + (time - before) / (after - before) * (to - from)]);
        }
        all
    }

    /// Loads at all times.
    pub(super) fn loads(&self) -> LoadSection {
        let values = Steps::of(self.told().into_iter().map(|[_, load]| load).collect());
        let mut section = LoadSection::in_time();
        let of = match (&self.load, &self.force) {
            (Some(_), _) => &mut section.mean_pressure,
            (None, Some(_)) => &mut section.force,
            (None, None) => &mut section.penetration,
        };
        *of = Some(values);
        section
    }

    /// Times of the loads.
    pub fn times(&self) -> Times {
        Times { times: self.told().into_iter().map(|[time, _]| time).collect(), tolerance: self.tolerance }
    }

    /// A refusal where another section or the bodies do not allow loads in time.
    pub(super) fn follow(section: &TableAt<'_>, root: &TableAt<'_>, problem: &Problem) -> Result<(), Refusal> {
        let refuse = |message: &str, label: &str| Refusal::new(section.span, format!("`time`: {message}"), label);
        for (other, why) in [
            ("tangential", "a contact that sticks is not followed on bodies that creep"),
            ("composite_hardness", "surfaces of bodies that creep have no hardness here"),
            ("life", "wear and passes of bodies that creep are not followed"),
            ("stress", "stresses of bodies that creep are not computed"),
        ] {
            if root.section(other)?.is_some() {
                return Err(refuse(why, "not together").help(format!("leave [{other}] or [time] out")));
            }
        }
        let bodies = problem.bodies();
        let is_judged = !Criterion::all(bodies).is_empty() || bodies.tire();
        let stresses = if is_judged { Err(CreepError::Stresses) } else { Ok(()) };
        CreepError::of_problem(problem).and(stresses).map_err(|error| {
            let help = match error {
                CreepError::Elastic => "give a layer, the substrate or the counterbody `relaxation`, or use [load]",
                CreepError::Isolated => {
                    "set lattice.kind = \"square\" with a period of many contact widths: the answer over two periods shows what is left of the images"
                }
                CreepError::Hardness => {
                    "leave `hardness` out, also that of a `material`: take its numbers instead of its name"
                }
                CreepError::Adhesion => "leave [adhesion] or [time] out",
                CreepError::Friction => "leave [friction] or [time] out",
                CreepError::Motion => "leave [motion] or [time] out",
                _ => "leave strengths and laws of fatigue out, also those of a `material`: take its numbers instead of its name",
            };
            refuse(&error.to_string(), "loads in time").help(help)
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, Source};
    use percoat_core::load::Load;
    use percoat_core::spectral::TIME_TOLERANCE;

    fn read(time: &str, more: &str) -> Result<Case, String> {
        let text = format!(
            "lattice = {{ kind = \"square\", period = 4.0 }}\nlevels = [{{ shape = \"paraboloid\", radius = 1.0 }}]\n\
             substrate = {{ young = 1.0, poisson = 0.3, relaxation = {{ shear = [3.0], times = [1.0] }} }}\n\
             units = {{ length = \"µm\", pressure = \"MPa\", time = \"s\" }}\ngrid = {{ points = 64 }}\ntime = {{ {time} }}\n{more}"
        );
        Case::read(&Source { name: "case".to_owned(), text, ..Source::default() }, &[])
            .map_err(|error| error.to_string())
    }

    #[test]
    fn a_path_is_read_with_the_times_between_and_written_back() {
        let path = "[[0.0, 0.0], [1.0, 0.05], [1.0, 0.02], [5.0, 0.02]]";
        let case = read(&format!("load = {path}, times = [0.5, 1.0, 3.0]"), "").unwrap();
        let run = case.run();
        assert_eq!(run.times.as_ref().unwrap().times, [0.0, 0.5, 1.0, 1.0, 3.0, 5.0]);
        assert_eq!(run.times.unwrap().tolerance, TIME_TOLERANCE);
        assert_eq!(run.loads, [0.0, 0.025, 0.05, 0.02, 0.02, 0.02].map(Load::MeanPressure));
        assert_eq!(case.step_count(), 6);
        let text = case.to_toml();
        assert!(!text.contains("[load]"), "{text}");
        assert!(Case::read(&Source { text, ..Source::default() }, &[]).unwrap() == case);
        for (key, load) in [("force", Load::Force(0.5)), ("penetration", Load::Penetration(0.5))] {
            let run = read(&format!("{key} = [[0.0, 0.5], [7.0, 0.5]], tolerance = 0.01"), "").unwrap().run();
            assert_eq!((run.loads, run.times.unwrap().tolerance), (vec![load; 2], 0.01));
        }
        let logarithmic = "times = { from = 0.1, to = 10.0, steps = 3, spacing = \"log\" }";
        let run = read(&format!("load = [[0.0, 1e-3], [10.0, 1e-3]], {logarithmic}"), "").unwrap().run();
        assert_eq!(run.times.unwrap().times.len(), 4);
    }

    #[test]
    fn what_is_not_followed_in_time_is_refused() {
        let path = "load = [[0.0, 0.1], [5.0, 0.1]]";
        for (time, more, why) in [
            ("load = [[0.0, 0.1], [-1.0, 0.1]]", "", "`time.load[1]` has the time -1, before"),
            ("load = [[0.0, -0.1]]", "", "has the load -0.1, below 0"),
            ("load = [[0.0, 0.1, 0.2]]", "", "a pair [time, load]"),
            ("tolerance = 0.1", "", "`time.load`, `time.force` or `time.penetration` is missing"),
            (&format!("{path}, times = 7.0"), "", "outside of the path"),
            (path, "load = { mean_pressure = 0.1 }", "exclude each other"),
            (path, "stress = {}", "[stress]"),
            (path, "friction = { coefficient = 0.1 }", "[friction]"),
            (path, "motion = { velocity = 0.1 }", "[motion]"),
            (path, "adhesion = { work = 1e-3, range = 1.0 }", "[adhesion]"),
            (path, "life = {}", "[life]"),
            (path, "layers = [{ thickness = 0.1, young = 1.0, poisson = 0.3, yield_strength = 1.0 }]", "strengths"),
            (path, "layers = [{ thickness = 0.1, young = 1.0, poisson = 0.3, hardness = 1.0 }]", "hardness"),
        ] {
            let error = read(time, more).unwrap_err();
            assert!(error.contains(why), "{time} {more}: {error}");
        }
        let text = "lattice = { kind = \"square\", period = 4.0 }\nlevels = [{ shape = \"paraboloid\", radius = 1.0 }]\n\
                    substrate = { young = 1.0, poisson = 0.3 }\ngrid = { points = 64 }\ntime = { load = [[0, 0.1]] }";
        let elastic = Case::read(&Source { text: text.to_owned(), ..Source::default() }, &[]);
        assert!(elastic.unwrap_err().to_string().contains("no material of the bodies relaxes"));
        let isolated = read(path, "").map(|_| ()).and_then(|()| {
            let text = "lattice = { kind = \"isolated\", size = 4.0 }\nlevels = [{ shape = \"paraboloid\", radius = 1.0 }]\n\
                        substrate = { young = 1.0, poisson = 0.3, relaxation = { shear = [3.0], times = [1.0] } }\n\
                        grid = { points = 64 }\ntime = { force = [[0, 0.1]] }";
            let read = Case::read(&Source { text: text.to_owned(), ..Source::default() }, &[]);
            read.map(|_| ()).map_err(|error| error.to_string())
        });
        assert!(isolated.unwrap_err().contains("periodic cell"));
    }
}
