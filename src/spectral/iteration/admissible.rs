//! The pressures among which the methods search.

/// Admissible pressures: p ≥ 0 where contact may occur, p = 0 elsewhere.
///
/// A further bound on the pressure (p ≤ hardness) would belong here too. It takes more than the clipping of a step: a second
/// active set, a load that is restored by a shift instead of a scale, and the least ⟨s, g⟩ over the box for the certificate.
#[derive(Debug, Clone, Copy, Default)]
pub struct AdmissibleSet<'a> {
    /// Whether contact may occur, one value per sample; `None`: everywhere.
    mask: Option<&'a [bool]>,
}

impl<'a> AdmissibleSet<'a> {
    /// Pressures on the samples of a mask; on all samples without one.
    pub fn new(mask: Option<&'a [bool]>) -> Self {
        Self { mask }
    }

    /// Whether contact may occur everywhere.
    pub fn is_everywhere(self) -> bool {
        self.mask.is_none()
    }

    /// p ← 0 where contact may not occur.
    pub(super) fn restrict(self, pressure: &mut [f64]) {
        self.closed().for_each(|i| pressure[i] = 0.0);
    }

    /// The uniform pressure on the samples of the set with the given sum.
    pub(super) fn fill(self, pressure: &mut [f64], sum: f64) {
        let size = pressure.len() - self.closed().count();
        pressure.fill(sum / size as f64);
        self.restrict(pressure);
    }

    /// g ← `far` where contact may not occur: such a sample never joins the active set.
    pub(super) fn open(self, gap: &mut [f64], far: f64) {
        self.closed().for_each(|i| gap[i] = far);
    }

    /// min g, and min g where p = 0, over the samples where contact may occur.
    pub(super) fn least_gaps(self, pressure: &[f64], gap: &[f64]) -> [f64; 2] {
        let admissible = |i: &usize| self.mask.is_none_or(|mask| mask[*i]);
        (0..gap.len()).filter(admissible).fold([f64::INFINITY; 2], |[least, outside], i| {
            [least.min(gap[i]), if pressure[i] > 0.0 { outside } else { outside.min(gap[i]) }]
        })
    }

    /// Samples where contact may not occur.
    fn closed(self) -> impl Iterator<Item = usize> + use<'a> {
        self.mask.unwrap_or_default().iter().enumerate().filter(|(_, admissible)| !**admissible).map(|(i, _)| i)
    }
}
