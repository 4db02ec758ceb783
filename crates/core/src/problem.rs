//! The contact problem: a counterbody, rigid or elastic, above a layered elastic half-space, at rest or sliding.

use crate::body::{Bodies, CompositeError, CompositeHardness, HalfSpace, Interface, Side};
use crate::counterbody::Counterbody;
use crate::friction::{Friction, FrictionError};
use crate::lattice::Cell;
use std::fmt;

/// A counterbody above a half-space, with or without friction. Both parts are checked at construction: every problem is valid.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    counterbody: Counterbody,
    bodies: Bodies,
    friction: Option<Friction>,
    composite: Option<CompositeHardness>,
}

impl Problem {
    /// Frictionless contact of a counterbody of this shape ([`Indenters`](crate::counterbody::Indenters) or a
    /// [`Topography`](crate::counterbody::Topography)), or the load of a [`GivenPressure`](crate::counterbody::GivenPressure), on a [`HalfSpace`], rigid, or of [`Bodies`] of which both are elastic; in
    /// one unit of length.
    pub fn new(counterbody: impl Into<Counterbody>, bodies: impl Into<Bodies>) -> Self {
        Self { counterbody: counterbody.into(), bodies: bodies.into(), friction: None, composite: None }
    }

    /// The problem with friction.
    ///
    /// # Errors
    /// [`FrictionError::Unheld`] when a layer lies on a frictionless interface, unless the coefficient is zero.
    pub fn sliding(self, friction: Friction) -> Result<Self, FrictionError> {
        let loose = |own: &HalfSpace| {
            let index = own.layers().iter().position(|layer| layer.interface() == Interface::Frictionless)?;
            Some(own.interface_id(index + 1))
        };
        let unheld = self.bodies.each().find_map(loose).filter(|_| friction.coefficient() > 0.0);
        match unheld {
            Some(interface) => Err(FrictionError::Unheld(interface)),
            None => Ok(Self { friction: Some(friction), ..self }),
        }
    }

    /// Hardness that the pressure of contact does not exceed, in its unit, with the side of the softer surface. `None` without one, and
    /// under a given pressure, which is prescribed, displaces elastically and presses nothing in.
    pub fn hardness(&self) -> Option<(f64, Side)> {
        self.bodies.hardness().filter(|_| self.counterbody.pressure().is_none())
    }

    /// The problem with a hardness of the coating and its substrate together: each load meets that of its own penetration.
    ///
    /// # Errors
    /// [`CompositeError::Counterbody`] for a counterbody that is softer than either: the laws are those of a body that yields alone.
    pub fn with_composite_hardness(self, composite: CompositeHardness) -> Result<Self, CompositeError> {
        let above = self.bodies.surface_durability(Side::Counterbody).hardness;
        match above.filter(|above| *above < composite.largest()) {
            Some(above) => Err(CompositeError::Counterbody(above)),
            None => Ok(Self { composite: Some(composite), ..self }),
        }
    }

    /// Largest hardness that any load meets, a pressure, with the side of the softer surface; `None` without one.
    pub fn largest_hardness(&self) -> Option<(f64, Side)> {
        match &self.composite {
            Some(composite) => Some((composite.largest(), Side::Body)),
            None => self.bodies.hardness(),
        }
    }

    /// Hardness of the coating and its substrate together; `None` where the coating has its own at any depth.
    pub fn composite_hardness(&self) -> Option<&CompositeHardness> {
        self.composite.as_ref()
    }

    /// The problem on a body whose surface has this hardness, a pressure.
    #[must_use]
    pub(crate) fn with_surface_hardness(&self, hardness: f64) -> Self {
        Self { bodies: self.bodies.with_body(self.half_space().with_surface_hardness(hardness)), ..self.clone() }
    }

    /// Whether the softer body moves away below the counterbody, which slides with friction: what is pressed in leaves the contact. Without
    /// friction, also at a coefficient of zero, the loads of a path follow one another at one place.
    pub fn is_swept(&self) -> bool {
        self.friction.is_some_and(|friction| friction.coefficient() > 0.0)
            && self.hardness().is_some_and(|(_, softer)| softer == Side::Body)
    }

    /// The same problem without hardness: elastic under any pressure.
    #[must_use]
    pub fn without_hardness(&self) -> Self {
        Self { bodies: self.bodies.without_hardness(), composite: None, ..self.clone() }
    }

    /// The same problem on another body.
    #[must_use]
    pub fn on_body(&self, body: HalfSpace) -> Self {
        Self { bodies: self.bodies.with_body(body), ..self.clone() }
    }

    /// The same indenters in a window `factor` times as wide and as high; `None` unless they are an isolated contact.
    pub(crate) fn widened(&self, factor: f64) -> Option<Self> {
        let counterbody = self.counterbody.indenters()?.widened(factor)?.into();
        Some(Self { counterbody, ..self.clone() })
    }

    /// The shape of the counterbody.
    pub fn counterbody(&self) -> &Counterbody {
        &self.counterbody
    }

    /// The elastic bodies.
    pub fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// The layered half-space of the body.
    pub fn half_space(&self) -> &HalfSpace {
        self.bodies.body()
    }

    /// The friction of a sliding counterbody; `None` at rest.
    pub fn friction(&self) -> Option<&Friction> {
        self.friction.as_ref()
    }

    /// Direction of sliding, a unit vector: that of the friction, +x without any.
    pub fn direction(&self) -> [f64; 2] {
        self.friction.map_or([1.0, 0.0], |friction| friction.direction())
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.counterbody.cell()
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", self.counterbody, self.bodies)?;
        self.friction.iter().try_for_each(|friction| write!(f, "\n{friction}"))
    }
}
