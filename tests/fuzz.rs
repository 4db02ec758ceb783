//! Case files, overrides and surfaces that nobody would write: mutated and random ones, from a generator that always
//! gives the same.
//!
//! Whatever is read, the answer is a case or a refusal, at once: no panic, no overflow, no number that is none. A case
//! that is taken reads back equal and has finite responses. What the program does with it ends with a code from 0 to
//! 4 and leaves the files beside it alone.
//!
//! `PERCOAT_FUZZ=1000000 cargo test --test fuzz` runs as many instead of 4000; `PERCOAT_FUZZ_SEED` gives others.

#![cfg(feature = "cli")]

mod common;
#[path = "common/temporary.rs"]
mod temporary;

use common::Random;
use percoat::body::InPlane;
use percoat::case::resources::Job;
use percoat::case::{Case, Source, embedded, foreseen, plausibility, resources};
use percoat::machine::{Capacity, bytes};
use percoat::run::Sampling;
use percoat::{Depth, Grid, MeanStress, Substrate};
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// How long reading one case may take.
const AT_ONCE: Duration = Duration::from_secs(5);
/// How long a run on a tiny grid may take.
const SOON: Duration = Duration::from_secs(120);

/// A case with every section.
const RICH: &str = include_str!("common/rich.toml");

const VALUES: [&str; 48] = [
    "0",
    "1",
    "-1",
    "2",
    "0.5",
    "-0.0",
    "1e-9",
    "1e-7",
    "1e-3",
    "1e3",
    "1e7",
    "1e13",
    "1e-15",
    "1e155",
    "1e-155",
    "1e200",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "-9223372036854775808",
    "99999999999999999999",
    "32768",
    "32767",
    "2049",
    "7",
    "0x7fffffff",
    "true",
    "\"\"",
    "\"level 2\"",
    "\"level 0\"",
    "\"bonded\"",
    "\"frictionless\"",
    "[]",
    "{}",
    "[0, 0]",
    "[1, 1]",
    "[[0, 0]]",
    "[1e60, 1e-60]",
    "1979-05-27",
    "{ from = 1, to = 0, steps = 3 }",
    "{ tangential_stiffness = 1e-300 }",
    "{ points = 3, depth = 1e9, rows = 2 }",
];

const KEYS: [&str; 64] = [
    "title",
    "lattice",
    "lattice.kind",
    "lattice.period",
    "lattice.a1",
    "lattice.a2",
    "levels",
    "levels.0",
    "levels.0.shape",
    "levels.0.radius",
    "levels.0.height",
    "levels.1.height",
    "levels.0.slope",
    "levels.0.coefficient",
    "levels.0.exponent",
    "levels.0.sites",
    "levels.1.sites",
    "levels.2.sites",
    "surface",
    "surface.heights",
    "layers",
    "layers.0",
    "layers.0.thickness",
    "layers.0.shear_ratio",
    "layers.0.young",
    "layers.0.poisson",
    "layers.0.interface",
    "layers.0.interface.tangential_stiffness",
    "layers.0.interface.normal_stiffness",
    "substrate",
    "substrate.young",
    "substrate.poisson",
    "load",
    "load.mean_pressure",
    "load.mean_pressure.from",
    "load.mean_pressure.to",
    "load.mean_pressure.steps",
    "load.mean_pressure.spacing",
    "load.penetration",
    "grid",
    "grid.points",
    "grid.accuracy",
    "solver",
    "solver.method",
    "solver.tolerance",
    "solver.max_iterations",
    "stress",
    "stress.planes",
    "stress.mean",
    "stress.section",
    "stress.section.from",
    "stress.section.toward",
    "stress.section.length",
    "stress.section.depth",
    "stress.points",
    "stress.volume",
    "stress.volume.depth",
    "stress.volume.rows",
    "stress.volume.points",
    "localized",
    "localized.indenters",
    "localized.elements",
    "localized.radius",
    "localized.mutual_effect",
];

const CHARACTERS: &str = "\"'[]{}=.,#\n\r\t \\\0_-+eé∞0123456789abcxyz";

/// Between 0 and `below`, which is not reached.
fn index(random: &mut Random, below: usize) -> usize {
    (random.unit() * below as f64) as usize
}

