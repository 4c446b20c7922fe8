//! Gates: the doorways of bays, which jut out of a building, such as a trailer at its dock.
//!
//! A bay is as wide as its gate, so there is no neck before it and [`super::doorways`] finds none.  But it juts out.
//! Method: the site as a whole, with all that stands in it, is opened by a disc wider than a gate (G. Matheron 1975). A
//! part that the disc does not cover is a bay when it has walls at its sides and is empty. Its gate is the last line
//! across on the way from its middle to the hall before the walls at its sides end.
//!
//! Cost: O(cells), nearly all of it in coarse cells of a quarter of a metre. Limits: a wing of the building that is as
//! narrow and holds nothing is a bay; of two gates of one bay, the one towards its middle is found.

use super::doorways::{Doorway, WIDEST_M};
use super::ground::RoomGround;
use crate::components::{Component, Components, Neighbours};
use crate::distance_transform::DistanceTransform;
use crate::geometry::{OrientedBox, Point, Vector, direction};
use crate::grid::{Occupancy, OccupancyGrid};
use crate::site_ground::CoarseGrid;
use crate::watch::{Stopped, Watch};

/// Diameter of the disc, metres: a gate and the walls beside it.
const DISC_M: f64 = WIDEST_M + 0.5;
/// Least area of a bay, square metres: smaller are the corners of the building that a disc does not cover, and doors
/// that lie back in their wall.
const LEAST_BAY_M2: f64 = 4.0;
/// Least share of the sides of a bay that is wall and not unknown: unknown sides are where the scanner saw no further.
const WALL_SHARE: f64 = 0.7;
/// Least share of the width of a bay that is empty across its middle. No measurement is recorded for this value.
const EMPTY_SHARE: f64 = 0.75;
/// Greatest width of a line across a bay in widths of its middle; a wider one lies outside, before the gate. No
/// measurement is recorded for this value.
const WIDENING: f64 = 1.25;

/// Finds the gates of all bays.
pub(super) fn find(grid: &OccupancyGrid, ground: &RoomGround, watch: &Watch<'_>) -> Result<Vec<Doorway>, Stopped> {
    let blocks = CoarseGrid::of(grid, watch)?;
    let reach = DISC_M / 2.0 / (blocks.side as f64 * grid.resolution());
    let count = blocks.is_outside.len();
    let is_far = |from: &DistanceTransform, block: usize| f64::from(from.squared[block]) > reach * reach;
    let outside = DistanceTransform::of(blocks.columns, count, |block| blocks.is_outside[block], watch)?;
    let discs = DistanceTransform::of(blocks.columns, count, |block| is_far(&outside, block), watch)?;
    let juts_out = |block: usize| !blocks.is_outside[block] && is_far(&discs, block);
    let found = Components::of([blocks.columns, count], Neighbours::Four, juts_out, watch)?;
    let least = LEAST_BAY_M2 / (blocks.side as f64 * grid.resolution()).powi(2);
    let large = found.iter().filter(|component| component.len() as f64 >= least);
    Ok(large.filter_map(|component| gate(grid, ground, &blocks, component, juts_out)).collect())
}

/// The gate of a part that juts out, if it is a bay.
fn gate(
    grid: &OccupancyGrid,
    ground: &RoomGround,
    blocks: &CoarseGrid,
    component: Component<'_>,
    juts_out: impl Fn(usize) -> bool,
) -> Option<Doorway> {
    let mut floor = Vec::new();
    let (mut walls, mut unseen) = (0_usize, 0_usize);
    for (column, row) in component.cells().flat_map(|block| cells_of(blocks, block)) {
        if ground.holds(column, row) {
            floor.push(Point::new(column as f64 + 0.5, row as f64 + 0.5));
            for (across, up) in [(-1, 0), (1, 0), (0, -1), (0, 1)] {
                match grid.at(column + across, row + up) {
                    Occupancy::Occupied => walls += 1,
                    Occupancy::Unknown => unseen += 1,
                    Occupancy::Free => {}
                }
            }
        }
    }
    if floor.is_empty() || (walls as f64) < WALL_SHARE * (walls + unseen) as f64 {
        return None;
    }
    let shape = OrientedBox::smallest_around(&floor);
    let middle = middle(&floor);
    let hall = middle_of_neighbours(blocks, component, juts_out)?;
    let inwards = [0.0, 1.0, 2.0, 3.0]
        .map(|quarter| direction(shape.angle + quarter * std::f64::consts::FRAC_PI_2))
        .into_iter()
        .max_by(|one, other| one.dot(&(hall - middle)).total_cmp(&other.dot(&(hall - middle))))?;
    gate_towards(ground, middle, inwards, &shape)
}

