//! The header of a text of heights: comments as written by Gwyddion, SPIP and other programs.
//!
//! ```text
//! # Width: 10.00 µm         # x-pixels = 512          # h=650 w=650
//! # Height: 10.00 µm        # x-length = 5000         # pixel size=3.7e-7 m
//! # Value units: m          # x-unit = nm
//! ```
//!
//! Such a text is an image: a line runs along x, the first one on top. Comments with other keys are ignored. SPIP's are those of
//! [`spip`](super::spip). A quantity that is given twice, and not the same, is refused.

use super::fault::Fault;
use super::unit;

/// A length as written, and its unit where it has one.
#[derive(Debug, Clone, PartialEq)]
pub struct Length {
    /// The number.
    pub value: f64,
    /// Name of the unit, if it has one.
    pub unit: Option<String>,
}

impl Length {
    /// The length in the unit `length` of a case; times `factor` where it has no unit. `None` where one unit is not known.
    pub fn in_unit(&self, length: Option<&str>, factor: f64) -> Option<f64> {
        match &self.unit {
            None => Some(self.value * factor),
            Some(unit) => Some(self.value * unit::factor(unit, length?).ok()?),
        }
    }

    /// The length in metres; `None` without a known unit.
    pub fn metres(&self) -> Option<f64> {
        Some(self.value * unit::factor(self.unit.as_deref()?, "m").ok()?)
    }
}

/// Unit of the heights in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum HeightsUnit {
    /// A known unit of length.
    Known(String),
    /// Another unit than one of length, or a factor that was not applied.
    Other,
}

impl HeightsUnit {
    /// The unit of a name.
    pub fn of(name: &str) -> Self {
        if unit::is_known(name) { Self::Known(name.to_owned()) } else { Self::Other }
    }
}

/// Values of the known keys.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Header {
    /// Sides of an image along its lines and across them.
    sides: [Option<Length>; 2],
    pixel: Option<Length>,
    /// Number of values in a line, and of lines.
    counts: [Option<usize>; 2],
    /// Unit of sides that are written without one.
    lateral: Option<String>,
    heights: Option<HeightsUnit>,
    has_channel: bool,
    /// Whether it is one of SPIP, whose sides are in nanometres.
    is_spip: bool,
    /// Factor of the numbers to nanometres.
    bit2nm: Option<f64>,
    /// Number of places without a measurement that a mask behind the heights marks.
    voids: Option<usize>,
}

/// Quantity of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum About {
    /// Side along a line (0) or across the lines (1).
    Side(usize),
    Pixel,
    /// Number of values in a line (0) or of lines (1).
    Count(usize),
    Lateral,
    Heights,
    Factor,
    Channel,
    Format,
    Bit2nm,
    Voids,
}

/// Keys in small letters, with blanks for `-` and `_`.
const KEYS: [(&[&str], About); 12] = [
    (&["width", "breite", "largeur", "larghezza", "ancho", "x length", "scan width"], About::Side(0)),
    (&["height", "höhe", "h\u{fffd}he", "hauteur", "altezza", "alto", "y length", "scan height"], About::Side(1)),
    (&["pixel size", "pixelsize", "pixel"], About::Pixel),
    (&["w", "x pixels", "columns", "ncols"], About::Count(0)),
    (&["h", "y pixels", "lines", "rows", "nrows"], About::Count(1)),
    (&["lateral units", "lateral unit", "xy units", "xy unit", "x unit", "y unit"], About::Lateral),
    (&["value units", "value unit", "z units", "z unit", "data unit", "data units", "height unit"], About::Heights),
    (&["file format"], About::Format),
    (&["bit2nm"], About::Bit2nm),
    (&["voidpixels"], About::Voids),
    (&["bit2unit", "z scale", "zscale", "z factor"], About::Factor),
    (&["channel", "kanal"], About::Channel),
];

