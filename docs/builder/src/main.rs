//! Builds the book of percoat and the page that computes: runs every command of its pages and compares what they print, typesets the
//! equations, and checks every link.
//!
//! `cargo run -p percoat-book -- --percoat target/release/percoat target/book`

mod cells;
mod generated;
mod links;
mod math;
mod page;
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
    /// A Python with the package percoat, which runs the Python of the pages; without it they are not run
    #[arg(long)]
    python: Option<PathBuf>,
    /// The module of the page that computes; without it there is no such page
    #[arg(long)]
    wasm: Option<PathBuf>,
    /// Write what the commands print into the sources, where it differs
    #[arg(long)]
    write: bool,
    /// Build only the pages whose path contains this text
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
        let wanted = arguments.only.as_ref().is_none_or(|only| path.to_string_lossy().contains(only));
        let mut page = cells::Page::read(&text).with_context(|| path.display().to_string())?;
        if wanted {
            let ran = tools.run(&mut page, &to).with_context(|| path.display().to_string())?;
            if arguments.write && !ran.is_empty() {
                fs::write(&from, page.source())?;
                println!("written: {}", from.display());
            } else {
                differences.extend(ran.into_iter().map(|text| format!("{}: {text}", from.display())));
            }
        }
        source::copy_pictures(&text, &from, &to)?;
        let text = generated::filled(&page.source(), &tools)?;
        fs::write(&to, math::typeset(&text).with_context(|| path.display().to_string())?)?;
    }
    fs::copy(arguments.docs.join("book.toml"), place.path().join("book.toml"))?;
    source::copy_folder(&arguments.docs.join("theme"), &place.path().join("theme"))?;
    build(place.path(), &arguments.output)?;
    if let Some(wasm) = &arguments.wasm {
        page::bundle(&arguments.docs.join("page/web"), wasm, &arguments.output.join("page/index.html"))?;
    }
    differences.extend(links::broken(&arguments.output, arguments.wasm.is_some())?);
    for difference in &differences {
        eprintln!("{difference}\n");
    }
    match differences.len() {
        0 => println!("the book is in {}", arguments.output.display()),
        count => bail!("{count} faults; --write takes over what commands print"),
    }
    Ok(())
}

/// Makes the folder of a file.
fn make_parent(file: &Path) -> Result<()> {
    Ok(file.parent().map_or(Ok(()), fs::create_dir_all)?)
}

fn build(root: &Path, output: &Path) -> Result<()> {
    let mut book = MDBook::load(root)?;
    if output.exists() {
        fs::remove_dir_all(output)?;
    }
    fs::create_dir_all(output)?;
    book.config.build.build_dir = output.canonicalize()?;
    book.build()
}
