//! The section as a whole: formats, units, cells, grids, what is made periodic, and what is refused or doubted.

use super::*;
use crate::case::section::ReadTable;
use crate::case::{Case, CaseError, Source, plausibility};
use npyz::{Order, WriterBuilder};
use std::f64::consts::TAU;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

const LATTICE: &str = "[lattice]\nkind = \"square\"\nperiod = 1\n";
const REST: &str = "[substrate]\nyoung = 1\npoisson = 0.3\n[load]\nmean_pressure = 1e-3\n";

fn write<T: npyz::AutoSerialize>(folder: &Path, shape: &[u64], order: Order, values: &[T]) {
    let file = File::create(folder.join("surface.npy")).unwrap();
    let options = npyz::WriteOptions::new().default_dtype().shape(shape).order(order);
    let mut writer = options.writer(file).begin_nd().unwrap();
    writer.extend(values).unwrap();
    writer.finish().unwrap();
}

fn source(folder: &Path, text: String) -> Source {
    Source { name: "case".to_owned(), text, folder: folder.to_owned(), ..Source::default() }
}

/// A case on a square cell of side 1 with this after `[surface]`, and the rest.
fn read(folder: &Path, surface: &str, more: &str) -> Result<Case, CaseError> {
    let lattice = if surface.contains("period") || surface.contains("pixel") { "" } else { LATTICE };
    Case::read(&source(folder, format!("{lattice}[surface]\n{surface}\n{REST}{more}")), &[])
}

const NPY: &str = "heights = \"surface.npy\"";

fn heights(case: &Case) -> Array2<f64> {
    case.problem().topography().expect("a topography").heights().to_owned()
}

fn reads_back(case: &Case) {
    let elsewhere = source(Path::new("elsewhere"), case.to_toml());
    assert_eq!(&Case::read(&elsewhere, &[]).unwrap_or_else(|error| panic!("{error}")), case, "{}", case.to_toml());
}

#[test]
fn every_type_and_order_gives_the_same_heights_with_a2_fastest() {
    let folder = tempfile::tempdir().unwrap();
    let expected = ndarray::arr2(&[[1., 2., 3.], [4., 5., 6.]]);
    let check = || {
        let case = read(folder.path(), NPY, "").unwrap();
        assert_eq!(heights(&case), expected);
        assert_eq!(case.grid, Sampling::Points([2, 3]));
        reads_back(&case);
    };
    for (order, stored) in [(Order::C, [1u8, 2, 3, 4, 5, 6]), (Order::Fortran, [1, 4, 2, 5, 3, 6])] {
        macro_rules! each {
            ($($type:ty),*) => { $(
                write(folder.path(), &[2, 3], order, &stored.map(<$type>::from));
                check();
            )* };
        }
        each!(f64, f32, u8, i16, u16, i32, u32, i64, u64);
    }
    // The other order of bytes, by hand.
    let head = "{'descr': '>i2', 'fortran_order': False, 'shape': (2, 3)}";
    let values = (1..=6i16).flat_map(i16::to_be_bytes).collect::<Vec<_>>();
    let file = [b"\x93NUMPY\x01\0", &[head.len() as u8, 0][..], head.as_bytes(), &values].concat();
    std::fs::write(folder.path().join("surface.npy"), file).unwrap();
    check();
    for (name, text) in [("a.csv", "1,2,3\n4,5,6\n"), ("a.TXT", "1 2 3\n4 5 6\n"), ("a.dat", "1;2;3\n4;5;6")] {
        std::fs::write(folder.path().join(name), text).unwrap();
        assert_eq!(heights(&read(folder.path(), &format!("heights = \"{name}\""), "").unwrap()), expected, "{name}");
    }
}

