//! `[surface.random]`: a self-affine surface from a seed instead of a file.

use super::super::error::Refusal;
use super::super::keys::{Form, Key, Range, Unit};
use super::super::reader::TableAt;
use super::super::section::{ReadTable, demanded, section};
use percoat_core::counterbody::roughness::{Rms, SelfAffine};
use percoat_core::lattice::Cell;

const SIZE: Form = Form::Number(Range::Size);

section! {
    /// The section `[surface.random]`, complete.
    #[derive(Copy)]
    pub struct RandomSection = RANDOM, rules one_amplitude {
        /// the Hurst exponent
        pub hurst: f64 = Key::new(&[Form::Number(Range::between(0.0, 1.0))], "0.8"),
        /// the longest wavelength
        pub longest: Option<f64> = Key::new(&[SIZE], "1.0").unit(Unit::Length).otherwise("that of the cell"),
        /// the wavelength above which the spectrum is constant
        pub rolloff: Option<f64> = Key::new(&[SIZE], "0.5").unit(Unit::Length).otherwise("`longest`"),
        /// the shortest wavelength
        pub shortest: f64 =
            Key::new(&[SIZE], "0.25").unit(Unit::Length).rule("`shortest` ≤ `rolloff` ≤ `longest`"),
        /// root mean square of the slope
        pub rms_slope: Option<f64> = Key::new(&[Form::Number(Range::POSITIVE)], "0.1"),
        /// root mean square of the heights
        pub rms_height: Option<f64> = Key::new(&[SIZE], "0.02").unit(Unit::Length).instead_of("rms_slope"),
        /// seed of the random numbers
        pub seed: usize = Key::new(&[Form::Integer(0, i64::MAX as usize)], "1").default("0"),
    }
}

fn one_amplitude(_: &RandomSection, section: &TableAt<'_>) -> Result<(), Refusal> {
    section.one_of(["rms_slope", "rms_height"]).map(drop)
}

impl RandomSection {
    /// Reads the section; `longest` defaults to the longest wave of `cell`.
    pub(super) fn read_in(section: &TableAt<'_>, cell: Cell) -> Result<Self, Refusal> {
        let random = Self::read_table(section)?;
        let [x, y] = cell.reduced().short();
        // The wave whose crests are the densest lines of the lattice, which are farthest apart.
        let of_cell = cell.area() / x.hypot(y);
        let longest = random.longest.unwrap_or(of_cell);
        let (rolloff, shortest) = (random.rolloff.unwrap_or(longest), random.shortest);
        if !(shortest <= rolloff && rolloff <= longest) {
            let what = format!(
                "`{}` ≤ `rolloff` ≤ `longest` must hold of the wavelengths, not {shortest} ≤ {rolloff} ≤ {longest}",
                section.path("shortest")
            );
            return Err(Refusal::new(section.value("shortest")?.node.span, what, "no band of wavelengths")
                .help("`rolloff` is `longest` when not given, and that is the longest wave of the cell"));
        }
        Ok(Self { longest: Some(longest), rolloff: Some(rolloff), ..random })
    }

    /// The section as a [`SelfAffine`].
    pub fn surface(&self) -> SelfAffine {
        let Self { hurst, longest, rolloff, shortest, rms_slope, rms_height, seed } = *self;
        let rms = rms_slope.map_or_else(|| Rms::Height(demanded(rms_height)), Rms::Slope);
        let [longest, rolloff] = [longest, rolloff].map(demanded);
        SelfAffine { hurst, longest, rolloff, shortest, rms, seed: seed as u64 }
    }
}
