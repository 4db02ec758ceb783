//! `[[levels]]`: indenters of equal shape and height.

use super::area_function::{AREA, AreaSection};
use super::error::Refusal;
use super::keys::{Form, Key, Range, Unit};
use super::reader::TableAt;
use super::section::{ReadTable, Words, demanded, section, words};
use super::source::Source;
use percoat_common::measure::Measure;
use percoat_core::counterbody::{Level, Shape, flank_slope};
use std::sync::Arc;

const SIZE: Form = Form::Number(Range::Size);
const COORDINATE: Form = Form::Number(Range::Coordinate);
/// Tip radius of a Rockwell diamond, mm, and its half angle, degrees: a cone of 120° (ISO 6508-2).
const ROCKWELL: (f64, f64) = (0.2, 60.0);
const PYRAMIDS: &[&str] = &["rockwell", "berkovich", "vickers", "cube-corner"];

words! {
    /// Kinds of shapes.
    pub enum ShapeKind {
        /// r²/2R.
        Paraboloid = "paraboloid",
        /// A sphere's lower half.
        Sphere = "sphere",
        /// A cone.
        Cone = "cone",
        /// c rⁿ.
        Power = "power",
        /// A cone with a spherical tip.
        SpheroCone = "sphero-cone",
        /// The diamond of Rockwell C and of scratch tests.
        Rockwell = "rockwell",
        /// A pyramid of three faces, 65.27° from the axis.
        Berkovich = "berkovich",
        /// A pyramid of four faces, 68° from the axis.
        Vickers = "vickers",
        /// A pyramid of three faces at right angles.
        CubeCorner = "cube-corner",
        /// A tip of a measured area function.
        Measured = "measured",
    }
}

section! {
    /// One section of `[[levels]]`.
    pub struct LevelSection = LEVELS, misplaced [
        ("radius", "`radius` is a size of a paraboloid, a sphere or a sphero-cone; others have a `tip_radius`, or none"),
        ("slope", "`slope` is the size of a cone"),
        ("coefficient", "`coefficient` is a size of a power profile c rⁿ"),
        ("exponent", "`exponent` is a size of a power profile c rⁿ"),
        ("half_angle", "`half_angle` is a size of a sphero-cone"),
        ("tip_radius", "`tip_radius` is that of a Rockwell diamond or of a pyramid; others have a `radius`, or none"),
        ("area", "`area` is that of a measured tip"),
    ] {
        /// the shape of the indenters; a power law is c rⁿ, pyramids are the cones of equal area
        pub shape: ShapeKind = Key::new(&[Form::Word(ShapeKind::WORDS)], "\"paraboloid\""),
        /// the radius at the apex
        pub radius: Option<f64> =
            Key::new(&[SIZE], "0.8").unit(Unit::Length).of(&["paraboloid", "sphere", "sphero-cone"]),
        /// the slope of the flank
        pub slope: Option<f64> = Key::new(&[SIZE], "0.1").of(&["cone"]),
        /// c of the profile c rⁿ
        pub coefficient: Option<f64> = Key::new(&[SIZE], "1.5").unit(Unit::LengthToOneMinusN).of(&["power"]),
        /// n of the profile c rⁿ
        pub exponent: Option<f64> = Key::new(&[SIZE], "3.0").of(&["power"]),
        /// angle between the flank and the axis; the sphere goes over into the flank without a kink
        pub half_angle: Option<f64> =
            Key::new(&[Form::Number(Range::between(1.0, 89.0))], "70.0").unit(Unit::Degree).of(&["sphero-cone"]),
        /// the radius of the rounded apex of a diamond
        pub tip_radius: Option<f64> = Key::new(&[SIZE], "0.1")
            .unit(Unit::Length)
            .of(PYRAMIDS)
            .otherwise("0.2 mm of a Rockwell diamond, where `units.length` is known; sharp pyramids"),
        /// measured area of the cross-section over the depth from the apex: the path of a table, or coefficients
        pub area: Option<AreaSection> =
            Key::new(&[Form::Text("the path of a file"), Form::Table(&AREA)], "\"tip.csv\"")
                .of(&["measured"])
                .rule("columns `depth` and `area`, as `depth_nm,area_nm2`"),
        /// protrusion of the apices, of which only differences matter
        pub height: f64 = Key::new(&[COORDINATE], "0.02").unit(Unit::Length).default("0"),
        /// places of its indenters, in fractions of a₁ and a₂; in the window of an isolated contact from its middle
        pub sites: Option<Vec<[f64; 2]>> = Key::new(
            &[Form::List { of: &Form::Tuple("a site [s1, s2]", &[COORDINATE; 2]), count: [1, 10_000] }],
            "[[0.0, 0.0], [0.5, 0.5]]",
        )
        .otherwise("the lattice's standard ones")
        .rule("all levels have them, or none"),
    }
}

