//! Files of heights that are something else, and good ones as instruments and programs write them: none is read wrongly without a word,
//! and none of the good ones is refused or doubted.

use crate::program::{Answer, Desk};
use percoat::case::{Case, Source};
use percoat::machine::Capacity;
use percoat::output::Check;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::sync::Arc;

/// Fate of a file.
#[derive(Debug, Clone, Copy)]
enum Fate {
    /// Exit code 2 with these words.
    Refused(&'static [&'static str]),
    /// Read, with a warning of these words.
    Told(&'static [&'static str]),
    /// Read without a warning, with this rms height.
    Read(f64),
}
use Fate::{Read, Refused, Told};

const REST: &str = "[substrate]\nyoung = 1\npoisson = 0.3\n[load]\nmean_pressure = 1e-3\n[grid]\npoints = 16\n";
const PERIOD: &str = "period = 64";

/// A case with a file of heights and these further lines of `[surface]`.
fn case(name: &str, surface: &str, more: &str) -> String {
    format!("{more}\n[surface]\nheights = \"{name}\"\n{surface}\n{REST}")
}

/// `percoat check` on such a case.
fn check(name: &str, content: impl AsRef<[u8]>) -> Answer {
    let desk = Desk::new();
    desk.write(name, content);
    desk.write("case.toml", case(name, PERIOD, ""));
    desk.percoat(&["check", "case.toml"])
}

/// The same without the program, with file and case in memory.
fn look(name: &str, content: impl AsRef<[u8]>, surface: &str, more: &str) -> Answer {
    let files = [(name.to_owned(), Arc::from(content.as_ref()))].into();
    let source = Source { text: case(name, surface, more), files, ..Source::default() };
    let room = Capacity { memory: u64::MAX, disk: u64::MAX };
    let case = Case::read(&source, &[]).map_err(|error| error.to_string());
    match case.and_then(|case| Check::of(&case, "case", room).map_err(|error| error.to_string())) {
        Ok(check) => {
            let err = check.warnings.iter().map(|doubt| format!("warning: {doubt}\n")).collect();
            Answer { code: 0, out: check.to_string(), err }
        }
        Err(err) => Answer { code: 2, out: String::new(), err },
    }
}

fn meets(answer: &Answer, fate: Fate, name: &str) {
    let Answer { code, out, err } = answer;
    let has = |text: &str, words: &[&str]| words.iter().all(|word| text.contains(word));
    let fits = match fate {
        Refused(words) => *code == 2 && has(err, words),
        Told(words) => *code == 0 && has(err, words),
        Read(rms) => *code == 0 && !err.contains("warning") && (rms_height(out) / rms - 1.0).abs() < 1e-3,
    };
    assert!(fits, "{name}: {fate:?}, but {code}\n{err}\n{out}");
}

/// The rms height that `check` prints.
fn rms_height(out: &str) -> f64 {
    let rest = out.split("rms height ").nth(1).unwrap_or_default();
    let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c))).unwrap_or(rest.len());
    rest[..end].parse().unwrap_or(f64::NAN)
}

/// A rough periodic surface of 16 × 16, heights to about 2.
fn height(i: usize, j: usize) -> f64 {
    let (s, t) = (TAU * i as f64 / 16.0, TAU * j as f64 / 16.0);
    (s + 0.4).sin() + 0.7 * (t + 1.1).cos() + 0.3 * (3.0 * s - 2.0 * t).sin() + 0.2 * (5.0 * s + 4.0 * t).cos()
}

/// A matrix as text: each number by `text`, parted by `mark`.
fn matrix([n1, n2]: [usize; 2], mark: &str, text: impl Fn(usize, usize) -> String) -> String {
    (0..n1).map(|i| (0..n2).map(|j| text(i, j)).collect::<Vec<_>>().join(mark) + "\n").collect()
}

fn plain(scale: f64, mark: &str) -> String {
    matrix([16, 16], mark, |i, j| format!("{:.5e}", scale * height(i, j)))
}

fn points(mark: &str, spacing: f64, scale: f64) -> String {
    let line = |k: usize| {
        let (x, y) = (spacing * (k % 16) as f64, spacing * (k / 16) as f64);
        format!("{x:.6e}{mark}{y:.6e}{mark}{:.5e}\n", scale * height(k % 16, k / 16))
    };
    (0..256).map(line).collect()
}