/// Walks from the middle of a bay to its gate, in cells.
fn gate_towards(ground: &RoomGround, middle: Point, inwards: Vector, shape: &OrientedBox) -> Option<Doorway> {
    let most = DISC_M / ground.cell;
    let across = Vector::new(-inwards.y, inwards.x);
    let line = |step: usize| {
        let place = middle + inwards * step as f64;
        let [left, right] = [across, -across].map(|way| wall(ground, place, way, most));
        let (left, right) = (left?, right?);
        // A place that is no ground has both its walls at itself: the walk ends there, at the latest at the map's end.
        let width = (right - left).norm();
        (width > 0.0).then_some(([left, right], width))
    };
    let (first, width) = line(0)?;
    let narrow_side = usize::from(inwards.dot(&direction(shape.angle)).abs() > 0.5);
    if width < EMPTY_SHARE * shape.sides()[narrow_side] {
        return None;
    }
    let is_within = |(_, here): &([Point; 2], f64)| *here <= WIDENING * width && *here <= most;
    let mut ends = first;
    let mut step = 1;
    while let Some((further, _)) = line(step).filter(is_within) {
        (ends, step) = (further, step + 1);
    }
    // Without ground before the gate, the map ends there.
    let before = middle + inwards * step as f64;
    ground.holds(before.x.floor() as i64, before.y.floor() as i64).then_some(())?;
    Some(Doorway { ends: ends.map(|end| [end.x.floor() as i64, end.y.floor() as i64]), wall_ends: 2 })
}

/// The first place in a direction that is no ground; `None` within `most` cells.
fn wall(ground: &RoomGround, from: Point, way: Vector, most: f64) -> Option<Point> {
    let places = (0..=2 * most.ceil() as usize).map(|step| from + way * (step as f64 / 2.0));
    places.into_iter().find(|place| !ground.holds(place.x.floor() as i64, place.y.floor() as i64))
}

/// Columns and rows of the cells of a coarse cell.
fn cells_of(blocks: &CoarseGrid, block: usize) -> impl Iterator<Item = (i64, i64)> + use<> {
    let (side, columns) = (blocks.side, blocks.columns);
    let (column, row) = (block % columns * side, block / columns * side);
    (row..row + side).flat_map(move |row| (column..column + side).map(move |column| (column as i64, row as i64)))
}

/// The mean place of the coarse cells of the site beside a part that juts out, cells.
fn middle_of_neighbours(
    blocks: &CoarseGrid,
    component: Component<'_>,
    juts_out: impl Fn(usize) -> bool,
) -> Option<Point> {
    let (columns, count) = (blocks.columns, blocks.is_outside.len());
    let beside = |block: usize| {
        let left = (!block.is_multiple_of(columns)).then(|| block - 1);
        let right = (!(block + 1).is_multiple_of(columns)).then_some(block + 1);
        [left, right, block.checked_sub(columns), Some(block + columns).filter(|&block| block < count)]
    };
    let center = |block: usize| {
        let [column, row] = [block % columns, block / columns].map(|place| (place as f64 + 0.5) * blocks.side as f64);
        Point::new(column, row)
    };
    let of_hall = component.cells().flat_map(beside).flatten();
    let of_hall: Vec<Point> =
        of_hall.filter(|&block| !blocks.is_outside[block] && !juts_out(block)).map(center).collect();
    (!of_hall.is_empty()).then(|| middle(&of_hall))
}

fn middle(points: &[Point]) -> Point {
    Point::from(points.iter().map(|point| point.coords).sum::<Vector>() / points.len() as f64)
}
