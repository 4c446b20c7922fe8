//! Directions that only a part of a map has.
//!
//! The energy of a whole map is a sum of squares: a few hundred aligned racks leave a hall of another direction far below
//! any threshold, though it is as clear to the eye. So the map is asked block by block. A block whose own best pair of
//! perpendicular directions stands out, and far above all pairs that are known, votes for its own; a pair with votes
//! enough is refined on the blocks that voted for it. Cost: that of one more scan, since the blocks share the sample.
//! Limits: parts smaller than [`LEAST_BLOCKS`] blocks have no say.

use rayon::prelude::*;

use super::energy::{EnergyScan, OccupiedSample, pair_angle_between};
use crate::grid::OccupancyGrid;
use crate::watch::{Stopped, Watch};

/// Side of a block, metres: several rows of racks and their aisles.
const BLOCK_M: f64 = 20.0;
/// Fewest cells of a block that show a direction.
const LEAST_CELLS: usize = 300;
/// How far the best pair of a block stands out, deviations of scattered cells, and how far above the known pairs.
const LEAST_DEVIATIONS: f64 = 20.0;
const ABOVE_KNOWN: f64 = 2.0;
/// Votes within this are for one pair, radians: half of what keeps two apart.
const SAME_VOTE: f64 = 1.5 * std::f64::consts::PI / 180.0;
/// Votes that a pair needs: furniture of a room stands askew, too.
const LEAST_BLOCKS: usize = 4;

/// Pairs that parts of a map have and that are none of `known`; one direction of each, radians.
pub(super) fn pairs(
    grid: &OccupancyGrid,
    sample: &OccupiedSample,
    known: &[f64],
    watch: &Watch<'_>,
) -> Result<Vec<f64>, Stopped> {
    let side = ((BLOCK_M / grid.resolution()) as usize).max(1);
    let (columns, rows) = (grid.width().div_ceil(side), grid.height().div_ceil(side));
    if columns * rows < LEAST_BLOCKS {
        return Ok(Vec::new());
    }
    let blocks = sample.split(columns * rows, |column, row| Some(row / side * columns + column / side));
    let votes: Vec<Option<f64>> = blocks.par_iter().map(|block| vote(block, known, watch)).collect::<Result<_, _>>()?;
    let mut votes: Vec<(f64, OccupiedSample)> =
        votes.into_iter().zip(blocks).filter_map(|(vote, block)| Some((vote?, block))).collect();
    let mut pairs = Vec::new();
    loop {
        let is_for = |angle: f64, vote: f64| pair_angle_between(vote, angle) <= SAME_VOTE;
        let supporters = |angle: f64| votes.iter().filter(|vote| is_for(angle, vote.0)).count();
        let counts = votes.iter().map(|vote| (supporters(vote.0), vote.0));
        let best = counts.reduce(|best, other| if other.0 > best.0 { other } else { best });
        let Some((_, angle)) = best.filter(|best| best.0 >= LEAST_BLOCKS) else { return Ok(pairs) };
        let (own, others) = votes.into_iter().partition(|vote| is_for(angle, vote.0));
        votes = others;
        let part = own.into_iter().map(|vote: (f64, OccupiedSample)| vote.1).reduce(|mut part, block| {
            part.append(&block);
            part
        });
        pairs.push(part.unwrap_or_default().refine_pair(angle, watch)?);
    }
}

/// The best pair of a block, if no known one explains it.
fn vote(block: &OccupiedSample, known: &[f64], watch: &Watch<'_>) -> Result<Option<f64>, Stopped> {
    if block.len() < LEAST_CELLS {
        return Ok(None);
    }
    let scan = EnergyScan::new(block, watch)?;
    let Some(&angle) = scan.pair_peaks(1.0).first() else { return Ok(None) };
    let contrast = scan.pair_contrast_near(angle);
    let explained = known.iter().map(|&known| scan.pair_contrast_near(known)).fold(0.0, f64::max);
    let is_own = contrast >= LEAST_DEVIATIONS * scan.noise(block) && contrast > ABOVE_KNOWN * explained;
    Ok(is_own.then_some(angle))
}
