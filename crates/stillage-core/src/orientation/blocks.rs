//! Directions that only a part of a map has.
//!
//! The energy of a whole map is a sum of squares, so a hall of another direction beside a few hundred aligned racks
//! stays far below any threshold. So the map is scanned block by block. A block votes for its best pair of
//! perpendicular directions if that pair stands out, and far above all known pairs; a pair with enough votes is refined
//! on the blocks that voted for it. Cost: that of one more scan, since the blocks share the sample. Limits: parts
//! smaller than [`LEAST_BLOCKS`] blocks are not found.

use rayon::prelude::*;

use super::energy::{EnergyScan, OccupiedSample, pair_angle_between};
use crate::grid::OccupancyGrid;
use crate::watch::{Stopped, Watch};

/// Side of a block, metres: several rows of racks and their aisles.
const BLOCK_M: f64 = 20.0;
/// Fewest cells of a block that show a direction.
const LEAST_CELLS: usize = 300;
/// Least contrast of the best pair of a block, standard deviations of that of scattered cells.
const LEAST_DEVIATIONS: f64 = 20.0;
/// Least contrast of the best pair of a block, over that of the known pairs.
const ABOVE_KNOWN: f64 = 2.0;
/// Votes within this are for one pair, radians: half the distance of two peaks of a scan.
const SAME_PAIR: f64 = 1.5 * std::f64::consts::PI / 180.0;
/// Votes that a pair needs: the furniture of one room may be turned as well.
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
        let is_for = |angle: f64, vote: f64| pair_angle_between(vote, angle) <= SAME_PAIR;
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

/// The best pair of a block, unless a known one explains it.
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
