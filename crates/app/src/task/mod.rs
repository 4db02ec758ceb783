//! The tasks on a case: one door for the program, the Python package, the page, and the combinations of a sweep.
//!
//! A task is made of a case and the memory and disk of a machine, and what cannot be done is [refused](Refused) before anything is
//! claimed or solved. Carried out with a recorder it gives its outcome with all warnings, of which files, tables and pictures are made.
//! A refinement to a prescribed accuracy ends before a grid for which memory or disk do not suffice, whatever the recorder.

mod compare;
mod identify;
mod life;
mod limit;
mod refused;
mod solve;
mod within;

pub use compare::{Compare, CompareError, Compared};
pub use identify::{Identified, Identify};
pub use life::{FollowError, FollowLife, Followed};
pub use limit::{FindLimits, Limited};
pub use refused::Refused;
pub use solve::{Solve, Solved};

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_case::case::resources::{Job, needs};
    use percoat_case::case::{Case, embedded};
    use percoat_common::machine::Capacity;
    use percoat_core::run::RefinementEnd;
    use std::convert::Infallible;
    use std::ops::ControlFlow;

    /// A case that no grid in reach solves to its accuracy, and room for grids of 128 × 128 samples at most.
    fn roomy(name: &str, job: Job, more: &[&str]) -> (Case, Capacity) {
        let set: Vec<String> = ["grid.accuracy=1e-7"].iter().chain(more).map(|&text| text.to_owned()).collect();
        let case = Case::read(&embedded::source(name).unwrap(), &set).unwrap();
        let memory = needs(&case, [128; 2], job).memory;
        (case, Capacity { memory, disk: u64::MAX })
    }

    #[test]
    fn a_refinement_ends_where_there_is_no_room_whatever_the_task() {
        let ended = |end: Option<RefinementEnd>, task: &str| assert_eq!(end, Some(RefinementEnd::Room), "{task}");
        let (case, room) = roomy("fig2", Job::Keep, &["stress={}"]);
        let solved = Solve::in_memory(&case, room).unwrap().solve(&mut ()).unwrap();
        ended(solved.outcome.end, "solve");
        assert!(solved.outcome.points.iter().all(|n| *n <= 128));

        let (case, room) = roomy("fig2", Job::Limit { pictures: false }, &["layers.0.yield_strength=1"]);
        let found = FindLimits::new(&case, room, false).unwrap().find(&mut ()).unwrap();
        assert!(found.warnings.iter().any(|warning| warning.contains("no room")), "{:?}", found.warnings);

        let (case, room) = roomy("tin-fatigue", Job::Life { pictures: false }, &[]);
        let life = FollowLife::new(&case, room, false).unwrap();
        let followed = life.follow(None, &|| true, &mut |_, _| Ok::<(), Infallible>(())).unwrap();
        ended(followed.begun.end, "life");

        let cheap = ["localized={ indenters = [1], elements = 4 }"];
        let (case, room) = roomy("fig2", Job::Compare { pictures: false }, &cheap);
        let compared = Compare::new(&case, room, false).unwrap();
        let compared = compared.compare(&mut (), &mut |_, _| ControlFlow::Continue(())).unwrap();
        assert!(compared.warnings.iter().any(|warning| warning.contains("no room")), "{:?}", compared.warnings);
        assert!(!compared.converged());
    }
}
