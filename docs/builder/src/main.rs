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
    /// Write what the commands print and draw into the sources, where it differs
    #[arg(long)]
    write: bool,
    /// Run only the pages whose path contains this text
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
            // Pictures that a page has made stand there already.
            if !to.is_file() {
                source::copy(&from, &to)?;
            }
            continue;
        }
        let (text, found) = ran(&from, &to, &tools, &arguments)?;
        differences.extend(found);
        let text = source::with_pictures(&text, &from, &to)?;
        fs::write(&to, math::typeset(&text).with_context(|| path.display().to_string())?)?;
    }
    // The README is no page of the book, but its commands run too.
    let readme = arguments.docs.join("../README.md");
    differences.extend(ran(&readme, &place.path().join("README.md"), &tools, &arguments)?.1);
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
        count => bail!("{count} faults; --write takes over what commands print and draw"),
    }
    Ok(())
}

/// The page of the file `from`, run if it is wanted; and what differs from what it shows, unless that could be written into the sources.
fn ran(from: &Path, to: &Path, tools: &run::Tools, arguments: &Arguments) -> Result<(String, Vec<String>)> {
    let name = from.display().to_string();
    let text = fs::read_to_string(from)?;
    let mut page = cells::Page::read(&text).with_context(|| name.clone())?;
    if arguments.only.as_ref().is_some_and(|only| !name.contains(only)) {
        return Ok((text, Vec::new()));
    }
    if !tools.can_run(&page) {
        eprintln!("{name} is not run: --python names a Python with the package");
        return Ok((text, Vec::new()));
    }
    let run::Ran { mut differences, pictures } = tools.run(&mut page, to).with_context(|| name.clone())?;
    let (text, found) = generated::renewed(&page.source(), tools).with_context(|| name.clone())?;
    differences.extend(found);
    if arguments.write && differences.iter().any(|difference| difference.is_taken) {
        fs::write(from, &text)?;
        println!("written: {name}");
        differences.retain(|difference| !difference.is_taken);
    }
    let mut told: Vec<String> =
        differences.into_iter().map(|difference| format!("{name}: {}", difference.text)).collect();
    for picture in pictures {
        let [made, kept] = [to, from].map(|page| source::beside(page, &picture));
        match is_current(&kept, &made, tools)? {
            true => {}
            false if arguments.write => source::copy(&made, &kept)?,
            false => told.push(format!("{name}: the picture {picture} is not the one that is drawn")),
        }
    }
    Ok((text, told))
}

/// Whether a picture that is kept shows the words and numbers of one that was drawn.
fn is_current(kept: &Path, made: &Path, tools: &run::Tools) -> Result<bool> {
    if !kept.is_file() {
        return Ok(false);
    }
    let [kept, made] = [fs::read_to_string(kept)?, fs::read_to_string(made)?].map(|svg| source::words(&svg));
    Ok(tools.alike(&kept, &made))
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
