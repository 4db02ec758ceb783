//! `[tangential]`: partial slip by a tangential force or a shift at the end of each load step.

use super::error::Refusal;
use super::friction::FrictionSection;
use super::keys::{Form, Key, Range, Unit};
use super::load::LoadSection;
use super::node::Value;
use super::reader::TableAt;
use super::section::{KeyValue, ReadTable, section};
use super::value::ValueAt;
use percoat_core::friction::Friction;
use percoat_core::lattice::Surroundings;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::run::Motion;
use percoat_core::spectral::{Drive, Rolling, RollingDrive};
use serde::{Serialize, Serializer};
use std::ops::Bound;

/// Most steps of a history.
const STEPS: usize = 10_000;
/// Fewest steps of a cycle, and the number that they are a multiple of.
const QUARTERS: usize = 4;

const PART: Form = Form::Number(Range::Within(Bound::Excluded(-1.0), Bound::Excluded(1.0)));
const PARTS: Form = Form::List { of: &PART, count: [1, STEPS] };
const PAIR: Form = Form::Tuple("a pair [x, y]", &[PART; 2]);
const PAIRS: Form = Form::List { of: &PAIR, count: [1, STEPS] };
const CREEPAGE: Form = Form::Number(Range::Within(Bound::Excluded(-0.1), Bound::Excluded(0.1)));
const LENGTH: Form = Form::Number(Range::Coordinate);
const LENGTHS: Form = Form::List { of: &LENGTH, count: [1, STEPS] };
const LENGTH_PAIR: Form = Form::Tuple("a pair [x, y]", &[LENGTH; 2]);
const LENGTH_PAIRS: Form = Form::List { of: &LENGTH_PAIR, count: [1, STEPS] };

section! {
    /// The section `[tangential]`: one of the keys.
    pub struct TangentialSection = TANGENTIAL, rules one {
        /// tangential force at the end of each step over the largest friction μP: numbers along `friction.direction`, or pairs [x, y]
        pub force: Option<History> = Key::new(&[PARTS, PAIRS], "[0.3, -0.3, 0.3]"),
        /// shift of the counterbody against the body at the end of each step, from the first contact on: numbers along
        /// `friction.direction`, or pairs [x, y]
        pub shift: Option<History> =
            Key::new(&[LENGTHS, LENGTH_PAIRS], "[0.1, 0.2]").unit(Unit::Length).instead_of("force"),
        /// cycles of the tangential force
        pub path: Option<PathSection> = Key::new(&[Form::Table(&PATH)], "{ amplitude = 0.6, cycles = 1, steps = 8 }")
            .instead_of("shift")
            .and_of(&["force"]),
        /// steady rolling along `friction.direction`, at each load
        pub rolling: Option<RollingSection> = Key::new(&[Form::Table(&ROLLING)], "{ force = 0.3, distance = 4.0 }")
            .instead_of("path")
            .and_of(&["force", "shift"]),
    }
}

section! {
    /// Steady rolling.
    #[derive(Copy)]
    pub struct RollingSection = ROLLING, rules one_drive {
        /// tangential force over the largest friction μP
        pub force: Option<f64> = Key::new(&[PART], "0.3"),
        /// creepage along the direction of friction: by how much the counterbody gets ahead of the body, over the distance rolled
        pub creepage: Option<f64> = Key::new(&[CREEPAGE], "0.001").instead_of("force"),
        /// distance, in lengths of the contact along its way
        pub distance: f64 = Key::new(&[Form::Number(Range::between(0.5, 100.0))], "6.0").default("4.0"),
        /// step, in lengths of the contact; half as long ones are taken too
        pub step: f64 = Key::new(&[Form::Number(Range::between(0.01, 0.5))], "0.0625").default("0.125"),
    }
}

section! {
    /// Cycles of the tangential force around zero, after it has come to its amplitude.
    #[derive(Copy)]
    pub struct PathSection = PATH, rules whole_quarters {
        /// amplitude over the largest friction μP
        pub amplitude: f64 =
            Key::new(&[Form::Number(Range::Within(Bound::Excluded(0.0), Bound::Excluded(1.0)))], "0.6"),
        /// number of cycles
        pub cycles: usize = Key::new(&[Form::Integer(1, 100)], "2").default("1"),
        /// steps of a cycle
        pub steps: usize = Key::new(&[Form::Integer(QUARTERS, 1000)], "16").default("8").rule("a multiple of 4"),
    }
}

/// Force or shift at the end of a step: along the direction of friction, or a vector.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Component {
    /// Along the direction of friction.
    Along(f64),
    /// [x, y].
    Vector([f64; 2]),
}

/// Forces or shifts at the ends of the steps.
#[derive(Debug, Clone, PartialEq)]
pub struct History(Vec<Component>);

