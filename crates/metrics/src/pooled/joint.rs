//! Comparisons of any number of subjects, resampled together where they were seen from the same place.

use super::{PooledNumber, SumTable};
use crate::{Bootstrap, MetricsError, Score};
use std::collections::{BTreeMap, BTreeSet};

/// A number of some windows.
#[derive(Clone, Debug)]
pub struct Member<'a> {
    /// Which.
    pub number: PooledNumber,
    /// The windows, each with its ground: windows of equal ground see the same tiles and are
    /// resampled together, others independently.
    pub windows: Vec<(usize, &'a SumTable)>,
}

/// Place of a cluster of tiles.
type Place = (u32, u32);

/// A member's window in clusters.
struct Clustered {
    ground: usize,
    /// By index of the ground's clusters.
    sums: Vec<Vec<f64>>,
}

/// Numbers made of the members' numbers, each with its interval. `statistic` gets one value a member.
///
/// # Errors
/// A member without windows, or without a tile that says anything.
pub fn compare_jointly(
    members: &[Member<'_>],
    statistic: impl Fn(&[f64]) -> Vec<f64> + Sync,
    bootstrap: &Bootstrap,
) -> Result<Vec<Score>, MetricsError> {
    let grounds = grounds(members, bootstrap.cluster_tiles);
    let counts: Vec<usize> = grounds.values().map(BTreeSet::len).collect();
    if members.iter().any(|m| m.windows.is_empty()) || counts.contains(&0) {
        return Err(MetricsError::Zero("the number of tiles that say anything"));
    }
    let classes: Vec<Vec<usize>> = members
        .iter()
        .map(|m| m.number.classes(&m.windows.iter().map(|w| w.1).collect::<Vec<_>>()))
        .collect();
    let clustered: Vec<Vec<Clustered>> =
        members.iter().map(|m| clusters_of(m, &grounds, bootstrap.cluster_tiles)).collect();
    let of = |weights: &[Vec<u32>]| {
        let value = |((member, windows), classes): ((&Member<'_>, &Vec<Clustered>), &Vec<usize>)| {
            let sums: Vec<Vec<f64>> = windows.iter().map(|w| w.weighted(weights)).collect();
            member.number.value(&sums, classes)
        };
        let values: Vec<f64> = members.iter().zip(&clustered).zip(&classes).map(value).collect();
        statistic(&values)
    };
    Ok(bootstrap.estimate_weighted(&counts, of).into_iter().map(|e| e.score).collect())
}

/// The clusters of each ground in which some member sees something.
fn grounds(members: &[Member<'_>], side: u32) -> BTreeMap<usize, BTreeSet<Place>> {
    let mut grounds: BTreeMap<usize, BTreeSet<Place>> = BTreeMap::new();
    for member in members {
        for &(ground, table) in &member.windows {
            let places = grounds.entry(ground).or_default();
            let seen = table.rows.iter().filter(|(.., sums)| member.number.is_seen(sums));
            places.extend(seen.map(|&(column, row, _)| place(column, row, side)));
        }
    }
    grounds
}

fn place(column: u32, row: u32, side: u32) -> Place {
    (row / side.max(1), column / side.max(1))
}

fn clusters_of(member: &Member<'_>, grounds: &BTreeMap<usize, BTreeSet<Place>>, side: u32) -> Vec<Clustered> {
    let order: Vec<usize> = grounds.keys().copied().collect();
    let clustered = |&(ground, table): &(usize, &SumTable)| {
        let index: BTreeMap<Place, usize> =
            grounds[&ground].iter().enumerate().map(|(i, &place)| (place, i)).collect();
        let width = table.rows.first().map_or(0, |(.., sums)| sums.len());
        let mut sums = vec![vec![0.0; width]; index.len()];
        for (column, row, values) in &table.rows {
            if let Some(&at) = index.get(&place(*column, *row, side)) {
                sums[at].iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
            }
        }
        let ground = order.iter().position(|&g| g == ground).unwrap_or_default();
        Clustered { ground, sums }
    };
    member.windows.iter().map(clustered).collect()
}

impl Clustered {
    /// The sums when each cluster of each ground counts so many times.
    fn weighted(&self, weights: &[Vec<u32>]) -> Vec<f64> {
        let mut total = vec![0.0; self.sums.first().map_or(0, Vec::len)];
        for (sums, &weight) in self.sums.iter().zip(&weights[self.ground]).filter(|&(_, &w)| w > 0) {
            total.iter_mut().zip(sums).for_each(|(t, s)| *t += f64::from(weight) * s);
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pooled::against;

    /// Tiles in a row, each with `points` points of squared difference `squared`.
    fn table(squared: &[f64]) -> SumTable {
        let row = |(i, &s): (usize, &f64)| (2 * i as u32, 0, vec![100.0, 100.0 * s, 0.0, 0.0]);
        let table = SumTable { rows: squared.iter().enumerate().map(row).collect() };
        assert!((against::squared(&table.rows[0].2) - squared[0]).abs() < 1e-15);
        table
    }

    fn ratio(a: &SumTable, b: (usize, &SumTable)) -> Score {
        let member = |window| Member { number: PooledNumber::Departure, windows: vec![window] };
        let members = [member((0, a)), member(b)];
        compare_jointly(&members, |v| vec![v[0] / v[1] - 1.0], &Bootstrap::default()).expect("compared")[0]
    }

    #[test]
    fn what_is_wrong_alike_cancels_on_the_same_ground_only() {
        let a = table(&[4.0, 16.0, 1.0, 64.0, 9.0]);
        let b = table(&[1.0, 4.0, 0.25, 16.0, 2.25]);
        let paired = ratio(&a, (0, &b));
        // A is twice B in every tile: so it is in every resample, to rounding.
        assert!((paired.low - 1.0).abs() < 1e-12 && (paired.high - 1.0).abs() < 1e-12, "{paired:?}");
        let unpaired = ratio(&a, (1, &b));
        assert!((unpaired.value - 1.0).abs() < 1e-12 && unpaired.high - unpaired.low > 0.5, "{unpaired:?}");
    }

    #[test]
    fn nothing_seen_is_an_error() {
        let blind = SumTable { rows: vec![(0, 0, vec![0.0; 4])] };
        let member = Member { number: PooledNumber::Departure, windows: vec![(0, &blind)] };
        assert!(compare_jointly(&[member], <[f64]>::to_vec, &Bootstrap::default()).is_err());
    }
}
