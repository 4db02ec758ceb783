//! The outline of contact between the samples where no boundary is fitted: of merged contacts, of contacts of few samples, and of
//! those of a topography.
//!
//! Next to the edge the square of the pressure grows evenly inwards and the power 2/3 of the gap outwards. Over their own
//! slopes both are the distance from the edge,
//!
//! d = p²/|∇p²| in contact, d = −g^{2/3}/|∇g^{2/3}| outside,
//!
//! whatever the modulus. Between the samples d is interpolated; the outline is where it is zero.

use super::snapshot::Snapshot;
use super::tiling::around;
use super::window::Window;
use percoat_draw::contour::zero_lines;
use rayon::prelude::*;

/// Largest distance from the edge that is computed, in spacings.
const FAR: f64 = 1.5;
/// Largest number of intervals along a window in which an outline is searched.
const MOST_INTERVALS: f64 = 480.0;

impl Snapshot {
    /// Distance of a place from the edge of contact, a length: positive inside, negative outside; accurate near the edge.
    pub fn inside(&self, place: [f64; 2]) -> f64 {
        around(self.step.grid(), place).iter().map(|&(index, weight)| weight * self.inside_at(index)).sum()
    }

    /// Distance of a sample from the edge of contact, by its flat index.
    fn inside_at(&self, index: usize) -> f64 {
        let (grid, pressures, gaps) = (self.step.grid(), self.pressures(), self.step.finest().gaps());
        let touches = pressures[index] > 0.0;
        let value = |index: usize| match pressures[index] > 0.0 {
            true => pressures[index].powi(2),
            false => gaps[index].max(0.0).cbrt().powi(2),
        };
        let here = value(index);
        // Neighbours along a₁ and a₂, before and after.
        let [n1, n2] = grid.points();
        let (i, j) = (index / n2, index % n2);
        let pairs = [
            [((i + n1 - 1) % n1) * n2 + j, ((i + 1) % n1) * n2 + j],
            [i * n2 + (j + n2 - 1) % n2, i * n2 + (j + 1) % n2],
        ];
        let [along1, along2] = pairs.map(|[before, after]| {
            let alike = |next: usize| (pressures[next] > 0.0) == touches;
            match (alike(before), alike(after)) {
                (true, true) => 0.5 * (value(after) - value(before)),
                (true, false) => here - value(before),
                (false, true) => value(after) - here,
                // Both edges are near: half a step away.
                (false, false) => 2.0 * here,
            }
        });
        let [[x1, y1], [x2, y2]] = grid.steps();
        let determinant = x1 * y2 - y1 * x2;
        let slope = ((along1 * y2 - along2 * y1) / determinant).hypot((along2 * x1 - along1 * x2) / determinant);
        let far = FAR * grid.spacing();
        let distance = if slope > 0.0 { (here / slope).min(far) } else { far };
        if touches { distance } else { -distance }
    }

    /// Index of the site whose indenter faces a place, and the vector from its axis, lengths; `None` for a topography.
    pub fn facing(&self, place: [f64; 2]) -> Option<(usize, [f64; 2])> {
        let (cell, sites) = (self.step.grid().cell(), self.step.surface().sites());
        let (reduced, fractions) = (cell.reduced(), cell.fractions(place));
        let facing = sites.iter().enumerate().map(|(index, site)| {
            let offset = reduced.nearest([fractions[0] - site.place[0], fractions[1] - site.place[1]]);
            (index, offset, site.profile(offset[0].hypot(offset[1])))
        });
        facing.min_by(|a, b| a.2.total_cmp(&b.2)).map(|(index, offset, _)| (index, offset))
    }

    /// Whether the contact of the indenter that faces a place has no fitted boundary.
    fn is_rough(&self, place: [f64; 2]) -> bool {
        self.facing(place).is_none_or(|(site, _)| self.reading.boundaries[site].is_none())
    }

    /// Outlines within a window of all contacts without a fitted boundary.
    pub fn outlines(&self, window: Window) -> Vec<Vec<[f64; 2]>> {
        if self.reading.boundaries.iter().all(Option::is_some) {
            return Vec::new();
        }
        let lengths = window.map(|[first, last]| last - first);
        let at = |[u, v]: [f64; 2]| [window[0][0] + u * lengths[0], window[1][0] + v * lengths[1]];
        let count = |length: f64| (1.5 * length / self.step.grid().spacing()).clamp(40.0, MOST_INTERVALS) as usize;
        let counts = lengths.map(count);
        // A place takes four samples. Where the grid has fewer than all places take, each is computed once.
        let samples = self.step.grid().len();
        let once = (samples <= 4 * counts[0] * counts[1])
            .then(|| (0..samples).into_par_iter().map(|index| self.inside_at(index)).collect::<Vec<f64>>());
        let inside = |place: [f64; 2]| match &once {
            Some(all) => self.between_samples(all, place),
            None => self.inside(place),
        };
        let value = |part: [f64; 2]| self.is_rough(at(part)).then(|| inside(at(part)));
        let lines = zero_lines(counts[0], counts[1], value).into_iter();
        lines.map(|line| line.into_iter().map(at).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::{HalfSpace, Material};
    use percoat_core::counterbody::{Indenters, Level, Shape};
    use percoat_core::lattice::{Cell, Lattice};
    use percoat_core::load::Load;
    use percoat_core::problem::Problem;
    use percoat_core::spectral::{Settings, Solver};

    /// A contact far from others, in a skewed cell: the fitted boundary is known to much less than a spacing.
    #[test]
    fn the_outline_is_the_fitted_boundary_to_a_fifth_of_a_spacing() {
        let cell = Cell::new([1.0, 0.1], [0.3, 1.1]).unwrap();
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let indenters = Indenters::new(Lattice::new(cell, vec![vec![[0.5, 0.5]]]).unwrap(), vec![level]).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let mut solver = Solver::new(Problem::new(indenters, body), [64, 64], Settings::default()).unwrap();
        let step = solver.solve(Load::MeanPressure(0.01));
        let (reading, spacing) = (step.reading(), step.grid().spacing());
        let boundary = reading.boundaries[0].clone().unwrap();
        let mut snapshot = Snapshot::new("", step, reading);
        snapshot.reading.boundaries[0] = None;
        let centre = cell.point([0.5, 0.5]);
        let window = [0, 1].map(|k| [centre[k] - 0.45, centre[k] + 0.45]);
        let lines = snapshot.outlines(window);
        assert_eq!(lines.len(), 1);
        for [x, y] in &lines[0] {
            let [dx, dy] = [x - centre[0], y - centre[1]];
            let error = dx.hypot(dy) - boundary.radius(dy.atan2(dx));
            assert!(error.abs() < 0.2 * spacing, "{} of a spacing at {x} {y}", error / spacing);
        }
    }
}
