//! The ground of halls with storage, divided into aisles, crossings and open floor.

use super::chains;
use super::fronts::{self, Ground};
use super::strip::{self, Strip};
use crate::geometry::{OrientedBox, Point, line_angle_between};
use crate::grid::OccupancyGrid;
use crate::plot::PlotKind;
use crate::rooms::RoomCells;
use crate::watch::{Stopped, Watch};

/// An aisle reaches this far into the rough front of what stands beside it, metres.
const CONTACT_M: f64 = 0.15;
/// Aisles that cross differ in direction by more than this, radians.
const CROSSING: f64 = 0.5;

/// Divides the ground of a room, `room` from 1, in which `bodies` stand, and adds its parts to the rooms; `main` is the
/// direction of the site, radians.
///
/// # Errors
/// [`Stopped`] when the watch says so.
pub(crate) fn divide(
    grid: &OccupancyGrid,
    rooms: &mut RoomCells,
    room: u32,
    bodies: &[OrientedBox],
    main: f64,
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let ground = |point: Point| match grid.cell_at(point) {
        Some((column, row)) if rooms.cells[row * grid.width() + column] == room => Ground::Free,
        _ => Ground::Closed,
    };
    let mut strips = Vec::new();
    for chain in chains::of_bodies(bodies, main) {
        watch.check()?;
        strips.extend(fronts::strips(&chain, grid.resolution(), ground).into_iter().filter(fronts::is_aisle));
    }
    let mut strips = strip::joined(strips);
    strips.retain(fronts::is_aisle);
    paint(grid, rooms, room, &strips, watch)
}

