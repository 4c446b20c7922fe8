//! Passages: straight strips of ground between two walls that face each other.
//!
//! Rooms may open into a corridor over their whole front, where no doorway parts them. A person still sees the corridor,
//! because its walls go on in one line beyond the opening. So strips are followed from where both walls are seen for as
//! long as enough of either is seen, and the ground beside their openings is parted from them.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`cross_lines`] | the ground on every line across a direction, with the walls at its ends |
//! | [`strip`] | strips of ground between two walls |
//! | [`openings`] | where the sides and the ends of a strip are open |
//!
//! Whatever is built on both sides of a strip is a wall, and no furniture. Cost: O(cells). Limits: passages run along the
//! two directions of the site; a bend is where one ends and the next one begins.

mod cross_lines;
mod openings;
mod strip;

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

use self::openings::Opening;
use self::strip::PassageStrip;
use super::doorways::Doorway;
use super::ground::{Jambs, RoomGround};
use super::partition::Partition;
use crate::geometry::DisjointSets;
use crate::watch::{Stopped, Watch};

/// The passages of a site.
pub(super) struct RoomPassages {
    strips: Vec<PassageStrip>,
    openings: Vec<Opening>,
    /// Pairs of neighbouring cells of the walls of passages.
    pub walls: Vec<Jambs>,
}

impl RoomPassages {
    /// Finds the passages along and across a direction of the site, `angle` in radians.
    pub(super) fn of(ground: &RoomGround, angle: f64, watch: &Watch<'_>) -> Result<Self, Stopped> {
        let mut strips = Vec::new();
        for angle in [angle, angle + FRAC_PI_2] {
            let lines = cross_lines::find(ground, angle, watch)?;
            strips.extend(strip::find(&lines, angle, ground.cell, watch)?);
        }
        let (mut openings, mut walls) = (Vec::new(), Vec::new());
        for (number, strip) in strips.iter().enumerate() {
            watch.check()?;
            openings::find(ground, strip, number, &mut openings, &mut walls);
        }
        // Where two passages meet, their ground is one.
        openings.retain(|opening| {
            let is_other = |&(number, _): &(usize, &PassageStrip)| number != opening.passage;
            !strips.iter().enumerate().filter(is_other).any(|(_, strip)| strip.is_met_at(opening.outside))
        });
        Ok(Self { strips, openings, walls })
    }

    /// The ground with all openings of the passages closed, by lines two cells wide: no step aslant leads through them.
    pub(super) fn closed(&self, ground: &RoomGround) -> RoomGround {
        let mut closed = ground.clone();
        for cell in self.closings().flat_map(|jambs| ground.cells_between(&jambs)) {
            closed.is_free[cell..].iter_mut().take(2).for_each(|is_free| *is_free = false);
        }
        closed
    }

    /// Whether a doorway leads across a passage and is about as wide: then it parts nothing.
    pub(super) fn are_crossed_by(&self, ground: &RoomGround, doorway: &Doorway) -> bool {
        let ends = doorway.ends.map(|cell| ground.middle_of(cell));
        self.strips.iter().any(|strip| strip.is_crossed_by(ends))
    }

    /// Joins the arms of passages to them in a partition for which all openings were closed, and gives the doorways that are
    /// left between a room and a passage; `doorways` are all others of the site.
    pub(super) fn join_arms(
        &self,
        ground: &RoomGround,
        doorways: &[Doorway],
        partition: &mut Partition,
    ) -> Vec<Doorway> {
        let as_doorway = |opening: &Opening| Doorway { ends: opening.jambs, wall_ends: 2 };
        let sides_of = |opening: &Opening| partition.sides(ground, &as_doorway(opening));
        let mut areas = vec![0.0; partition.count + 1];
        for (&room, _) in partition.rooms.iter().zip(&ground.is_free).filter(|&(_, &is_free)| is_free) {
            areas[room as usize] += ground.cell * ground.cell;
        }
        // Ways into each room; all openings to one side of a passage are one.
        let mut ways = vec![0; partition.count + 1];
        for doorway in doorways {
            partition.sides(ground, doorway).into_iter().for_each(|room| ways[room as usize] += 1);
        }
        let mut met = BTreeSet::new();
        for opening in &self.openings {
            for room in sides_of(opening) {
                ways[room as usize] += usize::from(met.insert((room, opening.passage, opening.is_left)));
            }
        }
        let (mut parting, mut joined) = (Vec::new(), DisjointSets::new(partition.count + 1));
        for opening in &self.openings {
            let sides = sides_of(opening);
            if sides[0] == sides[1] || sides.contains(&0) {
                continue;
            }
            let outside = if opening.is_left { sides[0] } else { sides[1] };
            let is_outside = |cell: usize| partition.rooms[cell] == outside;
            let is_arm = !opening.is_end
                && ways[outside as usize] > 1
                && opening.leads_into_arm(ground, areas[outside as usize], is_outside);
            if is_arm {
                joined.join(sides[0] as usize, sides[1] as usize);
            } else {
                parting.push(as_doorway(opening));
            }
        }
        partition.join(&mut joined);
        parting
    }

