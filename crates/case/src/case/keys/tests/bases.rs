//! Cases in which each key can be set.

use super::super::key::Key;
use crate::case::model::CASE;
use crate::case::{Case, CaseError, Source};
use toml::{Table, Value};

const RICH: &str = include_str!("../../../../../../tests/common/rich.toml");

const BODY: &str = "substrate = { young = 1.0, poisson = 0.3 }\nload = { mean_pressure = 1e-3 }\n\
                    units = { length = \"µm\" }\ngrid = { points = 8 }\n";

/// A few cases that have every table of the keys between them, and a folder with the file of one.
pub struct Bases {
    folder: tempfile::TempDir,
    cases: Vec<Table>,
}

/// One of the cases, at a key.
pub struct At<'a> {
    bases: &'a Bases,
    case: Table,
    /// The keys and indices that lead to the table of the key.
    steps: Vec<String>,
    path: String,
}

/// Every key with its path.
pub fn all_keys() -> Vec<(String, &'static Key)> {
    let tables = CASE.tables("").into_iter();
    let keys = tables.flat_map(|(path, keys)| keys.all.iter().map(move |key| (format!("{path}.{}", key.name), key)));
    keys.map(|(path, key)| (path.trim_start_matches('.').to_owned(), key)).collect()
}

/// A folder with the files that the cases name.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let surface = |name: &str, height: fn(u32) -> u32| {
        let head = b"{'descr': '<f8', 'fortran_order': False, 'shape': (8, 8)}";
        let values: Vec<u8> = (0..64).flat_map(|k| f64::from(height(k)).to_le_bytes()).collect();
        let npy = [b"\x93NUMPY\x01\0", &[head.len() as u8, 0][..], head, &values].concat();
        std::fs::write(folder.path().join(name), npy).unwrap();
    };
    surface("surface.npy", |k| k * k % 7);
    // Heights along one side of the cell.
    surface("lines.npy", |k| (k / 8).pow(2) % 7);
    let material = "[[material]]\nname = \"own\"\nyoung = 210.0\npoisson = 0.3\n";
    std::fs::write(folder.path().join("own.toml"), material).unwrap();
    std::fs::write(folder.path().join("tip.csv"), "depth,area\n0.01,0.1\n1.0,30.0\n").unwrap();
    folder
}

/// Cases that stick and slip, with each key of `[tangential]`.
fn slipping(case: String) -> impl Iterator<Item = String> {
    let keys = [
        "force = [0.3]",
        "shift = [0.1]",
        "path = { amplitude = 0.5 }",
        "rolling = { force = 0.1 }",
        "rolling = { creepage = 0.01 }",
    ];
    keys.into_iter().map(move |keys| format!("{case}friction = {{ coefficient = 0.1 }}\ntangential = {{ {keys} }}\n"))
}

/// Cases that adhere, with each key of `[adhesion]` and the loads that they alone have: a grip, and every load below 0.
fn adhering(head: &str) -> [String; 6] {
    let range = "{ from = 1e-3, to = 2e-3, steps = 3 }";
    let loads =
        ["mean_pressure", "force", "penetration", "grip"].map(|key| (format!("{key} = {range}"), "range = 0.1"));
    let others = [("grip = 1e-3, machine_stiffness = 2.0", "range = 0.1"), ("force = 1e-3", "strength = 0.1")];
    let [first, second] = others.map(|(load, keys)| (load.to_owned(), keys));
    let [mean, force, penetration, grip] = loads;
    [mean, force, penetration, grip, first, second].map(|(load, keys)| {
        let body = BODY.replace("mean_pressure = 1e-3", &load);
        format!("{head}{body}adhesion = {{ work = 1e-3, {keys} }}\n")
    })
}

