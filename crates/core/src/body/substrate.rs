//! The substrate that the layers lie on: an elastic half-space, or a rigid base.

use super::Material;

/// Substrate that the layers of a body lie on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Substrate {
    /// An elastic half-space of this material. Its mean displacement under a periodic pressure is infinite and left out.
    Elastic(Material),
    /// A rigid base, which no traction displaces: the lower interface of the last layer joins it to the base. All
    /// displacements count from it, the mean compression of the layers among them. It has no stresses and no strength.
    Rigid,
}

impl Substrate {
    /// Material of the substrate; `None` for a rigid base.
    pub fn material(self) -> Option<Material> {
        match self {
            Self::Elastic(material) => Some(material),
            Self::Rigid => None,
        }
    }

    /// Whether it is a rigid base.
    pub fn is_rigid(self) -> bool {
        self == Self::Rigid
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Amplitudes, Depth, HalfSpace, InPlane, Interface, Layer, MaterialError, MeanStress, Name};
    use super::*;
    use crate::numeric::linear::solve;

    const SPRING: Interface = Interface::Spring { tangential: 0.3, normal: 2.0 };

    fn layer(shear: f64, poisson: f64, thickness: f64, interface: Interface) -> Layer {
        Layer::new(Material::from_shear(shear, poisson).unwrap(), thickness, interface).unwrap()
    }

    fn on_rigid_base(layers: &[Layer]) -> HalfSpace {
        HalfSpace::on_rigid_base(layers.to_vec()).unwrap()
    }

    /// Stacks of one and several layers, soft and stiff, compressible and not, with every kind of interface at the base.
    fn stacks() -> Vec<Vec<Layer>> {
        let bases = [Interface::Bonded, Interface::Frictionless, SPRING];
        let of = |base: Interface| {
            [
                vec![layer(2.0, 0.3, 1.0, base)],
                vec![layer(2.0, 0.5, 1.0, base)],
                vec![layer(3.0, 0.2, 0.3, Interface::Bonded), layer(0.1, 0.45, 0.5, base)],
                vec![
                    layer(0.5, 0.0, 0.3, SPRING),
                    layer(20.0, 0.3, 0.1, Interface::Frictionless),
                    layer(1.0, 0.5, 0.4, base),
                ],
            ]
        };
        bases.into_iter().flat_map(of).collect()
    }

    #[test]
    fn nothing_but_a_rigid_base_is_no_body() {
        assert_eq!(HalfSpace::on_rigid_base(vec![]), Err(MaterialError::NoLayers));
    }

    /// T = [2κ sinh 2x − 4x]/[2κ cosh 2x + κ² + 1 + 4x²], κ = 3 − 4ν, x = qh: the closed form of one bonded layer for χ → 0.
    #[test]
    fn one_bonded_layer_has_its_closed_form() {
        for poisson in [0.0, 0.2, 0.45, 0.5] {
            let kappa = 3.0 - 4.0 * poisson;
            for x in [0.3, 0.9, 1.1, 3.0, 10.0, 40.0f64] {
                let upper = 2.0 * kappa * (2.0 * x).sinh() - 4.0 * x;
                let closed = upper / (2.0 * kappa * (2.0 * x).cosh() + kappa * kappa + 1.0 + 4.0 * x * x);
                let found =
                    on_rigid_base(&[layer(3.0, poisson, 0.5, Interface::Bonded)]).response().correction(2.0 * x);
                assert!((found / closed - 1.0).abs() < 2e-14, "ν {poisson}, x {x}: {found} {closed}");
            }
        }
    }