#[test]
fn files_that_hold_something_else_are_refused_or_told() {
    let decimal = |digits: usize, offset: f64| {
        matrix([16, 16], ",", |i, j| format!("{:.digits$}", offset + height(i, j)).replace('.', ","))
    };
    let with = |change: &dyn Fn(usize, usize) -> Option<&'static str>| {
        matrix([16, 16], " ", |i, j| change(i, j).map_or(format!("{:.4}", height(i, j)), str::to_owned))
    };
    let axes = matrix([17, 17], ",", |i, j| match (i, j) {
        (0, j) => format!("{}", 2 * j),
        (i, 0) => format!("{:.2}", 0.31 * i as f64),
        (i, j) => format!("{:.4}", height(i - 1, j - 1)),
    });
    let rows = matrix([16, 17], "\t", |i, j| match j {
        0 => format!("{:.3}", 0.019_53 * i as f64),
        j => format!("{:.4}", height(i, j - 1)),
    });
    let four = points(" ", 1.0, 1.0).lines().fold(String::new(), |text, line| text + line + " 7\n");
    let gaps = points(" ", 1.0, 1.0)
        .lines()
        .enumerate()
        .filter(|(k, _)| k % 50 != 3)
        .fold(String::new(), |text, (_, line)| text + line + "\n");
    let scattered = (0..200_u64).fold(String::new(), |mut text, k| {
        let at = |m: u64| (k * m % 997) as f64 / 10.0;
        writeln!(text, "{} {} {}", at(7_919), at(104_729), at(1_299_709) / 50.0).unwrap();
        text
    });
    let interleaved = matrix([16, 32], ",", |i, j| {
        if j.is_multiple_of(2) { format!("{:.0}", 9.0 * height(i, j / 2)) } else { "0".to_owned() }
    });
    let twice = format!("{0}\n{0}", plain(1.0, "\t"));
    let profile = |mark: &str, line: fn(f64, f64) -> Vec<f64>| {
        let of = |k: usize| line(k as f64, height(k, 3)).iter().map(f64::to_string).collect::<Vec<_>>().join(mark);
        (0..132).map(|k| of(k) + "\n").collect::<String>()
    };
    let columns = [profile(" ", |x, _| vec![x]), profile(" ", |_, z| vec![z])];
    let in_two_lines = columns.map(|column| column.replace('\n', " ") + "\n").concat();
    for (name, file, content, fate) in [
        ("one decimal, commas", "a.csv", decimal(1, 0.0), Told(&["16 lines of 32", "decimal commas, 16 × 16?"][..])),
        ("one decimal of large ones", "a.csv", decimal(1, 250.0), Told(&["decimal commas, 16 × 16?"])),
        (
            "three decimals, commas",
            "a.csv",
            decimal(3, 0.0),
            Refused(&["16 lines of 32", "decimal commas, 16 × 16?", "semicolons"]),
        ),
        ("six decimals in .txt", "a.txt", decimal(6, 100.0), Refused(&["decimal comma"])),
        (
            "decimal commas of a power",
            "a.csv",
            matrix([16, 16], ",", |i, j| format!("{:.3e}", height(i, j)).replace('.', ",")),
            Refused(&["decimal comma"]),
        ),
        ("whole numbers and zeros", "a.csv", interleaved, Told(&["every second number along a₂ is 0"])),
        (
            "thousands between commas",
            "a.csv",
            matrix([16, 16], ",", |i, j| format!("{},{:03}.5", 5 + i % 3, (100.0 * (height(i, j) + 3.0)).round())),
            Refused(&["16 lines of 32 numbers", "commas between thousands, 16 × 16?"]),
        ),
        (
            "thousands or decimal commas",
            "a.txt",
            matrix([16, 16], "\t", |i, j| format!("{},{:03}", 5 + i % 3, (100.0 * (height(i, j) + 3.0)).round())),
            Told(&["three digits behind its comma", "thousands?"]),
        ),
        (
            "some numbers whole",
            "a.csv",
            matrix([16, 16], ",", |i, j| {
                if i == 3 && j == 3 { "2".to_owned() } else { format!("{:.3}", height(i, j)).replace('.', ",") }
            }),
            Refused(&["line 4 holds 31 numbers", "decimal ones"]),
        ),
        ("a first column of coordinates", "a.txt", rows.clone(), Told(&["heights[:, 0] rise evenly", "coordinates"])),
        (
            "coordinates along both sides",
            "a.csv",
            axes,
            Told(&["heights[:, 0] rise evenly", "heights[0, :] rise evenly"]),
        ),
        (
            "an index from pandas",
            "a.csv",
            matrix([16, 17], ",", |i, j| if j == 0 { i.to_string() } else { format!("{}", height(i, j - 1)) }),
            Told(&["heights[:, 0]"]),
        ),
        (
            "-9999 in a corner",
            "a.txt",
            with(&|i, j| (i + j == 0).then_some("-9999")),
            Refused(&["-9999.0 at 1 of 256 places, the first at [0, 0]", "fill"]),
        ),
        (
            "-9999.0 at a third",
            "a.txt",
            with(&|i, j| ((i + j) % 3 == 1).then_some("-9999.0")),
            Refused(&["-9999.0 at 85 of 256"]),
        ),
        ("32767", "a.dat", with(&|i, _| (i == 4).then_some("32767")), Refused(&["no data"])),
        ("1.70141E+38", "a.dat", with(&|i, _| (i == 4).then_some("1.70141E+38")), Refused(&["16 of 256"])),
        ("-3.4028235e38", "a.dat", with(&|i, j| (i == 4 && j > 7).then_some("-3.4028235e38")), Refused(&["8 of 256"])),
        ("1e10", "a.dat", with(&|i, j| (i == 4 && j == 7).then_some("1e10")), Refused(&["[4, 7]"])),
        (
            "NaN",
            "a.txt",
            with(&|i, j| (i == 4 && j == 7).then_some("NaN")),
            Told(&["1 of 256 places (0.39062 %) have no measurement"]),
        ),
        ("infinity", "a.txt", with(&|i, j| (i == 4 && j == 7).then_some("inf")), Refused(&["inf at [4, 7]"])),
        (
            "BAD",
            "a.txt",
            with(&|i, j| (i == 4 && j == 7).then_some("BAD")),
            Refused(&["line 5 holds what is no number as number 8"]),
        ),
        (
            "zeros where nothing was measured",
            "a.txt",
            matrix([16, 16], " ", |i, j| if i == j { "0".to_owned() } else { format!("{:.4}", 80.0 + height(i, j)) }),
            Told(&["the same height occurs at 16 of 256"]),
        ),
        (
            "a spike",
            "a.txt",
            with(&|i, j| (i == 4 && j == 7).then_some("512.5")),
            Told(&["[4, 7] lies", "standard deviations"]),
        ),
        ("points with holes", "a.txt", gaps, Refused(&["6 of 16 × 16 points are missing"])),
        ("points with a quality", "a.txt", four, Refused(&["16 × 16 grid", "keep x, y and z"])),
        ("points anywhere", "a.txt", scattered.clone(), Told(&["200 lines of three numbers", "points x y z?"])),
        ("points anywhere, said", "a.xyz", scattered, Refused(&["is off the grid"])),
        (
            "two images by headers",
            "a.txt",
            format!("# Channel: a\n{0}\n# Channel: b\n{0}", plain(1.0, "\t")),
            Refused(&["line 19 begins a second header"]),
        ),
        ("two images by an empty line", "a.txt", twice, Told(&["2 blocks of 16 lines"])),
        (
            "a header of another size",
            "a.txt",
            format!("# h=16 w=15\n{}", plain(1.0, " ")),
            Refused(&["16 lines of 16 numbers, and its header says 16 lines of 15"]),
        ),
        (
            "a header without its mark",
            "a.txt",
            format!("h=16 w=16\n{}", plain(1.0, " ")),
            Refused(&["line 1", "a header?"]),
        ),
        (
            "a width in no unit",
            "a.txt",
            format!("# Width: 3 furlong\n{}", plain(1.0, " ")),
            Refused(&["line 1 gives a side"]),
        ),
        (
            "a height in volts",
            "a.txt",
            format!("# Width: 3 m\n# Height: 3 m\n# Value units: V\n{}", plain(1.0, " ")),
            Refused(&["no unit of length", "surface.scale"]),
        ),
        (
            "a unit and a case without",
            "a.txt",
            format!("# Value units: m\n{}", plain(1.0, " ")),
            Refused(&["heights are in m", "[units]"]),
        ),
        (
            "a grid of a map",
            "a.txt",
            format!("ncols 16\nnrows 16\nNODATA_value -9999\n{}", plain(1.0, " ")),
            Refused(&["line 1", "a header?"]),
        ),
        (
            "names of the columns",
            "a.csv",
            format!("\"x\",\"y\"\n{}", plain(1.0, ",")),
            Refused(&["line 1", "a header?"]),
        ),
        (
            "a profile",
            "a.txt",
            profile(" ", |x, z| vec![x, z]),
            Refused(&["132 lines of two numbers", "a profile is no surface", "equal columns"]),
        ),
        (
            "a falling profile",
            "a.csv",
            profile(",", |x, z| vec![-0.3 * x * x, z]),
            Refused(&["a profile is no surface"]),
        ),
        (
            "a profile in two lines",
            "a.dat",
            in_two_lines,
            Refused(&["two lines of 132 numbers", "a profile is no surface"]),
        ),
        (
            "a profile as points",
            "a.txt",
            profile(" ", |x, z| vec![x, 7.5, z]),
            Refused(&["132 points on a line along x", "a profile is no surface"]),
        ),
        (
            "a profile as points, said",
            "a.xyz",
            profile(" ", |x, z| vec![0.0, x, z]),
            Refused(&["132 points on a line along y"]),
        ),
        (
            "an attocube of two units",
            "a.txt",
            format!("# x-unit = nm\n# y-unit = µm\n{}", plain(1.0, " ")),
            Refused(&["line 2 gives a quantity that another line of the header gives otherwise"]),
        ),
        (
            "two widths",
            "a.txt",
            format!("# Width: 3 m\n# Height: 3 m\n# Width: 4 m\n{}", plain(1.0, " ")),
            Refused(&["line 3: which one?"]),
        ),
        ("one long line", "a.txt", plain(1.0, " ").replace('\n', " "), Refused(&["1 × 256 heights"])),
        ("one column", "a.txt", plain(1.0, "\n"), Refused(&["256 × 1 heights"])),
    ] {
        meets(&look(file, content, PERIOD, ""), fate, name);
    }
    // UTF-16, as spreadsheets save "Unicode text".
    let wide: Vec<u8> = plain(1.0, "\t").encode_utf16().flat_map(u16::to_le_bytes).collect();
    meets(&look("a.txt", [&[0xff, 0xfe][..], &wide].concat(), PERIOD, ""), Refused(&["UTF-16"]), "UTF-16");
    // An image of 16 lines of 32 on sides in the order of the image.
    let image =
        matrix([16, 32], " ", |i, j| format!("{:.4}", (TAU * j as f64 / 32.0).sin() + (TAU * i as f64 / 16.0).cos()));
    meets(&look("a.txt", &image, "period = [20, 10]", ""), Told(&["is it an image?", "0.62500"]), "lines of an image");
    meets(&look("a.txt", &image, "period = [10, 20]", ""), Read(1.0), "lines along a₁");
}