/// Cases that move steadily: over materials that relax, and with heat of friction, layers and a counterbody that conduct.
fn moving(head: &str) -> [String; 2] {
    let conducts = "conductivity = 45.0, diffusivity = 12.0, expansion = 1.2e-5";
    let relaxes = "relaxation = { shear = [3.0, 6.0], times = [1.0, 0.05], constant = \"poisson\" }";
    let timed = BODY.replace("\"µm\" }", "\"µm\", time = \"s\", temperature = \"K\" }");
    let body = |keys: &str| timed.replace("poisson = 0.3", &format!("poisson = 0.3, {keys}"));
    let layer = |keys: &str| format!("{{ thickness = 1.0, young = 2.0, poisson = 0.2, {keys} }}");
    let motion = "motion = { velocity = 1.0 }\n";
    let above = |keys: &str, layers: &str| {
        format!("layers = [{layers}]\ncounterbody = {{ young = 1.0, poisson = 0.3, {keys}, layers = [{layers}] }}\n")
    };
    let resists = layer(&format!("{conducts}, thermal_resistance = 0.1"));
    [
        format!("{head}{}{}{motion}", body(relaxes), above(relaxes, &layer(relaxes))),
        format!(
            "{head}{}{}{motion}friction = {{ coefficient = 0.1 }}\nheat = {{ partition = 0.5, bulk = [20.0, 30.0], expansion = false }}\n",
            body(conducts),
            above(conducts, &resists)
        ),
    ]
}

/// Cases of bodies that relax: one that moves, and some with each key of `[time]`.
fn relaxing(head: &str) -> impl Iterator<Item = String> {
    let relaxation = "relaxation = { shear = [3.0, 6.0], times = [1.0, 0.05], constant = \"bulk\" }";
    let layers = format!("layers = [{{ thickness = 1.0, young = 2.0, poisson = 0.2, {relaxation} }}]");
    let body = BODY.replace("poisson = 0.3", &format!("poisson = 0.3, {relaxation}"));
    let counterbody = format!("counterbody = {{ young = 1.0, poisson = 0.3, {relaxation}, {layers} }}\n");
    let moves = format!("{head}{body}{layers}\n{counterbody}motion = {{ velocity = 2.0 }}\n");
    let still = format!("{head}{}{layers}\n{counterbody}", body.replace("load = { mean_pressure = 1e-3 }\n", ""));
    let times = ["times = [0.5, 2.0]", "times = { from = 0.5, to = 2.0, steps = 3 }"];
    let paths = ["load", "force", "penetration"].map(|key| format!("{key} = [[0.0, 0.0], [1.0, 1e-3], [100.0, 1e-3]]"));
    let in_time =
        paths.into_iter().flat_map(move |path| times.map(|times| format!("{still}time = {{ {path}, {times} }}\n")));
    std::iter::once(moves).chain(in_time)
}

/// A case under a counterbody with layers.
fn below_layers(case: &Table, layers: Value) -> String {
    let mut counterbody: Table =
        "young = 2e11\npoisson = 0.3\nyield_strength = 1e9\ntensile_strength = 2e9\nname = \"ball\"\n\
         fatigue = { amplitude = 4e8, passes = 1e6, exponent = 8, weibull_slope = 2.0 }\nendurance = { torsion = 4e8, bending = 6e8 }\n\
         strain_life = { strain = 1e-3, passes = 1e6, exponent = 5, direction = \"compression\" }\n"
            .parse()
            .unwrap();
    counterbody.insert("layers".to_owned(), layers);
    let mut case = case.clone();
    case.insert("counterbody".to_owned(), Value::Table(counterbody));
    toml::to_string(&case).unwrap()
}

