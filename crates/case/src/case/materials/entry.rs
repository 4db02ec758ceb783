//! A material of the library: its numbers with range, source and certainty.

use std::borrow::Cow;

use crate::case::error::Refusal;
use crate::case::keys::{Form, Key, Range};
use crate::case::node::Value;
use crate::case::section::{KeyValue, section, words};
use crate::case::value::ValueAt;

/// Most letters of a material's name and kind.
pub(in crate::case) const LETTERS: usize = 40;

/// Most other names of a material.
const ALIASES: usize = 100;

/// Most materials of a file.
const MATERIALS: usize = 10_000;

const NAME: Form = Form::Name("a name", LETTERS);
const TEXT: Form = Form::Text("a text");
static SIZES: [Form; 2] = [Form::Number(Range::Size), Form::Table(&PROPERTY)];
static RATIOS: [Form; 2] = [Form::Number(Range::between(0.0, 0.5)), Form::Table(&PROPERTY)];
const SIZE: Key = Key::new(&SIZES, "210.0");
const SIZE_OR_NONE: Key = SIZE.otherwise("not known");

words! {
    /// How well a number is known.
    pub enum Certainty {
        /// A number that its source states, or that follows from what the source states.
        Sourced = "sourced",
        /// A usual value that was not found in a source.
        Assumed = "assumed",
    }
}

section! { whole
    /// A number of a material: itself, or a table with what is known about it.
    pub struct Property = PROPERTY {
        /// the number, GPa or without unit
        pub value: f64 = Key::new(&[Form::Number(Range::Coordinate)], "210.0"),
        /// lowest and highest value of the sources, treatments and depositions
        pub range: Option<[f64; 2]> =
            Key::new(&[Form::Tuple("[lowest, highest]", &[Form::Number(Range::Coordinate); 2])], "[205.0, 213.0]")
                .otherwise("not known"),
        /// what was measured, such as the kind of test
        pub what: Option<String> = Key::new(&[TEXT], "\"0.2 % proof\"").otherwise("not said"),
        /// where the number comes from
        pub source: Option<String> = Key::new(&[TEXT], "\"EN 10083-2:2006\"").otherwise("not said"),
        /// how well the number is known
        pub certainty: Option<Certainty> =
            Key::new(&[Form::Word(<Certainty as crate::case::section::Words>::WORDS)], "\"sourced\"").otherwise("not said"),
    }
    beside {}
}

section! {
    /// A material of a library, `[[material]]`; moduli, hardness and strengths in GPa.
    pub struct LibraryMaterial = MATERIAL {
        /// its name, by which a case calls it
        pub name: String = Key::new(&[NAME], "\"TiN\""),
        /// other names by which a case may call it, such as those of other standards
        pub aliases: Vec<String> = Key::new(&[Form::List { of: &NAME, count: [0, ALIASES] }], "[\"AISI 52100\", \"SUJ2\"]")
            .default("[]")
            .omitted_as_nothing(),
        /// its kind, such as steel or hard coating
        pub kind: Option<String> = Key::new(&[Form::Name("a kind", LETTERS)], "\"hard coating\"").otherwise("not said"),
        /// what its numbers depend on
        pub about: Option<String> = Key::new(&[TEXT], "\"Hardness falls with tempering.\"").otherwise("not said"),
        /// Young's modulus
        pub young: Property = SIZE,
        /// Poisson's ratio
        pub poisson: Property = Key::new(&RATIOS, "0.3"),
        /// mean pressure under an indenter, load over projected area
        pub hardness: Option<Property> = SIZE_OR_NONE,
        /// stress at which it yields in tension or compression, compared with the von Mises stress
        pub yield_strength: Option<Property> = SIZE_OR_NONE,
        /// tensile stress at which it breaks without yielding, compared with the largest principal stress
        pub tensile_strength: Option<Property> = SIZE_OR_NONE,
        /// tensile strength of a material that yields before it breaks; no case takes it
        pub ultimate_strength: Option<Property> = SIZE_OR_NONE,
    }
}

section! { whole
    /// A file of materials.
    pub struct MaterialFile = MATERIALS_FILE {
        /// its materials
        pub material: Vec<LibraryMaterial> =
            Key::new(&[Form::Sections(&MATERIAL, MATERIALS)], "[{ name = \"TiN\", young = 430.0, poisson = 0.25 }]"),
    }
    beside {}
}

impl KeyValue for Property {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        if !matches!(value.node.value, Value::Table(_)) {
            let value = value.number()?;
            return Ok(Self { value, range: None, what: None, source: None, certainty: None });
        }
        let table = value.table()?;
        table.only()?;
        // Bounds are those of the material's key.
        let inner = table.value("value")?;
        let number = ValueAt::new(Cow::Borrowed(&*inner.node), value.key, value.all, inner.path.clone()).number()?;
        let range: Option<[f64; 2]> = KeyValue::of(&table, "range")?;
        if range.is_some_and(|[low, high]| !(low..=high).contains(&number)) {
            return Err(table.value("range")?.refuse(format!("[lowest, highest] around the value {number}")));
        }
        Ok(Self {
            value: number,
            range,
            what: KeyValue::of(&table, "what")?,
            source: KeyValue::of(&table, "source")?,
            certainty: KeyValue::of(&table, "certainty")?,
        })
    }
}

impl LibraryMaterial {
    /// Name and other names of the material.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        std::iter::once(&self.name).chain(&self.aliases).map(String::as_str)
    }

    /// Whether a case may call the material by this name.
    pub fn is_called(&self, name: &str) -> bool {
        self.names().any(|known| known == name)
    }

    /// The property that it has for a key of a case, GPa or without unit; `None` of other keys, and where it is not known.
    pub(in crate::case) fn property(&self, key: &str) -> Option<&Property> {
        match key {
            "young" => Some(&self.young),
            "poisson" => Some(&self.poisson),
            "hardness" => self.hardness.as_ref(),
            "yield_strength" => self.yield_strength.as_ref(),
            "tensile_strength" => self.tensile_strength.as_ref(),
            _ => None,
        }
    }

    /// The material as TOML, the form of a file of materials.
    pub fn to_toml(&self) -> String {
        let file = MaterialFile { material: vec![self.clone()] };
        let text = crate::case::plain_toml::toml(&file).expect("numbers and texts under names");
        format!("{}\n", text.trim_end())
    }
}
