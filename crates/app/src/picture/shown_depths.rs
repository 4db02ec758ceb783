//! The depths that a panel of a section shows, and their scale: the whole section, or thin coatings once more.

use percoat_core::run::places::{BELOW_COATING, THIN};
use percoat_core::stress::VerticalSection;
use percoat_draw::number::short;

/// Height over width of a section that is not shown to scale, least and largest.
const ASPECT: [f64; 2] = [0.4, 1.1];
/// Height over width of a coating on its own, least and largest; the label fits along the lowest panel.
const COATING_ASPECT: [f64; 2] = [0.45, 0.8];

/// Depths that a panel shows; z < 0 in the counterbody.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ShownDepths {
    /// z at the top and at the bottom, lengths.
    pub(super) top: f64,
    pub(super) bottom: f64,
    /// Height over width of the panel.
    pub(super) aspect: f64,
    /// Ratio of the scales of depth and of the line.
    stretch: f64,
    /// Whether it shows a coating alone.
    pub(super) is_coating: bool,
}

impl ShownDepths {
    /// The whole of sections along one line, the counterbody above the body.
    pub(super) fn whole(sections: &[VerticalSection]) -> Self {
        let top = sections.get(1).map_or(0.0, |above| -deepest(above));
        Self::between(sections, [top, deepest(&sections[0])], ASPECT, false)
    }

    /// The layers of each body with a little of its substrate, where those of one are [thin](THIN) in the whole; else `None`.
    pub(super) fn coating(sections: &[VerticalSection]) -> Option<Self> {
        let height: f64 = sections.iter().map(deepest).sum();
        let coatings = || sections.iter().map(|section| section.interfaces().last().copied());
        if !coatings().flatten().any(|coating| coating < THIN * height) {
            return None;
        }
        let ends: Vec<f64> = coatings()
            .zip(sections)
            .map(|(coating, section)| {
                coating.map_or(0.0, |thickness| (BELOW_COATING * thickness).min(deepest(section)))
            })
            .collect();
        let top = ends.get(1).map_or(0.0, |above| -above);
        Some(Self::between(sections, [top, ends[0]], COATING_ASPECT, true))
    }

    fn between(sections: &[VerticalSection], [top, bottom]: [f64; 2], aspects: [f64; 2], is_coating: bool) -> Self {
        let [first, last] = sections[0].line.span;
        let scale = (bottom - top) / (last - first);
        let aspect = scale.clamp(aspects[0], aspects[1]);
        Self { top, bottom, aspect, stretch: aspect / scale, is_coating }
    }

    /// A sentence on its scale, after the word for depth; empty where it is to scale.
    pub(super) fn words(&self, depth: &str) -> String {
        let times = |stretch: f64| short(format!("{stretch:.1e}").parse().unwrap_or(stretch));
        match self.stretch {
            s if s > 1.0 + 1e-9 => format!("{depth} is stretched by a factor of {}.", times(s)),
            s if s < 1.0 - 1e-9 => format!("{depth} is compressed by a factor of {}.", times(s.recip())),
            _ => String::new(),
        }
    }
}

/// Depth of the last row, a length.
pub(super) fn deepest(section: &VerticalSection) -> f64 {
    section.depths.last().map_or(1.0, |depth| depth.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ndarray::Array2;
    use percoat_core::body::Depth;
    use percoat_core::stress::{StressState, SurfaceLine};

    /// A section of a length and a depth, below layers of a thickness.
    fn section(length: f64, depth: f64, coating: Option<f64>) -> VerticalSection {
        let row = |z: f64, material: usize| Depth { z, material };
        let depths = match coating {
            Some(z) => vec![row(0.0, 1), row(z, 1), row(z, 2), row(depth, 2)],
            None => vec![row(0.0, 1), row(depth, 1)],
        };
        let line = SurfaceLine { origin: [0.0; 2], direction: [1.0, 0.0], span: [0.0, length], points: 2 };
        let states = Array2::from_elem((depths.len(), 2), StressState::default());
        VerticalSection { line, depths, states, highest: None }
    }

    #[test]
    fn a_coating_of_less_than_a_twelfth_is_shown_once_more() {
        let shown =
            |sections: &[VerticalSection]| ShownDepths::coating(sections).map(|depths| [depths.top, depths.bottom]);
        assert_eq!(shown(&[section(140.0, 60.0, Some(3.0))]), Some([0.0, 7.5]));
        assert_eq!(shown(&[section(140.0, 60.0, Some(6.0))]), None);
        assert_eq!(shown(&[section(140.0, 60.0, None)]), None);
        // Beside an uncoated counterbody the body's coating is a smaller part of the whole.
        assert_eq!(shown(&[section(140.0, 60.0, Some(6.0)), section(140.0, 60.0, None)]), Some([0.0, 15.0]));
        assert_eq!(shown(&[section(140.0, 60.0, Some(3.0)), section(140.0, 60.0, Some(2.0))]), Some([-5.0, 7.5]));
    }

    #[test]
    fn what_is_not_to_scale_is_said() {
        let whole = ShownDepths::whole(&[section(100.0, 60.0, Some(2.0))]);
        assert_eq!((whole.aspect, whole.words(" Depth")), (0.6, String::new()));
        let coating = ShownDepths::coating(&[section(100.0, 60.0, Some(2.0))]).unwrap();
        assert_eq!((coating.aspect, &coating.words(" depth")[..]), (0.45, " depth is stretched by a factor of 9."));
    }
}
