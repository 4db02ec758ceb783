//! The largest tension, τ₁ and von Mises on the surface: at an edge of contact, or in the open.
//!
//! 1. **Edges** beside the samples where contact ends are found between the samples of the smoothed pressure, and the
//!    tension there is read between those of the smoothed stresses.
//! 2. **Everywhere** the tension is that of the [`Skin`]: of the series itself but for a band along the edges.
//! 3. The highest edges and the highest sample are read again by the exact sums, with three widths.
//!
//! Fields that are used up row by row are not kept: of the smoothed stresses near edges no more than the band.

use super::field::{REACH, StressField};
use super::peak::Peak;
use super::quantity::{LargestSoFar, OVERALL, Quantity};
use super::surface::Skin;
use super::tensor::State;
use super::transform::Transform;
use crate::body::Depth;
use crate::numeric::search::{first_largest, largest};
use rayon::prelude::*;
use std::sync::Arc;

/// Widths that the largest tension is read with again, over the usual ones: how it changes tells its error.
const OTHER: [f64; 2] = [0.7, 1.45];
/// Places that the exact sum decides between.
const FINALISTS: usize = 8;
/// The error of a tension beside a spot or open place of n samples per radius is at least this over n² of the tension,
/// and of the usual one.
const FEW: f64 = 0.3;
/// The cusp that a traction makes at the trailing edge errs by at least this over n of the stress 2μp that leads to it.
const CUSP: f64 = 0.2;
/// Where coupling ends the pressure like d^{½+η}, what is read at its edge takes that for a square root: the cusp errs by
/// about this times |η| n^{|η|−½} of the stress that leads to it (`validation/sliding-wave`).
const POWER: f64 = 3.0;
/// Usual tension at an edge over the largest pressure: (1 − 2ν)/3 at Hertz' contact.
const TENSION: f64 = 0.13;
/// By how much all that makes an error uncertain is multiplied, so that nineteen of twenty hold.
const SAFETY: f64 = 1.5;
/// Where a spot of n samples per radius stands against a coarser grid: errors fall at least as n^{−1.5}, so that the
/// finer of two grids whose spacings have the ratio 2 errs by less than the change over 2^{1.5} − 1.
/// Under a counterbody that slides they fall as n^{−1.2} where an edge lies awkwardly between the samples
/// (`validation/sliding-sphere`): over 2^{1.2} − 1 = 1.3, for which [`SAFETY`] makes up.
const FALL: f64 = 1.8;

/// The largest of a stress on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crest {
    /// Where and how large.
    pub peak: Peak,
    /// How uncertain its value is by what this grid alone tells, a pressure.
    pub uncertainty: f64,
    /// What errors are relative to: the stress itself, or the usual tension under the largest pressure, 0.13 of it, where
    /// that is more (as on incompressible materials, which have no tension at the edge).
    pub scale: f64,
}

impl Crest {
    /// Estimated relative error, also from the largest value of the same stress on the surface of the next `coarser` grid.
    pub fn error(&self, coarser: Option<f64>) -> f64 {
        let change = coarser.map_or(0.0, |value| (value - self.peak.value).abs());
        SAFETY * (self.uncertainty + change / FALL) / self.scale
    }
}

/// What stands at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Open,
    Edge,
}

/// An edge between the samples.
#[derive(Debug, Clone, Copy)]
struct Edge {
    place: [f64; 2],
    /// p̃ and its slopes.
    near: [f64; 3],
    /// That of the less resolved of the spot and the open place beside it.
    resolution: f64,
    state: State,
}

/// The samples near edges, row by row: their columns, and what is known there.
type Band<T> = Vec<Vec<(usize, T)>>;

/// σ_xx, σ_yy, σ_xy and p as they are near an edge, and the part that the series itself has.
type Sharp = ([f64; 4], f64);

/// A place between the samples, read by cubics in each direction: rows and columns around it, and their weights.
#[derive(Debug)]
struct Between {
    rows: [(usize, f64); 4],
    columns: [(usize, f64); 4],
}

/// What stands at a place on the surface.
#[derive(Debug, Clone, Copy)]
struct Highest {
    kind: Kind,
    place: [f64; 2],
    state: State,
    /// The pressure there, smoothed for edges.
    smoothed: f64,
}

