//! Quantities of a load step, each declared once with its field: name, symbol, kind of unit and error.
//!
//! The macro `quantities!` makes three things of the list of a record's fields: the record itself, its quantities as a static table, and where it
//! keeps them in a record of their own, its errors. A field that is followed by `= Kind "name" "symbol"` is a quantity:
//!
//! | behind it | meaning |
//! |---|---|
//! | `code "…"` | the key in files, where that is not the name of the field |
//! | `short "…"` | the name in narrow places |
//! | `given "…"` | the name where a pressure is given, and nothing touches |
//! | `error field` | the field of the error, beside it |
//! | `by expression` | how it is read off the record, where that is not the field with its error |
//!
//! Whether a quantity applies to a step is what its reading says: `None` where it does not, infinite under a tip.

use crate::measured::Measured;

/// Kind of the unit of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A pressure or a stress.
    Pressure,
    /// A force: a pressure times an area.
    Force,
    /// A length.
    Length,
    /// A length squared.
    Area,
    /// A cubed length.
    Volume,
    /// A pressure times a cubed length.
    Energy,
    /// A force per length.
    Stiffness,
    /// A pressure per length.
    PressurePerLength,
    /// A part of a whole.
    Fraction,
    /// A ratio, as a coefficient of friction.
    Ratio,
    /// A temperature.
    Temperature,
    /// A number of passes.
    Passes,
    /// A stress over a strength.
    Utilisation,
    /// A strain: a length over a length.
    Strain,
    /// A time.
    Time,
}

impl Kind {
    /// Name of the kind.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pressure => "pressure",
            Self::Force => "force",
            Self::Length => "length",
            Self::Area => "area",
            Self::Volume => "volume",
            Self::Energy => "energy",
            Self::Stiffness => "force per length",
            Self::PressurePerLength => "pressure per length",
            Self::Fraction => "fraction",
            Self::Ratio => "ratio",
            Self::Temperature => "temperature",
            Self::Passes => "passes",
            Self::Utilisation => "utilisation",
            Self::Strain => "strain",
            Self::Time => "time",
        }
    }
}

/// Place of the error of a quantity in files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorAt {
    /// The error is under `errors` of its record, by the code of the quantity.
    Under,
    /// The error is beside the quantity, under this key.
    Beside(&'static str),
    /// The quantity is a peak of the keys `value` and `error`.
    InPeak,
    /// The error has no key, or is not in the unit of the quantity.
    Nowhere,
}

/// Names of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Named {
    /// Key in files.
    pub code: &'static str,
    /// Name in words.
    pub name: &'static str,
    /// Name in narrow places.
    pub short: &'static str,
    /// Name where a pressure is given, and nothing touches.
    pub given: &'static str,
    /// Symbol.
    pub symbol: &'static str,
    /// Kind of the unit.
    pub kind: Kind,
    /// Place of the error.
    pub error: ErrorAt,
}

impl Named {
    /// A quantity that has one name everywhere.
    pub const fn new(code: &'static str, name: &'static str, symbol: &'static str, kind: Kind, error: ErrorAt) -> Self {
        Self { code, name, short: name, given: name, symbol, kind, error }
    }

    /// The quantity with another name in narrow places.
    #[must_use]
    pub const fn short(self, short: &'static str) -> Self {
        Self { short, ..self }
    }

    /// The quantity with another name where a pressure is given.
    #[must_use]
    pub const fn given(self, given: &'static str) -> Self {
        Self { given, ..self }
    }

    /// Keys of value and error in files, behind the keys that lead to the `record`; no key of an error that has none.
    pub fn keys(&self, record: &str) -> (String, Option<String>) {
        let key = format!("{record}{}", self.code);
        match self.error {
            ErrorAt::Under => (key, Some(format!("{record}errors.{}", self.code))),
            ErrorAt::Beside(error) => (key, Some(format!("{record}{error}"))),
            ErrorAt::InPeak => (format!("{key}.value"), Some(format!("{key}.error"))),
            ErrorAt::Nowhere => (key, None),
        }
    }

    /// The name in a contact, or where a pressure is given.
    pub const fn of(&self, is_given: bool) -> &'static str {
        if is_given { self.given } else { self.name }
    }
}

/// A quantity of a record: its names, and how it is read.
#[derive(Debug, Clone, Copy)]
pub struct Quantity<R: 'static> {
    /// Names and kind.
    pub named: Named,
    of: fn(&R) -> Option<Measured>,
}

impl<R> Quantity<R> {
    /// A quantity that is read off a record in this way.
    pub const fn new(named: Named, of: fn(&R) -> Option<Measured>) -> Self {
        Self { named, of }
    }

    /// Value and error in a record; `None` where the quantity does not apply, infinite under a tip.
    pub fn of(&self, record: &R) -> Option<Measured> {
        (self.of)(record)
    }

    /// Value and error in a record where the value is finite.
    pub fn finite(&self, record: &R) -> Option<Measured> {
        self.of(record).and_then(Measured::finite)
    }
}