#[test]
fn the_cell_is_that_of_the_lattice_the_period_the_pixel_or_the_points() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &[2, 3], Order::C, &[0.0; 6]);
    let xyz: String = (0..6).map(|k| format!("{} {} {k}\n", 0.5 * f64::from(k / 3), 0.25 * f64::from(k % 3))).collect();
    std::fs::write(folder.path().join("surface.xyz"), &xyz).unwrap();
    let vectors = |surface: &str| {
        let text = format!("[surface]\n{surface}\n{REST}");
        let case = Case::read(&source(folder.path(), text), &[]).unwrap_or_else(|error| panic!("{error}"));
        reads_back(&case);
        case.problem().cell().vectors()
    };
    assert_eq!(vectors(&format!("{NPY}\nperiod = 4")), [[4.0, 0.0], [0.0, 4.0]]);
    assert_eq!(vectors(&format!("{NPY}\nperiod = [4, 3]")), [[4.0, 0.0], [0.0, 3.0]]);
    assert_eq!(vectors(&format!("{NPY}\npixel = 0.5")), [[1.0, 0.0], [0.0, 1.5]]);
    assert_eq!(vectors(&format!("{NPY}\npixel = [0.5, 1]")), [[1.0, 0.0], [0.0, 3.0]]);
    assert_eq!(vectors("heights = \"surface.xyz\""), [[1.0, 0.0], [0.0, 0.75]]);
    assert_eq!(vectors("heights = \"surface.xyz\"\nperiod = 2"), [[2.0, 0.0], [0.0, 2.0]]);
    let fault = |lattice: &str, surface: &str| {
        let text = format!("{lattice}[surface]\n{NPY}\n{surface}\n{REST}");
        Case::read(&source(folder.path(), text), &[]).unwrap_err().to_string()
    };
    assert!(fault("", "").contains("`surface.period` is missing, and so is [lattice]"));
    assert!(fault("", "period = 1\npixel = 1").contains("exclude each other"));
    assert!(fault(LATTICE, "pixel = 1").contains("`surface.pixel` and [lattice] exclude each other"));
    assert!(fault("", "period = [1, 0]").contains("period[1]"));
}

#[test]
fn heights_are_scaled_and_a_unit_needs_that_of_the_case() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &[2, 2], Order::C, &[0, 1, 2, 3]);
    let case = read(folder.path(), &format!("{NPY}\nscale = -0.5"), "").unwrap();
    assert_eq!(heights(&case), ndarray::arr2(&[[0.0, -0.5], [-1.0, -1.5]]));
    reads_back(&case);
    let fault = |surface: &str| read(folder.path(), &format!("{NPY}\n{surface}"), "").unwrap_err().to_string();
    assert!(fault("unit = \"nm\"").contains("[units] with length = \"µm\""), "{}", fault("unit = \"nm\""));
    assert!(fault("scale = 0").contains("other than 0"));
    assert!(fault("window = \"boxcar\"").contains("\"hann\" or \"tukey\""));
}

/// Heights of a section with the unit of the case.
#[test]
fn a_unit_becomes_part_of_the_scale() {
    let node = |text: &str| super::super::node::Table::parse(text).unwrap();
    let of = |text: &str, length: Option<&str>| {
        let table = node(text);
        let end = super::super::span::Span::new(0, 0..0);
        let section = TableAt::root(&table, super::super::model::CASE.within("surface"), end);
        Treatment::of(&SurfaceSection::read_table(&section)?, &section, length)
            .map(|treatment| (treatment.scale, treatment.unit))
    };
    assert_eq!(of("unit = \"nm\"\nscale = 2", Some("µm")), Ok((2e-3, 1e-3)));
    assert_eq!(of("unit = \"µm\"", Some("um")), Ok((1.0, 1.0)));
    assert_eq!(of("scale = 3", Some("furlong")), Ok((3.0, 1.0)));
    assert!(of("unit = \"furlong\"", Some("m")).is_err() && of("unit = \"m\"", Some("l")).is_err());
}

fn wave(n1: usize, n2: usize) -> Vec<f64> {
    let part = |k: usize, n: usize| k as f64 / n as f64;
    (0..n1 * n2).map(|k| 1e-2 * (TAU * (2.0 * part(k / n2, n1) + part(k % n2, n2))).cos()).collect()
}

