//! Error by the sublayers of graded layers: the surface compliance is compared with that of twice as many.
//!
//! A change from n to 2n sublayers is ¾ of the error at n, at second order in 1/n. Compared are wavelengths from the
//! longest of the cell to a sixteenth of its shorter side, about the size of a contact spot; a wave shorter than a
//! sublayer would depend on the uppermost one alone.

use crate::case::{Case, layers};
use percoat_core::body::Bodies;
use percoat_core::notation::number;
use percoat_core::numeric::search::largest;
use percoat_core::reading::FEW_SAMPLES;
use std::f64::consts::TAU;

/// Number of the shortest waves along the cell's shorter side.
const WAVES: f64 = 16.0;
/// Number of wavenumbers compared.
const COUNT: usize = 24;
/// Relative error above which there is a warning: that of the peak pressure of a contact of [`FEW_SAMPLES`] samples, 0.1 n⁻², see
/// [`percoat_core::reading::Errors`].
const WORTH_SAYING: f64 = 0.1 / (FEW_SAMPLES * FEW_SAMPLES);

/// Estimated largest relative error of the surface compliance by the sublayers of graded layers; `None` without any.
pub fn sublayer_error(case: &Case) -> Option<f64> {
    let above = case.counterbody.iter().flat_map(|above| &above.layers.0);
    case.layers.iter().chain(above).any(|layer| layer.graded.is_some()).then_some(())?;
    let body = layers::refined(&case.layers, &case.substrate)?;
    let finer = match case.counterbody.as_ref().filter(|above| above.is_elastic()) {
        Some(above) => Bodies::elastic(body, above.refined()?),
        None => Bodies::from(body),
    };
    let cell = case.problem().cell();
    let longer = cell.reduced().longer_side();
    let shorter = cell.area() / longer;
    Some(4.0 / 3.0 * difference(case.problem().bodies(), &finer, [TAU / longer, TAU * WAVES / shorter]))
}

/// Largest relative difference of two surface compliances between two wavenumbers.
fn difference(coarse: &Bodies, fine: &Bodies, [least, most]: [f64; 2]) -> f64 {
    let wavenumbers = (0..COUNT).map(|k| least * (most / least).powf(k as f64 / (COUNT - 1) as f64));
    largest(wavenumbers.map(|q| (coarse.compliance(q) / fine.compliance(q) - 1.0).abs()))
}

