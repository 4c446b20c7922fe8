//! How many regions a map has: clusters of texture that do not differ in orientation are one pattern.
//!
//! The paper leaves the number of clusters to the user. Texture alone cannot tell it: k-means splits any map, and
//! what differs most between tiles is how full they are. But regions serve to keep the lines of one orientation out
//! of the other's blocks (II-D), so clusters count as different only if their dominant orientations are: for each
//! number of clusters the radiogram energy of each cluster is scanned, clusters without an orientation go to their
//! neighbours, clusters that agree are merged. The number that leaves most patterns wins, the sharper ones in a tie.
//!
//! Departure: orientation pairs (a direction and its perpendicular) are compared. Cost: O(k (sample x angles)) for each
//! number of clusters. Limits: two blocks of the same orientation and different pitch are one region.

use super::tiles::{NONE, Tiles};
use crate::orientation::energy::{EnergyScan, OccupiedSample, pair_angle_between};
use crate::watch::{Stopped, Watch};

/// Occupied cells sampled of the whole map: enough for some clusters, cheap enough for a scan of each.
pub(super) const SAMPLE_CELLS: usize = 60_000;
/// Fewest sampled cells of a pattern (accuracy study: 60 per window).
const MIN_CELLS: usize = 60;
/// Smallest contrast of a pattern's orientation, as a share of the mean energy. Of scattered points it is below 0.1,
/// of rack blocks above 1.
const MIN_RELATIVE_CONTRAST: f64 = 0.3;
/// Orientations that differ by less are the same (modulo a quarter turn), degrees.
const AGREEMENT_DEG: f64 = 2.0;
/// A pattern in which another's orientation stands out by this share of its own holds both: no reason to part them.
const SHARED_CONTRAST: f64 = 0.5;

/// A division of the tiles into patterns of really different orientation.
pub(super) struct Division {
    /// Pattern of each tile; [`NONE`] where a cluster has no orientation of its own.
    pub labels: Vec<u8>,
    /// Number of patterns.
    pub count: usize,
    /// How sharply the patterns are aligned.
    pub sharpness: f64,
}

/// Clusters that count as one, and how they are aligned.
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

    /// Whether another pattern's orientation is (nearly) as good for this one as its own.
    fn accepts(&self, own: f64, other: f64) -> bool {
        self.scan.pair_contrast_near(other) >= SHARED_CONTRAST * self.scan.pair_contrast_near(own)
    }

    fn agrees_with(&self, other: &Self) -> bool {
        match (self.angle(), other.angle()) {
            (Some(one), Some(two)) => {
                pair_angle_between(one, two) <= AGREEMENT_DEG.to_radians()
                    || self.accepts(one, two)
                    || other.accepts(two, one)
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

/// The first two patterns that are one.
fn agreeing(patterns: &[Pattern]) -> Option<(usize, usize)> {
    (0..patterns.len())
        .flat_map(|first| (first + 1..patterns.len()).map(move |second| (first, second)))
        .find(|&(first, second)| patterns[first].agrees_with(&patterns[second]))
}
