//! Declaration of the keys of the case file, each once, as a field of its section.
//!
//! [`section!`] makes of one list of fields the struct, the table of keys ([`Keys`]: forms, ranges, units, defaults, examples,
//! from which refusals, `percoat explain`, the schema and the table of all keys are made), the reader and the writer:
//!
//! ```text
//! section! {
//!     /// The section `[friction]`.
//!     pub struct FrictionSection = FRICTION, rules FrictionSection::rules {
//!         /// coefficient of friction μ: the traction on the body is μp
//!         pub coefficient: f64 = Key::new(&[Form::Number(Range::between(0.0, 100.0))], "0.3"),
//!         …
//!     }
//! }
//! ```
//!
//! The comment of a field is the meaning of the key in messages and `percoat explain`. Its type determines how the value is read
//! ([`KeyValue`]); an `Option` may be absent. `rules` is a function that checks the keys of a table together.
//! `absent` names a function: where it holds for a section, the section is left out of the written case, as another section gives the same.
//! `misplaced [("key", "why")]` names keys that are often written in the wrong table.
//! `section! { for Type = KEYS { … } }` declares the keys of a struct that the core defines; `section! { whole … }` has no reader.

use super::error::Refusal;
use super::keys::{Form, Key, Written};
use super::reader::TableAt;
use super::value::ValueAt;

/// A type that the value of a key is read as.
pub(in crate::case) trait KeyValue: Sized {
    /// The value; a refusal where the key does not admit it.
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal>;

    /// The value of a key of a table, or its default; a refusal where it is missing.
    fn of(table: &TableAt<'_>, key: &str) -> Result<Self, Refusal> {
        Self::read(&table.value(key)?)
    }

    /// Whether it is that of an absent key.
    fn is_absent(&self) -> bool {
        false
    }

    /// Whether it is 0, false or an empty list.
    fn is_nothing(&self) -> bool {
        false
    }

    /// Whether a written case has it.
    fn is_written(&self, key: &Key) -> bool {
        match key.written {
            Written::WhereGiven => !self.is_absent(),
            Written::UnlessNothing => !self.is_absent() && !self.is_nothing(),
            Written::Never => false,
        }
    }
}

impl<T: KeyValue> KeyValue for Option<T> {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        T::read(value).map(Some)
    }

    fn of(table: &TableAt<'_>, key: &str) -> Result<Self, Refusal> {
        table.optional(key).map(|value| T::read(&value)).transpose()
    }

    fn is_absent(&self) -> bool {
        self.is_none()
    }

    fn is_nothing(&self) -> bool {
        self.as_ref().is_some_and(T::is_nothing)
    }
}

impl KeyValue for f64 {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        value.number()
    }

    fn is_nothing(&self) -> bool {
        *self == 0.0
    }
}

impl KeyValue for usize {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        value.integer()
    }
}

impl KeyValue for bool {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        value.boolean()
    }

    fn is_nothing(&self) -> bool {
        !self
    }
}

impl KeyValue for String {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        match value.forms {
            [Form::Name(..)] => value.name(),
            _ => value.text(),
        }
        .map(str::to_owned)
    }
}

impl<const N: usize> KeyValue for [f64; N] {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        value.numbers()
    }
}

impl<T: KeyValue> KeyValue for Vec<T> {
    fn read(value: &ValueAt<'_>) -> Result<Self, Refusal> {
        value.list()?.iter().map(T::read).collect()
    }

    fn is_nothing(&self) -> bool {
        self.is_empty()
    }
}

/// The value of a key that the kind of its table demands, which [`TableAt::only`] has found there.
pub(in crate::case) fn demanded<T>(value: Option<T>) -> T {
    value.expect("the reader refuses a table without a key that its kind demands")
}

