//! Surfaces from instruments' files: those that the libraries of others wrote (`tests/surfaces`), and broken ones.

#![cfg(feature = "cli")]

use miniz_oxide::deflate::compress_to_vec;
use percoat::case::{Case, Source, Treated, plausibility};
use std::fs;
use std::path::Path;
use std::sync::Arc;

const POINTS: [usize; 2] = [24, 15];
const HOLES: [[usize; 2]; 4] = [[3, 2], [3, 3], [17, 11], [0, 14]];
const REST: &str = "[units]\nlength = \"nm\"\n[substrate]\nyoung = 1\npoisson = 0.3\n[load]\nmean_pressure = 1e-3\n";

/// Height of `tests/surfaces/make.py`, nm; y upward.
fn height(i: usize, j: usize) -> f64 {
    20.0 * i as f64 - 35.0 * j as f64 + ((7 * i + 11 * j * j) % 13 * 8) as f64
}

fn stored(name: &str) -> Vec<u8> {
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/surfaces").join(name)).unwrap()
}

/// The source of a case on a file of this name and content, with further lines of `[surface]`.
fn source(name: &str, content: Vec<u8>, surface: &str) -> Source {
    let text = format!("[surface]\nheights = \"{name}\"\n{surface}\n{REST}");
    let files = [(name.to_owned(), Arc::from(content))].into();
    Source { name: "case".to_owned(), text, files, ..Source::default() }
}

/// The case, which is read back from what it writes.
fn read(name: &str, content: Vec<u8>, surface: &str) -> Result<Case, String> {
    let source = source(name, content, surface);
    let case = Case::read(&source, &[]).map_err(|error| error.to_string())?;
    let again = Source { text: case.to_toml(), ..source };
    assert_eq!(Case::read(&again, &[]).as_ref(), Ok(&case), "{}", case.to_toml());
    Ok(case)
}

/// Largest difference of the heights of a case from the formula times `factor`, nm, but at the holes; both from the first sample on.
fn error(case: &Case, factor: f64) -> f64 {
    let heights = case.problem().topography().unwrap().heights();
    assert_eq!(heights.dim(), (POINTS[0], POINTS[1]));
    let expected = |i: usize, j: usize| factor * (height(i, j) - height(0, 0));
    let differences = heights.indexed_iter().filter(|((i, j), _)| !HOLES.contains(&[*i, *j]));
    differences.fold(0.0, |most, ((i, j), height)| f64::max(most, (height - heights[[0, 0]] - expected(i, j)).abs()))
}

fn doubts(case: &Case) -> String {
    plausibility::of_case(case).join("\n")
}

/// Errors: of doubles some units in the last place of 500 nm; of a text its ten digits; of points of 32 bits that of the spacing, a
/// number of single precision; of single precision half a unit in its last place.
const FILES: [(&str, &str, f64, usize); 19] = [
    ("one_height.gwy", "", 1e-12, 4),
    ("two_heights.gwy", "channel = \"Height\"", 1e-12, 4),
    ("two_heights.gwy", "channel = 2", 1e-12, 4),
    ("doubles.x3p", "", 1e-12, 4),
    ("shorts.x3p", "", 1e-12, 4),
    ("layers.x3p", "channel = 1", 1e-12, 4),
    ("other.x3p", "", 1e-4, 0),
    ("text.x3p", "", 1e-12, 4),
    ("binary.sdf", "", 1e-11, 4),
    ("text.sdf", "", 1e-8, 4),
    ("iso2.sdf", "", 1e-11, 4),
    ("iso2_text.sdf", "", 1e-11, 4),
    ("bcr.sdf", "", 1e-11, 4),
    ("bcr_floats.sdf", "", 1e-11, 4),
    ("bcr_text.sdf", "", 1e-11, 4),
    ("plain.sur", "", 1e-4, 4),
    ("compressed.sur", "", 1e-4, 4),
    ("hyperspy.sur", "", 1e-4, 4),
    ("grid.asc", "unit = \"µm\"", 1e-11, 4),
];

#[test]
fn the_files_of_other_libraries_are_the_surface_that_they_were_made_of() {
    for (name, surface, tolerance, holes) in FILES {
        let case = read(name, stored(name), surface).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(error(&case, 1.0) < tolerance, "{name}: {:e}", error(&case, 1.0));
        let [[x, _], [_, y]] = case.problem().cell().vectors();
        // A spacing of single precision in .sur.
        assert!((x / 12e3 - 1.0).abs() < 1e-7 && (y / 12e3 - 1.0).abs() < 1e-7, "{name}: {x} × {y}");
        let told = format!("{holes} of 360 places (1.1111 %) have no measurement");
        assert_eq!(doubts(&case).contains(&told), holes > 0, "{name}: {}", doubts(&case));
        let section = case.surface.as_ref().unwrap();
        assert_eq!(section.stages.iter().any(|stage| matches!(stage.treated, Treated::Filled { .. })), holes > 0);
        // Filled heights lie between those of their surroundings.
        let heights = case.problem().topography().unwrap().heights();
        let level =
            |[i, j]: [usize; 2]| heights[[i, j]] - heights[[0, 0]] + height(0, 0) - 20.0 * i as f64 + 35.0 * j as f64;
        assert!(HOLES.iter().all(|at| (-1.0..=97.0).contains(&level(*at))), "{name}");
    }
    let compressed = "hyperspy_compressed.sur";
    assert!(error(&read(compressed, stored(compressed), "").unwrap(), 1.0) < 1e-4);
}

