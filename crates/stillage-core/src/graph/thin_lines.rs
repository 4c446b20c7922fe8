//! Thinned ground as lines between the cells where lines meet or begin.

use std::collections::BTreeMap;

use super::thinning::{around, thinned};

/// The lines of thinned ground.
pub(super) struct ThinLines {
    /// Cells where lines meet or end, beside the anchors.
    pub meetings: Vec<usize>,
    /// The lines between ends. An end is an anchor by its index, or a meeting, counted after the anchors.
    pub between: Vec<ThinLine>,
}

/// A line between two ends.
pub(super) struct ThinLine {
    pub ends: [usize; 2],
    /// The cells between the ends, in their order.
    pub cells: Vec<usize>,
}

/// A picture of thinned ground whose lines are being followed.
struct Follower {
    around: [isize; 8],
    remains: Vec<bool>,
    /// By cell of a meeting or an anchor: its end.
    ends: BTreeMap<usize, usize>,
    /// Cells of lines that were followed.
    is_followed: Vec<bool>,
    lines: ThinLines,
}

impl ThinLines {
    /// Thins ground, whose `room` is given by cell, to lines that join anchors: cells of the ground, `None` for an anchor that
    /// lies nowhere.
    pub fn of(width: usize, room: &[u16], anchors: &[Option<usize>]) -> Self {
        let cells: Vec<usize> = anchors.iter().flatten().copied().collect();
        let remains = thinned(width, room, &cells);
        let is_followed = vec![false; remains.len()];
        let lines = Self { meetings: Vec::new(), between: Vec::new() };
        let mut follower = Follower { around: around(width), remains, ends: BTreeMap::new(), is_followed, lines };
        follower.find_ends(room, anchors);
        follower.follow_all(anchors.len());
        follower.lines
    }
}

impl Follower {
    fn beside(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        self.around.into_iter().map(move |by| cell.wrapping_add_signed(by)).filter(|&other| self.remains[other])
    }

    /// Finds the cells that are anchors or have other than two neighbours. Those side by side are one end.
    fn find_ends(&mut self, room: &[u16], anchors: &[Option<usize>]) {
        let mut by_cell: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (anchor, cell) in anchors.iter().enumerate() {
            by_cell.entry(cell.unwrap_or(usize::MAX)).or_default().push(anchor);
        }
        by_cell.remove(&usize::MAX);
        let is_end =
            |cell: usize| self.remains[cell] && (by_cell.contains_key(&cell) || self.beside(cell).count() != 2);
        let mut found: Vec<Vec<usize>> = Vec::new();
        let mut is_seen = vec![false; self.remains.len()];
        for start in (0..self.remains.len()).filter(|&cell| self.remains[cell]) {
            if is_seen[start] || !is_end(start) {
                continue;
            }
            let mut cluster = vec![start];
            is_seen[start] = true;
            let mut next = 0;
            while let Some(&cell) = cluster.get(next) {
                next += 1;
                let beside: Vec<usize> = self.beside(cell).filter(|&other| !is_seen[other] && is_end(other)).collect();
                for &other in &beside {
                    is_seen[other] = true;
                }
                cluster.extend(beside);
            }
            found.push(cluster);
        }
        for cluster in found {
            let attached: Vec<usize> = cluster.iter().filter_map(|cell| by_cell.get(cell)).flatten().copied().collect();
            let end = attached.first().copied().unwrap_or_else(|| {
                let widest = cluster.iter().copied().max_by_key(|&cell| (room[cell], usize::MAX - cell));
                self.lines.meetings.extend(widest);
                anchors.len() + self.lines.meetings.len() - 1
            });
            let others = attached.into_iter().skip(1);
            self.lines.between.extend(others.map(|other| ThinLine { ends: [end, other], cells: Vec::new() }));
            self.ends.extend(cluster.into_iter().map(|cell| (cell, end)));
        }
    }

    fn follow_all(&mut self, anchors: usize) {
        let starts: Vec<(usize, usize)> = self.ends.iter().map(|(&cell, &end)| (cell, end)).collect();
        for (cell, end) in starts {
            self.follow_from(cell, end);
        }
        // What is left are rings on which nothing lies: each gets an end.
        for cell in 0..self.remains.len() {
            if self.remains[cell] && !self.is_followed[cell] && !self.ends.contains_key(&cell) {
                self.lines.meetings.push(cell);
                let end = anchors + self.lines.meetings.len() - 1;
                self.ends.insert(cell, end);
                self.follow_from(cell, end);
            }
        }
    }

    /// Follows the lines that begin beside a cell.
    fn follow_from(&mut self, start: usize, end: usize) {
        let firsts: Vec<usize> = self.beside(start).collect();
        for first in firsts {
            if self.is_followed[first] || self.ends.contains_key(&first) {
                continue;
            }
            let (mut before, mut cell, mut cells) = (start, first, Vec::new());
            let last = loop {
                self.is_followed[cell] = true;
                cells.push(cell);
                // A cell between ends has two neighbours: the one before and the next one.
                let Some(next) = self.beside(cell).find(|&other| other != before) else { break None };
                if let Some(&last) = self.ends.get(&next) {
                    break Some(last);
                }
                (before, cell) = (cell, next);
            };
            if let Some(last) = last {
                self.lines.between.push(ThinLine { ends: [end, last], cells });
            }
        }
    }
}
