//! Runs of the program that several tests read.

use std::sync::OnceLock;
use umbrage_tests::{Card, empty_folder, run, umbrage};

/// The paths of `every_variant`, as windows of its scorecard.
pub(crate) const STILL: &str = "colonnade P0";
pub(crate) const MOVING: [&str; 2] = ["colonnade P1", "colonnade P4"];

/// Every variant on the colonnade: camera still (P0), moving forward (P1), low over the floor (P4).
pub(crate) fn every_variant() -> &'static Card {
    static CARD: OnceLock<Card> = OnceLock::new();
    CARD.get_or_init(|| {
        evaluate("--path P0 --path P1 --path P4 --size 256x144 --frames 8 --seeds 4 --samples 128 --map 1024")
    })
}

/// Evaluates the colonnade with these flags.
pub(crate) fn evaluate(flags: &str) -> Card {
    let folder = empty_folder();
    let line = format!("evaluate colonnade {flags} --out run --cache cache");
    run(&mut umbrage(folder.path(), &line)).ended_with(0);
    Card::load(&folder.path().join("run"))
}
