//! The keys that layers, the substrate and the counterbody have in common, those of any material.

use super::keys::{Form, Key, Range, Unit};

/// Most letters of a material's name.
const LETTERS: usize = 40;
const SIZE: Form = Form::Number(Range::Size);

pub(in crate::case) const MATERIAL: Key = Key::new(&[Form::Name("a name", LETTERS)], "\"TiN\"")
    .otherwise("none")
    .rule("needs units.pressure; where both moduli are given it is a name alone")
    .fills(&["name", "young", "poisson", "yield_strength", "tensile_strength", "hardness"]);
pub(in crate::case) const NAME: Key =
    Key::new(&[Form::Name("a name", LETTERS)], "\"TiN\"").otherwise("its `material`, or its number");
pub(in crate::case) const YIELD: Key =
    Key::new(&[SIZE], "8.0").unit(Unit::Pressure).otherwise("its material's, or never reached");
pub(in crate::case) const TENSILE: Key =
    Key::new(&[SIZE], "2.0").unit(Unit::Pressure).otherwise("its material's, or never reached");

/// Declares a section of a material, as `section!` does: `material` and `name` come first, strengths and laws between the `first` and the
/// `last` keys of its own.
macro_rules! material_section {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident = $keys:ident $(, rules $rules:path)? $(, misplaced [$($misplaced:tt)*])?
        { $($first:tt)* } { $($last:tt)* }
    ) => {
        $crate::case::section::section! {
            $(#[$attribute])*
            pub struct $name = $keys $(, rules $rules)? $(, misplaced [$($misplaced)*])? {
                /// material of `percoat materials` or of the file `materials`, for moduli, strengths, hardness and name that are not given
                pub material: Option<String> = $crate::case::material_keys::MATERIAL,
                /// name of the material, used in place of its number in tables and pictures
                pub name: Option<String> = $crate::case::material_keys::NAME,
                $($first)*
                /// relaxation of the shear modulus to that of `young` and `poisson`
                pub relaxation: Option<$crate::case::relaxation::RelaxationSection> = $crate::case::relaxation::RELAXES,
                /// thermal conductivity, a power per length and temperature
                pub conductivity: Option<f64> = $crate::case::heat::CONDUCTIVITY,
                /// thermal diffusivity, an area per time
                pub diffusivity: Option<f64> = $crate::case::heat::DIFFUSIVITY,
                /// coefficient of linear thermal expansion, one over a temperature
                pub expansion: Option<f64> = $crate::case::heat::EXPANSION,
                /// yield strength, compared with the von Mises stress
                pub yield_strength: Option<f64> = $crate::case::material_keys::YIELD,
                /// tensile strength, compared with the largest principal stress
                pub tensile_strength: Option<f64> = $crate::case::material_keys::TENSILE,
                /// hardness: the pressure never exceeds that of the softer surface
                pub hardness: Option<f64> = $crate::case::durability::HARDNESS,
                /// Archard's coefficient of wear k: the pressure p wears off the depth k p ds along the path ds of sliding
                pub wear: Option<f64> = $crate::case::durability::WEAR,
                /// fatigue by the range of the principal shear stress τ₁ in a pass
                pub fatigue: Option<$crate::case::durability::FatigueSection> = $crate::case::durability::FATIGUE_LAW,
                /// endurance limits, below which any number of passes is borne, for the criteria of Crossland and Dang Van
                pub endurance: Option<$crate::case::durability::EnduranceSection> =
                    $crate::case::durability::ENDURANCE_LIMITS,
                /// passes to failure by the largest strain, as layers of pavements are designed
                pub strain_life: Option<$crate::case::durability::StrainLifeSection> =
                    $crate::case::durability::STRAIN_LAW,
                $($last)*
            }
        }
    };
}
pub(in crate::case) use material_section;
