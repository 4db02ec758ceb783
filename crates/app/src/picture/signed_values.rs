//! Values of a stress in sections of both bodies: z > 0 in the body, z < 0 in the counterbody above it.

use super::between_rows::{at, zeros};
use ndarray::Array2;
use percoat_core::reading::SectionMeasure;
use percoat_core::stress::VerticalSection;

/// Signs of z in the body and in the counterbody, which is drawn above.
pub(super) const SIGNS: [f64; 2] = [1.0, -1.0];

/// Values of a measure in the bodies; z < 0 in the counterbody.
pub(super) struct SignedValues<'a> {
    parts: Vec<(&'a VerticalSection, Array2<f64>)>,
}

impl<'a> SignedValues<'a> {
    pub(super) fn new(sections: &'a [VerticalSection], measure: SectionMeasure) -> Self {
        Self { parts: sections.iter().map(|section| (section, section.values(measure))).collect() }
    }

    /// The value at s, z; `None` outside.
    pub(super) fn at(&self, [s, z]: [f64; 2]) -> Option<f64> {
        let above = self.parts.get(1).filter(|_| z < 0.0);
        let (section, values) = above.or(self.parts.first())?;
        at(section, values, s, if above.is_some() { -z } else { z })
    }

    /// Lines of points s, z on which values are zero.
    pub(super) fn zero_lines(&self) -> Vec<Vec<[f64; 2]>> {
        let of = |(part, (section, values)): (usize, &(&VerticalSection, Array2<f64>))| {
            let lines = zeros(section, values).into_iter();
            lines.map(|line| line.into_iter().map(|[s, z]| [s, SIGNS[part] * z]).collect()).collect::<Vec<_>>()
        };
        self.parts.iter().enumerate().flat_map(of).collect()
    }

    /// Least and largest of the values, of zero and of `more` values.
    pub(super) fn span(&self, more: impl Iterator<Item = f64>) -> [f64; 2] {
        let values = self.parts.iter().flat_map(|(_, values)| values.iter().copied());
        values.chain(more).fold([0.0, 0.0], |[low, high], x| [x.min(low), x.max(high)])
    }
}
