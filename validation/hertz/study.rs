//! Hertz as the limit of a wide lattice, and of very thick and very thin coatings.
//!
//! Among its images a contact of the same load is smaller and its pressure higher than Hertz' by terms of the order
//! (a/l)³ (the image curvature PS₃/(2πE*)), and its penetration lacks the lift PS₁/(πE*) of the images. A coating much
//! thicker than the contact is a half-space of its own, a much thinner one leaves that of the substrate.

use super::draw::{self, curve, logarithmic, slope};
use super::steps::{Steps, case};
use super::{Check, Data, Outcome, Study, StudyError};
use crate::exact::galin::paraboloid;
use crate::exact::lattice_sums::TRIANGULAR;
use crate::exact::{CoatedContact, Coating, Hertz, System};
use percoat_app::picture::{Axis, Chart, Figure, Style};

pub const STUDY: Study = Study {
    name: "hertz",
    title: "Hertz as the limit of wide lattices and of thick and thin coatings",
    files: &["coating.data.csv", "figure.png", "lattice.data.csv"],
    run,
    quick: None,
};

const CASE: &str = include_str!("case.toml");
const RADIUS: f64 = 0.8;
/// Samples along a contact radius.
const SAMPLES: f64 = 40.0;

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let lattice = lattice(&mut outcome)?;
    let coating = coating(&mut outcome)?;
    outcome.figures.push(("figure", figure(&lattice, &coating)?));
    outcome.data = vec![lattice, coating];
    Ok(outcome)
}

/// Load of the contact of Hertz with radius a.
fn load(radius: f64, modulus: f64) -> f64 {
    4.0 / 3.0 * modulus * radius.powi(3) / RADIUS
}

/// Contacts among wider and wider spaced images.
fn lattice(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let mut data = Data::new(
        "lattice",
        &["a_over_l", "peak", "peak_hertz", "radius", "radius_hertz", "penetration", "penetration_hertz"],
    );
    for radius in [0.2, 0.16, 0.1, 0.08, 0.05] {
        let case = case("hertz", CASE, &[])?;
        let mut steps = Steps::of(&case, (SAMPLES / radius) as usize)?;
        let modulus = case.half_space().surface_material().contact_modulus();
        let load = load(radius, modulus);
        let found = steps.loaded(load / case.problem().cell().area())?;
        let hertz = Hertz::loaded(RADIUS, load, modulus);
        let lift = load * TRIANGULAR.0[0] / (std::f64::consts::PI * modulus);
        let contact_radius = found.levels[0].contact_radius.unwrap_or(f64::NAN);
        data.rows.push(vec![
            radius,
            found.max_pressure,
            hertz.peak,
            contact_radius,
            hertz.radius,
            found.penetration - lift,
            hertz.penetration,
        ]);
    }
    for (quantity, tolerance) in [("peak", 3e-4), ("radius", 3e-4), ("penetration", 3e-4)] {
        let [found, hertz] = [data.column(quantity), data.column(&format!("{quantity}_hertz"))];
        let name = if quantity == "penetration" { "penetration less the lift of the images" } else { quantity };
        outcome.checks.push(Check::relative(format!("a/l = 0.05: {name}, Hertz"), found[4], hertz[4], tolerance));
        if quantity == "peak" {
            let excess: Vec<f64> = found.iter().zip(&hertz).map(|(found, hertz)| found / hertz - 1.0).collect();
            outcome.checks.push(Check::order(
                "order in a/l of the peak's excess",
                (excess[0] / excess[4]).ln() / 4f64.ln(),
                3.0,
                0.2,
            ));
        }
    }
    Ok(data)
}