const MICROMETRES: &str = "[units]\nlength = \"µm\"";

#[test]
fn good_files_are_read_without_a_word() {
    let gwyddion = |mark: &str, width: &str, height: &str| {
        format!("# Channel: ZSensor\n# Width: {width}\n# Height: {height}\n# Value units: m\n{}", plain(1e-6, mark))
    };
    let rms = 0.81_f64.sqrt();
    let german = "# Kanal: Höhe\n# Breite: 64,00 µm\n# Höhe: 64,00 µm\n# Value units: m\n";
    let comma = |text: String| text.replace('.', ",");
    for (name, file, content, surface) in [
        ("Gwyddion", "a.txt", gwyddion("\t", "64.00 µm", "64.00 µm"), ""),
        ("Gwyddion, in nanometres and metres", "a.txt", gwyddion(" ", "64000 nm", "6.4e-5 m"), ""),
        ("Gwyddion in German", "a.txt", comma(format!("{german}{}", plain(1e-6, "\t"))), ""),
        ("Gwyddion with the cell of the case", "a.txt", gwyddion("\t", "64 µm", "64 µm"), PERIOD),
        ("Gwyddion, the factor by hand", "a.txt", gwyddion("\t", "64 µm", "64 µm"), "scale = 1e6"),
        ("Gwyddion, the unit once more", "a.txt", gwyddion("\t", "64 µm", "64 µm"), "unit = \"m\""),
        ("Gwyddion, turned over", "a.txt", gwyddion("\t", "64 µm", "64 µm"), "unit = \"m\"\nscale = -1"),
        (
            "Gwyddion, points",
            "a.xyz",
            format!("# Channel: Z\n# Lateral units: m\n# Value units: m\n{}", points("\t", 4e-6, 1e-6)),
            "",
        ),
        (
            "Gwyddion, points in a text",
            "a.txt",
            format!("# Lateral units: m\n# Value units: m\n{}", points("\t", 4e-6, 1e-6)),
            "",
        ),
        (
            "SPIP",
            "a.dat",
            format!(
                "# File Format = ASCII\n# Created by SPIP 6\n# x-pixels = 16\n# y-pixels = 16\n# x-length = 64000\n# y-length = 64000\n# x-unit = nm\n# y-unit = nm\n# z-unit = nm\n# Start of Data:\n{}",
                plain(1e3, "\t")
            ),
            "",
        ),
        ("SPIP of Gwyddion", "a.asc", spip("# Bit2nm = 1.0\n", &plain(1e3, "\t")), ""),
        ("SPIP in a text", "a.txt", spip("# Bit2nm = 1.0\n", &plain(1e3, "\t")), ""),
        ("SPIP in counts", "a.asc", spip("# Bit2nm = 0.5\n", &plain(2e3, "\t")).replace('\n', "\r\n"), ""),
        (
            "SPIP in brackets",
            "a.asc",
            spip("# Bit2nm = 1.0\n# z-unit = [µm]\n# voidpixels =0\n", &plain(1.0, "\t")),
            "",
        ),
        ("SPIP, the unit by hand", "a.asc", spip("", &plain(1.0, "\t")), "unit = \"µm\""),
        ("counts and a pixel", "a.txt", format!("# h=16 w=16\n# pixel size=4e-6 m\n{}", plain(1.0, " ")), ""),
        ("numpy.savetxt", "a.txt", matrix([16, 16], " ", |i, j| format!("{:.18e}", height(i, j))), PERIOD),
        (
            "numpy.savetxt with words",
            "a.txt",
            format!("# profilometer, 20 C, tip radius 2 um\n{}", plain(1.0, " ")),
            PERIOD,
        ),
        (
            "a comment with a height",
            "a.txt",
            format!("# Height: 3 nm step, Tip: 2 nm\n% wavelength = 632.8 nm\n{}", plain(1.0, " ")),
            PERIOD,
        ),
        ("a spreadsheet", "a.csv", plain(1.0, ","), PERIOD),
        ("a spreadsheet in German", "a.csv", comma(plain(1.0, ";")), PERIOD),
        ("a spreadsheet of Windows", "a.csv", plain(1.0, ",").replace('\n', "\r\n"), PERIOD),
        ("tabs and decimal commas", "a.dat", comma(plain(1.0, "\t")), PERIOD),
        ("a comma at each end", "a.csv", plain(1.0, ",").replace('\n', ",\n"), PERIOD),
        ("MATLAB", "a.txt", matrix([16, 16], "  ", |i, j| format!("{:>14.7e}", height(i, j))), PERIOD),
        ("points with commas", "a.csv", points(",", 4.0, 1.0), ""),
        ("points with semicolons and commas", "a.csv", comma(points(";", 4.0, 1.0)), ""),
        ("points of the case's unit", "a.xyz", points(" ", 4.0, 1.0), ""),
        (
            "counts of a converter",
            "a.csv",
            matrix([16, 16], ",", |i, j| format!("{:.0}", 1000.0 * height(i, j))),
            "period = 64\nscale = 1e-3",
        ),
        (
            "counts without a sign",
            "a.csv",
            matrix([16, 16], ",", |i, j| format!("{:.0}", 30_000.0 + 1000.0 * height(i, j))),
            "period = 64\nscale = 1e-3",
        ),
    ] {
        meets(&look(file, content, surface, MICROMETRES), Read(rms), name);
    }
    // In Latin-1, as on Windows.
    let text = gwyddion("\t", "64.00 \u{1}m", "64.00 \u{1}m").into_bytes();
    let latin: Vec<u8> = text.into_iter().map(|byte| if byte == 1 { 0xb5 } else { byte }).collect();
    meets(&look("a.txt", latin, "", MICROMETRES), Read(rms), "Latin-1");
}