#[test]
fn the_grid_is_that_of_the_file_or_the_same_surface_on_another() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &[11, 13], Order::C, &wave(11, 13));
    assert_eq!(read(folder.path(), NPY, "").unwrap().grid, Sampling::Points([11, 13]));
    assert!(read(folder.path(), NPY, "[grid]\npoints = [11, 13]\n").is_ok());
    let case = read(folder.path(), NPY, "[grid]\npoints = [24, 16]\n").unwrap();
    let expected = percoat_core::numeric::array::field([24, 16], wave(24, 16));
    assert!((&heights(&case) - &expected).iter().all(|d| d.abs() < 1e-15) && plausibility::of_case(&case).is_empty());
    let told = read(folder.path(), NPY, "[grid]\npoints = [11, 12]\n").unwrap_err().to_string();
    assert!(told.contains("factors 2, 3, 5 and 7"), "{told}");
    let fine = read(folder.path(), NPY, "[grid]\naccuracy = 0.01\n").unwrap();
    assert_eq!((fine.grid, heights(&fine).dim()), (Sampling::Accuracy(0.01), (11, 13)));
    reads_back(&fine);
}

#[test]
fn a_grid_that_cannot_hold_the_slope_is_doubted() {
    let folder = tempfile::tempdir().unwrap();
    let fine: Vec<f64> = (0..256).map(|k| 1e-3 * (TAU * 5.0 * (k / 16) as f64 / 16.0).cos()).collect();
    write(folder.path(), &[16, 16], Order::C, &fine);
    let doubts = |points: usize| {
        let case = read(folder.path(), NPY, &format!("[grid]\npoints = {points}\n")).unwrap();
        plausibility::of_case(&case).join("\n")
    };
    assert!(doubts(12).is_empty(), "{}", doubts(12));
    // Heights that alternate from sample to sample are there on a finer grid too.
    let alternating: Vec<f64> = (0..256).map(|k| if k / 16 % 2 == 0 { 1e-3 } else { -1e-3 }).collect();
    write(folder.path(), &[16, 16], Order::C, &alternating);
    assert!(doubts(48).is_empty(), "{}", doubts(48));
    write(folder.path(), &[16, 16], Order::C, &fine);
    assert!(doubts(8).contains("of the surface's 0.022214"), "{}", doubts(8));
}

#[test]
fn what_is_not_periodic_is_doubted_until_it_is_made_so() {
    let folder = tempfile::tempdir().unwrap();
    let tilted: Vec<f64> = wave(24, 24).into_iter().zip(0..).map(|(h, k)| h + 0.01 * f64::from(k / 24)).collect();
    write(folder.path(), &[24, 24], Order::C, &tilted);
    let of = |more: &str| {
        let case = read(folder.path(), &format!("{NPY}\n{more}"), "").unwrap_or_else(|error| panic!("{error}"));
        reads_back(&case);
        (heights(&case), plausibility::of_case(&case).join("\n"))
    };
    let (_, doubt) = of("");
    assert!(doubt.contains("along a₁ heights jump by") && doubt.contains("surface.level = true"), "{doubt}");
    let (level, doubt) = of("level = true");
    assert!(doubt.is_empty(), "{doubt}");
    // The wave itself has no mean slope along a₂, and a little along a₁.
    assert!(level.iter().zip(wave(24, 24)).all(|(h, w)| (h - w).abs() < 2e-3));
    let lowest = level.iter().copied().fold(f64::INFINITY, f64::min);
    for window in ["true", "\"tukey\"", "\"hann\""] {
        let (tapered, doubt) = of(&format!("level = true\nwindow = {window}"));
        assert!(doubt.is_empty() && tapered[[0, 0]] < lowest && tapered[[23, 12]] < lowest, "{window}");
    }
    assert_eq!(of("window = true").0, of("window = \"tukey\"").0);
    assert_eq!(of("window = false").0, of("").0);
}

