//! Which frames are scored together: those that follow each other by one step.

use std::collections::BTreeMap;
use std::ops::Range;

/// Windows of one length, as places in the list of numbers.
pub(super) struct Windows {
    pub(super) places: Vec<Range<usize>>,
    /// Frames in each.
    pub(super) length: usize,
    /// Numbers from a frame to the next.
    pub(super) step: u32,
    /// What a reader must know.
    pub(super) notes: Vec<String>,
}

/// Gaps that a note lists.
const LISTED: usize = 8;

/// Divides ascending numbers into windows of at most `longest` frames. None spans a gap: what moved meanwhile
/// nobody saw. From the middle of each stretch, as of paths of our own.
pub(super) fn windows(numbers: &[u32], longest: usize) -> Windows {
    let steps: Vec<u32> = numbers.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
    steps.iter().for_each(|&step| *counts.entry(step).or_default() += 1);
    // On ties the smallest.
    let usual = counts.iter().rev().max_by_key(|(_, count)| **count).map_or(1, |(&step, _)| step);
    if 2 * counts.get(&usual).copied().unwrap_or(0) < steps.len() {
        let notes =
            vec!["the frames' numbers follow no step: each is scored by itself, without swimming".into()];
        return Windows { places: (0..numbers.len()).map(|i| i..i + 1).collect(), length: 1, step: 1, notes };
    }
    let gaps: Vec<usize> = (0..steps.len()).filter(|&i| steps[i] != usual).collect();
    let ends = gaps.iter().map(|i| i + 1).chain([numbers.len()]);
    let mut stretches: Vec<Range<usize>> = Vec::new();
    for end in ends {
        let start = stretches.last().map_or(0, |s| s.end);
        stretches.push(start..end);
    }
    let length = stretches.iter().map(Range::len).max().unwrap_or(0).min(longest).max(1);
    let places: Vec<Range<usize>> = stretches.iter().flat_map(|stretch| within(stretch, length)).collect();
    let mut notes = Vec::new();
    if usual > 1 {
        notes.push(format!("the frames' numbers go by {usual}: swimming is over {usual} frames' motion"));
    }
    if !gaps.is_empty() {
        let after: Vec<String> = gaps.iter().take(LISTED).map(|&i| numbers[i].to_string()).collect();
        let more = if gaps.len() > LISTED { " and others" } else { "" };
        notes.push(format!("frames are missing after {}{more}: no window spans a gap", after.join(", ")));
    }
    let left = numbers.len() - places.len() * length;
    if left > 0 {
        notes.push(format!("{left} frames do not fill a window of {length} and are not scored"));
    }
    Windows { places, length, step: usual, notes }
}

fn within(stretch: &Range<usize>, length: usize) -> impl Iterator<Item = Range<usize>> {
    let count = stretch.len() / length;
    let start = stretch.start + (stretch.len() - count * length) / 2;
    (0..count).map(move |i| start + i * length..start + (i + 1) * length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_window_spans_a_gap() {
        let plain: Vec<u32> = (5..45).collect();
        let whole = windows(&plain, 16);
        assert_eq!((whole.places, whole.length, whole.step), (vec![4..20, 20..36], 16, 1));
        assert_eq!(whole.notes, ["8 frames do not fill a window of 16 and are not scored"]);

        let torn: Vec<u32> = (0..6).chain(10..20).chain([30]).collect();
        let torn = windows(&torn, 4);
        assert_eq!((torn.places, torn.step), (vec![1..5, 7..11, 11..15], 1));
        assert_eq!(torn.notes[0], "frames are missing after 5, 19: no window spans a gap");

        let thin: Vec<u32> = (0..8).map(|i| 3 * i).collect();
        let thin = windows(&thin, 16);
        assert_eq!((thin.places.first(), thin.places.len(), thin.step), (Some(&(0..8)), 1, 3));
        assert!(thin.notes[0].contains("go by 3"), "{:?}", thin.notes);

        let wild = windows(&[0, 5, 11, 18], 16);
        assert_eq!((wild.places.len(), wild.length, wild.step), (4, 1, 1));
        assert!(wild.notes[0].contains("follow no step"), "{:?}", wild.notes);

        let one = windows(&[7], 16);
        assert_eq!((one.places.first(), one.places.len(), one.notes.len()), (Some(&(0..1)), 1, 0));
    }
}