    /// For waves that are long against the layer, x = qh → 0, compliance tends to that of a column: h/M of a bonded compressible
    /// layer, and of its springs 1/k_n; q²h³/(3G) of a bonded incompressible one, from which fluid-like flow is squeezed; h(1 − ν)/(2G) of
    /// a layer that slides on the base. Deviations are of the order x² or less, down to
    /// rounding.
    #[test]
    fn thin_layers_are_columns() {
        let (shear, h) = (3.0, 0.25);
        type Column<'a> = &'a dyn Fn(f64) -> f64;
        let cases: [(f64, Interface, Column<'_>); 5] = [
            (0.1, Interface::Bonded, &|_| h * 0.8 / (2.0 * shear * 0.9)),
            (0.3, Interface::Bonded, &|_| h * 0.4 / (2.0 * shear * 0.7)),
            (0.3, SPRING, &|_| h * 0.4 / (2.0 * shear * 0.7) + 0.5),
            (0.5, Interface::Bonded, &|q| q * q * h * h * h / (3.0 * shear)),
            (0.45, Interface::Frictionless, &|_| h * 0.55 / (2.0 * shear)),
        ];
        for (poisson, base, column) in cases {
            let body = on_rigid_base(&[layer(shear, poisson, h, base)]);
            let error = |x: f64| body.response().compliance(x / h) / column(x / h) - 1.0;
            let (one, half) = (error(2e-3), error(1e-3));
            // A layer that slides deviates by the order x⁴ alone.
            assert!(one.abs() < 4e-4 && one / half > 3.9, "ν {poisson}, {base}: {one:e}, {half:e}");
            assert!(
                [1e-6, 1e-9, 1e-12].iter().all(|&x| error(x).abs() < 1e-11),
                "ν {poisson}, {base}: {:e}",
                error(1e-9)
            );
        }
    }

    /// The compliance of long waves is that under a uniform pressure where no mean lateral strain can arise: not on a base without
    /// friction, on which the layer spreads.
    #[test]
    fn the_mean_compliance_is_that_of_columns() {
        for layers in stacks() {
            let body = on_rigid_base(&layers);
            let spreads = layers.iter().any(|layer| layer.interface() == Interface::Frictionless);
            let (mean, long) = (body.mean_compliance(), body.response().compliance(1e-9));
            let springs = layers.iter().filter(|layer| layer.interface() == SPRING).count() as f64 / 2.0;
            let compressible = layers.iter().any(|layer| layer.material().poisson() < 0.5);
            assert!(mean >= springs && (mean > springs) == compressible, "{body}: {mean}");
            assert!(spreads || (mean - long).abs() < 1e-12 * (mean + 1e-3), "{body}: {mean}, {long}");
        }
        assert_eq!(
            HalfSpace::new(vec![layer(1.0, 0.3, 1.0, SPRING)], Material::from_shear(1.0, 0.3).unwrap())
                .mean_compliance(),
            0.0
        );
    }

    /// F, F′, 2Gq u_z and 2Gq u_q at x of the functions cosh x, sinh x, x sinh x and x cosh x.
    fn basis(x: f64, nu: f64) -> [[f64; 4]; 4] {
        let (c, s) = (x.cosh(), x.sinh());
        let derivatives = [
            [c, s, c, s],
            [s, c, s, c],
            [x * s, s + x * c, 2.0 * c + x * s, 3.0 * s + x * c],
            [x * c, c + x * s, 2.0 * s + x * c, 3.0 * c + x * s],
        ];
        derivatives.map(|[f0, f1, f2, f3]| [f0, f1, (1.0 - nu) * f3 - (2.0 - nu) * f1, (1.0 - nu) * f2 + nu * f0])
    }

    /// Rows F, F′, u_z, u_q over the coefficients of a layer at a distance z below its upper face.
    fn rows(layer: &Layer, q: f64, z: f64) -> [[f64; 4]; 4] {
        let functions = basis(q * z, layer.material().poisson());
        let unit = 0.5 / (layer.material().shear() * q);
        std::array::from_fn(|row| std::array::from_fn(|k| functions[k][row] * if row > 1 { unit } else { 1.0 }))
    }

    /// The coefficients of all layers by one dense system: the tractions on the surface, the conditions at the interfaces, and at the base
    /// those of a spring against what does not move.
    fn dense(layers: &[Layer], traction: InPlane, q: f64) -> Vec<f64> {
        let size = 4 * layers.len();
        let (mut matrix, mut right) = (Vec::new(), Vec::new());
        let mut condition = |parts: &[(usize, [f64; 4])], value: f64| {
            let mut row = vec![0.0; size];
            for (number, part) in parts {
                row[4 * number..4 * number + 4]
                    .iter_mut()
                    .zip(part)
                    .for_each(|(entry, coefficient)| *entry += coefficient);
            }
            matrix.push(row);
            right.push(value);
        };
        let top = rows(&layers[0], q, 0.0);
        let [pressure, shear] = if traction == InPlane::Normal { [1.0, 0.0] } else { [0.0, -1.0] };
        condition(&[(0, top[0])], pressure);
        condition(&[(0, top[1])], shear);
        for (number, layer) in layers.iter().enumerate() {
            let [f, g, uz, uq] = rows(layer, q, layer.thickness());
            let next = layers.get(number + 1).map(|next| rows(next, q, 0.0).map(|row| (number + 1, row.map(|x| -x))));
            let with = |part: [f64; 4], row: usize| {
                std::iter::once((number, part)).chain(next.map(|next| next[row])).collect::<Vec<_>>()
            };
            if next.is_some() {
                condition(&with(f, 0), 0.0);
            }
            // A spring is closed by the pressure F over k_n and drawn by −F′ over k_t.
            let sum = |a: [f64; 4], b: [f64; 4], factor: f64| std::array::from_fn(|k| a[k] + factor * b[k]);
            let (normal, tangential) = match layer.interface() {
                Interface::Spring { tangential, normal } => (normal.recip(), Some(tangential.recip())),
                Interface::Bonded => (0.0, Some(0.0)),
                Interface::Frictionless => (0.0, None),
            };
            // Under a shear traction σ_zz and u_z both have the other sign.
            condition(&with(sum(uz, f, -normal), 2), 0.0);
            match tangential {
                Some(slip) => {
                    if next.is_some() {
                        condition(&with(g, 1), 0.0);
                    }
                    condition(&with(sum(uq, g, slip), 3), 0.0);
                }
                None => {
                    condition(&[(number, g)], 0.0);
                    if let Some(next) = next {
                        condition(&[next[1]], 0.0);
                    }
                }
            }
        }
        solve(matrix, right).unwrap()
    }

    /// Amplitudes in all layers down to the base against one dense system of their coefficients.
    #[test]
    fn amplitudes_are_those_of_a_dense_system() {
        for layers in stacks() {
            let body = on_rigid_base(&layers);
            for (traction, q) in [InPlane::Normal, InPlane::Along]
                .into_iter()
                .flat_map(|traction| [0.3, 1.0, 4.0].map(|q| (traction, q)))
            {
                let coefficients = dense(&layers, traction, q);
                let sign = if traction == InPlane::Normal { 1.0 } else { -1.0 };
                let (interior, mut top) = (body.response().interior(traction, q), 0.0);
                for (number, layer) in layers.iter().enumerate() {
                    for part in [0.0, 0.37, 1.0] {
                        let z = part * layer.thickness();
                        let [f, g, uz, uq] = rows(layer, q, z)
                            .map(|row| (0..4).map(|k| row[k] * coefficients[4 * number + k]).sum::<f64>());
                        let Amplitudes { szz, sqz, uz: found_uz, uq: found_uq, .. } =
                            interior.at(Depth { z: top + z, material: number + 1 });
                        let scale = 1.0 + found_uz.abs().max(found_uq.abs());
                        for (found, known) in [(szz, -sign * f), (sqz, g), (found_uz, sign * uz), (found_uq, uq)] {
                            assert!(
                                (found - known).abs() < 1e-11 * scale,
                                "{body}, q {q}, {number}, {part}: {found} {known}"
                            );
                        }
                    }
                    top += layer.thickness();
                }
            }
        }
    }

    /// Compliances of the surface and amplitudes down to the base differ from those on a substrate n times as stiff by the order of 1/n.
    #[test]
    fn a_stiff_substrate_tends_to_the_rigid_base() {
        for layers in stacks() {
            let body = on_rigid_base(&layers);
            let bottom = Depth { z: body.base_depth(), material: layers.len() };
            let errors = |q: f64, stiffness: f64| {
                let stiff = HalfSpace::new(layers.clone(), Material::from_shear(stiffness, 0.3).unwrap());
                let [rigid, elastic] = [&body, &stiff].map(|body| body.response().surface(q));
                let surface = [
                    elastic.normal / rigid.normal - 1.0,
                    (elastic.coupling - rigid.coupling) / (rigid.normal * rigid.along).sqrt(),
                    elastic.along / rigid.along - 1.0,
                    elastic.across / rigid.across - 1.0,
                ];
                let inside = [InPlane::Normal, InPlane::Along].map(|traction| {
                    let [rigid, elastic] = [&body, &stiff].map(|body| body.response().amplitudes(traction, q, bottom));
                    [elastic.szz - rigid.szz, elastic.sqz - rigid.sqz, elastic.sqq - rigid.sqq, elastic.stt - rigid.stt]
                });
                surface.into_iter().chain(inside.concat()).fold(0.0f64, |most, error| most.max(error.abs()))
            };
            for q in [0.3, 1.0, 5.0] {
                let found = [1e4, 1e6, 1e8].map(|stiffness| stiffness * errors(q, stiffness));
                assert!(
                    found[0] > 0.0 && found.iter().all(|error| *error < 4.0 * found[0] + 1e-4),
                    "{body}, q {q}: {found:?}"
                );
            }
        }
    }

    #[test]
    fn the_base_is_no_material() {
        let titled = layer(2.0, 0.3, 1.0, Interface::Bonded);
        let rubber = Material::from_shear(2.0, 0.3).unwrap().with_name(Some(Name::new("rubber")));
        let named = Layer::new(rubber, 0.5, Interface::Bonded).unwrap();
        let body = on_rigid_base(&[titled, named]);
        assert_eq!((body.material_count(), body.materials().count(), body.strengths().count()), (2, 2, 2));
        assert_eq!(body.interface_id(2).to_string(), "rubber/rigid base");
        assert_eq!(body.interface_id(1).to_string(), "material 1/rubber");
        let materials = |z: f64| body.depths(z).iter().map(|depth| depth.material).collect::<Vec<usize>>();
        assert_eq!([1.0, 1.5, 1.6].map(materials), [vec![1, 2], vec![2], vec![]]);
        let rows = body.rows(4.0, 8);
        assert_eq!(rows.last().map(|depth| (depth.z, depth.material)), Some((1.5, 2)));
        // The base gives no way laterally: the wide disc is confined.
        assert_eq!(MeanStress::HalfSpace.lateral(&body), MeanStress::Confined.lateral(&body));
        assert!(body.to_string().ends_with("rigid base") && !body.to_string().contains('χ'));
    }
}
