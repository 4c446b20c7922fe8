//! What each kind is made of.
//!
//! Ranges are those of the trade: aisles of 2.2 m (narrow) to 4 m (wide), cross aisles of 3 to 5 m, halls of 25 to 60 m.

use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use stillage_core::geometry::Point;

use crate::hall::{Floor, Hall, Side};
use crate::kind::Kind;
use crate::pallet::Pallet;
use crate::random::Random;
use crate::shape::{Convex, Pose};
use crate::site::Site;
use crate::storage::{StoragePlan, Walls};
use crate::style::{Style, any_pallet, inch_pallet};

/// A site along its walls, and what of it is seen.
#[derive(Debug)]
pub(crate) struct Composition {
    pub(crate) site: Site,
    /// Nobody drives here.
    pub(crate) shut: Option<Convex>,
    /// How far the scanner sees, metres.
    pub(crate) sight: f64,
}

/// Boxes and legs in a site: the share of boxes.
pub(crate) type BoxShare = Option<f64>;

/// Sight of a common scanner, metres.
const SIGHT: f64 = 25.0;
/// Length and depth of a block of racks, metres.
const RACKS: [Range<f64>; 2] = [26.0..40.0, 18.0..28.0];

/// Makes a site.
pub(crate) fn compose(kind: Kind, boxes: BoxShare, random: &mut Random) -> Composition {
    let mut maker = Maker { boxes, random };
    let site = match kind {
        Kind::Staging => maker.staging(),
        Kind::TwoDirections => maker.two_directions(),
        Kind::LShape => maker.l_shape(),
        Kind::Diagonal => maker.diagonal(),
        Kind::Unexplored => return maker.unexplored(),
        _ => maker.one_hall(kind),
    };
    Composition { site, shut: None, sight: SIGHT }
}

struct Maker<'a> {
    boxes: BoxShare,
    random: &'a mut Random,
}

