//! The reading of the contact of a topography, beside the reading of any contact: counted and corrected area, spots, gap and
//! stiffness.
//!
//! **Area.** Samples in contact are counted, and the count is corrected by the perimeter of contact
//! (V. A. Yastrebov, G. Anciaux & J.-F. Molinari, Tribol. Int. 114 (2017) 161–171).
//! The reading between the samples errs by more where spots have fewer than some ten samples across, or are many without smooth
//! boundaries: [`Reading::contact_fraction`](super::Reading::contact_fraction) is then the one of both with the smaller error.
//!
//! **Spots** are samples in contact whose cells share an edge or a corner, as the usual tools of the field join them; what is
//! open joins at edges alone, so that a spot closed at corners keeps its hole. Cells of samples are parallelograms of the reduced
//! basis of the samples' lattice, squares on a square cell, with eight neighbours; on a hexagonal cell they are hexagons, whose
//! six neighbours all share edges.
//!
//! **Stiffness.** [`stiffness`] is dp̄/dδ from neighbouring load steps: with the mean gap ū, dp̄/dδ = −dp̄/dū. An isolated contact has its
//! exact dP/dδ by [`Tangent`](crate::Tangent) instead, except under friction that couples.
//!
//! **An isolated contact** has no area to which parts, densities and a mean gap could be related: it lies in a window of any size.
//! None of these is stated, instead of a number each; the area of contact, the spots and the stiffness do not depend on the window.

use super::counted::CountedArea;
use super::histogram::Histogram;
use crate::lattice::Grid;
use crate::lattice::components::SpotCounts;
use crate::numeric::sums;
use crate::quantity::quantities;
use crate::spectral::Contact;
use serde::{Deserialize, Serialize};

quantities! {
    /// Scalars and distributions of the contact of a topography.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct RoughReading {
        /// Samples in contact over all samples; `None` for an isolated contact.
        #[serde(deserialize_with = "Option::deserialize")]
        pub counted_fraction: Option<f64>,
        /// Fraction of the cell in contact, counted and corrected by the perimeter; `None` for an isolated contact.
        #[serde(deserialize_with = "Option::deserialize")]
        pub corrected_fraction: Option<f64> = Fraction "fraction counted and corrected by the perimeter" "A/A₀"
            short "counted, corrected by the perimeter" error corrected_fraction_error,
        /// Estimated discretisation error of the corrected fraction; `None` without a coarser grid.
        #[serde(default)]
        pub corrected_fraction_error: Option<f64>,
        /// Length of the contacts' borders along the samples' edges, over the cell's area: 1/length. A border without preferred
        /// direction is 4/π times as long along the edges of rectangular samples as it is. `None` for an isolated contact.
        #[serde(deserialize_with = "Option::deserialize")]
        pub perimeter_density: Option<f64>,
        /// Contact spots, by their counted areas.
        pub spots: SpotSizes,
        /// Mean gap over the cell, zero in contact; a length. `None` for an isolated contact.
        #[serde(deserialize_with = "Option::deserialize")]
        pub mean_gap: Option<f64> = Length "mean gap" "ū" error mean_gap_error,
        /// Estimated discretisation error of the mean gap, a length; `None` without a coarser grid, and for an isolated contact.
        #[serde(default)]
        pub mean_gap_error: Option<f64>,
        /// Normal stiffness dp̄/dδ by the neighbouring load steps, pressure per length; `None` without them. Of an isolated contact dP/dδ,
        /// force per length, under friction that couples alone: `None` where the step has its contact stiffness by the tangent.
        pub stiffness: Option<f64> = PressurePerLength "stiffness" "dp̄/dδ" error stiffness_error,
        /// Estimated error of the stiffness, in its unit.
        pub stiffness_error: Option<f64>,
        /// Histograms of pressure and gap over the samples, and of the areas of spots; of an isolated contact without the gap, and of the
        /// pressure over the samples in contact.
        #[serde(skip)]
        pub histograms: Vec<Histogram>,
    }
    table RoughQuantities as ROUGH;
}

/// Sizes of the contact spots; areas are counted, lengths squared. 0 without contact.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SpotSizes {
    /// Number of spots in the cell.
    pub count: usize,
    /// Spots per area of the surface, 1/length²; `None` for an isolated contact.
    #[serde(deserialize_with = "Option::deserialize")]
    pub density: Option<f64>,
    /// Mean area of a spot.
    pub mean_area: f64,
    /// Median of the areas.
    pub median_area: f64,
    /// Area up to which, from the smallest on, spots carry half of the load.
    pub half_load_area: f64,
    /// Area of the largest spot.
    pub largest_area: f64,
    /// Whether a spot reaches across the cell to an image of itself.
    pub percolates: bool,
}