/// What is read off the surface once for all crests.
#[derive(Debug)]
struct Surface {
    skin: Skin,
    /// The same with other widths.
    others: [Skin; OTHER.len()],
    edges: Vec<Edge>,
    /// Place of the largest sample of each quantity.
    samples: Vec<[f64; 2]>,
    /// The largest smoothed pressure.
    pressed: f64,
}

impl StressField {
    /// The largest tension, τ₁ and von Mises on the surface; none where there is no edge: contact is complete, or nowhere.
    pub(super) fn crests(&self) -> Vec<(Quantity, Crest)> {
        self.crests_of(&OVERALL)
    }

    /// Those of some quantities.
    pub(super) fn crests_of(&self, quantities: &[Quantity]) -> Vec<(Quantity, Crest)> {
        if !self.regions().have_edges() {
            return Vec::new();
        }
        let surface = self.read_surface(quantities);
        // The places where a quantity may be largest, as indices into `places`: most quantities share theirs.
        let mut places: Vec<(Kind, [f64; 2])> = Vec::new();
        let finalists: Vec<Vec<usize>> = quantities
            .iter()
            .zip(&surface.samples)
            .map(|(&quantity, &sample)| {
                let number = |place: (Kind, [f64; 2])| {
                    places.iter().position(|own| *own == place).unwrap_or_else(|| {
                        places.push(place);
                        places.len() - 1
                    })
                };
                surface.finalists(quantity, sample).into_iter().map(number).collect()
            })
            .collect();
        let read = |skin: &Skin| self.read_places(skin, &places);
        let (own, others) = (read(&surface.skin), surface.others.each_ref().map(read));
        let of = |(&quantity, numbers): (&Quantity, &Vec<usize>)| {
            let highest = |all: &[Highest]| {
                let own = numbers.iter().map(|&number| all[number]);
                own.max_by(|a, b| quantity.of(&a.state).total_cmp(&quantity.of(&b.state)))
            };
            let others = others.iter().filter_map(|other| highest(other));
            highest(&own).map(|highest| (quantity, self.crest_of(&surface, quantity, highest, others)))
        };
        quantities.iter().zip(&finalists).filter_map(of).collect()
    }

    /// The largest tension on the surface; `None` where there is no edge: contact is complete, or nowhere.
    pub fn crest(&self) -> Option<Crest> {
        self.crests_of(&[Quantity::Tension]).first().map(|(_, crest)| *crest)
    }

    fn read_surface(&self, quantities: &[Quantity]) -> Surface {
        let slice = Arc::new(self.slice(Depth::SURFACE, REACH));
        let skin = Skin::new(self, &slice, 1.0);
        let (transform, mut room) = (Transform::new(self.grid().points()), Vec::new());
        let (edges, band) = self.edges(&skin, &transform, &mut room);
        let (edges, band) = self.along_edges(&skin, &transform, &mut room, edges, band);
        let (samples, pressed) = self.highest_samples(&skin, &transform, room, &band, quantities);
        Surface { others: OTHER.map(|scale| Skin::new(self, &slice, scale)), skin, edges, samples, pressed }
    }

    /// The crest that stands at the highest place, with what `others`, the highest ones with other widths, tell of its error.
    fn crest_of(
        &self,
        surface: &Surface,
        quantity: Quantity,
        highest: Highest,
        others: impl Iterator<Item = Highest>,
    ) -> Crest {
        let Surface { skin, edges, pressed, .. } = surface;
        let value_of = |edge: &Edge| quantity.of(&edge.state);
        let Highest { kind, place, state, smoothed } = highest;
        let value = quantity.of(&state);
        // How far the stress at an edge that few samples see may reach above the largest one; at least so far at it all.
        let usual = if quantity == Quantity::Tension { TENSION * pressed } else { 0.0 };
        let spread: f64 = others.map(|other| (quantity.of(&other.state) - value).abs()).sum();
        let unlike = if kind == Kind::Edge { smoothed.abs() * skin.unlike } else { 0.0 };
        let [tx, ty] = self.traction();
        let cusp = 2.0 * tx.hypot(ty) * pressed;
        let eta = self.edge_exponent().abs();
        let few = |edge: &Edge| {
            let (own, n) = (value_of(edge), edge.resolution);
            let turned = POWER * eta * n.powf(eta - 0.5);
            own + FEW / (n * n) * usual.max(own.abs()) + (CUSP / n + turned) * cusp - value
        };
        let few = largest(edges.iter().map(few));
        let direction = state.s1_direction();
        let peak =
            Peak { value, position: [place[0], place[1], 0.0], material: 1, direction, error: None, rival: None };
        Crest { peak, uncertainty: spread + unlike + few, scale: usual.max(value.abs()) }
    }

