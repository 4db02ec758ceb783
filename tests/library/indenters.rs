//! One indenter of each shape that instruments have, alone on a bare half-space, by the whole solver: against Sneddon's integrals
//! (Int. J. Eng. Sci. 3 (1965) 47) of slopes f′(r) that are written down here again,
//!
//! δ = a ∫₀ᵃ f′(r)/√(a² − r²) dr,  P = 2E* ∫₀ᵃ r² f′(r)/√(a² − r²) dr.

#![cfg(feature = "cli")]

use percoat::case::{Case, Document, IdentificationTask, Source, foreseen, plausibility};
use percoat::identification::Measurement;
use percoat::measurements::Curves;
use percoat::{Load, Settings, Solver};
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::ControlFlow;
use std::sync::Arc;

const POINTS: usize = 128;

/// δ and P/E* by the midpoint rule over r = a sin θ.
fn sneddon(a: f64, slope: impl Fn(f64) -> f64) -> [f64; 2] {
    let count = 100_000;
    let step = FRAC_PI_2 / f64::from(count);
    let terms = (0..count).map(|k| {
        let sine = ((f64::from(k) + 0.5) * step).sin();
        let slope = slope(a * sine) * step;
        [a * slope, 2.0 * a * a * sine * sine * slope]
    });
    terms.fold([0.0; 2], |sum, term| [sum[0] + term[0], sum[1] + term[1]])
}

/// A sphere of the radius R up to r = R cos α, and from there on a flank at the angle α to the axis.
fn sphero_cone(radius: f64, degrees: f64) -> impl Fn(f64) -> f64 {
    let angle = degrees.to_radians();
    move |r| if r < radius * angle.cos() { r / (radius * radius - r * r).sqrt() } else { angle.tan().recip() }
}

/// Case of a level in a window that its contact of the radius a fills by three quarters; in µm and GPa.
fn case(level: &str, a: f64, files: &[(&str, &str)], more: &str) -> Result<Case, String> {
    Case::read(&source(level, a, files, more), &[]).map_err(|error| error.to_string())
}

fn source(level: &str, a: f64, files: &[(&str, &str)], more: &str) -> Source {
    let text = format!(
        "lattice = {{ kind = \"isolated\", size = {} }}\nlevels = [{{ {level} }}]\nsubstrate = {{ young = 100.0, poisson = 0.3 }}\n\
         load = {{ force = 1.0 }}\ngrid = {{ points = {POINTS} }}\n{more}",
        2.7 * a
    );
    let bytes = |text: &str| -> Arc<[u8]> { text.as_bytes().into() };
    let files = files.iter().map(|(name, text)| ((*name).to_owned(), bytes(text))).collect();
    Source { name: "tip".to_owned(), text, files, ..Source::default() }
}

const UNITS: &str = "units = { length = \"µm\", pressure = \"GPa\" }\n";

/// Solves the force of a contact of the radius a, and compares radius and penetration.
fn is_sneddons(level: &str, a: f64, files: &[(&str, &str)], slope: impl Fn(f64) -> f64, tolerance: f64) {
    let case = case(level, a, files, UNITS).unwrap();
    let [penetration, force] = sneddon(a, slope);
    let force = force * 100.0 / (1.0 - 0.09);
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    let step = Solver::new(case.problem().as_ref().clone(), [POINTS; 2], settings).unwrap().solve(Load::Force(force));
    assert!(step.report.stop.solved(), "{level}: {}", step.report);
    let reading = step.reading();
    let radius = reading.levels[0].contact_radius.unwrap();
    for (found, known) in [(radius, a), (reading.penetration, penetration)] {
        assert!((found / known - 1.0).abs() < tolerance, "{level} at {a}: {found}, {known}");
    }
    let stated = reading.errors.penetration.unwrap();
    assert!((reading.penetration - penetration).abs() < 3.0 * stated, "{level}: {stated}");
    assert_eq!(reading.levels[0].singular(), level.contains("berkovich\"") && !level.contains("tip_radius"), "{level}");
}