#[test]
fn channels_are_named_and_heights_turned_over_by_their_scale() {
    let of = |name: &str, surface: &str| read(name, stored(name), surface);
    assert!(error(&of("two_heights.gwy", "channel = \"Height, backward\"").unwrap(), -1.0) < 1e-12);
    assert!(error(&of("layers.x3p", "channel = \"layer 2\"").unwrap(), -1.0) < 1e-12);
    assert!(error(&of("one_height.gwy", "unit = \"m\"\nscale = -2").unwrap(), -2.0) < 1e-11);
    // Degrees are no heights without a factor.
    assert!(of("one_height.gwy", "channel = 1").unwrap_err().contains("no unit of length"));
    assert!(error(&of("one_height.gwy", "channel = 1\nscale = 1").unwrap(), 1.0) < 1e-11);
    for (name, surface, words) in [
        ("two_heights.gwy", "", "several channels of heights"),
        ("two_heights.gwy", "", "1 \"Phase\", no length; 2 \"Height\" in m; 3 \"Height, backward\" in m"),
        ("two_heights.gwy", "channel = \"height\"", "no channel of the name"),
        ("two_heights.gwy", "channel = 4", "has no channel 4"),
        ("layers.x3p", "", "1 \"layer 1\" in m; 2 \"layer 2\" in m"),
        ("binary.sdf", "channel = 2", "has no channel 2"),
        ("grid.asc", "channel = \"Height\"", "no channel of the name"),
        ("doubles.x3p", "unit = \"µm\"", "says that its heights are in m"),
        ("doubles.x3p", "channel = 0", "`surface.channel`"),
    ] {
        let told = of(name, surface).unwrap_err();
        assert!(told.contains(words), "{name} {surface}: {told}");
    }
    assert!(of("grid.asc", "channel = 1\nunit = \"µm\"").is_ok());
}

/// The unit of the case is needed for files in metres, as for any file that names a unit.
#[test]
fn a_file_in_metres_needs_the_unit_of_the_case() {
    let text = format!("[surface]\nheights = \"a.x3p\"\n{}", REST.replace("[units]\nlength = \"nm\"\n", ""));
    let files = [("a.x3p".to_owned(), Arc::from(stored("doubles.x3p")))].into();
    let source = Source { name: "case".to_owned(), text, files, ..Source::default() };
    assert!(Case::read(&source, &[]).unwrap_err().to_string().contains("says that its heights are in m"));
}

#[test]
fn truncated_files_are_refused_wherever_they_end() {
    for (name, surface, ..) in FILES {
        let whole = stored(name);
        for end in (0..whole.len()).step_by(37) {
            let Ok(case) = read(name, whole[..end].to_vec(), surface) else { continue };
            // A text may end within its last number, or after it.
            assert!(
                name.ends_with("text.sdf") && end > whole.len() - 60 || name == "grid.asc" && end > whole.len() - 30,
                "{name} to {end}"
            );
            assert_eq!(case.problem().topography().unwrap().points(), POINTS);
        }
    }
}

/// A byte is set to its complement, here and there: another surface or an error, never a panic.
#[test]
fn a_changed_byte_is_another_surface_or_an_error() {
    for (name, surface, ..) in FILES {
        let whole = stored(name);
        // The heads are where the sizes stand.
        for at in (0..whole.len().min(700)).step_by(3).chain((700..whole.len()).step_by(211)) {
            let mut other = whole.clone();
            other[at] = !other[at];
            let _ = Case::read(&source(name, other, surface), &[]);
        }
    }
}

fn put(mut content: Vec<u8>, at: usize, bytes: &[u8]) -> Vec<u8> {
    content[at..at + bytes.len()].copy_from_slice(bytes);
    content
}

