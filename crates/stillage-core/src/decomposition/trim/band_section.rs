//! A section of a band with places along all of it, or along none of it.

use std::ops::Range;

use crate::decomposition::ground::{Axis, Rect, RegionFrame};
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;
use crate::runs::runs_of_equal;

/// Share of a strip that must be free, drivable, or in the site for the strip to be so.
pub(super) const GROUND_SHARE: f64 = 0.5;
/// Lines of a band without places that are shorter than this are an empty place or two, metres; longer, they are open
/// floor.
const OPEN_STRETCH_M: f64 = 1.9;
/// The same beyond the first and last place along the bands of one block, metres.
pub(super) const OPEN_END_M: f64 = 0.5;

/// A section of a band. Arrays hold the low and the high side.
pub(super) struct BandSection {
    pub rect: Rect,
    pub axis: Axis,
    /// Whether places lie along the side, by line across the band.
    pub sides: [Vec<bool>; 2],
    /// Whether any place lies along the side.
    pub fronts: [bool; 2],
    /// Whether the site ends at the side.
    pub walls: [bool; 2],
}

impl BandSection {
    pub fn across(&self) -> Range<usize> {
        self.rect.range(self.axis.other()).clone()
    }

    /// Some lines of it, as a parcel.
    pub fn part(&self, across: Range<usize>, kind: PlotKind) -> Parcel {
        Parcel::new(self.rect.with(self.axis.other(), across), kind, Some(self.axis))
    }

    /// All of it is an aisle where places lie along it, and open floor elsewhere.
    pub fn whole(&self) -> Parcel {
        let kind = if self.fronts == [false; 2] { PlotKind::OpenFloor } else { PlotKind::Aisle };
        self.part(self.across(), kind)
    }

    /// Adds one aisle, and open floor on both sides of it.
    pub fn add_only_aisle(&self, aisle: Range<usize>, parcels: &mut Vec<Parcel>) {
        let across = self.across();
        for floor in [across.start..aisle.start, aisle.end..across.end] {
            if !floor.is_empty() {
                parcels.push(self.part(floor, PlotKind::OpenFloor));
            }
        }
        parcels.push(self.part(aisle, PlotKind::Aisle));
    }

    /// Adds the aisle of the row on one side, as long as this row.
    pub fn add_aisle_of_side(
        &self,
        frame: &RegionFrame,
        across: &Range<usize>,
        side: usize,
        parcels: &mut Vec<Parcel>,
    ) {
        let has_place = self.sides[side].clone();
        let end = has_place.iter().rposition(|&here| here).map_or(0, |last| last + 1);
        let reach = has_place.iter().position(|&here| here).unwrap_or(end)..end;
        let has_place = without_short_gaps(frame, has_place, &reach);
        let start = self.rect.range(self.axis).start;
        for run in runs_of_equal(&has_place) {
            let kind = if has_place[run.start] { PlotKind::Aisle } else { PlotKind::OpenFloor };
            let part = self.part(across.clone(), kind);
            parcels.push(Parcel { rect: part.rect.with(self.axis, start + run.start..start + run.end), ..part });
        }
    }
}

/// Lines with places, and the short gaps between them within `reach` and beyond it, which are empty places.
pub(super) fn without_short_gaps(frame: &RegionFrame, mut has_place: Vec<bool>, reach: &Range<usize>) -> Vec<bool> {
    if has_place.contains(&true) {
        fill_gaps(&mut has_place[reach.clone()], frame.cells_of(OPEN_STRETCH_M));
        fill_gaps(&mut has_place, frame.cells_of(OPEN_END_M));
    }
    has_place
}

/// Sets the runs of unset values that are shorter than `least`.
fn fill_gaps(values: &mut [bool], least: usize) {
    let gaps: Vec<Range<usize>> = runs_of_equal(values).filter(|run| !values[run.start] && run.len() < least).collect();
    for gap in gaps {
        values[gap].fill(true);
    }
}
