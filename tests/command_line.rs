//! `percoat` from outside: what a person types, reads and finds in the output folder.

#![cfg(feature = "cli")]
#![allow(clippy::too_many_lines, reason = "a test of refused files lists each fault beside its message")]

#[path = "command_line/archive.rs"]
mod archive;
#[path = "command_line/assumptions.rs"]
mod assumptions;
#[path = "command_line/browser.rs"]
mod browser;
#[path = "command_line/cases.rs"]
mod cases;
#[path = "command_line/compare.rs"]
mod compare;
#[path = "command_line/daily.rs"]
mod daily;
#[path = "command_line/damaged_records.rs"]
mod damaged_records;
#[path = "command_line/damaged_reports.rs"]
mod damaged_reports;
#[path = "command_line/damaged_sweeps.rs"]
mod damaged_sweeps;
#[path = "command_line/damages.rs"]
mod damages;
#[path = "command_line/exit_codes.rs"]
mod exit_codes;
#[path = "command_line/explain.rs"]
mod explain;
#[path = "command_line/folder.rs"]
mod folder;
#[path = "command_line/hardness.rs"]
mod hardness;
#[path = "command_line/hostile_folders.rs"]
mod hostile_folders;
#[path = "command_line/hostile_surfaces.rs"]
mod hostile_surfaces;
#[path = "command_line/hostile_words.rs"]
mod hostile_words;
#[path = "command_line/identify.rs"]
mod identify;
#[path = "command_line/inspection.rs"]
mod inspection;
#[path = "command_line/interruption.rs"]
mod interruption;
#[path = "command_line/life.rs"]
mod life;
#[path = "command_line/limit.rs"]
mod limit;
#[path = "command_line/materials.rs"]
mod materials;
#[path = "command_line/mortal.rs"]
mod mortal;
#[path = "command_line/numpy.rs"]
mod numpy;
#[path = "command_line/pictures.rs"]
mod pictures;
#[path = "command_line/process_limits.rs"]
mod process_limits;
#[path = "command_line/program.rs"]
mod program;
#[path = "command_line/readings.rs"]
mod readings;
#[path = "command_line/refusals.rs"]
mod refusals;
#[path = "command_line/report.rs"]
mod report;
#[path = "command_line/resume.rs"]
mod resume;
#[path = "command_line/solve.rs"]
mod solve;
#[path = "command_line/stress.rs"]
mod stress;
#[path = "command_line/sweep.rs"]
mod sweep;
#[path = "common/temporary.rs"]
mod temporary;
#[path = "command_line/topography.rs"]
mod topography;
#[path = "command_line/uncertainty.rs"]
mod uncertainty;
#[path = "command_line/units.rs"]
mod units;
#[path = "command_line/validate.rs"]
mod validate;