#[test]
fn sizes_that_the_file_does_not_hold_are_refused() {
    let sdf = |at: usize, bytes: &[u8]| read("a.sdf", put(stored("binary.sdf"), at, bytes), "");
    let sur = |at: usize, bytes: &[u8]| read("a.sur", put(stored("plain.sur"), at, bytes), "");
    let packed = |at: usize, bytes: &[u8]| read("a.sur", put(stored("compressed.sur"), at, bytes), "");
    let gwy = |field: &[u8], bytes: &[u8]| {
        let content = stored("one_height.gwy");
        let mut starts =
            content.windows(field.len()).enumerate().filter(|(_, window)| *window == field).map(|(at, _)| at);
        // The second channel, the one of heights.
        let at = starts.nth(1).unwrap() + field.len();
        read("a.gwy", put(content, at, bytes), "")
    };
    let asc = |from: &str, to: &str| {
        let text = String::from_utf8(stored("grid.asc")).unwrap().replacen(from, to, 1);
        read("a.asc", text.into_bytes(), "unit = \"µm\"")
    };
    let text = |from: &str, to: &str| {
        let text = String::from_utf8(stored("text.sdf")).unwrap().replacen(from, to, 1);
        read("a.sdf", text.into_bytes(), "")
    };
    let unequal = put(put(stored("plain.sur"), 196, &[b' '; 16]), 280, &1e3f32.to_le_bytes());
    for (told, words) in [
        (sdf(42, &[0xff, 0x7f, 0xff, 0x7f]), "ends before the data"),
        (sdf(42, &[0xff, 0xff]), "between 2 and 32768"),
        (sdf(44, &[1, 0]), "a profile is no surface"),
        (sdf(46, &(-1.0f64).to_le_bytes()), "a distance is negative"),
        (sdf(62, &f64::NAN.to_le_bytes()), "no number other than 0"),
        (sdf(78, &[1]), "is compressed"),
        (sdf(79, &[9]), "of a type that the format does not have"),
        (sur(108, &(-24i32).to_le_bytes()), "between 2 and 32768"),
        (sur(108, &i32::MAX.to_le_bytes()), "ends before the data"),
        (sur(98, &[8]), "neither 16 nor 32 bits"),
        (sur(120, &f32::NAN.to_le_bytes()), "no length greater than 0"),
        (sur(14, &[9]), "ends before the data"),
        (sur(12, &[1, 1]), "old Macintosh"),
        (sur(18, &[12]), "holds a picture"),
        (packed(108, &30_000i32.to_le_bytes()), "not as many as its header states"),
        (packed(512, &u32::MAX.to_le_bytes()), "ends before the data"),
        (packed(516, &u32::MAX.to_le_bytes()), "not as many as its header states"),
        (packed(520, &u32::MAX.to_le_bytes()), "ends before the data"),
        (gwy(b"xres\0i", &(-5i32).to_le_bytes()), "between 2 and 32768"),
        (gwy(b"xres\0i", &30_000i32.to_le_bytes()), "an image of 30000 × 15 has 360 numbers"),
        (gwy(b"data\0D", &u32::MAX.to_le_bytes()), "ends before the data"),
        (gwy(b"xreal\0d", &0f64.to_le_bytes()), "no length greater than 0"),
        (asc("ncols        24", "ncols 30000"), "ends before the data"),
        (asc("ncols        24", "ncols -24"), "between 2 and 32768"),
        (asc("nrows        15", "nrows 14"), "more heights than its header states"),
        (asc("dx ", "dz "), "no CELLSIZE"),
        (asc("-9999.0 ", "-9999.0 X"), "no number"),
        (text("NumPoints = 24", "NumPoints = 32000"), "ends before the data"),
        (text("NumProfiles", "Profiles"), "lacks a size"),
        (text("BAD", "bed"), "no number"),
        (text("BAD", "1 BAD"), "more heights than its header states"),
        (text("NumPoints = 24", "NumPoints = 23"), "more heights than its header states"),
        (sdf(44, &[14, 0]), "more heights than its header states"),
        (read("a.sur", unequal, ""), "a spacing of its header has no unit"),
    ] {
        let told = told.map(|_| ()).unwrap_err();
        assert!(told.contains(words), "{words}: {told}");
    }
}

/// A text of the proposal before the standard, with comments, words, ends of lines of old computers and a star in a value; and what may
/// follow binary heights, or precede them.
#[test]
fn sdf_files_of_other_writers_are_read() {
    let text = String::from_utf8(stored("bcr_text.sdf")).unwrap();
    let replacements = [
        ("NumPoints = 24", "NumPoints   24 ; points of a line"),
        ("Zresolution", "; a comment\nManufacID = A*B\nZresolution"),
        ("DataType = 6", "DataType = LongInt"),
        ("Compression = 0", "Compression = NULL"),
        ("CheckType = 0", "CheckType = None"),
        ("aBCR", "ABCR"),
        ("2147483647", "BAD ; 3 4\n"),
    ];
    let other = replacements.iter().fold(text, |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    });
    let of = |text: String| error(&read("a.sdf", text.into_bytes(), "").unwrap(), 1.0);
    assert!(of(format!("{other}\nmeasured by A")) < 1e-11);
    assert!(of(other.replace("\r\n", "\n").replace('\n', "\r")) < 1e-11);
    let longer = |name: &str| [stored(name), vec![b' '; 500]].concat();
    assert!(error(&read("a.sdf", longer("binary.sdf"), "").unwrap(), 1.0) < 1e-11);
    assert!(error(&read("a.sdf", longer("bcr.sdf"), "").unwrap(), 1.0) < 1e-11);
    // Two numbers more behind the header.
    let olympus = [&stored("binary.sdf")[..81], &[5, 0, 0, 0, 1, 0, 0, 0], &stored("binary.sdf")[81..]].concat();
    assert!(error(&read("a.sdf", olympus, "").unwrap(), 1.0) < 1e-11);
}

/// A file as `sdfile_export_text` of Gwyddion writes it: six digits, the first line on top, no star at the end.
#[test]
fn the_sdf_export_of_gwyddion_is_read() {
    let mut text = "aBCR-0.0\nManufacID   = Gwyddion\nCreateDate  = 01012026\nModDate     = 01012026\nNumPoints   = 24\nNumProfiles = 15\n\
                    Xscale      = 5.000000e-07\nYscale      = 8.000000e-07\nZscale      = 1.000000e+00\nZresolution = -1\n\
                    Compression = 0\nDataType    = 3\nCheckType   = 0\nNumDataSet  = 1\nNanPresent  = 0\n*\n"
        .to_owned();
    for j in (0..POINTS[1]).rev() {
        (0..POINTS[0]).for_each(|i| text += &format!("{:.5e}\n", 1e-9 * height(i, j)));
    }
    let case = read("a.sdf", text.into_bytes(), "").unwrap();
    // Half a unit of the sixth digit of 500 nm, twice.
    assert!(error(&case, 1.0) < 1.01e-3 && !doubts(&case).contains("have no measurement"), "{}", error(&case, 1.0));
}

