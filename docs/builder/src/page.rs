//! The page that computes, in one file: its style, its scripts and its module within, so that it works from a disk too.

use anyhow::{Context, Result};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::fs;
use std::io::Write;
use std::path::Path;

/// Writes the page of the folder `web` with the module `wasm` to a file.
pub fn bundle(web: &Path, wasm: &Path, to: &Path) -> Result<()> {
    let read = |name: &str| fs::read_to_string(web.join(name)).with_context(|| web.join(name).display().to_string());
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    packed.write_all(&fs::read(wasm).with_context(|| wasm.display().to_string())?)?;
    let module = STANDARD.encode(packed.finish()?);
    let worker = read("worker.js")?.replace('\\', "\\\\").replace('`', "\\`").replace("${", "\\${");
    let scripts = format!(
        "{}\nconst WORKER = `{worker}`;\nconst MODULE = \"{module}\";\n{}",
        read("state.js")?,
        read("page.js")?
    );
    let page = read("index.html")?.replace("/* page.css */", &read("page.css")?).replace("/* bundled */", &scripts);
    crate::make_parent(to)?;
    Ok(fs::write(to, page)?)
}
