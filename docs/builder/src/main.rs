//! Builds the book of percoat and the page that computes: runs the blocks `console` and `python` of its pages and compares what they
//! print, typesets the equations, and checks every link. Blocks `sh` are not run: they install, take minutes, or need a cluster.
//!
//! `cargo run -p percoat-book -- --percoat target/release/percoat target/book`

mod cells;
mod generated;
mod links;
mod math;
mod page;
mod python;
mod run;
mod source;

use anyhow::{Context, Result, bail};
use clap::Parser;
use mdbook_driver::MDBook;
use std::fs;
use std::path::{Path, PathBuf};

/// Builds the book and the page that computes into a folder.
#[derive(Debug, Parser)]
struct Arguments {
    /// The folder, which is written anew
    output: PathBuf,
    /// The folder of the book's sources
    #[arg(long, default_value = "docs")]
    docs: PathBuf,
    /// The program whose commands the pages show
    #[arg(long, default_value = "target/release/percoat")]
    percoat: PathBuf,
    /// A Python with the package percoat; without it pages with Python are not run
    #[arg(long)]
    python: Option<PathBuf>,
    /// The module of the page that computes; without it there is no such page
    #[arg(long)]
    wasm: Option<PathBuf>,
    /// Write what the commands print into the sources, where it differs
    #[arg(long)]
    write: bool,
    /// Run only the pages whose path contains this text; links are checked only where all pages are run
    #[arg(long)]
    only: Option<String>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let tools = run::Tools::new(&arguments.percoat, arguments.python.as_deref())?;
    let place = tempfile::tempdir()?;
    let sources = place.path().join("src");
    let mut differences = Vec::new();
    for path in source::files(&arguments.docs.join("src"))? {
        let (from, to) = (arguments.docs.join("src").join(&path), sources.join(&path));
        make_parent(&to)?;
        if path.extension().is_none_or(|ending| ending != "md") {
            fs::copy(&from, &to)?;
            continue;
        }
        let text = fs::read_to_string(&from)?;
        let mut page = cells::Page::read(&text).with_context(|| path.display().to_string())?;
        differences.extend(ran(&mut page, &from, &to, &tools, &arguments)?);
        let text = source::with_pictures(&page.source(), &from, &to)?;
        let text = generated::filled(&text, &tools)?;
        fs::write(&to, math::typeset(&text).with_context(|| path.display().to_string())?)?;
    }
    // The README is no page of the book, but its commands run too.
    let readme = arguments.docs.join("../README.md");
    let mut page = cells::Page::read(&fs::read_to_string(&readme)?)?;
    differences.extend(ran(&mut page, &readme, &place.path().join("README.md"), &tools, &arguments)?);
    fs::copy(arguments.docs.join("book.toml"), place.path().join("book.toml"))?;
    source::copy_folder(&arguments.docs.join("theme"), &place.path().join("theme"))?;
    build(place.path(), &arguments.output)?;
    if let Some(wasm) = &arguments.wasm {
        page::bundle(&arguments.docs.join("page/web"), wasm, &arguments.output.join("page/index.html"))?;
    }
    // Pages that are not run lack their pictures.
    if arguments.only.is_none() && arguments.python.is_some() {
        differences.extend(links::broken(&arguments.output, arguments.wasm.is_some())?);
    }
    for difference in &differences {
        eprintln!("{difference}\n");
    }
    match differences.len() {
        0 => println!("the book is in {}", arguments.output.display()),
        count => bail!("{count} faults; --write takes over what commands print"),
    }
    Ok(())
}

/// Runs the cells of the page of the file `from`, if it is wanted; what differs from what they print, unless that could be written into
/// the file.
fn ran(
    page: &mut cells::Page,
    from: &Path,
    to: &Path,
    tools: &run::Tools,
    arguments: &Arguments,
) -> Result<Vec<String>> {
    if arguments.only.as_ref().is_some_and(|only| !from.to_string_lossy().contains(only)) {
        return Ok(Vec::new());
    }
    let name = from.display().to_string();
    if !tools.can_run(page) {
        eprintln!("{name} is not run: --python names a Python with the package");
        return Ok(Vec::new());
    }
    let mut differences = tools.run(page, to).with_context(|| name.clone())?;
    if arguments.write && differences.iter().any(|difference| difference.is_taken) {
        fs::write(from, page.source())?;
        println!("written: {name}");
        differences.retain(|difference| !difference.is_taken);
    }
    Ok(differences.into_iter().map(|difference| format!("{name}: {}", difference.text)).collect())
}

/// Makes the folder of a file.
fn make_parent(file: &Path) -> Result<()> {
    Ok(file.parent().map_or(Ok(()), fs::create_dir_all)?)
}

/// A file in the folder of a book, without which the folder is not replaced.
const MARK: &str = ".percoat-book";

/// Builds the book into a folder, in the place of an earlier book alone.
fn build(root: &Path, output: &Path) -> Result<()> {
    let mut book = MDBook::load(root)?;
    if output.exists() {
        if !output.join(MARK).is_file() && fs::read_dir(output)?.next().is_some() {
            bail!("{} holds something else than this book: name another folder, or clear it", output.display());
        }
        fs::remove_dir_all(output)?;
    }
    fs::create_dir_all(output)?;
    book.config.build.build_dir = output.canonicalize()?;
    book.build()?;
    Ok(fs::write(output.join(MARK), "Built from docs/: replaced as a whole by the next build.\n")?)
}
