//! How much memory an analysis will need, known before it begins.
//!
//! The larger sum of what is held at two peaks: while cells get their categories, and while ground is parted into rooms.
//! Measured at 20.5 million cells with the defaults: 968 MiB for the whole process, where 1,171 are estimated.

use crate::categorization::KEPT_CELLS;
use crate::features;
use crate::raycast::border_bytes_per_cell;
use crate::spec::{AnalysisOptions, CategoryCount, ClusteringMethod};

/// What the smallest map takes: tables, and tiles at work.
const BASE_BYTES: f64 = 16.0 * 1024.0 * 1024.0;

/// Grid, both masks of the sweep, the categories, the numbers of the measured cells and their labels, for each cell.
const BYTES_PER_CELL: f64 = 16.0;

/// The same while rooms are found, with the nearest obstacles and the basins of the flood, and frames of the regions.
const ROOM_BYTES_PER_CELL: f64 = 54.0;

/// Bytes that the analysis of a map of so many cells needs at its peak, by estimate: on the safe side.
#[must_use]
pub fn analysis_bytes(cells: u64, options: &AnalysisOptions) -> u64 {
    let categorization = &options.categorization;
    let cells = cells as f64;
    let memberships = match categorization.k {
        _ if categorization.clustering == ClusteringMethod::KMeans && categorization.relaxation.is_none() => 0.0,
        CategoryCount::Fixed(count) => count as f64,
        CategoryCount::Auto => categorization.max_k as f64,
    };
    // Twice: by part and together, or before and after a step of the relaxation.
    let per_cell = BYTES_PER_CELL + border_bytes_per_cell(categorization.beams) + 2.0 * 2.0 * memberships;
    let sample =
        cells.min(KEPT_CELLS as f64) * (features::names(categorization.profile).len() * size_of::<f32>()) as f64;
    let (categorized, parted) = (cells * per_cell + 2.0 * sample, cells * ROOM_BYTES_PER_CELL + sample);
    (BASE_BYTES + categorized.max(parted)) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_site_of_the_papers_size_needs_about_a_gibibyte() {
        let options = AnalysisOptions::default();
        let mebibytes = |cells, options| analysis_bytes(cells, options) >> 20;
        assert_eq!(mebibytes(20_520_000, &options), 1_171);
        assert_eq!(mebibytes(100, &options), 16);
    }

    #[test]
    fn beams_and_memberships_take_their_share() {
        let mut options = AnalysisOptions::default();
        let plain = analysis_bytes(1_000_000, &options);
        options.categorization.beams = 3_600;
        assert!(analysis_bytes(1_000_000, &options) > 2 * plain);
        options.categorization.beams = 360;
        options.categorization.clustering = ClusteringMethod::GaussianMixture;
        assert!(analysis_bytes(1_000_000, &options) > plain);
    }
}