/// The mark of one version among the numbers of another is no summit and no pit.
#[test]
fn what_no_version_of_sdf_explains_is_refused_with_the_way_through() {
    let binary = |name: &str, at: usize, bytes: &[u8]| read("a.sdf", put(stored(name), at, bytes), "");
    let text = |name: &str, from: &str, to: &str| {
        let text = String::from_utf8(stored(name)).unwrap();
        assert!(text.contains(from), "{from}");
        read("a.sdf", text.replacen(from, to, 1).into_bytes(), "")
    };
    for (told, words) in [
        (
            binary("binary.sdf", 0, b"bISO-3.0"),
            "is of the version ISO-3.0; BCR-0.0, BCR-1.0, ISO-1.0 and ISO-2.0 are read",
        ),
        (binary("binary.sdf", 0, b"bISO-\xff\0\0"), "is of the version that is not known"),
        (text("text.sdf", "aISO-1.0", "aBCR-2.0"), "is of the version BCR-2.0"),
        (binary("binary.sdf", 78, &[1]), "compressed"),
        (binary("binary.sdf", 80, &[1]), "checksums"),
        (binary("binary.sdf", 79, &[1]), "numbers without a sign"),
        (text("text.sdf", "CheckType = 0", "CheckType = 1"), "checksums"),
    ] {
        let told = told.map(|_| ()).unwrap_err();
        assert!(told.contains(words) && told.contains("save it there as .gwy"), "{words}: {told}");
    }
    for (told, words) in [
        (binary("bcr.sdf", 81 + 2 * 7, &i16::MIN.to_le_bytes()), "-32768.0 at 1 of 360 places"),
        (text("iso2_text.sdf", " 268 ", " 32767 "), "32767.0 at 1 of 360 places"),
        (binary("binary.sdf", 81 + 8 * 7, &f64::MAX.to_le_bytes()), "at most 1e60"),
        (text("text.sdf", "NumPoints = 24", "NumPoints = 24\nNumPoints = 24"), "a number of its header twice"),
    ] {
        let told = told.map(|_| ()).unwrap_err();
        assert!(told.contains(words), "{words}: {told}");
    }
    // By the proposal the largest number is the mark, of numbers without a sign too.
    let raised = (0..360).fold(stored("bcr.sdf"), |content, k| {
        let at = 81 + 2 * k;
        let number = i16::from_le_bytes([content[at], content[at + 1]]);
        let other = if number == i16::MAX { u16::MAX } else { (i32::from(number) + 1000) as u16 };
        put(content, at, &other.to_le_bytes())
    });
    let case = read("a.sdf", put(raised, 79, &[1]), "").unwrap();
    assert!(error(&case, 1.0) < 1e-11 && doubts(&case).contains("4 of 360 places"));
}

/// The first channel is a profile, and the second one wanted.
#[test]
fn a_channel_is_read_beside_another_that_is_no_surface() {
    let content = stored("one_height.gwy");
    let at = content.windows(6).position(|window| window == b"xres\0i").unwrap() + 6;
    let profile = |surface: &str| read("a.gwy", put(content.clone(), at, &1i32.to_le_bytes()), surface);
    assert!(error(&profile("channel = 2").unwrap(), 1.0) < 1e-12);
    assert!(profile("channel = 1\nscale = 1").unwrap_err().contains("a profile is no surface"));
}

/// Bytes that the header of old SUR files reserves are not read as a number of spectra; a blank unit of the spacing of samples is the unit of
/// length where the ratio of the two is 1, and is refused elsewhere.
#[test]
fn headers_of_older_sur_files_are_read() {
    let other = put(stored("plain.sur"), 94, &123_456i32.to_le_bytes());
    assert!(error(&read("a.sur", other.clone(), "").unwrap(), 1.0) < 1e-4);
    assert!(read("a.sur", put(other, 18, &[21]), "").unwrap_err().contains("a spectrum at each point"));
    let mut blank = stored("plain.sur");
    for axis in 0..3 {
        let unit = blank[180 + 16 * axis..][..16].to_vec();
        blank = put(blank, 228 + 16 * axis, &unit);
        blank = put(put(blank, 180 + 16 * axis, &[0; 16]), 276 + 4 * axis, &1f32.to_le_bytes());
    }
    assert!(error(&read("a.sur", blank, "").unwrap(), 1.0) < 1e-4);
}

/// A ball on a floor has a best sphere that is not the ball's.
#[test]
fn a_sphere_that_leaves_most_of_the_heights_is_doubted() {
    let told = |square: i32, floor: &str| {
        let height = |i: i32, j: i32| match square - (2 * i - 31).pow(2) - (2 * j - 31).pow(2) {
            left if left > 36 => format!("{}", f64::from(left).sqrt()),
            _ => floor.to_owned(),
        };
        let line = |i: i32| (0..32).map(|j| height(i, j)).collect::<Vec<_>>().join(" ") + "\n";
        let text: String = (0..32).map(line).collect();
        doubts(&read("a.txt", text.into_bytes(), "pixel = 2\nform = \"sphere\"").unwrap())
    };
    assert!(told(576, "0").contains("the surface has 63 % of its rms height left"), "{}", told(576, "0"));
    assert!(!told(900, "nan").contains("rms height left"), "{}", told(900, "nan"));
}

