//! Colours: a palette for lines that colour-blind readers can tell apart, and perceptually uniform maps for fields.
//!
//! - Lines: black and the six strong colours of M. Okabe & K. Ito, *Color Universal Design* (2008).
//! - Values from zero up: viridis (S. van der Walt & N. Smith, CC0), light at the top.
//! - Values of both signs: blue – white – red, made in Oklab (B. Ottosson, 2020) with a lightness that falls linearly
//!   with |value| on both sides of a white zero.

/// Red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// Black.
    pub const BLACK: Self = Self([0, 0, 0]);
    /// White.
    pub const WHITE: Self = Self([255, 255, 255]);
    /// The grey of captions.
    pub const GREY: Self = Self([70, 70, 70]);

    /// The colour of places without a value in a map.
    pub const PALE: Self = Self([205, 205, 205]);

    /// Colour of a line by its index, see [`Curve::colour`](super::Curve).
    pub fn line(index: usize) -> Self {
        const LINES: [[u8; 3]; 6] =
            [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233]];
        match index {
            0 => Self::BLACK,
            _ => Self(LINES[(index - 1) % LINES.len()]),
        }
    }

    /// Colour of a line at a depth from 0 to 1: the sequential map without its last part, too light on white.
    pub fn deep(part: f64) -> Self {
        ColourMap::Sequential.colour(0.87 * part.clamp(0.0, 1.0))
    }

    /// The colour mixed with a part of white, from 0 (unchanged) to 1 (white).
    pub fn lighter(self, part: f64) -> Self {
        Self(self.0.map(|c| (f64::from(c) + part * (255.0 - f64::from(c))).round() as u8))
    }

    /// Perceived lightness L of Oklab, 0 to 1.
    pub fn lightness(self) -> f64 {
        let [r, g, b] = self.0.map(|c| {
            let c = f64::from(c) / 255.0;
            if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        });
        let l = 0.412_221_470_8 * r + 0.536_332_536_3 * g + 0.051_445_992_9 * b;
        let m = 0.211_903_498_2 * r + 0.680_699_545_1 * g + 0.107_396_956_6 * b;
        let s = 0.088_302_461_9 * r + 0.281_718_837_6 * g + 0.629_978_700_5 * b;
        0.210_454_255_3 * l.cbrt() + 0.793_617_785 * m.cbrt() - 0.004_072_046_8 * s.cbrt()
    }

    /// Colour from Oklab coordinates, clipped to sRGB.
    fn oklab(lightness: f64, a: f64, b: f64) -> Self {
        let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
        let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
        let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548 * b).powi(3);
        let linear = [
            4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
            -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
            -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701 * s,
        ];
        Self(linear.map(|c: f64| {
            let c = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
            (255.0 * c).round().clamp(0.0, 255.0) as u8
        }))
    }
}

/// A map from values to colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// Colours for values from zero up.
    Sequential,
    /// Colours for values of both signs: white is zero.
    Diverging,
}

/// Viridis at equal steps, 0xRRGGBB.
const VIRIDIS: [u32; 33] = [
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453781, 0x424086, 0x3e4989, 0x3b528b, 0x375b8d, 0x33638d,
    0x2f6b8e, 0x2c728e, 0x297a8e, 0x26828e, 0x23898e, 0x21918c, 0x1f988b, 0x1fa088, 0x22a785, 0x28ae80, 0x32b67a,
    0x3fbc73, 0x4ec36b, 0x5ec962, 0x70cf57, 0x84d44b, 0x98d83e, 0xaddc30, 0xc2df23, 0xd8e219, 0xece51b, 0xfde725,
];

impl ColourMap {
    /// The colours at 256 equal steps: of 0…1 for the sequential map, of −1…1 for the diverging one.
    pub fn table(self) -> Vec<Colour> {
        (0..256).map(|k| self.colour(f64::from(k) / 255.0)).collect()
    }

    fn colour(self, t: f64) -> Colour {
        match self {
            Self::Sequential => {
                let place = t * (VIRIDIS.len() - 1) as f64;
                let before = (place as usize).min(VIRIDIS.len() - 2);
                let rest = place - before as f64;
                let part = |index: usize, k: usize| f64::from(VIRIDIS[index].to_be_bytes()[k + 1]);
                let mix = |k: usize| (1.0 - rest) * part(before, k) + rest * part(before + 1, k);
                Colour([0, 1, 2].map(|k| mix(k).round() as u8))
            }
            Self::Diverging => {
                let x = 2.0 * t - 1.0;
                let hue: f64 = if x < 0.0 { 4.45 } else { 0.52 };
                // Colourfulness rises, then falls again as far as dark colours can be shown.
                let chroma = 0.17 * (std::f64::consts::FRAC_PI_2 * (1.35 * x.abs()).min(1.0)).sin()
                    - 0.05 * (x.abs() - 0.74).max(0.0) / 0.26;
                Colour::oklab(1.0 - 0.66 * x.abs(), chroma * hue.cos(), chroma * hue.sin())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequential_map_grows_lighter_all_the_way() {
        let lightness: Vec<f64> = ColourMap::Sequential.table().into_iter().map(Colour::lightness).collect();
        assert!(lightness.windows(2).all(|pair| pair[1] > pair[0] - 2e-3));
        assert!(lightness[255] - lightness[0] > 0.5);
    }

    #[test]
    fn the_diverging_map_is_white_at_zero_and_darkens_alike_on_both_sides() {
        let lightness: Vec<f64> = ColourMap::Diverging.table().into_iter().map(Colour::lightness).collect();
        assert!(lightness[127] > 0.99 && lightness[128] > 0.99);
        assert!(lightness[..128].windows(2).all(|pair| pair[1] > pair[0] - 3e-3));
        for k in 0..128 {
            assert!((lightness[k] - lightness[255 - k]).abs() < 0.02, "{k}: {} {}", lightness[k], lightness[255 - k]);
        }
    }
}