impl RoughReading {
    /// Reading of a contact without estimated errors; `None` for indenters. [`Step::rough_reading`](crate::Step::rough_reading)
    /// has them.
    pub fn of(contact: &Contact) -> Option<Self> {
        contact.problem().topography()?;
        Some(Self::with_counted(contact, &CountedArea::of(contact.grid(), contact.pressures())))
    }

    /// Reading of the contact of a topography whose samples in contact are counted already.
    pub(super) fn with_counted(contact: &Contact, counted: &CountedArea) -> Self {
        let (grid, pressure, gap) = (contact.grid(), contact.pressures(), contact.gaps());
        let surroundings = grid.cell().surroundings();
        let (spots, areas) = spots(grid, contact.spots(None));
        let touching = pressure.iter().copied().filter(|p| *p > 0.0);
        let open = pressure.iter().zip(gap).filter(|(p, _)| **p <= 0.0).map(|(_, gap)| gap.max(0.0));
        let by_pressure = |samples: usize| Histogram::even("pressure", touching.clone(), samples);
        let by_gap = |samples: usize| Histogram::even("gap", open, samples);
        let samples = surroundings.per_cell(grid.len());
        let histograms = [
            Some(by_pressure(samples.unwrap_or_else(|| touching.clone().count()))),
            samples.map(by_gap),
            Some(Histogram::by_decades("spot_area", areas.iter().copied())),
        ];
        Self {
            counted_fraction: surroundings.per_cell(counted.fraction),
            corrected_fraction: surroundings.per_cell(counted.corrected.value),
            corrected_fraction_error: counted.error.and_then(|error| surroundings.per_cell(error)),
            perimeter_density: surroundings.per_cell(counted.perimeter_density),
            spots,
            mean_gap: surroundings.per_cell(contact).map(mean_gap),
            mean_gap_error: None,
            stiffness: None,
            stiffness_error: None,
            histograms: histograms.into_iter().flatten().collect(),
        }
    }
}

/// Mean gap over the cell, zero in contact; a length.
pub(super) fn mean_gap(contact: &Contact) -> f64 {
    let (pressure, gap) = (contact.pressures(), contact.gaps());
    sums::of(gap.len(), |k| if pressure[k] > 0.0 { [0.0] } else { [gap[k].max(0.0)] })[0] / gap.len() as f64
}

/// Sizes of the spots, and the areas of all spots, ascending.
fn spots(grid: &Grid, counts: &SpotCounts) -> (SpotSizes, Vec<f64>) {
    let areas: Vec<f64> = counts.sizes.iter().map(|(size, _)| *size as f64 * grid.sample_area()).collect();
    let density = grid.cell().surroundings().per_cell(areas.len() as f64 / grid.cell().area());
    let [Some(&largest_area), Some(&median_area)] = [areas.last(), areas.get(areas.len() / 2)] else {
        return (SpotSizes { density, ..SpotSizes::default() }, areas);
    };
    let sizes = SpotSizes {
        count: areas.len(),
        density,
        mean_area: areas.iter().sum::<f64>() / areas.len() as f64,
        median_area,
        half_load_area: counts.half_load().map_or(largest_area, |middle| areas[middle]),
        largest_area,
        percolates: counts.wraps,
    };
    (sizes, areas)
}

