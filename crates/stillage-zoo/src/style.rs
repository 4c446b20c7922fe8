//! How places are stored: what a block of racks or of floor storage repeats.

use crate::pallet::Pallet;
use crate::random::Random;

/// Which places of a row hold something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Fill {
    /// Each place by itself, empty with a probability.
    Single(f64),
    /// Lanes are filled from the back; the mean share that is empty.
    FromBack(f64),
}

/// What the rows of one region have in common. Metres.
#[derive(Debug, Clone)]
pub(crate) struct Style {
    pub(crate) pallet: Pallet,
    /// Width along the aisle and depth into the row of one place.
    pub(crate) place: [f64; 2],
    pub(crate) places_per_bay: usize,
    /// Between bays: the width of an upright, or the gap between lanes.
    pub(crate) gap: f64,
    /// Whether uprights stand in the gaps.
    pub(crate) uprights: bool,
    /// Between two rows back to back.
    pub(crate) flue: f64,
    /// Places between an aisle and the back of the row.
    pub(crate) layers: usize,
    pub(crate) fill: Fill,
    /// Share of the pallets that show a load instead of legs.
    pub(crate) boxes: f64,
    /// Probability that a row is not there between two cross aisles.
    pub(crate) missing_rows: f64,
    /// Probability that a row is out of step with the others.
    pub(crate) shifted_rows: f64,
    /// Standard deviation of the position of a pallet on its place, and of its turn, radians.
    pub(crate) careless: [f64; 2],
    pub(crate) guards: bool,
    pub(crate) tunnels: bool,
    pub(crate) aisle: f64,
    pub(crate) cross_aisle: f64,
    /// Mean distance of cross aisles.
    pub(crate) cross_every: f64,
    /// Probability that nobody drove an aisle between two cross aisles.
    pub(crate) unvisited: f64,
}

/// Widest and deepest place: what the methods for warehouses have to expect.
const LARGEST_PLACE: [f64; 2] = [1.4, 1.3];

impl Style {
    /// Racks for a pallet.
    pub(crate) fn racks(pallet: Pallet, random: &mut Random) -> Self {
        let [width, depth] = pallet.size;
        // EN 15620: 75 to 100 mm between pallets, and between pallets and uprights.
        let place = [width + random.within(0.08..0.18), depth + random.within(0.0..0.1)];
        Self {
            pallet,
            place: [place[0].min(LARGEST_PLACE[0]), place[1].min(LARGEST_PLACE[1])],
            places_per_bay: random.count(2..4),
            gap: random.within(0.08..0.12),
            uprights: true,
            flue: random.within(0.05..0.2),
            layers: 1,
            fill: Fill::Single(random.within(0.05..0.3)),
            boxes: random.pick([0.0, 0.0, 1.0]),
            missing_rows: random.pick([0.0, 0.0, 0.06]),
            shifted_rows: random.pick([0.0, 0.0, 0.3]),
            careless: [random.within(0.01..0.035), random.within(0.005..0.03)],
            guards: random.chance(0.2),
            tunnels: false,
            aisle: random.within(2.6..3.8),
            cross_aisle: random.within(3.0..5.0),
            cross_every: random.within(13.0..24.0),
            unvisited: random.pick([0.0, 0.0, 0.05]),
        }
    }

    /// Places on the floor, in lanes.
    fn floor(pallet: Pallet, layers: usize, fill: Fill, random: &mut Random) -> Self {
        let slack = random.within(0.04..0.12);
        Self {
            place: [pallet.size[0] + slack, (pallet.size[1] + slack).min(LARGEST_PLACE[1])],
            places_per_bay: 1,
            gap: random.within(0.05..0.25),
            uprights: false,
            flue: random.within(0.05..0.3),
            layers,
            fill,
            guards: false,
            missing_rows: 0.0,
            // A driver's eye instead of a beam to stop at.
            careless: [random.within(0.02..0.04), random.within(0.01..0.04)],
            ..Self::racks(pallet, random)
        }
    }

    /// Block storage: lanes four to eight deep.
    pub(crate) fn block(pallet: Pallet, random: &mut Random) -> Self {
        let layers = random.count(4..9);
        let fill = Fill::FromBack(random.within(0.15..0.45));
        let aisle = random.within(3.0..4.2);
        Self { shifted_rows: 0.0, aisle, ..Self::floor(pallet, layers, fill, random) }
    }

    /// A staging grid: short marked lanes with walkways between them.
    pub(crate) fn staging(pallet: Pallet, random: &mut Random) -> Self {
        let layers = random.count(3..6);
        let fill = Fill::Single(random.within(0.3..0.6));
        Self {
            gap: random.within(0.15..0.4),
            shifted_rows: 0.0,
            cross_aisle: random.within(1.6..2.6),
            cross_every: random.within(6.0..11.0),
            unvisited: 0.0,
            ..Self::floor(pallet, layers, fill, random)
        }
    }

    /// Length of a bay with one of its gaps.
    pub(crate) fn bay(&self) -> f64 {
        self.places_per_bay as f64 * self.place[0] + self.gap
    }

    /// Depth of the places between an aisle and the back of a row.
    pub(crate) fn side_depth(&self) -> f64 {
        self.layers as f64 * self.place[1]
    }
}

/// A pallet of any sort, as it stands to its aisle.
pub(crate) fn any_pallet(random: &mut Random) -> Pallet {
    let long_side_to_aisle = random.chance(0.3);
    if random.chance(0.7) { Pallet::euro(long_side_to_aisle) } else { inch_pallet(random) }
}

/// A pallet of 48 x 40 inches, as it stands to its aisle.
pub(crate) fn inch_pallet(random: &mut Random) -> Pallet {
    let long_side_to_aisle = random.chance(0.4);
    Pallet::inch(long_side_to_aisle, random.chance(0.4))
}
