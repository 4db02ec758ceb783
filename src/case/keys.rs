//! The keys of a case: every table of the file, and what each of its keys is.
//!
//! The reader learns here what it accepts, what a missing key is and where a misplaced one belongs; an override, what it
//! drives out; the README, its table of sections.

/// The keys of a table: of the whole case, of a section, or of a table inside one.
#[derive(Debug)]
pub(super) struct Keys {
    /// Every key, in the order in which they are told.
    pub(super) all: &'static [Key],
    /// Keys that one may look for here, and why they have no place.
    pub(super) misplaced: &'static [(&'static str, &'static str)],
}

/// A key of a table.
#[derive(Debug)]
pub(super) struct Key {
    /// Its name.
    pub(super) name: &'static str,
    /// What it is, with unit and default.
    pub(super) what: &'static str,
    /// Kinds of table that have it, by the text of the table's first key; empty: all. Keys of other kinds exclude it.
    pub(super) kinds: &'static [&'static str],
    /// The other key in whose place it stands.
    pub(super) instead_of: Option<&'static str>,
    /// Further keys that it excludes.
    pub(super) and_of: &'static [&'static str],
    /// Keys of the table, or of each table of the list, that it holds or may hold.
    pub(super) holds: &'static Keys,
}

const fn key(name: &'static str, what: &'static str) -> Key {
    Key { name, what, kinds: &[], instead_of: None, and_of: &[], holds: &NONE }
}

impl Key {
    const fn of(self, kinds: &'static [&'static str]) -> Self {
        Self { kinds, ..self }
    }

    const fn instead_of(self, other: &'static str) -> Self {
        Self { instead_of: Some(other), ..self }
    }

    const fn holds(self, keys: &'static Keys) -> Self {
        Self { holds: keys, ..self }
    }

    const fn and_of(self, others: &'static [&'static str]) -> Self {
        Self { and_of: others, ..self }
    }

    fn excludes(&self, other: &Self) -> bool {
        let kinds = !self.kinds.is_empty() && !other.kinds.is_empty() && self.kinds != other.kinds;
        let one = |a: &Self, b: &Self| a.instead_of == Some(b.name) || a.and_of.contains(&b.name);
        kinds || one(self, other) || one(other, self)
    }
}

impl Keys {
    const fn new(all: &'static [Key]) -> Self {
        Self { all, misplaced: &[] }
    }

    /// A key by its name.
    pub(super) fn get(&self, name: &str) -> Option<&'static Key> {
        self.all.iter().find(|key| key.name == name)
    }

    /// The keys of the tables inside one of its keys; none for a key it does not know.
    pub(super) fn within(&self, name: &str) -> &'static Self {
        self.get(name).map_or(&NONE, |key| key.holds)
    }

    /// Keys that cannot stand beside this one in the table.
    pub(super) fn excluded(&self, name: &str) -> Vec<&'static str> {
        let Some(key) = self.get(name) else { return Vec::new() };
        self.all.iter().filter(|other| key.excludes(other)).map(|other| other.name).collect()
    }

    /// This table and all inside it, each with its path.
    pub(super) fn tables(&'static self, path: &str) -> Vec<(String, &'static Self)> {
        let inside = self.all.iter().flat_map(|key| match path {
            _ if key.holds.all.is_empty() => Vec::new(),
            "" => key.holds.tables(key.name),
            _ => key.holds.tables(&format!("{path}.{}", key.name)),
        });
        std::iter::once((path.to_owned(), self)).chain(inside).collect()
    }
}

/// Paths of the tables within the case that have a key.
pub(super) fn homes(name: &str) -> Vec<String> {
    let tables = CASE.tables("").into_iter().skip(1);
    tables.filter(|(_, keys)| keys.get(name).is_some()).map(|(path, _)| path).collect()
}

static NONE: Keys = Keys::new(&[]);