/// Files of instruments that state no unit are in no unit, and not in that of the case.
#[test]
fn a_file_without_units_is_read_in_the_unit_that_the_case_says() {
    let field = b"unitstr\0sm\0";
    let gwy = stored("one_height.gwy");
    let at: Vec<usize> = (0..gwy.len()).filter(|at| gwy[*at..].starts_with(field)).collect();
    // The phase has metres along its sides, the height everywhere, its mask along its sides.
    assert_eq!(at.len(), 4);
    let blank = |which: &[usize]| which.iter().fold(gwy.clone(), |content, k| put(content, at[*k] + 9, b" "));
    let of = |which: &[usize], surface: &str| read("a.gwy", blank(which), &format!("channel = 2\n{surface}"));
    let mut sur = stored("plain.sur");
    sur[180..276].fill(0);
    let of_sur = |surface: &str| read("a.sur", sur.clone(), surface);
    let of_asc = |surface: &str| read("grid.asc", stored("grid.asc"), surface);
    for told in [of(&[0, 1, 2, 3], ""), of_sur(""), of_asc("")] {
        let told = told.map(|_| ()).unwrap_err();
        assert!(told.contains("says no unit of its heights") && told.contains("surface.unit"), "{told}");
    }
    for (told, factor) in [
        (of(&[0, 1, 2, 3], "unit = \"m\""), 1.0),
        (of(&[0, 1, 2, 3], "scale = 2e9\nperiod = 12e3"), 2.0),
        (of_sur("unit = \"µm\""), 1.0),
        (of_asc("unit = \"µm\""), 1.0),
        (of(&[1], "unit = \"m\"\nperiod = 12e3"), 1.0),
        (of(&[2], "unit = \"m\"\nperiod = 12e3"), 1.0),
    ] {
        let case = told.unwrap_or_else(|error| panic!("{error}"));
        let [[x, _], [_, y]] = case.problem().cell().vectors();
        assert!(error(&case, factor) < 1e-4 && (x / 12e3 - 1.0).abs() < 1e-7 && (y / 12e3 - 1.0).abs() < 1e-7);
    }
    // Neither the unit of the heights nor that of the case is that of the sides. Which of two is blank the file decides.
    let sides = [of(&[0, 1, 2, 3], "scale = 1e9"), of_sur("scale = 1e3"), of_asc("scale = 1e3")];
    let one = [of(&[1], ""), of(&[2], "")].map(|told| told.map(|_| ()).unwrap_err());
    let one: Vec<String> = one.into_iter().filter(|told| !told.contains("no unit of its heights")).collect();
    assert_eq!(one.len(), 1);
    for told in sides.into_iter().map(|told| told.map(|_| ()).unwrap_err()).chain(one) {
        assert!(told.contains("`surface.period` is missing") && told.contains("and not their unit"), "{told}");
    }
}

/// A zip of files, each with its content, and the sizes that are stated of it where they are not those that it has.
fn zip(files: &[(&str, &[u8], Option<u32>)]) -> Vec<u8> {
    packed_by(8, files)
}

/// A zip of files that are packed by a method: 0 as they are, 8 deflated.
fn packed_by(method: u8, files: &[(&str, &[u8], Option<u32>)]) -> Vec<u8> {
    let (mut content, mut directory) = (Vec::new(), Vec::new());
    for (name, bytes, stated) in files {
        let packed = if method == 0 { bytes.to_vec() } else { compress_to_vec(bytes, 6) };
        let [short, long] =
            [|n: usize| (n as u16).to_le_bytes().to_vec(), |n: usize| (n as u32).to_le_bytes().to_vec()];
        let size = stated.map_or(bytes.len(), |size| size as usize);
        // Version, flags, method, time and date.
        let common = [
            vec![20, 0, 0, 0, method, 0, 0, 0, 0, 0],
            crc32fast::hash(bytes).to_le_bytes().to_vec(),
            long(packed.len()),
            long(size),
            short(name.len()),
        ]
        .concat();
        let start = content.len();
        content.extend([&b"PK\x03\x04"[..], &common, &[0, 0], name.as_bytes(), &packed].concat());
        let rest = [vec![0; 10], long(start)].concat();
        directory.extend([&b"PK\x01\x02\x14\0"[..], &common, &[0, 0], &rest, name.as_bytes()].concat());
    }
    let (start, length, count) = (content.len() as u32, directory.len() as u32, files.len() as u16);
    content.extend(directory);
    content.extend([&b"PK\x05\x06\0\0\0\0"[..], &count.to_le_bytes(), &count.to_le_bytes()].concat());
    content.extend([&length.to_le_bytes()[..], &start.to_le_bytes(), &[0, 0]].concat());
    content
}

fn main_xml(size: [&str; 3], kind: &str) -> String {
    let axis = |name: &str, of: &str| {
        format!("<{name}><AxisType>{of}</AxisType><DataType>{kind}</DataType><Increment>1e-6</Increment></{name}>")
    };
    let axes = [axis("CX", "I"), axis("CY", "I"), axis("CZ", "A")].concat();
    let [x, y, z] = size;
    format!(
        "<?xml version=\"1.0\"?><p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\"><Record1><Axes>{axes}</Axes></Record1>\
         <Record3><MatrixDimension><SizeX>{x}</SizeX><SizeY>{y}</SizeY><SizeZ>{z}</SizeZ></MatrixDimension>\
         <DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3></p:ISO5436_2>"
    )
}

