//! `contact.npz` as NumPy sees it.
//!
//! `PERCOAT_PYTHON` names the Python to use (default `python3`). Where it has no NumPy the test is skipped, unless
//! `PERCOAT_REQUIRE_NUMPY` is set.

use crate::program::Desk;
use std::env;
use std::path::Path;
use std::process::{Command, Stdio};

#[test]
fn numpy_reads_the_archive_back() {
    let python = env::var_os("PERCOAT_PYTHON").unwrap_or_else(|| "python3".into());
    let mut import = Command::new(&python);
    let has_numpy = import.args(["-c", "import numpy"]).stderr(Stdio::null()).status().is_ok_and(|it| it.success());
    if !has_numpy {
        let reason = format!("{} has no NumPy", python.display());
        assert!(env::var_os("PERCOAT_REQUIRE_NUMPY").is_none(), "{reason}");
        println!("skipped: {reason}");
        return;
    }
    let desk = Desk::new();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/numpy/read_back.py");
    let periodic = ["--no-pictures", "--set", "grid.points=[48, 64]", "--set", "load.mean_pressure=[0.02, 0.06]"];
    let isolated = ["ball-on-disc", "--no-pictures", "--set", "grid.points=[48, 64]"];
    for (name, arguments) in [("two", &periodic[..]), ("ball", &isolated[..])] {
        let folder = desk.solve(name, arguments);
        let output = Command::new(&python).arg(&script).arg(&folder.0).output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
        println!("{said}");
        assert!(output.status.success(), "{name}: {said}");
    }
}
