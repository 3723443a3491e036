//! Every variant has its row and picture in docs/techniques.md.

use std::path::Path;
use umbrage_shadows::VARIANTS;

#[test]
fn every_variant_has_a_row_and_a_picture() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let text = std::fs::read_to_string(docs.join("techniques.md")).expect("read");
    for variant in VARIANTS {
        let link = format!("(techniques/{}.png)", variant.name);
        assert!(text.contains(&link), "{} has no row in docs/techniques.md", variant.name);
        let picture = docs.join("techniques").join(format!("{}.png", variant.name));
        assert!(picture.exists(), "{} has no picture: `cargo xtask figures`", variant.name);
    }
}

#[test]
fn names_are_unique_and_fit_commands() {
    let mut names: Vec<&str> = VARIANTS.iter().map(|v| v.name).collect();
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-.".contains(c);
    assert!(names.iter().all(|name| name.chars().all(plain)), "{names:?}");
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), VARIANTS.len());
}
