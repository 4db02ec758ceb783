//! `histograms.csv`: distributions of pressure, gap and spot areas of every load step.

use percoat_core::run::StepRecord;
use std::fmt::Write;

/// The content of `histograms.csv`, one row an interval: step, quantity, ends, count, and density: part of the whole per unit of it.
/// Pressures are counted over the samples in contact and gaps over the others, relative to all samples; areas over spots. Of an isolated
/// contact pressures are relative to the samples in contact, and gaps left out. `None` for indenters.
pub fn histograms(steps: &[StepRecord]) -> Option<String> {
    let mut text = "step,quantity,from,to,count,density\n".to_owned();
    for (number, step) in (1..).zip(steps) {
        for histogram in &step.rough.as_ref()?.histograms {
            let intervals = histogram.ends.windows(2).zip(&histogram.counts).zip(histogram.densities());
            for ((ends, count), density) in intervals {
                let (quantity, [from, to]) = (&histogram.quantity, [ends[0], ends[1]]);
                // Writing into a String cannot fail.
                let _ = writeln!(text, "{number},{quantity},{from:e},{to:e},{count},{density:e}");
            }
        }
    }
    Some(text)
}