/// Peak pressure under one load on a hard coating from much thicker to much thinner than the contact.
fn coating(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let mut data = Data::new("coating", &["h_over_a", "peak", "peak_coating", "peak_substrate"]);
    let radius = 0.1;
    let (chi, nu) = (2.0, 0.3);
    for ratio in [100.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01] {
        let coating = Coating::new(chi, [nu, nu], ratio * radius)?;
        let layers = format!("layers=[{{ thickness = {}, shear_ratio = {chi}, poisson = {nu} }}]", ratio * radius);
        let case = case("hertz", CASE, &[layers])?;
        let mut steps = Steps::of(&case, (SAMPLES / radius) as usize)?;
        let substrate = case.half_space().material(2).contact_modulus();
        let load = load(radius, coating.modulus());
        let found = steps.loaded(load / case.problem().cell().area())?;
        let [hard, soft] = [coating.modulus(), substrate].map(|modulus| Hertz::loaded(RADIUS, load, modulus).peak);
        data.rows.push(vec![ratio, found.max_pressure, hard, soft]);
    }
    let found = data.column("peak");
    // Ten periods thick and ten thousandths of the radius thin: what is left are the images and the thickness itself.
    let images = |modulus: f64, load: f64| -> Result<f64, StudyError> {
        let contact = System::single(modulus, TRIANGULAR, vec![paraboloid(RADIUS)]).loaded(load, radius);
        Ok(contact.ok_or("the series did not converge")?[0].axis)
    };
    let coating = Coating::new(chi, [nu, nu], 1.0)?;
    let load = load(radius, coating.modulus());
    outcome.checks.push(Check::relative(
        "h/a = 100: peak, Hertz with E₁* among images",
        found[0],
        images(coating.modulus(), load)?,
        2e-4,
    ));
    let soft_modulus = coating.half_space().material(2).contact_modulus();
    let thin = found.last().copied().unwrap_or(f64::NAN);
    let soft_among_images = images(soft_modulus, load)?;
    outcome.checks.push(Check::relative(
        "h/a = 0.01: peak, Hertz with E₂* among images",
        thin,
        soft_among_images,
        1e-2,
    ));
    let excess = |index: usize| found[index] / soft_among_images - 1.0;
    let order = (excess(5) / excess(7)).ln() / 10f64.ln();
    outcome.checks.push(Check::order("order in h/a of the excess over E₂*, h/a = 0.1 to 0.01", order, 1.0, 0.2));
    Ok(data)
}

fn figure(lattice: &Data, coating: &Data) -> Result<Figure, StudyError> {
    let ratio = lattice.column("a_over_l");
    let excess = |quantity: &str| -> Vec<[f64; 2]> {
        let pairs = lattice.column(quantity).into_iter().zip(lattice.column(&format!("{quantity}_hertz")));
        ratio.iter().zip(pairs).map(|(&x, (found, hertz))| [x, (found / hertz - 1.0).abs()]).collect()
    };
    let peak = excess("peak");
    let left = Chart {
        title: "Wide lattices".to_owned(),
        x: Axis::log("contact radius over period a/l").from_to(0.01, 1.0),
        y: Axis::log("deviation from Hertz"),
        curves: vec![
            slope("slope 3", 3.0, 0, &peak),
            curve("peak pressure", Style::Markers, 1, peak),
            curve("contact radius", Style::Markers, 2, excess("radius")),
            curve("penetration less lift", Style::Markers, 3, excess("penetration")),
        ],
    };
    // Under the load P of the solved points the contact on a coating of thickness h has its own radius: both from the
    // integral equation at unit thickness, whose load scales with h².
    let mut alone = Vec::new();
    let unit = Coating::new(2.0, [0.3, 0.3], 1.0)?;
    let hertz = Hertz::loaded(1.0, 1.0, unit.modulus());
    for radius in logarithmic(0.01, 30.0, 60) {
        let contact = CoatedContact::new(&unit, radius).ok_or("singular")?;
        let scale = (contact.load / hertz.load).cbrt();
        alone.push([1.0 / (scale * hertz.radius), contact.peak / (scale * hertz.peak)]);
    }
    let points = coating.column("h_over_a").into_iter().zip(coating.column("peak")).zip(coating.column("peak_coating"));
    let limit = coating.rows.first().map_or(f64::NAN, |row| row[3] / row[2]);
    let right = Chart {
        title: "Thick and thin coatings, χ = 2".to_owned(),
        x: Axis::log("thickness over Hertz' radius h/a"),
        y: Axis::linear("peak over that on E₁*").from_to(0.55, 1.05),
        curves: vec![
            curve("integral equation", Style::Line, 0, alone),
            curve(
                "limits",
                Style::Dashed,
                2,
                [[0.01, limit], [100.0, limit], [f64::NAN; 2], [0.01, 1.0], [100.0, 1.0]],
            ),
            curve("solver", Style::Markers, 1, points.map(|((x, found), hard)| [x, found / hard])),
        ],
    };
    Ok(draw::figure(vec![left, right], "Left: contacts of one load against Hertz. Right: a/l = 0.1."))
}
