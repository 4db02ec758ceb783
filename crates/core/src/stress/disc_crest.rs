//! The largest tension, τ₁ and von Mises stress on the surface under uniform pressures on discs, whose edges are known.
//!
//! At the edge of a disc of the radius a under p the stresses jump as on a bare half-space of the surface material, with **n** across the
//! edge and **t** along it,
//!
//! σ_αβ = σ̂_αβ − p (n_α n_β + 2ν t_α t_β) inside,  σ̂_αβ outside.
//!
//! σ̂ is continuous; outwards its slope jumps by (1 − 2ν)(p/a)(t_α t_β − n_α n_β): outside of one disc σ_rr = −σ_tt = (1 − 2ν)pa²/(2r²). The
//! waves of the discs are smoothed by a Gaussian that changes what is smooth in the fourth order of its width w alone, and both
//! singularities are replaced in the sum by sharp ones. At u widths outside the edge the smoothed step is ½ erfc(u/√2) − ½uφ(u), and the
//! smoothed kink exceeds the sharp one by w[½φ(u) − |u|Φ(−|u|)], Φ the normal distribution and φ its density.

use super::constants::{EDGE_ERROR, EDGE_WIDTH, EXACT_EDGES, USUAL_TENSION};
use super::crest::Crest;
use super::cubic::CubicInterpolation;
use super::depth_response::DepthResponse;
use super::field::{REACH, StressField};
use super::measure::StressMeasure;
use super::peak::Peak;
use super::smoothed_surface::{SurfaceStresses, fourth};
use super::tensor::StressState;
use super::transform::Transform;
use crate::body::Depth;
use crate::counterbody::LoadedDisc;
use crate::numeric::parallel;
use rayon::prelude::*;
use std::f64::consts::{PI, SQRT_2, TAU};
use std::sync::Arc;

/// Widths from an edge beyond which smoothed step and kink are the sharp ones.
const BAND: f64 = 7.0;
/// Least and largest number of points at which the edge of a disc is read first.
const EDGE_POINTS: [usize; 2] = [8, 96];

/// A side of the edge of a disc, by the number of the disc.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Side {
    disc: usize,
    is_inside: bool,
}

/// A point of the surface, on a side of an edge or away from edges.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Point {
    place: [f64; 2],
    side: Option<Side>,
}

/// Smoothed waves of the discs on the surface.
struct SmoothedDiscs<'a> {
    field: &'a StressField,
    stresses: SurfaceStresses,
    /// Width w of the Gaussian, a length.
    width: f64,
}

impl StressField {
    /// The largest values of some measures on the surface under discs; none under another pressure, under a traction, whose stresses are
    /// infinite at the edges, and where a disc is as wide as its cell.
    /// Their errors follow from the changes with other `widths` of smoothing, over the usual one.
    pub(super) fn crests_of_discs(&self, measures: &[StressMeasure], widths: &[f64]) -> Vec<(StressMeasure, Crest)> {
        let width = EDGE_WIDTH / self.least_aliased();
        let room = self.grid().cell().clear_radius();
        let fits = |disc: &LoadedDisc| disc.radius + BAND * width < room;
        if self.discs().is_empty() || self.slides() || !self.discs().iter().all(fits) {
            return Vec::new();
        }
        let response = Arc::new(self.depth_response(Depth::SURFACE, REACH));
        let smoothed = |scale: f64| SmoothedDiscs::new(self, &response, scale * width);
        let (discs, others): (_, Vec<_>) = (smoothed(1.0), widths.iter().map(|&scale| smoothed(scale)).collect());
        let longer = self.series.waves.shells_up_to(1.0 / width).saturating_sub(1);
        let [unlike, _] = response.unlike(longer, self.surface_poisson());
        let candidates = discs.candidates(measures);
        measures
            .iter()
            .zip(candidates)
            .map(|(&measure, points)| (measure, self.disc_crest(measure, &points, unlike, (&discs, &others))))
            .collect()
    }

    /// The crest at the highest of some points, its uncertainty from the changes with `others`, other widths.
    fn disc_crest(
        &self,
        measure: StressMeasure,
        points: &[Point],
        unlike: f64,
        (discs, others): (&SmoothedDiscs<'_>, &[SmoothedDiscs<'_>]),
    ) -> Crest {
        let highest = |smoothed: &SmoothedDiscs<'_>| {
            let states = smoothed.states(points).into_iter().zip(points);
            states.reduce(|a, b| if measure.of(&b.0) > measure.of(&a.0) { b } else { a }).expect("there are points")
        };
        let (state, point) = highest(discs);
        let value = measure.of(&state);
        let pressed = self.discs().iter().map(|disc| disc.pressure).fold(0.0, f64::max);
        let per_stress = measure.per_stress();
        let usual = if measure.is_tensile() { USUAL_TENSION * pressed * per_stress } else { 0.0 };
        let scale = usual.max(value.abs());
        let spread: f64 = others.iter().map(|other| (measure.of(&highest(other).0) - value).abs()).sum();
        let at_edge = |side: Side| {
            let LoadedDisc { radius, pressure, .. } = self.discs()[side.disc];
            0.5 * pressure * unlike * per_stress + EDGE_ERROR * (self.spacing() / radius).powi(2) * scale
        };
        let [x, y] = point.place;
        let material = self.half_space().material_id(1);
        let direction = state.s1_direction();
        let peak = Peak { value, position: [x, y, 0.0], material, direction, error: None, rival: None };
        Crest::with_safety(peak, spread + point.side.map_or(0.0, at_edge), scale)
    }
}

