//! Limit loads under a sliding sphere, as [`percoat_core::run::Run::limits`] finds them, against closed forms.
//!
//! A paraboloid on a wide lattice slides without influence on its pressure. Strengths are those with which the closed form
//! fails at a/l = 0.1, where the contact has a known number of samples; the run begins at a part of that load. What the
//! images' first terms add ([`exact::sliding_sphere`](crate::exact::sliding_sphere)) is in the closed form.

use super::draw::{self, curve, linear};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::galin::{Contact, paraboloid};
use crate::exact::lattice_sums::TRIANGULAR;
use crate::exact::sliding_sphere::{Stress, images, mises, stresses, together, trailing_tension};
use crate::exact::{Sums, System};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{HalfSpace, Interface, InterfaceStrength, Layer, Material, MeanStress, Strength};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::friction::Friction;
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::reading::Criterion;
use percoat_core::run::{At, Limit, Run, Sampling, StressRequest};

pub const STUDY: Study = Study {
    name: "limit",
    title: "Limit loads under a sliding sphere: yield, cracking, residual stress, delamination",
    files: &["bare.data.csv", "coated.data.csv", "figure.png"],
    run: || run(&WHOLE),
    quick: Some(|| run(&QUICK)),
};

const YIELD: &str = include_str!("yield.csv");
const TENSION: &str = include_str!("tension.csv");
const SWITCH: &str = include_str!("switch.csv");
const POISSON: f64 = 0.3;
/// Contact radius over period at failure, and samples along it.
const RADIUS: f64 = 0.1;
const SAMPLES: f64 = 20.0;
/// Thickness of a layer of the substrate's own material, over a, where it lies deeper than what fails.
const THICK: f64 = 1.5;
/// Residual stress over the strength.
const RESIDUAL: [f64; 2] = [-0.3, 0.3];
/// Depth of an interface over a, and its strength under shear over that under tension.
const INTERFACES: [f64; 2] = [0.3, 0.8];
const SHEAR: f64 = 5.0;
/// Load over that of failure from which a run begins.
const START: f64 = 0.8;
/// Bearing of the sliding: along no lattice line.
const BEARING: f64 = 0.3;

/// The friction coefficients, residual stresses and interfaces for which limit loads are sought.
struct Points {
    /// Friction on the bare half-space; `None` for every one of the table.
    bare: Option<&'static [f64]>,
    /// Friction on the layer, residual stress over the strength, and depths of the interface over a.
    coated: &'static [(f64, &'static [f64], &'static [f64])],
}

const WHOLE: Points = Points { bare: None, coated: &[(0.0, &RESIDUAL, &INTERFACES), (0.5, &RESIDUAL, &INTERFACES)] };
/// Every place at which a half-space yields, and every criterion of a layer.
const QUICK: Points = Points { bare: Some(&[0.2, 0.5, 1.0]), coated: &[(0.0, &[0.3], &[]), (0.5, &[-0.3], &[0.8])] };

/// Paraboloids that slide on a half-space, at the load at which it shall fail.
struct Slider {
    system: System,
    material: Material,
    friction: f64,
}

impl Slider {
    fn new(friction: f64) -> Result<Self, StudyError> {
        let material = Material::from_young(1.0, POISSON)?;
        let system = System::single(material.contact_modulus(), TRIANGULAR, vec![paraboloid(1.0)]);
        Ok(Self { system, material, friction })
    }

    /// The contact of a radius over the period.
    fn contact(&self, radius: f64) -> Contact {
        self.system.contacts(&[radius])[0]
    }

    /// Stress over p₀ at a place over a, the images' first terms with it, under the contact of a radius over the period.
    fn stress(&self, radius: f64, place: [f64; 3]) -> Stress {
        let Sums([_, s3, _]) = TRIANGULAR;
        let scale = radius.powi(3) * s3;
        let isolated = together(stresses(POISSON, place), self.friction);
        let images = together(images(POISSON, place), self.friction);
        std::array::from_fn(|k| isolated[k] + scale * images[k])
    }

    /// The largest of a quantity of the stress over p₀ down to [`THICK`], by the plane y = 0.
    fn worst(&self, radius: f64, quantity: impl Fn(Stress) -> f64) -> f64 {
        largest([-2.0, 2.0], [0.0, THICK * RADIUS / radius], |[x, z]| quantity(self.stress(radius, [x, 0.0, z])))
    }

