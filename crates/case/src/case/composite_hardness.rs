//! `[composite_hardness]`: the hardness of a thin coating together with its substrate.

use super::error::Refusal;
use super::keys::{Form, Key, Range};
use super::load::LoadSection;
use super::reader::TableAt;
use super::section::{Words, section, words};
use percoat_core::body::{CompositeError, CompositeHardness, HardnessLaw};
use percoat_core::problem::Problem;

words! { HardnessLaw { Area = "area", Korsunsky = "korsunsky", } }

section! {
    /// Hardness of one layer and its substrate together, which falls from that of the layer to that of the substrate as the penetration grows
    /// beside the thickness; for one isolated contact under loads that rise.
    #[derive(Copy)]
    pub struct CompositeHardnessSection = COMPOSITE_HARDNESS {
        /// law: the part of the area that the layer bears, by Jönsson and Hogmark, or that of Korsunsky and others
        pub law: HardnessLaw = Key::new(&[Form::Word(HardnessLaw::WORDS)], "\"area\""),
        /// constant of the law: C of the area, about 1 for a layer that deforms with the substrate and 0.5 for one that cracks; k of Korsunsky, which is fitted to measured hardness
        pub constant: f64 = Key::new(&[Form::Number(Range::Size)], "0.5"),
    }
}

impl CompositeHardnessSection {
    /// The problem with this hardness; a refusal where the law says nothing of the body, the contact or the loads.
    pub(super) fn harden(
        &self,
        section: &TableAt<'_>,
        load: &LoadSection,
        problem: Problem,
    ) -> Result<Problem, Refusal> {
        let refuse = |message: String, help: &str| {
            let message = format!("`composite_hardness`: {message}");
            Err(Refusal::new(section.span, message, "not for this case").help(help))
        };
        if !problem.kind().is_indentation() {
            let message = "its laws are those of one indentation, and this is no isolated contact";
            return refuse(message.to_owned(), "leave the section out, or set lattice.kind = \"isolated\"");
        }
        let loads = load.loads();
        if loads.windows(2).any(|two| two[1].value() < two[0].value()) {
            let message = "the loads fall, and the hardness is that of a growing depth";
            return refuse(message.to_owned(), "give loads that rise, or leave the section out");
        }
        let composite = CompositeHardness::of(problem.half_space(), self.law, self.constant);
        composite.and_then(|composite| problem.with_composite_hardness(composite)).or_else(|error| {
            let help = match error {
                CompositeError::Counterbody(_) => "leave the section out, or give the counterbody a larger `hardness`",
                _ => "give one layer, and a `hardness` of it and of the substrate",
            };
            refuse(error.to_string(), help)
        })
    }
}
