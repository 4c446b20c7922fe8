//! How many regions a map has, by the Gabor method: clusters of texture that agree in orientation are one pattern.
//!
//! The paper leaves the number of clusters to the user. Texture alone does not give it: k-means splits any map, and
//! tiles differ most in how full they are. Regions serve to keep the lines of one orientation out of blocks of another
//! (II-D), so clusters count as different only if their dominant orientations are. For each number of clusters the
//! radiogram energy of each cluster is scanned; clusters without an orientation are left to their neighbours; clusters
//! that agree are merged. The number that leaves most patterns is taken, the one of greater sharpness in a tie.
//!
//! Orientations are compared as pairs (a direction and its perpendicular). Cost: O(k (sample x angles)) for each number
//! k of clusters. Limits: two blocks of the same orientation and different pitch are one region.

use super::tiles::{NONE, Tiles};
use crate::orientation::energy::{EnergyScan, OccupiedSample, pair_angle_between};
use crate::watch::{Stopped, Watch};

/// Occupied cells sampled of the whole map: enough for a scan of each cluster, and cheap.
pub(super) const SAMPLE_CELLS: usize = 60_000;
/// Fewest sampled cells of a pattern (accuracy study: 60 per window).
const MIN_CELLS: usize = 60;
/// Least contrast of a pattern's orientation, as a share of the mean energy: below 0.1 for scattered points, above 1
/// for blocks of racks.
const MIN_RELATIVE_CONTRAST: f64 = 0.3;
/// Orientations that differ by less are the same (modulo a quarter turn), degrees.
/// No measurement is recorded for this value.
const AGREEMENT_DEG: f64 = 2.0;
/// Two patterns are one if in either of them the other's orientation has at least this share of the contrast of its
/// own.
const SHARED_CONTRAST: f64 = 0.5;

/// A division of the tiles into patterns of different orientations.
pub(super) struct Division {
    /// Pattern of each tile; [`NONE`] where a cluster has no orientation of its own.
    pub labels: Vec<u8>,
    /// Number of patterns.
    pub count: usize,
    /// Sum over the patterns of contrast times sampled cells.
    pub sharpness: f64,
}

/// Clusters that are one pattern, and the energy of their cells by direction.
struct Pattern {
    clusters: Vec<u8>,
    sample: OccupiedSample,
    scan: EnergyScan,
}

impl Pattern {
    fn new(clusters: Vec<u8>, sample: OccupiedSample, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let scan = EnergyScan::new(&sample, watch)?;
        Ok(Self { clusters, sample, scan })
    }

    /// The strongest orientation pair.
    fn angle(&self) -> Option<f64> {
        let enough = self.sample.len() >= MIN_CELLS;
        let angle = self.scan.pair_peaks(1.0).first().copied().filter(|_| enough)?;
        let stands_out = self.scan.pair_contrast_near(angle) >= MIN_RELATIVE_CONTRAST * self.scan.mean_energy();
        stands_out.then_some(angle)
    }

    /// Whether another pattern's orientation stands out here as well.
    fn shows(&self, own: f64, other: f64) -> bool {
        self.scan.pair_contrast_near(other) >= SHARED_CONTRAST * self.scan.pair_contrast_near(own)
    }

    fn agrees_with(&self, other: &Self) -> bool {
        match (self.angle(), other.angle()) {
            (Some(one), Some(two)) => {
                pair_angle_between(one, two) <= AGREEMENT_DEG.to_radians()
                    || self.shows(one, two)
                    || other.shows(two, one)
            }
            _ => false,
        }
    }
}

/// Merges the `count` clusters of the tiles into patterns.
pub(super) fn divide(
    tiles: &Tiles,
    clusters: &[u8],
    count: usize,
    sample: &OccupiedSample,
    watch: &Watch<'_>,
) -> Result<Division, Stopped> {
    let cluster_of = |column: usize, row: usize| {
        let cluster = clusters[tiles.of_cell(column, row)];
        (cluster != NONE).then_some(usize::from(cluster))
    };
    let mut patterns = Vec::new();
    for (cluster, sample) in sample.split(count, cluster_of).into_iter().enumerate() {
        patterns.push(Pattern::new(vec![cluster as u8], sample, watch)?);
    }
    patterns.retain(|pattern| pattern.angle().is_some());
    while let Some((first, second)) = agreeing(&patterns) {
        let second = patterns.remove(second);
        let first = patterns.remove(first);
        let mut merged = first.sample;
        merged.append(&second.sample);
        patterns.push(Pattern::new([first.clusters, second.clusters].concat(), merged, watch)?);
        patterns.retain(|pattern| pattern.angle().is_some());
    }
    let mut pattern_of = [NONE; NONE as usize + 1];
    for (index, pattern) in patterns.iter().enumerate() {
        for &cluster in &pattern.clusters {
            pattern_of[usize::from(cluster)] = index as u8;
        }
    }
    let labels = clusters.iter().map(|&cluster| pattern_of[usize::from(cluster)]).collect();
    let sharpness = patterns.iter().map(|pattern| {
        pattern.angle().map_or(0.0, |angle| pattern.scan.pair_contrast_near(angle) * pattern.sample.len() as f64)
    });
    Ok(Division { labels, count: patterns.len(), sharpness: sharpness.sum() })
}

/// The first two patterns that agree in orientation.
fn agreeing(patterns: &[Pattern]) -> Option<(usize, usize)> {
    (0..patterns.len())
        .flat_map(|first| (first + 1..patterns.len()).map(move |second| (first, second)))
        .find(|&(first, second)| patterns[first].agrees_with(&patterns[second]))
}
