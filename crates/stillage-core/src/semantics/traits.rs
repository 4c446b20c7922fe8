//! Degrees of truth of statements about a category, and how well a label fits them.

use super::evidence::CategoryEvidence;
use super::label::{Functionality, Label};
use super::view::View;

/// Factor on the likelihood of a label that is drivable and nothing else: it fits every free place, so a more specific
/// label is preferred. No measurement is recorded for this value.
const PLAIN_DRIVABLE: f64 = 0.75;
/// Id of the label for places where ways meet, in both tables of the paper.
const JUNCTION: &str = "ju";
/// Share of a category's area that was cut out as plots above which their kinds decide: the majority.
const MAJORITY: f64 = 0.5;

// Ramps: a statement is false below the first value, true above the second, and in between by degrees. No
// measurement is recorded for their values; where a comment gives a reason, that is their origin.

/// Median face area, square metres: a place for one EUR pallet has about 1, a bay of three 4.
const LARGER_THAN_ONE_PLACE: [f64; 2] = [2.0, 4.0];
/// Median face area, square metres: a bay of three pallets has 4, a free-standing block 16.
const LARGER_THAN_STORAGE: [f64; 2] = [4.0, 16.0];
/// Share of occupied cells: the nine blocks of a pallet cover about a tenth of its place, a misplaced line leaves a
/// twentieth in a corridor.
const HAS_GOODS: [f64; 2] = [0.05, 0.15];
/// Share of unknown cells: beams do not enter a stack of goods.
const UNSEEN: [f64; 2] = [0.4, 0.8];
/// Share of free cells.
const FREE: [f64; 2] = [0.5, 0.85];
/// Share of the border lined by structure: an empty place has neighbours on three sides.
const ENCLOSED: [f64; 2] = [0.5, 0.75];
/// Share of the border that is open: an empty place is open on one side at most.
const OPEN: [f64; 2] = [0.25, 0.5];
/// Share of the border lined by structure: something stands along it.
const LINED: [f64; 2] = [0.2, 0.5];
/// Ratio of the principal axes of what is seen.
const LONG_VIEW: [f64; 2] = [1.5, 3.5];
/// Long over short side of a face.
const LONG_FACE: [f64; 2] = [1.5, 4.0];
/// Mean beam length over that of the map.
const FAR_VIEW: [f64; 2] = [0.7, 1.2];
/// Median face area, square metres: a person can work there.
const ROOMY: [f64; 2] = [2.0, 8.0];

/// Degrees of truth of statements about a category, 0 to 1.
pub(super) struct Traits {
    /// Most cells are free.
    free: f64,
    /// Goods stand, or could stand, there.
    goods: f64,
    /// It extends along one direction.
    long: f64,
    /// It extends to all sides.
    wide: f64,
    /// Structure runs along its border.
    lined: f64,
    /// People could work there.
    roomy: f64,
    /// What its faces were cut out as; decides alone where it is known.
    plots: Option<PlotShares>,
}

impl Traits {
    pub(super) fn new(evidence: &CategoryEvidence, view: View) -> Self {
        let is_one_place = 1.0 - ramp(evidence.median_area, LARGER_THAN_ONE_PLACE);
        let is_small = 1.0 - ramp(evidence.median_area, LARGER_THAN_STORAGE);
        let free = ramp(evidence.free_fraction, FREE);
        let enclosed = ramp(evidence.lined_fraction, ENCLOSED).min(1.0 - ramp(evidence.open_fraction, OPEN));
        let empty_place = free.min(is_one_place).min(enclosed);
        let hidden_goods = is_small.min(ramp(evidence.unknown_fraction, UNSEEN));
        let goods = ramp(evidence.occupied_fraction, HAS_GOODS).max(hidden_goods).max(empty_place);
        let lined = ramp(evidence.lined_fraction, LINED);
        // The lines of racks may cut faces anywhere, so beams show better what is long and what is wide.
        let long = match view.elongation {
            Some(ratio) => ramp(ratio, LONG_VIEW),
            None => ramp(evidence.elongation, LONG_FACE),
        };
        let far = view.relative_beam.map_or(1.0 - lined, |beam| ramp(beam, FAR_VIEW));
        Self {
            free,
            goods,
            long,
            wide: far.min(1.0 - long),
            lined,
            roomy: ramp(evidence.median_area, ROOMY),
            plots: PlotShares::of(evidence),
        }
    }

    /// A label is as likely as the least likely of its functionalities. A way to storage and to rooms need be the way to
    /// one of them only.
    pub(super) fn likelihood(&self, label: &Label) -> f64 {
        let suit = |function: &Functionality| match function {
            // Table IV gives corridors and junctions the same functionalities: only their names tell them apart.
            Functionality::Access if label.id == JUNCTION => self.suit(Functionality::Connection),
            Functionality::StorageAccess | Functionality::Access => {
                let ways = [Functionality::StorageAccess, Functionality::Access].into_iter();
                ways.filter(|&way| label.has(way)).map(|way| self.suit(way)).fold(0.0, f64::max)
            }
            &other => self.suit(other),
        };
        let least = label.functionality.iter().map(suit).fold(1.0, f64::min);
        match label.functionality.as_slice() {
            [] => 0.0,
            [Functionality::Drivable] => least * PLAIN_DRIVABLE,
            _ => least,
        }
    }

    fn suit(&self, functionality: Functionality) -> f64 {
        if let Some(plots) = self.plots {
            return plots.suit(functionality);
        }
        let passable = self.free.min(1.0 - self.goods);
        match functionality {
            Functionality::Drivable => passable,
            Functionality::StorageAccess => passable.min(self.long.max(self.lined.min(1.0 - self.wide))),
            Functionality::Access => passable.min(self.long),
            Functionality::Connection => passable.min(self.wide),
            Functionality::Storage => self.goods,
            Functionality::WorkPlace => passable.min(1.0 - self.long).min(self.lined).min(self.roomy),
        }
    }
}

/// Shares of a category's area by what its faces were cut out as.
#[derive(Debug, Clone, Copy)]
struct PlotShares {
    place: f64,
    aisle: f64,
    floor: f64,
    room: f64,
}

impl PlotShares {
    /// `None` where most of the area was cut out as nothing, as all is in the paper's decomposition.
    fn of(evidence: &CategoryEvidence) -> Option<Self> {
        let (place, aisle, floor) = (evidence.place_fraction, evidence.aisle_fraction, evidence.floor_fraction);
        let (room, rest) = (evidence.room_fraction, evidence.rest_fraction);
        (place + aisle + floor + room + rest > MAJORITY).then_some(Self { place, aisle, floor, room })
    }

    fn suit(self, functionality: Functionality) -> f64 {
        match functionality {
            Functionality::Drivable => self.aisle + self.floor,
            Functionality::StorageAccess | Functionality::Access => self.aisle,
            Functionality::Connection => self.floor,
            Functionality::Storage => self.place,
            Functionality::WorkPlace => self.room,
        }
    }
}

/// 0 up to `low`, 1 from `high` on, linear in between.
fn ramp(value: f64, [low, high]: [f64; 2]) -> f64 {
    ((value - low) / (high - low)).clamp(0.0, 1.0)
}
