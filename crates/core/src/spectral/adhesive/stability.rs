//! Stability of a state under tension: how far the softening of the tension is from what the bodies bear.
//!
//! Small changes v of the gap on its open samples change the energy by ½⟨v, K v⟩ − ½⟨s v, v⟩, s = −dτ/dg. The state is stable as long as
//!
//! κ = max ⟨s v, v⟩/⟨v, K v⟩ < 1
//!
//! over all v that are zero in contact, and of zero mean where the mean displacement is held. 1 − κ is the margin. κ is the rate of the convex–concave
//! iteration too. Found by conjugate gradients on Rayleigh's quotient, preconditioned with C.

use super::elastic::{Elastic, Hold};
use super::minimiser::Fields;
use super::tension::Tension;
use crate::numeric::sums;

/// Relative change of 1 − κ at which the search ends, and most of its steps.
const TOLERANCE: f64 = 2e-3;
const MOST_STEPS: usize = 80;

/// A change v of the gap, with its K v.
#[derive(Clone)]
struct Change {
    field: Vec<f64>,
    image: Vec<f64>,
}

/// κ of a state; 0 where the tension does not soften.
pub(super) fn softening_over_stiffness(elastic: &mut Elastic, tension: &Tension, hold: Hold, fields: &Fields) -> f64 {
    let gap = &fields.gap;
    let is_free = |elastic: &Elastic, i: usize| !elastic.is_inside(i) || gap[i] > 0.0;
    let mut softening = vec![0.0; gap.len()];
    sums::update(
        &mut softening,
        |i, _| {
            if elastic.is_inside(i) && gap[i] > 0.0 { tension.softening(gap[i]) } else { 0.0 }
        },
    );
    if softening.iter().all(|s| *s == 0.0) {
        return 0.0;
    }
    let admit = |elastic: &Elastic, field: &mut [f64]| {
        sums::update(field, |i, v| if is_free(elastic, i) { v } else { 0.0 });
        if hold == Hold::Mean {
            let [sum, free] = sums::of(field.len(), |i| if is_free(elastic, i) { [field[i], 1.0] } else { [0.0; 2] });
            sums::update(field, |i, v| if is_free(elastic, i) { v - sum / free } else { 0.0 });
        }
    };
    let compliance = match hold {
        Hold::Spring(compliance) => compliance,
        Hold::Mean | Hold::Load(_) => elastic.unit(),
    };
    let change = |elastic: &mut Elastic, mut field: Vec<f64>| {
        elastic.displace(&mut field, compliance);
        admit(elastic, &mut field);
        let mut image = field.clone();
        elastic.press(&mut image, if let Hold::Spring(compliance) = hold { Some(compliance) } else { None });
        Change { field, image }
    };
    let mut best = change(elastic, softening.clone());
    let (mut direction, mut kappa, mut before) = (None::<Change>, 0.0, 0.0);
    for _ in 0..MOST_STEPS {
        let [soft, stiff] = quotient(&softening, &best, &best);
        if stiff <= 0.0 {
            return kappa;
        }
        let last = std::mem::replace(&mut kappa, soft / stiff);
        if (kappa - last).abs() < TOLERANCE * (1.0 - kappa).abs() {
            break;
        }
        // Uphill, preconditioned.
        let mut uphill = vec![0.0; gap.len()];
        sums::update(&mut uphill, |i, _| {
            if is_free(elastic, i) { softening[i] * best.field[i] - kappa * best.image[i] } else { 0.0 }
        });
        let kept = uphill.clone();
        let mut next = change(elastic, uphill);
        let [slope] = sums::of(gap.len(), |i| [kept[i] * next.field[i]]);
        if let Some(old) = direction.take().filter(|_| before > 0.0) {
            let beta = slope / before;
            sums::update(&mut next.field, |i, v| v + beta * old.field[i]);
            sums::update(&mut next.image, |i, v| v + beta * old.image[i]);
        }
        before = slope;
        best = highest(&softening, &best, &next);
        direction = Some(next);
    }
    kappa
}

/// ⟨s a, b⟩ and ⟨a, K b⟩.
fn quotient(softening: &[f64], a: &Change, b: &Change) -> [f64; 2] {
    sums::of(softening.len(), |i| [softening[i] * a.field[i] * b.field[i], a.field[i] * b.image[i]])
}

/// The combination a + t b with the largest quotient, scaled to its size.
fn highest(softening: &[f64], a: &Change, b: &Change) -> Change {
    let [[saa, kaa], [sab, kab], [sbb, kbb]] =
        [quotient(softening, a, a), quotient(softening, a, b), quotient(softening, b, b)];
    // (saa + 2t sab + t² sbb)/(kaa + 2t kab + t² kbb) is stationary at the roots of a quadratic.
    let [c0, c1, c2] = [sab * kaa - saa * kab, sbb * kaa - saa * kbb, sbb * kab - sab * kbb];
    let root = (c1 * c1 - 4.0 * c0 * c2).max(0.0).sqrt();
    let q = -0.5 * (c1 + root.copysign(c1));
    let value = |t: f64| (saa + t * (2.0 * sab + t * sbb)) / (kaa + t * (2.0 * kab + t * kbb));
    let roots = [q / c2, c0 / q].into_iter().filter(|t| t.is_finite());
    let t = roots.fold(0.0, |best: f64, t| if value(t) > value(best) { t } else { best });
    let size = (kaa + t * (2.0 * kab + t * kbb)).max(f64::MIN_POSITIVE).sqrt();
    let mut sum = a.clone();
    sums::update(&mut sum.field, |i, v| (v + t * b.field[i]) / size);
    sums::update(&mut sum.image, |i, v| (v + t * b.image[i]) / size);
    sum
}