#[test]
fn zips_that_unpack_without_end_are_refused() {
    let data: Vec<u8> = (0..12u8).flat_map(|k| i16::from(k).to_le_bytes()).collect();
    let main = main_xml(["4", "3", "1"], "I");
    let of = |main: &str, data: &[u8], stated: Option<u32>| {
        read("a.x3p", zip(&[("main.xml", main.as_bytes(), None), ("bindata/data.bin", data, stated)]), "")
    };
    assert!(of(&main, &data, None).is_ok());
    let turned = |r22: &str| {
        let rotation = format!("<Rotation><r11>1</r11><r12>0.0</r12><r22>{r22}</r22></Rotation></Axes>");
        main.replace("</Axes>", &rotation)
    };
    assert!(of(&turned("1.000e+00"), &data, None).is_ok());
    let zeros = vec![0; 64 << 20];
    let blanks = format!("{main}{}", " ".repeat(8 << 20));
    let nested = format!("{}{}", "<a>".repeat(9000), "</a>".repeat(9000));
    // Each names every namespace above it: n³ comparisons.
    let namespaces: String = (0..3000).map(|k| format!("<a xmlns:n{k}=\"c\">")).collect();
    let attributes: String = (0..130_000).map(|k| format!(" a{k}=''")).collect();
    let laughs = format!(
        "<!DOCTYPE a [<!ENTITY b \"cccc\"><!ENTITY d \"&b;&b;\">]>{}",
        main.trim_start_matches("<?xml version=\"1.0\"?>")
    );
    let huge = main_xml(["32768", "32768", "1"], "D");
    for (told, words) in [
        // Sixty-four mebibytes, stated and not.
        (of(&main, &zeros, None), "at most 24 belong there"),
        (of(&main, &zeros, Some(24)), "does not unpack to the size"),
        (of(&main, &data, Some(u32::MAX)), "at most 24 belong there"),
        (of(&main, &data[..20], None), "a file of its zip has 20 bytes"),
        (of(&main, &data[..20], Some(24)), "a file of its zip has 20 bytes"),
        (of(&huge, &data, None), "a file of its zip has 24 bytes"),
        (of(&huge, &zeros, Some(u32::MAX)), "a file of its zip says"),
        (of(&blanks, &data, None), "at most 65536 belong there"),
        (of(&namespaces, &data, None), "more than 16 namespaces"),
        (of(&format!("<a{attributes}/>"), &data, None), "at most 65536 belong there"),
        (of(&nested, &data, None), "lacks an axis"),
        (of(&laughs, &data, None), "no XML"),
        (of("<a", &data, None), "no XML"),
        (of(&main_xml(["4", "3", "1000000"], "I"), &data, None), "too many"),
        (of(&main_xml(["4", "-3", "1"], "I"), &data, None), "between 2 and 32768"),
        (of(&main_xml(["4", "1", "1"], "I"), &data, None), "a profile is no surface"),
        (of(&main_xml(["4", "3", "1"], "X"), &data, None), "of a type"),
        (of(&main.replacen(">I<", ">A<", 1), &data, None), "coordinates of their own"),
        (of(&main.replace("1e-6", "0"), &data, None), "no length greater than 0"),
        (of(&main.replacen("<Increment>1e-6</Increment>", "", 1), &data, None), "lacks the increment of x or y"),
        (of(&turned("-1"), &data, None), "rotated or mirrored"),
        (of(&turned("one"), &data, None), "rotated or mirrored"),
        (read("a.x3p", zip(&[("main.xml", main.as_bytes(), None)]), ""), "is missing"),
        (read("a.x3p", zip(&[("readme", b"a", None)]), ""), "without a main.xml"),
        (read("a.x3p", b"PK\x03\x04".to_vec(), ""), "no whole zip"),
        (read("a.gwy", stored("binary.sdf"), ""), "does not begin as a file of its format"),
    ] {
        let told = told.map(|_| ()).unwrap_err();
        assert!(told.contains(words), "{words}: {told}");
    }
}

/// `main.xml` with its heights as text; this list of them.
fn main_with(list: &str) -> String {
    let main = main_xml(["4", "3", "1"], "D");
    let (before, rest) = main.split_once("<DataLink>").unwrap();
    format!("{before}{list}{}", rest.split_once("</DataLink>").unwrap().1)
}

/// Heights as in the samples of the standard.
#[test]
fn heights_in_main_xml_are_read_or_refused() {
    let of = |list: &str| read("a.x3p", zip(&[("main.xml", main_with(list).as_bytes(), None)]), "");
    let datums = |count: usize| (0..count).map(|k| format!("<Datum>{k}.5e-3</Datum>\n")).collect::<String>();
    let list = |datums: &str| format!("<DataList>{datums}</DataList>");
    let plain = of(&list(&datums(12))).unwrap();
    // In micrometres: the increment along z is one, too.
    let heights = plain.problem().topography().unwrap().heights().to_owned();
    assert_eq!(heights.dim(), (4, 3));
    assert!(
        heights
            .indexed_iter()
            .all(|((i, j), height)| { (height - heights[[0, 0]] - (i + 4 * j) as f64).abs() < 1e-12 })
    );
    let prefixed =
        list(&datums(12)).replace("<D", "<p:D").replace("</D", "</p:D").replacen("<p:Datum", "<!-- < --> <p:Datum", 1);
    let spaced = list(&datums(12)).replace("Datum>", "Datum >").replace("DataList>", "DataList\n >");
    for other in [prefixed, spaced] {
        assert_eq!(of(&other).unwrap().problem().loaded_by(), plain.problem().loaded_by());
    }
    for empty in ["<Datum/>", "<Datum />", "<Datum></Datum>", "<Datum> </Datum>", "<Datum>nan</Datum>"] {
        let case = of(&list(&datums(12).replace("<Datum>7.5e-3</Datum>", empty))).unwrap();
        assert!(doubts(&case).contains("1 of 12 places"), "{empty}: {}", doubts(&case));
    }
    let comment = "<!-- <DataList> --><DataList></DataList>";
    for (told, words) in [
        (of(&list(&datums(11))), "ends before the data"),
        (of(&list(&datums(13))), "more heights than its main.xml states"),
        (of(&list(&datums(12).replace("3.5e-3", "3;5"))), "one of its heights is no number"),
        (of(&list(&datums(12).replace("3.5e-3", "<b/>"))), "something else"),
        (of(&list(&datums(12).replacen("</Datum>", "</Data>", 1))), "something else"),
        (of(&list(&(datums(12) + "<!-- "))), "something else"),
        (of(&list(&(datums(12) + "and"))), "something else"),
        (of("<DataList/>"), "ends before the data"),
        (of(comment), "no XML"),
        (of(&format!("{0}{0}", list(&datums(12)))), "something else"),
        (of(&format!("{}<DataList/>", list(&datums(12)))), "an element DataList of its main.xml twice"),
        (of("<DataList>"), "no XML"),
        (of(""), "names no file of them"),
        (of(&(list(&datums(12)) + "<DataLink><PointDataLink>a</PointDataLink></DataLink>")), "its heights twice"),
        (of(&(list(&datums(12)) + &" ".repeat(1 << 17))), "at most 65536 belong there"),
    ] {
        let told = told.map(|_| ()).unwrap_err();
        assert!(told.contains(words), "{words}: {told}");
    }
    // More than the rest of a main.xml may have.
    let many = main_with(&list(&(0..300 * 200).map(|k| format!("<Datum>{}e-9</Datum>", k % 7)).collect::<String>()))
        .replace("<SizeX>4<", "<SizeX>300<")
        .replace("<SizeY>3<", "<SizeY>200<");
    let case = read("a.x3p", zip(&[("main.xml", many.as_bytes(), None)]), "").unwrap();
    assert_eq!(case.problem().topography().unwrap().points(), [300, 200]);
}

