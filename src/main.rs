//! The program `percoat`.

use std::process::ExitCode;

// The allocator of musl returns every large block to the system and takes it anew, with a page fault for each 4 kB.
#[cfg(target_env = "musl")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    ExitCode::from(percoat::command::main(std::env::args_os()))
}
