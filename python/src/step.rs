//! A solved load step: its fields on the surface, and stresses and displacements inside the body.

use crate::case::Case;
use crate::errors::refused;
use crate::interior;
use crate::record::to_python;
use crate::value::value;
use crate::work;
use ndarray::{Array2, Array3, ArrayView2};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2};
use percoat::case::resources::Job;
use percoat::output::{read_checkpoint, write_checkpoint};
use percoat::reading::StressReading;
use percoat::run::StressRequest;
use percoat::spectral::Checkpoint;
use percoat::{HalfSpace, Solver, StressFields, case};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::io::Cursor;
use std::sync::Arc;

/// A solved load step, its case, and the checkpoint from which it can be restored; `None` of a contact that sticks, whose steps follow from
/// those before.
#[derive(Debug)]
pub struct Kept {
    pub case: Arc<case::Case>,
    pub step: percoat::Step,
    pub checkpoint: Option<Checkpoint>,
}

/// A solved load step.
#[pyclass(frozen, skip_from_py_object, module = "percoat._core")]
#[derive(Debug, Clone)]
pub struct Step(Arc<Kept>);

impl From<Kept> for Step {
    fn from(kept: Kept) -> Self {
        Self(Arc::new(kept))
    }
}

impl Kept {
    /// The stress fields under the contact.
    fn fields(&self) -> StressFields {
        let strains = self.case.stress.as_ref().is_some_and(|stress| stress.strain);
        StressFields::new(self.step.finest(), self.case.mean_stress()).with_strains(strains)
    }

    /// The half-space of this name, "body" or "counterbody".
    fn half_space(&self, body: &str) -> Result<&HalfSpace, String> {
        let bodies = self.step.problem().bodies();
        match body {
            "body" => Ok(bodies.body()),
            "counterbody" => bodies.counterbody().ok_or_else(|| {
                "the counterbody of the case is rigid: it has no stresses; give it a section [counterbody]".to_owned()
            }),
            other => Err(format!("body is \"body\" or \"counterbody\", not {other:?}")),
        }
    }
}

/// Twelve components on a plane (12, n₁, n₂), or 22 with its strains, the number of its material, from 1, and the name where it has one.
type Plane<'py> = (Bound<'py, PyArray3<f64>>, usize, Option<&'static str>);

/// Section: s, x, y of its points and z of its rows; the materials of the rows; the components (12, rows, points), or 22
/// with its strains.
type Cross<'py> = ([Bound<'py, PyArray1<f64>>; 4], Bound<'py, PyArray1<i32>>, Bound<'py, PyArray3<f64>>);

/// Traction, slip and energy per area.
type Slipped<'py> = (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray3<f64>>, Bound<'py, PyArray2<f64>>);