/// The whole case.
pub(super) static CASE: Keys = Keys::new(&[
    key("title", "what the case is, one line"),
    key("lattice", "the cell, and with it the places of the indenters").holds(&LATTICE),
    key("levels", "indenters of one shape and height, one section `[[levels]]` a level").holds(&LEVELS),
    key("surface", "one period of any topography").instead_of("levels").holds(&SURFACE),
    key("layers", "the coating, one section `[[layers]]` a layer from the surface down; none: uncoated").holds(&LAYERS),
    key("substrate", "what the coating lies on").holds(&SUBSTRATE),
    key("load", "what is prescribed, one value a load step: a number, a list or a range").holds(&LOAD),
    key("grid", "samples of the cell").holds(&GRID),
    key("solver", "how the contact problem is solved, and how far").holds(&SOLVER),
    key("friction", "the indenters slide; without the section they do not").holds(&FRICTION),
    key("units", "names for axes, tables and captions; numbers are not converted").holds(&UNITS),
    key("stress", "stresses that are wanted; without the section none").holds(&STRESS),
    key("localized", "circles of the localized method, for `compare`").holds(&LOCALIZED),
]);

static LATTICE: Keys = Keys {
    all: &[
        key("kind", "\"hexagonal\", \"square\" or \"oblique\""),
        key("period", "the distance of neighbouring indenters whatever their level").of(&["hexagonal", "square"]),
        key("a1", "a cell vector [x, y]").of(&["oblique"]),
        key("a2", "a cell vector [x, y]").of(&["oblique"]),
    ],
    misplaced: &[
        ("a1", "the cell of a hexagonal or square lattice follows from `period`"),
        ("a2", "the cell of a hexagonal or square lattice follows from `period`"),
        ("period", "the cell of an oblique lattice is given by `a1` and `a2`"),
    ],
};

static LEVELS: Keys = Keys {
    all: &[
        key("shape", "\"paraboloid\", \"sphere\", \"cone\" or \"power\""),
        key("radius", "the radius at the apex, a length greater than 0").of(&["paraboloid", "sphere"]),
        key("slope", "the slope of the flank, greater than 0").of(&["cone"]),
        key("coefficient", "c of the profile c rⁿ, greater than 0").of(&["power"]),
        key("exponent", "n of the profile c rⁿ, greater than 0").of(&["power"]),
        key("height", "protrusion of the apices, a length of which only differences matter; 0 when not given"),
        key("sites", "[[s1, s2], …] in fractions of a₁, a₂; the lattice's standard ones when not given"),
    ],
    misplaced: &[
        ("radius", "`radius` is a size of a paraboloid or a sphere"),
        ("slope", "`slope` is the size of a cone"),
        ("coefficient", "`coefficient` is a size of a power profile c rⁿ"),
        ("exponent", "`exponent` is a size of a power profile c rⁿ"),
    ],
};

static SURFACE: Keys = Keys::new(&[
    key("heights", "the path of a file, relative to the case file: `.npy`, `.csv`, `.txt`, `.dat` or `.xyz`"),
    key("scale", "factor of its heights, negative to turn them over; 1 when not given"),
    key("unit", "the unit of its heights, such as \"nm\"; needs `units.length`"),
    key("period", "lengths of the whole file along a₁ and a₂, L or [L1, L2], in place of [lattice]"),
    key("pixel", "the distance of its samples, d or [d1, d2]").instead_of("period"),
    key("level", "whether its mean plane is taken away; false when not given"),
    key("window", "tapers its border: true, \"tukey\" or \"hann\"; false when not given"),
    key("random", "a self-affine surface").instead_of("heights").holds(&RANDOM),
]);

static RANDOM: Keys = Keys::new(&[
    key("hurst", "the Hurst exponent, between 0 and 1"),
    key("shortest", "the shortest wavelength, a length"),
    key("longest", "the longest wavelength; that of the cell when not given"),
    key("rolloff", "the wavelength above which the spectrum is constant; `longest` when not given"),
    key("rms_slope", "root mean square of the slope"),
    key("rms_height", "root mean square of the heights, a length").instead_of("rms_slope"),
    key("seed", "which of all such surfaces, an integer; 0 when not given"),
]);

