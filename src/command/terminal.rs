//! Standard error and standard output: colours (<https://no-color.org>), and terminals without a cursor.

use clap::{ColorChoice, ValueEnum};
use percoat_common::plain;
use std::env;
use std::ffi::OsString;
use std::fmt;
use std::io::{self, ErrorKind, IsTerminal, StdoutLock, Write};
use std::path::Path;
use std::sync::OnceLock;

/// Prints a line on standard error, hidden characters as their escapes ([`plain`]). A line that cannot be written is no error.
macro_rules! tell {
    ($($message:tt)*) => {
        $crate::command::terminal::print_line(&percoat_common::plain::lines(&format!($($message)*)))
    };
}
pub(super) use tell;

/// Prints a line on standard error as it is, with percoat's own colours.
pub fn print_line(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Standard output, with hidden characters as their escapes ([`plain`]). A closed pipe is no error: the command goes on to its end
/// and its exit code.
pub struct Out(StdoutLock<'static>);

/// Locks standard output for one writer.
pub fn out() -> Out {
    Out(io::stdout().lock())
}

impl Write for Out {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        unless_unread(self.0.write(bytes), bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        unless_unread(self.0.flush(), ())
    }

    fn write_fmt(&mut self, text: fmt::Arguments<'_>) -> io::Result<()> {
        self.write_all(plain::lines(&text.to_string()).as_bytes())
    }
}

/// The result, or a value in place of the error of a closed pipe.
fn unless_unread<T>(result: io::Result<T>, otherwise: T) -> io::Result<T> {
    match result {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(otherwise),
        result => result,
    }
}

/// Clears the line of the terminal.
pub fn clear_line() {
    let _ = write!(io::stderr(), "\r\x1b[K");
}

/// Prints the place to which the finished steps of an interrupted run, or foreign files beside them, have been moved.
pub fn tell_aside(place: Option<&Path>, quiet: bool) {
    if let (Some(place), false) = (place, quiet) {
        tell!(
            "note: steps of an interrupted run, or files that are not percoat's, were in the place where a result is gathered; they are now in {}",
            plain::path(place)
        );
    }
}

/// Warning of the damage of an earlier run, with the place where the run is kept and what is done. It is printed also with --quiet,
/// since work is lost.
pub fn damage(reason: &str, aside: Option<&Path>, done: &str) -> String {
    let aside = aside.map_or(String::new(), |place| format!("; it is kept in {}", plain::path(place)));
    format!("{reason}{aside}; {done}")
}

/// At most five warnings, then one with the number of the rest; `others` ends its sentence.
pub fn first_five(mut warnings: Vec<String>, others: &str) -> Vec<String> {
    let more = warnings.len().saturating_sub(5);
    warnings.truncate(5);
    warnings.extend((more > 0).then(|| format!("and {more} more{others}")));
    warnings
}

/// Width of a line of standard output in characters; 80 without a terminal.
pub fn width() -> usize {
    let size = terminal_size::terminal_size_of(io::stdout());
    size.map_or(80, |(terminal_size::Width(width), _)| usize::from(width))
}

/// Prints warnings, unless quiet.
pub fn warn(warnings: &[String], quiet: bool) {
    if !quiet {
        warnings.iter().for_each(|warning| tell!("warning: {warning}"));
    }
}

/// The use of colours in messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Colour {
    /// Where a terminal shows it, unless NO_COLOR is set
    #[default]
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// The value of `--color`.
static CHOSEN: OnceLock<Colour> = OnceLock::new();

/// Sets the use of colours in messages.
pub fn choose_colour(colour: Colour) {
    // The use of colours is set once, before any message.
    let _ = CHOSEN.set(colour);
}

fn chosen_colour() -> Colour {
    CHOSEN.get().copied().unwrap_or_default()
}

/// Whether messages may be coloured.
pub fn coloured() -> bool {
    match chosen_colour() {
        Colour::Always => true,
        Colour::Never => false,
        Colour::Auto => moves() && allows_colour(env::var_os("NO_COLOR")),
    }
}

/// Use of colours in the help and in errors of arguments: on terminals with a cursor, also in continuous integration, where clap alone
/// would colour terminals without one.
pub fn parser_colour() -> ColorChoice {
    match chosen_colour() {
        Colour::Always => ColorChoice::Always,
        Colour::Auto if has_cursor(env::var_os("TERM")) && allows_colour(env::var_os("NO_COLOR")) => ColorChoice::Auto,
        Colour::Auto | Colour::Never => ColorChoice::Never,
    }
}

/// Whether lines can be redrawn in their place, as the progress is.
pub fn moves() -> bool {
    io::stderr().is_terminal() && has_cursor(env::var_os("TERM"))
}

fn allows_colour(no_color: Option<OsString>) -> bool {
    no_color.is_none_or(|value| value.is_empty())
}

fn has_cursor(term: Option<OsString>) -> bool {
    term.is_none_or(|name| name != "dumb")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_color_and_a_dumb_terminal_are_obeyed() {
        assert!(allows_colour(None) && allows_colour(Some("".into())) && !allows_colour(Some("1".into())));
        assert!(has_cursor(None) && has_cursor(Some("xterm".into())) && !has_cursor(Some("dumb".into())));
    }
}
