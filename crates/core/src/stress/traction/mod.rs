//! The traction on the surface of a body: a pressure p, and a tangential traction **q** = (q_x, q_y).
//!
//! - **Coulomb**: **q** = μ p **e**. The waves of **q** are μ **e** times those of p, and at an edge of contact both end with the
//!   exponents ½ ± η of coupled friction ([`Friction::edge_exponent`]).
//! - **Fields**: any q_x and q_y on the samples of p, with waves of their own. At an edge of contact p and **q** end like the square
//!   root of the distance, in any proportion to each other.
//!
//! Heat of friction that enters a body which expands is one more field, a flux.

use crate::counterbody::{LoadedDisc, constant_axis};
use crate::friction::Friction;
use crate::heat::HeatedBody;
use crate::heating::Heating;
use crate::lattice::{Grid, NotOnGrid};
use crate::numeric::array::view;
use crate::numeric::sums;
use crate::spectral::Contact;
use ndarray::ArrayView2;
use std::borrow::Cow;
use std::sync::Arc;

/// Pressure and tangential traction on one body, sample by sample on a grid.
#[derive(Debug, Clone)]
pub struct Traction<'a> {
    grid: Arc<Grid>,
    /// Pressure, one value per sample, a₂ fastest.
    pressure: Cow<'a, [f64]>,
    tangential: Tangential<'a>,
    /// Discs of a given pressure that the samples stand for; none of another pressure.
    discs: Vec<LoadedDisc>,
    /// Whether the pressure is that of a contact, which vanishes at edges; between surfaces that adhere it ends with a tension.
    is_contact: bool,
    /// Axis along which nothing changes, see [`Counterbody::line`](crate::Counterbody::line).
    line: Option<usize>,
    /// Velocity with which the traction moves over the body, lengths per time; zero at rest.
    velocity: [f64; 2],
    /// Heat that enters this body, and the other one; `None` where nothing expands.
    heat: [Option<EnteringHeat<'a>>; 2],
}

/// Heat that enters a body, which expands.
#[derive(Debug, Clone)]
pub(super) struct EnteringHeat<'a> {
    /// The body, with the velocity of the source over it.
    pub body: HeatedBody,
    /// Flux, a power per area, one value per sample, a₂ fastest.
    pub flux: Cow<'a, [f64]>,
}

/// Tangential traction on a body.
#[derive(Debug, Clone)]
enum Tangential<'a> {
    None,
    /// μ p **e**, and Dundurs' β of the materials that meet at the surface.
    Coulomb {
        friction: Friction,
        beta: f64,
    },
    /// q_x and q_y, pressures, one value per sample, a₂ fastest.
    Fields([Cow<'a, [f64]>; 2]),
}

/// Form of a tangential traction: how its waves and its edges follow from those of the pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ShearForm {
    /// No tangential traction.
    None,
    /// Coulomb friction: μ **e** times the pressure, and η of the exponents ½ ± η at edges of contact.
    Coulomb { ratio: [f64; 2], edge_exponent: f64 },
    /// Fields with waves of their own, which end at edges of contact like a square root.
    Fields,
}

impl ShearForm {
    /// Tangential traction over the pressure, zero without one; `None` of fields.
    pub fn ratio(self) -> Option<[f64; 2]> {
        match self {
            Self::None => Some([0.0; 2]),
            Self::Coulomb { ratio, .. } => Some(ratio),
            Self::Fields => None,
        }
    }

    /// η of the exponents ½ ± η with which pressure and traction vanish at edges of contact.
    pub fn edge_exponent(self) -> f64 {
        match self {
            Self::Coulomb { edge_exponent, .. } => edge_exponent,
            Self::None | Self::Fields => 0.0,
        }
    }
}

impl<'a> Traction<'a> {
    /// Traction on the body under a solved contact: its pressure, and μ p **e** of a counterbody that slides, or the tractions of partial
    /// slip.
    pub fn sliding(contact: &'a Contact) -> Self {
        let problem = contact.problem();
        let beta = problem.bodies().dundurs_beta();
        Self {
            grid: Arc::clone(contact.grid()),
            pressure: contact.net_pressures(),
            tangential: match (contact.shear(), contact.tensions()) {
                (Some(shear), _) => Tangential::Fields(shear.traction.each_ref().map(|field| (&field[..]).into())),
                (None, None) => coulomb(problem.friction(), beta),
                // The tension does not rub.
                (None, Some(_)) => rubbed(problem.friction(), contact.pressures()),
            },
            discs: discs_under(contact),
            is_contact: problem.counterbody().is_some() && problem.adhesion().is_none(),
            line: problem.loaded_by().line(),
            velocity: problem.velocity(),
            heat: entering(contact),
        }
    }