impl Maker<'_> {
    /// Racks for any pallet, with the wished share of boxes.
    fn racks(&mut self) -> Style {
        let pallet = any_pallet(self.random);
        let style = Style::racks(pallet, self.random);
        self.wished(style)
    }

    /// A style with the wished share of boxes.
    fn wished(&self, mut style: Style) -> Style {
        style.boxes = self.boxes.unwrap_or(style.boxes);
        style
    }

    /// The style that a kind of a single block stands for.
    fn style(&mut self, kind: Kind) -> Style {
        let racks = self.racks();
        let random = &mut *self.random;
        let style = match kind {
            Kind::EuroLong => Style::racks(Pallet::euro(true), random),
            Kind::Inch => Style::racks(inch_pallet(random), random),
            Kind::Flues => Style { flue: random.within(0.25..0.6), aisle: random.within(2.2..2.8), ..racks },
            Kind::Tunnels => Style { tunnels: true, cross_every: 40.0, ..racks },
            Kind::Guards => Style { guards: true, ..racks },
            Kind::DoubleDeep => Style { layers: 2, ..racks },
            Kind::BlockStorage => Style::block(any_pallet(random), random),
            Kind::Mixed => Style { boxes: random.within(0.3..0.7), ..racks },
            _ => racks,
        };
        self.wished(style)
    }

    fn plan(&mut self, region: char, style: Style, size: [f64; 2], walls: Walls) -> StoragePlan {
        StoragePlan::new(region, style, size, walls, self.random)
    }

    /// A lane around storage, metres.
    fn lane(&mut self) -> f64 {
        self.random.within(3.0..5.0)
    }

    /// Doors in the walls to the left and to the right of a floor, and clutter.
    fn fit_out(&mut self, hall: &mut Hall, doors: &[(usize, Side)]) {
        for &(floor, side) in doors {
            let count = self.random.count(1..4);
            hall.add_doors(floor, side, count, self.random);
        }
        let density = self.random.pick([0.0, 0.3, 0.8]);
        hall.add_clutter(density, self.random);
    }

    /// One block in a rectangular hall.
    fn one_hall(&mut self, kind: Kind) -> Site {
        let style = self.style(kind);
        let size = RACKS.map(|range| self.random.within(range));
        let plan = self.plan('A', style, size, Walls(true, true));
        let [left, right] = [self.lane(), self.lane()];
        let offices = if kind == Kind::Offices { self.random.within(4.0..6.5) } else { 0.0 };
        let [below, above] = plan.behind(self.random);
        let width = left + plan.length() + right + offices;
        let mut hall = Hall::new(vec![Floor { x: 0.0..width, y: 0.0..below + plan.depth() + above }]);
        if kind == Kind::Columns {
            hall.add_columns(self.random);
        }
        hall.store(&plan, &Pose::new(0.0, left, below), None, self.random);
        let mut doors = vec![(0, Side::Left)];
        if kind == Kind::Offices {
            // Rooms of 3 to 4.5 m leave a part of the side open.
            let most = ((plan.depth() - 4.0) / 4.5) as usize;
            hall.add_offices(offices, most.clamp(1, 4), self.random);
        } else {
            doors.push((0, Side::Right));
        }
        self.fit_out(&mut hall, &doors);
        hall.finish()
    }

    /// Racks, and before them marked places and doors along the low wall.
    fn staging(&mut self) -> Site {
        let style = self.racks();
        let size = [self.random.within(24.0..36.0), self.random.within(12.0..18.0)];
        let racks = self.plan('A', style, size, Walls(false, true));
        let pallet = any_pallet(self.random);
        let style = Style::staging(pallet, self.random);
        let style = self.wished(style);
        let staging = StoragePlan::single('B', style, racks.length(), self.random);
        let [left, right] = [self.lane(), self.lane()];
        let [_, above] = racks.behind(self.random);
        let (width, height) = (left + racks.length() + right, staging.depth() + racks.depth() + above);
        let mut hall = Hall::new(vec![Floor { x: 0.0..width, y: 0.0..height }]);
        hall.store(&staging, &Pose::new(0.0, left, 0.0), None, self.random);
        hall.store(&racks, &Pose::new(0.0, left, staging.depth()), None, self.random);
        let doors = self.random.count(3..6);
        hall.add_doors(0, Side::Low, doors, self.random);
        self.fit_out(&mut hall, &[(0, Side::Left)]);
        hall.finish()
    }

    /// Racks along the hall, and racks across it.
    fn two_directions(&mut self) -> Site {
        let size = [self.random.within(18.0..26.0), self.random.within(22.0..30.0)];
        let style = self.racks();
        let along = self.plan('A', style, size, Walls(true, true));
        let [left, between, low, high] = [(); 4].map(|()| self.lane());
        let size = [(along.depth() - low - high).max(8.0), self.random.within(12.0..20.0)];
        let style = self.racks();
        // Turned left by 90 degrees, high y of the block is the left of the hall.
        let across = self.plan('B', style, size, Walls(true, false));
        let [below, above] = along.behind(self.random);
        let [beside, _] = across.behind(self.random);
        let start = left + along.length() + between;
        let width = start + across.depth() + beside;
        let height = (below + along.depth() + above).max(low + across.length() + high);
        let mut hall = Hall::new(vec![Floor { x: 0.0..width, y: 0.0..height }]);
        hall.store(&along, &Pose::new(0.0, left, below), None, self.random);
        hall.store(&across, &Pose::new(FRAC_PI_2, start + across.depth(), low), None, self.random);
        self.fit_out(&mut hall, &[(0, Side::Left)]);
        hall.finish()
    }

    /// Two rectangles of floor with racks of their own, along or across.
    fn l_shape(&mut self) -> Site {
        let style = self.racks();
        let size = [self.random.within(28.0..38.0), self.random.within(13.0..19.0)];
        let lower = self.plan('A', style, size, Walls(true, false));
        let turned = self.random.chance(0.5);
        let style = self.racks();
        let size = [self.random.within(10.0..15.0), self.random.within(12.0..18.0)];
        let size = if turned { [size[1], size[0]] } else { size };
        let upper = self.plan('B', style, size, Walls(turned, !turned));
        let [left, right, lane, beside] = [(); 4].map(|()| self.lane());
        let ([below, _], [at_right, above]) = (lower.behind(self.random), upper.behind(self.random));
        let width = left + lower.length() + right;
        let height = below + lower.depth();
        let extent = if turned { [upper.depth(), upper.length()] } else { [upper.length(), upper.depth()] };
        // Turned, the wall behind its first row is the right one.
        let side = if turned { at_right } else { beside };
        let upper_width = (left + extent[0] + side).min(width);
        let upper_height = if turned { extent[1] + 2.0 * lane } else { extent[1] + above };
        let floors = vec![
            Floor { x: 0.0..width, y: 0.0..height },
            Floor { x: 0.0..upper_width, y: height..height + upper_height },
        ];
        let mut hall = Hall::new(floors);
        hall.store(&lower, &Pose::new(0.0, left, below), None, self.random);
        let pose = if turned {
            Pose::new(FRAC_PI_2, left + upper.depth(), height + lane)
        } else {
            Pose::new(0.0, left, height)
        };
        hall.store(&upper, &pose, None, self.random);
        self.fit_out(&mut hall, &[(0, Side::Left), (0, Side::Right), (1, Side::Left)]);
        hall.finish()
    }

    /// Racks aslant; their ends follow the walls like the teeth of a saw.
    fn diagonal(&mut self) -> Site {
        let [width, height] = [self.random.within(34.0..46.0), self.random.within(26.0..34.0)];
        let angle = self.random.pick([-1.0, 1.0]) * self.random.within(18.0..45.0_f64).to_radians();
        let style = Style { shifted_rows: 0.0, ..self.racks() };
        let diagonal = width.hypot(height);
        let plan = self.plan('A', style, [diagonal, diagonal], Walls(false, false));
        let floor = Floor { x: 0.0..width, y: 0.0..height };
        let outline = Convex::rectangle(0.0..width, 0.0..height).grown(-self.lane());
        let mut hall = Hall::new(vec![floor]);
        let middle = Point::new(plan.length() / 2.0, plan.depth() / 2.0);
        let pose = Pose::carrying(angle, middle, Point::new(width / 2.0, height / 2.0));
        hall.store(&plan, &pose, Some(&outline), self.random);
        self.fit_out(&mut hall, &[(0, Side::Left), (0, Side::Right)]);
        hall.finish()
    }

    /// A hall seen in parts.
    fn unexplored(&mut self) -> Composition {
        let style = Style { unvisited: self.random.within(0.2..0.45), ..self.racks() };
        let size = RACKS.map(|range| self.random.within(range));
        let plan = self.plan('A', style, size, Walls(true, true));
        let [left, right] = [self.lane(), self.lane()];
        let [below, above] = plan.behind(self.random);
        let (width, height) = (left + plan.length() + right, below + plan.depth() + above);
        let mut hall = Hall::new(vec![Floor { x: 0.0..width, y: 0.0..height }]);
        hall.store(&plan, &Pose::new(0.0, left, below), None, self.random);
        self.fit_out(&mut hall, &[(0, Side::Left), (0, Side::Right)]);
        let driven = self.random.within(0.5..0.75) * width;
        let shut = Convex::rectangle(driven..width, 0.0..height);
        Composition { site: hall.finish(), shut: Some(shut), sight: self.random.within(6.0..10.0) }
    }
}