static LAYERS: Keys = Keys::new(&[
    key("thickness", "the thickness of the layer, a length"),
    key("shear_ratio", "χ = G/G_substrate"),
    key("young", "Young's modulus, a pressure").instead_of("shear_ratio"),
    key("poisson", "Poisson's ratio, between 0 and 0.5"),
    key("graded", "moduli, `poisson` among them, that change with depth, the layer laid out as bonded sublayers")
        .instead_of("young")
        .and_of(&["shear_ratio", "poisson"])
        .holds(&GRADED),
    key("interface", "the lower face: \"bonded\" (when not given), \"frictionless\" or a spring").holds(&SPRING),
    key("residual_stress", "equi-biaxial, a pressure, positive in tension; 0 when not given"),
    key("yield_strength", "what the stress of von Mises must not reach, a pressure"),
    key("tensile_strength", "what the largest principal stress must not reach, a pressure"),
    key("interface_strength", "what the lower face bears").holds(&INTERFACE_STRENGTH),
]);

static GRADED: Keys = Keys::new(&[
    key("shear_ratio", "χ at the upper and the lower face, [upper, lower]"),
    key("young", "Young's modulus at the upper and the lower face, [upper, lower]").instead_of("shear_ratio"),
    key("poisson", "Poisson's ratio at the upper and the lower face, [upper, lower]; linear between them"),
    key("law", "how the stiffness goes from one to the other, \"linear\" or \"exponential\"; linear without it"),
    key("sublayers", "number of sublayers, each a material of its own in the outputs; 20 without it"),
]);

static INTERFACE_STRENGTH: Keys = Keys::new(&[
    key("normal", "under tension alone, a pressure; never reached when not given"),
    key("shear", "under shear alone, a pressure; never reached when not given"),
]);

static SPRING: Keys = Keys::new(&[
    key("tangential_stiffness", "a pressure per length; rigid when not given"),
    key("normal_stiffness", "a pressure per length; rigid when not given"),
]);

static SUBSTRATE: Keys = Keys {
    all: &[
        key("young", "Young's modulus, a pressure"),
        key("poisson", "Poisson's ratio, between 0 and 0.5"),
        key("yield_strength", "what the stress of von Mises must not reach, a pressure"),
        key("tensile_strength", "what the largest principal stress must not reach, a pressure"),
    ],
    misplaced: &[("shear_ratio", "`shear_ratio` relates a layer to the substrate, whose modulus is `young`")],
};

pub(super) static LOAD: Keys = Keys::new(&[
    key("mean_pressure", "the nominal pressure p̄, same unit as Young's modulus").holds(&RANGE),
    key("penetration", "the penetration δ from first touch, a length").instead_of("mean_pressure").holds(&RANGE),
]);

static RANGE: Keys = Keys::new(&[
    key("from", "the first value"),
    key("to", "the last value"),
    key("steps", "the number of values, both ends counted"),
    key("spacing", "\"linear\" (when not given) or \"log\""),
]);

static GRID: Keys = Keys::new(&[
    key(
        "points",
        "along each cell vector, an integer or [n1, n2]; 512 when not given, with a surface those of its file",
    ),
    key("accuracy", "refine until results change by less, relatively").instead_of("points"),
]);

static SOLVER: Keys = Keys::new(&[
    key("method", "\"preconditioned\" (when not given) or \"polonsky-keer\""),
    key(
        "tolerance",
        "energy of the error below 20 times it and the elastic energy, penetration outside contact below 10 times it \
         and δ, residual ε below it; 10⁻⁸ when not given",
    ),
    key("max_iterations", "for one load step on one grid; 10000 when not given"),
]);

static FRICTION: Keys = Keys::new(&[
    key("coefficient", "μ ≥ 0: the body feels the traction μp"),
    key("direction", "in which the indenters slide, [x, y] of any length; [1, 0] when not given"),
    key("coupling", "whether the pressure follows what the traction displaces; true when not given"),
]);