    /// Edges beside the samples where contact ends, their stress not known yet; and row by row the samples near edges,
    /// with p̃ and its slopes.
    fn edges(&self, skin: &Skin, transform: &Transform, room: &mut Vec<f64>) -> (Vec<Edge>, Band<[f64; 3]>) {
        let (grid, regions) = (self.grid(), self.regions());
        let ([_, n2], cell, len) = (grid.points(), grid.cell(), grid.len());
        let mut fields = vec![0.0; 3 * len];
        let columns = self.series.on_plane(transform, std::mem::take(room), &skin.near);
        columns.write(&mut fields);
        *room = columns.into_room();
        let near = |index: usize| [0, 1, 2].map(|k| fields[k * len + index]);
        let found = (0..len).into_par_iter().filter(|&index| regions.touches(index)).filter_map(|index| {
            let open = grid.neighbours(index).filter(|&next| !regions.touches(next));
            let resolution = open.map(|next| regions.resolution(next)).reduce(f64::min)?.min(regions.resolution(index));
            let (mut place, mut near, mut u) = (cell.point(grid.fractions(index)), near(index), 0.0);
            for _ in 0..3 {
                (place, u) = skin.moved(place, near);
                let between = Between::new(grid.points(), cell.fractions(place));
                near = [0, 1, 2].map(|k| between.value(&fields[k * len..(k + 1) * len], n2));
            }
            (u.abs() < 0.5).then_some(Edge { place, near, resolution, state: State::default() })
        });
        let band = |i: usize| {
            let samples = (0..n2).map(|j| (j, near(i * n2 + j)));
            samples.filter(|(_, near)| skin.sees_edge(*near)).collect()
        };
        (found.collect(), (0..grid.points()[0]).into_par_iter().map(band).collect())
    }

    /// The edges with their stress, and the band with σ_xx, σ_yy, σ_xy, p as they are near edges and
    /// the part that the series itself has.
    fn along_edges(
        &self,
        skin: &Skin,
        transform: &Transform,
        room: &mut Vec<f64>,
        mut edges: Vec<Edge>,
        band: Band<[f64; 3]>,
    ) -> (Vec<Edge>, Band<Sharp>) {
        let (points, cell) = (self.grid().points(), self.grid().cell());
        // What each row adds to which edge.
        let places: Vec<Between> = edges.iter().map(|edge| Between::new(points, cell.fractions(edge.place))).collect();
        let mut beside: Vec<Vec<(usize, f64)>> = vec![Vec::new(); points[0]];
        for (number, place) in places.iter().enumerate() {
            place.rows.iter().for_each(|&(i, weight)| beside[i].push((number, weight)));
        }
        let columns = self.series.on_plane(transform, std::mem::take(room), &skin.edge);
        let read = columns.map(|i, row| {
            let at = |j: usize| row.map(|component| component[j]);
            let sharp: Vec<_> = band[i].iter().map(|&(j, near)| (j, skin.sharp(near, at(j)))).collect();
            let parts: Vec<[f64; 4]> = beside[i]
                .iter()
                .map(|&(number, weight)| row.map(|component| weight * places[number].across(component)))
                .collect();
            (sharp, parts)
        });
        *room = columns.into_room();
        let mut sums = vec![[0.0; 4]; edges.len()];
        let (mut sharp, mut rows) = (Vec::with_capacity(read.len()), beside.iter());
        for (own, parts) in read {
            for (&(number, _), part) in rows.next().into_iter().flatten().zip(parts) {
                sums[number].iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
            }
            sharp.push(own);
        }
        for (edge, sum) in edges.iter_mut().zip(sums) {
            edge.state = skin.state_on_edge(edge.near, sum);
        }
        (edges, sharp)
    }