#[test]
fn a_factor_that_may_or_may_not_hold_the_unit_is_refused() {
    let content = format!("# Width: 64 µm\n# Height: 64 µm\n# Value units: m\n{}", plain(1e-6, " "));
    for (surface, more, fate) in [
        ("scale = 2", MICROMETRES, Refused(&["heights are in m", "surface.unit = \"m\""][..])),
        ("scale = -1", MICROMETRES, Refused(&["heights are in m"])),
        ("unit = \"nm\"", MICROMETRES, Refused(&["heights are in m", "surface.unit"])),
        ("scale = 2\nunit = \"m\"", MICROMETRES, Read(1.8)),
        ("scale = 1e6\nperiod = 64", "", Read(0.9)),
        ("period = 32", MICROMETRES, Told(&["says that it is 64.000 × 64.000 large"])),
    ] {
        meets(&look("a.txt", &content, surface, more), fate, surface);
    }
}

/// A header of SPIP on 64 µm, without a unit; with these lines before its end.
fn spip(more: &str, data: &str) -> String {
    format!(
        "# File Format = ASCII\n# Created by Gwyddion 2.65\n# Original file: NONE\n# x-pixels = 16\n# y-pixels = 16\n# x-length = 64000\n\
         # y-length = 64000\n# x-offset = 0\n# y-offset = 0\n{more}# Start of Data:\n{data}"
    )
}

