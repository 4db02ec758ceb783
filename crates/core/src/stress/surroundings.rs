//! Stresses around the window of an isolated contact.
//!
//! The pressure ends in the window, its field does not: stiff layers bend, and tension at the surface or lift-off of an interface may be
//! largest several contact radii away. So the search goes on in windows each twice as wide as the one before, outside of that one. There
//! the short waves of the pressure have decayed: with m the least distance from loaded samples to the window before, the waves
//!
//! φ(q) P(**q**),  φ = ½ erfc(β(q/q₁ − 1)),  q₁ = 2ββ′/m
//!
//! leave e^{−β′²} of the stresses, and a grid of some hundred samples holds them, however wide the window is.
//!
//! **Where it ends.** Beyond half the size of the contact and what its [stiff layers reach](crate::body::HalfSpace::bending_reach)
//! stresses only decay: none beyond a window is larger than the largest one on its border, b. The search ends in the first window that is as
//! wide and on whose border no measure is larger than both, inside and at rest, or b is a thousandth of the largest pressure: where one at rest is
//! larger, as σ_zz = 0 than a compression, so far. A value that is stated from a border, or is no larger than at rest, has an error that covers
//! the measure at rest raised by b. So have faint ones, less than a thousandth of the largest pressure, that lie deeper than four windows and by
//! which no strength is judged: they are not followed.

use super::far_field::FarField;
use super::field::StressField;
use super::found::{Following, FoundStresses};
use super::loaded_window::{MOST_WINDOWS, passed};
use super::measure::Sought;
use super::series::Series;
use super::tensor::StressState;
use super::window_waves::window_waves;
use crate::lattice::{Cell, Grid};
use std::sync::Arc;

/// Part of the largest pressure below which stresses on the border of a window, and measures deep under it, are not followed beyond it.
const FAINT: f64 = 1e-3;

impl StressField {
    /// The field in the window of a number from 1 around an isolated contact, outside of the window of the number before it; `None` of
    /// a periodic system.
    pub(super) fn around(&self, number: u32) -> Option<&Self> {
        let field = self.around.get(number as usize - 1)?;
        if field.get().is_none() {
            // Not within the lock: threads that wait for it would be those that work on it.
            let _ = field.set(self.made_around(number).map(Box::new));
        }
        field.get()?.as_deref()
    }

    fn made_around(&self, number: u32) -> Option<Self> {
        let loaded = self.loaded.as_ref()?;
        let (most, points) = loaded.extent.cut(number);
        let [window, hole] = [number, number - 1].map(|number| Cell::window(loaded.extent.sides(number)));
        let (window, hole) = (window.expect("multiples of a window are windows"), hole.ok()?);
        let grid = Arc::new(Grid::new(window, points).expect("a window has samples"));
        let tables = self.tables().around();
        let series_grid = tables.series_grid(&grid);
        let waves = Arc::clone(series_grid.waves());
        let coefficients = window_waves(&waves, series_grid.cell(), &loaded.traction)
            .scaled(|number| passed(waves.wavenumbers()[waves.shells()[number] as usize] / most));
        let far_tables = tables.far(window, self.half_space(), self.form());
        let far = FarField::new(far_tables, &loaded.traction, series_grid.cell());
        Some(self.outside(hole, [grid, series_grid], Series::of_waves(waves, coefficients), far))
    }

    /// The contenders for what is `sought` in the cell, or in the window of an isolated contact and around it as far as larger values
    /// may lie; `None` when `goes_on` returns false.
    pub(super) fn found_everywhere(
        &self,
        radii: [f64; 2],
        sought: Sought,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<FoundStresses> {
        let all = vec![[true; 2]; self.materials()];
        let mut found = self.found(radii, sought, &all, goes_on)?;
        let strains = sought.strains(self.half_space()) && !self.regions().have_edges();
        if let Some(hookean) = strains.then(|| self.hookean()).flatten() {
            found.contenders.extend(&hookean.found(radii, sought, &all, goes_on)?.contenders);
        }
        let Some(loaded) = &self.loaded else { return Some(found) };
        found.at_rest = (1..=self.materials()).map(|material| self.at_rest(material)).collect();
        let (extent, reach) = (&loaded.extent, loaded.reach);
        let (strengths, faint) = (self.half_space().strengths().collect(), FAINT * loaded.traction.largest());
        let lives = self.half_space().durabilities().map(|durability| durability.strain_life).collect();
        found.following = Some(Following { strengths, lives, faint, depth: extent.deep() });
        for number in 1..=MOST_WINDOWS {
            let wanted = match extent.margin(number - 1) < reach {
                true => all.clone(),
                false => found.may_be_larger_outside(),
            };
            if !wanted.as_flattened().contains(&true) {
                break;
            }
            let wide = self.around(number)?;
            let mut around = wide.found(extent.radii(number), sought, &wanted, goes_on)?;
            (around.resolution, around.is_exact_below) = (found.resolution, found.is_exact_below);
            around.left_out = extent.left_out(number);
            found.around.push(around);
        }
        Some(found)
    }

    /// The state without load in a material.
    pub(super) fn at_rest(&self, material: usize) -> StressState {
        let residual = self.half_space().residual_stresses().nth(material - 1).unwrap_or(0.0);
        StressState { xx: residual, yy: residual, ..StressState::default() }
    }
}
