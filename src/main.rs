//! The command line of percoat.

mod command;

use std::process::ExitCode;

fn main() -> ExitCode {
    match command::Arguments::read() {
        Ok(arguments) => command::run(&arguments),
        Err(code) => code,
    }
}