#[test]
fn files_of_other_contents_are_refused_with_what_they_hold() {
    let folder = tempfile::tempdir().unwrap();
    let fault = || read(folder.path(), NPY, "").unwrap_err().to_string();
    let head = "{'descr': '<c8', 'fortran_order': False, 'shape': (2, 2)}";
    let file = [b"\x93NUMPY\x01\0", &[head.len() as u8, 0][..], head.as_bytes(), &[0; 32]].concat();
    std::fs::write(folder.path().join("surface.npy"), file).unwrap();
    assert!(fault().contains("values of type '<c8'") && fault().contains("float32"), "{}", fault());
    write(folder.path(), &[4], Order::C, &[0.0; 4]);
    assert!(fault().contains("shape (4)"), "{}", fault());
    write(folder.path(), &[1, 4], Order::C, &[0.0; 4]);
    assert!(fault().contains("shape (1, 4)"), "{}", fault());
    write(folder.path(), &[2, 2], Order::C, &[0.0, 1.0, f64::INFINITY, 3.0]);
    assert!(fault().contains("holds inf at [1, 0]"), "{}", fault());
    write(folder.path(), &[2, 2], Order::C, &[f64::NAN; 4]);
    assert!(fault().contains("no measurement at any place"), "{}", fault());
    write(folder.path(), &[20, 20], Order::C, &[0.0; 400]);
    let whole = std::fs::read(folder.path().join("surface.npy")).unwrap();
    std::fs::write(folder.path().join("surface.npy"), &whole[..whole.len() - 9]).unwrap();
    assert!(fault().contains("ends before its 20 × 20 values"), "{}", fault());
    std::fs::write(folder.path().join("surface.csv"), "1,2\n3,x\n").unwrap();
    let told = read(folder.path(), "heights = \"surface.csv\"", "").unwrap_err().to_string();
    assert!(told.contains("surface.csv line 2 holds what is no number as number 2"), "{told}");
    std::fs::write(folder.path().join("surface.png"), "").unwrap();
    let told = read(folder.path(), "heights = \"surface.png\"", "").unwrap_err().to_string();
    assert!(told.contains("no format is known") && told.contains("`.npy`") && told.contains("`.xyz`"), "{told}");
}

const RANDOM: &str = "[surface.random]\nhurst = 0.8\nshortest = 0.125\nrms_slope = 0.1";

fn random(more: &str, grid: &str) -> Result<Case, CaseError> {
    let text = format!("{LATTICE}{RANDOM}\n{more}\n{REST}{grid}");
    Case::read(&source(Path::new("nowhere"), text), &[])
}

#[test]
fn a_random_surface_needs_no_file_and_is_the_same_on_every_grid_that_holds_it() {
    let case = random("", "[grid]\npoints = 24\n").unwrap();
    let section = *case.surface.as_ref().and_then(SurfaceSection::random).unwrap();
    assert_eq!(
        (section.longest, section.rolloff, section.seed, section.rms_slope),
        (Some(1.0), Some(1.0), 0, Some(0.1))
    );
    reads_back(&case);
    let finer = random("", "[grid]\npoints = 48\n").unwrap();
    let (coarse, fine) = (heights(&case), heights(&finer));
    assert!(coarse.indexed_iter().all(|((i, j), h)| (h - fine[[2 * i, 2 * j]]).abs() < 1e-15));
    assert_ne!(heights(&random("seed = 1", "[grid]\npoints = 24\n").unwrap()), coarse);
    assert!(plausibility::of_case(&case).is_empty());
    let doubts = plausibility::of_case(&random("", "[grid]\npoints = 8\n").unwrap()).join("\n");
    assert!(doubts.contains("of the surface's 0.10000"), "{doubts}");
    let refined = random("", "[grid]\naccuracy = 0.01\n").unwrap();
    assert_eq!(heights(&refined).dim(), (18, 18), "more than twice the eight shortest waves, with fast factors");
}

#[test]
fn what_is_no_random_surface_is_refused() {
    let fault = |more: &str, grid: &str| random(more, grid).unwrap_err().to_string();
    assert!(fault("rolloff = 2", "").contains("must hold of the wavelengths"));
    assert!(fault("rms_height = 1", "").contains("exclude each other"));
    assert!(fault("longest = 0.2\nrolloff = 0.2\nseed = -1", "").contains("seed"));
    let large = RANDOM.replace("0.125", "3\nlongest = 4");
    let text = format!("{LATTICE}{large}\n{REST}");
    let told = Case::read(&source(Path::new("."), text), &[]).unwrap_err().to_string();
    assert!(
        told.contains("no wave that the cell holds is between the wavelengths 3 and 4: its longest one is 1"),
        "{told}"
    );
    let text = format!("{LATTICE}[surface]\nlevel = true\n{RANDOM}\n{REST}");
    let told = Case::read(&source(Path::new("."), text), &[]).unwrap_err().to_string();
    assert!(told.contains("`surface.level` has no place beside `surface.random`"), "{told}");
    let text = format!("{LATTICE}[surface]\n{NPY}\n{RANDOM}\n{REST}");
    let told = Case::read(&source(Path::new("."), text), &[]).unwrap_err().to_string();
    assert!(told.contains("exclude each other"), "{told}");
}

