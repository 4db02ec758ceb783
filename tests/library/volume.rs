//! The stress field as a VTK file: what its own bytes, and VTK itself, say.

#![cfg(feature = "cli")]

use crate::common;

use common::Random;
use ndarray::Array2;
use percoat::output::write_volume;
use percoat::{Cell, Depth, Grid, HalfSpace, Interface, Layer, Material, MeanStress, StressField};
use std::collections::HashMap;
use std::env;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;

const POINTS: [usize; 2] = [12, 8];
/// Lengths differ in every direction from index to index, so that swapped axes show.
const SIDE: f64 = 1.5;

fn coated() -> (StressField, Vec<Depth>) {
    let coating = Layer::new(Material::from_shear(5.0, 0.2).unwrap(), 0.25, Interface::Bonded).unwrap();
    let half_space = HalfSpace::new(vec![coating], Material::from_shear(1.0, 0.3).unwrap());
    let grid = Arc::new(Grid::new(Cell::hexagonal(SIDE).unwrap(), POINTS).unwrap());
    let mut random = Random(4711);
    let pressure = Array2::from_shape_fn(POINTS, |_| random.unit());
    let field = StressField::under(&grid, pressure.view(), &half_space, None, MeanStress::Confined).unwrap();
    let depths = [0.0, 0.1, 0.25, 0.5].iter().flat_map(|&z| half_space.depths(z)).collect();
    (field, depths)
}

/// The value of an attribute in an XML tag.
fn attribute<'a>(tag: &'a str, name: &str) -> &'a str {
    let start = tag.find(&format!("{name}=\"")).unwrap() + name.len() + 2;
    &tag[start..start + tag[start..].find('"').unwrap()]
}

/// The head of the file, and its arrays by name.
fn read(path: &Path) -> (String, HashMap<String, Vec<f64>>) {
    let bytes = std::fs::read(path).unwrap();
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let end = bytes.windows(mark.len()).position(|window| window == mark).unwrap();
    let (head, data) = (String::from_utf8(bytes[..end].to_vec()).unwrap(), &bytes[end + mark.len()..]);
    let word = |at: usize| <[u8; 8]>::try_from(&data[at..at + 8]).unwrap();
    let array = |tag: &str| {
        let offset: usize = attribute(tag, "offset").parse().unwrap();
        let count = u64::from_le_bytes(word(offset)) as usize / 8;
        let values = (1..=count).map(|k| f64::from_le_bytes(word(offset + 8 * k))).collect();
        (attribute(tag, "Name").to_owned(), values)
    };
    let arrays = head.lines().filter(|line| line.starts_with("<DataArray")).map(array).collect();
    (head, arrays)
}

#[test]
fn every_point_of_the_file_has_the_state_of_its_place() {
    let (field, depths) = coated();
    assert_eq!(depths.len(), 5, "both sides of the interface");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stress.vts");
    write_volume(&path, &field, &depths, POINTS).unwrap();
    assert_eq!(folder.path().read_dir().unwrap().count(), 1, "no temporary file stays");

    let (head, arrays) = read(&path);
    let [n1, n2] = POINTS;
    assert_eq!(attribute(&head, "WholeExtent"), format!("0 {n1} 0 {n2} 0 4"));
    let names = ["sigma_xx", "sigma_yy", "sigma_zz", "sigma_xy", "sigma_xz", "sigma_yz", "tau1", "mises", "sigma1"];
    let (places, displacement, material) = (&arrays["points"], &arrays["displacement"], &arrays["material"]);
    assert_eq!(arrays.len(), names.len() + 3);
    assert_eq!((places.len(), material.len()), (3 * 13 * 9 * 5, 13 * 9 * 5));

    let cell = field.grid().cell();
    for (k, &depth) in depths.iter().rev().enumerate() {
        for (i, j) in [(0, 0), (5, 2), (n1, 0), (3, n2), (n1, n2)] {
            let index = i + (n1 + 1) * (j + (n2 + 1) * k);
            let [x, y] = cell.point([i as f64 / n1 as f64, j as f64 / n2 as f64]);
            assert_eq!(places[3 * index..][..3], [x, y, -depth.z]);
            assert_eq!(material[index], depth.material as f64);
            let state = field.points(depth, &[[x, y]])[0];
            let [xx, yy, zz, xy, xz, yz, ux, uy, uz] = state.components();
            // z upwards, as coordinates and displacements.
            let expected = [xx, yy, zz, xy, -xz, -yz, state.tau1(), state.mises(), state.s1()];
            for (name, value) in names.iter().zip(expected) {
                assert!((arrays[*name][index] - value).abs() < 1e-11, "{name} at {i}, {j}, {k}");
            }
            for (found, value) in displacement[3 * index..][..3].iter().zip([ux, uy, -uz]) {
                assert!((found - value).abs() < 1e-11, "displacement at {i}, {j}, {k}");
            }
        }
    }
}

