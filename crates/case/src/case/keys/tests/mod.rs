//! Reader, schema and `percoat explain` agree with the table of keys.

mod bases;
mod bounds;
mod schema;

use super::key::{Absent, Key};
use super::{UnknownKey, explain, overview, table};
use crate::case::model::CASE;
use bases::Bases;

#[test]
fn the_table_of_all_keys_has_a_row_for_each() {
    let table = table();
    let paths = |keys: &[Key]| keys.iter().map(|key| key.name).collect::<Vec<_>>();
    for section in CASE.all {
        assert!(table.contains(&format!("\n| `{}` |", section.name)), "{}", section.name);
        for name in paths(section.holds().all) {
            assert!(table.contains(&format!("| `{name}` |")), "{}.{name}", section.name);
        }
    }
    let mut rows = table.lines().filter(|line| line.starts_with('|'));
    assert!(rows.all(|row| row.matches('|').count() == 5), "four cells a row");
}

#[test]
fn a_key_is_at_home_in_every_table_that_has_it() {
    assert_eq!(CASE.homes("tolerance"), ["solver", "time", "life"]);
    assert_eq!(CASE.homes("points"), ["grid", "stress", "stress.volume"]);
    assert_eq!(CASE.homes("normal_stiffness"), ["layers.interface", "counterbody.layers.interface"]);
    assert!(CASE.homes("colour").is_empty());
}

#[test]
fn sizes_of_one_shape_exclude_those_of_the_others() {
    let [levels, lattice, localized] = ["levels", "lattice", "localized"].map(|name| CASE.within(name));
    assert_eq!(levels.excluded("slope"), ["radius", "coefficient", "exponent", "half_angle", "tip_radius", "area"]);
    assert_eq!(levels.excluded("exponent"), ["radius", "slope", "half_angle", "tip_radius", "area"]);
    // A sphero-cone has both.
    assert_eq!(levels.excluded("half_angle"), ["slope", "coefficient", "exponent", "tip_radius", "area"]);
    assert_eq!(lattice.excluded("period"), ["a1", "a2", "size"]);
    assert_eq!((CASE.excluded("levels"), CASE.excluded("surface")), (vec!["surface"], vec!["levels"]));
    assert!(levels.excluded("height").is_empty() && localized.excluded("radius").is_empty());
}

#[test]
fn a_key_is_found_by_its_path_or_its_name_and_a_slip_is_told() {
    let paths = |path: &str| explain(path).map(|found| found.into_iter().map(|key| key.path).collect::<Vec<_>>());
    for path in ["layers.poisson", "layers.0.poisson", "layers[0].poisson"] {
        assert_eq!(paths(path).unwrap(), ["layers.poisson"]);
    }
    assert_eq!(paths("points").unwrap(), ["grid.points", "stress.points", "stress.volume.points"]);
    assert_eq!(paths("volume.points").unwrap(), ["stress.volume.points"]);
    let near = |path: &str| paths(path).unwrap_err().near;
    assert_eq!(near("layers.thicknes"), ["layers.thickness"]);
    let places = ["layers.poisson", "layers.graded.poisson", "substrate.poisson", "counterbody.poisson"];
    let above = ["counterbody.layers.poisson", "counterbody.layers.graded.poisson"];
    assert_eq!(near("poison"), [&places[..], &above].concat());
    assert_eq!(near("solver.acuracy"), ["grid.accuracy"]);
    assert_eq!(near("sovler.tolerance"), ["solver.tolerance", "time.tolerance", "life.tolerance"]);
    assert_eq!(near("sovler"), ["solver"]);
    let strange = UnknownKey { path: "xyzzy".to_owned(), near: vec![] };
    assert_eq!(explain("xyzzy").unwrap_err(), strange);
    assert!(strange.to_string().contains("lists the sections") && paths("").is_err() && paths("0").is_err());
}

#[test]
fn what_is_printed_fits_eighty_letters() {
    let all = CASE.all.iter().flat_map(|key| explain(key.name).unwrap());
    let inside = CASE.tables("").into_iter().skip(1).flat_map(|(path, keys)| {
        keys.all.iter().flat_map(move |key| explain(&format!("{path}.{}", key.name)).unwrap())
    });
    for text in all.chain(inside).map(|key| key.to_string()).chain([overview()]) {
        for line in text.lines() {
            assert!(line.chars().count() <= 80 && line.trim_end() == line, "{line:?} of\n{text}");
        }
    }
}

#[test]
fn every_example_is_a_case_in_some_surroundings() {
    let bases = Bases::new();
    for (path, key) in bases::all_keys() {
        let read = bases.each(&path).any(|at| at.set(key.example).is_ok());
        assert!(read, "{path} = {}: {:?}", key.example, bases.each(&path).map(|at| at.set(key.example).err()).last());
        let explanation = explain(&path).unwrap().remove(0);
        assert!(explanation.example.parse::<toml::Table>().is_ok(), "{}", explanation.example);
        let Some(set) = explanation.set else { continue };
        // A key of one kind goes with the others of it.
        let kind = key.kinds.first().map(|kind| match path.starts_with("levels") {
            true => format!("levels.0.shape={kind}"),
            false => format!("lattice.kind={kind}"),
        });
        let others =
            bases::all_keys().into_iter().filter(|(_, other)| !key.kinds.is_empty() && other.kinds == key.kinds);
        let others = others.filter_map(|(path, _)| explain(&path).unwrap().remove(0).set);
        let sets = kind.into_iter().chain(others).chain([set]).map(|set| set.trim_matches('\'').to_owned());
        let sets: Vec<String> = sets.collect();
        assert!(bases.all().any(|text| bases.read(&text, &sets).is_ok()), "{sets:?}");
    }
}

#[test]
fn a_default_is_what_a_case_without_the_key_has() {
    let bases = Bases::new();
    let mut count = 0;
    for (path, key) in bases::all_keys() {
        let Absent::Value(default) = key.absent else { continue };
        let at = bases.each(&path).next().unwrap_or_else(|| panic!("no case has {path}"));
        let (without, with) = (at.without().unwrap(), at.set(default).unwrap());
        assert!(without == with, "{path} = {default}:\n{}\nis not\n{}", with.to_toml(), without.to_toml());
        assert!(at.set(key.example).unwrap() != without, "{path} = {} changes nothing", key.example);
        count += 1;
    }
    assert!(count >= 20, "only {count} defaults");
}
