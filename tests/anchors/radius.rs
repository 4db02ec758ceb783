//! Contact radius between the samples: how fast it converges, wherever the indenter stands on the grid.

use super::isolated::{alone, power_law};
use super::series::{System, TRIANGULAR, Term, paraboloid};
use super::support::{Coating, Steps, homogeneous, relative};
use percoat::indenter::{Level, Shape};
use percoat::lattice::{Cell, Lattice};
use percoat::texture::Surface;

#[test]
fn the_radius_converges_faster_than_the_spacing_wherever_the_site_stands() {
    // a/l = 0.1 on the hexagonal lattice, where the series of the images is exact to 1e-6.
    let radius = 0.1;
    let exact = System::single(1.0, TRIANGULAR, vec![paraboloid(0.8)]).contacts(&[radius])[0];
    let cell = Cell::hexagonal(1.0).unwrap();
    // Site in spacings from a sample.
    let shifts = [[0.37, 0.21], [0.5, 0.5], [0.13, 0.77]];
    let worst: Vec<f64> = [100, 200, 400, 800]
        .into_iter()
        .map(|points| {
            let errors = shifts.iter().map(|shift| {
                let site = shift.map(|x| 0.5 + x / points as f64);
                let surface = Surface::Indenters {
                    lattice: Lattice::new(cell, vec![vec![site]]).unwrap(),
                    levels: vec![Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0).unwrap()],
                };
                let found = Steps::new(&surface, &homogeneous(), [points; 2]).loaded(exact.load / cell.area());
                (found.levels[0].contact_radius.unwrap() / radius - 1.0).abs()
            });
            errors.fold(0.0, f64::max)
        })
        .collect();
    let order = (worst[0] / worst[3]).log2() / 3.0;
    println!("worst errors of the radius at 10, 20, 40, 80 samples per radius: {worst:?}, order {order:.2}");
    assert!(worst[1] < 5e-4, "error {:.1e} at 20 samples per radius", worst[1]);
    assert!(order > 1.5, "order {order:.2}, errors {worst:?}");
}

#[test]

fn cones_and_power_laws_have_their_radius_too() {
    // Contact radius 1 on the half-space; counting samples errs by 1 % at 20 samples per radius.
    for (samples, tolerance) in [(10, 1e-2), (20, 1e-3), (40, 3e-4)] {
        for exponent in [1.0, 1.5, 3.0, 4.0] {
            let shape = Shape::Power { coefficient: 0.1, exponent };
            let (_, found, _) = power_law(shape, Term { coefficient: 0.1, exponent }, samples);
            let what = format!("radius, n = {exponent}, {samples} samples");
            relative(&what, found.levels[0].contact_radius.unwrap(), 1.0, tolerance);
        }
    }
}

#[test]

fn a_contact_wider_than_its_soft_coating_is_thick_has_its_radius() {
    // Load of the contact of radius 2 on a coating of thickness 1 under a paraboloid of radius 1: integral equation of
    // the coated contact.
    let coating = Coating { chi: 0.5, poisson: [0.45, 0.3], thickness: 1.0 };
    let (found, _) = alone(&coating, 9.8112764528, 2.0, 40.0, 400);
    relative("radius", found.contact_radius.unwrap(), 2.0, 1e-3);
}
