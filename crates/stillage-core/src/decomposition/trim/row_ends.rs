//! Which pieces of the rows are no places.
//!
//! - Ground outside the site holds no goods: the comb runs on behind walls, where a robot looked out of a door.
//! - Passages that several rows share are no places ([`super::passages`]). A gap that no other row shares leads nowhere:
//!   a few empty places. So is a bare piece between places that is as wide as they are.
//! - A row of goods ends where its last sign does, and no row goes through a wall: bare pieces beyond are open floor.
//!
//! Cost: O(cells of the rows). Limits: an empty place at the end of a row without a post is given up, since nothing
//! tells it from floor.

use std::collections::BTreeMap;
use std::ops::Range;

use super::passages;
use crate::decomposition::ground::{Axis, Cell, RegionFrame};
use crate::decomposition::plot::{Parcel, PlotKind};

/// Share of a piece that must lie in the site: goods hide as much of their place where they are seen from one side
/// only.
const SITE_SHARE: f64 = 0.3;
/// The same where most of the row lies in the site, and only its end is seen badly.
const SITE_SHARE_OF_END: f64 = 0.1;
const MAJORITY: f64 = 0.5;
/// What reaches this far into a piece from its inner neighbour is the neighbour's: overhang and drift, metres.
const OVERHANG_M: f64 = 0.25;
/// A post at the outer border of a piece may stand so far beyond it, metres.
const POST_REACH_M: f64 = 0.1;
/// Less than this is no post, square metres: two cells of 5 cm.
const LEAST_POST_M2: f64 = 0.005;
/// A piece with more of it unknown than this may hold anything.
const UNSEEN_SHARE: f64 = 0.2;
/// A piece is a place when its width differs by less than this share from that of the places beside it.
const LIKE_PLACE: f64 = 0.3;
/// More places than this are not empty side by side, or behind one another: three of ten are on a site with room.
const MOST_EMPTY: usize = 3;
/// A wall runs on before the row, metres, and is seen along this share of its length.
const BEFORE_ROW_M: f64 = 1.4;
const WALL_SHARE: f64 = 0.75;
/// What a wall may be off the line across a row, metres.
const WALL_WIDTH_M: f64 = 0.1;

/// Ends the rows; other parcels stay as they are.
pub(super) fn end(frame: &RegionFrame, parcels: Vec<Parcel>) -> Vec<Parcel> {
    let is_of_row = |one: &Parcel| one.axis.is_some() && !matches!(one.kind, PlotKind::Aisle | PlotKind::OpenFloor);
    let (pieces, mut ended): (Vec<Parcel>, Vec<Parcel>) = parcels.into_iter().partition(is_of_row);
    for axis in Axis::BOTH {
        let mut rows = PieceRow::all(pieces.iter().filter(|piece| piece.axis == Some(axis)), axis);
        for row in &mut rows {
            row.leave_out(frame);
        }
        let passages = passages::find(frame, &rows);
        for row in &mut rows {
            row.fill(frame);
        }
        passages::open(frame, &mut rows, passages);
        for row in rows {
            row.end(frame, &mut ended);
        }
    }
    ended
}

/// Pieces that follow one another.
pub(super) struct PieceRow {
    pub axis: Axis,
    pub across: Range<usize>,
    pub pieces: Vec<Parcel>,
}