    /// Any `pressure` on a grid, axes along a₁ and a₂, without a tangential traction. The pressure is taken to end as a contact's does.
    ///
    /// # Errors
    /// [`NotOnGrid`] unless the pressure has one value per sample of the grid.
    pub fn normal(grid: &Arc<Grid>, pressure: ArrayView2<'a, f64>) -> Result<Self, NotOnGrid> {
        let line = constant_axis(pressure);
        let pressure = on_grid(grid, pressure)?;
        let (tangential, discs) = (Tangential::None, Vec::new());
        let (grid, velocity, heat) = (Arc::clone(grid), [0.0; 2], [None, None]);
        Ok(Self { grid, pressure, tangential, discs, is_contact: true, line, velocity, heat })
    }

    /// The pressure with μ p **e** on a body that meets the counterbody with Dundurs'
    /// [β](crate::body::Bodies::dundurs_beta).
    #[must_use]
    pub fn with_friction(self, friction: &Friction, beta: f64) -> Self {
        Self { tangential: coulomb(Some(friction), beta), ..self }
    }

    /// The pressure with the tangential tractions q_x and q_y on the body, in its unit, axes along a₁ and a₂. Where contact has edges
    /// they are taken to end there like the square root of the distance, as the pressure does.
    ///
    /// # Errors
    /// [`NotOnGrid`] unless both have one value per sample of the grid.
    pub fn with_fields(self, [x, y]: [ArrayView2<'a, f64>; 2]) -> Result<Self, NotOnGrid> {
        let fields = [on_grid(&self.grid, x)?, on_grid(&self.grid, y)?];
        let line = common_axis([view(self.grid.points(), &self.pressure), x, y]);
        Ok(Self { tangential: Tangential::Fields(fields), line, ..self })
    }

    /// The traction as the counterbody bears it: the same pressure, the opposite tangential traction.
    #[must_use]
    pub fn reversed(self) -> Self {
        let tangential = match self.tangential {
            Tangential::None => Tangential::None,
            // β changes its sign too, so that trailing edges stay trailing edges.
            Tangential::Coulomb { friction, beta } => {
                Tangential::Coulomb { friction: friction.reversed(), beta: -beta }
            }
            Tangential::Fields(fields) => {
                Tangential::Fields(fields.map(|field| field.iter().map(|q| -q).collect::<Vec<f64>>().into()))
            }
        };
        // A counterbody rests in the frame of the traction, and what heat it takes enters it.
        let [own, other] = self.heat;
        Self { tangential, velocity: [0.0; 2], heat: [other, own], ..self }
    }

    /// Velocity with which the traction moves over the body, lengths per time; zero at rest.
    pub(super) fn velocity(&self) -> [f64; 2] {
        self.velocity
    }

    /// The traction with samples of its own.
    pub(super) fn into_owned(self) -> Traction<'static> {
        let Self { grid, pressure, tangential, discs, is_contact, line, velocity, heat } = self;
        let owned = |field: Cow<'a, [f64]>| Cow::Owned(field.into_owned());
        let heat = heat.map(|heat| heat.map(|EnteringHeat { body, flux }| EnteringHeat { body, flux: owned(flux) }));
        let tangential = match tangential {
            Tangential::None => Tangential::None,
            Tangential::Coulomb { friction, beta } => Tangential::Coulomb { friction, beta },
            Tangential::Fields(fields) => Tangential::Fields(fields.map(owned)),
        };
        Traction { grid, pressure: owned(pressure), tangential, discs, is_contact, line, velocity, heat }
    }

