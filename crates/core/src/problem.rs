//! The problem: a layered elastic half-space, loaded by a counterbody, rigid or elastic, at rest or sliding, or by a given pressure.

use crate::adhesion::{Adhesion, AdhesionError};
use crate::body::{Bodies, CompositeError, CompositeHardness, HalfSpace, Interface, Side};
use crate::counterbody::{Counterbody, GivenPressure, Indenters, Level, LevelName, LoadedBy, Topography};
use crate::friction::{Friction, FrictionError};
use crate::heating::{HeatedBodies, Heating, HeatingError};
use crate::kind::{ContactKind, Datum};
use crate::lattice::{Cell, Surroundings};
use crate::steady_motion::{MotionError, SteadyMotion};
use std::fmt;

/// A half-space and what loads it, with or without friction. Both parts are checked at construction: every problem is valid.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    loaded_by: LoadedBy,
    bodies: Bodies,
    friction: Option<Friction>,
    adhesion: Option<Adhesion>,
    motion: Option<SteadyMotion>,
    heating: Option<Heating>,
    composite: Option<CompositeHardness>,
}

impl Problem {
    /// Frictionless contact of a counterbody of this shape ([`Indenters`] or a
    /// [`Topography`]), or the load of a [`GivenPressure`], on a [`HalfSpace`], rigid, or of [`Bodies`] of which both are elastic; in
    /// one unit of length.
    pub fn new(loaded_by: impl Into<LoadedBy>, bodies: impl Into<Bodies>) -> Self {
        let (loaded_by, bodies) = (loaded_by.into(), bodies.into());
        Self { loaded_by, bodies, friction: None, adhesion: None, motion: None, heating: None, composite: None }
    }

    /// The problem with friction.
    ///
    /// # Errors
    /// [`FrictionError::Unheld`] when a layer lies on a frictionless interface, unless the coefficient is zero.
    pub fn sliding(self, friction: Friction) -> Result<Self, FrictionError> {
        let loose = |body: &HalfSpace| {
            let index = body.layers().iter().position(|layer| layer.interface() == Interface::Frictionless)?;
            Some(body.interface_id(index + 1))
        };
        let unheld = self.bodies.each().find_map(loose).filter(|_| friction.coefficient() > 0.0);
        match unheld {
            Some(interface) => Err(FrictionError::Unheld(interface)),
            None => Ok(Self { friction: Some(friction), ..self }),
        }
    }

    /// The problem with surfaces that pull each other.
    ///
    /// # Errors
    /// [`AdhesionError::Given`] under a given pressure, [`AdhesionError::Hardness`] with a hardness, [`AdhesionError::Coupled`] with friction that
    /// couples.
    pub fn adhering(self, adhesion: Adhesion) -> Result<Self, AdhesionError> {
        self.may_adhere()?;
        Ok(Self { adhesion: Some(adhesion), ..self })
    }

    /// Whether surfaces of these bodies, with this friction, may adhere.
    pub(crate) fn may_adhere(&self) -> Result<(), AdhesionError> {
        match () {
            () if self.kind().is_given => Err(AdhesionError::Given),
            () if self.largest_hardness().is_some() => Err(AdhesionError::Hardness),
            () if self.friction.is_some_and(|friction| friction.couples()) => Err(AdhesionError::Coupled),
            () => Ok(()),
        }
    }

    /// The problem with a counterbody, or a given pressure, that moves steadily over the body, in the [direction](Self::direction) of the
    /// friction.
    ///
    /// # Errors
    /// [`MotionError`] where no material of the body relaxes and not all conduct heat, in the window of an isolated contact, and with hardness,
    /// adhesion or, below a contact with a body that relaxes, a life by strain.
    pub fn moving(self, motion: SteadyMotion) -> Result<Self, MotionError> {
        match () {
            () if !self.half_space().relaxes() && !self.half_space().conducts() => Err(MotionError::Elastic),
            () if self.cell().surroundings() == Surroundings::FreeSpace => Err(MotionError::Isolated),
            () if self.largest_hardness().is_some() => Err(MotionError::Hardness),
            () if self.adhesion.is_some() => Err(MotionError::Adhesion),
            () if self.strains_at_edges() && self.bodies.last_by_strain() => Err(MotionError::Strain),
            () => Ok(Self { motion: Some(motion), ..self }),
        }
    }

    /// Whether a body that relaxes lies below the edges of a contact: strains there follow from glassy moduli when the contact moves.
    pub fn strains_at_edges(&self) -> bool {
        self.half_space().relaxes() && self.given_pressure().is_none()
    }

    /// The problem with frictional heat, of a counterbody that slides with friction and moves steadily.
    ///
    /// # Errors
    /// [`HeatingError`] without friction or motion, and where a material has no conduction.
    pub fn heated(self, heating: Heating) -> Result<Self, HeatingError> {
        if self.motion.is_none() {
            return Err(HeatingError::Rest);
        }
        if self.friction.is_none_or(|friction| friction.coefficient() <= 0.0) {
            return Err(HeatingError::Smooth);
        }
        let heated = Self { heating: Some(heating), ..self };
        heated.heated_bodies()?;
        Ok(heated)
    }

    /// Frictional heat; `None` where nothing heats.
    pub fn heating(&self) -> Option<&Heating> {
        self.heating.as_ref()
    }

    /// Conducting bodies of the problem.
    ///
    /// # Errors
    /// [`HeatingError::Material`] for a material without conduction.
    pub(crate) fn heated_bodies(&self) -> Result<HeatedBodies, HeatingError> {
        let speed = self.motion.map_or(0.0, |motion| motion.velocity());
        HeatedBodies::new(self.half_space(), self.bodies.counterbody(), (speed, self.direction()))
    }

