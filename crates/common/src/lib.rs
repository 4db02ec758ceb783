//! Tools that the crates of percoat around its numerical core share: [plain text](plain) and its [encoding], [units](mod@unit) with their prefixes, [numbers
//! with a unit](measure), and the memory, disk and threads of the [machine]. No physics, no files.

pub mod encoding;
pub mod machine;
pub mod measure;
pub mod plain;
pub mod unit;
