//! What the formulas of heat are tested against: differential equations solved point by point, and closed forms in space.

pub mod collocation;
mod element;
mod moving_band;
pub mod stacks;
