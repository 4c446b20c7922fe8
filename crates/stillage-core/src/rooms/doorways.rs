//! Doorways: where the ground narrows between two wider places, so that it parts two rooms.
//!
//! Method: the watershed of the distance to the nearest obstacle, from the widest places down (L. Vincent and P. Soille
//! 1991; for rooms: the distance and Voronoi segmentations surveyed by R. Bormann et al., *Room segmentation*, ICRA
//! 2016). Each widest place begins a basin; where two basins meet, the ground has a neck, and they are joined unless the
//! neck is a doorway.
//!
//! Departure: a neck is a doorway when it is narrow beside both basins, and how narrow it must be depends on what
//! stands at its ends ([`Doorway::wall_ends`]). A door is a gap in a wall that goes on behind the jamb, thin and
//! straight; a cupboard or a bin does not go on. So furniture parts rooms only where it nearly closes the way, and wide
//! openings do where walls stand at both ends. No direction is needed: slanted and curved walls are found like any
//! others.
//!
//! Cost: O(cells + necks x width^2), the width of a neck in cells, at most that of [`WIDEST_M`]. Limits: an opening as
//! wide as the room behind it is no doorway; ground wider than [`WIDEST_M`] is never parted.

use super::ground::{Jambs, RoomGround};
use crate::distance_transform::DistanceTransform;
use crate::geometry::DisjointSets;
use crate::watch::{Stopped, Watch};

/// Greatest width of a doorway as a share of the width of the narrower basin at its widest, by the number of ends of
/// the doorway that walls continue. Measured on ten office floors, plain and furnished: 0.05 to 0.1 more or less costs
/// up to two points of panoptic quality.
const GREATEST_WIDTH_SHARES: [f64; 3] = [0.5, 0.8, 0.9];
/// Greatest width of a doorway, metres: double doors and gates are narrower.
pub(super) const WIDEST_M: f64 = 4.0;
/// Least width of a room at its widest, metres: nobody stands in less.
const NARROWEST_ROOM_M: f64 = 0.6;
/// How far a wall is followed behind a jamb, metres: further than a cupboard is deep.
const WALL_REACH_M: f64 = 0.8;
/// Least share of that reach that is wall. No measurement is recorded for this value.
const WALL_SHARE: f64 = 0.7;
/// Ground lies on both sides of a wall within this distance, metres: more than inner walls are thick.
const WALL_SIDE_M: f64 = 0.5;
/// How far a wall may lie beside the line across the doorway, metres. No measurement is recorded for this value.
const WALL_DRIFT_M: f64 = 0.1;
/// Longest gap in a wall that is overlooked, metres. No measurement is recorded for this value.
const WALL_GAP_M: f64 = 0.2;
/// Greatest distance of the far end of a neck from its middle, in half widths. No measurement is recorded for this
/// value.
const FAR_END_FACTOR: f64 = 1.6;

/// Least and greatest width of a door, metres: a person fits through, and one leaf or two close it.
const DOOR_WIDTHS_M: [f64; 2] = [0.6, 3.0];

/// The shortest line across a neck that parts two rooms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Doorway {
    /// Column and row of the obstacle at each of its ends, the jambs.
    pub ends: Jambs,
    /// How many of its ends a wall continues.
    pub wall_ends: usize,
}

impl Doorway {
    /// Distance between the jambs, metres, for cells with sides of `cell` metres.
    pub(super) fn width(&self, cell: f64) -> f64 {
        let [from, to] = self.ends;
        ((to[0] - from[0]) as f64).hypot((to[1] - from[1]) as f64) * cell
    }

    /// Whether it is a door: as wide as one, in a wall. Other doorways are gaps between goods or furniture.
    pub(super) fn is_door(&self, cell: f64) -> bool {
        self.wall_ends > 0 && (DOOR_WIDTHS_M[0]..=DOOR_WIDTHS_M[1]).contains(&self.width(cell))
    }
}

/// Finds the doorways of the ground.
pub(super) fn find(ground: &RoomGround, watch: &Watch<'_>) -> Result<Vec<Doorway>, Stopped> {
    let clearance = DistanceTransform::of(ground.width, ground.is_free.len(), |cell| !ground.is_free[cell], watch)?;
    let mut watershed = Watershed {
        ground,
        clearance: &clearance,
        watch,
        basin_of: vec![NO_BASIN; ground.is_free.len()],
        is_ridge: vec![false; ground.is_free.len()],
        basins: DisjointSets::default(),
        peaks: Vec::new(),
        doorways: Vec::new(),
    };
    for cells in widest_first(ground, &clearance).chunks(CHECK_EVERY) {
        watch.check()?;
        for &cell in cells {
            watershed.add(cell as usize)?;
        }
    }
    Ok(watershed.doorways)
}