#[test]
fn what_an_x3p_file_has_twice_or_changed_is_refused() {
    let data: Vec<u8> = (0..12u8).flat_map(|k| i16::from(k).to_le_bytes()).collect();
    let main = main_xml(["4", "3", "1"], "I");
    let sum = |content: &[u8]| format!("{:X}", md5::compute(content));
    let stated = |md5: &str| {
        let md5 = format!("</PointDataLink><MD5ChecksumPointData>{md5}</MD5ChecksumPointData>");
        main.replace("</PointDataLink>", &md5)
    };
    let of = |main: &str, more: &[(&str, &[u8])]| {
        let files = [("main.xml", main.as_bytes(), None), ("bindata/data.bin", &data[..], None)];
        let more = more.iter().map(|(name, content)| (*name, *content, None));
        read("a.x3p", zip(&files.into_iter().chain(more).collect::<Vec<_>>()), "")
    };
    let of_main = sum(main.as_bytes()) + " *main.xml\n";
    let of_data = sum(&data) + " *bindata/data.bin\n";
    let others = sum(b"another");
    for (main, more) in [
        (&stated(&sum(&data)), &[][..]),
        (&stated("not computed"), &[]),
        (&main, &[("md5checksum.hex", of_main.as_bytes())]),
        (&main, &[("md5checksum.hex", &b"none"[..])]),
        // The checksum of another member, as SurfaceTopography writes it.
        (&main, &[("md5checksum.hex", of_data.as_bytes())]),
        (&main, &[("another.hex", others.as_bytes())]),
        (&main, &[("__MACOSX/main.xml", &b"a"[..]), ("._main.xml", b"b"), ("domain.xml", b"c")]),
    ] {
        assert!(of(main, more).is_ok(), "{more:?}");
    }
    let valid = main.replace(
        "</PointDataLink>",
        "</PointDataLink><ValidPointsLink>v</ValidPointsLink><MD5ChecksumValidPoints>VV</MD5ChecksumValidPoints>",
    );
    assert!(of(&valid.replace("VV", &sum(&[255, 15])), &[("v", &[255, 15])]).is_ok());
    let named = main.replace("</Record3>", "</Record3><Record4><ChecksumFile>a.hex</ChecksumFile></Record4>");
    for (told, words) in [
        (of(&stated(&others), &[]), "another checksum"),
        (of(&valid.replace("VV", &others), &[("v", &[255, 15])]), "another checksum"),
        (of(&main, &[("md5checksum.hex", others.as_bytes())]), "another checksum"),
        (of(&named, &[("a.hex", of_main.as_bytes())]), "another checksum"),
        (of(&main, &[("main.xml", main.as_bytes())]), "a member of its zip twice"),
        (of(&main, &[("bindata/data.bin", &data)]), "a member of its zip twice"),
        (of(&main, &[("copy/main.xml", main.as_bytes())]), "is a zip with 2 files main.xml"),
        (
            of(&main.replacen("<SizeX>4</SizeX>", "<SizeX>4</SizeX><SizeX>4</SizeX>", 1), &[]),
            "an element SizeX of its main.xml twice",
        ),
        (of(&main.replacen("<Record3>", "<Record3/><Record3>", 1), &[]), "an element Record3 of its main.xml twice"),
        (of(&main.replacen("<Increment>", "<Increment>2</Increment><Increment>", 1), &[]), "an element Increment"),
    ] {
        let told = told.map(|_| ()).unwrap_err();
        assert!(told.contains(words), "{words}: {told}");
    }
    let twice = |name: &[u8]| {
        let content = stored("two_heights.gwy");
        let at = content.windows(name.len()).position(|window| window == b"/2/data\0o").unwrap();
        read("a.gwy", put(content, at, name), "channel = 1\nscale = 1").map(|_| ()).unwrap_err()
    };
    assert!(twice(b"/1/data\0o").contains("twice"));
    let asc = String::from_utf8(stored("grid.asc")).unwrap();
    let told = read("a.asc", format!("ncols 24\n{asc}").into_bytes(), "unit = \"µm\"").map(|_| ()).unwrap_err();
    assert!(told.contains("a value of its header twice"), "{told}");
}

