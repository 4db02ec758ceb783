//! Uses of a case by the program, the Python package and the page: [tasks](task), their [outputs](output),
//! [sweeps](sweep), [figures](picture) and [reports](report).

pub mod output;
pub mod picture;
pub mod report;
pub mod sweep;
pub mod task;
