//! How much memory an analysis needs, estimated before it begins.
//!
//! The estimate is the larger of two peaks: while cells get their categories, and while the ground is divided into
//! rooms. At 20.5 million cells with the default options it is 1,171 MiB; 968 MiB were measured for the whole process.

use crate::categorization::KEPT_CELLS;
use crate::features;
use crate::raycast::border_bytes_per_cell;
use crate::spec::{AnalysisOptions, CategoryCount, ClusteringMethod};

/// Memory of the smallest map, bytes: tables, and the working memory of tiles.
const BASE_BYTES: f64 = 16.0 * 1024.0 * 1024.0;

/// Bytes per cell while cells get their categories: grid, both masks of the sweep, categories, numbers and labels of
/// the measured cells.
const BYTES_PER_CELL: f64 = 16.0;

/// Bytes per cell while rooms are found: also the nearest obstacles, the basins of the flood and the frames of the
/// regions.
const ROOM_BYTES_PER_CELL: f64 = 54.0;

/// Bytes that the analysis of a map of `cells` cells needs at its peak; the estimate is meant to be too high.
#[must_use]
pub fn analysis_bytes(cells: u64, options: &AnalysisOptions) -> u64 {
    let categorization = &options.categorization;
    let cells = cells as f64;
    let memberships = match categorization.k {
        _ if categorization.clustering == ClusteringMethod::KMeans && categorization.relaxation.is_none() => 0.0,
        CategoryCount::Fixed(count) => count as f64,
        CategoryCount::Auto => categorization.max_k as f64,
    };
    // Two copies of 16 bits: by part and together, or before and after an iteration of the relaxation.
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
