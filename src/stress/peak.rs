//! The place where a stress is largest.

/// A largest value and where it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The value, a pressure; infinite under a tip in contact.
    pub value: f64,
    /// x, y, z; lengths.
    pub position: [f64; 3],
    /// Material, from 1; the substrate is layers + 1.
    pub material: usize,
    /// Direction along which σ₁ acts there, a unit vector: a crack opens across it.
    pub direction: [f64; 3],
    /// Estimated error of the value by the grid; `None` where there is no coarser grid or no number. It covers the rivals:
    /// the largest value plus error of all places that were compared, less the value, and no less than the value's own error.
    pub error: Option<f64>,
    /// Another place where the stress may be largest within the errors; `None` where the place is decided or no error is
    /// known.
    pub rival: Option<Rival>,
}

/// A place whose value plus error exceeds what the largest value is at least: of several the one that may be the highest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rival {
    /// The value there, in the unit of the largest one.
    pub value: f64,
    /// Estimated error of that value by the grid.
    pub error: f64,
    /// x, y, z; lengths.
    pub position: [f64; 3],
    /// Material, from 1.
    pub material: usize,
}

impl Peak {
    /// The larger of two, this one of equals; what is not a number is larger than any.
    pub fn higher(self, other: Self) -> Self {
        if self.value.is_nan() || other.value <= self.value { self } else { other }
    }

    /// The value where it is finite.
    pub fn finite(&self) -> Option<f64> {
        self.value.is_finite().then_some(self.value)
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Peak {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let [x, y, z] = self.position;
        let mut keys = serializer.serialize_struct("peak", 9)?;
        keys.serialize_field("value", &self.finite())?;
        keys.serialize_field("error", &self.error)?;
        keys.serialize_field("singular", &self.value.is_infinite())?;
        keys.serialize_field("x", &x)?;
        keys.serialize_field("y", &y)?;
        keys.serialize_field("z", &z)?;
        keys.serialize_field("material", &self.material)?;
        keys.serialize_field("direction", &self.direction)?;
        keys.serialize_field("rival", &self.rival)?;
        keys.end()
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Rival {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let [x, y, z] = self.position;
        let mut keys = serializer.serialize_struct("rival", 6)?;
        keys.serialize_field("value", &self.value)?;
        keys.serialize_field("error", &self.error)?;
        keys.serialize_field("x", &x)?;
        keys.serialize_field("y", &y)?;
        keys.serialize_field("z", &z)?;
        keys.serialize_field("material", &self.material)?;
        keys.end()
    }
}