/// A case that was one, with its overrides.
fn mutated(random: &mut Random) -> (String, Vec<String>) {
    let all = embedded::all();
    let number = index(random, all.len() + 3);
    let mut text = all.get(number).map_or(RICH, |(_, text)| text).to_owned();
    for _ in 0..index(random, 3) {
        text = changed(text, random);
    }
    let overrides = (0..index(random, 4)).map(|_| overridden(random)).collect();
    (text, overrides)
}

/// A text with one thing changed.
fn changed(text: String, random: &mut Random) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    if lines.is_empty() {
        return text;
    }
    let line = index(random, lines.len());
    match index(random, 9) {
        0 => drop(lines.remove(line)),
        1 => lines.insert(line, lines[index(random, lines.len())].clone()),
        2 => {
            let other = index(random, lines.len());
            lines.swap(line, other);
        }
        3..=6 => {
            // The value of some key.
            let keyed: Vec<usize> = (0..lines.len()).filter(|&line| lines[line].contains(" = ")).collect();
            if let Some(&line) = keyed.get(index(random, keyed.len().max(1))) {
                let key = lines[line].split(" = ").next().unwrap_or_default().to_owned();
                lines[line] = format!("{key} = {}", random.pick(&VALUES));
            }
        }
        7 => {
            let mut characters: Vec<char> = lines.join("\n").chars().collect();
            let new: Vec<char> = CHARACTERS.chars().collect();
            for _ in 0..=index(random, 4) {
                let at = index(random, characters.len());
                match index(random, 3) {
                    0 => characters[at] = random.pick(&new),
                    1 => characters.insert(at, random.pick(&new)),
                    _ => drop(characters.remove(at)),
                }
            }
            return characters.into_iter().collect();
        }
        _ => {
            let deep = "[".repeat(index(random, 3000));
            lines[line] = format!("{} = {deep}", random.pick(&["a", "title", "lattice"]));
            if random.unit() < 0.5 {
                lines.truncate(line);
            }
        }
    }
    lines.join("\n")
}

fn overridden(random: &mut Random) -> String {
    let key = match index(random, 12) {
        0 => random.pick(&KEYS).replace('.', ".."),
        1 => format!("{}.{}", random.pick(&KEYS), random.pick(&KEYS)),
        2 => random.pick(&KEYS).replace(".0", &format!(".{}", random.pick(&VALUES))),
        3 => "a.".repeat(index(random, 2000)) + "a",
        _ => random.pick(&KEYS).to_owned(),
    };
    let value = match index(random, 6) {
        0 => format!("{:e}", random.log(1e-300, 1e300)),
        1 => format!("{:.3}", random.log(1e-3, 1e3)),
        2 => random.pick(&["hexagonal", "square", "sphere", "cone", "power", "half-space", "polonsky-keer"]).to_owned(),
        _ => random.pick(&VALUES).to_owned(),
    };
    if index(random, 40) == 0 { format!("{key}{value}") } else { format!("{key}={value}") }
}

/// An .npy file that may be one.
fn surface(random: &mut Random) -> Vec<u8> {
    let lengths = ["0", "1", "2", "3", "8", "40000", "4294967296", "18446744073709551615", "-1", "x", ""];
    let axes: Vec<&str> = (0..index(random, 4)).map(|_| random.pick(&lengths)).collect();
    let axes = if index(random, 3) == 0 { vec!["8", "2"] } else { axes };
    let kinds = ["'<f8'", "'>f8'", "'<f8'", "'<f4'", "'|O'", "[('a', '<f8')]", "''", "8"];
    let shape =
        if index(random, 30) == 0 { "(".repeat(index(random, 60_000)) } else { format!("({},)", axes.join(", ")) };
    let order = random.pick(&["False", "True", "False", "0"]);
    let head = format!("{{'descr': {}, 'fortran_order': {order}, 'shape': {shape}, }}\n", random.pick(&kinds));
    let size = if index(random, 20) == 0 { random.unit() * 70_000.0 } else { head.len() as f64 } as u16;
    let mut bytes = [&b"\x93NUMPY"[..], &[1, 0], &size.to_le_bytes(), head.as_bytes()].concat();
    // Half of them have the 16 values of 8 × 2, so that some surfaces are taken.
    let count = if index(random, 2) == 0 { 16 } else { index(random, 20) };
    for _ in 0..count {
        let value = match index(random, 60) {
            0 => f64::NAN,
            1 => random.log(1e-300, 1e300),
            _ => 0.01 * random.unit(),
        };
        bytes.extend(value.to_le_bytes());
    }
    for _ in 0..index(random, 3) {
        let at = index(random, bytes.len());
        bytes[at] = (256.0 * random.unit()) as u8;
    }
    bytes
}

