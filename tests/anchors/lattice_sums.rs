//! The operator's response to a localised pressure holds the lattice sums.
//!
//! A Gaussian pressure of load P and width s has the displacement (Taylor series of the periodic Green function
//! averaged over it)
//!
//! πE* w/P = √(π/2)/s + S₁ + S₃ s²/2 + 9 S₅ s⁴/8 + …
//!
//! at its centre, and without the first term at the sites of another sublattice. The polynomial in s² through several
//! widths gives S₁, S₃ and S₅.

use super::series::{Sums, TRIANGULAR, coated_triangular, moment};
use super::support::{Coating, absolute, homogeneous, relative};
use percoat::grid::Grid;
use percoat::lattice::Cell;
use percoat::layered::TransferFunction;
use percoat::material::{HalfSpace, Interface, Layer, Material};
use percoat::operator::Operator;
use std::f64::consts::PI;

/// Sums seen at the loaded site and at the site (⅓, ⅓) of the cell, from six widths s between `width` and twice
/// `width`.
fn measured(cell: Cell, points: usize, half_space: &HalfSpace, width: f64) -> [Sums; 2] {
    let grid = Grid::new(cell, [points, points]).unwrap();
    let mut operator = Operator::new(&grid, &TransferFunction::new(half_space));
    let modulus = half_space.surface_material().contact_modulus();
    let third = points / 3 * points + points / 3;
    let (mut squares, mut own, mut other) = (vec![], vec![], vec![]);
    for step in 0..6 {
        let s = width * (1.0 + 0.2 * f64::from(step));
        let pressure: Vec<f64> = (0..grid.len()).map(|index| gaussian(&grid, index, s)).collect();
        let mut displacement = vec![0.0; grid.len()];
        operator.displacement(&pressure, &mut displacement);
        squares.push(s * s);
        own.push(PI * modulus * displacement[0] - (0.5 * PI).sqrt() / s);
        other.push(PI * modulus * displacement[third]);
    }
    [own, other].map(|values| {
        let c = polynomial(&squares, &values);
        Sums([c[0], 2.0 * c[1], 8.0 / 9.0 * c[2]])
    })
}

/// exp(−r²/2s²)/(2πs²) summed over the nearest images of the origin.
fn gaussian(grid: &Grid, index: usize, s: f64) -> f64 {
    let [s1, s2] = grid.fractions(index);
    (-1..=1)
        .flat_map(|i| (-1..=1).map(move |j| (f64::from(i), f64::from(j))))
        .map(|(i, j)| {
            let [x, y] = grid.cell().point([s1 - 0.5 + i, s2 - 0.5 + j]);
            let [ox, oy] = grid.cell().point([0.5, 0.5]);
            (-0.5 * ((x + ox).powi(2) + (y + oy).powi(2)) / (s * s)).exp()
        })
        .sum::<f64>()
        / (2.0 * PI * s * s)
}

/// Coefficients of the polynomial through the points (x, y): divided differences, then Horner's scheme.
fn polynomial(x: &[f64], y: &[f64]) -> Vec<f64> {
    let mut differences = y.to_vec();
    for order in 1..x.len() {
        for i in (order..x.len()).rev() {
            differences[i] = (differences[i] - differences[i - 1]) / (x[i] - x[i - order]);
        }
    }
    let mut coefficients = vec![0.0; x.len()];
    for i in (0..x.len()).rev() {
        for k in (1..x.len()).rev() {
            coefficients[k] = coefficients[k - 1] - x[i] * coefficients[k];
        }
        coefficients[0] = differences[i] - x[i] * coefficients[0];
    }
    coefficients
}

#[test]
fn a_point_load_on_the_triangular_lattice_feels_its_epstein_zeta_sums() {
    let [Sums([s1, s3, s5]), _] = measured(Cell::hexagonal(1.0).unwrap(), 144, &homogeneous(), 0.025);
    let Sums([e1, e3, e5]) = TRIANGULAR;
    absolute("S1", s1, e1, 1e-9);
    relative("S3", s3, e3, 1e-9);
    relative("S5", s5, e5, 1e-4);
}

#[test]
fn a_point_load_on_the_square_lattice_feels_its_epstein_zeta_sums() {
    // 30-digit Epstein zeta sums.
    let [Sums([s1, s3, s5]), _] = measured(Cell::square(1.0).unwrap(), 144, &homogeneous(), 0.025);
    absolute("S1", s1, -3.900264920001955883, 1e-9);
    relative("S3", s3, 9.033621683100950306, 1e-9);
    relative("S5", s5, 5.090258233665482946, 1e-4);
}

#[test]
fn three_sublattices_feel_their_own_sums_and_those_of_each_other() {
    // Period 1 between neighbours, cell side √3. Sums from the sublattice to itself and to each other one, 30-digit
    // Epstein zeta sums.
    let [own, other] = measured(Cell::hexagonal(3f64.sqrt()).unwrap(), 240, &homogeneous(), 0.025);
    let Sums([s1, s3, s5]) = own;
    absolute("own S1", s1, -2.4326206931833058, 1e-9);
    relative("own S3", s3, 2.12352811027957, 1e-7);
    absolute("own S5", s5, 0.43377599258828, 1e-4);
    let Sums([s1, s3, s5]) = other;
    absolute("other S1", s1, -0.890400971476800544, 1e-9);
    relative("other S3", s3, 4.45532381231762, 1e-7);
    relative("other S5", s5, 3.16406126590521, 1e-4);
}

