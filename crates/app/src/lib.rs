//! What the program, the Python package and the page make of a case: [tasks](task), their [outputs](output), [sweeps](sweep),
//! [figures](picture) and [reports](report).

pub mod output;
pub mod picture;
pub mod report;
pub mod sweep;
pub mod task;