/// The cells of the ground by falling distance to the nearest obstacle; of equals the first one first. A counting sort:
/// squared distances are whole numbers up to a quarter of the number of cells.
fn widest_first(ground: &RoomGround, clearance: &DistanceTransform) -> Vec<u32> {
    let squared = |cell: &u32| clearance.squared[*cell as usize] as usize;
    let cells = || (0..ground.is_free.len() as u32).filter(|&cell| ground.is_free[cell as usize]);
    let widest = cells().map(|cell| squared(&cell)).max().unwrap_or(0);
    // The place of the first cell of each distance; the widest ones come first.
    let mut starts = vec![0_u32; widest + 2];
    cells().for_each(|cell| starts[squared(&cell)] += 1);
    let mut wider = 0;
    for start in starts.iter_mut().rev() {
        wider += std::mem::replace(start, wider);
    }
    let mut sorted = vec![0; wider as usize];
    for cell in cells() {
        let next = &mut starts[squared(&cell)];
        sorted[*next as usize] = cell;
        *next += 1;
    }
    sorted
}

/// Cells that are added between two looks at the stop flag: well below 50 ms of work.
const CHECK_EVERY: usize = 4_096;
/// The basin of a cell that was not added yet.
const NO_BASIN: u32 = u32::MAX;

/// The state of the watershed.
struct Watershed<'a> {
    ground: &'a RoomGround,
    clearance: &'a DistanceTransform,
    watch: &'a Watch<'a>,
    /// Basin of each cell so far.
    basin_of: Vec<u32>,
    /// Cells of doorways that are decided already.
    is_ridge: Vec<bool>,
    /// Basins, numbered by falling width; those without a doorway between them are joined.
    basins: DisjointSets,
    /// By basin: squared distance of its widest place to the nearest obstacle, cells.
    peaks: Vec<u32>,
    doorways: Vec<Doorway>,
}

