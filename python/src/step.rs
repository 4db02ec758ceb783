//! A solved load step: its fields, where they are, and what is inside the body.

use crate::case::Case;
use crate::errors::refused;
use crate::interior;
use crate::record::to_python;
use crate::work;
use ndarray::ArrayView2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2};
use percoat::case::resources::Job;
use percoat::output::{read_checkpoint, write_checkpoint};
use percoat::reading::StressReading;
use percoat::run::{Cut, StressRequest};
use percoat::spectral::Checkpoint;
use percoat::{MeanStress, Solver, StressField, case};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::io::Cursor;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// What stays of a step.
#[derive(Debug)]
pub struct Kept {
    pub case: Arc<case::Case>,
    pub step: percoat::Step,
    pub checkpoint: Checkpoint,
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
    fn mean(&self) -> MeanStress {
        self.case.stress.as_ref().map_or(MeanStress::default(), |stress| stress.mean)
    }

    /// The stress field under it.
    pub fn field(&self) -> StressField {
        StressField::new(self.step.finest(), self.mean())
    }
}

/// Components on a section, its points, and what its rows are.
type Cross<'py> = ([Bound<'py, PyArray1<f64>>; 4], Bound<'py, PyArray1<i32>>, Bound<'py, PyArray3<f64>>);

#[pymethods]
impl Step {
    /// Pressure, a view of where it is; nothing is copied.
    #[getter]
    fn pressure<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        Self::shared(slf, slf.get().0.step.pressure())
    }

    /// Gap, a view of where it is; nothing is copied.
    #[getter]
    fn gap<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        Self::shared(slf, slf.get().0.step.gap())
    }

    /// Displacement, an array of its own.
    fn displacement<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let kept = Arc::clone(&self.0);
        Ok(work::run(py, None, None, move |_| kept.step.displacement())?.into_pyarray(py))
    }

    /// Stresses at points (n, 3), of the material of this number where a depth is an interface.
    #[pyo3(signature = (points, material = None))]
    fn stress<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        material: Option<i64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (kept, points) = (Arc::clone(&self.0), points.as_array().to_owned());
        let states = work::run(py, None, None, move |listener| interior::at(&kept, points.view(), material, listener))?;
        Ok(states.map_err(refused)?.into_pyarray(py))
    }

    /// Twelve components on a plane (12, n₁, n₂), and the material it is in.
    #[pyo3(signature = (z, points = None, material = None))]
    fn plane<'py>(
        &self,
        py: Python<'py>,
        z: f64,
        points: Option<Vec<i64>>,
        material: Option<i64>,
    ) -> PyResult<(Bound<'py, PyArray3<f64>>, usize)> {
        let kept = Arc::clone(&self.0);
        let plane = work::run(py, None, None, move |listener| interior::plane(&kept, z, points, material, listener))?;
        let (components, material) = plane.map_err(refused)?;
        Ok((components.into_pyarray(py), material))
    }

    /// A vertical cut as the key `stress.section` of a case has it, or the case's own: s, x, y; z and material of each row;
    /// twelve components (12, rows, points).
    #[pyo3(signature = (cut = None))]
    fn section<'py>(&self, py: Python<'py>, cut: Option<&Bound<'py, PyAny>>) -> PyResult<Cross<'py>> {
        let kept = Arc::clone(&self.0);
        let request = match cut {
            Some(cut) => {
                let (case, cut) = (Arc::clone(&kept.case), crate::toml::value(cut, "stress.section")?);
                work::run(py, None, None, move |_| interior::request(&case, &cut))?.map_err(refused)?
            }
            None => kept.case.run().stress.unwrap_or_default(),
        };
        let StressRequest { cut: Some(cut), .. } = request else {
            return Err(refused("say where the section begins and where it leads: the case asks for none"));
        };
        let (line, sides, components) = work::run(py, None, None, move |_| {
            let Cut { line, .. } = cut;
            let depths = cut.depths(kept.step.problem().half_space());
            (line, depths.clone(), interior::section(&kept, &line, &depths))
        })?;
        let places = line.places();
        let [x, y] = [0, 1].map(|axis| places.iter().map(|place| place[axis]).collect::<Vec<f64>>());
        let z: Vec<f64> = sides.iter().map(|depth| depth.z).collect();
        let materials: Vec<i32> = sides.iter().map(|depth| depth.material as i32).collect();
        let own = [line.distances(), x, y, z].map(|values| values.into_pyarray(py));
        Ok((own, materials.into_pyarray(py), components.into_pyarray(py)))
    }

    /// The largest stresses, as a dict; `None` without contact.
    fn maxima<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let kept = Arc::clone(&self.0);
        let stress = work::run(py, None, None, move |listener| {
            let reading = kept.step.reading();
            let stop = listener.stop();
            let goes_on = || !stop.load(Ordering::Relaxed);
            (reading.max_pressure > 0.0)
                .then(|| StressReading::of_while(&kept.step, &reading, &kept.field(), &goes_on))
                .flatten()
        })?;
        stress.map(|stress| to_python(py, &stress)).transpose()
    }

    /// What the step is made again of, see [`step`].
    fn checkpoint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let mut bytes = Cursor::new(Vec::new());
        write_checkpoint(&mut bytes, &self.0.checkpoint).map_err(refused)?;
        Ok(PyBytes::new(py, &bytes.into_inner()))
    }
}

impl Step {
    /// A field of a step, where it is.
    #[expect(unsafe_code, reason = "NumPy is shown memory that belongs to the step")]
    fn shared<'py>(slf: &Bound<'py, Self>, field: ArrayView2<'_, f64>) -> Bound<'py, PyArray2<f64>> {
        // SAFETY: the array keeps the step alive, which neither changes nor moves its fields; nobody can write through it.
        let array = unsafe { PyArray2::borrow_from_array(&field, slf.clone().into_any()) };
        drop(array.readwrite().make_nonwriteable());
        array
    }
}

/// A step of a case again, of what was kept of it: `index` is that of its load, from 0.
#[pyfunction]
pub fn step(py: Python<'_>, case: &Bound<'_, Case>, index: usize, points: [usize; 2], bytes: &[u8]) -> PyResult<Step> {
    case.get().allow(Job::Keep)?;
    let (case, bytes) = (Arc::clone(&case.get().own), bytes.to_vec());
    let kept = work::run(py, None, None, move |_| {
        let checkpoint = read_checkpoint(Cursor::new(bytes)).map_err(|error| error.to_string())?;
        let load = *case.load.loads().get(index).ok_or("the case has no such load")?;
        let mut solver =
            Solver::new(Arc::clone(case.problem()), points, case.solver).map_err(|error| error.to_string())?;
        let step = solver.restore(load, checkpoint.clone()).map_err(|error| error.to_string())?;
        Ok::<_, String>(Kept { case, step, checkpoint })
    })?;
    Ok(kept.map_err(refused)?.into())
}
