//! `[solver]`: method, tolerance and iterations of the solver.

use super::keys::{Form, Key, Range};
use super::section::{Words, section, words};
use percoat_core::spectral::{Method, Settings};

words! { Method { Preconditioned = "preconditioned", PolonskyKeer = "polonsky-keer", } }

section! {
    for Settings = SOLVER {
        /// method of conjugate gradients
        method = Key::new(&[Form::Word(Method::WORDS)], "\"polonsky-keer\"")
            .default("\"preconditioned\"")
            .rule("not \"polonsky-keer\" under coupled friction"),
        /// energy of the error below 20 tolerance times the elastic energy, penetration outside contact below 10
        /// tolerance times δ, residual ε below the tolerance
        tolerance = Key::new(&[Form::Number(Range::between(1e-14, 1e-4))], "1e-10").default("1e-8"),
        /// most iterations for one load step on one grid
        max_iterations = Key::new(&[Form::Integer(1, usize::MAX)], "2000").default("10000"),
    }
}
