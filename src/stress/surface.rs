//! Stresses on the surface itself, where the pressure ends like a square root.
//!
//! There the series of the stresses converges slowly and overshoots. But what is singular at an edge is the pressure
//! alone: with **n** normal and **t** along the edge, and ν of the surface material,
//!
//! σ_αβ = σ̂_αβ − p (n_α n_β + 2ν t_α t_β),
//!
//! where σ̂ has no square root any more. So the series is smoothed by a Gaussian, which leaves σ̂ as it is to the fourth
//! order of its width (each factor is multiplied by 1 + q²w²/2), and the smoothed pressure is put back as the sharp one
//! that [`super::edge`] finds behind it. At the edge itself the pressure is zero, and outside it stays so.
//!
//! Near an edge, the width leaves e^{−EDGE²/2} of the shortest waves of the grid, which carry its error. The steps of an
//! edge on the grid make longer waves too: the width near edges grows against the spacing, as n^{2/5} from n = 12 samples
//! along the radius of the smallest spot on. From one to three widths off the edge all this gives way to the series
//! itself, smoothed to the fourth order with e^{−OPEN²/2} of the shortest waves.

use super::edge::Edge;
use super::field::{REACH, StressField};
use super::peak::Peak;
use super::series::Response;
use super::slice::{Slice, components};
use super::tensor::State;
use super::transform::Transform;
use crate::body::Depth;
use crate::numeric::search::{first_largest, largest};

/// Width of the Gaussian near an edge, times the least wavenumber that the grid cannot hold.
const EDGE: f64 = 4.5;
/// The same away from edges.
pub(super) const OPEN: f64 = 3.0;
/// Widths that the largest tension is read with again, over the usual ones: how it changes tells its error.
const OTHER: [f64; 2] = [0.7, 1.45];
/// Places that the exact sum decides between.
const FINALISTS: usize = 8;
/// The error of a tension beside a spot or open place of n samples per radius is at least this over n² of the tension,
/// and of the usual one.
const FEW: f64 = 0.3;
/// Usual tension at an edge over the largest pressure: (1 − 2ν)/3 at Hertz' contact.
const TENSION: f64 = 0.13;
/// By how much all that makes an error uncertain is multiplied, so that nineteen of twenty hold.
const SAFETY: f64 = 1.5;
/// Where a spot of n samples per radius stands against a coarser grid: errors fall at least as n^{−1.5}, so that the
/// finer of two grids whose spacings have the ratio 2 errs by less than the change over 2^{1.5} − 1.
const FALL: f64 = 1.8;

/// p̃, ∂p̃/∂x, ∂p̃/∂y, then σ_xx, σ_yy, σ_xy, p smoothed for edges, and the same four smoothed for open places.
pub(super) type Smooth = [f64; 11];

/// The surface of a field, smoothed.
#[derive(Debug)]
pub(super) struct Skin<'a> {
    field: &'a StressField,
    slice: Slice,
    /// Per shell: the Gaussian near edges, both factors of the stresses.
    factors: Vec<[f64; 3]>,
    /// Width of the Gaussian near edges, a length.
    width: f64,
    edge: Edge,
}

/// The largest tension on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crest {
    /// Where and how large.
    pub peak: Peak,
    /// How uncertain its value is by what this grid alone tells, a pressure.
    pub uncertainty: f64,
    /// What errors are relative to: the tension itself, or the usual one under the largest pressure, 0.13 of it, where
    /// that is more (as on incompressible materials, which have no tension at the edge).
    pub scale: f64,
}

impl Crest {
    /// Estimated relative error, also from the largest tension on the surface of the next coarser grid where there is one.
    pub fn error(&self, coarser: Option<f64>) -> f64 {
        let change = coarser.map_or(0.0, |tension| (tension - self.peak.value).abs());
        SAFETY * (self.uncertainty + change / FALL) / self.scale
    }
}

impl<'a> Skin<'a> {
    /// With `scale` times the usual widths.
    pub fn new(field: &'a StressField, scale: f64) -> Self {
        let most = field.grid().least_aliased();
        let growth = (field.regions.least_resolution() / 12.0).max(1.0).powf(0.4);
        let [edge, open] = [EDGE * growth, OPEN].map(|c| scale * c / most);
        let factors = field.series.waves.wavenumbers().iter().map(|&q| {
            let gaussian = (-0.5 * q * q * edge * edge).exp();
            [gaussian, fourth(q * edge), fourth(q * open)]
        });
        let (factors, slice) = (factors.collect(), field.slice(Depth::SURFACE, REACH));
        Self { field, slice, factors, width: edge, edge: Edge::new() }
    }

    /// At a place (x, y): the sum over waves itself.
    fn at(&self, place: [f64; 2]) -> Smooth {
        self.field.at(&[place], self)[0]
    }

