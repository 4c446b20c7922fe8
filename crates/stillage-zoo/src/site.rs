//! A site before any robot drove through it: floor, solids, truth and the ways to drive.

use stillage_core::geometry::Point;

use crate::shape::{Convex, Pose};

/// What a scanner can see and what is true, in one frame.
#[derive(Debug, Clone, Default)]
pub(crate) struct Site {
    /// Where beams pass, unless something stands there. Everything else is solid.
    pub(crate) floor: Vec<Convex>,
    /// What stands on the floor.
    pub(crate) solids: Vec<Convex>,
    /// What is true of the floor.
    pub(crate) truth: Vec<Fact>,
    /// Where the robot drives; it leaves out what is blocked.
    pub(crate) routes: Vec<[Point; 2]>,
    /// Racks and blocks from front to back: floor that is no junction.
    pub(crate) bodies: Vec<Convex>,
}

/// Something true of a polygon.
#[derive(Debug, Clone)]
pub(crate) struct Fact {
    pub(crate) shape: Convex,
    pub(crate) about: About,
}

/// What is true.
#[derive(Debug, Clone)]
pub(crate) enum About {
    /// A place for one pallet.
    Place(Place),
    /// An aisle between two cross aisles.
    Corridor { region: char, aisle: usize, segment: usize },
    /// Floor to drive on that serves no place.
    Junction,
    /// A wall of the hall or of a room.
    Wall,
    /// A column of the building.
    Pillar { region: char },
    /// The floor of an office; neither corridor nor junction of the warehouse.
    Room,
    /// Storage of one direction and pitch; the angle (radians) is that of its rows.
    Region { name: char, angle: f64, pitch: f64, depth: f64 },
}

impl About {
    fn turned(&self, by: f64) -> Self {
        match *self {
            Self::Region { name, angle, pitch, depth } => Self::Region { name, angle: angle + by, pitch, depth },
            ref other => other.clone(),
        }
    }
}

/// A place for one pallet.
#[derive(Debug, Clone)]
pub(crate) struct Place {
    pub(crate) region: char,
    /// Region, row within it, segment of the row.
    pub(crate) row: String,
    pub(crate) content: Content,
    /// Places between it and its aisle.
    pub(crate) front: usize,
    /// On which side of the row its aisle lies: 1 or -1.
    pub(crate) facing: i8,
    /// Lower corner, width and depth in the frame of the region, metres.
    pub(crate) local: [f64; 4],
}

/// What stands on a place, as a scanner sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Content {
    Nothing,
    /// A load that reaches down to the beams.
    Box,
    /// The legs of a pallet.
    Pallet,
}

impl Site {
    /// Takes in what was made in another frame.
    pub(crate) fn add(&mut self, part: &Self, pose: &Pose) {
        let placed = |shapes: &[Convex]| shapes.iter().map(|shape| shape.placed(pose)).collect::<Vec<_>>();
        self.floor.extend(placed(&part.floor));
        self.solids.extend(placed(&part.solids));
        self.bodies.extend(placed(&part.bodies));
        let fact = |fact: &Fact| Fact { shape: fact.shape.placed(pose), about: fact.about.turned(pose.angle) };
        self.truth.extend(part.truth.iter().map(fact));
        self.routes.extend(part.routes.iter().map(|ends| ends.map(|end| pose.apply(end))));
    }

    /// A stripe of a thickness (metres) around the floor, without what is floor itself.
    pub(crate) fn walls(&self, thickness: f64) -> Vec<Convex> {
        let mut walls: Vec<Convex> = Vec::new();
        for floor in &self.floor {
            let pieces = floor.grown(thickness).minus_all(self.floor.iter().chain(&walls));
            walls.extend(pieces);
        }
        walls
    }

    /// States a fact.
    pub(crate) fn state(&mut self, shape: Convex, about: About) {
        self.truth.push(Fact { shape, about });
    }

    /// Shapes of the facts that a question is answered with yes for.
    pub(crate) fn shapes(&self, wanted: impl Fn(&About) -> bool) -> impl Iterator<Item = &Convex> {
        self.truth.iter().filter(move |fact| wanted(&fact.about)).map(|fact| &fact.shape)
    }
}