/// Below the rim of the sphere, at it, and far beyond: 100 µm of a Rockwell diamond.
#[test]
fn a_rockwell_diamond_is_spherical_and_then_conical() {
    for a in [20.0, 100.0, 150.0, 900.0] {
        is_sneddons("shape = \"rockwell\"", a, &[], sphero_cone(200.0, 60.0), 1e-3);
    }
    is_sneddons("shape = \"sphero-cone\", radius = 0.4, half_angle = 70", 0.3, &[], sphero_cone(0.4, 70.0), 1e-3);
}

/// Equivalent half angles of Berkovich and Vickers, 70.3°, and of the cube corner, 42.28°, as they are tabulated.
#[test]
fn pyramids_are_the_cones_of_their_area() {
    for (level, a, slope) in [
        ("shape = \"berkovich\"", 0.3, sphero_cone(1e-9, 70.30)),
        ("shape = \"berkovich\", tip_radius = 0.1", 0.05, sphero_cone(0.1, 70.30)),
        ("shape = \"vickers\", tip_radius = 0.2", 0.3, sphero_cone(0.2, 70.30)),
        ("shape = \"cube-corner\", tip_radius = \"50 nm\"", 0.2, sphero_cone(0.05, 42.28)),
    ] {
        is_sneddons(level, a, &[], slope, 1.5e-3);
    }
}

/// The area A = 24.5 h² + 2h, by coefficients, by coefficients in nanometres, and by a table of it: r f′ = 2π r²/A′(h).
#[test]
fn a_measured_tip_is_the_profile_of_its_area() {
    let slope = |r: f64| {
        let h = (-1.0 + (1.0 + 24.5 * PI * r * r).sqrt()) / 24.5;
        2.0 * PI * r / (49.0 * h + 2.0)
    };
    let depths = (0..40).map(|k| 2.0 * 1.15f64.powi(k));
    let table: String = depths.map(|h| format!("{h};{}\n", 24.5 * h * h + 2000.0 * h)).collect();
    let file = [("tip.csv", &format!("Tip 3\nContact depth (nm);Area (nm²)\n0;0\n{table}")[..])];
    for area in [
        "{ coefficients = [24.5, 2.0], depths = [0.002, 0.5] }",
        "{ coefficients = [24.5, 2000], depths = [\"2 nm\", 0.5], unit = \"nm\" }",
        "\"tip.csv\"",
    ] {
        is_sneddons(&format!("shape = \"measured\", area = {area}"), 0.4, &file, slope, 1e-3);
    }
}

/// A curve of Sneddon's integrals, from far inside the sphere to far out on the cone, contains the modulus under a known tip, and the radius
/// of the tip on a known body. ln δ over ln P has a kink in its curvature at the rim, which the nodes of the curve smooth.
#[test]
fn a_curve_of_a_sphero_cone_contains_modulus_and_tip_radius() {
    let modulus = 100.0 / (1.0 - 0.09);
    let points = (0..16).map(|k| sneddon(30.0 * 1.2f64.powi(k), sphero_cone(200.0, 60.0)));
    let (penetrations, forces): (Vec<f64>, Vec<f64>) = points.map(|[depth, force]| (depth, force * modulus)).unzip();
    let measured = Curves::Loading(Measurement::new(forces, penetrations, None).unwrap());
    for (level, free, start, known) in [
        ("shape = \"rockwell\"", "substrate.young", "substrate.young=60", 100.0),
        ("shape = \"rockwell\"", "levels.0.tip_radius", "levels.0.tip_radius=150", 200.0),
        (
            "shape = \"sphero-cone\", radius = 200, half_angle = 60",
            "levels.0.half_angle",
            "levels.0.half_angle=66",
            60.0,
        ),
    ] {
        let source = source(level, 200.0, &[], UNITS);
        let coarse = [start.to_owned(), "grid.points=48".to_owned()];
        let document = Document::new(&source, &coarse).unwrap();
        let case = document.case().unwrap();
        let task = IdentificationTask::new(&document, &case, &[free.to_owned()]).unwrap();
        let (found, best) = task.find(&measured, &mut |_| ControlFlow::Continue(())).unwrap();
        let value = found.estimates()[0].value;
        assert!((value / known - 1.0).abs() < 2e-3, "{free}: {value}, {known}");
        assert!(best.to_toml().contains("half_angle") == (free == "levels.0.half_angle"));
    }
}