    /// Heat that enters the body, which expands; `None` where nothing does.
    pub(super) fn heat(&self) -> Option<&EnteringHeat<'a>> {
        self.heat[0].as_ref()
    }

    /// The grid.
    pub fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// The pressure sample by sample, a₂ fastest.
    pub(super) fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// q_x and q_y sample by sample, a₂ fastest; `None` where they follow from the pressure.
    pub(super) fn fields(&self) -> Option<[&[f64]; 2]> {
        match &self.tangential {
            Tangential::Fields(fields) => Some(fields.each_ref().map(|field| &**field)),
            Tangential::None | Tangential::Coulomb { .. } => None,
        }
    }

    /// Form of the tangential traction.
    pub(super) fn form(&self) -> ShearForm {
        match &self.tangential {
            Tangential::None => ShearForm::None,
            Tangential::Coulomb { friction, beta } => {
                ShearForm::Coulomb { ratio: friction.traction(), edge_exponent: friction.edge_exponent(*beta) }
            }
            Tangential::Fields(_) => ShearForm::Fields,
        }
    }

    /// Discs of a given pressure that the samples stand for; none of another pressure.
    pub(super) fn discs(&self) -> &[LoadedDisc] {
        &self.discs
    }

    /// Whether the pressure is that of a contact, which vanishes at edges.
    pub(super) fn is_of_contact(&self) -> bool {
        self.is_contact
    }

    /// Axis along which nothing changes; `None` where there is no such axis.
    pub(super) fn line(&self) -> Option<usize> {
        self.line
    }

    /// Whether anything acts on a sample.
    pub(super) fn is_loaded(&self, sample: usize) -> bool {
        self.pressure[sample] != 0.0 || self.fields().is_some_and(|fields| fields.iter().any(|q| q[sample] != 0.0))
    }

    /// The largest pressure or tension, or where it is larger that of the tangential tractions of fields, a pressure.
    pub(super) fn largest(&self) -> f64 {
        let fields = self.fields();
        let size = |i: usize| self.pressure[i].abs();
        let of = |i: usize| fields.map_or(size(i), |[x, y]| size(i).max(x[i].hypot(y[i])));
        -sums::least(self.pressure.len(), |i| -of(i))
    }
}

/// Heat that enters the body under a contact, and the counterbody; `None` of what does not expand.
fn entering<'a>(contact: &'a Contact) -> [Option<EnteringHeat<'a>>; 2] {
    let problem = contact.problem();
    let (Some(heat), Ok(bodies)) = (contact.heat(), problem.heated_bodies()) else { return [None, None] };
    if !problem.heating().is_some_and(Heating::expands) {
        return [None, None];
    }
    let of = |body: HeatedBody, flux: Cow<'a, [f64]>| {
        let warms = body.expands() && flux.iter().any(|q| *q != 0.0);
        warms.then_some(EnteringHeat { body, flux })
    };
    let above = bodies.counterbody.and_then(|above| of(above, heat.flux_above().into()));
    [of(bodies.body, (&heat.flux[..]).into()), above]
}

/// μ p **e** of a counterbody that slides with friction.
fn coulomb<'a>(friction: Option<&Friction>, beta: f64) -> Tangential<'a> {
    let rubs = |friction: &&Friction| friction.traction() != [0.0; 2];
    friction.filter(rubs).map_or(Tangential::None, |&friction| Tangential::Coulomb { friction, beta })
}

/// μ p **e** as fields, sample by sample.
fn rubbed<'a>(friction: Option<&Friction>, pressure: &[f64]) -> Tangential<'a> {
    let rubs = |friction: &&Friction| friction.traction() != [0.0; 2];
    friction.filter(rubs).map_or(Tangential::None, |friction| {
        let along = |ratio: f64| pressure.iter().map(|p| ratio * p).collect::<Vec<f64>>().into();
        Tangential::Fields(friction.traction().map(along))
    })
}

/// The samples of a field, a₂ fastest.
fn on_grid<'a>(grid: &Grid, field: ArrayView2<'a, f64>) -> Result<Cow<'a, [f64]>, NotOnGrid> {
    grid.check(field.dim().into())?;
    Ok(field.to_slice().map_or_else(|| field.iter().copied().collect::<Vec<f64>>().into(), Cow::Borrowed))
}

/// The axis along which all of some fields are constant while one at least changes along the other; `None` where there is no such
/// axis.
fn common_axis(fields: [ArrayView2<'_, f64>; 3]) -> Option<usize> {
    let changes = |field: &ArrayView2<'_, f64>| field.iter().any(|value| Some(value) != field.first());
    let mut axes = fields.into_iter().filter(changes).map(constant_axis);
    let axis = axes.next()?;
    axes.all(|other| other == axis).then_some(axis)?
}

/// The discs of a given pressure under the load of a contact; none of any other pressure.
fn discs_under(contact: &Contact) -> Vec<LoadedDisc> {
    let Some(given) = contact.problem().given_pressure() else { return Vec::new() };
    let factor = sums::mean(contact.pressures()) * contact.grid().cell().area() / given.force();
    given.loaded_discs().iter().map(|disc| LoadedDisc { pressure: factor * disc.pressure, ..*disc }).collect()
}

#[cfg(test)]
mod tests;