/// A section that is read from its table.
pub(in crate::case) trait ReadTable: Sized {
    /// Reads the section with the keys of a table.
    fn read_table(table: &TableAt<'_>) -> Result<Self, Refusal>;
}

macro_rules! section {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident = $keys:ident $(, rules $rules:path)? $(, absent $absent:path)? $(, misplaced [$($misplaced:tt)*])? {
            $($(#[doc = $what:literal])+ pub $field:ident: $type:ty = $key:expr,)*
        }
        $(beside { $($(#[$other_attribute:meta])* pub $other:ident: $other_type:ty,)* })?
    ) => {
        $crate::case::section::section! { @struct [$(#[$attribute])*] $name
            [$($(#[doc = $what])+ pub $field: $type,)* $($($(#[$other_attribute])* pub $other: $other_type,)*)?]
        }
        $crate::case::section::section! { @keys $keys [$($($misplaced)*)?] $($($what)+ $field = $key,)* }
        $crate::case::section::section! { @write $name $keys $($field)* }
        $crate::case::section::section! {
            @read $name [$($rules)?] [$($absent)?] [$($field)*] [$($($other)*)?]
        }
    };
    // The keys of a struct of the core, which has its own serialisation.
    (for $name:ident = $keys:ident { $($(#[doc = $what:literal])+ $field:ident = $key:expr,)* }) => {
        $crate::case::section::section! { @keys $keys [] $($($what)+ $field = $key,)* }
        $crate::case::section::section! { @read $name [] [] [$($field)*] [] }
    };
    // A struct with further fields, read by hand.
    (whole
        $(#[$attribute:meta])*
        pub struct $name:ident = $keys:ident {
            $($(#[doc = $what:literal])+ pub $field:ident: $type:ty = $key:expr,)*
        }
        beside { $($(#[$other_attribute:meta])* $other:ident: $other_type:ty,)* }
    ) => {
        $crate::case::section::section! { @struct [$(#[$attribute])*] $name
            [$($(#[doc = $what])+ pub $field: $type,)* $($(#[$other_attribute])* $other: $other_type,)*]
        }
        $crate::case::section::section! { @keys $keys [] $($($what)+ $field = $key,)* }
        $crate::case::section::section! { @write $name $keys $($field)* }
    };
    (@struct [$($attributes:tt)*] $name:ident [$($fields:tt)*]) => {
        $($attributes)*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name { $($fields)* }
    };
    (@keys $keys:ident [$($misplaced:tt)*] $($($what:literal)+ $field:ident = $key:expr,)*) => {
        pub(in crate::case) static $keys: $crate::case::keys::Keys = $crate::case::keys::Keys {
            all: &[$($crate::case::keys::Key {
                name: stringify!($field),
                what: concat!($($what),+).trim_ascii_start(),
                ..$key
            }),*],
            misplaced: &[$($misplaced)*],
        };
    };
    (@write $name:ident $keys:ident $($field:ident)*) => {
        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                use serde::ser::SerializeMap;
                let mut map = serializer.serialize_map(None)?;
                let mut keys = $keys.all.iter();
                $(
                    let key = keys.next();
                    if key.is_some_and(|key| $crate::case::section::KeyValue::is_written(&self.$field, key)) {
                        map.serialize_entry(stringify!($field), &self.$field)?;
                    }
                )*
                map.end()
            }
        }
    };
    (@read $name:ident [$($rules:path)?] [$($absent:path)?] [$($field:ident)*] [$($other:ident)*]) => {
        impl $crate::case::section::KeyValue for $name {
            fn read(value: &$crate::case::value::ValueAt<'_>) -> Result<Self, $crate::case::error::Refusal> {
                <Self as $crate::case::section::ReadTable>::read_table(&value.table()?)
            }

            $(fn is_absent(&self) -> bool {
                $absent(self)
            })?
        }
        impl $crate::case::section::ReadTable for $name {
            fn read_table(
                table: &$crate::case::reader::TableAt<'_>,
            ) -> Result<Self, $crate::case::error::Refusal> {
                table.only()?;
                let section = Self {
                    $($field: $crate::case::section::KeyValue::of(table, stringify!($field))?,)*
                    $($other: Default::default(),)*
                };
                $($rules(&section, table)?;)?
                Ok(section)
            }
        }
    };
}

/// The words of an enum, each of which is a value of a key: `words! { Method { Preconditioned = "preconditioned", … } }`.
macro_rules! words {
    ($name:ident { $($variant:ident = $word:literal,)+ }) => {
        impl $crate::case::section::Words for $name {
            const WORDS: &'static [&'static str] = &[$($word),+];
        }
        impl $crate::case::section::KeyValue for $name {
            fn read(value: &$crate::case::value::ValueAt<'_>) -> Result<Self, $crate::case::error::Refusal> {
                match value.word()? {
                    $($word => Ok(Self::$variant),)+
                    _ => Err(value.refuse_form()),
                }
            }
        }
    };
    ($(#[$attribute:meta])* pub enum $name:ident { $($(#[doc = $what:literal])+ $variant:ident = $word:literal,)+ }) => {
        $(#[$attribute])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
        pub enum $name {
            $($(#[doc = $what])+ #[serde(rename = $word)] $variant,)+
        }
        $crate::case::section::words! { $name { $($variant = $word,)+ } }
    };
}

/// An enum each of whose variants is a word of the case file.
pub(in crate::case) trait Words {
    /// The words, in the order of the variants.
    const WORDS: &'static [&'static str];
}

pub(in crate::case) use {section, words};