/// A file in memory is read as one on disk, comes before it, and keeps its name.
#[test]
fn a_file_in_memory_is_read_as_one_on_disk() {
    let folder = tempfile::tempdir().unwrap();
    let heights: Vec<f64> = (0..48).map(|k| (0.3 * f64::from(k)).sin()).collect();
    write(folder.path(), &[6, 8], Order::C, &heights);
    let text = format!("surface = {{ heights = \"surface.npy\", scale = 2, level = true }}\n{LATTICE}{REST}");
    let on_disk = Case::read(&source(folder.path(), text.clone()), &[]).unwrap();
    let bytes = std::fs::read(folder.path().join("surface.npy")).unwrap();
    let nowhere =
        Source { files: [("surface.npy".to_owned(), bytes.into())].into(), ..source(Path::new("nowhere"), text) };
    let in_memory = Case::read(&nowhere, &[]).unwrap();
    let heights = |case: &Case| case.problem().topography().unwrap().heights().to_owned();
    assert_eq!(heights(&in_memory), heights(&on_disk));
    assert!(in_memory.to_toml().contains("heights = \"surface.npy\""), "{}", in_memory.to_toml());
    let again = Case::read(&Source { text: in_memory.to_toml(), ..nowhere.clone() }, &[]).unwrap();
    assert_eq!(again, in_memory);

    let other = Source { files: [("other.npy".to_owned(), Arc::from([0; 4]))].into(), ..nowhere };
    assert!(Case::read(&other, &[]).unwrap_err().to_string().contains("cannot read"));
}

/// A header's image stands upright: x along its lines, the last line at the bottom; its sides make the cell.
#[test]
fn a_file_with_a_header_is_the_image_that_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let line = |i: usize| (0..4).map(|j| format!("{:.5e}", 1e-6 * (10 * i + j) as f64)).collect::<Vec<_>>().join("\t");
    let image: String = (0..3).map(|i| line(i) + "\n").collect();
    let text = format!("# Channel: Z\n# Width: 8 µm\n# Height: 3000 nm\n# Value units: m\n{image}");
    std::fs::write(folder.path().join("a.txt"), text).unwrap();
    let of = |more: &str| {
        let text = format!("[units]\nlength = \"µm\"\n[surface]\nheights = \"a.txt\"\n{more}\n{REST}");
        let case = Case::read(&source(folder.path(), text), &[]).unwrap_or_else(|error| panic!("{error}"));
        reads_back(&case);
        case
    };
    let case = of("");
    let expected = Array2::from_shape_fn((4, 3), |(i, j)| (10 * (2 - j) + i) as f64);
    assert!((heights(&case) - expected).iter().all(|d| d.abs() < 1e-4));
    assert_eq!(case.problem().cell().vectors(), [[8.0, 0.0], [0.0, 3.0]]);
    assert!(case.to_toml().contains("unit = \"m\""), "{}", case.to_toml());
    let turned = of("unit = \"m\"\nscale = -2");
    assert_eq!(heights(&turned), heights(&case) * -2.0);
}

/// Points in a text are points: x along a₁, with a period of their own.
#[test]
fn points_in_a_text_are_read_as_points() {
    let folder = tempfile::tempdir().unwrap();
    let points: String =
        (0..20).map(|k| format!("{} {} {k}\n", 0.5 * f64::from(k % 5), 0.25 * f64::from(k / 5))).collect();
    for name in ["a.txt", "a.csv", "a.dat", "a.xyz"] {
        std::fs::write(folder.path().join(name), &points).unwrap();
        let text = format!("[surface]\nheights = \"{name}\"\n{REST}");
        let case = Case::read(&source(folder.path(), text), &[]).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(heights(&case), Array2::from_shape_fn((5, 4), |(i, j)| (5 * j + i) as f64), "{name}");
        assert_eq!(case.problem().cell().vectors(), [[2.5, 0.0], [0.0, 1.0]], "{name}");
    }
}
