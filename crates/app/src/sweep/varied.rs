//! Ranges of uncertain keys, read for a case, and the combinations by which a sweep tells what they do to its results.
//!
//! `--vary KEY=A:B` is uniform from A to B, `KEY=10%` uniform within 10 % of the case's value, `KEY=normal:MEAN:DEVIATION` or
//! `KEY=normal:5%` normal, `KEY=library` uniform over the range that the library states for the material.
//!
//! With N samples of k keys, rows **a**ⱼ and **b**ⱼ of 2k coordinates of a scrambled Sobol sequence make k + 2 combinations each: **a**ⱼ, **b**ⱼ,
//! and **a**ⱼ with the i-th key of **b**ⱼ, i = 1 … k (A. Saltelli et al., *Comput. Phys. Commun.* 181 (2010) 259–270).

use super::axis::plain;
use super::combinations::{Combination, Combinations, CombinationsError, MOST, keys_once};
use super::design::{Design, Distribution, Varied};
use percoat_case::case::{Case, CaseError, Document, NoRange, Source};
use sobol_burley::sample;

/// Fewest and most samples: points of the sequence.
const SAMPLES: [usize; 2] = [8, 1 << 16];
/// Most keys: two coordinates of the sequence each.
const KEYS: usize = 128;
/// Half the distance of neighbouring coordinates of the sequence, multiples of 2⁻²³.
const HALF: f64 = 1.0 / (1 << 24) as f64;

/// Why keys cannot be varied.
#[derive(Debug, thiserror::Error)]
pub enum VaryError {
    /// The case is refused as it is.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A text is no range of a key, or the case has no number there.
    #[error(
        "--vary {text}: {reason}; write KEY=A:B, KEY=10%, KEY=normal:MEAN:DEVIATION, KEY=normal:5% or KEY=library, for \
         example layers.0.young=190:213"
    )]
    Range {
        /// The text.
        text: String,
        /// The fault.
        reason: String,
    },
    /// A key is given twice, or the combinations are too many.
    #[error(transparent)]
    Combinations(#[from] CombinationsError),
    /// The number of samples is none of a sequence.
    #[error(
        "--samples {0}: the points of a Sobol sequence are even for powers of 2 alone: give one from {least} to {most}",
        least = SAMPLES[0],
        most = SAMPLES[1]
    )]
    Samples(usize),
}

impl Distribution {
    /// The value below which a part of all lies, which is between 0 and 1.
    fn quantile(self, part: f64) -> f64 {
        match self {
            Self::Uniform { from, to } => (1.0 - part) * from + part * to,
            Self::Normal { mean, deviation } => mean + deviation * normal_quantile(part),
        }
    }

    /// Lowest and highest value; of the normal distribution those at the outermost coordinates of the sequence.
    fn ends(self) -> [f64; 2] {
        match self {
            Self::Uniform { from, to } => [from, to],
            Self::Normal { .. } => [HALF, 1.0 - HALF].map(|coordinate| self.quantile(coordinate)),
        }
    }

    /// Number of the value at a coordinate as TOML: as many digits as the coordinate has.
    fn text(self, coordinate: f64) -> String {
        let value = self.quantile(coordinate);
        let width = match self {
            Self::Uniform { from, to } => to - from,
            Self::Normal { deviation, .. } => deviation,
        };
        let digits = (7.0 + (value.abs() / width).log10().max(0.0).ceil()).min(16.0) as usize;
        plain(format!("{value:.digits$e}").parse().unwrap_or(value))
    }
}