/// Sides are in nanometres and heights are numbers × Bit2nm, whatever the unit of the case and the ending of the file.
#[test]
fn the_lengths_of_spip_are_nanometres() {
    let heights = plain(1e3, "\t");
    let mask = |hole: &str| matrix([16, 16], "\t", |i, j| if i == 4 && j == 7 { hole } else { "0" }.to_owned());
    let marked = |voids: &str, hole: &str| {
        spip(&format!("# Bit2nm = 1.0\n# voidpixels ={voids}\n"), &(heights.clone() + &mask(hole)))
    };
    for (content, surface, fate) in [
        (spip("# Bit2nm = 1.0\n", &heights), "", Read(0.9)),
        (spip("# Bit2nm = 1.0\n", &heights), "period = 0.064", Told(&["says that it is 64.000 × 64.000 large"][..])),
        (marked("1", "1"), "", Told(&["1 of 256 places"])),
        (marked("2", "1"), "", Refused(&["do not mark by 1 the 2 places"])),
        (marked("1", "0.5"), "", Refused(&["do not mark by 1 the 1 places"])),
        (marked("0", "1"), "", Refused(&["holds 32 lines of 16 numbers, and its header says 16"])),
        (
            spip("# Bit2nm = 1.0\n# voidpixels = 3\n", &heights),
            "",
            Refused(&["3 places have no measurement, and does not mark"]),
        ),
        (spip("", &heights), "", Refused(&["says no unit of its heights", "surface.unit"])),
        (spip("# Bit2nm = 0.5\n# z-unit = nm\n", &heights), "", Refused(&["a factor before them", "surface.scale"])),
        (spip("# Bit2nm = 1.0\n# z-unit = V\n", &heights), "", Refused(&["no unit of length"])),
        (spip("# Bit2nm = 0\n", &heights), "", Refused(&["Bit2nm that is no number greater than 0"])),
    ] {
        for file in ["a.asc", "a.txt"] {
            meets(&look(file, &content, surface, MICROMETRES), fate, surface);
        }
    }
    // A mark of missing data among the counts, before the factor.
    let first = heights.split_once('\t').unwrap().1;
    let counts = spip("# Bit2nm = 0.37\n", &format!("32767\t{first}"));
    meets(&look("a.asc", counts, "", MICROMETRES), Refused(&["32767.0 at 1 of 256 places"]), "a mark");
}