impl About {
    fn of(key: &str) -> Option<Self> {
        let small = key.to_lowercase().replace(['-', '_'], " ");
        let key = small.split_whitespace().collect::<Vec<_>>().join(" ");
        let known = KEYS.iter().find(|(names, _)| names.contains(&&key[..])).map(|(_, about)| *about);
        known.or_else(|| key.starts_with("height conversion factor").then_some(Self::Factor))
    }
}

impl Header {
    /// Reads the comment at line `number`, without its mark; `begun`: whether numbers precede it.
    pub fn note(&mut self, number: usize, comment: &str, begun: bool) -> Result<(), Fault> {
        for (about, value) in pairs(comment) {
            if begun || (about == About::Channel && self.has_channel) {
                let what = format!("line {number} begins a second header: several images in one file?");
                return Err(Fault::new(what, format!("line {number}")).help("give each image a file of its own"));
            }
            self.take(number, about, value)?;
        }
        Ok(())
    }

    fn take(&mut self, number: usize, about: About, value: &str) -> Result<(), Fault> {
        let (amount, unit) = measured(value);
        let counted = || amount.filter(|n| n.fract() == 0.0 && (1.0..=1e6).contains(n)).map(|n| n as usize);
        let known = |name: &str| unit::is_known(name).then(|| name.to_owned());
        let unreadable = |what: &str| {
            Fault::new(format!("line {number} gives {what}"), format!("line {number}: not read"))
                .help("write a number and a unit of length, such as 10 µm, or remove the line")
        };
        match about {
            About::Channel => self.has_channel = true,
            About::Format => self.is_spip |= value.trim().eq_ignore_ascii_case("ASCII"),
            About::Voids => {
                self.voids = amount.filter(|n| n.fract() == 0.0 && (1.0..=1e12).contains(n)).map(|n| n as usize);
            }
            About::Bit2nm => {
                let Some(factor) = amount.filter(|x| x.is_finite() && *x > 0.0) else {
                    return Err(Fault::new(
                        format!("line {number} gives a Bit2nm that is no number greater than 0"),
                        "no factor",
                    ));
                };
                set(&mut self.bit2nm, factor, number)?;
            }
            About::Count(axis) => set_if(&mut self.counts[axis], counted(), number)?,
            About::Side(axis) if ["px", "pixel", "pixels"].contains(&unit) => {
                set_if(&mut self.counts[axis], counted(), number)?;
            }
            // "Height: nm" is the unit of the heights; other words are ignored.
            About::Side(1) if amount.is_none() => {
                self.heights = known(value.trim()).map(HeightsUnit::Known).or(self.heights.take());
            }
            About::Side(1) if self.sides[0].is_none() => {}
            About::Side(_) | About::Pixel => {
                let Some(value) = amount.filter(|x| x.is_finite() && *x > 0.0) else {
                    return Err(unreadable("a side of the image that is no length greater than 0"));
                };
                let length_unit = known(unit);
                if length_unit.is_none() && !unit.is_empty() {
                    return Err(unreadable("a side of the image in a unit of length that is not known"));
                }
                let length = Length { value, unit: length_unit };
                match about {
                    About::Side(axis) => set(&mut self.sides[axis], length, number)?,
                    _ => set(&mut self.pixel, length, number)?,
                }
            }
            About::Lateral => match known(in_brackets(value)) {
                Some(name) => set(&mut self.lateral, name, number)?,
                None => return Err(unreadable("sides in a unit of length that is not known")),
            },
            // A factor precedes the unit that applies after it.
            About::Heights if self.heights == Some(HeightsUnit::Other) => {}
            About::Heights => {
                let heights_unit = known(in_brackets(value)).map_or(HeightsUnit::Other, HeightsUnit::Known);
                set(&mut self.heights, heights_unit, number)?;
            }
            About::Factor => self.heights = Some(HeightsUnit::Other),
        }
        Ok(())
    }

    /// Whether the text is an image.
    pub fn is_image(&self) -> bool {
        self.sides.iter().any(Option::is_some) || self.pixel.is_some() || self.counts.iter().any(Option::is_some)
    }