#[pymethods]
impl Step {
    /// Contact pressure (n₁, n₂), a view of the memory of the step.
    #[getter]
    fn pressure<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        Self::shared(slf, slf.get().0.step.pressure())
    }

    /// Gap (n₁, n₂), a view of the memory of the step.
    #[getter]
    fn gap<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        Self::shared(slf, slf.get().0.step.gap())
    }

    /// Displacement of the surface (n₁, n₂), a new array.
    fn displacement<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let kept = Arc::clone(&self.0);
        Ok(work::run(py, None, None, move |_| kept.step.displacement())?.into_pyarray(py))
    }

    /// Tangential traction on the body and slip (2, n₁, n₂), and the energy per area that slip has dissipated (n₁, n₂), of a contact that
    /// sticks and slips; `None` of another.
    fn shear<'py>(&self, py: Python<'py>) -> Option<Slipped<'py>> {
        let [n1, n2] = self.0.step.grid().points();
        let shear = self.0.step.finest().shear()?;
        let pair = |[x, y]: &[Vec<f64>; 2]| {
            let values = [&x[..], &y[..]].concat();
            Array3::from_shape_fn((2, n1, n2), |(k, i, j)| values[(k * n1 + i) * n2 + j]).into_pyarray(py)
        };
        let work = Array2::from_shape_fn((n1, n2), |(i, j)| shear.work[i * n2 + j]).into_pyarray(py);
        Some((pair(&shear.traction), pair(&shear.slip), work))
    }

    /// Tension (n₁, n₂) of surfaces that adhere; `None` of others.
    fn tension<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        let [n1, n2] = self.0.step.grid().points();
        let tension = self.0.step.finest().tensions()?;
        Some(Array2::from_shape_fn((n1, n2), |(i, j)| tension[i * n2 + j]).into_pyarray(py))
    }

    /// Temperature (n₁, n₂) of the body's surface; `None` where nothing heats.
    fn surface_temperature<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        let [n1, n2] = self.0.step.grid().points();
        let heat = self.0.step.finest().heat()?;
        Some(Array2::from_shape_fn((n1, n2), |(i, j)| heat.body[i * n2 + j]).into_pyarray(py))
    }

    /// Stresses (n, 6) at points (n, 3), or their strains; on an interface in the material of this number, from 1.
    #[pyo3(signature = (points, material = None, body = "body", strain = false))]
    fn at_points<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        material: Option<i64>,
        body: &str,
        strain: bool,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let side = self.0.half_space(body).map_err(refused)?.side();
        let (kept, points) = (Arc::clone(&self.0), points.as_array().to_owned());
        let components = work::try_run(py, None, None, move |listener| {
            interior::at_points(kept.fields().on(side), points.view(), (material, strain), listener)
        })?;
        Ok(components.into_pyarray(py))
    }

    /// Twelve components on a plane (12, n₁, n₂), at the samples of the contact without `points`, or 22 with its strains; the number of
    /// its material, and the name.
    #[pyo3(signature = (z, points = None, material = None, body = "body", strain = false))]
    fn plane<'py>(
        &self,
        py: Python<'py>,
        z: f64,
        points: Option<Vec<i64>>,
        material: Option<i64>,
        body: &str,
        strain: bool,
    ) -> PyResult<Plane<'py>> {
        let half_space = self.0.half_space(body).map_err(refused)?;
        let (side, kept) = (half_space.side(), Arc::clone(&self.0));
        let points = points.map_or(Ok(kept.step.grid().points()), |points| interior::counts(&points, strain));
        let points = points.map_err(refused)?;
        let (components, material) = work::try_run(py, None, None, move |listener| {
            interior::plane(kept.fields().on(side), z, points, (material, strain), listener)
        })?;
        let name = half_space.material_id(material).name;
        Ok((components.into_pyarray(py), material, name.map(|name| name.text())))
    }

    /// Twelve components, or 22 with the strains, on the vertical cut of this value of the key `stress.section`, without one on that of
    /// the case.
    #[pyo3(signature = (cut = None, body = "body", strain = false))]
    fn section<'py>(
        &self,
        py: Python<'py>,
        cut: Option<&Bound<'py, PyAny>>,
        body: &str,
        strain: bool,
    ) -> PyResult<Cross<'py>> {
        let side = self.0.half_space(body).map_err(refused)?.side();
        let kept = Arc::clone(&self.0);
        let request = match cut {
            Some(cut) => kept.case.section(&value(cut, "stress.section")?).map_err(refused)?,
            None => kept.case.run().stress.unwrap_or_default(),
        };
        let StressRequest { cut: Some(cut), .. } = request else {
            return Err(refused("say where the section begins and where it leads: the case asks for none"));
        };
        let (line, sides, components) = work::run(py, None, None, move |_| {
            let fields = kept.fields();
            let depths = cut.depths(fields.on(side).half_space());
            let components = interior::section(fields.on(side), &cut.line, &depths, strain);
            (cut.line, depths, components)
        })?;
        let places = line.places();
        let [x, y] = [0, 1].map(|axis| places.iter().map(|place| place[axis]).collect::<Vec<f64>>());
        let z: Vec<f64> = sides.iter().map(|depth| depth.z).collect();
        let materials: Vec<i32> = sides.iter().map(|depth| depth.material as i32).collect();
        let coordinates = [line.distances(), x, y, z].map(|values| values.into_pyarray(py));
        Ok((coordinates, materials.into_pyarray(py), components.into_pyarray(py)))
    }

    /// The largest stresses, and strains where the case asks for them, as a dict; `None` where nothing acts on the bodies.
    fn maxima<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let kept = Arc::clone(&self.0);
        let stress = work::run(py, None, None, move |listener| {
            let reading = kept.step.reading();
            let acts = kept.step.finest().net_pressures().iter().any(|pressure| *pressure != 0.0);
            acts.then(|| StressReading::of_while(&kept.step, &reading, &kept.fields(), &listener.goes_on())).flatten()
        })?;
        stress.map(|stress| to_python(py, &stress)).transpose()
    }

    /// The bytes from which [`step`] restores the step.
    fn checkpoint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let checkpoint = self.0.checkpoint.as_ref().ok_or_else(|| {
            refused(
                "a step of a contact that sticks or adheres cannot be pickled, since it follows from those before: solve its case again",
            )
        })?;
        let mut bytes = Cursor::new(Vec::new());
        write_checkpoint(&mut bytes, checkpoint).map_err(refused)?;
        Ok(PyBytes::new(py, &bytes.into_inner()))
    }
}

impl Step {
    /// The step with its case and checkpoint.
    pub fn kept(&self) -> Arc<Kept> {
        Arc::clone(&self.0)
    }

    /// A field of a step as an array that cannot be written to; nothing is copied.
    #[expect(unsafe_code, reason = "NumPy reads memory that belongs to the step")]
    fn shared<'py>(slf: &Bound<'py, Self>, field: ArrayView2<'_, f64>) -> Bound<'py, PyArray2<f64>> {
        // SAFETY: the array keeps the step alive, which neither changes nor moves its fields; it cannot be written to.
        let array = unsafe { PyArray2::borrow_from_array(&field, slf.clone().into_any()) };
        drop(array.readwrite().make_nonwriteable());
        array
    }
}

/// The step of a case from the bytes of its checkpoint; `index` is that of its load, from 0.
#[pyfunction]
pub fn step(py: Python<'_>, case: &Bound<'_, Case>, index: usize, points: [usize; 2], bytes: &[u8]) -> PyResult<Step> {
    case.get().allow(Job::Keep)?;
    let (case, bytes) = (Arc::clone(&case.get().case), bytes.to_vec());
    let kept = work::try_run(py, None, None, move |_| {
        let checkpoint = read_checkpoint(Cursor::new(bytes))?;
        let load = *case.load.loads().get(index).ok_or("the case has no such load")?;
        let mut solver = Solver::new(Arc::clone(case.problem()), points, case.solver)?;
        let step = solver.restore(load, checkpoint.clone())?;
        Ok(Kept { case, step, checkpoint: Some(checkpoint) })
    })?;
    Ok(kept.into())
}