/// The way through a program that reads what percoat does not.
#[test]
fn a_file_that_is_refused_for_its_format_names_the_way_through() {
    for (file, content) in
        [("a.spm", "binary"), ("a.sdf", "no SDF"), ("a.gwy", "no GWY"), ("a.asc", "WSxM file"), ("a.x3p", "no zip")]
    {
        let answer = check(file, content);
        assert!(
            answer.code == 2 && answer.err.contains("Gwyddion") && answer.err.contains(".gwy"),
            "{file}: {}",
            answer.err
        );
    }
}

/// A path can be anybody's: what stands at it is not repeated.
#[test]
fn errors_do_not_repeat_what_a_file_holds() {
    for (file, content) in [
        ("a.csv", "root:x:0:0:SECRET,b\n"),
        ("a.csv", "1,2\n3,SECRET\n"),
        ("a.txt", "SECRET"),
        ("a.txt", "1 2\n3 1.SECRET,5\n"),
        ("a.dat", "# Width: SECRET\n1 2\n3 4\n"),
        ("a.dat", "# Value units: SECRET\n1 2\n3 4\n"),
        ("a.dat", "# Width: 3 SECRET\n1 2\n3 4\n"),
        ("a.xyz", "SECRET 0 1\n"),
        ("a.xyz", "0 0 1\n1 0 SECRET\n"),
        ("a.npy", "\u{1}SECRET"),
    ] {
        let answer = check(file, content);
        assert!(answer.code == 2 && !answer.err.contains("SECRET"), "{content:?}: {}", answer.err);
    }
    let head = "{'descr': 'SECRET KIND', 'fortran_order': False, 'shape': (2, 2), }";
    let array = [b"\x93NUMPY\x01\0", &[head.len() as u8, 0][..], head.as_bytes(), &[0; 32]].concat();
    let answer = check("a.npy", array);
    assert!(
        answer.code == 2 && answer.err.contains("another type") && !answer.err.contains("SECRET"),
        "{}",
        answer.err
    );
}