/// A warning names pyramids and measured tips, which are taken as round, and another one flanks that are too steep for small strains.
#[test]
fn what_is_assumed_of_a_tip_is_told() {
    let told = |level: &str| {
        let case = case(level, 1.0, &[], UNITS).unwrap();
        let all: Vec<String> = plausibility::of_case(&case).into_iter().chain(foreseen(&case, &[])).collect();
        all.join("\n")
    };
    assert!(!told("shape = \"rockwell\"").contains("taken as round"));
    let berkovich = told("shape = \"berkovich\", tip_radius = 0.1");
    assert_eq!(berkovich.matches("taken as round").count(), 1, "{berkovich}");
    assert!(berkovich.contains("levels[0] (berkovich, half angle 70.30°)"), "{berkovich}");
    let corner = told("shape = \"cube-corner\"");
    assert!(corner.contains("levels[0].shape = \"cube-corner\", of the slope 1.09"), "{corner}");
    let measured = told("shape = \"measured\", area = { coefficients = [24.5, 2.0], depths = [0.002, 0.5] }");
    assert!(measured.contains("levels[0] (measured): taken as round"), "{measured}");
}

/// The 0.2 mm of a Rockwell diamond are those of the unit of the case, and are written into it.
#[test]
fn a_rockwell_diamond_needs_a_unit_or_a_radius() {
    let radius = |units: &str| {
        let case = case("shape = \"rockwell\"", 100.0, &[], &format!("units = {{ length = \"{units}\" }}\n")).unwrap();
        case.levels[0].tip_radius
    };
    assert_eq!([radius("mm"), radius("µm"), radius("nm")], [Some(0.2), Some(200.0), Some(2e5)]);
    let refused = case("shape = \"rockwell\"", 100.0, &[], "").unwrap_err();
    assert!(refused.contains("`levels[0].tip_radius` is missing") && refused.contains("0.2 mm"), "{refused}");
    let given = case("shape = \"rockwell\", tip_radius = 20", 10.0, &[], "").unwrap();
    assert!(given.to_toml().contains("tip_radius = 20"), "{}", given.to_toml());
}

/// A written case reads back equal, with its file by an absolute path or in memory.
#[test]
fn a_case_with_a_measured_tip_reads_back() {
    let file = [("tip.csv", "depth_nm,area_nm2\n10,2450\n100,245000\n")];
    let of = |level: &str| case(&format!("shape = \"measured\", {level}"), 0.1, &file, UNITS).unwrap();
    let coefficients = of("area = { coefficients = [24.5, 2000], depths = [0.01, 0.2], unit = \"nm\" }");
    let source = Source { name: "again".to_owned(), text: coefficients.to_toml(), ..Source::default() };
    assert_eq!(Case::read(&source, &[]).unwrap(), coefficients);
    let stored = of("area = \"tip.csv\"");
    assert!(stored.to_toml().contains("area = \"tip.csv\""), "{}", stored.to_toml());
    let missing = case("shape = \"measured\", area = \"none.csv\"", 0.1, &[], UNITS).unwrap_err();
    assert!(missing.contains("`levels[0].area`: cannot read") && missing.contains("depth_nm,area_nm2"), "{missing}");
    let falling = [("tip.csv", "depth_nm,area_nm2\n10,2450\n100,245\n")];
    let falling = case("shape = \"measured\", area = \"tip.csv\"", 0.1, &falling, UNITS).unwrap_err();
    assert!(falling.contains("tip.csv: line 3: depths and areas of a tip must be above 0 and rise"), "{falling}");
}
