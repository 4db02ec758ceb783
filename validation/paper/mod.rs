//! The paper itself: Figs 2 to 7 and Table 1 of Goryacheva & Torskaya (2019) with the parameters as printed, and every
//! statement of its §§ 3 and 4 held against what comes out.
//!
//! A figure is a study of its own: it draws the picture as the paper does, from the converged spectral solution and,
//! where the paper has it, without mutual effect. Its [`Claim`]s are judged by numbers; that a claim of the
//! paper does not hold is no failure, that it fares otherwise than found is one. [`table`] writes all of them into
//! `validation/paper/README.md`.

mod against;
mod apart;
mod asymmetry;
mod claim;
#[path = "fig2/study.rs"]
mod fig2;
#[path = "fig3/study.rs"]
mod fig3;
#[path = "fig4/study.rs"]
mod fig4;
#[path = "fig5/study.rs"]
mod fig5;
#[path = "fig6/study.rs"]
mod fig6;
#[path = "fig7/study.rs"]
mod fig7;
mod model;
mod spot;
pub mod table;
#[path = "table1/study.rs"]
mod table1;
mod under;

pub use claim::{Claim, Rule, Test, Verdict, pinned};

use super::Study;

/// The studies, in the order of the paper.
pub const STUDIES: [Study; 7] =
    [fig2::STUDY, fig3::STUDY, table1::STUDY, fig4::STUDY, fig5::STUDY, fig6::STUDY, fig7::STUDY];