    /// Frictional heat over the pressure, μ v: a power per area and pressure; 0 where nothing heats.
    pub(crate) fn heat_over_pressure(&self) -> f64 {
        let heats = self.heating.is_some();
        let friction = self.friction.filter(|_| heats).map_or(0.0, |friction| friction.coefficient());
        friction * self.motion.map_or(0.0, |motion| motion.velocity())
    }

    /// Steady motion; `None` at rest, and of elastic bodies.
    pub fn motion(&self) -> Option<&SteadyMotion> {
        self.motion.as_ref()
    }

    /// Velocity **v** of the counterbody, or of the given pressure, over the body, lengths per time; zero at rest, and of elastic bodies.
    pub fn velocity(&self) -> [f64; 2] {
        let speed = self.motion.map_or(0.0, |motion| motion.velocity());
        self.direction().map(|e| speed * e)
    }

    /// Adhesion of the surfaces; `None` where they do not pull each other.
    pub fn adhesion(&self) -> Option<&Adhesion> {
        self.adhesion.as_ref()
    }

    /// The problem without friction: neither sliding nor sticking.
    #[must_use]
    pub fn at_rest(&self) -> Self {
        Self { friction: None, ..self.clone() }
    }

    /// Hardness that the pressure of contact does not exceed, in its unit, with the side of the softer surface. `None` without one, and
    /// under a given pressure, which is prescribed, displaces elastically and presses nothing in.
    pub fn hardness(&self) -> Option<(f64, Side)> {
        self.bodies.hardness().filter(|_| !self.kind().is_given)
    }

    /// The problem with a hardness of the coating and its substrate together: each load meets the hardness at its penetration.
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

    /// Hardness of the coating and its substrate together; `None` where the hardness of the coating holds at any depth.
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

    /// The problem without hardness: elastic under any pressure.
    #[must_use]
    pub fn without_hardness(&self) -> Self {
        Self { bodies: self.bodies.without_hardness(), composite: None, ..self.clone() }
    }

    /// The problem on another body.
    #[must_use]
    pub fn on_body(&self, body: HalfSpace) -> Self {
        Self { bodies: self.bodies.with_body(body), ..self.clone() }
    }

    /// The problem with a window `factor` times as wide and as high; `None` unless they are an isolated contact.
    pub(crate) fn widened(&self, factor: f64) -> Option<Self> {
        let loaded_by = self.indenters()?.widened(factor)?.into();
        Some(Self { loaded_by, ..self.clone() })
    }

    /// The counterbody, or the given pressure.
    pub fn loaded_by(&self) -> &LoadedBy {
        &self.loaded_by
    }

    /// The shape of the counterbody; `None` under a given pressure.
    pub fn counterbody(&self) -> Option<&Counterbody> {
        self.loaded_by.counterbody()
    }

    /// The indenters; `None` under a topography and a given pressure.
    pub fn indenters(&self) -> Option<&Indenters> {
        self.counterbody()?.indenters()
    }

    /// The period of the lattice of indenters, a length; `None` around an isolated contact, and without indenters.
    pub fn period(&self) -> Option<f64> {
        let period = self.indenters()?.lattice().period();
        self.cell().surroundings().per_cell(period)
    }

    /// The only indenter of an isolated contact; `None` in a periodic system, and without indenters.
    pub fn lone_indenter(&self) -> Option<&Level> {
        let indenters = self.indenters()?;
        match (self.cell().surroundings(), indenters.sites().len(), indenters.levels()) {
            (Surroundings::FreeSpace, 1, [level, ..]) => Some(level),
            _ => None,
        }
    }

    /// The name in words of a level by its number, from 1.
    pub fn level_name(&self, level: usize) -> LevelName {
        LevelName::new(level, self.lone_indenter())
    }

    /// The levels of the indenters; none under a topography and a given pressure.
    pub fn levels(&self) -> &[Level] {
        self.indenters().map_or(&[], Indenters::levels)
    }

    /// The topography; `None` under indenters and a given pressure.
    pub fn topography(&self) -> Option<&Topography> {
        self.counterbody()?.topography()
    }

    /// Whether a rigid counterbody is pressed onto the body.
    pub fn has_rigid_counterbody(&self) -> bool {
        self.counterbody().is_some() && self.bodies.counterbody().is_none()
    }

    /// The given pressure; `None` under a counterbody.
    pub fn given_pressure(&self) -> Option<&GivenPressure> {
        self.loaded_by.pressure()
    }

    /// Kind of the contact.
    pub fn kind(&self) -> ContactKind {
        self.loaded_by.kind()
    }

    /// Datum from which penetration and displacements count.
    pub fn datum(&self) -> Datum {
        Datum::of(self.cell().surroundings(), self.bodies.mean_compliance())
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

    /// Direction in which the counterbody, or the given pressure, slides or moves over the body, a unit vector; `None` at rest without friction.
    pub fn sliding_direction(&self) -> Option<[f64; 2]> {
        (self.friction.is_some() || self.motion.is_some()).then(|| self.direction())
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.loaded_by.cell()
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", self.loaded_by, self.bodies)?;
        self.friction.iter().try_for_each(|friction| write!(f, "\n{friction}"))?;
        self.motion.iter().try_for_each(|motion| write!(f, "\n{motion}"))?;
        self.heating.iter().try_for_each(|heating| write!(f, "\n{heating}"))?;
        self.adhesion.iter().try_for_each(|adhesion| write!(f, "\n{adhesion}"))
    }
}
