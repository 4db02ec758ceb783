//! The stress fields of both bodies under one contact.

use super::field::StressField;
use super::tables::Tables;
use super::traction::{ShearForm, Traction};
use super::work::StressWork;
use crate::body::{Bodies, MeanStress, Side};
use crate::spectral::Contact;
use std::fmt;
use std::sync::Arc;

/// The stress field of the body, and that of the counterbody where it is elastic.
///
/// Each field has its own z, from the common surface inward; x and y are those of the body. The counterbody bears the
/// tangential traction in the opposite direction.
#[derive(Debug)]
pub struct StressFields {
    body: StressField,
    counterbody: Option<StressField>,
}

impl StressFields {
    /// Stress fields under a solved contact.
    pub fn new(contact: &Contact, mean: MeanStress) -> Self {
        Self::with_tables(contact, mean, &Arc::default())
    }

    /// Stress fields under a solved contact that share the `tables` of other fields of a run.
    pub(crate) fn with_tables(contact: &Contact, mean: MeanStress, tables: &Arc<Tables>) -> Self {
        Self::sharing(Traction::sliding(contact), contact.problem().bodies(), mean, tables)
    }

    /// The fields, of which the largest strains are searched beside the largest stresses where `strains` is set.
    #[must_use]
    pub fn with_strains(self, strains: bool) -> Self {
        let Self { body, counterbody } = self;
        Self { body: body.with_strains(strains), counterbody: counterbody.map(|field| field.with_strains(strains)) }
    }

    /// Stress fields of both bodies under any traction on the first one.
    pub fn under(traction: Traction<'_>, bodies: &Bodies, mean: MeanStress) -> Self {
        Self::sharing(traction, bodies, mean, &Arc::default())
    }

    fn sharing(traction: Traction<'_>, bodies: &Bodies, mean: MeanStress, tables: &Arc<Tables>) -> Self {
        let body = StressField::sharing(&traction, bodies.on(None), mean, Arc::clone(tables));
        let counterbody = bodies
            .counterbody()
            .map(|counterbody| StressField::sharing(&traction.reversed(), counterbody, mean, Arc::clone(tables)));
        Self { body, counterbody }
    }

    /// The fields under another contact of the same run, or of this step on another grid; `None` for a contact without the tangential
    /// tractions that do not follow from its pressure.
    pub(crate) fn of_other(&self, contact: &Contact) -> Option<Self> {
        let is_known = self.body.form() != ShearForm::Fields || contact.shear().is_some();
        is_known.then(|| {
            Self::with_tables(contact, self.body.mean_stress(), self.body.tables()).with_strains(self.body.strains)
        })
    }

    /// Work of these fields so far, and of all others of the run that share their tables.
    pub fn work(&self) -> StressWork {
        self.body.tables().work().so_far()
    }

    /// The field of the body.
    pub fn body(&self) -> &StressField {
        &self.body
    }

    /// The field of the counterbody; `None` where it is rigid.
    pub fn counterbody(&self) -> Option<&StressField> {
        self.counterbody.as_ref()
    }

    /// The field of the body, then that of the counterbody where it is elastic.
    pub fn each(&self) -> impl Iterator<Item = &StressField> {
        [&self.body].into_iter().chain(&self.counterbody)
    }

    /// The field on one side; that of the body where the side has none.
    pub fn on(&self, side: Option<Side>) -> &StressField {
        self.counterbody.as_ref().filter(|_| side == Some(Side::Counterbody)).unwrap_or(&self.body)
    }
}

impl fmt::Display for StressFields {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.body)?;
        self.counterbody.iter().try_for_each(|field| write!(f, "\ncounterbody: {field}"))
    }
}
