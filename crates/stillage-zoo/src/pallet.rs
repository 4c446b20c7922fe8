//! Pallets and loads, as a scanner near the floor or at the height of the load sees them.
//!
//! Sizes: EN 13698-1 (Euro, 1.2 m x 0.8 m on nine blocks), GMA (48 x 40 inches, on nine blocks or three stringers).

use stillage_core::geometry::Point;

use crate::random::Random;
use crate::shape::{Convex, Pose};
use crate::site::Content;

/// What carries the deck of a pallet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Bearers {
    /// Nine blocks of a size along the aisle and into the row, metres.
    Blocks([f64; 2]),
    /// Three stringers into the row, of a thickness, metres.
    Stringers(f64),
}

/// A pallet as it stands: size along the aisle and into the row, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pallet {
    pub(crate) size: [f64; 2],
    pub(crate) bearers: Bearers,
}

/// Length and width of a pallet of 48 x 40 inches, metres.
const INCH_SIZE: [f64; 2] = [1.219, 1.016];

impl Pallet {
    /// A Euro pallet.
    pub(crate) fn euro(long_side_to_aisle: bool) -> Self {
        // EN 13698-1: blocks are 145 mm long, the outer ones 100 mm wide.
        if long_side_to_aisle {
            Self { size: [1.2, 0.8], bearers: Bearers::Blocks([0.145, 0.1]) }
        } else {
            Self { size: [0.8, 1.2], bearers: Bearers::Blocks([0.1, 0.145]) }
        }
    }

    /// A pallet of 48 x 40 inches; those on stringers are entered from the narrow side.
    pub(crate) fn inch(long_side_to_aisle: bool, stringers: bool) -> Self {
        let [long, short] = INCH_SIZE;
        match (long_side_to_aisle, stringers) {
            (true, _) => Self { size: [long, short], bearers: Bearers::Blocks([0.14, 0.09]) },
            // A 2 x 4 on edge, nominally 38 mm.
            (false, true) => Self { size: [short, long], bearers: Bearers::Stringers(0.038) },
            (false, false) => Self { size: [short, long], bearers: Bearers::Blocks([0.09, 0.14]) },
        }
    }

    /// What stops beams where this pallet stands about a centre, turned by an angle.
    pub(crate) fn solids(&self, center: Point, angle: f64, content: Content, random: &mut Random) -> Vec<Convex> {
        let [width, depth] = self.size;
        match (content, self.bearers) {
            (Content::Nothing, _) => Vec::new(),
            (Content::Box, _) => {
                // Loads are stretched film on cartons: a little smaller than the pallet, seldom larger.
                let slack = random.within(-0.02..0.08);
                vec![Convex::turned_box(center, [width - slack, depth - slack], angle)]
            }
            (Content::Pallet, Bearers::Blocks(block)) => {
                let pose = Pose { angle, offset: center.coords };
                let [inset_x, inset_y] = [(width - block[0]) / 2.0, (depth - block[1]) / 2.0];
                let sides = [-1.0, 0.0, 1.0];
                let middles = sides.iter().flat_map(|x| sides.map(|y| Point::new(x * inset_x, y * inset_y)));
                middles.map(|middle| Convex::turned_box(pose.apply(middle), block, angle)).collect()
            }
            (Content::Pallet, Bearers::Stringers(thickness)) => {
                let pose = Pose { angle, offset: center.coords };
                let inset = (width - thickness) / 2.0;
                let at = |side: f64| pose.apply(Point::new(side * inset, 0.0));
                [-1.0, 0.0, 1.0].map(|side| Convex::turned_box(at(side), [thickness, depth], angle)).to_vec()
            }
        }
    }
}
