//! The life of a case: passes until something fails, and what is left after that.

use super::refused::Refused;
use crate::output::LifeFile;
use percoat_case::case::Case;
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_common::machine::Capacity;
use percoat_core::life::{Beginning, LifeError, LifeState, LifeTask};
use std::error::Error;

/// The life of a case, to be followed.
#[derive(Debug)]
pub struct FollowLife<'a> {
    case: &'a Case,
    allowed: Allowed<'a>,
    /// Bodies, load and grid, and how far the life is followed.
    pub life: LifeTask,
}

/// A life that was followed to its end.
#[derive(Debug)]
pub struct Followed<'a> {
    /// The case.
    pub case: &'a Case,
    /// Bodies, load and grid.
    pub task: &'a LifeTask,
    /// The contact before the first pass.
    pub begun: Beginning,
    /// The last state.
    pub state: LifeState,
    /// The content of `life.json`, with all warnings.
    pub file: LifeFile,
}

/// Why a life is not followed to its end; `E` is the error of what receives its states.
#[derive(Debug, thiserror::Error)]
pub enum FollowError<E: Error + 'static> {
    /// A contact is not solved, or the search was stopped.
    #[error(transparent)]
    Life(#[from] LifeError),
    /// The state to go on from is on another grid: where an accuracy is prescribed, the grid depends on the memory that is free.
    #[error("the life was begun on another grid")]
    OtherGrid,
    /// A state is not taken.
    #[error("{0}")]
    Recorder(#[source] E),
}

impl<'a> FollowLife<'a> {
    /// The task in the memory and disk of `room`, with `pictures` or without.
    ///
    /// # Errors
    /// [`Refused`] where they do not suffice, of a case with several loads or a given pressure, and where nothing tires or wears.
    pub fn new(case: &'a Case, room: Capacity, pictures: bool) -> Result<Self, Refused> {
        let life = case.life_task().map_err(Refused::new)?;
        let allowed = Allowed::within(case, room, Job::Life { pictures }).map_err(Refused::new)?;
        life.check().map_err(Refused::new)?;
        Ok(Self { case, allowed, life })
    }

    /// Follows the life from its beginning, or from a state that was `saved`, until `goes_on` is false; `each` receives every state.
    ///
    /// # Errors
    /// [`FollowError`].
    pub fn follow<E: Error + 'static>(
        &'a self,
        saved: Option<LifeState>,
        goes_on: &dyn Fn() -> bool,
        each: &mut dyn FnMut(&LifeState, &Beginning) -> Result<(), E>,
    ) -> Result<Followed<'a>, FollowError<E>> {
        let Self { case, allowed, life: task } = self;
        let begun = task.beginning(&|points| allowed.fits(points), goes_on)?;
        if saved.as_ref().is_some_and(|saved| saved.points != begun.step.grid().points()) {
            return Err(FollowError::OtherGrid);
        }
        let mut state = saved.unwrap_or_else(|| task.unworn(&begun));
        while state.end.is_none() {
            state = task.advance(state, &begun, goes_on)?;
            each(&state, &begun).map_err(FollowError::Recorder)?;
        }
        let file = LifeFile::new(case, task, &begun, &state);
        Ok(Followed { case, task, begun, state, file })
    }
}

impl Followed<'_> {
    /// Whether every contact was solved, that before the first pass to the accuracy if one is prescribed.
    pub fn converged(&self) -> bool {
        self.state.converged(&self.begun)
    }
}
