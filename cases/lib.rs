//! The example cases of percoat, by name: each is a file of this folder.

/// Name and text of every case, in the order of names.
pub const CASES: [(&str, &str); 19] = [
    ("ball-on-disc", include_str!("ball-on-disc.toml")),
    ("dlc-on-steel", include_str!("dlc-on-steel.toml")),
    ("fig2", include_str!("fig2.toml")),
    ("fig3a", include_str!("fig3a.toml")),
    ("fig3b", include_str!("fig3b.toml")),
    ("fig4", include_str!("fig4.toml")),
    ("fig5", include_str!("fig5.toml")),
    ("fig6a", include_str!("fig6a.toml")),
    ("fig6b", include_str!("fig6b.toml")),
    ("fig7", include_str!("fig7.toml")),
    ("pavement", include_str!("pavement.toml")),
    ("polymer-on-steel", include_str!("polymer-on-steel.toml")),
    ("ring", include_str!("ring.toml")),
    ("rough", include_str!("rough.toml")),
    ("rough-metal", include_str!("rough-metal.toml")),
    ("running-in", include_str!("running-in.toml")),
    ("scratch", include_str!("scratch.toml")),
    ("tin-fatigue", include_str!("tin-fatigue.toml")),
    ("tin-on-steel", include_str!("tin-on-steel.toml")),
];
