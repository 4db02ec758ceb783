//! Saved states that contradict themselves are refused.

use percoat::case::{Case, embedded};
use percoat::reading::Verdict;

#[test]
fn a_state_that_its_utilisation_contradicts_is_refused() {
    let case = Case::read(&embedded::source("dlc-on-steel").unwrap(), &["grid.points=32".to_owned()]).unwrap();
    let step = case.run().solve(&mut ()).unwrap().steps.pop().unwrap();
    assert_eq!(step.check(), Ok(()));
    let mut other = step.clone();
    let failing = other.strength.iter_mut().find(|row| row.verdict == Verdict::Fails).unwrap();
    failing.verdict = Verdict::Holds;
    assert!(other.check().unwrap_err().contains("makes it `fails`"));
    let mut other = step;
    let governing = other.governing.as_mut().unwrap();
    let another = other.strength.iter().find(|row| row.criterion != governing.criterion).unwrap();
    governing.criterion = another.criterion;
    assert!(other.check().unwrap_err().contains("`governing`"));
}

#[test]
fn what_a_topography_lacks_in_a_window_alone_is_due_on_a_cell() {
    let set = ["grid.points=64", "surface.random.shortest=5.0", "load.mean_pressure=0.1"].map(str::to_owned);
    let case = Case::read(&embedded::source("rough").unwrap(), &set).unwrap();
    let mut step = case.run().solve(&mut ()).unwrap().steps.pop().unwrap();
    assert_eq!(step.check(), Ok(()));
    step.rough.as_mut().unwrap().mean_gap = None;
    assert_eq!(step.check().unwrap_err(), "`rough.mean_gap` is null where a number is due");
}
