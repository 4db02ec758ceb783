//! Slow twin of temperature, swelling and thermal stress: heat equation and Navier's equations by Chebyshev collocation.
//!
//! With fields of e^{ikξ}, u along **k**, w into the body, Lamé's Λ = 2Gν/(1−2ν) and β = (3Λ + 2G)α,
//!
//! T″ − k²T + i(k_x v/κ)T = 0,
//! σ_zz = (Λ + 2G)w′ + ikΛu − βT,  σ_qq = (Λ + 2G)iku + Λw′ − βT,  σ_qz = G(u′ + ikw),
//! σ_zz′ + ikσ_qz = 0,  σ_qz′ + ikσ_qq = 0
//!
//! at the Chebyshev points of elements, a few per layer, down to where e^{−kz} is lost. Nothing is shared with what it tests: neither
//! exponentials nor the stress function nor reciprocity.

use super::element::{DEGREE, Element};
use crate::body::Conduction;
use crate::body::{Amplitudes, Depth, Interface, Material};
use crate::heat::HeatedBody;
use rustfft::num_complex::Complex64;

/// kz at which the substrate ends: e^{−45} = 3·10⁻²⁰.
const DEEP: f64 = 45.0;
/// Largest |s| times the length of an element in a layer.
const LONG: f64 = 3.0;

type Row = Vec<Complex64>;

/// Solution at one node.
pub struct Node {
    pub depth: Depth,
    pub temperature: Complex64,
    /// Flux into the depth.
    pub flux: Complex64,
    /// Amplitudes in the phases of [`ThermalStress`](crate::heat::ThermalStress).
    pub amplitudes: Amplitudes<Complex64>,
}

pub struct Collocation<'a> {
    body: &'a HeatedBody,
    k: f64,
    kx: f64,
    elements: Vec<Element>,
}

impl<'a> Collocation<'a> {
    pub fn new(body: &'a HeatedBody, [kx, ky]: [f64; 2]) -> Self {
        let k = kx.hypot(ky);
        let rate =
            |conduction: &Conduction| (k * k).max((kx * body.velocity() / conduction.diffusivity()).abs()).sqrt() * 1.2;
        let (mut elements, mut top) = (Vec::new(), 0.0);
        for (material, layer) in body.half_space().layers().iter().enumerate() {
            let pieces = (rate(&body.conductions()[material]) * layer.thickness() / LONG).ceil();
            let length = layer.thickness() / pieces;
            for piece in 0..pieces as usize {
                let from = top + piece as f64 * length;
                elements.push(Element::new(material, from, from + length));
            }
            top += layer.thickness();
        }
        if let Some(conduction) = body.conductions().get(body.half_space().layers().len()) {
            let (mut length, end) = (2.0 / rate(conduction), top + DEEP / k);
            while top < end {
                elements.push(Element::new(body.half_space().layers().len(), top, top + length));
                top += length;
                length *= 2.0;
            }
        }
        Self { body, k, kx, elements }
    }

    fn count(&self) -> usize {
        self.elements.len() * (DEGREE + 1)
    }

    fn material(&self, element: &Element) -> Material {
        self.body.half_space().material(element.material + 1)
    }

    /// Row of the value and of the derivative of unknown `field` of `fields` at a node of an element.
    fn value(&self, [field, fields]: [usize; 2], element: usize, node: usize) -> [Row; 2] {
        let mut rows = [(); 2].map(|_| vec![Complex64::default(); fields * self.count()]);
        let first = field * self.count() + element * (DEGREE + 1);
        rows[0][first + node] = 1.0.into();
        for (j, slope) in self.elements[element].slope[node].iter().enumerate() {
            rows[1][first + j] = Complex64::from(*slope);
        }
        rows
    }

