//! Where ground narrows between two wider places: the passages that part rooms.
//!
//! Method: the watershed of the distance to the nearest obstacle, flooded from the widest places down (L. Vincent and
//! P. Soille 1991; for rooms: the distance and Voronoi segmentations surveyed by R. Bormann et al., *Room segmentation*,
//! ICRA 2016), with the merging of basins decided when they meet, as in persistence: where two basins meet, the ground
//! has a neck. Departure: a neck parts two rooms when it is narrow beside both of them, and how narrow it must be hangs
//! on what stands at its ends ([`Passage::wall_ends`]). A door is a gap in a wall, and the wall goes on behind the jamb,
//! thin and straight; beside a cupboard or a bin it does not. So furniture parts rooms only where it nearly closes them,
//! and wide openings do where walls say so. No direction is needed: slanted and curved walls are as good as any.
//!
//! Cost: O(cells), and O(width^2) for each neck. Limits: an opening as wide as the room behind it is none; ground wider
//! than [`WIDEST_M`] is never parted.

use super::ground::Ground;
use super::nearest::Nearest;
use crate::geometry::DisjointSets;
use crate::watch::{Stopped, Watch};

/// A neck parts two rooms when it is narrower than this share of the narrower one at its widest, by the number of its
/// ends that walls continue (measured on ten office floors, plain and furnished: 0.05 to 0.1 more or less costs up to two points of quality).
const CONTRASTS: [f64; 3] = [0.5, 0.8, 0.9];
/// Necks wider than this part nothing, metres: double doors and gates are narrower.
pub(super) const WIDEST_M: f64 = 4.0;
/// Places narrower than this are no rooms, metres: nobody stands there.
const NARROWEST_ROOM_M: f64 = 0.6;
/// A wall that continues a neck is followed so far behind the jamb, metres: further than a cupboard is deep.
const WALL_REACH_M: f64 = 0.8;
/// Share of that reach that must be wall.
const WALL_SHARE: f64 = 0.7;
/// Ground lies on both sides of a wall within this distance, metres: more than walls are thick.
const WALL_SIDE_M: f64 = 0.5;
/// A wall may lie so far beside the line of the neck, metres.
const WALL_DRIFT_M: f64 = 0.1;
/// Gaps in a wall up to this length are overlooked, metres.
const WALL_GAP_M: f64 = 0.2;
/// The far end of a neck is looked for within so many times its half width.
const FAR_END_FACTOR: f64 = 1.6;

/// The narrowest line across a neck.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passage {
    /// Cells (column, row) of the obstacles at its ends.
    pub ends: [[i64; 2]; 2],
    /// How many of its ends a wall continues.
    pub wall_ends: usize,
}

impl Passage {
    /// From jamb to jamb, metres, for cells of some side.
    pub(super) fn width(&self, cell: f64) -> f64 {
        let [from, to] = self.ends;
        ((to[0] - from[0]) as f64).hypot((to[1] - from[1]) as f64) * cell
    }
}

/// Finds the passages between rooms.
pub(super) fn passages(ground: &Ground, watch: &Watch<'_>) -> Result<Vec<Passage>, Stopped> {
    let clearance = Nearest::of(ground.width, ground.is_free.len(), |cell| !ground.is_free[cell], watch)?;
    let mut flood = Flood {
        ground,
        clearance: &clearance,
        basin_of: vec![NO_BASIN; ground.is_free.len()],
        is_ridge: vec![false; ground.is_free.len()],
        basins: DisjointSets::default(),
        peaks: Vec::new(),
        passages: Vec::new(),
    };
    for cells in widest_first(ground, &clearance).chunks(4096) {
        watch.check()?;
        for &cell in cells {
            flood.reach(cell as usize);
        }
    }
    Ok(flood.passages)
}

/// The cells of the ground by falling distance to the nearest obstacle; of equals the first one first. Squared
/// distances are whole numbers up to a quarter of the number of cells, so they are counted, not compared.
fn widest_first(ground: &Ground, clearance: &Nearest) -> Vec<u32> {
    let squared = |cell: &u32| clearance.squared[*cell as usize] as usize;
    let cells = || (0..ground.is_free.len() as u32).filter(|&cell| ground.is_free[cell as usize]);
    let widest = cells().map(|cell| squared(&cell)).max().unwrap_or(0);
    // Where the cells of each distance start; the widest ones first.
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

const NO_BASIN: u32 = u32::MAX;

struct Flood<'a> {
    ground: &'a Ground,
    clearance: &'a Nearest,
    basin_of: Vec<u32>,
    /// Cells where two rooms meet: each neck is looked at once.
    is_ridge: Vec<bool>,
    /// Ground around a widest place each; those without a neck between them are joined. Wider ones come first.
    basins: DisjointSets,
    /// By basin: squared distance of its widest place to the nearest obstacle, cells.
    peaks: Vec<u32>,
    passages: Vec<Passage>,
}

