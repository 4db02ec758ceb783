//! Words for what differs between kinds of contact, in one table each.

use percoat_core::kind::ContactKind;
use percoat_core::lattice::Surroundings;
use percoat_core::run::StepRecord;

/// Words for a kind of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Words {
    /// Words for what lies around the cell.
    pub around: &'static AroundWords,
    /// Words for what loads the body.
    pub load: &'static LoadWords,
    /// End of a sentence that begins with the area of contact, or its part of the surface.
    pub extent_of: &'static str,
}

/// Words for what lies around the cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AroundWords {
    /// Rectangle or parallelogram of the grid.
    pub cell: &'static str,
    /// Name of the rectangle or parallelogram at the head of a table.
    pub heading: &'static str,
    /// Points of the grid.
    pub samples: &'static str,
    /// Further way, beside a lower load, to stay below a hardness.
    pub more_room: &'static str,
    /// Elastic energy.
    pub energy: &'static str,
    /// Number of contact spots of a topography.
    pub spots: &'static str,
    /// Stiffness by neighbouring load steps.
    pub stiffness: &'static str,
    /// Depth of what is worn off that is stated.
    pub worn: &'static str,
    /// Keys of a case that have no effect, each with its section.
    pub without_effect: &'static [[&'static str; 2]],
    /// Alternative text and caption of the pictures of pressure, contact and profiles.
    pub pictures: [[&'static str; 2]; 3],
}

/// Words for what loads the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoadWords {
    /// Area of contact, as the head of a column.
    pub area: &'static str,
    /// Pressure on the surface.
    pub pressure: &'static str,
    /// Bars on top of a section of the body.
    pub bars: &'static str,
    /// Mean pressure over the area in contact; `None` where none is stated.
    pub mean_pressure: Option<&'static str>,
}

const CELL: AroundWords = AroundWords {
    cell: "cell",
    heading: "Cell",
    samples: "samples of the cell",
    more_room: "",
    energy: "elastic energy of a cell",
    spots: "contact spots in the cell, joined at edges and corners of samples",
    stiffness: "stiffness dp̄/dδ, a pressure per length",
    worn: "mean",
    without_effect: &[],
    pictures: [
        [
            "Map of the contact pressure over several cells",
            "Contact pressure over several cells, true to scale; white is no contact.",
        ],
        [
            "Contact spots by level, and the radius of their boundaries over the direction",
            "Contact spots by level with their boundaries, and how far each boundary is from a circle; dashed: without the \
             mutual effect of the indenters.",
        ],
        [
            "Curves of the pressure through an indenter of each level",
            "Pressure through each level along the line of its largest extent; dashed: the same indenter alone under the \
             same load.",
        ],
    ],
};

// Far from an isolated contact there is no mean of what is worn.
const WINDOW: AroundWords = AroundWords {
    cell: "window",
    heading: "Window",
    samples: "samples of the window",
    more_room: ", a larger window",
    energy: "elastic energy",
    spots: "contact spots, joined at edges and corners of samples",
    stiffness: "stiffness dP/dδ, a force per length",
    worn: "depth",
    without_effect: &[["stress", "mean"]],
    pictures: [
        ["Map of the contact pressure in the window", "Contact pressure, true to scale; white is no contact."],
        [
            "Contact spots, and the radius of their boundaries over the direction",
            "Contact spots with their boundaries, and how far each boundary is from a circle.",
        ],
        [
            "Curves of the pressure through an indenter of each level",
            "Pressure through each level along the line of its largest extent.",
        ],
    ],
};

const CONTACT: LoadWords = LoadWords {
    area: "contact",
    pressure: "contact pressure",
    bars: "contacts",
    mean_pressure: Some("mean pressure where there is contact"),
};

const PRESSURE: LoadWords =
    LoadWords { area: "under pressure", pressure: "pressure", bars: "where the pressure acts", mean_pressure: None };

impl AroundWords {
    /// Words for what lies around a cell.
    pub fn of(surroundings: Surroundings) -> &'static Self {
        match surroundings {
            Surroundings::Periodic => &CELL,
            Surroundings::FreeSpace => &WINDOW,
        }
    }
}

impl LoadWords {
    /// Words for what loads the body in the steps of a run.
    pub fn of(steps: &[StepRecord]) -> &'static Self {
        if steps.iter().any(|step| step.kind().is_given) { &PRESSURE } else { &CONTACT }
    }
}

impl Words {
    /// Words for a kind of contact.
    pub fn of(ContactKind { surroundings, is_given }: ContactKind) -> Self {
        let extent_of = match (surroundings, is_given) {
            (Surroundings::Periodic, false) => "of the surface is in contact",
            (Surroundings::Periodic, true) => "of the surface is under pressure",
            (Surroundings::FreeSpace, false) => "is the area of contact",
            (Surroundings::FreeSpace, true) => "is the area under pressure",
        };
        let load = if is_given { &PRESSURE } else { &CONTACT };
        Self { around: AroundWords::of(surroundings), load, extent_of }
    }
}