/// Φ⁻¹, the quantile of the normal distribution of mean 0 and deviation 1, by bisection.
fn normal_quantile(part: f64) -> f64 {
    let (mut low, mut high) = (-9.0, 9.0);
    for _ in 0..64 {
        let middle: f64 = 0.5 * (low + high);
        let below = 0.5 * libm::erfc(-middle * std::f64::consts::FRAC_1_SQRT_2);
        if below < part { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

impl Varied {
    /// Reads `KEY=RANGE` for a case, which must admit both ends.
    fn read(text: &str, document: &Document<'_>, case: &Case) -> Result<Self, VaryError> {
        let refuse = |reason: String| VaryError::Range { text: text.to_owned(), reason };
        let (key, range) = text.split_once('=').ok_or_else(|| refuse("a key needs a range".to_owned()))?;
        let (key, range) = (key.trim(), range.trim());
        let no_number =
            || refuse(format!("`{key}` is no single number that the case states and that may have any digits"));
        // The number of a text, in the unit of the case.
        let number = |text: &str| match text.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => {
                let case = document.changed(&[format!("{key}={}", text.trim())]);
                case.map_err(|error| refuse(error.message().to_owned()))?.number(key).ok_or_else(no_number)
            }
        };
        // Value of the case, and the part of it that a percentage is.
        let part_of_value = |percent: &str| {
            let value = case.number(key).ok_or_else(no_number)?;
            let part = percent.trim_start_matches('±').trim().parse::<f64>().ok().filter(|part| *part > 0.0);
            let part = part.ok_or_else(|| refuse(format!("`{percent} %` is no part above 0")))?;
            Ok::<_, VaryError>([value, 0.01 * part * value.abs()])
        };
        let distribution = match (range, range.strip_suffix('%'), range.split_once(':')) {
            ("library", ..) => {
                let [from, to] = case.material_range(key).map_err(|why: NoRange| refuse(why.to_string()))?;
                Distribution::Uniform { from, to }
            }
            (_, Some(percent), None) => {
                let [value, part] = part_of_value(percent)?;
                Distribution::Uniform { from: value - part, to: value + part }
            }
            (_, _, Some(("normal", spread))) => {
                let [mean, deviation] = match (spread.strip_suffix('%'), spread.split_once(':')) {
                    (Some(percent), None) => part_of_value(percent)?,
                    (_, Some((mean, deviation))) => [number(mean)?, number(deviation)?],
                    _ => return Err(refuse("a normal distribution has a mean and a deviation".to_owned())),
                };
                Distribution::Normal { mean, deviation }
            }
            (_, _, Some((from, to))) => Distribution::Uniform { from: number(from)?, to: number(to)? },
            _ => return Err(refuse("there is no range behind `=`".to_owned())),
        };
        let is_spread = match distribution {
            Distribution::Uniform { from, to } => from < to,
            Distribution::Normal { deviation, .. } => deviation > 0.0,
        };
        if !is_spread {
            return Err(refuse("the first end must be below the second one, and a deviation above 0".to_owned()));
        }
        for end in distribution.ends().map(plain) {
            let changed = document.changed(&[format!("{key}={end}")]);
            let changed = changed.map_err(|error| refuse(format!("it reaches {end}, and {}", error.message())))?;
            changed.number(key).ok_or_else(no_number)?;
        }
        Ok(Self { key: key.to_owned(), distribution })
    }
}

impl Design {
    /// The samples for uncertain keys, `KEY=RANGE` each, of a case with the settings `fixed` of all combinations.
    ///
    /// # Errors
    /// [`VaryError`].
    pub fn new(
        source: &Source,
        fixed: &[String],
        vary: &[String],
        samples: usize,
        seed: u32,
    ) -> Result<Self, VaryError> {
        if !samples.is_power_of_two() || !(SAMPLES[0]..=SAMPLES[1]).contains(&samples) {
            return Err(VaryError::Samples(samples));
        }
        let document = Document::new(source, fixed)?;
        let case = document.case()?;
        let keys = vary.iter().map(|text| Varied::read(text, &document, &case)).collect::<Result<Vec<_>, _>>()?;
        keys_once(keys.iter().map(|varied| &varied.key[..]))?;
        let design = Self { keys, samples, seed };
        if design.keys.is_empty() {
            return Err(CombinationsError::Nothing.into());
        }
        if design.keys.len() > KEYS || design.count() > MOST {
            return Err(CombinationsError::TooMany(design.count().to_string()).into());
        }
        Ok(design)
    }

    /// All combinations, sample after sample: those of the first samples are the same for any number of them.
    pub fn combinations(&self) -> Combinations {
        let count = self.keys.len();
        let value = |sample_index: usize, matrix: usize, key: usize| {
            let coordinate = sample(sample_index as u32, (matrix * count + key) as u32, self.seed);
            self.keys[key].distribution.text(f64::from(coordinate) + HALF)
        };
        let row = |index: usize| {
            let (sample_index, place) = (index / self.block(), index % self.block());
            // The second row of a block is **b**, and each further one has a single key of it.
            let matrix = |key: usize| usize::from(place == 1 || place == key + 2);
            (0..count).map(|key| value(sample_index, matrix(key), key)).collect()
        };
        let all = (0..self.count()).map(|index| Combination { number: index + 1, values: row(index) });
        let keys = self.keys.iter().map(|varied| varied.key.clone()).collect();
        Combinations { keys, all: all.collect(), design: Some(self.clone()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_case::case::embedded;

    fn design(vary: &[&str], samples: usize) -> Result<Design, VaryError> {
        let vary: Vec<String> = vary.iter().map(|&text| text.to_owned()).collect();
        let fixed = ["load.force=1 N".to_owned()];
        Design::new(&embedded::source("ball-on-disc").unwrap(), &fixed, &vary, samples, 0)
    }

    /// The disc of the case: 3 µm TiAlN, D2 of 210 GPa, which the library has with 190 to 210 GPa.
    #[test]
    fn a_range_is_in_the_unit_of_the_case_or_a_part_of_its_value_or_of_the_library() {
        let uniform = |from: f64, to: f64| Distribution::Uniform { from, to };
        for (text, distribution) in [
            ("layers.0.thickness=2.5:3.5", uniform(2.5, 3.5)),
            ("layers[0].thickness = 2500 nm : 0.0035 mm", uniform(2.5, 3.5)),
            ("layers.0.thickness=10%", uniform(2.7, 3.3)),
            ("layers.0.thickness=±10 %", uniform(2.7, 3.3)),
            // The force of all combinations is set to 1 N.
            ("load.force=20%", uniform(800.0, 1200.0)),
            ("substrate.young=library", uniform(190.0, 210.0)),
            ("friction.coefficient=normal:0.2:0.02", Distribution::Normal { mean: 0.2, deviation: 0.02 }),
            ("substrate.young=normal:210 GPa:5 GPa", Distribution::Normal { mean: 210.0, deviation: 5.0 }),
            ("substrate.young=normal:5%", Distribution::Normal { mean: 210.0, deviation: 10.5 }),
        ] {
            assert_eq!(design(&[text], 8).unwrap().keys[0].distribution, distribution, "{text}");
        }
    }

    #[test]
    fn what_cannot_be_varied_is_refused_with_its_text_and_why() {
        for (text, words) in [
            ("layers.0.thickness", "a key needs a range"),
            ("layers.0.thickness=3", "no range behind `=`"),
            ("layers.0.thickness=3:2", "below the second one"),
            ("layers.0.thickness=0%", "no part above 0"),
            ("layers.0.thickness=x%", "no part above 0"),
            ("layers.0.thickness=-1:2", "it reaches -1"),
            ("layers.0.thickness=1 N:2 N", "it must be a length"),
            ("layers.0.thicknes=1:2", "`layers[0].thicknes`"),
            ("layers.7.thickness=1:2", "layers"),
            ("layers.0.poisson=0.2:0.6", "it reaches 0.6"),
            ("friction.coefficient=normal:0.2:0.1", "it reaches -0.3"),
            ("friction.coefficient=normal:0.2", "a mean and a deviation"),
            ("friction.coefficient=10%", "no single number that the case states"),
            ("layers.0.thickness=library", "no range of `thickness` for TiAlN"),
            ("levels.0.radius=library", "names no `material`"),
            ("grid.points=64:128", "grid.points"),
            ("counterbody.material=1:2", "counterbody.material"),
        ] {
            let told = design(&[text], 8).unwrap_err().to_string();
            assert!(told.contains(words) && told.contains(&format!("--vary {text}")), "{text}: {told}");
        }
        for samples in [0, 4, 100, 1 << 17] {
            assert!(matches!(design(&["layers.0.thickness=10%"], samples), Err(VaryError::Samples(_))), "{samples}");
        }
        let told = design(&["layers.0.thickness=10%", "layers[0].thickness=1:2"], 8).unwrap_err().to_string();
        assert!(told.contains("is given twice"), "{told}");
    }

    #[test]
    fn a_sample_is_two_rows_and_one_with_each_key_of_the_second_in_the_first() {
        let vary = ["layers.0.thickness=10%", "substrate.young=190:210", "levels.0.radius=5%"];
        let design_of = |samples: usize| design(&vary, samples).unwrap();
        let few = design_of(16).combinations();
        assert_eq!(few.all.len(), 16 * 5);
        for block in few.all.chunks(5) {
            let [a, b] = [&block[0].values, &block[1].values];
            assert!(a.iter().zip(b).all(|(a, b)| a != b));
            for (key, mixed) in block[2..].iter().enumerate() {
                let mut expected = a.clone();
                expected[key].clone_from(&b[key]);
                assert_eq!(mixed.values, expected);
            }
        }
        // More samples go on from the fewer ones, and another seed has others.
        assert_eq!(design_of(32).combinations().all[..80], few.all[..]);
        let other = Design { seed: 1, ..design_of(16) }.combinations();
        assert!(other.all.iter().zip(&few.all).all(|(other, few)| other.values != few.values));
    }

    /// A net: of 16 points each of 16 equal parts of a coordinate has one.
    #[test]
    fn samples_are_even_in_every_key() {
        let design = design(&["layers.0.thickness=2:4", "levels.0.radius=2000:4000"], 16).unwrap();
        for (key, scale) in [1.0, 1000.0].into_iter().enumerate() {
            for place in [0, 1] {
                let rows = design.combinations().all.into_iter().skip(place).step_by(4);
                let value = |row: Combination| row.values[key].parse::<f64>().unwrap();
                let mut parts: Vec<usize> = rows.map(|row| (8.0 * (value(row) / scale - 2.0)) as usize).collect();
                parts.sort_unstable();
                assert_eq!(parts, (0..16).collect::<Vec<_>>());
            }
        }
    }

    /// 1.959964 and 3.090232 are the tabulated 97.5 % and 99.9 % quantiles.
    #[test]
    fn normal_quantiles_are_those_of_tables() {
        for (part, exact) in [(0.5, 0.0), (0.975, 1.959_964), (0.001, -3.090_232)] {
            assert!((normal_quantile(part) - exact).abs() < 1e-6, "{part}");
        }
    }
}