    fn temperatures(&self) -> Vec<Complex64> {
        let (mut rows, mut right) = (Vec::new(), Vec::new());
        let mut hold = |row: Row, value: f64| {
            rows.push(row);
            right.push(Complex64::from(value));
        };
        let face = |element: usize, node: usize| {
            let [value, slope] = self.value([0, 1], element, node);
            let conductivity = self.body.conductions()[self.elements[element].material].conductivity();
            [value, times(&slope, (-conductivity).into())]
        };
        hold(face(0, 0)[1].clone(), 1.0);
        for (number, element) in self.elements.iter().enumerate() {
            let conduction = &self.body.conductions()[element.material];
            let decay = Complex64::new(-self.k * self.k, self.kx * self.body.velocity() / conduction.diffusivity());
            for node in 1..DEGREE {
                let slopes: Vec<Row> = (0..=DEGREE).map(|j| self.value([0, 1], number, j)[1].clone()).collect();
                let mut row = times(&self.value([0, 1], number, node)[0], decay);
                for (j, slope) in slopes.iter().enumerate() {
                    row = plus(&row, slope, element.slope[node][j].into());
                }
                hold(row, 0.0);
            }
            let [value, flux] = face(number, DEGREE);
            let next = self.elements.get(number + 1);
            let changes = next.is_none_or(|next| next.material != element.material);
            let resistance = if changes { self.body.resistances().get(element.material).copied() } else { Some(0.0) };
            // The flux falls by its resistance; an infinite one lets nothing through.
            let fall = |below: Option<&Row>| match resistance {
                Some(f64::INFINITY) => flux.clone(),
                _ => plus(
                    &below.map_or(value.clone(), |below| plus(&value, below, (-1.0).into())),
                    &flux,
                    (-resistance.unwrap_or(0.0)).into(),
                ),
            };
            match next {
                Some(_) => {
                    let [below, flux_below] = face(number + 1, 0);
                    hold(fall(Some(&below)), 0.0);
                    hold(plus(&flux, &flux_below, (-1.0).into()), 0.0);
                }
                None => hold(fall(None), 0.0),
            }
        }
        eliminated(rows, right)
    }

    /// Rows of w, u, σ_zz, σ_qz and σ_qq at a node without heat.
    fn elastic(&self, element: usize, node: usize) -> [Row; 5] {
        let material = self.material(&self.elements[element]);
        let (g, nu) = (material.shear(), material.poisson());
        let lame = 2.0 * g * nu / (1.0 - 2.0 * nu);
        let ([u, du], [w, dw]) = (self.value([0, 2], element, node), self.value([1, 2], element, node));
        let ik = Complex64::new(0.0, self.k);
        let szz = plus(&times(&dw, (lame + 2.0 * g).into()), &u, ik * lame);
        let sqq = plus(&times(&dw, lame.into()), &u, ik * (lame + 2.0 * g));
        let sqz = times(&plus(&du, &w, ik), g.into());
        [w, u, szz, sqz, sqq]
    }

    /// −βT/T in an element.
    fn beta(&self, element: &Element) -> f64 {
        let (material, alpha) = (self.material(element), self.body.conductions()[element.material].expansion());
        let (g, nu) = (material.shear(), material.poisson());
        -(6.0 * g * nu / (1.0 - 2.0 * nu) + 2.0 * g) * alpha
    }

    /// Solution at all nodes, from the surface down.
    pub fn solution(&self) -> Vec<Node> {
        let temperatures = self.temperatures();
        let moved = self.displacements(&temperatures);
        let mut nodes = Vec::new();
        for (number, element) in self.elements.iter().enumerate() {
            let conduction = &self.body.conductions()[element.material];
            let material = self.material(element);
            for (node, &z) in element.nodes.iter().enumerate() {
                let at = |row: &Row| row.iter().zip(&moved).map(|(a, b)| a * b).sum::<Complex64>();
                let temperature = temperatures[number * (DEGREE + 1) + node];
                let heat = temperature * self.beta(element);
                let [w, u, szz, sqz, sqq] = self.elastic(number, node).each_ref().map(at);
                let (szz, sqq) = (szz + heat, sqq + heat);
                let stt = (szz + sqq) * material.poisson() - temperature * (material.young() * conduction.expansion());
                let i = Complex64::I;
                let amplitudes = Amplitudes { szz, sqz: i * sqz, sqq, stt, uz: w, uq: i * u };
                let slope = self.value([0, 1], number, node)[1]
                    .iter()
                    .zip(&temperatures)
                    .map(|(a, b)| a * b)
                    .sum::<Complex64>();
                let depth = Depth { z, material: element.material + 1 };
                nodes.push(Node { depth, temperature, flux: -slope * conduction.conductivity(), amplitudes });
            }
        }
        nodes
    }

    /// Sums of rows and of heat that are zero in equilibrium inside an element.
    fn equilibrium(&self, number: usize, temperatures: &[Complex64]) -> Vec<(Row, Complex64)> {
        let (element, ik) = (&self.elements[number], Complex64::new(0.0, self.k));
        let heat = |node: usize| temperatures[number * (DEGREE + 1) + node] * self.beta(element);
        let all: Vec<[Row; 5]> = (0..=DEGREE).map(|j| self.elastic(number, j)).collect();
        let at = |node: usize| {
            let (mut down, mut along) = (times(&all[node][3], ik), times(&all[node][4], ik));
            let mut down_heat = Complex64::default();
            for j in 0..=DEGREE {
                let slope = Complex64::from(element.slope[node][j]);
                down = plus(&down, &all[j][2], slope);
                along = plus(&along, &all[j][3], slope);
                down_heat += slope * heat(j);
            }
            [(down, down_heat), (along, ik * heat(node))]
        };
        (1..DEGREE).flat_map(at).collect()
    }