    /// The contact at which what grows with it, given the radius over the period and p₀, reaches 1.
    fn failing(&self, utilisation: impl Fn(f64, f64) -> f64) -> Contact {
        let [mut low, mut high] = [0.5 * RADIUS, 2.0 * RADIUS];
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if utilisation(middle, self.contact(middle).axis) < 1.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        self.contact(0.5 * (low + high))
    }

    /// The limit of a half-space by one of its criteria, from a part of the load of `exact` on.
    fn limit(&self, half_space: &HalfSpace, criterion: Criterion, exact: &Contact) -> Result<Found, StudyError> {
        let limits = self.limits(half_space.clone(), exact)?;
        self.found(&limits, criterion, exact)
    }

    /// All limits of a half-space.
    fn limits(&self, half_space: HalfSpace, exact: &Contact) -> Result<Vec<Limit>, StudyError> {
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0)?;
        let indenters = Indenters::new(Lattice::hexagonal(1.0, 1)?, vec![level])?;
        let friction = Friction::new(self.friction, [BEARING.cos(), BEARING.sin()])?.uncoupled();
        let problem = Problem::new(indenters, half_space).sliding(friction)?;
        let points = [(SAMPLES / RADIUS).round() as usize; 2];
        let load = Load::MeanPressure(START * exact.load / problem.cell().area());
        let mut run = Run::new(problem, vec![load], Sampling::Points(points));
        run.stress = Some(StressRequest { mean: MeanStress::HalfSpace, ..StressRequest::default() });
        let limits = run.limits(&mut ())?;
        if limits.converged() { Ok(limits.limits) } else { Err("a load was not solved".into()) }
    }

    /// The limit found by a criterion, against the contact that the closed form fails under.
    fn found(&self, limits: &[Limit], wanted: Criterion, exact: &Contact) -> Result<Found, StudyError> {
        let limit = limits.iter().find(|limit| limit.criterion == wanted).ok_or("a limit of each criterion")?;
        let At::Load { load: mean_pressure, error, position: [x, y, z], .. } = limit.at else {
            return Err(format!("{wanted}: {:?}", limit.at).into());
        };
        let cell = Cell::hexagonal(1.0)?;
        let contact = self.system.loaded(mean_pressure * cell.area(), RADIUS).ok_or("the series did not converge")?[0];
        let [x, y] = cell.reduced().nearest(cell.fractions([x, y]));
        let (s, c) = BEARING.sin_cos();
        Ok(Found {
            axis: contact.axis,
            exact: exact.axis,
            // p₀ grows as the third root of the load.
            stated: error.unwrap_or(f64::NAN) / (3.0 * mean_pressure),
            place: [c * x + s * y, c * y - s * x, z].map(|length| length / exact.radius),
        })
    }
}

/// A limit.
struct Found {
    /// p₀ there, and by the closed form.
    axis: f64,
    exact: f64,
    /// Stated relative error of p₀.
    stated: f64,
    /// The place that fails, over a, in the axes of the sliding.
    place: [f64; 3],
}

const EDGE: [f64; 3] = [-1.0, 0.0, 0.0];

