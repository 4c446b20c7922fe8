//! Which pieces of the rows are no places.
//!
//! - Pieces outside the site hold no goods. The comb divides ground behind walls as well, where a robot looked out of a door.
//! - A passage that several rows share is none ([`super::passages`]). A passage that no other row shares leads nowhere: it
//!   is a few empty places. So is a bare piece between places that is as wide as they are.
//! - A row ends with its last goods, and no row goes through a wall: bare pieces beyond are open floor.
//!
//! Cost: O(cells of the rows). Limits: an empty place at the end of a row without a post is given up, since it looks
//! like floor.

use super::passages::Passages;
use super::piece_row::PieceRow;
use crate::decomposition::ground::{Axis, Cell, RegionFrame};
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

/// Share of a piece that must lie in the site: the rest may be hidden by its own goods, where these are seen from one side
/// only.
const SITE_SHARE: f64 = 0.3;
/// The same where the pieces of the row lie in the site by more than [`MAJORITY`] on average, and only its end is seen
/// badly.
const SITE_SHARE_OF_END: f64 = 0.1;
const MAJORITY: f64 = 0.5;
/// What reaches this far into a piece from its inner neighbour belongs to the neighbour, metres: overhang and drift.
const OVERHANG_M: f64 = 0.25;
/// A post at the outer border of a piece may stand this far beyond it, metres.
const POST_REACH_M: f64 = 0.1;
/// A smaller occupied area is no post, square metres: two cells of 5 cm.
const LEAST_POST_M2: f64 = 0.005;
/// A piece with a greater unknown share than this is not taken for empty.
const UNSEEN_SHARE: f64 = 0.2;
/// A piece is as wide as a place if its width differs by less than this share from the median of the places of its row.
const LIKE_PLACE: f64 = 0.3;
/// Most places that are taken for empty side by side, or behind one another: on a site with room, three of ten places
/// are empty.
const MOST_EMPTY: usize = 3;
/// A wall runs on before the row for this distance, metres, and is seen along this share of its length.
const BEFORE_ROW_M: f64 = 1.4;
const WALL_SHARE: f64 = 0.75;
/// Offset of a wall from a line across the row, metres, at most.
const WALL_WIDTH_M: f64 = 0.1;

/// Trims the rows; other parcels stay as they are and come first.
pub(super) fn trimmed(frame: &RegionFrame, parcels: Vec<Parcel>, watch: &Watch<'_>) -> Result<Vec<Parcel>, Stopped> {
    let is_of_row = |one: &Parcel| one.axis.is_some() && !matches!(one.kind, PlotKind::Aisle | PlotKind::OpenFloor);
    let (pieces, mut trimmed): (Vec<Parcel>, Vec<Parcel>) = parcels.into_iter().partition(is_of_row);
    for axis in Axis::BOTH {
        let mut rows = PieceRow::all(pieces.iter().filter(|piece| piece.axis == Some(axis)), axis);
        for row in &mut rows {
            watch.check()?;
            row.leave_out_what_is_outside(frame);
        }
        let passages = Passages::find(frame, &rows, watch)?;
        for row in &mut rows {
            watch.check()?;
            row.fill_empty_places(frame);
        }
        passages.open(frame, &mut rows, watch)?;
        for row in rows {
            watch.check()?;
            row.trim(frame, &mut trimmed);
        }
    }
    Ok(trimmed)
}

impl PieceRow {
    /// Pieces outside the site are no places.
    fn leave_out_what_is_outside(&mut self, frame: &RegionFrame) {
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

    /// Makes empty places of the passages between places, and of bare pieces that are as wide as places.
    fn fill_empty_places(&mut self, frame: &RegionFrame) {
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
    fn trim(self, frame: &RegionFrame, trimmed: &mut Vec<Parcel>) {
        if !self.holds_places() {
            trimmed.extend(self.pieces);
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
            trimmed.extend(within.iter().cloned());
            for floor in [before, after] {
                if let [first, .., last] | [first @ last] = floor {
                    let along = self.along(first).start..self.along(last).end;
                    trimmed.push(Parcel::new(
                        first.rect.with(self.axis, along),
                        PlotKind::OpenFloor,
                        Some(self.axis.other()),
                    ));
                }
            }
        }
    }

    /// Whether a piece at the low or the high end of the row holds nothing, and is seen well enough to say so.
    fn is_bare(&self, frame: &RegionFrame, piece: &Parcel, is_low: bool, is_wall: &[bool]) -> bool {
        let along = self.along(piece);
        let (reach, overhang) = (frame.cells_of(POST_REACH_M), frame.cells_of(OVERHANG_M).min(along.len() / 2));
        let most = frame.whole().range(self.axis).end;
        // What lies behind a wall does not belong to the piece.
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

    /// For every line across the row, whether it is a wall; that is seen before the row as well.
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