/// Whatever hangs on a case that was taken is finite, and it reads back equal.
fn holds_together(case: &Case) {
    let (half_space, cell) = (case.half_space(), case.problem().cell());
    for text in [plausibility::of_case(case), foreseen(case, &[])].concat() {
        assert!(!text.is_empty() && !text.to_lowercase().contains("nan"), "{text}");
    }
    let grids = case.grid.grids(&cell).expect("a case that is refined has a grid");
    for job in [Job::Solve { pictures: true, fields: true }, Job::Compare { pictures: true }] {
        let needs = resources::needs(case, grids[grids.len() - 1], job);
        assert!(needs.memory > 0 && bytes(needs.memory).contains('B'));
        assert!(0 < needs.disk && needs.disk <= needs.disk_while_running);
        // Half of the memory or disk that is needed never fits, whatever the machine at hand has.
        let [memory, disk] = [needs.memory / 2, needs.disk_while_running / 2];
        for room in [Capacity { memory, disk: u64::MAX }, Capacity { memory: u64::MAX, disk }] {
            if let Some(said) = resources::refusal(case, room, job) {
                assert!(said.contains("take about"), "{said}");
            }
        }
    }
    let grid = match case.grid {
        Sampling::Points(points) => Grid::new(cell, points).expect("a cell has a grid"),
        Sampling::Accuracy(_) => Grid::new(cell, [96, 96]).expect("a cell has a grid"),
    };
    let transfer = half_space.response();
    let least = grid.least_wavenumber();
    let most = std::f64::consts::PI / grid.spacing();
    for q in [least, (least * most).sqrt(), most, 4.0 * most] {
        let compliance = transfer.compliance(q);
        assert!(compliance.is_finite() && compliance > 0.0, "compliance {compliance} at {q}");
        let interior = transfer.interior(InPlane::Normal, q);
        // Nothing is inside a rigid base.
        let materials = half_space.layers().len() + usize::from(half_space.substrate() != Substrate::Rigid);
        let places = (1..=materials).flat_map(|material| {
            let (top, _) = half_space.faces(material);
            [top, top + 0.3 / q].map(|z| Depth { z, material })
        });
        for depth in places {
            let state = interior.at(depth);
            assert!((state.szz + state.sqz + state.sqq + state.stt).is_finite(), "{state:?} at q = {q}");
        }
    }
    for mean in [MeanStress::Confined, MeanStress::HalfSpace] {
        assert!(mean.lateral(half_space).iter().all(|stress| stress.is_finite()));
    }
    let copy =
        Source { name: "copy".to_owned(), text: case.to_toml(), folder: "elsewhere".into(), ..Source::default() };
    let again = Case::read(&copy, &[]).unwrap_or_else(|error| panic!("does not read back: {error}"));
    assert_eq!(&again, case, "reads back as another case");
}

/// Reads one case; gives whether it was taken.
fn judge(text: &str, overrides: &[String], folder: &Path) -> bool {
    let started = Instant::now();
    let source =
        Source { name: "case.toml".to_owned(), text: text.to_owned(), folder: folder.to_owned(), ..Source::default() };
    let outcome = catch_unwind(AssertUnwindSafe(|| match Case::read(&source, overrides) {
        Ok(case) => {
            holds_together(&case);
            true
        }
        Err(error) => {
            assert!(!error.message().is_empty() && error.render(false).starts_with("error: "), "{error}");
            false
        }
    }));
    let told = || format!("{overrides:?} on\n{text}");
    let taken = outcome.unwrap_or_else(|_| panic!("a panic with {}", told()));
    assert!(started.elapsed() < AT_ONCE, "{:?} with {}", started.elapsed(), told());
    taken
}

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
}