/// Increments are metres; those in micrometres are named, along the sides and upward.
#[test]
fn an_increment_that_can_hardly_be_metres_is_named() {
    let data: Vec<u8> = (0..12u8).flat_map(|k| i16::from(k * k).to_le_bytes()).collect();
    let of = |increments: [&str; 3]| {
        let main = main_xml(["4", "3", "1"], "I");
        let parts: Vec<&str> = main.split("1e-6").collect();
        let main: String = parts
            .iter()
            .zip(increments.iter().chain([&""]))
            .flat_map(|(part, increment)| [*part, *increment])
            .collect();
        doubts(
            &read("a.x3p", zip(&[("main.xml", main.as_bytes(), None), ("bindata/data.bin", &data, None)]), "").unwrap(),
        )
    };
    assert!(!of(["1e-6", "2e-6", "1e-8"]).contains("increment"));
    let told = of(["0.5", "0.5", "1e-8"]);
    assert!(told.contains("its samples stand 0.50000 m apart along x, and it is 2.0000 × 1.5000 m large"), "{told}");
    let told = of(["1e-3", "0.02", "1e-8"]);
    assert!(told.contains("its samples stand 0.020000 m apart along y"), "{told}");
    let told = of(["5e-14", "5e-14", "1e-15"]);
    assert!(told.contains("5.0000e-14 m apart along x"), "{told}");
    let told = of(["1e-6", "1e-6", "0.01"]);
    assert!(told.contains("its heights range over 1.2100 m, and it is 4.0000e-6 × 3.0000e-6 m large"), "{told}");
    let sdf = put(put(stored("binary.sdf"), 46, &0.5f64.to_le_bytes()), 54, &0.5f64.to_le_bytes());
    let told = doubts(&read("a.sdf", sdf, "").unwrap());
    assert!(told.contains("0.50000 m apart along x"), "{told}");
}

#[test]
fn a_zip_is_read_as_it_was_packed_or_refused() {
    let data: Vec<u8> = (0..12u8).flat_map(|k| i16::from(k).to_le_bytes()).collect();
    let main = main_xml(["4", "3", "1"], "I");
    let of = |method: u8, data: &[u8], stated: Option<u32>| {
        packed_by(method, &[("main.xml", main.as_bytes(), None), ("bindata/data.bin", data, stated)])
    };
    assert!(read("a.x3p", of(0, &data, None), "").is_ok());
    // A stored file is not longer than it says.
    let told = read("a.x3p", of(0, &vec![0; 8 << 20], Some(24)), "").unwrap_err();
    assert!(told.contains("stored with another size"), "{told}");
    for method in [0, 8] {
        let mut changed = of(method, &data, None);
        // The data ends where the directory begins.
        let directory = changed.windows(4).position(|window| window == b"PK\x01\x02").unwrap();
        changed[directory - 5] ^= 1;
        let told = read("a.x3p", changed, "").unwrap_err();
        assert!(told.contains("another checksum") || method == 8 && told.contains("is damaged"), "{told}");
    }
}

#[test]
fn form_holes_and_short_waves_are_treated_in_their_order() {
    let of = |surface: &str| {
        let case = read("doubles.x3p", stored("doubles.x3p"), surface).unwrap_or_else(|error| panic!("{error}"));
        let stages = case.surface.as_ref().unwrap().stages.clone();
        (case, stages)
    };
    let (case, stages) = of("form = \"second order\"\ncutoff = 2000\nwindow = true");
    assert!(matches!(
        stages.iter().map(|stage| stage.treated).collect::<Vec<_>>()[..],
        [
            Treated::AsRead,
            Treated::WithoutForm { radius: None, .. },
            Treated::Filled { .. },
            Treated::Smoothed { is_periodic: false, .. }
        ]
    ));
    let heights: Vec<f64> = stages.iter().map(|stage| stage.rms.height).collect();
    assert!(heights[0] > 150.0 && heights[1] < 40.0 && heights[3] < 0.8 * heights[2], "{heights:?}");
    assert!(stages[3].rms.slope < 0.5 * stages[2].rms.slope);
    assert!(case.to_toml().contains("form = \"second order\"") && case.to_toml().contains("cutoff = 2000"));
    let (_, stages) = of("form = \"plane\"\ncutoff = 2000");
    assert!(matches!(stages[3].treated, Treated::Smoothed { is_periodic: true, .. }));
    // Two names of one form.
    let heights = |surface: &str| of(surface).0.problem().topography().unwrap().heights().to_owned();
    assert_eq!(heights("level = true"), heights("form = \"plane\""));
    let refused = |surface: &str| read("doubles.x3p", stored("doubles.x3p"), surface).unwrap_err();
    for (surface, words) in [
        ("level = true\nform = \"sphere\"", "`surface.level` subtracts the mean plane"),
        ("level = false\nform = \"plane\"", "`surface.level` keeps the mean plane"),
        ("form = \"ball\"", "\"sphere\""),
        ("cutoff = 1500", "from two samples, 1600.0, to its shorter side, 12000"),
        ("cutoff = 13000", "to its shorter side"),
        ("cutoff = -1", "`surface.cutoff`"),
    ] {
        assert!(refused(surface).contains(words), "{surface}: {}", refused(surface));
    }
    let half: String = (0..20).map(|k| if k % 5 < 3 { "nan 1 nan 2\n" } else { "nan nan 4 nan\n" }).collect();
    let told = read("a.txt", half.into_bytes(), "period = 1").unwrap_err();
    assert!(told.contains("have no measurement; at most half of them"), "{told}");
}