    /// At all samples of the grid.
    fn everywhere(&self) -> [Vec<f64>; 11] {
        let transform = Transform::new(self.field.grid().points());
        let columns = self.field.series.on_plane(&transform, self);
        let len = self.field.grid().len();
        let mut all = vec![0.0; 11 * len];
        columns.write(&mut all);
        std::array::from_fn(|c| all[c * len..(c + 1) * len].to_vec())
    }

    /// Distance from the edge over the width, positive inside, and the normal that points outward.
    fn edge_seen(&self, smooth: &Smooth) -> (f64, [f64; 2]) {
        let [p, gx, gy, ..] = *smooth;
        let slope = gx.hypot(gy);
        let normal = if slope > 0.0 { [-gx / slope, -gy / slope] } else { [1.0, 0.0] };
        (if p > 0.0 { self.edge.distance(p / (slope * self.width)) } else { self.edge.distance(0.0) }, normal)
    }

    /// A stress whose smoothed pressure `four[3]` is replaced by the pressure `p`.
    fn sharpened(&self, four: &[f64], p: f64, [nx, ny]: [f64; 2]) -> [f64; 3] {
        let twice = 2.0 * self.field.surface_poisson();
        let change = four[3] - p;
        [
            four[0] + change * (nx * nx + twice * ny * ny),
            four[1] + change * (ny * ny + twice * nx * nx),
            four[2] + change * (1.0 - twice) * nx * ny,
        ]
    }

    /// The state, its displacement left out.
    pub fn state(&self, smooth: &Smooth) -> State {
        let (u, normal) = self.edge_seen(smooth);
        let p = smooth[0] * self.edge.sharp(u);
        let near = self.sharpened(&smooth[3..7], p, normal);
        let [.., xx, yy, xy, open] = *smooth;
        // From one width to three: 0 to 1, smoothly.
        let t = (0.5 * (u.abs() - 1.0)).clamp(0.0, 1.0);
        let part = t * t * (3.0 - 2.0 * t);
        let between = |near: f64, open: f64| (1.0 - part) * near + part * open;
        let [xx, yy, xy] = [between(near[0], xx), between(near[1], yy), between(near[2], xy)];
        State { xx, yy, zz: -between(p, open), xy, ..State::default() }
    }

    /// The state at the edge, seen from a place on it.
    fn state_on_edge(&self, smooth: &Smooth) -> State {
        let (_, normal) = self.edge_seen(smooth);
        let [xx, yy, xy] = self.sharpened(&smooth[3..7], 0.0, normal);
        State { xx, yy, xy, ..State::default() }
    }

    /// The place moved to the edge beside it, by what is seen there.
    fn moved(&self, [x, y]: [f64; 2], smooth: &Smooth) -> ([f64; 2], f64) {
        let (u, [nx, ny]) = self.edge_seen(smooth);
        let step = self.width * u.clamp(-1.5, 1.5);
        ([x + step * nx, y + step * ny], u)
    }

    /// The place on the edge beside a place near it.
    fn onto_edge(&self, place: [f64; 2]) -> [f64; 2] {
        (0..2).fold(place, |place, _| self.moved(place, &self.at(place)).0)
    }

    /// The largest tension at places of which some stand at edges.
    fn largest(&self, places: &[(Kind, [f64; 2])]) -> Option<(Kind, [f64; 2], State)> {
        let read = |&(kind, place): &(Kind, [f64; 2])| match kind {
            Kind::Open => (kind, place, self.state(&self.at(place))),
            Kind::Edge => {
                let place = self.onto_edge(place);
                (kind, place, self.state_on_edge(&self.at(place)))
            }
        };
        places.iter().map(read).max_by(|(.., a), (.., b)| a.s1().total_cmp(&b.s1()))
    }

    /// How far the surface material's own response, which carries the singular part, is from the half-space's at the
    /// wavenumber 1/width, over the pressure: a coating must be thicker than the width for it.
    fn unlike(&self) -> f64 {
        let shell = self.field.series.waves.shells_up_to(1.0 / self.width).saturating_sub(1);
        let twice = 2.0 * self.field.surface_poisson();
        self.slice.amplitudes.get(shell).map_or(0.0, |at| (at.sqq + 1.0).abs().max((at.stt + twice).abs()))
    }
}