    fn displacements(&self, temperatures: &[Complex64]) -> Vec<Complex64> {
        let (mut rows, mut right) = (Vec::new(), Vec::new());
        let scale = self.material(&self.elements[0]).shear() * self.k;
        // A sum of rows and of heat is zero.
        let mut hold = |row: Row, heat: Complex64| {
            rows.push(row);
            right.push(-heat);
        };
        let heat = |element: usize, node: usize| {
            temperatures[element * (DEGREE + 1) + node] * self.beta(&self.elements[element])
        };
        let [_, _, szz, sqz, _] = self.elastic(0, 0);
        hold(szz, heat(0, 0));
        hold(sqz, 0.0.into());
        for (number, element) in self.elements.iter().enumerate() {
            for (row, heat) in self.equilibrium(number, temperatures) {
                hold(row, heat);
            }
            let [w, u, szz, sqz, _] = &self.elastic(number, DEGREE);
            let above = heat(number, DEGREE);
            let next = self.elements.get(number + 1).map(|_| (self.elastic(number + 1, 0), heat(number + 1, 0)));
            let changes = self.elements.get(number + 1).is_none_or(|next| next.material != element.material);
            let layers = self.body.half_space().layers();
            let interface = if changes {
                layers.get(element.material).map_or(Interface::Bonded, |layer| layer.interface())
            } else {
                Interface::Bonded
            };
            let (closure, slip) = match interface {
                Interface::Bonded => (0.0, Some(0.0)),
                Interface::Frictionless => (0.0, None),
                Interface::Spring { tangential, normal } => (normal.recip(), Some(tangential.recip())),
            };
            let less = |row: &Row, field: usize| {
                next.as_ref().map_or(row.clone(), |(next, _)| plus(row, &next[field], (-1.0).into()))
            };
            // w above − w below = −σ_zz/k_n, u below − u above = σ_qz/k_t, in stresses.
            hold(times(&plus(&less(w, 0), szz, closure.into()), scale.into()), above * closure * scale);
            if let Some((next, below)) = &next {
                hold(plus(szz, &next[2], (-1.0).into()), above - below);
            }
            match slip {
                Some(slip) => {
                    hold(times(&plus(&less(u, 1), sqz, slip.into()), scale.into()), 0.0.into());
                    if let Some((next, _)) = &next {
                        hold(plus(sqz, &next[3], (-1.0).into()), 0.0.into());
                    }
                }
                None => {
                    hold(sqz.clone(), 0.0.into());
                    if let Some((next, _)) = &next {
                        hold(next[3].clone(), 0.0.into());
                    }
                }
            }
        }
        eliminated(rows, right)
    }
}

fn times(row: &Row, factor: Complex64) -> Row {
    row.iter().map(|x| x * factor).collect()
}

fn plus(row: &Row, other: &Row, factor: Complex64) -> Row {
    row.iter().zip(other).map(|(x, y)| x + y * factor).collect()
}

/// Gauss' elimination with rows scaled and exchanged.
fn eliminated(mut rows: Vec<Row>, mut right: Vec<Complex64>) -> Vec<Complex64> {
    let n = right.len();
    assert_eq!(rows.len(), rows[0].len());
    for (row, right) in rows.iter_mut().zip(&mut right) {
        let scale = row.iter().fold(0.0, |most: f64, x| most.max(x.norm()));
        row.iter_mut().for_each(|x| *x /= scale);
        *right /= scale;
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].norm().total_cmp(&rows[b][k].norm())).unwrap();
        rows.swap(k, pivot);
        right.swap(k, pivot);
        let (head, tail) = rows.split_at_mut(k + 1);
        for (row, i) in tail.iter_mut().zip(k + 1..).filter(|(row, _)| row[k] != Complex64::default()) {
            let factor = row[k] / head[k][k];
            row[k..].iter_mut().zip(&head[k][k..]).for_each(|(x, y)| *x -= factor * y);
            let known = right[k];
            right[i] -= factor * known;
        }
    }
    for k in (0..n).rev() {
        let known: Complex64 = (k + 1..n).map(|m| rows[k][m] * right[m]).sum();
        right[k] = (right[k] - known) / rows[k][k];
    }
    right
}
