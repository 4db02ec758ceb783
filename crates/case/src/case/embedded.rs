//! Example cases that are embedded in the program.

use super::Source;

/// Name of the case that runs when none is given.
pub const DEFAULT: &str = "fig2";

const CASES: [(&str, &str); 26] = [
    ("afm-pull-off", include_str!("../../../../cases/afm-pull-off.toml")),
    ("ball-on-disc", include_str!("../../../../cases/ball-on-disc.toml")),
    ("dlc-on-steel", include_str!("../../../../cases/dlc-on-steel.toml")),
    ("fig2", include_str!("../../../../cases/fig2.toml")),
    ("fig3a", include_str!("../../../../cases/fig3a.toml")),
    ("fig3b", include_str!("../../../../cases/fig3b.toml")),
    ("fig4", include_str!("../../../../cases/fig4.toml")),
    ("fig5", include_str!("../../../../cases/fig5.toml")),
    ("fig6a", include_str!("../../../../cases/fig6a.toml")),
    ("fig6b", include_str!("../../../../cases/fig6b.toml")),
    ("fig7", include_str!("../../../../cases/fig7.toml")),
    ("fretting", include_str!("../../../../cases/fretting.toml")),
    ("pavement", include_str!("../../../../cases/pavement.toml")),
    ("pin-on-disc-hot", include_str!("../../../../cases/pin-on-disc-hot.toml")),
    ("polymer-on-steel", include_str!("../../../../cases/polymer-on-steel.toml")),
    ("ring", include_str!("../../../../cases/ring.toml")),
    ("rolling", include_str!("../../../../cases/rolling.toml")),
    ("rough", include_str!("../../../../cases/rough.toml")),
    ("rough-metal", include_str!("../../../../cases/rough-metal.toml")),
    ("rubber-creep", include_str!("../../../../cases/rubber-creep.toml")),
    ("rubber-sliding", include_str!("../../../../cases/rubber-sliding.toml")),
    ("running-in", include_str!("../../../../cases/running-in.toml")),
    ("scratch", include_str!("../../../../cases/scratch.toml")),
    ("textured", include_str!("../../../../cases/textured.toml")),
    ("tin-fatigue", include_str!("../../../../cases/tin-fatigue.toml")),
    ("tin-on-steel", include_str!("../../../../cases/tin-on-steel.toml")),
];

/// Name and text of every embedded case.
pub fn all() -> &'static [(&'static str, &'static str)] {
    &CASES
}

/// An embedded case as a source; `None` for an unknown name.
pub fn source(name: &str) -> Option<Source> {
    let (_, text) = CASES.iter().find(|(known, _)| *known == name)?;
    Some(Source { name: format!("embedded case {name}"), text: (*text).to_owned(), ..Source::default() })
}
