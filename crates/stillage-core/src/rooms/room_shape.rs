//! The shape of a room, and whether it is a corridor.
//!
//! A corridor is a room many times as long as wide with doors along it. Its length is its area by its width, and its
//! width four times the mean distance of its ground to the nearest wall, which is exact for a strip, straight or bent,
//! and for a net of strips. Furniture is no wall here. What a crowded room has of it at its walls still makes it look
//! like a net of strips; but it is neither straight nor bent around other rooms. Cost: O(cells).

use std::collections::{BTreeMap, BTreeSet};

use super::doorways::Doorway;
use super::ground::RoomGround;
use super::room_cells::RoomCells;
use crate::components::{Component, Components, Neighbours};
use crate::distance_transform::DistanceTransform;
use crate::geometry::{OrientedBox, Point, convex_hull, ring_area};
use crate::watch::{Stopped, Watch};

/// Least length of a corridor, in its widths. A square has 2.2, a room three times as long as wide 3.8.
const LEAST_LENGTH: f64 = 4.0;
/// Least number of doorways of a corridor: a room that is only passed through has two.
const LEAST_DOORWAYS: usize = 3;
/// A straight room of more widths is a corridor where it has a doorway at all: no office is six times as long as wide.
const LENGTH_OF_PASSAGES: f64 = 7.0;
/// Greatest share of its convex hull that a corridor fills, unless it is straight. On plain floor plans nets of corridors
/// fill 0.2 to 0.58, crowded rooms of scans 0.65 and more.
const GREATEST_FILL: f64 = 0.65;
/// Long by short side of the box around a straight corridor. No measurement is recorded for this value.
const STRAIGHT: f64 = 3.0;
/// Greatest diagonal of furniture that stands alone, metres: a block of four desks has 3.6.
const FURNITURE_M: f64 = 4.0;
/// Greatest depth of a rack that stands alone, metres: two rows back to back. Rooms between two corridors are deeper.
const RACK_M: f64 = 3.0;
/// Greatest width of a corridor, metres: wider is a hall. No measurement is recorded for this value.
const WIDEST_CORRIDOR_M: f64 = 5.0;

/// Size of a room.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RoomShape {
    /// Cells of its ground.
    pub(super) cells: usize,
    /// Mean width of its strips, cells.
    pub(super) width: f64,
    /// Side of a cell, metres.
    cell: f64,
    /// Area of its convex hull, cells.
    hull: f64,
    /// Long by short side of the smallest box around it.
    elongation: f64,
}

impl RoomShape {
    /// The shapes of all rooms, in their order.
    pub(super) fn of_rooms(
        ground: &RoomGround,
        rooms: &RoomCells,
        doorways: &[Doorway],
        watch: &Watch<'_>,
    ) -> Result<Vec<Self>, Stopped> {
        let is_wall = walls(ground, doorways, watch)?;
        let clearance = DistanceTransform::of(ground.width, ground.is_free.len(), |cell| is_wall[cell], watch)?;
        // First and last cell of each row of each room.
        let mut ends: BTreeMap<(u32, usize), [usize; 2]> = BTreeMap::new();
        let mut shapes = vec![Self { cell: ground.cell, ..Self::default() }; rooms.count + 1];
        for (cell, &room) in rooms.cells.iter().enumerate().filter(|&(cell, _)| ground.is_free[cell]) {
            let shape = &mut shapes[room as usize];
            shape.cells += 1;
            // Walls begin half a cell before the middle of their cells.
            shape.width += f64::from(clearance.squared[cell]).sqrt() - 0.5;
            ends.entry((room, cell / ground.width)).or_insert([cell, cell])[1] = cell;
        }
        let mut outlines: Vec<Vec<Point>> = vec![Vec::new(); shapes.len()];
        for ((room, row), [first, last]) in ends {
            let [left, right] = [first % ground.width, last % ground.width + 1].map(|column| column as f64);
            let corners = [left, right].into_iter().flat_map(|x| [row, row + 1].map(|y| Point::new(x, y as f64)));
            outlines[room as usize].extend(corners);
        }
        for (shape, outline) in shapes.iter_mut().zip(outlines) {
            shape.width *= 4.0 / shape.cells.max(1) as f64;
            shape.hull = ring_area(&convex_hull(&outline));
            shape.elongation = OrientedBox::smallest_around(&outline).elongation();
        }
        shapes.remove(0);
        Ok(shapes)
    }

    /// Whether it is a corridor, given the number of its doorways.
    pub(super) fn is_corridor(&self, doorways: usize) -> bool {
        let length = self.cells as f64 / (self.width * self.width);
        let is_straight = self.elongation >= STRAIGHT;
        let is_strip = is_straight || self.cells as f64 <= GREATEST_FILL * self.hull;
        let is_passage = is_straight && doorways > 0 && length >= LENGTH_OF_PASSAGES;
        let is_long = doorways >= LEAST_DOORWAYS && length >= LEAST_LENGTH && is_strip;
        self.width * self.cell <= WIDEST_CORRIDOR_M && (is_long || is_passage)
    }
}

/// Which cells are neither ground nor furniture; what a door is hung on is a wall.
fn walls(ground: &RoomGround, doorways: &[Doorway], watch: &Watch<'_>) -> Result<Vec<bool>, Stopped> {
    let mut is_wall: Vec<bool> = ground.is_free.iter().map(|is_free| !is_free).collect();
    let cell_at = |[column, row]: [i64; 2]| row as usize * ground.width + column as usize;
    let jambs: BTreeSet<usize> = doorways
        .iter()
        .filter(|doorway| doorway.is_door(ground.cell))
        .flat_map(|door| door.ends)
        .map(cell_at)
        .collect();
    let is_small = |thing: &Component<'_>| {
        thing.diagonal() * ground.cell < FURNITURE_M || thing.smallest_box(ground.cell).sides()[1] <= RACK_M
    };
    let size = [ground.width, is_wall.len()];
    let obstacles = Components::of(size, Neighbours::Eight, |cell| !ground.is_free[cell], watch)?;
    for thing in obstacles.iter().filter(is_small) {
        if !thing.cells().any(|cell| jambs.contains(&cell)) {
            thing.cells().for_each(|cell| is_wall[cell] = false);
        }
    }
    Ok(is_wall)
}