impl Flood<'_> {
    /// Floods one cell more.
    fn reach(&mut self, cell: usize) {
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
            return;
        };
        self.basin_of[cell] = widest;
        if count == 1 {
            return;
        }
        let is_known_neck = around.iter().any(|&near| self.is_ridge[near]);
        self.is_ridge[cell] = is_known_neck;
        for &basin in met[..count].iter().filter(|&&basin| basin != widest) {
            match self.neck(cell, self.peaks[basin as usize], is_known_neck) {
                Neck::Open => _ = self.basins.join(basin as usize, widest as usize),
                Neck::Parts(passage) => {
                    self.is_ridge[cell] = true;
                    self.passages.push(passage);
                }
                Neck::Known => {}
            }
        }
    }

    /// What becomes of a basin of some peak that meets a wider one at a cell.
    fn neck(&self, cell: usize, peak: u32, is_known_neck: bool) -> Neck {
        let (half, widest) = (f64::from(self.clearance.squared[cell]).sqrt(), f64::from(peak).sqrt());
        let (width, room) = (2.0 * half * self.ground.cell, 2.0 * widest * self.ground.cell);
        if half >= CONTRASTS[2] * widest || room < NARROWEST_ROOM_M || width > WIDEST_M {
            return Neck::Open;
        }
        if is_known_neck {
            return Neck::Known;
        }
        match self.passage(cell, half) {
            Some(passage) if half < CONTRASTS[passage.wall_ends] * widest => Neck::Parts(passage),
            _ => Neck::Open,
        }
    }

    /// The shortest line across a neck at a cell of half its width, cells; none between stacks, for goods part no rooms.
    fn passage(&self, cell: usize, half: f64) -> Option<Passage> {
        let place = |cell: usize| [(cell % self.ground.width) as i64, (cell / self.ground.width) as i64];
        let middle = place(cell);
        let near = place(self.clearance.cell[cell] as usize);
        let far = self.far_end(middle, near, FAR_END_FACTOR * half + 2.0)?;
        let is_stack =
            |[column, row]: [i64; 2]| self.ground.is_stack[row as usize * self.ground.width + column as usize];
        if is_stack(near) && is_stack(far) {
            return None;
        }
        let along = [(far[0] - near[0]) as f64, (far[1] - near[1]) as f64];
        let length = along[0].hypot(along[1]);
        let forward = along.map(|step| step / length);
        let goes_on = [
            !is_stack(near) && self.is_wall(near, forward.map(|step| -step)),
            !is_stack(far) && self.is_wall(far, forward),
        ];
        let wall_ends = goes_on.into_iter().map(usize::from).sum();
        Some(Passage { ends: [near, far], wall_ends })
    }

    /// The nearest obstacle on the far side of a cell, seen from an obstacle beside it: 120 degrees away or more.
    fn far_end(&self, middle: [i64; 2], near: [i64; 2], reach: f64) -> Option<[i64; 2]> {
        let toward = [near[0] - middle[0], near[1] - middle[1]].map(|step| step as f64);
        let side = reach as i64 + 1;
        let mut best: Option<([i64; 2], f64)> = None;
        for row in (middle[1] - side).max(0)..=(middle[1] + side).min(self.ground.height as i64 - 1) {
            for column in (middle[0] - side).max(0)..=(middle[0] + side).min(self.ground.width as i64 - 1) {
                let away = [column - middle[0], row - middle[1]].map(|step| step as f64);
                let distance = away[0].hypot(away[1]);
                let cosine_of_far = -0.5 * toward[0].hypot(toward[1]) * distance;
                let is_far = away[0] * toward[0] + away[1] * toward[1] < cosine_of_far;
                let is_nearest = best.is_none_or(|(_, least)| distance < least);
                if is_far && is_nearest && distance <= reach && !self.ground.holds(column, row) {
                    best = Some(([column, row], distance));
                }
            }
        }
        best.map(|(place, _)| place)
    }

    /// Whether a thin wall goes on from an obstacle in a direction (unit vector).
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

/// What a place where two basins meet is.
enum Neck {
    /// As wide as what lies beyond it: one room.
    Open,
    /// A passage between two rooms.
    Parts(Passage),
    /// Beside a cell where this was decided before.
    Known,
}