impl ShapeKind {
    /// Slope of the cone that has the area A = c h² of a pyramid at each depth h: √(π/c). `None` of another shape.
    ///
    /// A pyramid of n faces at the angle θ to its axis has A = n tan(π/n) tan²θ h². The modified Berkovich pyramid has θ = 65.27°, the Vickers
    /// pyramid 136° between its faces, and both nearly one area, 24.5 h² (ISO 14577-2).
    fn pyramid_slope(self) -> Option<f64> {
        let (faces, angle) = match self {
            Self::Berkovich => (3.0, 65.27),
            Self::Vickers => (4.0, 68.0),
            Self::CubeCorner => (3.0, 0.5f64.sqrt().atan().to_degrees()),
            _ => return None,
        };
        let tangent = f64::to_radians(angle).tan();
        Some((std::f64::consts::PI / (faces * (std::f64::consts::PI / faces).tan())).sqrt() / tangent)
    }

    /// The word of a case.
    pub fn word(self) -> &'static str {
        Self::WORDS[self as usize]
    }
}

impl LevelSection {
    /// The section of a table, with the tip radius of a Rockwell diamond where it has none, and the absolute path of its file; and its level.
    /// `length` is the unit of the case's lengths, if any.
    pub(super) fn read_in(
        table: &TableAt<'_>,
        source: &Source,
        length: Option<&str>,
    ) -> Result<(Self, Level), Refusal> {
        let section = Self::read_table(table)?;
        let is_rockwell = section.shape == ShapeKind::Rockwell;
        let tip_radius = match section.tip_radius {
            None if is_rockwell => Some(rockwell_radius(table, length)?),
            given => given,
        };
        let section = Self { tip_radius, ..section };
        let level = section.shape(table, source, length).and_then(|shape| {
            let refuse = |error| Refusal::new(table.span, format!("`{}`: {error}", table.path("shape")), "this level");
            Level::new(shape, section.height).map_err(refuse)
        })?;
        Ok((Self { area: section.area.map(|area| area.located(source)), ..section }, level))
    }

    /// Key and value of the radius at the apex, a length; `None` of a sharp tip, a power law and a measured tip.
    pub fn apex_radius(&self) -> Option<(&'static str, f64)> {
        let radius = self.radius.map(|radius| ("radius", radius));
        radius.or_else(|| self.tip_radius.map(|radius| ("tip_radius", radius)))
    }

    /// Whether the shape is the round one of the area of a pyramid or of a measured tip.
    pub(super) fn is_of_equal_area(&self) -> bool {
        self.shape == ShapeKind::Measured || self.shape.pyramid_slope().is_some()
    }

    fn shape(&self, table: &TableAt<'_>, source: &Source, length: Option<&str>) -> Result<Shape, Refusal> {
        Ok(match self.shape {
            ShapeKind::Paraboloid => Shape::Paraboloid { radius: demanded(self.radius) },
            ShapeKind::Sphere => Shape::Sphere { radius: demanded(self.radius) },
            ShapeKind::Cone => Shape::Cone { slope: demanded(self.slope) },
            ShapeKind::Power => {
                Shape::Power { coefficient: demanded(self.coefficient), exponent: demanded(self.exponent) }
            }
            ShapeKind::SpheroCone => {
                Shape::SpheroCone { radius: demanded(self.radius), slope: flank_slope(demanded(self.half_angle)) }
            }
            ShapeKind::Rockwell => {
                Shape::SpheroCone { radius: demanded(self.tip_radius), slope: flank_slope(ROCKWELL.1) }
            }
            ShapeKind::Berkovich | ShapeKind::Vickers | ShapeKind::CubeCorner => {
                let slope = demanded(self.shape.pyramid_slope());
                self.tip_radius.map_or(Shape::Cone { slope }, |radius| Shape::SpheroCone { radius, slope })
            }
            ShapeKind::Measured => {
                let (area, written) = (self.area.as_ref(), table.value("area")?);
                Shape::Measured(Arc::new(demanded(area).tip(&written, source, length)?))
            }
        })
    }
}

/// The tip radius of a Rockwell diamond in the unit of the case.
fn rockwell_radius(table: &TableAt<'_>, length: Option<&str>) -> Result<f64, Refusal> {
    let known = length.and_then(|length| Measure::like(length, Measure::METRE));
    let radius = known.and_then(|length| Measure::of("mm")?.convert(ROCKWELL.0, length));
    radius.ok_or_else(|| {
        let message = format!("`{}` is missing", table.path("tip_radius"));
        Refusal::new(table.span, message, "how large is 0.2 mm?").help(
            "add tip_radius, or [units] with length = \"µm\" or another, in which the 0.2 mm of the diamond are taken",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angles of the cones of equal area and factors of the areas: 70.3° and 24.5 as they are rounded for both flat pyramids, 42.28° and
    /// 3√3/2 of the corner of a cube.
    #[test]
    fn pyramids_have_their_equivalent_cones() {
        for (kind, angle, area) in [
            (ShapeKind::Berkovich, 70.30, 24.49),
            (ShapeKind::Vickers, 70.2996, 24.504),
            (ShapeKind::CubeCorner, 42.28, 2.598),
        ] {
            let slope = kind.pyramid_slope().unwrap();
            assert!((slope.recip().atan().to_degrees() - angle).abs() < 5e-3, "{kind:?}: {slope}");
            assert!((std::f64::consts::PI / (slope * slope) - area).abs() < 5e-3, "{kind:?}");
        }
        assert_eq!(ShapeKind::Cone.pyramid_slope(), None);
        assert_eq!((ShapeKind::CubeCorner.word(), ShapeKind::Paraboloid.word()), ("cube-corner", "paraboloid"));
    }
}