/// A field that is a quantity.
pub trait Reads {
    /// Place of the error, where none is declared.
    const ERROR: ErrorAt = ErrorAt::Nowhere;

    /// The value of the field with an error that stands elsewhere; `None` where there is no value.
    fn measured(&self, error: Option<f64>) -> Option<Measured>;
}

impl Reads for f64 {
    fn measured(&self, error: Option<f64>) -> Option<Measured> {
        Some(Measured::new(*self, error))
    }
}

impl<T: Reads> Reads for Option<T> {
    const ERROR: ErrorAt = T::ERROR;

    fn measured(&self, error: Option<f64>) -> Option<Measured> {
        self.as_ref()?.measured(error)
    }
}

/// Makes a record, its quantities and its errors of one list; see the [module](self).
macro_rules! quantities {
    // A record whose errors are a record of their own, with further ones behind those of its quantities.
    (
        $(#[$about:meta])*
        pub struct $record:ident {
            $(
                $(#[$attribute:meta])* pub $field:ident: $type:ty
                $(= $kind:ident $name:literal $symbol:literal
                    $(code $code:literal)? $(short $short:literal)? $(given $given:literal)?)?
            ),* $(,)?
        }
        table $table:ident as $list:ident;
        $(#[$of_errors:meta])*
        errors $errors:ident { $($(#[$of_more:meta])* pub $more:ident: $more_type:ty),* $(,)? }
    ) => {
        $(#[$about])*
        pub struct $record { $($(#[$attribute])* pub $field: $type,)* }

        $(#[$of_errors])*
        pub struct $errors {
            $($(#[doc = concat!("Error of the ", $name, ", in its unit; `None` where it is not known.")] pub $field: Option<f64>,)?)*
            $($(#[$of_more])* pub $more: $more_type,)*
        }

        $crate::quantity::quantities!(@table $record $table $list $($(
            $field ($name) $crate::quantity::Quantity::new(
                $crate::quantity::quantities!(@named $field $name $symbol $kind [$($code)?] $crate::quantity::ErrorAt::Under)
                    $(.short($short))? $(.given($given))?,
                |record: &$record| $crate::quantity::Reads::measured(&record.$field, record.errors.$field),
            );
        )?)*);
    };
    // A record whose errors stand beside its quantities, or in them.
    (
        $(#[$about:meta])*
        pub struct $record:ident {
            $(
                $(#[$attribute:meta])* pub $field:ident: $type:ty
                $(= $kind:ident $name:literal $symbol:literal
                    $(code $code:literal)? $(short $short:literal)? $(given $given:literal)?
                    $(error $error:ident)? $(by $of:expr)?)?
            ),* $(,)?
        }
        table $table:ident as $list:ident;
    ) => {
        $(#[$about])*
        pub struct $record { $($(#[$attribute])* pub $field: $type,)* }

        $crate::quantity::quantities!(@table $record $table $list $($(
            $field ($name) $crate::quantity::Quantity::new(
                $crate::quantity::quantities!(@named $field $name $symbol $kind [$($code)?]
                    $crate::quantity::quantities!(@place [$type] $(error $error)? $(by $of)?))
                    $(.short($short))? $(.given($given))?,
                $crate::quantity::quantities!(@read [$record $field] $(error $error)? $(by $of)?),
            );
        )?)*);
    };
    (@table $record:ident $table:ident $list:ident $($field:ident ($name:literal) $quantity:expr;)*) => {
        #[doc = concat!("The quantities of a [`", stringify!($record), "`].")]
        #[derive(Debug)]
        pub struct $table {
            $(#[doc = concat!("The ", $name, ".")] pub $field: $crate::quantity::Quantity<$record>,)*
        }

        #[doc = concat!("The quantities of a [`", stringify!($record), "`].")]
        pub static $list: $table = $table { $($field: $quantity,)* };

        impl $table {
            /// All quantities, in the order of the record.
            pub fn each(&self) -> Vec<&$crate::quantity::Quantity<$record>> {
                vec![$(&self.$field),*]
            }
        }
    };
    (@named $field:ident $name:literal $symbol:literal $kind:ident [$($code:literal)?] $error:expr) => {
        $crate::quantity::Named::new(
            $crate::quantity::quantities!(@first $($code,)? stringify!($field),),
            $name,
            $symbol,
            $crate::quantity::Kind::$kind,
            $error,
        )
    };
    (@first $first:expr, $($rest:expr,)*) => { $first };
    (@place [$type:ty]) => { <$type as $crate::quantity::Reads>::ERROR };
    (@place [$type:ty] error $error:ident) => { $crate::quantity::ErrorAt::Beside(stringify!($error)) };
    (@place [$type:ty] by $of:expr) => { $crate::quantity::ErrorAt::Nowhere };
    (@read [$record:ident $field:ident]) => { |record: &$record| $crate::quantity::Reads::measured(&record.$field, None) };
    (@read [$record:ident $field:ident] error $error:ident) => {
        |record: &$record| $crate::quantity::Reads::measured(&record.$field, record.$error)
    };
    (@read [$record:ident $field:ident] by $of:expr) => { $of };
}

pub(crate) use quantities;