impl Serialize for History {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl KeyValue for History {
    /// Reads a list of numbers and pairs.
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        // As many items as the key admits.
        value.list()?;
        let (numbers, pairs): (&'static [Form], &'static [Form]) =
            if value.key.unit == Unit::Length { (&[LENGTH], &[LENGTH_PAIR]) } else { (&[PART], &[PAIR]) };
        let items = value.each(numbers).zip(value.each(pairs));
        let component = |(number, pair): (ValueAt<'_>, ValueAt<'_>)| match number.node.value {
            Value::List(_) => pair.numbers().map(Component::Vector),
            _ => number.number().map(Component::Along),
        };
        items.map(component).collect::<Result<Vec<_>, _>>().map(Self)
    }
}

fn one(_: &TangentialSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    section.one_of(["force", "shift", "path", "rolling"]).map(drop)
}

fn one_drive(_: &RollingSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    section.one_of(["force", "creepage"]).map(drop)
}

fn whole_quarters(path: &PathSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    if path.steps.is_multiple_of(QUARTERS) {
        return Ok(());
    }
    Err(section.value("steps")?.refuse("a multiple of 4, so that a cycle passes its ends and zero"))
}

impl TangentialSection {
    /// Reads the section of a case with a problem, its `friction` and its loads; `None` without one.
    pub(super) fn of_case(
        root: &TableAt<'_>,
        problem: &Problem,
        friction: Option<&FrictionSection>,
        load: &LoadSection,
    ) -> Result<Option<Self>, Refusal> {
        root.section("tangential")?.map(|section| Self::read_in(&section, problem, friction, load)).transpose()
    }

    fn read_in(
        section: &TableAt<'_>,
        problem: &Problem,
        friction: Option<&FrictionSection>,
        load: &LoadSection,
    ) -> Result<Self, Refusal> {
        let (keys, loads) = (Self::read_table(section)?, load.values().len());
        let refuse = |message: &str, label: &str| Refusal::new(section.span, format!("`tangential` {message}"), label);
        if friction.is_none_or(|friction| friction.coefficient == 0.0) {
            return Err(refuse("needs a coefficient of friction", "nothing holds the surfaces to each other")
                .help("add [friction] with coefficient = 0.3, or leave [tangential] out"));
        }
        if problem.kind().is_given {
            return Err(refuse("needs a counterbody", "a given pressure has none that sticks"));
        }
        if keys.rolling.is_some() {
            let cell = problem.cell();
            let direction = problem.friction().map_or([1.0, 0.0], Friction::direction);
            let is_along = |[x, y]: [f64; 2]| (x * direction[1] - y * direction[0]).abs() < 1e-9 * x.hypot(y);
            if cell.surroundings() == Surroundings::FreeSpace && !cell.vectors().into_iter().any(is_along) {
                return Err(refuse("rolls along a side of the window", "not along `friction.direction`")
                    .help("set friction.direction to [1, 0] or [0, 1]"));
            }
            return Ok(keys);
        }
        let drives = keys.drives([1.0, 0.0]);
        for drive in &drives {
            if let Drive::Part([x, y]) = drive
                && x.hypot(*y) >= 1.0
            {
                return Err(refuse("has a force that friction does not bear", "the counterbody slides under it")
                    .help("keep the size of each pair below 1; without [tangential] the counterbody slides"));
            }
        }
        if loads != 1 && loads != drives.len() {
            let message = format!("has {} steps, and `load` has {loads}", drives.len());
            return Err(refuse(&message, "as many steps as loads, or one load for all"));
        }
        Ok(keys)
    }

    /// Force or shift at the end of each step, with numbers along a direction.
    fn drives(&self, direction: [f64; 2]) -> Vec<Drive> {
        let vector = |component: &Component| match *component {
            Component::Along(size) => direction.map(|e| size * e),
            Component::Vector(vector) => vector,
        };
        match (&self.force, &self.shift, &self.path) {
            (Some(History(parts)), ..) => parts.iter().map(|part| Drive::Part(vector(part))).collect(),
            (_, Some(History(shifts)), _) => shifts.iter().map(|shift| Drive::Shift(vector(shift))).collect(),
            (.., Some(path)) => path.parts().into_iter().map(|part| Drive::Part(direction.map(|e| part * e))).collect(),
            _ => Vec::new(),
        }
    }

    /// Whether the contact rolls.
    pub fn rolls(&self) -> bool {
        self.rolling.is_some()
    }

    /// Number of steps of a case with so many loads.
    pub(super) fn step_count(&self, loads: usize) -> usize {
        if self.rolling.is_some() { loads } else { self.drives([1.0, 0.0]).len() }
    }

    /// The load and the motion of each step.
    pub(super) fn steps(&self, loads: Vec<Load>, friction: Option<&Friction>) -> (Vec<Load>, Vec<Motion>) {
        let direction = friction.map_or([1.0, 0.0], Friction::direction);
        if let Some(rolling) = self.rolling {
            let motion = rolling.motion(direction);
            let motions = vec![motion; loads.len()];
            return (loads, motions);
        }
        let motions: Vec<Motion> = self.drives(direction).into_iter().map(Motion::Shear).collect();
        match loads[..] {
            [load] => (vec![load; motions.len()], motions),
            _ => (loads, motions),
        }
    }
}