fn run(points: &Points) -> Result<Outcome, StudyError> {
    let (bare, coated, at_rest) = (bare(points)?, coated(points)?, at_rest()?);
    let mut outcome = Outcome::default();
    let switches = Data::parse("switch", &numbers_only(SWITCH))?;
    let switches: Vec<[f64; 2]> =
        switches.rows.iter().filter(|row| row[0] == POISSON).map(|row| [row[3], row[4]]).collect();
    let [[to_edge, _], [to_contact, _]] = switches[..] else { return Err("two switches".into()) };
    let inside = |row: &&Vec<f64>| row[0] < to_edge;
    let edge = |row: &&Vec<f64>| to_edge < row[0] && row[0] < to_contact;
    let within = |row: &&Vec<f64>| to_contact < row[0];
    let rows = || bare.rows.iter();
    // A relative error over the stated one.
    let over = |value: f64, exact: f64, stated: f64| ((value / exact - 1.0).abs() / stated, 0.0);
    // The search knows a load to 10⁻³; inside, a stress errs by about 10⁻⁴.
    let checks = [
        Check::worst(
            "p₀/Y at yield inside the body, μ = 0 to 0.3",
            rows().filter(inside).map(|row| (row[1], row[2])),
            Tolerance::Relative(5e-4),
        ),
        Check::worst(
            "p₀/Y at yield in contact, μ = 1",
            rows().filter(within).map(|row| (row[1], row[2])),
            Tolerance::Relative(5e-4),
        ),
        Check::worst(
            "p₀/Y at yield at the trailing edge, μ = 0.32 to 0.7",
            rows().filter(edge).map(|row| (row[1], row[2])),
            Tolerance::Relative(1e-2),
        ),
        Check::worst(
            "p₀/Y at yield, error over the stated one",
            rows().map(|row| over(row[1], row[2], row[3])),
            Tolerance::Absolute(1.0),
        ),
        Check::worst("p₀/σ_t at cracking, μ = 0 to 1", rows().map(|row| (row[10], row[11])), Tolerance::Relative(1e-2)),
        Check::worst(
            "p₀/σ_t at cracking, error over the stated one",
            rows().map(|row| over(row[10], row[11], row[12])),
            Tolerance::Absolute(1.0),
        ),
        Check::worst(
            "place of yield below the surface, off the closed form's over the spacing",
            rows().filter(inside).map(|row| (off(row) * SAMPLES, 0.0)),
            Tolerance::Absolute(0.5),
        ),
        Check::worst(
            "place of yield at the trailing edge and in contact, off the closed form's over the spacing",
            rows().filter(|row| !inside(row)).map(|row| (off(row) * SAMPLES, 0.0)),
            Tolerance::Absolute(1.0),
        ),
        Check::worst(
            "place of cracking, off the trailing edge over the spacing",
            rows()
                .filter(|row| row[0] > 0.0)
                .map(|row| (((row[13] + 1.0).powi(2) + row[14].powi(2) + row[15].powi(2)).sqrt() * SAMPLES, 0.0)),
            Tolerance::Absolute(1.0),
        ),
        Check::absolute("limits by residual stress that is the strength", at_rest, 0.0, 0.0),
    ];
    outcome.checks.extend(checks);
    let of = |criterion: f64| coated.rows.iter().filter(move |row| row[2] == criterion);
    outcome.checks.push(Check::worst(
        "p₀ at yield with residual stress ∓0.3 Y",
        of(0.0).map(|row| (row[3], row[4])),
        Tolerance::Relative(5e-4),
    ));
    outcome.checks.push(Check::worst(
        "p₀ at cracking with residual stress, μ = 0 and 0.5, error over the stated one",
        of(1.0).map(|row| over(row[3], row[4], row[5])),
        Tolerance::Absolute(1.0),
    ));
    outcome.checks.push(Check::worst(
        "p₀ at delamination, interface at 0.3a and 0.8a",
        of(2.0).map(|row| (row[3], row[4])),
        Tolerance::Relative(1e-3),
    ));
    let tabulated =
        Data::parse("yield", YIELD)?.rows.into_iter().filter(|row| row[0] == POISSON).map(|row| [row[1], row[2]]);
    let mut yields: Vec<[f64; 2]> = tabulated.chain(switches).map(|[mu, stress]| [mu, 1.0 / stress]).collect();
    yields.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let cracks = linear(0.0, 1.0, 101).into_iter().map(|mu| [mu, 1.0 / trailing_tension(POISSON, mu)]).collect();
    outcome.figures.push(("figure", figure(&bare, [yields, cracks])));
    outcome.data = vec![bare, coated];
    Ok(outcome)
}

/// How far the place of yield is off the closed form's, over a.
fn off(row: &[f64]) -> f64 {
    [4, 6, 8].into_iter().map(|k| (row[k] - row[k + 1]).powi(2)).sum::<f64>().sqrt()
}

/// The table of switches with its places as numbers.
fn numbers_only(text: &str) -> String {
    text.replace(",inside,edge,", ",0,1,").replace(",edge,contact,", ",1,2,")
}

