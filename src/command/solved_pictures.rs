//! The pictures of a solved case, each declared once.

use super::declared::Declared::{self, Picture};
use percoat_app::picture::{self, Canvas, Snapshot};
use percoat_case::case::Case;
use percoat_core::VerticalSection;
use percoat_core::localized::isolated;
use percoat_core::run::StepRecord;

/// The last step of a solved case with the sections of its stresses, if there are any, and all steps.
#[derive(Debug)]
pub struct Pictured {
    pub last: Snapshot,
    pub sections: Vec<VerticalSection>,
    pub steps: Vec<StepRecord>,
}

impl Pictured {
    fn touches(&self) -> bool {
        self.last.reading.touches()
    }

    /// Whether isolated indenters on elastic bodies are compared with: nothing creeps, moves or heats.
    fn is_elastic(&self) -> bool {
        !self.last.step.finest().creeps() && self.last.step.problem().motion().is_none()
    }

    fn cut(&self) -> Option<&[VerticalSection]> {
        Some(&self.sections[..]).filter(|sections| self.touches() && !sections.is_empty())
    }

    fn contact(&self) -> Option<Canvas> {
        let radii = || isolated::radii(self.last.step.problem(), &self.last.reading);
        let radii = (self.touches() && self.is_elastic()).then(radii).flatten();
        if self.touches() { picture::contact(&self.last, radii.as_deref()) } else { None }
    }

    fn profiles(&self) -> Option<Canvas> {
        let profiles = || isolated::profiles(self.last.step.problem(), &self.last.reading);
        let profiles = self.is_elastic().then(profiles).flatten();
        picture::profiles(&self.last, profiles.as_deref())
    }

    fn slip_loop(&self) -> Option<Canvas> {
        picture::slip_loop(&self.last.title, self.last.step.problem(), &self.last.units, &self.steps)
    }

    fn approach(&self) -> Option<Canvas> {
        picture::approach(&self.last.title, self.last.step.problem(), &self.last.units, &self.steps)
    }

    fn creep(&self) -> Option<Canvas> {
        picture::creep(&self.last.title, self.last.step.problem(), &self.last.units, &self.steps)
    }

    fn curve(&self) -> Option<Canvas> {
        picture::load_curves(&self.last.title, self.last.step.problem(), &self.last.units, &self.steps)
    }
}

/// The pictures of a case with so many load steps.
pub fn of_case(case: &Case, steps: usize) -> Vec<Declared<Pictured>> {
    let is_cut = case.has_cut();
    let is_indented = case.problem().bodies().hardness().is_some();
    let (sticks, adheres, creeps) = (case.tangential.is_some(), case.adhesion.is_some(), case.time.is_some());
    let heats = case.problem().heating().is_some();
    let pictures: [(bool, Declared<Pictured>); 12] = [
        (true, Picture("pressure", |solved| solved.touches().then(|| picture::pressure(&solved.last)))),
        (true, Picture("contact", Pictured::contact)),
        (true, Picture("profiles", Pictured::profiles)),
        (is_indented, Picture("indentation", |solved| picture::indentation(&solved.last))),
        (is_cut, Picture("section", |solved| Some(picture::section(&solved.last, solved.cut()?)))),
        (is_cut, Picture("lines", |solved| Some(picture::lines(&solved.last, solved.cut()?)))),
        (sticks, Picture("slip", |solved| picture::slip(&solved.last))),
        (sticks && steps > 1, Picture("loop", Pictured::slip_loop)),
        (heats, Picture("temperature", |solved| picture::temperature(&solved.last))),
        (adheres && steps > 1, Picture("approach", Pictured::approach)),
        (creeps && steps > 1, Picture("creep", Pictured::creep)),
        (steps > 1 && !sticks && !adheres && !creeps, Picture("curve", Pictured::curve)),
    ];
    pictures.into_iter().filter_map(|(is_drawn, picture)| is_drawn.then_some(picture)).collect()
}
