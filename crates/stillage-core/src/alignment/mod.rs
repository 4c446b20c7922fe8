//! One map on another: shift and turn between two scans of a site, or the finding that they show different sites.
//!
//! | step | method | module |
//! | --- | --- | --- |
//! | surfaces | occupied cells beside free ones, with normals | `surfaces` |
//! | turns | correlation of the radiogram energies over the angle | `turns` |
//! | shifts | cross-correlation of coarse maps by Fourier transforms | `overview`, `shifts` |
//! | fit | closest points along the normals, robust against moved goods | `refine` |
//! | choice | what one motion explains and another does not | `rivals` |
//! | verdict | share of surfaces that touch, against that of the next best motion | `agreement`, `site_alignment` |
//!
//! Source: our own combination of known parts. The author of the paper aligns maps by their decompositions
//! (S. Gholami Shahbandi and M. Magnusson, *2D map alignment with region decomposition*, Autonomous Robots 2019); cells
//! serve here, because goods move and walls stay.
//!
//! The same grids give the same answer on any number of threads. Limits: no scale, no bend: a map whose scan drifted
//! is aligned where most of it agrees.

mod agreement;
mod overview;
mod refine;
mod rivals;
mod shifts;
mod site_alignment;
mod surfaces;
mod turns;

#[cfg(test)]
mod tests;

use rayon::prelude::*;

use crate::geometry::RigidMotion;
use crate::grid::OccupancyGrid;
use crate::watch::{Stopped, Watch};
use agreement::Tally;
use overview::Overview;
use surfaces::Surfaces;

pub use site_alignment::{NotSameSite, SiteAlignment};

/// Points of each map in the first comparison of all candidates.
const FEW_POINTS: usize = 2_000;
/// Points of each map in the last comparison: more change the fit by less than a millimetre.
const MANY_POINTS: usize = 20_000;
/// Fewest surface points of a map that can be told from another: 5 m of wall in cells of 0.05 m.
const FEWEST_POINTS: usize = 100;
/// Candidates in the last comparison.
const FINALISTS: usize = 6;
/// Motions that differ by less are one: distances within which surfaces touch, at the middle of the map, and radians.
const SAME_MOTION: (f64, f64) = (3.0, 0.01);

/// Finds the motion of a new map of a site onto an old one, in the map frames of both.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub fn align(
    new: &OccupancyGrid,
    old: &OccupancyGrid,
    watch: &Watch<'_>,
) -> Result<Result<SiteAlignment, NotSameSite>, Stopped> {
    let (from, to) = (Surfaces::of(new, watch)?, Surfaces::of(old, watch)?);
    if from.points.len().min(to.points.len()) < FEWEST_POINTS {
        return Ok(Err(NotSameSite { agreement: 0.0, overlap: 0.0 }));
    }
    let turns = turns::candidates(new, old, watch)?;
    let cell = overview::cell_for([&from, &to]);
    let starts = shifts::candidates(&Overview::of(&from, cell), &Overview::of(&to, cell), &turns, watch)?;
    let finalists = best_of([&from, &to], &starts, FEW_POINTS, FINALISTS, watch)?;
    let starts: Vec<RigidMotion> = finalists.into_iter().map(|(motion, _)| motion).collect();
    let mut ranked = best_of([&from, &to], &starts, MANY_POINTS, FINALISTS, watch)?;
    let samples = [&from, &to].map(|map| map.sample(MANY_POINTS));
    let advantage = rivals::settle([&from, &to], [&samples[0], &samples[1]], &mut ranked);
    let to_map_frames = |motion: RigidMotion| new.frame().motion().inverse().then(&motion).then(&old.frame().motion());
    let samples = [&from, &to].map(|map| map.sample(FEW_POINTS));
    let turn = ranked.first().map_or(0.0, |(motion, _)| motion.turn);
    let chance = agreement::chance([&from, &to], [&samples[0], &samples[1]], turn);
    Ok(site_alignment::verdict(&ranked, advantage, chance, to_map_frames))
}

/// Refines motions on a sample of the points, and keeps the best that differ.
fn best_of(
    maps: [&Surfaces<'_>; 2],
    starts: &[RigidMotion],
    points: usize,
    most: usize,
    watch: &Watch<'_>,
) -> Result<Vec<(RigidMotion, Tally)>, Stopped> {
    let [from, to] = maps;
    let samples = maps.map(|map| map.sample(points));
    let refine = |&start: &RigidMotion| {
        watch.check()?;
        let motion = refine::refine(from, to, &samples[0], start);
        Ok((motion, Tally::of_walls_and_all(maps, [&samples[0], &samples[1]], &motion)))
    };
    let mut found: Vec<(RigidMotion, Tally)> = starts.par_iter().map(refine).collect::<Result<_, Stopped>>()?;
    // A stable sort: of equals, the first stays the first.
    found.sort_by(|one, other| other.1.rank().total_cmp(&one.1.rank()));
    let middle = samples[0].get(samples[0].len() / 2).map(|&index| from.points[index]).unwrap_or_default();
    let mut kept: Vec<(RigidMotion, Tally)> = Vec::new();
    for candidate in found {
        let is_same = |(other, _): &(RigidMotion, Tally)| {
            let back = other.inverse().then(&candidate.0);
            (back.apply(middle) - middle).norm() < SAME_MOTION.0 * agreement::touch(maps)
                && back.turn.abs() < SAME_MOTION.1
        };
        if kept.len() < most && !kept.iter().any(is_same) {
            kept.push(candidate);
        }
    }
    Ok(kept)
}