impl<'a> SmoothedDiscs<'a> {
    fn new(field: &'a StressField, response: &Arc<DepthResponse>, width: f64) -> Self {
        Self { field, stresses: SurfaceStresses::of_discs(response, |q| fourth(q * width)), width }
    }

    /// Largest sample of the surface by each measure, and the points on edges where the measure is largest.
    fn candidates(&self, measures: &[StressMeasure]) -> Vec<Vec<Point>> {
        let (grid, field) = (self.field.series_grid(), self.field);
        let ([n1, n2], cell, len) = (grid.points(), grid.cell(), grid.len());
        let transform = Transform::new([n1, n2]);
        let mut fields = vec![0.0; 4 * len];
        field.series.on_plane(&transform, Vec::new(), &self.stresses).write(&mut fields);
        let [rows, columns] = field.own_samples();
        let best_of_row = |i: usize| -> Vec<(f64, Point)> {
            let state = |j: usize| {
                let index = i * n2 + j;
                let point = Point { place: cell.point(grid.fractions(index)), side: None };
                (self.sharp(point, std::array::from_fn(|k| fields[k * len + index])), point)
            };
            let states: Vec<(StressState, Point)> = columns.clone().map(state).collect();
            let best = |measure: &StressMeasure| {
                let values = states.iter().map(|(state, point)| (measure.of(state), *point));
                values.reduce(|a, b| if b.0 > a.0 { b } else { a }).expect("a row has samples")
            };
            measures.iter().map(best).collect()
        };
        let of_rows: Vec<Vec<(f64, Point)>> = rows.into_par_iter().map(best_of_row).collect();
        let at = |point: Point| {
            let between = CubicInterpolation::new([n1, n2], cell.fractions(point.place));
            self.sharp(point, std::array::from_fn(|k| between.value(&fields[k * len..(k + 1) * len], n2)))
        };
        let points = self.edge_points();
        let edges: Vec<(StressState, Point)> = parallel::map_items(&points, |&point| (at(point), point));
        let of_measure = |(number, measure): (usize, &StressMeasure)| {
            let sample = of_rows.iter().map(|row| row[number]).reduce(|a, b| if b.0 > a.0 { b } else { a });
            let mut ordered: Vec<(f64, Point)> =
                edges.iter().map(|(state, point)| (measure.of(state), *point)).collect();
            ordered.sort_by(|a, b| b.0.total_cmp(&a.0));
            sample.into_iter().chain(ordered.into_iter().take(EXACT_EDGES)).map(|(_, point)| point).collect()
        };
        measures.iter().enumerate().map(of_measure).collect()
    }

    /// Points on both sides of the edges of all discs, some two spacings apart.
    fn edge_points(&self) -> Vec<Point> {
        let spacing = self.field.spacing();
        let of_disc = |(number, disc): (usize, &LoadedDisc)| {
            let LoadedDisc { centre: [x, y], radius, .. } = *disc;
            let count = ((PI * radius / spacing) as usize).clamp(EDGE_POINTS[0], EDGE_POINTS[1]);
            let angles = (0..count).map(move |k| TAU * k as f64 / count as f64);
            angles.flat_map(move |angle| {
                let place = [x + radius * angle.cos(), y + radius * angle.sin()];
                [true, false].map(|is_inside| Point { place, side: Some(Side { disc: number, is_inside }) })
            })
        };
        self.field.discs().iter().enumerate().flat_map(of_disc).collect()
    }

    /// States at points by the exact sums.
    fn states(&self, points: &[Point]) -> Vec<StressState> {
        let places: Vec<[f64; 2]> = points.iter().map(|point| point.place).collect();
        let sums = self.field.at(&places, &self.stresses);
        points.iter().zip(sums).map(|(&point, sum)| self.sharp(point, sum)).collect()
    }

    /// The state at a point, from σ_xx, σ_yy, σ_xy and p of the smoothed waves.
    fn sharp(&self, point: Point, [mut xx, mut yy, mut xy, mut p]: [f64; 4]) -> StressState {
        let (cell, nu) = (self.field.series_grid().cell(), self.field.surface_poisson());
        for (number, disc) in self.field.discs().iter().enumerate() {
            let away = [0, 1].map(|k| point.place[k] - disc.centre[k]);
            let [x, y] = cell.shortest_equivalent(away);
            let r = x.hypot(y);
            let side = point.side.filter(|side| side.disc == number);
            let u = if side.is_some() { 0.0 } else { (r - disc.radius) / self.width };
            if u.abs() > BAND {
                continue;
            }
            let density = (-0.5 * u * u).exp() / TAU.sqrt();
            let step = 0.5 * libm::erfc(u / SQRT_2) - 0.5 * u * density;
            let is_inside = side.map_or(u < 0.0, |side| side.is_inside);
            let jump = disc.pressure * (step - f64::from(u8::from(is_inside)));
            let excess = self.width * (0.5 * density - 0.5 * u.abs() * libm::erfc(u.abs() / SQRT_2));
            let kink = (1.0 - 2.0 * nu) * disc.pressure / disc.radius * excess;
            // Mean over all directions in the middle of a small disc.
            let [nxx, nyy, nxy] =
                if r > 0.0 { [x * x, y * y, x * y].map(|product| product / (r * r)) } else { [0.5, 0.5, 0.0] };
            xx += jump * (nxx + 2.0 * nu * nyy) + kink * (nxx - nyy);
            yy += jump * (nyy + 2.0 * nu * nxx) + kink * (nyy - nxx);
            xy += nxy * ((1.0 - 2.0 * nu) * jump + 2.0 * kink);
            p -= jump;
        }
        StressState::on_surface([xx, yy, xy, p], [0.0; 2])
    }
}