impl Bases {
    pub fn new() -> Self {
        let linear = RICH.replace("\"log\"", "\"linear\"");
        let plain =
            "lattice = { kind = \"hexagonal\", period = 1.0 }\nlevels = [{ shape = \"paraboloid\", radius = 1.0 }]\n";
        let layer = |keys: &str| format!("layers = [{{ thickness = 1.0, {keys} }}]\n");
        let graded = layer("graded = { shear_ratio = [2, 1], poisson = [0.2, 0.3], sublayers = 5 }");
        let uniform = layer("shear_ratio = 2.0, poisson = 0.2");
        let window =
            "lattice = { kind = \"isolated\", size = 2.0 }\nlevels = [{ shape = \"paraboloid\", radius = 1.0 }]\n";
        // The counterbody has the layers of the rich case, and a graded one.
        let rich: Table = linear.parse().unwrap();
        let graded_above = below_layers(&rich, graded.parse::<Table>().unwrap()["layers"].clone());
        let limits = "endurance = { torsion = 0.4, bending = 0.5 }";
        let spectrum = "hurst = 0.5, shortest = 0.3, longest = 1.0, rolloff = 0.6, rms_slope = 0.2";
        let texts = [
            format!("{plain}{BODY}{uniform}friction = {{ coefficient = 0.1 }}\nlife = {{ passes = 10 }}\n"),
            linear.clone(),
            linear.replace("mean_pressure =", "penetration ="),
            linear.replace("mean_pressure =", "force ="),
            format!("{plain}{BODY}{graded}"),
            format!("surface = {{ heights = \"surface.npy\", period = 20.0 }}\n{BODY}"),
            format!("surface = {{ heights = \"surface.npy\", pixel = 0.5 }}\n{BODY}"),
            format!("surface = {{ heights = \"lines.npy\", period = 20.0 }}\nstress = {{}}\n{BODY}"),
            format!("surface = {{ period = 1.0, random = {{ {spectrum} }} }}\n{BODY}"),
            below_layers(&rich, rich["layers"].clone()),
            graded_above,
            format!("{window}{}", BODY.replace("mean_pressure", "force")),
            format!("{plain}{BODY}counterbody = {{ rigid = true, hardness = 9.0 }}\n"),
            format!(
                "{plain}{}{}counterbody = {{ young = 1.0, poisson = 0.3, {limits}, layers = [{{ thickness = 1.0, young = 2.0, poisson = 0.2, {limits} }}] }}\n",
                BODY.replace("poisson = 0.3", &format!("poisson = 0.3, {limits}")),
                layer(&format!("young = 2.0, poisson = 0.2, {limits}"))
            ),
            format!(
                "{plain}{}{}counterbody = {{ rigid = true, layers = [{{ thickness = 1.0, young = 2.0, poisson = 0.2 }}] }}\n",
                BODY.replace("young = 1.0, poisson = 0.3", "rigid = true"),
                layer("young = 2.0, poisson = 0.2")
            ),
            format!(
                "lattice = {{ kind = \"isolated\", size = 2.0 }}\n{}",
                BODY.replace("mean_pressure = 1e-3", "pressure = { disc = [[0.0, 0.0, 0.1]], value = 0.7 }")
            ),
            format!(
                "lattice = {{ kind = \"isolated\", size = 2.0 }}\nsurface = {{ heights = \"surface.npy\", radius = 3.0 }}\n{}",
                BODY.replace("mean_pressure", "force")
            ),
            format!(
                "lattice = {{ kind = \"isolated\", size = 2.0 }}\nlevels = [{{ shape = \"sphere\", radius = 1.0 }}]\n{}{}\
                 composite_hardness = {{ law = \"area\", constant = 0.5 }}\n",
                BODY.replace("mean_pressure", "force").replace("poisson = 0.3", "poisson = 0.3, hardness = 0.1"),
                layer("young = 2.0, poisson = 0.2, hardness = 0.2")
            ),
            format!(
                "lattice = {{ kind = \"hexagonal\", period = 10.0 }}\nlevels = [\
                 {{ shape = \"measured\", area = {{ coefficients = [24.5, 0.2], depths = [0.05, 1.0], unit = \"nm\" }} }}, \
                 {{ shape = \"sphero-cone\", radius = 1.0, half_angle = 60.0 }}, {{ shape = \"berkovich\", tip_radius = 0.5 }}]\n{BODY}"
            ),
        ];
        let more = adhering(plain).into_iter().chain(moving(plain)).chain(relaxing(plain));
        let texts = more.chain(slipping(format!("{plain}{BODY}{uniform}"))).chain(texts).chain([BODY.to_owned()]);
        Self { folder: folder(), cases: texts.map(|text| text.parse().unwrap()).collect() }
    }

    /// Texts of all of them that are cases as they stand.
    pub fn all(&self) -> impl Iterator<Item = String> {
        self.cases[..self.cases.len() - 1].iter().map(|case| toml::to_string(case).unwrap())
    }

    pub fn read(&self, text: &str, overrides: &[String]) -> Result<Case, CaseError> {
        let folder = self.folder.path().to_owned();
        Case::read(
            &Source { name: "case.toml".to_owned(), text: text.to_owned(), folder, ..Source::default() },
            overrides,
        )
    }

    /// Every case that has the table of the key, of its kind.
    pub fn each(&self, path: &str) -> impl Iterator<Item = At<'_>> {
        let (home, name) = path.rsplit_once('.').unwrap_or(("", path));
        let parts: Vec<&str> = home.split('.').filter(|part| !part.is_empty()).collect();
        let key = all_keys().into_iter().find(|(listed, _)| listed == path).unwrap().1;
        let fits = move |table: &Table| {
            let mut words = table.values().filter_map(Value::as_str);
            key.kinds.is_empty() || words.any(|word| key.kinds.contains(&word))
        };
        let found = self.cases.iter().filter_map(move |case| {
            let steps = steps(&Value::Table(case.clone()), &parts, &fits)?;
            Some(At { bases: self, case: case.clone(), steps, path: path_of(case, &parts, name, &fits)? })
        });
        found.collect::<Vec<_>>().into_iter()
    }
}

