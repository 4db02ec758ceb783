//! After a power cut at any moment of a sweep with fields, the files that its log names are there and whole.

use super::Log;
use super::examples::product;
use super::log::read;
use super::row::Row;
use super::study::{Study, folder_of};
use super::task::Task;
use crate::output::power_cut::Journal;
use crate::output::{OutputError, Plan, RunFolder, SWEEP_LOG, Writer};
use percoat_case::case::embedded;
use percoat_common::machine::Capacity;
use std::collections::HashSet;
use std::path::Path;

/// Power cuts with every part of the changes that may have come to the disk.
#[test]
fn after_a_power_cut_the_fields_of_every_combination_of_the_log_are_whole() {
    let source = embedded::source("fig2").unwrap();
    let fixed = ["grid.points=16".to_owned()];
    let combinations = product(&["layers.0.poisson=0.1,0.2,0.3"]);
    let room = Capacity { memory: 1 << 30, disk: u64::MAX };
    let study = Study::new(&source, &fixed, &combinations, Task::Solve, room).unwrap().keeping_fields();
    let place = tempfile::tempdir().unwrap();
    let journal = Journal::begin(place.path());
    let claim = RunFolder::claim(place.path(), Plan::new(Writer::Sweep)).unwrap();
    let staging = claim.staging();
    let mut log = Log::begin(&staging, "1-2", &[]).unwrap();
    let mut told = Vec::new();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let done = one.install(|| {
        study.run(&HashSet::new(), &staging, |row| {
            log.add(&row)?;
            told.push(journal.lock().unwrap().images.len());
            Ok::<(), OutputError>(())
        })
    });
    done.unwrap();
    Journal::end(&journal);
    let images = std::mem::take(&mut journal.lock().unwrap().images);
    assert!(told.len() == 3 && images.len() > 200, "{told:?} of {}", images.len());
    for (index, image) in images.iter().enumerate() {
        let within = |name: &str| image.get(&Path::new("unfinished-sweep").join(name)).and_then(Option::as_deref);
        let found = tempfile::tempdir().unwrap();
        std::fs::write(found.path().join(SWEEP_LOG), within(SWEEP_LOG).unwrap_or_default()).unwrap();
        // Whole lines are those of combinations, or damaged in whatever way and no rows.
        let lines = read(&found.path().join(SWEEP_LOG)).unwrap();
        let rows: Vec<Row> = lines.into_iter().flatten().map(|logged| logged.row).collect();
        assert!(rows.len() >= told.iter().filter(|images| **images <= index).count());
        for name in rows.iter().flat_map(|row| {
            ["contact.npz", "case.toml", "summary.json"].map(|name| format!("{}/{name}", folder_of(row.combination)))
        }) {
            let whole = std::fs::read(staging.join(&name)).unwrap();
            assert!(within(&name).is_some_and(|found| found == whole), "{name} in image {index}");
        }
    }
}