static UNITS: Keys = Keys::new(&[
    key("length", "what lengths are measured in, such as \"µm\"; not named when not given"),
    key("pressure", "what pressures are measured in, such as \"GPa\"; not named when not given"),
]);

static STRESS: Keys = Keys::new(&[
    key("planes", "depths of horizontal planes, a list of lengths"),
    key("mean", "the mean lateral stress: \"confined\" (when not given) or \"half-space\""),
    key("section", "a vertical cut from one level or place toward another, or along a direction").holds(&CUT),
    key("points", "single points [[x, y, z], …]"),
    key("volume", "the field under the cell, for ParaView").holds(&VOLUME),
]);

static CUT: Keys = Keys::new(&[
    key("from", "where the cut has its origin, such as \"level 1\", or a place [x, y]"),
    key("toward", "where it runs to, such as \"level 2\", or a direction [x, y]; that of sliding when not given"),
    key("length", "its length along the surface"),
    key("behind", "how far behind the origin it begins; half the length along the sliding, else 0, when not given"),
    key("depth", "how deep it goes"),
]);

static VOLUME: Keys = Keys::new(&[
    key("depth", "how deep it goes"),
    key("rows", "intervals in depth; 40 when not given"),
    key("points", "along each cell vector; 96 when not given"),
]);

static LOCALIZED: Keys = Keys::new(&[
    key("indenters", "inside the circles, a list, one a circle; [7, 13, 37, 73] when not given"),
    key("elements", "across the largest contact; 48 when not given"),
    key(
        "radius",
        "of the circle, \"load-balanced\" (when not given) or \"area-balanced\"; or \"lattice-sum\" of all indenters \
         outside it",
    ),
    key("mutual_effect", "whether the indenters around the one looked at act on it; true when not given"),
]);

#[cfg(test)]
mod tests {
    use super::*;

    fn what(Key { what, kinds, instead_of, .. }: &Key) -> String {
        match instead_of {
            Some(other) => format!("instead of `{other}`: {what}"),
            None if kinds.is_empty() => (*what).to_owned(),
            None => format!("{}: {what}", kinds.join(", ")),
        }
    }

    /// One row a key; those of a range stand under the first key that takes one.
    fn rows(keys: &Keys, path: &str) -> String {
        let row = |(index, key): (usize, &Key)| {
            let name = format!("{path}{}", key.name);
            let told = keys.all[..index].iter().any(|before| std::ptr::eq(before.holds, key.holds));
            let inside = if told { String::new() } else { rows(key.holds, &format!("{name}.")) };
            format!("| `{name}` | {} |\n{inside}", what(key))
        };
        keys.all.iter().enumerate().map(row).collect()
    }

    #[test]
    fn the_readme_has_this_table() {
        let section = |key: &Key| format!("| **`{}`** | {} |\n{}", key.name, what(key), rows(key.holds, ""));
        let table = format!("| key | is |\n|---|---|\n{}", CASE.all.iter().map(section).collect::<String>());
        assert!(include_str!("../../README.md").contains(&table), "README.md must contain\n{table}");
    }

    #[test]
    fn a_key_is_at_home_in_every_table_that_has_it() {
        assert_eq!(homes("tolerance"), ["solver"]);
        assert_eq!(homes("points"), ["grid", "stress", "stress.volume"]);
        assert_eq!(homes("normal_stiffness"), ["layers.interface"]);
        assert!(homes("colour").is_empty());
    }

    #[test]
    fn sizes_of_one_shape_exclude_those_of_the_others() {
        assert_eq!(LEVELS.excluded("slope"), ["radius", "coefficient", "exponent"]);
        assert_eq!(LEVELS.excluded("exponent"), ["radius", "slope"]);
        assert_eq!(LATTICE.excluded("period"), ["a1", "a2"]);
        assert_eq!((CASE.excluded("levels"), CASE.excluded("surface")), (vec!["surface"], vec!["levels"]));
        assert!(LEVELS.excluded("height").is_empty() && LOCALIZED.excluded("radius").is_empty());
    }
}