/// The way to a table that fits.
fn steps(value: &Value, parts: &[&str], fits: &impl Fn(&Table) -> bool) -> Option<Vec<String>> {
    match (value, parts) {
        (Value::Array(items), _) => items
            .iter()
            .enumerate()
            .find_map(|(index, item)| Some([vec![index.to_string()], steps(item, parts, fits)?].concat())),
        (Value::Table(table), []) => fits(table).then(Vec::new),
        (Value::Table(table), [part, rest @ ..]) => {
            Some([vec![(*part).to_owned()], steps(table.get(*part)?, rest, fits)?].concat())
        }
        _ => None,
    }
}

/// The path of a key as refusals have it: `levels[1].slope`.
fn path_of(case: &Table, parts: &[&str], name: &str, fits: &impl Fn(&Table) -> bool) -> Option<String> {
    let steps = steps(&Value::Table(case.clone()), parts, fits)?;
    let path = steps.iter().map(|step| match step.parse::<usize>() {
        Ok(index) => format!("[{index}]"),
        Err(_) => format!(".{step}"),
    });
    Some(format!("{}.{name}", path.collect::<String>()).trim_start_matches('.').to_owned())
}

impl At<'_> {
    /// The path of the key as refusals have it.
    pub fn path(&self) -> &str {
        &self.path
    }

    fn name(&self) -> &str {
        self.path.rsplit('.').next().unwrap()
    }

    /// The case without the key and those that it excludes.
    fn cleared(&self) -> Table {
        let mut case = Value::Table(self.case.clone());
        let names = self.steps.iter().filter(|step| step.parse::<usize>().is_err());
        let keys = names.fold(&CASE, |keys, name| keys.within(name));
        let table = table(&mut case, &self.steps);
        table.remove(self.name());
        keys.excluded(self.name()).iter().for_each(|other| drop(table.remove(*other)));
        let Value::Table(case) = case else { unreachable!() };
        case
    }

    /// The case without the key.
    pub fn without(&self) -> Result<Case, CaseError> {
        self.bases.read(&toml::to_string(&self.cleared()).unwrap(), &[])
    }

    /// The case with a value of the key, in TOML.
    pub fn set(&self, value: &str) -> Result<Case, CaseError> {
        self.bases.read(&self.text(value), &[])
    }

    /// The text of the case with a value of the key, and of a table of another kind what that needs.
    pub fn text(&self, value: &str) -> String {
        let mut case = Value::Table(self.cleared());
        let names = self.steps.iter().filter(|step| step.parse::<usize>().is_err());
        let keys = names.fold(&CASE, |keys, name| keys.within(name));
        let section = table(&mut case, &self.steps);
        let parse = |text: &str| format!("value = {text}").parse::<Table>().unwrap()["value"].clone();
        section.insert(self.name().to_owned(), parse(value));
        if keys.all[0].name == self.name() {
            let word = value.trim_matches('"');
            for key in keys.all.iter().filter(|key| !key.kinds.is_empty()) {
                section.remove(key.name);
                if key.kinds.contains(&word) {
                    section.insert(key.name.to_owned(), parse(key.example));
                }
            }
        }
        toml::to_string(&case).unwrap()
    }

    /// The value that a case has at the key when it is written.
    pub fn written(&self, case: &Case) -> Option<Value> {
        let mut written = Value::Table(case.to_toml().parse().unwrap());
        for step in &self.steps {
            written = match step.parse::<usize>() {
                Ok(index) => written.get(index)?.clone(),
                Err(_) => written.get(step)?.clone(),
            };
        }
        written.get(self.name()).cloned()
    }
}

fn table<'a>(case: &'a mut Value, steps: &[String]) -> &'a mut Table {
    let value = steps.iter().fold(case, |value, step| match step.parse::<usize>() {
        Ok(index) => &mut value.as_array_mut().unwrap()[index],
        Err(_) => &mut value.as_table_mut().unwrap()[step],
    });
    value.as_table_mut().unwrap()
}
