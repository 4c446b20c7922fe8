//! Features part by part: a sample for the clustering, then the label of every cell.
//!
//! The features of all cells of a large site would fill a gigabyte, so they never exist together: each part is
//! measured, labelled and dropped. The parts of the sample are kept until they are labelled, so nothing is measured
//! twice; a map of up to [`KEPT_CELLS`] is its own sample.

use std::ops::Range;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

use crate::clustering::PlaceModel;
use crate::features::{CellFeatures, FeatureSource, Workspace};
use crate::relaxation::Memberships;
use crate::watch::{Stage, Stopped, Watch};

/// Cells whose features are kept for the clustering: 104 MB, from more than a hundred parts all over the map.
pub(crate) const KEPT_CELLS: usize = 2_000_000;

/// Share of `cells` free cells that the sample holds; 1 where it holds them all.
pub(crate) fn sampled_share(cells: usize) -> f64 {
    (KEPT_CELLS as f64 / cells.max(1) as f64).min(1.0)
}

/// The features of some parts, drawn at random, or of all.
pub(super) struct Sample {
    /// By part, its cells and the range of their values in `rows`; `None` for the parts that were not drawn.
    parts: Vec<Option<(Vec<u32>, Range<usize>)>>,
    rows: Vec<f32>,
}

impl Sample {
    /// Draws as many parts as hold [`KEPT_CELLS`] of `cells` cells on average, and measures them.
    pub(super) fn measure(
        source: &FeatureSource<'_>,
        cells: usize,
        seed: u64,
        watch: &Watch<'_>,
    ) -> Result<Self, Stopped> {
        let sample = Self::of(source, draw(source.parts(), sampled_share(cells), seed), watch)?;
        // All drawn parts may be empty.
        if sample.rows.is_empty() { Self::of(source, (0..source.parts()).collect(), watch) } else { Ok(sample) }
    }

    /// Measures the drawn parts.
    fn of(source: &FeatureSource<'_>, drawn: Vec<usize>, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let steps = watch.steps(Stage::Features, drawn.len());
        let measured: Result<Vec<CellFeatures>, Stopped> = drawn
            .par_iter()
            .map_init(Workspace::default, |workspace, &part| {
                let features = source.part(part, workspace, watch)?;
                steps.count_one();
                Ok(features)
            })
            .collect();
        let mut sample = Self { parts: (0..source.parts()).map(|_| None).collect(), rows: Vec::new() };
        for (part, features) in drawn.into_iter().zip(measured?) {
            let start = sample.rows.len();
            sample.rows.extend_from_slice(&features.values);
            sample.parts[part] = Some((features.cells, start..sample.rows.len()));
        }
        Ok(sample)
    }

    /// The features, row by row.
    pub(super) fn rows(&self) -> &[f32] {
        &self.rows
    }
}

/// A share of the parts, ascending; all of them where the share is one or more.
fn draw(parts: usize, share: f64, seed: u64) -> Vec<usize> {
    let wanted = ((parts as f64 * share).ceil() as usize).min(parts);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut order: Vec<usize> = (0..parts).collect();
    for place in 0..wanted {
        let other = place + (random.next_u64() % (parts - place) as u64) as usize;
        order.swap(place, other);
    }
    order.truncate(wanted);
    order.sort_unstable();
    order
}

/// The labels of the cells of a part, and what they add to the description of the categories.
pub(super) struct PartLabels {
    pub(super) cells: Vec<u32>,
    pub(super) labels: Vec<u8>,
    /// Packed memberships, where they are asked for: one for each cell and category.
    pub(super) shares: Vec<u16>,
    /// Cells of each category.
    pub(super) counts: Vec<usize>,
    /// Sums of the features of each category, one row per category.
    pub(super) sums: Vec<f64>,
}

/// Gives the cells of every part their labels, and their memberships where they are asked for.
pub(super) fn assign_parts(
    source: &FeatureSource<'_>,
    sample: Sample,
    model: &PlaceModel,
    is_graded: bool,
    watch: &Watch<'_>,
) -> Result<Vec<PartLabels>, Stopped> {
    let Sample { parts, rows } = sample;
    let steps = watch.steps(Stage::Categorization, parts.len());
    parts
        .into_par_iter()
        .enumerate()
        .map_init(Workspace::default, |workspace, (part, kept)| {
            watch.check()?;
            let labels = if let Some((cells, range)) = kept {
                label(cells, &rows[range], model, is_graded)
            } else {
                let CellFeatures { cells, values, .. } = source.part(part, workspace, watch)?;
                label(cells, &values, model, is_graded)
            };
            steps.count_one();
            Ok(labels)
        })
        .collect()
}

/// Labels the cells of a part.
fn label(cells: Vec<u32>, rows: &[f32], model: &PlaceModel, is_graded: bool) -> PartLabels {
    let mut labels = vec![0; cells.len()];
    let mut shares = Vec::new();
    if is_graded {
        let mut distributions = vec![0.0; cells.len() * model.len()];
        model.memberships(rows, &mut labels, &mut distributions);
        shares = vec![0; distributions.len()];
        Memberships::pack(&distributions, &mut shares);
    } else {
        model.assign(rows, &mut labels);
    }
    let columns = model.columns();
    let (mut counts, mut sums) = (vec![0; model.len()], vec![0.0; model.len() * columns]);
    for (row, &label) in rows.chunks_exact(columns).zip(&labels) {
        let label = usize::from(label);
        counts[label] += 1;
        let sums: &mut [f64] = &mut sums[label * columns..(label + 1) * columns];
        sums.iter_mut().zip(row).for_each(|(sum, &value)| *sum += f64::from(value));
    }
    PartLabels { cells, labels, shares, counts, sums }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_of_the_parts_is_drawn_and_the_seed_decides_which() {
        assert_eq!(draw(5, 3.0, 1), [0, 1, 2, 3, 4]);
        assert_eq!(draw(0, 3.0, 1), [0; 0]);
        let drawn = draw(1_000, 0.1, 1);
        assert_eq!(drawn.len(), 100);
        assert!(drawn.is_sorted_by(|a, b| a < b));
        assert_eq!(drawn, draw(1_000, 0.1, 1));
        assert_ne!(drawn, draw(1_000, 0.1, 2));
    }
}