    /// Unit of the heights, that of the numbers times [`factor`](Self::factor); `None` where the header has none.
    pub fn heights(&self) -> Option<HeightsUnit> {
        match (&self.heights, self.bit2nm) {
            (Some(_), Some(factor)) if factor != 1.0 => Some(HeightsUnit::Other),
            (None, Some(_)) => Some(HeightsUnit::Known("nm".to_owned())),
            (unit, _) => unit.clone(),
        }
    }

    /// Factor from the numbers of the file to its unit.
    pub fn factor(&self) -> f64 {
        self.bit2nm.filter(|_| self.heights.is_none()).unwrap_or(1.0)
    }

    /// Whether it is one of SPIP.
    pub fn is_spip(&self) -> bool {
        self.is_spip || self.bit2nm.is_some()
    }

    /// Lines of heights, and places without a measurement that a mask behind them marks; `None` without such places.
    pub fn voids(&self) -> Option<[usize; 2]> {
        Some([self.counts[1]?, self.voids?])
    }

    /// Unit of the coordinates of points: that of the sides, or of the heights.
    pub fn of_coordinates(&self) -> Option<String> {
        let heights = match &self.heights {
            Some(HeightsUnit::Known(name)) => Some(name.clone()),
            _ => None,
        };
        self.lateral.clone().or(heights)
    }

    /// Sides of an image of `lines` lines of `numbers` values; `None` where the header has none. Refused where the header has other
    /// counts, or only one side.
    pub fn sides(&self, [numbers, lines]: [usize; 2]) -> Result<Option<[Length; 2]>, Fault> {
        let says = [self.counts[0].unwrap_or(numbers), self.counts[1].unwrap_or(lines)];
        if says != [numbers, lines] {
            let what = format!(
                "holds {lines} lines of {numbers} numbers, and its header says {} lines of {}",
                says[1], says[0]
            );
            return Err(Fault::new(what, "header and numbers differ").help("correct or remove the header"));
        }
        let lateral = || self.lateral.clone().or_else(|| self.is_spip().then(|| "nm".to_owned()));
        let with_unit = |length: &Length| Length { unit: length.unit.clone().or_else(lateral), ..*length };
        match (&self.sides, &self.pixel) {
            ([Some(width), Some(height)], _) => Ok(Some([with_unit(width), with_unit(height)])),
            ([Some(_), None], _) => Err(Fault::new("has a header with a width and no height", "which height?")
                .help("add a line # Height: …, or remove that of the width and give surface.period")),
            (_, Some(pixel)) => {
                let side = |count: usize| Length { value: pixel.value * count as f64, ..with_unit(pixel) };
                Ok(Some([side(numbers), side(lines)]))
            }
            _ => Ok(None),
        }
    }
}

/// Sets a quantity of line `number`; refused where another line gives another one.
fn set<T: PartialEq>(quantity: &mut Option<T>, value: T, number: usize) -> Result<(), Fault> {
    if quantity.as_ref().is_some_and(|other| *other != value) {
        let what = format!("line {number} gives a quantity that another line of the header gives otherwise");
        return Err(Fault::new(what, format!("line {number}: which one?")).help("remove the line that is wrong"));
    }
    *quantity = Some(value);
    Ok(())
}

/// [`set`] with a value, if any.
fn set_if<T: PartialEq>(quantity: &mut Option<T>, value: Option<T>, number: usize) -> Result<(), Fault> {
    value.map_or(Ok(()), |value| set(quantity, value, number))
}

/// A text without blanks and brackets around it.
fn in_brackets(text: &str) -> &str {
    text.trim().trim_matches(['[', ']', '(', ')'])
}

/// Known keys of a comment with their values: `key: value`, `key = value`, or several `k=v` of one letter.
fn pairs(comment: &str) -> Vec<(About, &str)> {
    let short = comment.split_whitespace().filter_map(|word| word.split_once('='));
    let short: Vec<(About, &str)> = short
        .filter_map(|(key, value)| Some((About::of(key)?, value)))
        .filter(|(about, _)| matches!(about, About::Count(_)))
        .collect();
    if !short.is_empty() {
        return short;
    }
    let whole = comment.split_once(['=', ':']).and_then(|(key, value)| Some((About::of(key)?, value)));
    whole.into_iter().collect()
}

