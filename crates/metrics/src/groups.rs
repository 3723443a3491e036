//! Which rows of a table cannot be told apart: a compact letter display.
//!
//! Every pair is tested by its paired difference (t-test with the bootstrap's standard error), with
//! Holm's correction over the pairs at 5 %; the letters are made by insertion and absorption
//! (Piepho, *An Algorithm for a Letter-Based Representation of All-Pairwise Comparisons*, JCGS 2004).

use crate::interval::{CONFIDENCE, Estimate};
use crate::paired::paired_estimate;
use crate::{Bootstrap, MetricsError, Quantity, Score, TileTable};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Letters of each variant, in the order given; two variants that share a letter cannot be told
/// apart. "a" goes to the smallest value. Empty where the quantity was not measured.
///
/// # Errors
/// Tables that were not made from the same tiles, points and frames.
pub fn group_letters(
    variants: &[Vec<&TileTable>],
    what: Quantity,
    bootstrap: &Bootstrap,
) -> Result<Vec<String>, MetricsError> {
    Ok(compare_all(variants, what, bootstrap)?.letters)
}

/// All pairs of a table: their differences, which of them are real, and the letters that follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparisons {
    /// As [`group_letters`] gives them.
    pub letters: Vec<String>,
    /// First and second variant, first minus second, and whether they can be told apart after
    /// Holm's correction: the same decision that the letters show.
    pub pairs: Vec<(usize, usize, Score, bool)>,
}

/// Compares every two variants in one quantity.
///
/// # Errors
/// As [`group_letters`].
pub fn compare_all(
    variants: &[Vec<&TileTable>],
    what: Quantity,
    bootstrap: &Bootstrap,
) -> Result<Comparisons, MetricsError> {
    let measured: Vec<usize> =
        (0..variants.len()).filter(|&v| what.missing(&variants[v]).is_none()).collect();
    let (mut tests, mut differences) = (Vec::new(), Vec::new());
    // Values relative to the first: enough to rank by.
    let mut rank = vec![0.0; measured.len()];
    for (i, &a) in measured.iter().enumerate() {
        for (j, &b) in measured.iter().enumerate().skip(i + 1) {
            if let Ok(estimate) = paired_estimate(&variants[a], &variants[b], what, bootstrap)? {
                tests.push((p_value(&estimate), i, j));
                differences.push((i, j, estimate.score));
                if i == 0 {
                    rank[j] = -estimate.score.value;
                }
            }
        }
    }
    let different = holm(tests);
    let real = |i, j| different.contains(&(i, j));
    let pairs = differences.into_iter().map(|(i, j, score)| (measured[i], measured[j], score, real(i, j)));
    let pairs = pairs.collect();
    let letters = letters(&rank, letter_groups(measured.len(), &different));
    let mut all = vec![String::new(); variants.len()];
    measured.into_iter().zip(letters).for_each(|(variant, letters)| all[variant] = letters);
    Ok(Comparisons { letters: all, pairs })
}

/// Two-sided, for "the difference is 0".
fn p_value(estimate: &Estimate) -> f64 {
    if estimate.score.value == 0.0 {
        return 1.0;
    }
    let t = estimate.score.value.abs() / estimate.standard_error;
    let Ok(distribution) = StudentsT::new(0.0, 1.0, estimate.freedom.max(1) as f64) else { return 1.0 };
    2.0 * distribution.sf(t)
}

/// The pairs that differ, after Holm's step-down correction.
fn holm(mut tests: Vec<(f64, usize, usize)>) -> Vec<(usize, usize)> {
    tests.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = tests.len();
    let passes =
        |&(rank, (p, ..)): &(usize, &(f64, usize, usize))| *p <= (1.0 - CONFIDENCE) / (count - rank) as f64;
    tests.iter().enumerate().take_while(passes).map(|(_, &(_, i, j))| (i, j)).collect()
}

/// Maximal sets of members of which no two differ.
fn letter_groups(members: usize, different: &[(usize, usize)]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = vec![(0..members).collect()];
    for &(i, j) in different {
        let (split, mut kept): (Vec<_>, Vec<_>) =
            groups.into_iter().partition(|g| g.contains(&i) && g.contains(&j));
        for leaving in split.iter().flat_map(|group| [(group, i), (group, j)]) {
            let rest: Vec<usize> = leaving.0.iter().copied().filter(|&m| m != leaving.1).collect();
            if !kept.iter().any(|g| rest.iter().all(|m| g.contains(m))) {
                kept.retain(|g| !g.iter().all(|m| rest.contains(m)));
                kept.push(rest);
            }
        }
        groups = kept;
    }
    groups
}

fn letters(rank: &[f64], mut groups: Vec<Vec<usize>>) -> Vec<String> {
    let extremes = |group: &Vec<usize>| {
        group.iter().fold((f64::MAX, f64::MAX), |(low, high), &m| (low.min(rank[m]), high.min(-rank[m])))
    };
    groups.sort_by(|a, b| {
        let (a, b) = (extremes(a), extremes(b));
        a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1))
    });
    let name = |member: usize| {
        let of = groups.iter().enumerate().filter(|(_, g)| g.contains(&member));
        of.map(|(index, _)| char::from(b'a' + (index % 26) as u8)).collect()
    };
    (0..rank.len()).map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_that_differ_never_share_a_letter_and_others_do() {
        // 0 < 1 < 2 < 3, neighbours cannot be told apart, the rest can.
        let different = [(0, 2), (0, 3), (1, 3)];
        let letters = letters(&[0.0, 1.0, 2.0, 3.0], letter_groups(4, &different));
        assert_eq!(letters, ["a", "ab", "bc", "c"]);
    }

    #[test]
    fn all_alike_share_one_letter_and_all_different_share_none() {
        assert_eq!(letters(&[0.0; 3], letter_groups(3, &[])), ["a", "a", "a"]);
        let different = [(0, 1), (0, 2), (1, 2)];
        assert_eq!(letters(&[2.0, 0.0, 1.0], letter_groups(3, &different)), ["c", "a", "b"]);
    }

    #[test]
    fn holm_stops_at_the_first_pair_that_does_not_differ() {
        // Limits are .05/3, .05/2, .05: the second fails, so the third may not pass any more.
        assert_eq!(holm(vec![(0.04, 0, 1), (0.03, 0, 2), (0.001, 1, 2)]), [(1, 2)]);
    }
}
