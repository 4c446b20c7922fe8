//! Noding: cuts segments where they meet, by iterated snap rounding.
//!
//! Every end and every crossing makes its lattice pixel *hot*; a segment that meets a hot pixel is bent to its centre
//! (J. D. Hobby 1999, doi 10.1016/S0925-7721(99)00021-8). The pieces are bent again until none meets a pixel it does
//! not end in (D. Halperin and E. Packer, *Iterated snap rounding*, 2002, doi 10.1016/S0925-7721(01)00064-5), so that
//! at the end pieces meet only in their ends and every vertex keeps half a step away from every other piece.
//!
//! Departure: the pairs that cross are found through buckets instead of a sweep, which is simpler and, for lines spread
//! over a map, as fast. Cost: O(n + pairs sharing a bucket + pieces). Only pieces that were bent are examined again.

use super::EdgeSource;
use super::buckets::{BucketGrid, Buckets};
use super::lattice::{LatticePoint, LatticeSegment};
use crate::watch::{Stopped, Watch};

/// A segment of the lattice and its source. Ordered by place, then source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Piece<S = EdgeSource> {
    pub segment: LatticeSegment,
    pub source: S,
}

/// Segments that are examined between two looks at the stop flag: well below 50 ms of work.
const CHECK_EVERY: usize = 1_024;

/// Cuts pieces at every point where they meet. The result is sorted, each place once with its least source.
pub(super) fn node<S: Copy + Ord>(mut pieces: Vec<Piece<S>>, watch: &Watch<'_>) -> Result<Vec<Piece<S>>, Stopped> {
    keep_least_source(&mut pieces);
    let Some(bounds) = bounds(&pieces) else { return Ok(pieces) };
    let hot = hot_pixels(&pieces, bounds, watch)?;
    let index = PixelIndex::new(hot, bounds);
    let mut done = Vec::new();
    let mut bent = pieces;
    while !bent.is_empty() {
        let mut again = Vec::new();
        for (number, &piece) in bent.iter().enumerate() {
            if number % CHECK_EVERY == 0 {
                watch.check()?;
            }
            let chain = index.met_by(piece.segment);
            // A piece of a straight segment meets no other hot pixel; a bent one may.
            let straight = chain.iter().all(|&pixel| piece.segment.side(pixel) == 0);
            let target = if straight { &mut done } else { &mut again };
            target.extend(chain.windows(2).filter_map(|ends| {
                LatticeSegment::between(ends[0], ends[1]).map(|segment| Piece { segment, source: piece.source })
            }));
        }
        keep_least_source(&mut again);
        bent = again;
    }
    keep_least_source(&mut done);
    Ok(done)
}

/// Sorts pieces by place and keeps one of each place.
pub(super) fn keep_least_source<S: Copy + Ord>(pieces: &mut Vec<Piece<S>>) {
    pieces.sort_unstable();
    pieces.dedup_by_key(|piece| piece.segment);
}

/// Lower left and upper right corner of all pieces.
fn bounds<S>(pieces: &[Piece<S>]) -> Option<(LatticePoint, LatticePoint)> {
    let ends = || pieces.iter().flat_map(|piece| [piece.segment.low, piece.segment.high]);
    let low = LatticePoint { x: ends().map(|end| end.x).min()?, y: ends().map(|end| end.y).min()? };
    let high = LatticePoint { x: ends().map(|end| end.x).max()?, y: ends().map(|end| end.y).max()? };
    Some((low, high))
}

/// The ends of all pieces and the pixels of their crossings, ascending.
fn hot_pixels<S>(
    pieces: &[Piece<S>],
    (low, high): (LatticePoint, LatticePoint),
    watch: &Watch<'_>,
) -> Result<Vec<LatticePoint>, Stopped> {
    let grid = BucketGrid::over(low, high, pieces.len());
    let mut pairs = Vec::new();
    for (number, piece) in pieces.iter().enumerate() {
        grid.along(piece.segment, |bucket| pairs.push((bucket as u32, number as u32)));
    }
    let buckets = Buckets::pack(grid.bucket_count(), &pairs);
    let mut hot: Vec<_> = pieces.iter().flat_map(|piece| [piece.segment.low, piece.segment.high]).collect();
    let mut looked_at = 0;
    for bucket in 0..grid.bucket_count() {
        let members = buckets.of(bucket);
        for (position, &first) in members.iter().enumerate() {
            looked_at += members.len() - position;
            if looked_at > 64 * CHECK_EVERY {
                looked_at = 0;
                watch.check()?;
            }
            let segment = pieces[first as usize].segment;
            let others = members[position + 1..].iter().map(|&other| pieces[other as usize].segment);
            hot.extend(others.filter_map(|other| segment.crossing(other)));
        }
    }
    hot.sort_unstable();
    hot.dedup();
    Ok(hot)
}

/// Finds the hot pixels that a segment meets.
struct PixelIndex {
    grid: BucketGrid,
    buckets: Buckets,
    pixels: Vec<LatticePoint>,
}

impl PixelIndex {
    fn new(pixels: Vec<LatticePoint>, (low, high): (LatticePoint, LatticePoint)) -> Self {
        let grid = BucketGrid::over(low, high, pixels.len());
        let pairs: Vec<_> =
            pixels.iter().zip(0..).map(|(&pixel, number)| (grid.bucket_of(pixel) as u32, number)).collect();
        Self { grid, buckets: Buckets::pack(grid.bucket_count(), &pairs), pixels }
    }

    /// The hot pixels that a segment meets, from its low to its high end.
    fn met_by(&self, segment: LatticeSegment) -> Vec<LatticePoint> {
        let mut met = Vec::new();
        self.grid.along(segment, |bucket| {
            let pixels = self.buckets.of(bucket).iter().map(|&number| self.pixels[number as usize]);
            met.extend(pixels.filter(|&pixel| segment.meets_pixel(pixel)));
        });
        // A straight segment meets pixels in the order of their projection on it.
        let (dx, dy) = segment.direction();
        met.sort_unstable_by_key(|&pixel| {
            let (x, y) = segment.low.to(pixel);
            x * dx + y * dy
        });
        met
    }
}