impl PieceRow {
    fn all<'a>(pieces: impl Iterator<Item = &'a Parcel>, axis: Axis) -> Vec<Self> {
        let mut bands: BTreeMap<(usize, usize), Vec<Parcel>> = BTreeMap::new();
        for piece in pieces {
            let across = piece.rect.range(axis.other());
            bands.entry((across.start, across.end)).or_default().push(piece.clone());
        }
        let mut rows = Vec::new();
        for ((start, end), mut pieces) in bands {
            pieces.sort_by_key(|piece| piece.rect.range(axis).start);
            for row in pieces.chunk_by(|one, next| one.rect.range(axis).end == next.rect.range(axis).start) {
                rows.push(Self { axis, across: start..end, pieces: row.to_vec() });
            }
        }
        rows
    }

    pub(super) fn along(&self, piece: &Parcel) -> Range<usize> {
        piece.rect.range(self.axis).clone()
    }

    /// Takes the pieces outside the site for what they are.
    fn leave_out(&mut self, frame: &RegionFrame) {
        let mut places: Vec<&mut Parcel> = self.pieces.iter_mut().filter(|one| one.kind == PlotKind::Place).collect();
        let shares: Vec<f64> = places.iter().map(|place| frame.share(&place.rect, Cell::is_inside)).collect();
        let is_end = shares.iter().sum::<f64>() > MAJORITY * shares.len() as f64;
        let least = if is_end { SITE_SHARE_OF_END } else { SITE_SHARE };
        for (place, share) in places.iter_mut().zip(shares) {
            if share < least {
                place.kind = PlotKind::Other;
            }
        }
    }

    /// Makes empty places of the gaps between places, and of bare pieces that are as wide as places.
    fn fill(&mut self, frame: &RegionFrame) {
        let mut widths: Vec<usize> =
            self.pieces.iter().filter(|one| one.kind == PlotKind::Place).map(|one| self.along(one).len()).collect();
        widths.sort_unstable();
        let Some(&width) = widths.get(widths.len() / 2).filter(|&&width| width > 0) else { return };
        let axis = self.axis;
        let is_place = |index: usize| self.pieces.get(index).is_some_and(|piece| piece.kind == PlotKind::Place);
        let mut filled = Vec::with_capacity(self.pieces.len());
        for (index, piece) in self.pieces.iter().enumerate() {
            let along = self.along(piece);
            let count = (along.len() as f64 / width as f64).round() as usize;
            let is_few = count > 0 && count * piece.layers.len().max(1) <= MOST_EMPTY;
            let is_alike = (along.len() as f64 - width as f64).abs() < LIKE_PLACE * width as f64;
            let is_between = index > 0 && is_place(index - 1) && is_place(index + 1);
            let is_empty = match piece.kind {
                PlotKind::Passage => is_few,
                PlotKind::Other => is_few && is_alike && self.is_bare(frame, piece, true, &[]),
                _ => false,
            };
            if !is_between || !is_empty {
                filled.push(piece.clone());
                continue;
            }
            let border = |number: usize| along.start + number * along.len() / count;
            filled.extend((0..count).map(|number| Parcel {
                rect: piece.rect.with(axis, border(number)..border(number + 1)),
                kind: PlotKind::Place,
                ..piece.clone()
            }));
        }
        self.pieces = filled;
    }

    /// Makes open floor of the bare pieces at both ends, and before and behind every wall.
    fn end(self, frame: &RegionFrame, ended: &mut Vec<Parcel>) {
        if self.pieces.iter().all(|piece| piece.kind != PlotKind::Place) {
            ended.extend(self.pieces);
            return;
        }
        let start = self.along(&self.pieces[0]).start;
        let is_wall = self.walls(frame);
        let walls = |piece: &Parcel| {
            let along = self.along(piece);
            along.start - start..along.end - start
        };
        let has_wall = |piece: &Parcel| is_wall[walls(piece)].contains(&true);
        for part in self.pieces.chunk_by(|piece, next| !has_wall(piece) && !has_wall(next)) {
            let is_bare = |piece: &&Parcel, is_low| self.is_bare(frame, piece, is_low, &is_wall[walls(piece)]);
            let low = part.iter().take_while(|piece| is_bare(piece, true)).count();
            let high = part[low..].iter().rev().take_while(|piece| is_bare(piece, false)).count();
            let (before, rest) = part.split_at(low);
            let (within, after) = rest.split_at(rest.len() - high);
            ended.extend(within.iter().cloned());
            for floor in [before, after] {
                if let [first, .., last] | [first @ last] = floor {
                    let along = self.along(first).start..self.along(last).end;
                    ended.push(Parcel::new(
                        first.rect.with(self.axis, along),
                        PlotKind::OpenFloor,
                        Some(self.axis.other()),
                    ));
                }
            }
        }
    }

    /// Whether nothing shows a piece that the row ends with, on its low or high side.
    fn is_bare(&self, frame: &RegionFrame, piece: &Parcel, is_low: bool, is_wall: &[bool]) -> bool {
        let along = self.along(piece);
        let (reach, overhang) = (frame.cells_of(POST_REACH_M), frame.cells_of(OVERHANG_M).min(along.len() / 2));
        let most = frame.whole().range(self.axis).end;
        // What lies behind a wall is none of its business.
        let seen = if is_low {
            let wall = is_wall.iter().rposition(|&is_wall| is_wall);
            wall.map_or(along.start.saturating_sub(reach), |wall| along.start + wall + 1)..along.end - overhang
        } else {
            let wall = is_wall.iter().position(|&is_wall| is_wall);
            along.start + overhang..wall.map_or((along.end + reach).min(most), |wall| along.start + wall)
        };
        let seen = piece.rect.with(self.axis, seen.start.min(seen.end)..seen.end);
        let occupied = frame.count(&seen, Cell::is_occupied) as f64 * frame.cell * frame.cell;
        occupied < LEAST_POST_M2 && frame.share(&seen, Cell::is_unknown) <= UNSEEN_SHARE
    }

    /// For every line across the row whether it is a wall, which is seen before the row as well.
    fn walls(&self, frame: &RegionFrame) -> Vec<bool> {
        let along = self.along(&self.pieces[0]).start..self.along(&self.pieces[self.pieces.len() - 1]).end;
        let before = frame.cells_of(BEFORE_ROW_M);
        let end = frame.whole().range(self.axis.other()).end;
        let across = self.across.start.saturating_sub(before)..(self.across.end + before).min(end);
        let lines = frame.patch(&self.pieces[0].rect.with(self.axis.other(), across).with(self.axis, along), self.axis);
        let thick = frame.cells_of(WALL_WIDTH_M);
        let (mut ground, mut seen) = (vec![0_usize; lines.width], vec![0_usize; lines.width]);
        for row in 0..lines.height {
            let mut marked = 0;
            for (line, cell) in lines.row(row).iter().enumerate() {
                ground[line] += usize::from(cell.is_inside());
                if cell.is_occupied() {
                    let reach = line.saturating_sub(thick).max(marked)..(line + thick + 1).min(lines.width);
                    marked = reach.end;
                    seen[reach].iter_mut().for_each(|seen| *seen += 1);
                }
            }
        }
        let least = self.across.len();
        let is_wall = |(ground, seen): (usize, usize)| ground > least && seen as f64 >= WALL_SHARE * ground as f64;
        ground.into_iter().zip(seen).map(is_wall).collect()
    }
}