/// Along the drawn axes the tensor of the file has the principal stresses that the file gives, and on them the surface
/// displacement gradient of its own coordinates: σ_xz = G(∂u_x/∂z + ∂u_z/∂x) below the surface.
#[test]
fn stresses_displacements_and_coordinates_have_one_set_of_axes() {
    let half_space = HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap());
    let grid = Arc::new(Grid::new(Cell::square(1.0).unwrap(), POINTS).unwrap());
    let wave = |i: usize| 1.0 + (std::f64::consts::TAU * i as f64 / POINTS[0] as f64).cos();
    let pressure = Array2::from_shape_fn(POINTS, |(i, _)| wave(i));
    let field = StressField::under(&grid, pressure.view(), &half_space, None, MeanStress::Confined).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stress.vts");
    let (z, step) = (0.2, 1e-3);
    let depths = [z - step, z, z + step].map(|z| Depth { z, material: 1 });
    write_volume(&path, &field, &depths, POINTS).unwrap();
    let (_, arrays) = read(&path);
    let [n1, n2] = POINTS;
    let at = |i: usize, k: usize| i + (n1 + 1) * (n2 + 1) * k;
    let (places, displacement) = (&arrays["points"], &arrays["displacement"]);
    let i = 2;
    let rise = places[3 * at(i, 2) + 2] - places[3 * at(i, 0) + 2];
    let shear_up = (displacement[3 * at(i, 2)] - displacement[3 * at(i, 0)]) / rise;
    // u_z goes with cos(2πx): its slope at x is −2π tan(2πx) times itself, the mean taken off.
    let angle = std::f64::consts::TAU * i as f64 / n1 as f64;
    let mean: f64 = (0..n1).map(|i| displacement[3 * at(i, 1) + 2]).sum::<f64>() / n1 as f64;
    let along = -(displacement[3 * at(i, 1) + 2] - mean) * std::f64::consts::TAU * angle.tan();
    let stress = arrays["sigma_xz"][at(i, 1)];
    assert!(stress.abs() > 0.1, "{stress} says nothing");
    // Differences over 2e-3: (2π·1e-3)²/6 of the derivative.
    assert!((stress / (shear_up + along) - 1.0).abs() < 1e-4, "{stress} {}", shear_up + along);
}

#[test]
fn an_empty_volume_is_refused_and_leaves_no_file() {
    let (field, depths) = coated();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stress.vts");
    for (depths, points) in [(&[][..], POINTS), (&depths[..], [12, 0])] {
        let error = write_volume(&path, &field, depths, points).unwrap_err().to_string();
        assert!(error.contains("stress.vts") && error.contains("is empty"), "{error}");
    }
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

/// `PERCOAT_PYTHON` names the Python to use (default `python3`). Where it has no VTK the test is skipped, unless
/// `PERCOAT_REQUIRE_VTK` is set.
#[test]
fn vtk_reads_the_file() {
    let python = env::var_os("PERCOAT_PYTHON").unwrap_or_else(|| "python3".into());
    let mut import = Command::new(&python);
    import.args(["-c", "import vtkmodules.vtkIOXML"]).stderr(Stdio::null());
    if !import.status().is_ok_and(|it| it.success()) {
        let reason = format!("{} has no VTK", python.display());
        assert!(env::var_os("PERCOAT_REQUIRE_VTK").is_none(), "{reason}");
        println!("skipped: {reason}");
        return;
    }
    let (field, depths) = coated();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stress.vts");
    write_volume(&path, &field, &depths, POINTS).unwrap();
    let (i, j, k) = (5, 2, 3);
    let place = field.grid().cell().point([i as f64 / POINTS[0] as f64, j as f64 / POINTS[1] as f64]);
    let zz = field.points(depths[depths.len() - 1 - k], &[place])[0].zz;

    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/numpy/read_volume.py");
    let bounds = [0.0, 1.5 * SIDE, 0.0, 0.75f64.sqrt() * SIDE, -0.5, 0.0];
    let output = Command::new(&python)
        .arg(script)
        .arg(&path)
        .args([POINTS[0] + 1, POINTS[1] + 1, depths.len()].map(|n| n.to_string()))
        .args(bounds.map(|x| x.to_string()))
        .args([i, j, k].map(|n| n.to_string()))
        .arg(zz.to_string())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    println!("{said}");
    assert!(output.status.success(), "{said}");
}