impl RollingSection {
    fn motion(&self, direction: [f64; 2]) -> Motion {
        let drive = match (self.force, self.creepage) {
            (Some(part), _) => RollingDrive::Part(direction.map(|e| part * e)),
            (None, creepage) => RollingDrive::Creepage(direction.map(|e| creepage.unwrap_or(0.0) * e)),
        };
        Motion::Roll(drive, Rolling { direction, distance: self.distance, step: self.step })
    }
}

impl PathSection {
    /// Parts of μP: up to the amplitude, then the cycles along straight lines between its ends.
    fn parts(&self) -> Vec<f64> {
        let Self { amplitude, cycles, steps } = *self;
        let quarter = steps / QUARTERS;
        // From 1 to −1 and back in a cycle, by equal steps.
        let wave = |k: usize| {
            let quarters = (QUARTERS * (k % steps)) as f64 / steps as f64;
            amplitude * ((quarters - 2.0).abs() - 1.0)
        };
        let rise = (1..=quarter).map(|k| amplitude * k as f64 / quarter as f64);
        rise.chain((1..=cycles * steps).map(wave)).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, Source, embedded};
    use percoat_core::run::Motion;
    use percoat_core::spectral::{Drive, RollingDrive};

    fn read(set: &[&str]) -> Result<Case, String> {
        let set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
        Case::read(&embedded::source("fig2").unwrap(), &set).map_err(|error| error.to_string())
    }

    const FRICTION: &str = "friction={ coefficient = 0.5, direction = [0, 2] }";

    #[test]
    fn a_force_is_along_the_direction_of_friction_or_a_pair() {
        let case = read(&[FRICTION, "tangential={ force = [0.3, [0.1, -0.2]] }", "load.mean_pressure=0.01"]).unwrap();
        let run = case.run();
        assert_eq!(run.loads.len(), 2);
        let motions = [[0.0, 0.3], [0.1, -0.2]].map(|part| Motion::Shear(Drive::Part(part)));
        assert_eq!(run.motions, Some(motions.to_vec()));
        let again = Source { text: case.to_toml(), ..Source::default() };
        assert!(Case::read(&again, &[]).unwrap() == case);
    }

    #[test]
    fn a_path_rises_and_goes_to_and_fro_by_equal_steps() {
        let set =
            [FRICTION, "tangential={ path = { amplitude = 0.6, cycles = 2, steps = 8 } }", "load.mean_pressure=0.01"];
        let motions = read(&set).unwrap().run().motions.unwrap();
        let expected = [3, 6, 3, 0, -3, -6, -3, 0, 3, 6, 3, 0, -3, -6, -3, 0, 3, 6];
        assert_eq!(motions.len(), expected.len());
        for (motion, tenths) in motions.iter().zip(expected) {
            let Motion::Shear(Drive::Part([x, y])) = motion else { panic!("{motion:?}") };
            assert!(*x == 0.0 && (y - 0.1 * f64::from(tenths)).abs() < 1e-14, "{motion:?} {tenths}");
        }
    }

    #[test]
    fn rolling_is_at_each_load_along_the_direction_of_friction() {
        let set = [FRICTION, "tangential={ rolling = { creepage = 0.001 } }", "load.mean_pressure=[0.01, 0.02]"];
        let run = read(&set).unwrap().run();
        let [first, second] = &run.motions.unwrap()[..] else { panic!("a motion a load") };
        let Motion::Roll(drive, rolling) = first else { panic!("{first:?}") };
        assert_eq!((first, *drive), (second, RollingDrive::Creepage([0.0, 0.001])));
        assert_eq!((rolling.direction, rolling.distance, rolling.step), ([0.0, 1.0], 4.0, 0.125));
        let both = "tangential={ rolling = { force = 0.1, creepage = 0.001 } }";
        assert!(read(&[FRICTION, both]).is_err());
    }

    #[test]
    fn what_cannot_stick_is_refused() {
        let path = "tangential={ path = { amplitude = 0.6 } }";
        for (set, why) in [
            (vec![path, "load.mean_pressure=0.01"], "needs a coefficient"),
            (vec![FRICTION, "tangential={ force = [1.2] }"], "less than 1"),
            (vec![FRICTION, "tangential={ force = [[0.8, 0.8]] }", "load.mean_pressure=0.01"], "does not bear"),
            (vec![FRICTION, "tangential={ force = [0.1, 0.2] }", "load.mean_pressure=[0.01, 0.02, 0.03]"], "2 steps"),
            (vec![FRICTION, "tangential={ path = { amplitude = 0.6, steps = 6 } }"], "multiple of 4"),
            (vec![FRICTION, "tangential={}"], "force"),
        ] {
            let error = read(&set).unwrap_err();
            assert!(error.contains(why), "{set:?}: {error}");
        }
    }
}
