//! The first pass of the sweep: several directions walk the whole grid and keep the states of their lines at the
//! borders between tiles.

use super::directions::{Direction, PHASES};
use super::lines::Lines;
use super::mask::Mask;
use super::tile::TILE;
use crate::vectors::Kernel;
use crate::watch::{Stopped, Watch};

/// Rows between two checks of the stop flag.
const ROWS_PER_CHECK: usize = 64;

/// Directions of one quadrant that walk the whole mask together; the output is the states at tile borders of each.
pub(super) struct QuadrantWalk<'a> {
    pub(super) mask: &'a Mask,
    pub(super) directions: &'a [Direction],
    pub(super) watch: &'a Watch<'a>,
}

impl Kernel for QuadrantWalk<'_> {
    type Output = Result<Vec<Vec<u16>>, Stopped>;

    #[inline(always)]
    fn run<const SIMD_WIDTH: usize>(self) -> Self::Output {
        let Self { mask, directions, watch } = self;
        let mut walks: Vec<GridWalk> = directions.iter().map(|&direction| GridWalk::new(mask, direction)).collect();
        let ascending = directions.first().is_some_and(|direction| direction.ascending);
        for step in 0..mask.rows() {
            if step % ROWS_PER_CHECK == 0 {
                watch.check()?;
            }
            // Against the beam, from its far end.
            let row = if ascending { mask.rows() - 1 - step } else { step };
            for walk in &mut walks {
                walk.cross_row(mask, row);
            }
        }
        Ok(walks.into_iter().map(|walk| walk.borders).collect())
    }
}

/// The lines of one direction and the states kept so far.
struct GridWalk {
    direction: Direction,
    lines: [Lines; PHASES],
    /// By border, phase and column.
    borders: Vec<u16>,
}

impl GridWalk {
    fn new(mask: &Mask, direction: Direction) -> Self {
        let columns = 0..mask.columns() as isize;
        let lines = std::array::from_fn(|phase| {
            let ends = [direction.column(phase, 0), direction.column(phase, mask.rows())];
            Lines::between(columns.start - ends[0].max(ends[1])..columns.end - ends[0].min(ends[1]))
        });
        let inner_borders = mask.rows().saturating_sub(1) / TILE;
        Self { direction, lines, borders: vec![0; inner_borders * PHASES * mask.columns()] }
    }

    #[inline(always)]
    fn cross_row(&mut self, mask: &Mask, row: usize) {
        let columns = mask.columns();
        let near_border = if self.direction.ascending { row } else { row + 1 };
        let kept = (near_border % TILE == 0 && near_border > 0 && near_border < mask.rows())
            .then(|| (near_border / TILE - 1) * PHASES * columns);
        for (phase, lines) in self.lines.iter_mut().enumerate() {
            let crossing = self.direction.crossing(phase, row);
            let inside = -crossing.entry..columns as isize - crossing.entry;
            lines.cross(&inside, mask, row, &crossing);
            if let Some(start) = kept {
                let start = start + phase * columns;
                self.borders[start..start + columns].copy_from_slice(&lines.states_from(inside.start)[..columns]);
            }
        }
    }
}