/// Limits of a bare half-space with a yield and a tensile strength, without friction to much.
fn bare(points: &Points) -> Result<Data, StudyError> {
    let columns = [
        "mu",
        "yield",
        "yield_exact",
        "yield_stated",
        "x",
        "x_exact",
        "y",
        "y_exact",
        "z",
        "z_exact",
        "cracking",
        "cracking_exact",
        "cracking_stated",
        "cracking_x",
        "cracking_y",
        "cracking_z",
    ];
    let mut data = Data::new("bare", &columns);
    let of_poisson = |table: Data| table.rows.into_iter().filter(|row| row[0] == POISSON);
    let tensions = of_poisson(Data::parse("tension", TENSION)?);
    let wanted = |mu: f64| points.bare.is_none_or(|frictions| frictions.contains(&mu));
    let rows = of_poisson(Data::parse("yield", YIELD)?).zip(tensions).filter(|(worst, _)| wanted(worst[1]));
    for (worst, tension) in rows {
        let slider = Slider::new(worst[1])?;
        let [yielding, tensile] = [worst[2], tension[2]].map(|stress| stress * slider.contact(RADIUS).axis);
        let place @ [x, y, z] = [worst[3], worst[4], worst[5]];
        let strength = Strength { yielding: Some(yielding), tensile: Some(tensile) };
        let half_space = HalfSpace::new(vec![], slider.material).with_substrate_strength(strength)?;
        let yields = slider.failing(|radius, axis| mises(slider.stress(radius, place)) * axis / yielding);
        let cracks = slider.failing(|radius, axis| slider.stress(radius, EDGE)[0] * axis / tensile);
        let limits = slider.limits(half_space, &yields)?;
        let found = slider.found(&limits, Criterion::yield_of(1), &yields)?;
        let mut row = vec![worst[1], found.axis / yielding, found.exact / yielding, found.stated];
        row.extend([found.place[0], x, found.place[1], y, found.place[2], z]);
        let found = slider.found(&limits, Criterion::cracking_of(1), &cracks)?;
        row.extend([found.axis / tensile, found.exact / tensile, found.stated]);
        row.extend(found.place);
        data.rows.push(row);
    }
    Ok(data)
}

/// A layer of the substrate's own material and the residual stress and strengths given, `thickness` over a.
fn layered(
    material: Material,
    thickness: f64,
    residual: f64,
    strength: Strength,
    interface: InterfaceStrength,
) -> Result<HalfSpace, StudyError> {
    let layer = Layer::new(material, thickness * RADIUS, Interface::Bonded)?
        .with_residual_stress(residual)?
        .with_strengths(strength, interface)?;
    Ok(HalfSpace::new(vec![layer], material))
}

/// Limits of a layer of the substrate's own material, whose closed forms are those of the half-space.
fn coated(points: &Points) -> Result<Data, StudyError> {
    // Criteria: 0 yield, 1 cracking, 2 delamination.
    let mut data = Data::new("coated", &["mu", "residual", "criterion", "p0", "p0_exact", "stated", "interface"]);
    for &(mu, residual, interfaces) in points.coated {
        let slider = Slider::new(mu)?;
        let unit = slider.contact(RADIUS).axis;
        let row = |part: f64, criterion: f64, found: &Found, deep: f64| {
            vec![mu, part, criterion, found.axis / unit, found.exact / unit, found.stated, deep]
        };
        for &part in residual {
            if mu == 0.0 {
                let strength = slider.worst(RADIUS, mises) * unit / (1.0 - part);
                let exact = slider.failing(|radius, axis| {
                    let with_residual = |stress: Stress| {
                        let mut whole = stress.map(|part| part * axis / strength);
                        whole[..2].iter_mut().for_each(|lateral| *lateral += part);
                        mises(whole)
                    };
                    slider.worst(radius, with_residual)
                });
                let bears = Strength { yielding: Some(strength), tensile: None };
                let half_space = layered(slider.material, THICK, part * strength, bears, InterfaceStrength::default())?;
                let found = slider.limit(&half_space, Criterion::yield_of(1), &exact)?;
                data.rows.push(row(part, 0.0, &found, 0.0));
            }
            let strength = slider.stress(RADIUS, EDGE)[0] * unit / (1.0 - part);
            let exact = slider.failing(|radius, axis| part + slider.stress(radius, EDGE)[0] * axis / strength);
            let bears = Strength { yielding: None, tensile: Some(strength) };
            let half_space = layered(slider.material, THICK, part * strength, bears, InterfaceStrength::default())?;
            let found = slider.limit(&half_space, Criterion::cracking_of(1), &exact)?;
            data.rows.push(row(part, 1.0, &found, 0.0));
        }
        for &deep in interfaces {
            // √(⟨σ_zz⟩² + (τ/5)²) over p₀: the strength under tension that it needs.
            let carried = |radius: f64| {
                let deep = deep * RADIUS / radius;
                largest([-2.0, 2.0], [0.0, 1.0], |[x, y]| {
                    let [_, _, zz, _, xz, yz] = slider.stress(radius, [x, y, deep]);
                    zz.max(0.0).hypot(xz.hypot(yz) / SHEAR)
                })
            };
            let normal = carried(RADIUS) * unit;
            let exact = slider.failing(|radius, axis| carried(radius) * axis / normal);
            let bears = InterfaceStrength { normal: Some(normal), shear: Some(SHEAR * normal), friction: 0.0 };
            let half_space = layered(slider.material, deep, 0.0, Strength::default(), bears)?;
            let found = slider.limit(&half_space, Criterion::delamination_of(1), &exact)?;
            data.rows.push(row(0.0, 2.0, &found, deep));
        }
    }
    Ok(data)
}