/// Period 1. Thickness, χ, ν₁; effective S₁, S₃, S₅ of one level; S₁ of three levels to their own and to each other
/// level, S₃ to each other level: Epstein zeta sums plus converged reciprocal sums of T − 1. ν₂ = 0.3.
const COATED: [([f64; 3], [f64; 3], [f64; 3]); 5] = [
    ([0.5, 2.0, 0.20], [-4.1420777668, 7.2083075374, 30.46992632], [-2.01909410, -1.06149184, 6.90140087]),
    ([0.5, 0.5, 0.45], [-4.2988675296, 15.6184581366, -21.68869048], [-2.86426157, -0.71730298, 2.07854439]),
    ([0.5, 0.5, 0.20], [-4.2698890693, 14.0618915899, -11.99444137], [-2.73985659, -0.76501624, 2.69494887]),
    ([0.12, 0.2, 0.22], [-9.6461381812, 981.2640978582, -48832.07095733], [-9.08485385, -0.28064216, 0.81688864]),
    ([0.12, 5.0, 0.22], [11.5577542166, -2144.4934471944, 88389.55801308], [18.55881237, -3.50052908, 20.17887503]),
];

fn coating([thickness, chi, nu1]: [f64; 3]) -> Coating {
    Coating { chi, poisson: [nu1, 0.3], thickness }
}

#[test]
fn a_point_load_on_a_coating_feels_the_effective_sums() {
    for (parameters, [e1, e3, e5], [own, other, other3]) in COATED {
        println!("{parameters:?}");
        let coating = coating(parameters);
        let width = if coating.thickness < 0.2 { 0.01 } else { 0.025 };
        let points = if coating.thickness < 0.2 { 288 } else { 144 };
        let cell = Cell::hexagonal(1.0).unwrap();
        let [Sums([s1, s3, s5]), _] = measured(cell, points, &coating.half_space(), width);
        absolute("S1", s1, e1, 1e-8);
        relative("S3", s3, e3, 1e-6);
        relative("S5", s5, e5, 1e-4);
        let cell = Cell::hexagonal(3f64.sqrt()).unwrap();
        let [Sums([s1, ..]), Sums([t1, t3, _])] = measured(cell, 5 * points / 3, &coating.half_space(), width);
        absolute("own S1", s1, own, 2e-8);
        absolute("other S1", t1, other, 2e-8);
        relative("other S3", t3, other3, 1e-7);
    }
}

#[test]
fn the_series_of_these_tests_has_the_tabulated_effective_sums() {
    for (parameters, expected, [own, other, other3]) in COATED {
        let coating = coating(parameters);
        let whole = coated_triangular(&coating, 1.0);
        for (got, expected) in whole.0.into_iter().zip(expected) {
            relative("one level", got, expected, 1e-9);
        }
        let sublattice = coated_triangular(&coating, 3f64.sqrt());
        let Sums([t1, t3, _]) = whole.other_sublattice(sublattice);
        absolute("own S1", sublattice.0[0], own, 1e-8);
        absolute("other S1", t1, other, 1e-8);
        absolute("other S3", t3, other3, 1e-8);
    }
}

#[test]
fn the_bonded_layer_correction_has_its_twelve_digit_values() {
    // 6 × 6 boundary conditions of a bonded layer solved to 36 digits. χ, ν₁, x = qh, T; ν₂ = 0.3.
    for [chi, nu1, x, expected] in [
        [2.0, 0.20, 0.1, 1.72526660632],
        [2.0, 0.20, 0.5, 1.61261047905],
        [2.0, 0.20, 1.0, 1.41117464928],
        [2.0, 0.20, 2.0, 1.1244653574],
        [2.0, 0.20, 4.0, 1.00660669173],
        [0.5, 0.45, 0.1, 0.618461746474],
        [0.5, 0.45, 0.5, 0.606912178864],
        [0.5, 0.45, 1.0, 0.687768355896],
        [0.5, 0.45, 2.0, 0.874281670537],
    ] {
        let coating = coating([1.0, chi, nu1]);
        relative("crate's T", TransferFunction::new(&coating.half_space()).correction(x), expected, 1e-11);
        relative("closed T", coating.correction(x), expected, 1e-11);
    }
}

#[test]
fn a_layer_on_a_nearly_rigid_base_has_the_moments_of_the_rigid_one() {
    // A_n = ∫xⁿ(1 − T)dx, n = 0, 2, 4, of the layer bonded to a rigid base, by quadrature in high precision.
    for (nu, expected) in [
        (0.3, [1.3768541655, 2.5102066455, 16.963356698]),
        (0.45, [1.6254706121, 3.3460758897, 23.894470851]),
        (0.5, [1.77021677337, 3.83107715559, 27.99097798]),
    ] {
        let layer = Layer::new(Material::from_shear(1.0, nu).unwrap(), 1.0, Interface::Bonded).unwrap();
        let rigid = Material::from_shear(1e10, 0.3).unwrap();
        let transfer = TransferFunction::new(&HalfSpace::new(vec![layer], rigid));
        for (n, expected) in [0, 2, 4].into_iter().zip(expected) {
            relative("A_n", moment(|x| transfer.correction(x), n), expected, 1e-9);
        }
    }
}