    /// Place of the largest sample of each quantity, and the largest smoothed pressure of all.
    fn highest_samples(
        &self,
        skin: &Skin,
        transform: &Transform,
        room: Vec<f64>,
        band: &Band<Sharp>,
        quantities: &[Quantity],
    ) -> (Vec<[f64; 2]>, f64) {
        let found = LargestSoFar::new(quantities);
        let rows = self.series.on_plane(transform, room, &skin.open).map(|i, row| {
            let at = |j: usize| row.map(|component| component[j]);
            let mut states: Vec<State> = (0..row[0].len()).map(|j| skin.toward_open([0.0; 4], at(j), 1.0)).collect();
            for &(j, (sharp, part)) in &band[i] {
                states[j] = skin.toward_open(sharp, at(j), part);
            }
            (found.add(states.len(), |j| states[j]), largest(row[3].iter().copied()))
        });
        let place = |quantity: usize| {
            let (i, _) = first_largest(rows.iter().map(|(best, _)| best[quantity].1)).unwrap_or_default();
            let (j, _) = rows[i].0[quantity];
            self.grid().cell().point(self.grid().fractions(i * self.grid().points()[1] + j))
        };
        ((0..quantities.len()).map(place).collect(), largest(rows.iter().map(|&(_, pressed)| pressed)))
    }

    /// What stands at places of which some are at edges, by the exact sums.
    fn read_places(&self, skin: &Skin, places: &[(Kind, [f64; 2])]) -> Vec<Highest> {
        let of = |kind: Kind| places.iter().filter(move |(own, _)| *own == kind).map(|(_, place)| *place);
        let (open, mut edges): (Vec<_>, Vec<_>) = (of(Kind::Open).collect(), of(Kind::Edge).collect());
        for _ in 0..2 {
            let near = self.at(&edges, &skin.near);
            edges.iter_mut().zip(near).for_each(|(place, near)| *place = skin.moved(*place, near).0);
        }
        let read = |places: &[[f64; 2]]| self.at(places, &skin.near).into_iter().zip(self.at(places, &skin.edge));
        let mut on_edges = edges.iter().zip(read(&edges)).map(|(&place, (near, edge))| Highest {
            kind: Kind::Edge,
            place,
            state: skin.state_on_edge(near, edge),
            smoothed: edge[3],
        });
        let series = self.at(&open, &skin.open);
        let mut in_open = open.iter().zip(read(&open)).zip(series).map(|((&place, (near, edge)), series)| Highest {
            kind: Kind::Open,
            place,
            state: skin.state(near, edge, series),
            smoothed: edge[3],
        });
        let next = |(kind, _): &(Kind, _)| match kind {
            Kind::Open => in_open.next(),
            Kind::Edge => on_edges.next(),
        };
        places.iter().filter_map(next).collect()
    }
}

impl Surface {
    /// The highest sample and the highest edges.
    fn finalists(&self, quantity: Quantity, sample: [f64; 2]) -> Vec<(Kind, [f64; 2])> {
        let mut ordered: Vec<(f64, &Edge)> = self.edges.iter().map(|edge| (quantity.of(&edge.state), edge)).collect();
        ordered.sort_by(|a, b| b.0.total_cmp(&a.0));
        let edges = ordered.iter().take(FINALISTS).map(|(_, edge)| (Kind::Edge, edge.place));
        [(Kind::Open, sample)].into_iter().chain(edges).collect()
    }
}

impl Between {
    /// At the fractions s, t of the cell.
    fn new([n1, n2]: [usize; 2], [s, t]: [f64; 2]) -> Self {
        let around = |x: f64, n: usize| {
            let f = x - x.floor();
            let weights = [
                -f * (f - 1.0) * (f - 2.0) / 6.0,
                (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0,
                -(f + 1.0) * f * (f - 2.0) / 2.0,
                (f + 1.0) * f * (f - 1.0) / 6.0,
            ];
            let index = |k: usize| (x.floor() as i64 + k as i64 - 1).rem_euclid(n as i64) as usize;
            std::array::from_fn(|k| (index(k), weights[k]))
        };
        Self { rows: around(s * n1 as f64, n1), columns: around(t * n2 as f64, n2) }
    }

    /// What a row of a field is at the place across it.
    fn across(&self, row: &[f64]) -> f64 {
        self.columns.iter().map(|&(j, weight)| weight * row[j]).sum()
    }

    /// A field of rows of n₂ samples.
    fn value(&self, field: &[f64], n2: usize) -> f64 {
        self.rows.iter().map(|&(i, weight)| weight * self.across(&field[i * n2..(i + 1) * n2])).sum()
    }
}