/// A number at the beginning of a value and the text behind it, the micro sign normalised.
fn measured(value: &str) -> (Option<f64>, &str) {
    let value = value.trim();
    let end = value.find(|c: char| !(c.is_ascii_digit() || "+-.,eE".contains(c))).unwrap_or(value.len());
    (value[..end].replace(',', ".").parse().ok(), in_brackets(&value[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(comments: &[&str]) -> Result<Header, Fault> {
        let mut header = Header::default();
        for (number, comment) in (1..).zip(comments) {
            header.note(number, comment, false)?;
        }
        Ok(header)
    }

    fn length(value: f64, unit: &str) -> Length {
        Length { value, unit: Some(unit.to_owned()) }
    }

    #[test]
    fn headers_of_the_usual_programs_are_read() {
        let metres = Some(HeightsUnit::Known("m".to_owned()));
        for (comments, sides, heights) in [
            (
                &[" Channel: ZSensor", " Width: 10.00 µm", " Height: 5.00 µm", " Value units: m"][..],
                Some([length(10.0, "µm"), length(5.0, "µm")]),
                metres.clone(),
            ),
            (
                &["Kanal: Z", "Breite: 12,5 \u{fffd}m", "H\u{fffd}he: 567 nm", "Value units: m"],
                Some([length(12.5, "\u{fffd}m"), length(567.0, "nm")]),
                metres.clone(),
            ),
            (
                &[
                    "Created by SPIP 4.4",
                    "x-pixels = 4",
                    "y-pixels = 3",
                    "x-length = 50",
                    "y-length = 40",
                    "x-unit = nm",
                ],
                Some([length(50.0, "nm"), length(40.0, "nm")]),
                None,
            ),
            (
                &["h=3 w=4", "pixel size=2e-7 m", "height conversion factor (-> m)=6e-8", "data unit=m"],
                Some([length(8e-7, "m"), length(6e-7, "m")]),
                Some(HeightsUnit::Other),
            ),
            (&["Width: 4 px", "Height: 3 px", "Height: nm"], None, Some(HeightsUnit::Known("nm".to_owned()))),
            (
                &["Channel: Current", "Width: 1 m", "Height: 1 m", "Value units: V"],
                Some([length(1.0, "m"), length(1.0, "m")]),
                Some(HeightsUnit::Other),
            ),
            (&["heights of a disc: good", "tip radius = 2 nm", "Height: 3 nm", "wavelength: 632.8 nm"], None, None),
        ] {
            let header = of(comments).unwrap();
            let found = header.sides([4, 3]).unwrap();
            for (found, expected) in found.iter().flatten().zip(sides.iter().flatten()) {
                assert!(
                    (found.value / expected.value - 1.0).abs() < 1e-12 && found.unit == expected.unit,
                    "{comments:?}"
                );
            }
            assert_eq!((found.is_some(), header.heights()), (sides.is_some(), heights), "{comments:?}");
        }
    }

    #[test]
    fn headers_that_cannot_be_meant_are_refused_by_their_line() {
        for (comments, words) in [
            (&["Width: 10 furlong", "Height: 5 µm"][..], "line 1 gives a side of the image in a unit"),
            (&["", "Width: wide"], "line 2 gives a side of the image that is no length"),
            (&["Width: -1 µm"], "no length greater than 0"),
            (&["Channel: a", "Channel: b"], "line 2 begins a second header"),
            (&["Lateral units: s"], "line 1 gives sides in a unit"),
        ] {
            let fault = of(comments).unwrap_err();
            assert!(fault.what.contains(words), "{comments:?}: {}", fault.what);
        }
        let late = Header::default().note(9, "Width: 1 m", true).unwrap_err();
        assert!(late.what.contains("line 9 begins a second header"));
        for comments in [&["h=4 w=3"][..], &["x-pixels = 5"], &["Width: 10 µm"]] {
            assert!(of(comments).unwrap().sides([4, 3]).is_err(), "{comments:?}");
        }
    }
}