    /// The lines between jambs that close all openings, and along the walls.
    pub(super) fn closings(&self) -> impl Iterator<Item = Jambs> {
        self.openings.iter().map(|opening| opening.jambs).chain(self.walls.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::super::FloorPlan;
    use crate::grid::{Occupancy, OccupancyGrid};
    use crate::watch::Watch;

    /// The rooms of a site, a letter each; a cell is 0.5 m.
    fn check(picture: &str, expected: &Expect) {
        let grid = OccupancyGrid::from_ascii(picture, 0.5);
        let watch = Watch::unwatched();
        let plan = FloorPlan::of(&grid, 0.0, &watch).expect("nobody stops it");
        let rooms = plan.all_rooms();
        let symbol = |(&room, &cell): (&u32, &Occupancy)| match cell {
            Occupancy::Free => char::from(b'a' + room.wrapping_sub(1) as u8),
            _ => '#',
        };
        let symbols: Vec<char> = rooms.cells.iter().zip(grid.cells()).map(symbol).collect();
        let rows: Vec<String> = symbols.chunks(grid.width()).rev().map(String::from_iter).collect();
        expected.assert_eq(&(rows.join("\n") + "\n"));
    }

    #[test]
    fn a_room_that_is_open_over_its_whole_front_is_no_part_of_the_corridor() {
        check(
            "
            ####################################
            #..........#..........#............#
            #..........#..........#............#
            #..........#..........#............#
            #..........#..........#............#
            #..........#..........#............#
            #..........#..........#............#
            ####..######..........########..####
            #..................................#
            #..................................#
            #..................................#
            #..................................#
            ####################################
            ",
            &expect![[r#"
                ####################################
                #bbbbbbbbbb#cccccccccc#dddddddddddd#
                #bbbbbbbbbb#cccccccccc#dddddddddddd#
                #bbbbbbbbbb#cccccccccc#dddddddddddd#
                #bbbbbbbbbb#cccccccccc#dddddddddddd#
                #bbbbbbbbbb#cccccccccc#dddddddddddd#
                #bbbbbbbbbb#cccccccccc#dddddddddddd#
                ####aa######aaaaaaaaaa########aa####
                #aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa#
                #aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa#
                #aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa#
                #aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa#
                ####################################
            "#]],
        );
    }

    #[test]
    fn an_arm_between_two_corridors_joins_them_and_a_hall_at_their_end_is_a_room() {
        check(
            "
            ##################################################
            #........................#.......................#
            #................................................#
            #................................................#
            #................................................#
            ##############....########.......................#
            #............#....#......#.......................#
            #............#....#......#.......................#
            #............#....#......#.......................#
            #............#....#......#.......................#
            ##############....########.......................#
            #........................#.......................#
            #........................#.......................#
            #........................#.......................#
            #........................#.......................#
            ##################################################
            ",
            &expect![[r#"
                ##################################################
                #aaaaaaaaaaaaaaaaaaaaaaaa#bbbbbbbbbbbbbbbbbbbbbbb#
                #aaaaaaaaaaaaaaaaaaaaaaaabbbbbbbbbbbbbbbbbbbbbbbb#
                #aaaaaaaaaaaaaaaaaaaaaaaabbbbbbbbbbbbbbbbbbbbbbbb#
                #aaaaaaaaaaaaaaaaaaaaaaaabbbbbbbbbbbbbbbbbbbbbbbb#
                ##############aaaa########bbbbbbbbbbbbbbbbbbbbbbb#
                #cccccccccccc#aaaa#dddddd#bbbbbbbbbbbbbbbbbbbbbbb#
                #cccccccccccc#aaaa#dddddd#bbbbbbbbbbbbbbbbbbbbbbb#
                #cccccccccccc#aaaa#dddddd#bbbbbbbbbbbbbbbbbbbbbbb#
                #cccccccccccc#aaaa#dddddd#bbbbbbbbbbbbbbbbbbbbbbb#
                ##############aaaa########bbbbbbbbbbbbbbbbbbbbbbb#
                #aaaaaaaaaaaaaaaaaaaaaaaa#bbbbbbbbbbbbbbbbbbbbbbb#
                #aaaaaaaaaaaaaaaaaaaaaaaa#bbbbbbbbbbbbbbbbbbbbbbb#
                #aaaaaaaaaaaaaaaaaaaaaaaa#bbbbbbbbbbbbbbbbbbbbbbb#
                #aaaaaaaaaaaaaaaaaaaaaaaa#bbbbbbbbbbbbbbbbbbbbbbb#
                ##################################################
            "#]],
        );
    }
}
