//! The state of many lines of one phase, and their move across a row.
//!
//! Along one line, the distance from a row to the next blocking cell is that of the row ahead plus one row, or 0 where
//! a cell blocks. In every row a line is stopped by the cell that it enters and by the cell that it leaves through (the
//! supercover of the line), so walls of touching corners stop beams. The move is an addition and two masks over
//! contiguous numbers, which compilers turn into vector instructions.

use std::ops::Range;

use super::directions::{RowCrossing, UNITS_PER_ROW};
use super::mask::{LINES_PER_STEP, Mask};

/// The state of consecutive lines of one phase: units from the border last crossed to where the line is stopped.
#[derive(Debug)]
pub(super) struct Lines {
    /// Number of the first line.
    first: isize,
    states: Vec<u16>,
}

impl Lines {
    /// Lines of length 0.
    pub(super) fn between(numbers: Range<isize>) -> Self {
        Self { first: numbers.start, states: vec![0; numbers.len() + LINES_PER_STEP] }
    }

    /// Switches to other lines, whose states are to be set.
    #[inline(always)]
    pub(super) fn restart(&mut self, numbers: Range<isize>) {
        self.first = numbers.start;
        self.states.resize(numbers.len() + LINES_PER_STEP, 0);
    }

    /// The states of a line and of all after it.
    #[inline(always)]
    pub(super) fn states_from(&self, number: isize) -> &[u16] {
        &self.states[(number - self.first) as usize..]
    }

    /// The states of a line and of all after it, to be set.
    #[inline(always)]
    pub(super) fn states_from_mut(&mut self, number: isize) -> &mut [u16] {
        &mut self.states[(number - self.first) as usize..]
    }

    /// Moves some lines across a row of the mask, from the border ahead to the border behind. Up to [`LINES_PER_STEP`]
    /// lines after them are moved as well; their states are right only outside the grid.
    #[inline(always)]
    pub(super) fn cross(&mut self, numbers: &Range<isize>, mask: &Mask, row: usize, crossing: &RowCrossing) {
        let steps = numbers.len().div_ceil(LINES_PER_STEP);
        let (states, _) = self.states_from_mut(numbers.start).as_chunks_mut::<LINES_PER_STEP>();
        let (entered, _) = mask.from(row, numbers.start + crossing.entry).as_chunks::<LINES_PER_STEP>();
        let (states, entered) = (&mut states[..steps], &entered[..steps]);
        if crossing.entry == crossing.exit {
            for (states, entered) in states.iter_mut().zip(entered) {
                for (state, &entered) in states.iter_mut().zip(entered) {
                    *state = state.saturating_add(UNITS_PER_ROW) & entered;
                }
            }
        } else {
            let (left, _) = mask.from(row, numbers.start + crossing.exit).as_chunks::<LINES_PER_STEP>();
            for ((states, entered), left) in states.iter_mut().zip(entered).zip(&left[..steps]) {
                for ((state, &entered), &left) in states.iter_mut().zip(entered).zip(left) {
                    let through = state.saturating_add(UNITS_PER_ROW);
                    *state = ((through & left) | (crossing.border & !left)) & entered;
                }
            }
        }
    }
}