/// A pipe is read once, however often its case is.
#[cfg(unix)]
#[test]
fn heights_and_cases_come_out_of_pipes() {
    use std::process::Command;
    let desk = Desk::new();
    desk.write("a.csv", plain(1.0, ","));
    desk.write("b.txt", points(" ", 4.0, 1.0));
    desk.write("case.toml", case("a.csv", PERIOD, ""));
    let percoat = assert_cmd::cargo::cargo_bin!("percoat");
    for script in [
        "\"$P\" check case.toml --set surface.heights=<(cat a.csv)",
        "\"$P\" check <(cat case.toml)",
        "mkfifo a.dat && (cat a.csv >a.dat &) && \"$P\" check case.toml --set surface.heights=a.dat",
        "\"$P\" solve case.toml --set surface.heights=<(cat a.csv) -o out --no-pictures && echo 16 × 16 samples",
        "\"$P\" sweep case.toml --set surface.heights=<(cat a.csv) --set load.mean_pressure=1e-3,2e-3 -o sweep && echo 16 × 16 samples",
        "grep -v period case.toml >points.toml && \"$P\" check points.toml --set surface.heights=<(cat b.txt)",
    ] {
        let answer = Command::new("timeout")
            .args(["60", "bash", "-c", script])
            .env("P", percoat)
            .current_dir(desk.path("."))
            .output()
            .unwrap();
        let [out, err] = [&answer.stdout, &answer.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
        assert!(answer.status.success() && out.contains("16 × 16 samples"), "{script}: {out}\n{err}");
    }
}

/// On a square cell with equal counts nothing else shows which way the lines of a text run.
#[test]
fn a_run_says_which_way_the_lines_of_a_text_were_taken_to_run() {
    let image = format!("# Width: 64 µm\n# Height: 64 µm\n# Value units: um\n{}", plain(1.0, "\t"));
    for (name, content, surface, said) in [
        ("a.txt", plain(1.0, " "), PERIOD, true),
        ("b.csv", plain(1.0, ","), PERIOD, true),
        ("image.txt", image, "", false),
        ("points.txt", points(" ", 4.0, 1.0), "", false),
    ] {
        let desk = Desk::new();
        desk.write(name, content);
        desk.write("case.toml", case(name, surface, MICROMETRES));
        let Answer { code, out, err } = desk.percoat(&["solve", "case.toml", "--no-pictures"]);
        let found = out.contains(&format!("{name}: its lines run along a₁")) && out.contains("image[::-1].T");
        assert!(code == 0 && found == said, "{name}: {code}\n{out}\n{err}");
    }
}
