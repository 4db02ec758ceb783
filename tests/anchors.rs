//! Closed forms and converged numbers of contact mechanics that the whole solver is held against.

#![allow(clippy::excessive_precision, reason = "reference values keep the digits they were computed with")]

mod anchors {
    mod isolated;
    mod lattice_sums;
    mod paper;
    mod periodic_hertz;
    mod radius;
    mod series;
    mod support;
    mod waves;
}
