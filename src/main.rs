//! The program `percoat`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(percoat::command::main(std::env::args_os()))
}
