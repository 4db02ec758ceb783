//! Bytes that the parts of a computation take.
//!
//! The figures are peaks of the resident memory, measured from 64 to 1024 points with and without stresses, volumes and
//! pictures (`tests/command_line/refusals.rs` measures two of them again).

use percoat_core::stress::StrainState;

pub(super) const MEBIBYTE: u64 = 1 << 20;
/// The program before it solves anything, mostly its mapped code: of a build for tests, which is the largest.
pub(super) const PROGRAM: u64 = 31 * MEBIBYTE / 2;
/// Bytes of each thread: its stack and what the allocator keeps for it.
pub(super) const THREAD: u64 = MEBIBYTE / 2;
/// Per sample: reading a step, after the memory of solving it is freed.
pub(super) const READING: u64 = 20;
/// Per sample, in place of [`READING`]: waves, their coefficients and the search for maxima, and the plane that is written.
pub(super) const STRESS: u64 = 92;
pub(super) const PLANE: u64 = 36;
/// Per sample, below a load that moves: parts of the operator, fields of the splitting, and the directions of its trials; and in stresses the
/// complex coefficients of the waves in each material, and their amplitudes at a depth.
pub(super) const MOTION: u64 = 260;
pub(super) const PASSED: u64 = 80;
pub(super) const LAGS: u64 = 200;
/// Per sample and material, with stresses in a body that heat enters and expands: thermal stresses of its shells.
pub(super) const HEATED: u64 = 190;
/// Per sample, in bodies that creep: shells, gaps and the pressures kept; and for each mode of retardation its amplitudes, three times over, and
/// its share of the shells.
pub(super) const CREEP: u64 = 200;
pub(super) const CREEP_MODE: u64 = 64;
/// Code and buffers of stresses.
pub(super) const STRESSES: u64 = 2 * MEBIBYTE;
/// Per sample: memory of the stresses of earlier steps that the allocator keeps, in a path and in a search for a limit; and
/// coefficients of pressure and traction where no two waves share theirs.
pub(super) const AGAIN: u64 = 72;
pub(super) const SEARCH: u64 = 110;
pub(super) const SHELLS: u64 = 50;
/// Mean number of waves of one wavenumber on square and hexagonal cells, conjugates not counted, at least.
pub(super) const SYMMETRIC: f64 = 4.5;
/// Per sample: a stress field that is evaluated at single points only.
pub(super) const FIELD: u64 = 18;
/// Fields of each spot that the localized method keeps.
pub(super) const SPOT_FIELDS: u64 = 24;
/// Per sample: the solved problem while pictures are drawn.
pub(super) const KEPT: u64 = 64;
/// Per point of a volume: the states of all its planes, kept until they are written.
pub(super) const STATE: u64 = 72;
/// Numbers stored for a place of a stress field in `stress.npz`, those of strains, and numbers for a point of a VTK file.
pub(super) const COMPONENTS: u64 = 12;
pub(super) const STRAINS: u64 = StrainState::NAMES.len() as u64;
pub(super) const VTK_NUMBERS: u64 = 16;
/// Sheets of paper as pixels, several at a time: maps and profiles, cuts, load curves.
pub(super) const MAPS: u64 = 23 * MEBIBYTE;
pub(super) const CUTS: u64 = 19 * MEBIBYTE;
pub(super) const CURVES: u64 = 14 * MEBIBYTE;
pub(super) const COMPARED: u64 = 16 * MEBIBYTE;
/// `compare.json` with many levels and circles.
pub(super) const COMPARISON: u64 = MEBIBYTE;
/// Per sample: checkpoints, pressure and gap of all nested grids, twice while one replaces another.
pub(super) const CHECKPOINTS: u64 = 43;
/// Per sample: a step that stays in memory, pressure and gap of all nested grids and the displacement.
pub(super) const STEP: u64 = 31;
/// Per sample: a step at a limit that is shown, pressure and gap of its grids.
pub(super) const SHOWN: u64 = 21;
/// Per sample: a step, its tangent, and problems at other values in its window.
pub(super) const TANGENT: u64 = 84;
/// Per sample, with hardness: the surface before it is pressed in, depths and their readings; and depths in files.
pub(super) const INDENTED: u64 = 48;
pub(super) const DEPTHS: u64 = 8;
/// Per sample: depths worn off both surfaces, of a state and of the one before, and in a file.
pub(super) const WORN: u64 = 64;
/// Per sample: its position and level.
pub(super) const PLACES: u64 = 20;
/// A picture on disk, in both formats.
pub(super) const PICTURE: u64 = 3 * MEBIBYTE / 10;
/// A line of the damage of a material: 2048 nodes in two states and as text; and as text alone.
pub(super) const DAMAGE: [u64; 2] = [80 << 10, 40 << 10];
/// Most of these lines.
pub(super) const DAMAGE_LINES: u64 = 512;
/// Per sample, with partial slip: operators, tractions and histories of the grid, once more in half as many parts, and on the next coarser one;
/// 830 to 870 were measured; and its fields in files.
pub(super) const SLIP: u64 = 950;
pub(super) const SLIP_FIELDS: u64 = 40;
/// Per sample of the cell, or of the torus around a window, of surfaces that adhere: the last three states of a path and those that are
/// tried, working fields and operators, on both grids; and the tension in files.
pub(super) const ADHESION: u64 = 300;
pub(super) const TENSION: u64 = 8;
/// Per sample of the stresses and step, where something tires in a cycle of partial slip: the step, and its stress fields on both grids.
pub(super) const MOMENT: u64 = 150;