/// The largest limit load of two layers whose residual stress alone is the strength, by yield under pressure and by
/// cracking under tension.
fn at_rest() -> Result<f64, StudyError> {
    let slider = Slider::new(0.0)?;
    let exact = slider.contact(RADIUS);
    let [yielding, tensile] = [Some(exact.axis); 2];
    let mut largest = 0.0f64;
    for (residual, strength) in
        [(-exact.axis, Strength { yielding, tensile: None }), (exact.axis, Strength { yielding: None, tensile })]
    {
        let half_space = layered(slider.material, THICK, residual, strength, InterfaceStrength::default())?;
        let limits = slider.limits(half_space, &exact)?;
        largest = limits.iter().map(Limit::load).fold(largest, f64::max);
    }
    Ok(largest)
}

/// The largest value of a quantity between the ends of two ranges, by grids that shrink on it.
fn largest(x: [f64; 2], y: [f64; 2], value: impl Fn([f64; 2]) -> f64) -> f64 {
    let (mut ranges, mut counts) = ([x, y], [80, 40]);
    let (mut best, mut place) = (f64::NEG_INFINITY, [x[0], y[0]]);
    for _ in 0..6 {
        let steps: [f64; 2] = std::array::from_fn(|k| (ranges[k][1] - ranges[k][0]) / f64::from(counts[k]));
        for (i, j) in (0..=counts[0]).flat_map(|i| (0..=counts[1]).map(move |j| (i, j))) {
            let here = [ranges[0][0] + f64::from(i) * steps[0], ranges[1][0] + f64::from(j) * steps[1]];
            let found = value(here);
            if found > best {
                (best, place) = (found, here);
            }
        }
        let near =
            |k: usize, ends: [f64; 2]| [-1.0, 1.0].map(|side| (place[k] + side * steps[k]).clamp(ends[0], ends[1]));
        (ranges, counts) = ([near(0, x), near(1, y)], [8, 8]);
    }
    best
}

fn figure(bare: &Data, exact: [Vec<[f64; 2]>; 2]) -> Figure {
    let points = |x: &str, name: &str| -> Vec<[f64; 2]> {
        bare.column(x).into_iter().zip(bare.column(name)).map(|(x, y)| [x, y]).collect()
    };
    let error = |name: &str| -> Vec<[f64; 2]> {
        let pairs = points(name, &format!("{name}_exact"));
        bare.column("mu").into_iter().zip(pairs).map(|(mu, [value, exact])| [mu, (value / exact - 1.0).abs()]).collect()
    };
    let [yields, cracks] = exact;
    let limits = vec![
        curve("", Style::Line, 1, yields),
        curve("yield, p₀/Y", Style::Markers, 1, points("mu", "yield")),
        curve("", Style::Line, 2, cracks),
        curve("cracking, p₀/σ_t", Style::Markers, 2, points("mu", "cracking")),
    ];
    let errors = vec![
        curve("yield", Style::Markers, 1, error("yield")),
        curve("stated", Style::Dashed, 1, points("mu", "yield_stated")),
        curve("cracking", Style::Markers, 2, error("cracking")),
        curve("stated", Style::Dashed, 2, points("mu", "cracking_stated")),
    ];
    let chart =
        |title: &str, y: Axis, curves| Chart { title: title.to_owned(), x: Axis::linear("friction μ"), y, curves };
    let panels = vec![
        chart("Limit loads", Axis::log("p₀ over the strength"), limits),
        chart("Their errors", Axis::log("relative error of p₀"), errors),
    ];
    draw::figure(
        panels,
        "Lines: closed form, ν = 0.3; markers: the loads found, 20 samples a radius; dashed: the errors they state.",
    )
}
