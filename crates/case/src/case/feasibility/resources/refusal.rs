//! The refusal of a job that does not fit, and the largest grid on which it would.

use super::job::Job;
use super::needs;
use crate::case::{Case, identification};
use percoat_common::machine::{Capacity, bytes};
use percoat_core::numeric::fourier::fast_points;
use percoat_core::run::Sampling;

/// The largest grid of the shape of `points` on which a job fits; `None` if none does.
pub fn largest_points(case: &Case, points: [usize; 2], room: Capacity, job: Job) -> Option<[usize; 2]> {
    let most = points[0].max(points[1]);
    let shaped =
        |n: usize| points.map(|count| fast_points((count as f64 * n as f64 / most as f64).round().max(4.0) as usize));
    let fits = |n: usize| needs(case, shaped(n), job).fit(room);
    // Needs grow with the grid.
    let (mut low, mut high) = (4, 32_768);
    if !fits(low) {
        return None;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if fits(middle) { low = middle } else { high = middle }
    }
    Some(shaped(low))
}

/// Why a job on `case` does not fit, and what would; `None` if it fits. Of a refinement the first grid is checked here, later ones
/// by [`Needs::fit`](super::Needs::fit) when they are reached.
pub fn refusal(case: &Case, room: Capacity, job: Job) -> Option<String> {
    let key = if matches!(case.grid, Sampling::Accuracy(_)) { "grid.accuracy" } else { "grid.points" };
    let points = match (job, case.grid.grids(&case.problem().cell())) {
        (Job::Identify { .. }, _) => [identification::points(case); 2],
        (_, Ok(grids)) => grids[0],
        (_, Err(error)) => return Some(format!("{key}: {error}")),
    };
    let needs = needs(case, points, job);
    let what = if needs.memory > room.memory {
        format!("about {} of memory, and {} are available", bytes(needs.memory), bytes(room.memory))
    } else if needs.disk_while_running > room.disk {
        let (most, end) = (bytes(needs.disk_while_running), bytes(needs.disk));
        format!("about {most} of disk ({end} when done), and {} are free", bytes(room.disk))
    } else {
        return None;
    };
    let [n1, n2] = points;
    let advice = match largest_points(case, points, room, job) {
        Some([m1, m2]) if m1 * m2 < n1 * n2 => format!("the largest grid that fits is grid.points = [{m1}, {m2}]"),
        _ if matches!(job, Job::Compare { .. }) => "no grid fits: choose fewer localized.elements".to_owned(),
        _ if case.stress.as_ref().is_some_and(|stress| stress.volume.is_some()) => {
            "no grid fits: choose fewer rows or points in stress.volume".to_owned()
        }
        _ if needs.memory > room.memory => "no grid fits".to_owned(),
        _ => "no grid fits: choose fewer load steps, or another folder with -o".to_owned(),
    };
    Some(format!("{key}: {n1} × {n2} samples take {what}; {advice}"))
}
