//! The codes of locations.

use super::aisles::Slot;

/// Writes codes of one width per map, so that they sort as text: two digits for the aisle and three for the bay, more
/// where numbers need them.
pub(super) struct Codes {
    aisle_digits: usize,
    bay_digits: usize,
}

impl Codes {
    pub(super) fn for_slots(slots: &[Slot]) -> Self {
        let digits = |number: Option<u32>| number.unwrap_or(0).to_string().len();
        Self {
            aisle_digits: digits(slots.iter().map(|slot| slot.aisle).max()).max(2),
            bay_digits: digits(slots.iter().map(|slot| slot.bay).max()).max(3),
        }
    }

    pub(super) fn of(&self, slot: Slot) -> String {
        format!("{:0aisle$}-{:0bay$}", slot.aisle, slot.bay, aisle = self.aisle_digits, bay = self.bay_digits)
    }
}
