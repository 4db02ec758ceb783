//! The pictures of a run: which, of what size, and what stands in them.

use crate::program::{Desk, Folder};
use std::collections::BTreeSet;

/// A case of two steps with stresses in a section, on a small grid.
const ARGUMENTS: [&str; 7] =
    ["fig6b", "--set", "grid.points=48", "--set", "load.mean_pressure=[0.002, 0.02]", "--set", "lattice.period=0.5"];
/// Pictures, and their columns of 85 mm.
const PICTURES: [(&str, u32); 6] =
    [("contact", 2), ("curve", 2), ("lines", 2), ("pressure", 1), ("profiles", 1), ("section", 2)];

fn pictures(folder: &Folder) -> BTreeSet<String> {
    folder.names().into_iter().filter(|name| name.ends_with(".png") || name.ends_with(".svg")).collect()
}

fn named(ending: &str) -> BTreeSet<String> {
    PICTURES.iter().map(|(name, _)| format!("{name}.{ending}")).collect()
}

#[test]
fn a_run_leaves_pictures_one_or_two_columns_wide_in_both_formats_without_being_asked_and_they_go_when_none_are_wanted()
{
    let desk = Desk::new();
    let folder = desk.solve("run", &ARGUMENTS);
    assert_eq!(pictures(&folder), &named("png") | &named("svg"));
    for (name, columns) in PICTURES {
        let picture = folder.bytes(&format!("{name}.png"));
        assert_eq!(&picture[..8], b"\x89PNG\r\n\x1a\n", "{name}");
        let number = |at: usize| u32::from_be_bytes(picture[at..at + 4].try_into().unwrap());
        let [width, height] = [number(16), number(20)];
        // 85 mm at 300 dots per inch.
        assert!(width.abs_diff(1004 * columns) < 3, "{name}: {width} pixels wide");
        assert!((400..4000).contains(&height), "{name}: {height} pixels high");
    }
    desk.write("run/my own.png", "not of a run");
    let folder = desk.solve("run", &[&ARGUMENTS[..], &["--no-pictures"]].concat());
    assert_eq!(pictures(&folder), BTreeSet::from(["my own.png".to_owned()]));
}

#[test]
fn svg_pictures_hold_the_words_of_their_axes_and_captions() {
    let desk = Desk::new();
    let folder = desk.solve("run", &[&ARGUMENTS[..], &["--pictures", "svg"]].concat());
    assert_eq!(pictures(&folder), named("svg"));
    let expected: [(&str, &[&str]); 6] = [
        ("pressure", &["contact pressure p/E₂", "x/r₁", "y/r₁", "χ", "<image"]),
        ("contact", &["x/r₁", "direction θ (degrees)", "level 1"]),
        ("profiles", &["contact pressure p/E₂", "distance from the axis s/r₁", "level 1"]),
        ("curve", &["mean pressure p̄/E₂", "peak pressure p/E₂", "penetration δ/r₁"]),
        ("section", &["depth z/r₁", "σₛ/E₂", "τ₁/E₂"]),
        ("lines", &["principal shear stress τ₁/E₂", "interface, coating", "interface, substrate"]),
    ];
    for (name, words) in expected {
        let text = folder.text(&format!("{name}.svg"));
        for word in words {
            assert!(text.contains(word), "\"{word}\" does not stand in {name}.svg");
        }
        assert_well_formed(&text);
        assert!(!text.contains("=\"NaN") && !text.contains("=\"inf"), "{name}.svg has a place that is no number");
    }
}

#[test]
fn a_load_without_contact_and_merged_contacts_are_drawn_too() {
    let desk = Desk::new();
    let open = desk.solve("open", &["fig2", "--set", "grid.points=32", "--set", "load={ penetration = 0.0 }"]);
    assert!(!pictures(&open).contains("pressure.png"));
    let sets = ["--set", "grid.points=32", "--set", "load.mean_pressure=0.6"];
    let merged = desk.solve("merged", &[&["fig2", "--pictures", "png,svg"], &sets[..]].concat());
    assert!(["pressure.png", "contact.png", "profiles.png"].iter().all(|&name| pictures(&merged).contains(name)));
}

#[test]
fn a_word_for_a_format_that_does_not_exist_is_refused() {
    Desk::new().percoat(&["solve", "--pictures", "jpeg"]).complains(2, &["jpeg", "png", "svg"]);
}

/// Every element that is opened is closed, in order.
fn assert_well_formed(text: &str) {
    let mut open = Vec::new();
    for tag in text.split('<').skip(1) {
        let (tag, _) = tag.split_once('>').expect("a tag ends");
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name)),
            None if tag.ends_with('/') => {}
            None => open.push(tag.split_whitespace().next().unwrap()),
        }
    }
    assert!(open.is_empty(), "{open:?} stays open");
}
