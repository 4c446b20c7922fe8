//! Relaxation of the faces of a subdivision, over its adjacency graph.
//!
//! Cost: O(links x k^2) per iteration for k categories.

use super::compatibilities::Compatibilities;
use super::distribution::{SETTLED, entropy, greatest, soften};
use super::report::RelaxationReport;
use crate::spec::RelaxationOptions;
use crate::watch::{Stopped, Watch};

/// The neighbours of each face and the length of the border with each, metres.
pub type Adjacency = Vec<Vec<(usize, f64)>>;

/// Relaxes the distributions of faces over `count` categories. A face with an empty distribution takes no part.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn relax_faces(
    distributions: &mut [Vec<f32>],
    adjacency: &Adjacency,
    count: usize,
    options: RelaxationOptions,
    watch: &Watch<'_>,
) -> Result<RelaxationReport, Stopped> {
    let categories = |distributions: &[Vec<f32>]| -> Vec<usize> {
        distributions.iter().map(|shares| greatest(shares.iter().copied())).collect()
    };
    let entropies = |distributions: &[Vec<f32>]| {
        distributions.iter().map(|shares| entropy(shares.iter().copied())).fold(0.0, |sum, one| sum + one)
    };
    let nodes = distributions.iter().filter(|shares| !shares.is_empty()).count();
    let before = categories(distributions);
    let compatibilities = co_occurrence(distributions, &before, adjacency, count);
    let mut report =
        RelaxationReport { nodes, entropy_before: entropies(distributions), ..RelaxationReport::default() };
    distributions.iter_mut().filter(|shares| !shares.is_empty()).for_each(|shares| soften(shares));
    let mut last = before.clone();
    for _ in 0..options.iterations {
        watch.check()?;
        let next: Vec<Vec<f32>> = (0..distributions.len())
            .map(|face| updated(&distributions[face], &adjacency[face], distributions, &compatibilities))
            .collect();
        let moved = distributions.iter().flatten().zip(next.iter().flatten()).map(|(old, new)| (old - new).abs());
        let moved = moved.fold(0.0, f32::max);
        distributions.clone_from_slice(&next);
        let now = categories(distributions);
        report.changed_by_iteration.push(differences(&last, &now));
        last = now;
        if moved < SETTLED {
            break;
        }
    }
    report.changed = differences(&before, &last);
    report.entropy_after = entropies(distributions) / nodes.max(1) as f64;
    report.entropy_before /= nodes.max(1) as f64;
    Ok(report)
}

fn differences(one: &[usize], other: &[usize]) -> usize {
    one.iter().zip(other).filter(|(one, other)| one != other).count()
}

/// Compatibilities from the lengths of the borders between categories.
fn co_occurrence(
    distributions: &[Vec<f32>],
    categories: &[usize],
    adjacency: &Adjacency,
    count: usize,
) -> Compatibilities {
    let mut pairs = vec![0.0; count * count];
    for (face, neighbors) in adjacency.iter().enumerate().filter(|&(face, _)| !distributions[face].is_empty()) {
        for &(neighbor, length) in neighbors.iter().filter(|&&(neighbor, _)| !distributions[neighbor].is_empty()) {
            pairs[categories[face] * count + categories[neighbor]] += length;
        }
    }
    Compatibilities::from_pairs(&pairs, count)
}

/// The distribution of a face after one iteration.
fn updated(
    shares: &[f32],
    neighbors: &[(usize, f64)],
    distributions: &[Vec<f32>],
    compatibilities: &Compatibilities,
) -> Vec<f32> {
    let mut around = vec![0.0_f32; shares.len()];
    let mut border = 0.0;
    for &(neighbor, length) in neighbors.iter().filter(|&&(neighbor, _)| !distributions[neighbor].is_empty()) {
        border += length;
        for (around, share) in around.iter_mut().zip(&distributions[neighbor]) {
            *around += length as f32 * share;
        }
    }
    if border <= 0.0 {
        return shares.to_vec();
    }
    let support = |own: usize| {
        let sum: f32 = compatibilities.row(own).iter().zip(&around).map(|(r, around)| r * around).sum();
        sum / border as f32
    };
    let raised: Vec<f32> =
        shares.iter().enumerate().map(|(own, share)| share * (1.0 + support(own)).max(0.0)).collect();
    let sum: f32 = raised.iter().sum();
    if sum > 0.0 { raised.into_iter().map(|share| share / sum).collect() } else { shares.to_vec() }
}