impl Response<11> for Skin<'_> {
    const ODD: [bool; 11] = [false, true, true, false, false, false, false, false, false, false, false];

    fn shells(&self) -> usize {
        self.factors.len()
    }

    fn factors(&self, q: [f64; 2], shell: usize) -> [f64; 11] {
        let [gaussian, edge, open] = self.factors[shell];
        let [xx, yy, zz, xy, ..] = components(q, &self.slice.amplitudes[shell]);
        // The slope of c e^{iq·x} is iq times it.
        let [x, y] = q;
        let p = -zz;
        [
            gaussian * p,
            -gaussian * x,
            -gaussian * y,
            edge * xx,
            edge * yy,
            edge * xy,
            edge * p,
            open * xx,
            open * yy,
            open * xy,
            open * p,
        ]
    }

    fn mean(&self) -> [f64; 11] {
        let State { xx, yy, zz, .. } = self.slice.mean;
        [-zz, 0.0, 0.0, xx, yy, 0.0, -zz, xx, yy, 0.0, -zz]
    }
}

/// A Gaussian of which qw is wavenumber times width, made to leave what is smooth as it is to the fourth order.
fn fourth(qw: f64) -> f64 {
    (1.0 + 0.5 * qw * qw) * (-0.5 * qw * qw).exp()
}

/// What stands at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Open,
    Edge,
}

impl StressField {
    /// The largest tension on the surface; `None` where there is no edge: contact is complete, or nowhere.
    pub fn crest(&self) -> Option<Crest> {
        let points = self.grid().points();
        let regions = &self.regions;
        if !regions.have_edges() {
            return None;
        }
        let skin = Skin::new(self, 1.0);
        let everywhere = skin.everywhere();
        let cell = self.grid().cell();
        let place = |index: usize| cell.point(self.grid().fractions(index));
        let at = |index: usize| -> Smooth { std::array::from_fn(|c| everywhere[c][index]) };

        // Edges beside the samples where contact ends: the tension, the place, and the resolution of the less resolved
        // of the spot and the open place beside it.
        let edges = (0..regions.of.len()).filter(|&index| regions.touches(index)).filter_map(|index| {
            let open = self.grid().neighbours(index).filter(|&next| !regions.touches(next));
            let resolution = open.map(|next| regions.resolution(next)).reduce(f64::min)?.min(regions.resolution(index));
            let (mut here, mut smooth, mut u) = (place(index), at(index), 0.0);
            for _ in 0..3 {
                (here, u) = skin.moved(here, &smooth);
                smooth = between(&everywhere, points, cell.fractions(here));
            }
            (u.abs() < 0.5).then(|| (skin.state_on_edge(&smooth).s1(), here, resolution))
        });
        let mut edges: Vec<(f64, [f64; 2], f64)> = edges.collect();
        edges.sort_by(|a, b| b.0.total_cmp(&a.0));

        let open = |index: usize| skin.state(&at(index)).s1();
        let (highest, _) = first_largest((0..regions.of.len()).map(open))?;
        let mut finalists = vec![(Kind::Open, place(highest))];
        finalists.extend(edges.iter().take(FINALISTS).map(|&(_, place, _)| (Kind::Edge, place)));
        let (kind, place, state) = skin.largest(&finalists)?;
        let value = state.s1();
        // How far the tension at an edge that few samples see may reach above the largest one; at least so far at it all.
        let usual = TENSION * largest(everywhere[10].iter().copied());
        drop(everywhere);
        let spread = OTHER.iter().filter_map(|&scale| Skin::new(self, scale).largest(&finalists));
        let spread: f64 = spread.map(|(.., other)| (other.s1() - value).abs()).sum();
        let unlike = if kind == Kind::Edge { skin.at(place)[6].abs() * skin.unlike() } else { 0.0 };
        let few = |&(tension, _, resolution): &(f64, [f64; 2], f64)| {
            tension + FEW / (resolution * resolution) * usual.max(tension.abs()) - value
        };
        let few = largest(edges.iter().map(few));
        let direction = state.s1_direction();
        let peak = Peak { value, position: [place[0], place[1], 0.0], material: 1, direction };
        Some(Crest { peak, uncertainty: spread + unlike + few, scale: usual.max(value.abs()) })
    }
}

/// The fields between the samples at the fractions s, t of the cell: cubic in each direction.
fn between(fields: &[Vec<f64>; 11], [n1, n2]: [usize; 2], [s, t]: [f64; 2]) -> Smooth {
    let weights = |x: f64| {
        let f = x - x.floor();
        [
            -f * (f - 1.0) * (f - 2.0) / 6.0,
            (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0,
            -(f + 1.0) * f * (f - 2.0) / 2.0,
            (f + 1.0) * f * (f - 1.0) / 6.0,
        ]
    };
    let (x, y) = (s * n1 as f64, t * n2 as f64);
    let (along, across) = (weights(x), weights(y));
    let index = |x: f64, k: usize, n: usize| (x.floor() as i64 + k as i64 - 1).rem_euclid(n as i64) as usize;
    let mut total = [0.0; 11];
    for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
        let sample = index(x, i, n1) * n2 + index(y, j, n2);
        total.iter_mut().zip(fields).for_each(|(total, field)| *total += along[i] * across[j] * field[sample]);
    }
    total
}
