//! Cubics through values at unequal places, with limited slopes.
//!
//! Each slope is that of the parabola through three places. Where values do not bend evenly it is no steeper than three times the flatter
//! of its secants, so that a rise at one place raises nothing beyond its neighbours (Hyman, SIAM J. Sci. Stat. Comput. 4 (1983) 645).
//! Beside a smooth maximum one secant is flat, and that limit would flatten the top: bends that are alike are no rise at one place
//! (Dougherty, Edelman & Hyman, Math. Comp. 52 (1989) 471).

/// Most slope over the flatter secant.
const STEEPEST: f64 = 3.0;
/// Largest ratio of bends that are alike.
const ALIKE: f64 = 4.0;

/// Slopes of values at ascending places.
pub fn slopes(places: &[f64], values: &[f64]) -> Vec<f64> {
    let apart = |k: usize| places[k + 1] - places[k];
    let secant = |k: usize| (values[k + 1] - values[k]) / apart(k);
    let bend = |k: usize| (secant(k) - secant(k - 1)) / (apart(k) + apart(k - 1));
    let last = places.len().saturating_sub(1);
    let slope = |place: usize| match place {
        _ if last == 0 => 0.0,
        _ if last == 1 => secant(0),
        0 => end_slope([secant(0), secant(1)], [apart(0), apart(1)]),
        _ if place == last => end_slope([secant(last - 1), secant(last - 2)], [apart(last - 1), apart(last - 2)]),
        _ if are_alike((place - 1..=place + 1).filter(|&k| 0 < k && k < last).map(bend)) => {
            parabola_slope([secant(place - 1), secant(place)], [apart(place - 1), apart(place)])
        }
        _ => inner_slope([secant(place - 1), secant(place)], [apart(place - 1), apart(place)]),
    };
    (0..places.len()).map(slope).collect()
}

/// The cubic with value and slope at both ends `apart` at a part t of the way, not below 0.
pub fn between([[a, p], [b, q]]: [[f64; 2]; 2], apart: f64, t: f64) -> f64 {
    let (s, u) = (t * t * (3.0 - 2.0 * t), 1.0 - t);
    let linear = if s == 0.0 { a } else { a + s * (b - a) };
    (linear + apart * t * u * (u * p - t * q)).max(0.0)
}

/// Whether two or more bends have the same sign and about the same size.
fn are_alike(bends: impl Iterator<Item = f64>) -> bool {
    let bends: Vec<f64> = bends.collect();
    let [least, most] = [f64::min, f64::max].map(|of| bends.iter().map(|bend| bend.abs()).reduce(of).unwrap_or(0.0));
    bends.len() > 1 && bends.iter().all(|bend| bend * bends[0] > 0.0) && most <= ALIKE * least
}

/// Slope of the parabola through three places in the middle one, from the secants before and after it and their lengths.
fn parabola_slope([before, after]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    (b * before + a * after) / (a + b)
}

/// Slope of the parabola in its middle place, limited where values do not bend evenly.
fn inner_slope(secants: [f64; 2], lengths: [f64; 2]) -> f64 {
    limited(parabola_slope(secants, lengths), secants[0].abs().min(secants[1].abs()))
}

/// Slope of that parabola in its first place, from the first secant on; not against it.
fn end_slope([first, second]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    let slope = limited(((2.0 * a + b) * first - a * second) / (a + b), first.abs());
    if slope * first > 0.0 { slope } else { 0.0 }
}

fn limited(slope: f64, flatter: f64) -> f64 {
    let most = STEEPEST * flatter;
    if most.is_finite() { slope.clamp(-most, most) } else { 0.0 }
}