impl Watershed<'_> {
    /// Adds the next cell to a basin beside it, or begins a basin.
    fn add(&mut self, cell: usize) -> Result<(), Stopped> {
        let around = self.ground.around(cell);
        let mut met = [NO_BASIN; 8];
        let mut count = 0;
        let mut last = NO_BASIN;
        for near in around {
            let basin = self.basin_of[near];
            if basin == NO_BASIN || basin == last {
                continue;
            }
            last = basin;
            let basin = self.basins.find(basin as usize) as u32;
            if !met[..count].contains(&basin) {
                met[count] = basin;
                count += 1;
            }
        }
        let Some(&widest) = met[..count].iter().min() else {
            self.basin_of[cell] = self.basins.add() as u32;
            self.peaks.push(self.clearance.squared[cell]);
            return Ok(());
        };
        self.basin_of[cell] = widest;
        if count == 1 {
            return Ok(());
        }
        let is_beside_ridge = around.iter().any(|&near| self.is_ridge[near]);
        self.is_ridge[cell] = is_beside_ridge;
        for &basin in met[..count].iter().filter(|&&basin| basin != widest) {
            match self.neck(cell, self.peaks[basin as usize], is_beside_ridge)? {
                Neck::Open => _ = self.basins.join(basin as usize, widest as usize),
                Neck::Doorway(doorway) => {
                    self.is_ridge[cell] = true;
                    self.doorways.push(doorway);
                }
                Neck::Decided => {}
            }
        }
        Ok(())
    }

    /// What the cell is where a wider basin meets one with a widest place of squared clearance `peak`.
    fn neck(&self, cell: usize, peak: u32, is_beside_ridge: bool) -> Result<Neck, Stopped> {
        let (half, widest) = (f64::from(self.clearance.squared[cell]).sqrt(), f64::from(peak).sqrt());
        let (width, room) = (2.0 * half * self.ground.cell, 2.0 * widest * self.ground.cell);
        if half >= GREATEST_WIDTH_SHARES[2] * widest || room < NARROWEST_ROOM_M || width > WIDEST_M {
            return Ok(Neck::Open);
        }
        if is_beside_ridge {
            return Ok(Neck::Decided);
        }
        self.watch.check()?;
        Ok(match self.line_across(cell, half) {
            Some(doorway) if half < GREATEST_WIDTH_SHARES[doorway.wall_ends] * widest => Neck::Doorway(doorway),
            _ => Neck::Open,
        })
    }

    /// The shortest line across a neck through a cell, `half` cells from the nearest obstacle; `None` between two
    /// stacks, for goods part no rooms.
    fn line_across(&self, cell: usize, half: f64) -> Option<Doorway> {
        let place = |cell: usize| [(cell % self.ground.width) as i64, (cell / self.ground.width) as i64];
        let middle = place(cell);
        let near = place(self.clearance.nearest[cell] as usize);
        let far = self.far_end(middle, near, FAR_END_FACTOR * half + 2.0)?;
        let is_stack =
            |[column, row]: [i64; 2]| self.ground.is_stack[row as usize * self.ground.width + column as usize];
        if is_stack(near) && is_stack(far) {
            return None;
        }
        let along = [(far[0] - near[0]) as f64, (far[1] - near[1]) as f64];
        let length = along[0].hypot(along[1]);
        let forward = along.map(|step| step / length);
        let is_wall_end = [
            !is_stack(near) && self.is_wall(near, forward.map(|step| -step)),
            !is_stack(far) && self.is_wall(far, forward),
        ];
        let wall_ends = is_wall_end.into_iter().map(usize::from).sum();
        Some(Doorway { ends: [near, far], wall_ends })
    }

    /// The obstacle nearest to a cell within `reach` cells in a direction 120 degrees or more away from that of the
    /// obstacle `near`; of equals the first one. Rows are searched outwards, so that the cost is the square of what is
    /// found.
    fn far_end(&self, middle: [i64; 2], near: [i64; 2], reach: f64) -> Option<[i64; 2]> {
        let toward = [near[0] - middle[0], near[1] - middle[1]].map(|step| step as f64);
        let to_near = toward[0].hypot(toward[1]);
        let mut best: Option<(f64, [i64; 2])> = None;
        let mut least = reach;
        let mut up = 0;
        while up as f64 <= least {
            let side = least as i64;
            let columns = (middle[0] - side).max(0)..=(middle[0] + side).min(self.ground.width as i64 - 1);
            for row in [middle[1] - up, middle[1] + up] {
                if !(0..self.ground.height as i64).contains(&row) {
                    continue;
                }
                for column in columns.clone().filter(|&column| !self.ground.holds(column, row)) {
                    let away = [column - middle[0], row - middle[1]].map(|step| step as f64);
                    let distance = away[0].hypot(away[1]);
                    let is_far = away[0] * toward[0] + away[1] * toward[1] < -0.5 * to_near * distance;
                    let is_first = best.is_none_or(|(least, [_, before])| distance < least || row < before);
                    if is_far && distance <= least && is_first {
                        (best, least) = (Some((distance, [column, row])), distance);
                    }
                }
            }
            up += 1;
        }
        best.map(|(_, place)| place)
    }

    /// Whether a thin wall leads from an obstacle in a direction (unit vector).
    fn is_wall(&self, from: [i64; 2], forward: [f64; 2]) -> bool {
        let steps = self.ground.cells_of(WALL_REACH_M);
        let gaps = self.ground.cells_of(WALL_GAP_M);
        let drift = self.ground.cells_of(WALL_DRIFT_M) as i64;
        let (mut hits, mut misses) = (0, 0);
        for step in 0..steps {
            let at = |aside: i64| {
                let (ahead, aside) = (step as f64, aside as f64);
                [
                    from[0] as f64 + forward[0] * ahead - forward[1] * aside,
                    from[1] as f64 + forward[1] * ahead + forward[0] * aside,
                ]
            };
            if (-drift..=drift).any(|aside| self.is_thin_at(at(aside), forward)) {
                hits += 1;
            } else {
                misses += 1;
                if misses > gaps {
                    break;
                }
            }
        }
        f64::from(hits) >= WALL_SHARE * steps as f64
    }

    /// Whether an obstacle at a point has ground on both sides of a line through it.
    fn is_thin_at(&self, point: [f64; 2], forward: [f64; 2]) -> bool {
        let is_ground = |aside: f64| {
            let column = (point[0] - forward[1] * aside).round() as i64;
            let row = (point[1] + forward[0] * aside).round() as i64;
            self.ground.holds(column, row)
        };
        let mut sides = 1..=self.ground.cells_of(WALL_SIDE_M);
        !is_ground(0.0)
            && sides.clone().any(|aside| is_ground(aside as f64))
            && sides.any(|aside| is_ground(-(aside as f64)))
    }
}

/// What the ground is where two basins meet.
enum Neck {
    /// Too wide to part them: they are one room.
    Open,
    /// A doorway between two rooms.
    Doorway(Doorway),
    /// Part of a doorway that was found at a cell beside it.
    Decided,
}