#[test]
fn whatever_is_written_is_a_case_or_refused_at_once() {
    let count = setting("PERCOAT_FUZZ", 4_000);
    let mut random = Random(setting("PERCOAT_FUZZ_SEED", 20_261_121));
    let folder = temporary::folder();
    const SURFACE: &str = "[lattice]\nkind = \"square\"\nperiod = 1\n[surface]\nheights = \"surface.npy\"\n\
                           [substrate]\nyoung = 1\npoisson = 0.3\n[load]\nmean_pressure = 1e-3\n";
    let (mut cases, mut surfaces) = (0, 0);
    for number in 0..count {
        if number % 5 == 0 {
            fs::write(folder.path().join("surface.npy"), surface(&mut random)).unwrap();
            surfaces += u64::from(judge(SURFACE, &[], folder.path()));
        } else {
            let (text, overrides) = mutated(&mut random);
            cases += u64::from(judge(&text, &overrides, folder.path()));
        }
    }
    println!("{count} tried: {cases} cases and {surfaces} surfaces were taken");
    // Both answers are there, or the generator says nothing.
    assert!(50 * cases > count && cases < count && surfaces > 0, "{cases} and {surfaces} of {count}");
}

/// Runs percoat in `folder`; its code, or what went wrong.
fn run(arguments: &[String], folder: &Path) -> Result<ExitStatus, String> {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("percoat"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null());
    let errors = fs::File::create(folder.join("errors.txt")).map_err(|error| error.to_string())?;
    let mut child = command.stderr(errors).spawn().map_err(|error| error.to_string())?;
    let started = Instant::now();
    loop {
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            return Ok(status);
        }
        if started.elapsed() > SOON {
            child.kill().and_then(|()| child.wait()).map_err(|error| error.to_string())?;
            return Err(format!("does not end within {SOON:?}"));
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn whatever_is_asked_of_the_program_ends_with_a_code_and_spares_other_files() {
    let count = setting("PERCOAT_FUZZ_RUNS", 24);
    let mut random = Random(setting("PERCOAT_FUZZ_SEED", 20_261_122));
    let folder = temporary::folder();
    let mut codes = [0; 5];
    while codes.iter().sum::<u64>() < count {
        let (text, mut overrides) = mutated(&mut random);
        // Thousands of load steps end, but not soon.
        overrides.retain(|text| !text.contains("steps"));
        let source =
            Source { name: String::new(), text: text.clone(), folder: folder.path().to_owned(), ..Source::default() };
        // Most mutants are refused, which the other test sees to.
        if Case::read(&source, &overrides).is_err() && random.unit() < 0.9 {
            continue;
        }
        fs::write(folder.path().join("case.toml"), &text).unwrap();
        fs::write(folder.path().join("mine.txt"), "mine").unwrap();
        let points = random.pick(&["16", "[24, 12]", "[8, 30]"]);
        overrides.extend([format!("grid.points={points}"), "solver.max_iterations=60".to_owned()]);
        let word = |text: &str| text.to_owned();
        let mut arguments = match index(&mut random, 8) {
            0 => vec![word("check"), word("case.toml")],
            1 => vec![word("kernel"), word("case.toml"), word("--wavenumber=1e-9,1,1e30"), word("--depth=0,0.1,1e50")],
            2 => {
                overrides.extend(["localized.elements=8", "localized.indenters=[7]"].map(word));
                vec![word("compare"), word("case.toml"), word("--no-pictures"), word("-oout")]
            }
            3 => vec![word("solve"), word("case.toml"), word("-oout")],
            _ => vec![word("solve"), word("case.toml"), word("-oout"), word("--no-pictures")],
        };
        arguments.extend(overrides.iter().filter(|text| !text.contains('\0')).map(|text| format!("--set={text}")));
        let status = run(&arguments, folder.path());
        let said = String::from_utf8_lossy(&fs::read(folder.path().join("errors.txt")).unwrap()).into_owned();
        let told = || format!("{arguments:?} on\n{text}\n{said}");
        let status = status.unwrap_or_else(|error| panic!("{error}: {}", told()));
        let code = status.code().unwrap_or_else(|| panic!("{status}: {}", told()));
        assert!((0..=4).contains(&code), "code {code}: {}", told());
        assert!(!said.contains("panicked"), "{}", told());
        assert_eq!(fs::read_to_string(folder.path().join("mine.txt")).unwrap(), "mine");
        assert_eq!(fs::read_to_string(folder.path().join("case.toml")).unwrap(), text);
        codes[code as usize] += 1;
    }
    println!("codes 0 to 4: {codes:?}");
    assert!(codes[0] > 0 && codes[1] == 0 && codes[4] == 0, "{codes:?}");
}