/// Normal stiffness dp̄/dδ at each of several load steps [p̄, δ], and its estimated error; `None` where the steps do not determine
/// it. Forces in the place of mean pressures give dP/dδ.
///
/// The pressure of rough surfaces grows nearly as e^{δ/u₀}, so that δ is a smooth function of ln p̄: its derivative is that of
/// the parabola through a step and its neighbours, and dp̄/dδ = p̄/(dδ/d ln p̄). Between two steps the derivative takes the
/// secant's value somewhere: the error is the largest distance from the secants of the intervals up to two steps away, at an
/// end of the path twice that from the last one at least.
pub fn stiffness(steps: &[[f64; 2]]) -> Vec<Option<[f64; 2]>> {
    let mut path: Vec<[f64; 2]> =
        steps.iter().filter(|[p, _]| *p > 0.0 && p.is_finite()).map(|[p, depth]| [p.ln(), *depth]).collect();
    path.sort_by(|a, b| a[0].total_cmp(&b[0]));
    path.dedup_by(|next, kept| next[0] - kept[0] < SAME_LOAD);
    let lengths: Vec<f64> = path.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
    let secants: Vec<f64> =
        path.windows(2).zip(&lengths).map(|(pair, length)| (pair[1][1] - pair[0][1]) / length).collect();
    let at = |&[pressure, _]: &[f64; 2]| {
        let index = path.iter().position(|[x, _]| (x - pressure.ln()).abs() < SAME_LOAD).filter(|_| pressure > 0.0)?;
        // The interval at the step, and the next one: at an end of the path both on one side.
        let [interval, next] = match index {
            _ if secants.is_empty() => return None,
            _ if secants.len() == 1 => [0, 0],
            0 => [0, 1],
            last if last == secants.len() => [last - 1, last - 2],
            inner => [inner - 1, inner],
        };
        let is_end = index == 0 || index == secants.len();
        let (near, far) = (lengths[interval], lengths[next]);
        let rise = (secants[next] - secants[interval]) * near / (near + far);
        let derivative = secants[interval] + if is_end { -rise } else { rise };
        let value = Some(pressure / derivative).filter(|value| value.is_finite() && *value > 0.0)?;
        let distance = |secant: &f64| (value - pressure / secant).abs();
        let around = secants[index.saturating_sub(2)..].iter().take(index.min(2) + 2).map(distance).fold(0.0, f64::max);
        let error = match is_end {
            _ if secants.len() == 1 => value,
            true => around.max(2.0 * distance(&secants[interval])),
            false => around,
        };
        Some([value, error]).filter(|[_, error]| error.is_finite())
    };
    steps.iter().map(at).collect()
}

/// Difference of ln p̄ below which two load steps are one.
const SAME_LOAD: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;
    use crate::lattice::components::contact_spots;

    #[test]
    fn sizes_are_those_of_the_spots() {
        let grid = Grid::new(Cell::square(2.0).unwrap(), [8, 8]).unwrap();
        let mut pressure = [0.0; 64];
        let spots = |pressure: &[f64]| {
            let found = contact_spots(&grid, pressure);
            spots(&grid, &SpotCounts::of(&found, &grid, pressure))
        };
        assert_eq!(spots(&pressure).0, SpotSizes { density: Some(0.0), ..SpotSizes::default() });
        pressure[0] = 9.0;
        pressure[16..18].fill(1.0);
        pressure[36..40].fill(0.5);
        let (sizes, areas) = spots(&pressure);
        let sample = 4.0 / 64.0;
        assert_eq!(areas, [sample, 2.0 * sample, 4.0 * sample]);
        assert_eq!((sizes.count, sizes.density, sizes.percolates), (3, Some(0.75), false));
        assert_eq!((sizes.median_area, sizes.largest_area, sizes.half_load_area), (areas[1], areas[2], areas[0]));
        pressure[24..32].fill(1.0);
        assert!(spots(&pressure).0.percolates);
    }

    /// p = e^{δ/u₀} has p/u₀, and p = δ^{3/2} has (3/2) δ^{1/2}.
    #[test]
    fn stiffness_is_the_derivative_and_its_error_holds() {
        let depths: Vec<f64> = (1..=7).map(|k| 0.1 * f64::from(k)).collect();
        let exponential: Vec<[f64; 2]> = depths.iter().map(|d| [(d / 0.2).exp(), *d]).collect();
        for (found, [p, _]) in stiffness(&exponential).iter().zip(&exponential) {
            let [value, error] = found.unwrap();
            assert!((value / (p / 0.2) - 1.0).abs() < 1e-10 && error < 1e-10 * value);
        }
        // In any order, and one of them twice.
        let loads = [4, 0, 3, 1, 5, 2, 2].map(|k| 1e-3 * 1.5f64.powi(k));
        let hertz = loads.map(|p| [p, p.powf(2.0 / 3.0)]);
        for (found, [_, depth]) in stiffness(&hertz).iter().zip(&hertz) {
            let ([value, error], exact) = (found.unwrap(), 1.5 * depth.sqrt());
            assert!((value - exact).abs() < error && error < exact, "{value} ± {error}, {exact}");
        }
        assert_eq!(stiffness(&[[0.1, 0.2]]), [None]);
        assert_eq!(stiffness(&[[0.0, 0.0], [0.1, 0.2]]), [None, None]);
        let [value, error] = stiffness(&hertz[..2])[0].unwrap();
        assert_eq!(value, error, "two steps do not determine the error");
    }
}
