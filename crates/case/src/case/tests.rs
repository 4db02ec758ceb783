//! The case as a whole: embedded cases, defaults, overrides, writing and reading back.

use std::collections::BTreeSet;

use super::*;
use percoat_core::body::Interface;
use percoat_core::run::Sampling;
use serde_json::{Value, json};

/// A case with every section.
const RICH: &str = include_str!("../../../../tests/common/rich.toml");

/// Indenters as instruments have them.
const TIPS: &str = "lattice = { kind = \"hexagonal\", period = 9 }
levels = [
    { shape = \"sphero-cone\", radius = 1, half_angle = 60 },
    { shape = \"vickers\", tip_radius = 1 },
    { shape = \"measured\", area = { coefficients = [24.5, 1], depths = [0.1, 1], unit = \"nm\" } },
]
units = { length = \"µm\" }
substrate = { young = 1, poisson = 0.3 }
load = { mean_pressure = 1e-3 }
";

fn source(text: &str) -> Source {
    Source { name: "case.toml".to_owned(), text: text.to_owned(), ..Source::default() }
}

fn read(text: &str, overrides: &[&str]) -> Result<Case, CaseError> {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    Case::read(&source(text), &overrides)
}

fn fig2() -> String {
    embedded::source("fig2").unwrap().text
}

#[test]
fn the_keys_of_cases_that_are_read_are_those_of_the_table() {
    let folder = tempfile::tempdir().unwrap();
    let head = b"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2)}";
    let file = [b"\x93NUMPY\x01\0", &[head.len() as u8, 0][..], head, &[0; 32]].concat();
    std::fs::write(folder.path().join("surface.npy"), file).unwrap();
    let other = RICH.replace("mean_pressure =", "penetration =").replace("points = [24, 36]", "accuracy = 1e-3");
    let graded = "layers = [{ thickness = 1, graded = { shear_ratio = [2, 1], poisson = [0.2, 0.3], law = \"linear\" } },\n\
                  { thickness = 1, graded = { young = [2, 1], poisson = [0.2, 0.3], sublayers = 2 } }]\n";
    let surface = |keys: &str| {
        format!(
            "surface = {{ {keys} }}\nsubstrate = {{ young = 1, poisson = 0.3 }}\nload = {{ mean_pressure = 1e-3 }}\ngrid = {{ points = 8 }}\n{graded}"
        )
    };
    let random = "hurst = 0.8, shortest = 0.25, longest = 1, rolloff = 0.5, seed = 1";
    let surfaces = [
        "heights = \"surface.npy\", channel = 1, scale = 2, period = 1, level = true, form = \"plane\", cutoff = 1, window = true"
            .to_owned(),
        "heights = \"surface.npy\", pixel = 0.5".to_owned(),
        format!("period = 1, random = {{ {random}, rms_slope = 0.1 }}"),
        format!("period = 1, random = {{ {random}, rms_height = 0.1 }}"),
    ]
    .map(|keys| surface(&keys));
    // The layers of the rich case on its counterbody, and graded ones.
    let above = |layers: &str| {
        let mut case: toml::Table = RICH.parse().unwrap();
        let mut counterbody: toml::Table = case["substrate"].as_table().unwrap().clone();
        counterbody.insert("layers".to_owned(), layers.parse::<toml::Table>().unwrap()["layers"].clone());
        case.insert("counterbody".to_owned(), toml::Value::Table(counterbody));
        toml::to_string(&case).unwrap()
    };
    let bodies = [above(RICH), above(graded)];
    let isolated = "lattice = { kind = \"isolated\", size = 2 }\nlevels = [{ shape = \"sphere\", radius = 1 }]\n\
                    substrate = { young = 1, poisson = 0.3 }\nload = { force = { from = 1, to = 2, steps = 2, spacing = \"log\" } }\n";
    let mut found = BTreeSet::new();
    let rigid = "lattice = { kind = \"square\", period = 2 }\nlevels = [{ shape = \"sphere\", radius = 1 }]\n\
                 layers = [{ thickness = 1, young = 1, poisson = 0.3 }]\nsubstrate = { rigid = true }\n\
                 counterbody = { rigid = true, layers = [{ thickness = 1, young = 1, poisson = 0.3 }] }\nload = { mean_pressure = 1e-3 }\n";
    let ball = "lattice = { kind = \"isolated\", size = 2 }\nsurface = { radius = 3, random = { hurst = 0.8, shortest = 0.5, rms_slope = 0.1 } }\n\
                substrate = { young = 1, poisson = 0.3 }\nload = { force = 1 }\ngrid = { points = 16 }\n";
    let to_and_fro = "lattice = { kind = \"isolated\", size = 2 }\nlevels = [{ shape = \"sphere\", radius = 1 }]\n\
                      substrate = { young = 1, poisson = 0.3, wear = 1e-3 }\nload = { force = 1e-3 }\nfriction = { coefficient = 0.1 }\n\
                      life = { passes = 10, stroke = 5 }\n";
    let composite = "lattice = { kind = \"isolated\", size = 2 }\nlevels = [{ shape = \"sphere\", radius = 1 }]\n\
                     layers = [{ thickness = 0.1, young = 2, poisson = 0.3, hardness = 0.2 }]\n\
                     substrate = { young = 1, poisson = 0.3, hardness = 0.1 }\nload = { force = 1e-3 }\n\
                     composite_hardness = { law = \"korsunsky\", constant = 1 }\n";
    let texts = [RICH, &other, isolated, rigid, ball, to_and_fro, composite, TIPS];
    let more = [&slips()[..], &adheres(), &moves(), &creeps()].concat();
    let texts = texts.into_iter().chain(surfaces.iter().chain(&bodies).chain(&more).map(String::as_str));
    for text in embedded::all().iter().map(|(_, text)| *text).chain(texts) {
        let source = Source { folder: folder.path().to_owned(), ..source(text) };
        Case::read(&source, &[]).unwrap_or_else(|error| panic!("{error}"));
        collect(&node::Value::Table(node::Table::parse(text).unwrap()), "", &mut found);
    }
    // A unit needs one to be converted to.
    found.insert("surface.unit".to_owned());
    let tables = model::CASE.tables("");
    let named = |(path, keys): &(String, &'static keys::Keys)| {
        keys.all.iter().map(|key| join(path, key.name)).collect::<Vec<_>>()
    };
    assert_eq!(found, tables.iter().flat_map(named).collect());
}

/// Bodies that creep, with every key of `relaxation` and `[time]`.
fn creeps() -> [String; 2] {
    let relaxation = "relaxation = { shear = [3.0], times = [1.0], constant = \"poisson\" }";
    let layers = format!("layers = [{{ thickness = 1, young = 1, poisson = 0.3, {relaxation} }}]");
    let times = "{ from = 0.1, to = 5, steps = 3, spacing = \"log\", back = false }";
    let paths = [
        format!("load = [[0, 0], [9, 1e-3]], times = {times}"),
        "penetration = [[0, 0.1]], tolerance = 0.1".to_owned(),
    ];
    paths.map(|path| {
        format!(
            "lattice = {{ kind = \"square\", period = 5 }}\nlevels = [{{ shape = \"sphere\", radius = 1 }}]\n{layers}\n\
             substrate = {{ young = 1, poisson = 0.3, {relaxation} }}\ntime = {{ {path} }}\n\
             counterbody = {{ young = 1, poisson = 0.3, {relaxation}, {layers} }}\n"
        )
    })
}

/// Contacts that stick, slip and roll, with the keys of `[tangential]` that no embedded case has.
fn slips() -> [String; 3] {
    ["force = [0.3, [0.1, 0.2]]", "shift = [0.01]", "rolling = { creepage = 1e-3 }"].map(|keys| {
        format!(
            "lattice = {{ kind = \"isolated\", size = 2 }}\nlevels = [{{ shape = \"sphere\", radius = 1 }}]\n\
             substrate = {{ young = 1, poisson = 0.3 }}\nload = {{ force = 1e-3 }}\nfriction = {{ coefficient = 0.1 }}\n\
             tangential = {{ {keys} }}\n"
        )
    })
}

/// Contacts that adhere, with the keys of `[adhesion]` and the ranges that no embedded case has.
fn adheres() -> [String; 5] {
    let range = "{ from = 1e-3, to = 2e-3, steps = 3, spacing = \"log\", back = true }";
    let ranges = ["mean_pressure", "force", "penetration", "grip"].map(|key| format!("{key} = {range}"));
    let [mean, force, penetration, grip] = ranges;
    [mean, force, penetration, grip, "force = -1e-3".to_owned()].map(|load| {
        format!(
            "lattice = {{ kind = \"square\", period = 2 }}\nlevels = [{{ shape = \"sphere\", radius = 1 }}]\n\
             substrate = {{ young = 1, poisson = 0.3 }}\nload = {{ {load} }}\n\
             adhesion = {{ work = 1e-3, strength = 0.1, law = \"exponential\" }}\n"
        )
    })
}

/// Contacts that move steadily, with the keys of `[motion]`, `[heat]` and of materials that no embedded case has.
fn moves() -> [String; 1] {
    [format!(
        "lattice = {{ kind = \"square\", period = 2 }}\nlevels = [{{ shape = \"sphere\", radius = 1 }}]\n\
         layers = [{{ thickness = 0.1, young = 1, poisson = 0.3, {CONDUCTS}, thermal_resistance = 0.1, {RELAXES} }}]\n\
         substrate = {{ young = 1, poisson = 0.3, {CONDUCTS}, {RELAXES} }}\nload = {{ mean_pressure = 1e-3 }}\n\
         counterbody = {{ young = 1, poisson = 0.3, {CONDUCTS}, {RELAXES}, layers = [{{ thickness = 0.1, young = 1, poisson = 0.3, {CONDUCTS}, thermal_resistance = 0.1 }}] }}\nfriction = {{ coefficient = 0.1 }}\n\
         motion = {{ velocity = 2 }}\nheat = {{ partition = 0.5, bulk = [20, 30], expansion = false }}\n"
    )]
}

const CONDUCTS: &str = "conductivity = 1, diffusivity = 2, expansion = 1e-3";
const RELAXES: &str = "relaxation = { shear = [3], times = [1], constant = \"poisson\" }";

/// Paths of all keys inside a value, without the indices of lists.
fn collect(value: &node::Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        node::Value::Table(table) => {
            for entry in &table.entries {
                let path = join(path, &entry.key);
                collect(&entry.node.value, &path, found);
                found.insert(path);
            }
        }
        node::Value::List(items) => items.iter().for_each(|item| collect(&item.value, path, found)),
        _ => {}
    }
}

fn join(path: &str, key: &str) -> String {
    format!("{path}.{key}").trim_start_matches('.').to_owned()
}

#[test]
fn what_the_embedded_cases_say_about_overrides_works() {
    for (name, text) in embedded::all() {
        for line in text.lines().filter_map(|line| line.strip_prefix("#   --set ")) {
            let line = line.split("   ").next().unwrap();
            let overrides: Vec<String> = line.split(" --set ").map(|set| set.trim_matches('\'').to_owned()).collect();
            let case = Case::read(&embedded::source(name).unwrap(), &overrides);
            case.unwrap_or_else(|error| panic!("{name}: {error}"));
        }
    }
}

#[test]
fn a_case_written_with_its_defaults_reads_back_equal() {
    let embedded = embedded::all().iter().map(|(_, text)| *text);
    for text in embedded.chain([RICH]) {
        let case = read(text, &[]).unwrap_or_else(|error| panic!("{error}"));
        let written = case.to_toml();
        assert!(!written.contains("= 0.00000"), "{written}");
        assert_eq!(read(&written, &[]).unwrap_or_else(|error| panic!("{error}")), case, "{written}");
    }
}

#[test]
fn a_case_has_the_keys_of_its_file_in_json() {
    let case = serde_json::to_value(read(RICH, &[]).unwrap()).unwrap();
    assert_eq!(case["lattice"], json!({ "kind": "oblique", "a1": [1.0, 0.0], "a2": [0.25, 1.5] }));
    assert_eq!(case["levels"][1], json!({ "shape": "cone", "slope": 0.3, "height": 0.0, "sites": [[0.5, 0.0]] }));
    assert_eq!(case["layers"][0]["interface"], json!({ "tangential_stiffness": 2.5e11, "normal_stiffness": 4e12 }));
    assert_eq!(case["layers"][0]["young"], json!(3e11));
    assert_eq!(case["layers"][1]["interface"], json!("frictionless"));
    assert_eq!(case["load"], json!({ "mean_pressure": [1e8, 1e9, 1e10] }));
    assert_eq!(case["grid"], json!({ "points": [24, 36] }));
    assert_eq!(case["solver"]["method"], json!("polonsky-keer"));
    assert_eq!(case["stress"]["section"]["toward"], json!("level 3"));
    assert_eq!(case["stress"]["mean"], json!("half-space"));
    assert_eq!(case["stress"]["strain"], json!(true));
    assert_eq!(case["localized"]["radius"], json!("area-balanced"));
    assert_eq!(case.get("surface"), None::<&Value>);
}

#[test]
fn what_is_not_said_has_its_default() {
    let text = "[lattice]\nkind = \"square\"\nperiod = 2\n[[levels]]\nshape = \"cone\"\nslope = 0.1\n\
                [substrate]\nyoung = 1\npoisson = 0.3\n[load]\nmean_pressure = 1e-3\n";
    let case = read(text, &[]).unwrap();
    assert_eq!(case.grid, Sampling::Points([512, 512]));
    assert_eq!(case.solver, percoat_core::spectral::Settings::default());
    assert_eq!((&case.localized.indenters[..], case.localized.elements), (&[7, 13, 37, 73][..], 48));
    assert_eq!((case.stress, case.layers, case.title), (None, vec![], String::new()));
    let coated = format!("{text}[[layers]]\nthickness = 1\nshear_ratio = 2\npoisson = 0.2\n[stress]\n");
    let case = read(&coated, &[]).unwrap();
    assert_eq!(case.half_space().layers()[0].interface(), Interface::Bonded);
    assert_eq!(case.stress.map(|stress| (stress.planes, stress.strain)), Some((vec![], false)));
}

#[test]
fn a_case_without_strains_is_written_as_before_there_were_any() {
    let [without, denied, asked] = ["{planes=[0.1]}", "{planes=[0.1],strain=false}", "{planes=[0.1],strain=true}"]
        .map(|section| read(&fig2(), &[&format!("stress={section}")]).unwrap());
    assert_eq!(without.to_toml(), denied.to_toml());
    assert!(
        !without.to_toml().contains("strain") && asked.to_toml().contains("\nstrain = true\n"),
        "{}",
        asked.to_toml()
    );
    let requested = |case: &Case| case.run().stress.unwrap().strain;
    assert_eq!([&without, &denied, &asked].map(requested), [false, false, true]);
}

#[test]
fn the_shear_ratio_is_that_to_the_substrate() {
    let case = read(&fig2(), &[]).unwrap();
    let half_space = case.half_space();
    let ratio = half_space.layers()[0].material().shear() / half_space.material(half_space.material_count()).shear();
    assert!((ratio - 2.0).abs() < 1e-15);
}

#[test]
fn explicit_sites_stand_in_the_cell_whose_side_is_the_period() {
    let side = |overrides: &[&str]| {
        let [x, y] = read(&fig2(), overrides).unwrap().problem().cell().vectors()[0];
        x.hypot(y)
    };
    assert!((side(&[]) - 3f64.sqrt()).abs() < 1e-15);
    let sites = ["levels.0.sites=[[0, 0]]", "levels.1.sites=[[0.5, 0]]", "levels.2.sites=[[0, 0.5]]"];
    assert!((side(&sites) - 1.0).abs() < 1e-15);
}

#[test]
fn overrides_come_one_after_another_and_are_checked_like_the_file() {
    let fig2 = fig2();
    let case = read(&fig2, &["load.penetration=[0, 0.1]", "solver.method=polonsky-keer", "grid.points=[64,48]"]);
    let case = case.unwrap();
    assert_eq!((case.load.quantity(), case.load.values()), ("penetration", &[0.0, 0.1][..]));
    assert_eq!(case.grid, Sampling::Points([64, 48]));
    assert_eq!(read(&fig2, &["levels.1.height=0.5", "levels.1.height=0.4"]).unwrap().levels[1].height, 0.4);
    let error = read(&fig2, &["title=x", "substrate.poisson=0.6"]).unwrap_err();
    assert!(error.to_string().contains("--set:1:19"), "{error}");
}

#[test]
fn values_that_are_set_are_read_as_overrides_are() {
    let set = |values: &[&str], overrides: &[&str]| {
        let pair = |text: &&str| {
            let (key, value) = text.split_once('=').unwrap();
            (key.to_owned(), toml::from_str::<toml::Table>(&format!("value = {value}")).unwrap()["value"].clone())
        };
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        Case::read(&Source { set: values.iter().map(pair).collect(), ..source(&fig2()) }, &overrides)
    };
    let values = ["load.penetration=[0, 0.1]", "layers[0].poisson=0.4", "layers.0.poisson=0.3", "title=\"a b\""];
    assert_eq!(set(&values, &[]), read(&fig2(), &values));
    assert_eq!(set(&values[..2], &values[2..]), read(&fig2(), &values), "before the overrides");
    let deep = "a.".repeat(20) + "a=1";
    for wrong in ["substrate.poisson=0.6", "layers.7.poisson=0.3", "grid.pints=8", "=1", "a..b=1", &deep] {
        let (fault, typed) = (set(&[wrong], &[]).unwrap_err(), read(&fig2(), &[wrong]).unwrap_err());
        assert_eq!(fault.to_string(), typed.to_string());
        let told = set(&["title=\"x\""], &["title=y", wrong]).unwrap_err().to_string();
        assert_eq!(told, typed.to_string());
    }
}

#[test]
fn a_section_is_that_of_a_case_with_this_key() {
    let with = |case: &str, section: &str| read(case, &["stress={}", &format!("stress.section={section}")]);
    let asked = |case: &str, section: &str| {
        let value = toml::from_str::<toml::Table>(&format!("value = {section}")).unwrap()["value"].clone();
        read(case, &[]).unwrap().section(&value)
    };
    let sliding = fig2() + "[friction]\ncoefficient = 0.1\n";
    for (case, section) in [
        (fig2(), "{ from = \"level 1\", toward = \"level 2\", length = 1.0, depth = 0.5 }"),
        (fig2(), "{ from = [0.1, 0.2], toward = [1, 0], length = 2, depth = 0.5, behind = 0.25 }"),
        (sliding, "{ from = \"level 3\", length = 1.0, depth = 0.5 }"),
    ] {
        assert_eq!(Some(asked(&case, section).unwrap()), with(&case, section).unwrap().run().stress);
    }
    for wrong in [
        "{ from = \"level 9\", toward = \"level 1\", length = 1.0, depth = 0.5 }",
        "{ from = \"level 1\", length = 1.0, depth = 0.5 }",
        "{ from = \"level 1\", toward = [0, 0], length = 1.0, depth = 0.5 }",
        "{ from = \"level 1\", toward = \"level 2\", length = -1.0, depth = 0.5 }",
        "{ from = \"level 1\", toward = \"level 2\", lenght = 1.0, depth = 0.5 }",
        "1",
    ] {
        let (fault, typed) = (asked(&fig2(), wrong).unwrap_err(), with(&fig2(), wrong).unwrap_err());
        assert_eq!(fault.message(), typed.message());
        assert!(fault.message().contains("`stress.section"), "{fault}");
    }
}

/// The window is 4 by 2: a cut along (3, 4) leaves it 1.25 from the middle.
#[test]
fn an_isolated_contact_is_cut_across_its_window_unless_other_places_are_named() {
    let ball = "[lattice]\nkind = \"isolated\"\nsize = [4.0, 2.0]\n[[levels]]\nshape = \"sphere\"\nradius = 10.0\n[substrate]\nyoung = 1.0\n\
        poisson = 0.3\n[load]\nforce = 0.01\n[stress]\n";
    let cut = |more: &str, set: &[&str]| read(&format!("{ball}{more}"), set).unwrap().run().stress.unwrap().cut;
    for (more, half, direction) in
        [("", 2.0, [1.0, 0.0]), ("[friction]\ncoefficient = 0.1\ndirection = [3.0, 4.0]\n", 1.25, [0.6, 0.8])]
    {
        let cut = cut(more, &[]).unwrap();
        let found = [cut.line.span[0] + half, cut.line.span[1] - half, cut.depth - 1.0];
        let turned = [0, 1].map(|k| cut.line.unit()[k] - direction[k]);
        assert!(found.into_iter().chain(turned).all(|x| x.abs() < 1e-12), "{cut:?}");
        assert_eq!(cut.line.origin, [0.0; 2]);
    }
    // The cut of a copied case is that of the window which it is given.
    let text = read(ball, &[]).unwrap().to_toml();
    assert!(!text.contains("section"), "{text}");
    let smaller = read(&text, &["lattice.size=[2.0,1.0]"]).unwrap();
    assert!(smaller.has_cut() && (smaller.run().stress.unwrap().cut.unwrap().depth - 0.5).abs() < 1e-12);
    assert!(cut("planes = [0.1]\n", &[]).is_none() && cut("points = [[0.0, 0.0, 0.1]]\n", &[]).is_none());
    assert!(read(&fig2(), &["stress={}"]).unwrap().run().stress.unwrap().cut.is_none());
}

#[test]
fn layers_and_circles_without_end_are_refused() {
    let layers = fig2() + &"[[layers]]\nthickness = 1\nshear_ratio = 2\npoisson = 0.2\n".repeat(200);
    let error = read(&layers, &[]).unwrap_err();
    assert_eq!(error.message(), "`layers` must be at most 200 sections, not 201");
    let circles = format!("localized.indenters=[{}]", "7,".repeat(101));
    let error = read(&fig2(), &[&circles]).unwrap_err();
    assert!(error.message().starts_with("`localized.indenters` must be a list of at most 100 items"), "{error}");
}