/// A warning where the sublayers are too few.
pub(super) fn doubt(case: &Case) -> Option<String> {
    let error = sublayer_error(case).filter(|&error| error > WORTH_SAYING)?;
    Some(format!(
        "the sublayers of the graded layers are few: the surface compliance changes by {} with more of them; raise \
         graded.sublayers",
        number(error)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, Source};
    use percoat_core::body::{HalfSpace, Interface, Layer, Material};

    fn case(graded: &str) -> Case {
        let text = format!(
            "[lattice]\nkind = \"square\"\nperiod = 4\n[[levels]]\nshape = \"paraboloid\"\nradius = 1\n\
             [[layers]]\nthickness = 1\ngraded = {graded}\n[substrate]\nyoung = 1\npoisson = 0.3\n\
             [load]\nmean_pressure = 1e-3\n"
        );
        let source = Source { name: "case.toml".to_owned(), text, ..Source::default() };
        Case::read(&source, &[]).unwrap_or_else(|error| panic!("{error}"))
    }

    /// The equations of plane strain in depth, d/dz (u_z, u_q, σ_zz, σ_qz) under moduli that change with z, integrated upward
    /// from the substrate's two decaying states by Runge–Kutta's rule of fourth order, outside this program. 2000, 4000 and
    /// 8000 steps agree to twelve digits; of a homogeneous half-space the same gives 2(1 − ν²)/(Eq). h = 1, substrate E = 1,
    /// ν = 0.3.
    const EXACT: [(&str, [(f64, f64); 3]); 2] = [
        (
            "young = [4.0, 1.0], poisson = [0.2, 0.3]",
            [(0.5, 3.160_175_572_568_6), (2.0, 0.456_200_509_595_0), (6.0, 0.095_027_524_035_5)],
        ),
        (
            "young = [0.25, 1.0], poisson = [0.3, 0.3], law = \"exponential\"",
            [(0.5, 4.581_997_916_841_2), (2.0, 1.827_097_794_992_6), (6.0, 0.925_529_692_802_9)],
        ),
    ];

    #[test]
    fn the_compliance_of_graded_layers_is_that_of_the_differential_equation_at_second_order() {
        for (keys, values) in EXACT {
            for (wavenumber, exact) in values {
                let error = |sublayers: usize| {
                    let case = case(&format!("{{ {keys}, sublayers = {sublayers} }}"));
                    (case.half_space().response().compliance(wavenumber) / exact - 1.0).abs()
                };
                let errors = [10, 20, 40, 80].map(error);
                // (qh/n)² with a factor of order one, E changing by factors up to four.
                let bound = (4.0 + wavenumber * wavenumber) / 400.0;
                assert!(errors[1] < bound, "{keys}, q = {wavenumber}: {errors:?}");
                let order = (errors[2] / errors[3]).log2();
                assert!((order - 2.0).abs() < 0.1, "{keys}, q = {wavenumber}: order {order}, {errors:?}");
            }
        }
    }

    #[test]
    fn what_is_told_of_the_error_is_the_error() {
        let keys = "young = [4.0, 1.0], poisson = [0.2, 0.3], law = \"exponential\"";
        let (few, many) =
            (case(&format!("{{ {keys}, sublayers = 20 }}")), case(&format!("{{ {keys}, sublayers = 200 }}")));
        let told = sublayer_error(&few).unwrap();
        let true_error = difference(few.problem().bodies(), many.problem().bodies(), [TAU / 4.0, TAU * WAVES / 4.0]);
        // The largest of them stands where a wave is few sublayers long: there the order is less clean.
        assert!((0.5..2.0).contains(&(told / true_error)), "{told} for {true_error}");
        assert_eq!(doubt(&few).is_some(), told > WORTH_SAYING);
        let coarse = case(&format!("{{ {keys}, sublayers = 2 }}"));
        assert!(doubt(&coarse).is_some_and(|doubt| doubt.contains("graded.sublayers")) && doubt(&many).is_none());
    }

    #[test]
    fn equal_ends_are_a_homogeneous_layer_and_the_lower_face_is_that_of_the_whole() {
        let plain = case("{ young = [2, 2], poisson = [0.2, 0.2], sublayers = 7 }");
        let material = Material::from_young(2.0, 0.2).unwrap();
        let layer = Layer::new(material, 1.0, Interface::Bonded).unwrap();
        let one = HalfSpace::new(vec![layer], plain.half_space().material(8));
        assert!(difference(plain.problem().bodies(), &one.into(), [0.1, 30.0]) < 1e-12);
        assert_eq!(plain.half_space().layers().len(), 7);
        assert!(sublayer_error(&plain).unwrap() < 1e-12);
    }

    #[test]
    fn a_grading_drives_out_the_moduli_it_stands_for_and_is_refused_beside_them() {
        let read = |set: &str| Case::read(&crate::case::embedded::source("fig2").unwrap(), &[set.to_owned()]);
        let case = read("layers.0.graded={ young = [2, 1], poisson = [0.2, 0.3], sublayers = 4 }").unwrap();
        assert_eq!(case.half_space().layers().len(), 4);
        let refused = |set: &str| read(set).unwrap_err().to_string();
        assert!(refused("layers.0.graded={ young = 2, poisson = [0.2, 0.3] }").contains("upper and the lower face"));
        assert!(refused("layers.0.graded={ young = [2, 1], poisson = [0.2, 0.3], sublayers = 201 }").contains("200"));
        let both =
            "layers=[{ thickness = 1, young = 2, poisson = 0.3, graded = { young = [2, 1], poisson = [0.2, 0.3] } }]";
        assert!(refused(both).contains("exclude each other"));
        let layer = "{ thickness = 1, graded = { young = [2, 1], poisson = [0.2, 0.3], sublayers = 150 } }";
        assert!(refused(&format!("layers=[{layer}, {layer}]")).contains("at most 200 layers and sublayers, not 300"));
    }

    #[test]
    fn a_graded_layer_is_written_as_it_was_read() {
        let graded = case("{ shear_ratio = [3, 1], poisson = [0.2, 0.4], sublayers = 3 }");
        let source = Source { name: "case.toml".to_owned(), text: graded.to_toml(), ..Source::default() };
        assert_eq!(Case::read(&source, &[]).unwrap(), graded);
        assert!(graded.to_toml().contains("law = \"linear\"") && !graded.to_toml().contains("residual"));
    }
}