/// Gives the cells of a room the numbers of new parts: each aisle, all crossings, and what is left as open floor.
fn paint(
    grid: &OccupancyGrid,
    rooms: &mut RoomCells,
    room: u32,
    strips: &[Strip],
    watch: &Watch<'_>,
) -> Result<(), Stopped> {
    let floor = rooms.add_part(PlotKind::OpenFloor);
    let crossing = rooms.add_part(PlotKind::OpenFloor);
    let aisles: Vec<u32> = strips.iter().map(|_| rooms.add_part(PlotKind::Aisle)).collect();
    for cell in rooms.cells.iter_mut().filter(|cell| **cell == room) {
        *cell = floor;
    }
    for (strip, &aisle) in strips.iter().zip(&aisles) {
        watch.check()?;
        let is_crossed = |part: u32| {
            let other = part.checked_sub(aisles[0]).and_then(|number| strips.get(number as usize));
            other.is_some_and(|other| line_angle_between(other.angle, strip.angle) > CROSSING)
        };
        let reaching = Strip { across: [strip.across[0] - CONTACT_M, strip.across[1] + CONTACT_M], ..strip.clone() };
        for (column, row) in grid.cells_within(&reaching.bounds()) {
            let part = &mut rooms.cells[row * grid.width() + column];
            if *part == floor {
                *part = aisle;
            } else if is_crossed(*part) {
                *part = crossing;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;
    use crate::components::{Components, Neighbours};

    /// A hall drawn in characters of 0.5 m, in which whatever is occupied inside is a body, with the parts that its floor is
    /// divided into: a letter for each aisle, `+` for crossings, `.` for open floor.
    fn check(picture: &str, expected: &Expect) {
        const CELLS: usize = 5;
        let small = OccupancyGrid::from_ascii(picture, 0.5);
        let (width, height) = (small.width() * CELLS, small.height() * CELLS);
        let cell = |index: usize| small.row(index / width / CELLS)[index % width / CELLS];
        let grid = OccupancyGrid::new(
            width,
            height,
            crate::grid::GridFrame { resolution: 0.5 / CELLS as f64, origin: Point::origin(), yaw: 0.0 },
            (0..width * height).map(cell).collect(),
        );
        let watch = Watch::unwatched();
        let is_body = |cell: usize| grid.cells()[cell] == crate::grid::Occupancy::Occupied;
        let components = Components::of([width, width * height], Neighbours::Four, is_body, &watch);
        let bodies: Vec<OrientedBox> = components
            .expect("nobody stops it")
            .iter()
            .filter(|component| component.bounds().iter().all(|side| side.start > 0))
            .map(|component| {
                let [columns, rows] = component.bounds().map(|side| [side.start, side.end].map(|end| end as f64));
                let corner = |x: usize, y: usize| Point::new(columns[x], rows[y]) * grid.resolution();
                OrientedBox::around([corner(0, 0), corner(1, 1)], 0.0).expect("two corners")
            })
            .collect();
        let ground = |&cell: &crate::grid::Occupancy| u32::from(cell == crate::grid::Occupancy::Free);
        let mut rooms =
            RoomCells { count: 1, cells: grid.cells().iter().map(ground).collect(), ..RoomCells::default() };
        divide(&grid, &mut rooms, 1, &bodies, 0.0, &watch).expect("nobody stops it");
        let symbol = |column: usize, row: usize| match rooms.cells
            [(row * CELLS + CELLS / 2) * width + column * CELLS + CELLS / 2]
        {
            0 => '#',
            2 => '.',
            3 => '+',
            aisle => char::from(b'a' + (aisle - 4) as u8),
        };
        let line = |row: usize| (0..small.width()).map(|column| symbol(column, row)).collect::<String>();
        let drawn: Vec<String> = (0..small.height()).rev().map(line).collect();
        expected.assert_eq(&(drawn.join("\n") + "\n"));
    }

    #[test]
    fn three_racks_have_aisles_between_them_and_floor_at_their_ends() {
        check(
            "
            ##############################
            #............................#
            #............................#
            #............................#
            #............................#
            #............................#
            #............................#
            #............................#
            #............................#
            #............................#
            #......################......#
            #......################......#
            #............................#
            #............................#
            #............................#
            #......################......#
            #......################......#
            #............................#
            #............................#
            #............................#
            #......################......#
            #......################......#
            #............................#
            #............................#
            ##############################
            ",
            &expect![[r#"
                ##############################
                #......dddddddddddddddd......#
                #......dddddddddddddddd......#
                #......dddddddddddddddd......#
                #......dddddddddddddddd......#
                #......dddddddddddddddd......#
                #......dddddddddddddddd......#
                #......dddddddddddddddd......#
                #......dddddddddddddddd......#
                #......dddddddddddddddd......#
                #......################......#
                #......################......#
                #......cccccccccccccccc......#
                #......cccccccccccccccc......#
                #......cccccccccccccccc......#
                #......################......#
                #......################......#
                #......bbbbbbbbbbbbbbbb......#
                #......bbbbbbbbbbbbbbbb......#
                #......bbbbbbbbbbbbbbbb......#
                #......################......#
                #......################......#
                #......aaaaaaaaaaaaaaaa......#
                #......aaaaaaaaaaaaaaaa......#
                ##############################
            "#]],
        );
    }

    #[test]
    fn blocks_in_one_line_are_a_row() {
        check(
            "
            ##############################
            #............................#
            #............................#
            #......######....######......#
            #......######....######......#
            #......######....######......#
            #......######....######......#
            #......######....######......#
            #......######....######......#
            #............................#
            #............................#
            #......######....######......#
            #......######....######......#
            #......######....######......#
            #......######....######......#
            #......######....######......#
            #......######....######......#
            #............................#
            #............................#
            ##############################
            ",
            &expect![[r#"
                ##############################
                #......cccccccccccccccc......#
                #......cccccccccccccccc......#
                #......######....######......#
                #......######....######......#
                #......######....######......#
                #......######....######......#
                #......######....######......#
                #......######....######......#
                #......bbbbbbbbbbbbbbbb......#
                #......bbbbbbbbbbbbbbbb......#
                #......######....######......#
                #......######....######......#
                #......######....######......#
                #......######....######......#
                #......######....######......#
                #......######....######......#
                #......aaaaaaaaaaaaaaaa......#
                #......aaaaaaaaaaaaaaaa......#
                ##############################
            "#]],
        );
    }
}
