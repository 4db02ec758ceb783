//! The largest strains of the load steps: of each material, and on the faces by which layers are designed.

use super::Table;
use super::by_step::{Quantity, by_step};
use crate::output::number::in_unit;
use percoat_case::units::{Unit, Units};
use percoat_core::body::MaterialId;
use percoat_core::reading::StressReading;
use percoat_core::run::StepRecord;
use percoat_core::stress::Peak;
use percoat_core::stress::maxima::Extremes;

/// Table of the largest strains: the largest principal one of each material, the largest horizontal one at the bottom of each layer, by
/// which it cracks, and the compression on top of each material below the surface, by which it settles. `None` where no step has strains.
pub fn largest_strains(steps: &[StepRecord], units: &Units) -> Option<Table> {
    let any = steps.iter().find_map(|step| step.stress.as_ref().filter(|stress| stress.overall.strain.is_some()))?;
    let row = |name: String, peak: &dyn Fn(&StressReading) -> Option<Peak>| Quantity::of_peaks(name, steps, peak);
    let of_material = |extremes: &Extremes| {
        let material = extremes.tau1.material;
        let [top, bottom] = [0, 1].map(|number| face(any, material, number));
        let inside = row(format!("strain in {material}"), &|stress| stress.in_material(material)?.strain);
        let on_top = top.filter(|face| face.tau1.position[2] > 0.0);
        let on_top = on_top.map(|_| {
            row(format!("compression on top of {material}"), &|stress| face(stress, material, 0)?.compression)
        });
        let below = bottom.map(|_| {
            row(format!("horizontal strain at the bottom of {material}"), &|stress| {
                face(stress, material, 1)?.horizontal_strain
            })
        });
        [Some(inside), on_top, below].into_iter().flatten()
    };
    let rows: Vec<Quantity> = any.materials.iter().flat_map(of_material).collect();
    by_step("largest strain", (&Unit::Strain, in_unit), units, steps, &rows)
}

/// The largest values on a face of a material: the upper one is number 0, the lower one, of a layer, number 1.
fn face(stress: &StressReading, material: MaterialId, number: usize) -> Option<&Extremes> {
    stress.faces.iter().filter(|face| face.tau1.material == material).nth(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::examples;

    fn peak(material: usize, value: f64, z: f64) -> Peak {
        Peak {
            value,
            error: Some(1e-7),
            position: [0.0, 0.0, z],
            material: MaterialId::numbered(material),
            direction: [1.0, 0.0, 0.0],
            rival: None,
        }
    }

    /// Stresses of 1, and strains of these microstrain: principal, horizontal, compression.
    fn extremes(material: usize, z: f64, strains: [f64; 3]) -> Extremes {
        let [strain, horizontal_strain, compression] =
            strains.map(|microstrain| Some(peak(material, 1e-6 * microstrain, z)));
        let stress = peak(material, 1.0, z);
        Extremes { tau1: stress, tension: stress, mises: stress, strain, horizontal_strain, compression }
    }

    #[test]
    fn a_layer_has_its_bottom_and_what_lies_below_its_top() {
        let faces = vec![
            extremes(1, 0.0, [1.0, 2.0, 3.0]),
            extremes(1, 2.0, [4.0, 100.5, 5.0]),
            extremes(2, 2.0, [6.0, 7.0, 251.6]),
        ];
        let materials = vec![extremes(1, 1.0, [120.0, 110.0, 80.0]), extremes(2, 2.0, [90.0, 60.0, 251.6])];
        let stress = StressReading { overall: materials[0], materials, faces, interfaces: vec![], surface_error: 0.0 };
        let mut step = examples::step(1.0, None, 0.5);
        step.stress = Some(stress);
        let table = largest_strains(&[step.clone()], &Units::unknown()).unwrap();
        let rows: Vec<String> = table.rows.iter().map(|row| row[..2].join(": ")).collect();
        assert_eq!(
            rows,
            [
                "strain in material 1: 120.0 ± 0.1",
                "horizontal strain at the bottom of material 1: 100.5 ± 0.1",
                "strain in material 2: 90.0 ± 0.1",
                "compression on top of material 2: 251.6 ± 0.1",
            ]
        );
        assert_eq!(table.head[0], "largest strain (µε)");
        let reading = step.stress.as_mut().unwrap();
        (reading.overall.strain, reading.overall.tau1.value) = (None, f64::INFINITY);
        assert_eq!(largest_strains(&[step], &Units::unknown()), None);
    }
}
