//! A largest stress with its position, its error and its rival.

/// A largest value and its position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The value, a pressure; infinite under a tip in contact.
    pub value: f64,
    /// Position x, y, z; lengths.
    pub position: [f64; 3],
    /// Material, from 1; the substrate is layers + 1.
    pub material: usize,
    /// Direction of σ₁ at the position, a unit vector: a crack opens across it.
    pub direction: [f64; 3],
    /// Estimated discretisation error of the value; `None` without a coarser grid or for a value that is not a number. It covers
    /// the rivals: the largest value plus error of all positions compared, less the value, and no less than the value's own error.
    pub error: Option<f64>,
    /// Another position where the stress may be largest within the errors; `None` where there is none, or no error is known.
    pub rival: Option<Rival>,
}

/// A position whose value plus error exceeds the largest value less its error; of several the one with the largest sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rival {
    /// Value at the position, in the unit of the largest one.
    pub value: f64,
    /// Estimated discretisation error of the value.
    pub error: f64,
    /// Position x, y, z; lengths.
    pub position: [f64; 3],
    /// Material, from 1.
    pub material: usize,
}

impl Peak {
    /// The larger of two, this one of equals; a value that is not a number counts as largest.
    pub fn higher(self, other: Self) -> Self {
        if self.value.is_nan() || other.value <= self.value { self } else { other }
    }

    /// The value; `None` unless it is finite.
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
