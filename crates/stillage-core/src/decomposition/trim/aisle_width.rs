//! How much of a band is aisle; where there is room for more, the rest of it is open floor.
//!
//! The usual width of an aisle is that of the bands with places on both sides. If a band is wider, the side of its aisle
//! follows from the rows of other bands, which border on the same lines, or else from which of its two rows has no other
//! aisle. A band with room for two aisles and nothing else is two aisles, each as long as its own row.
//!
//! Cost: O(cells of the bands + places). Limits: a band between a row and a wall is all aisle, up to twice the usual width.

use std::cmp::Ordering;

use super::aisle_need::AisleNeeds;
use super::band_section::BandSection;
use super::place_index::PlaceIndex;
use crate::decomposition::ground::{Axis, RegionFrame};
use crate::decomposition::parcel::Parcel;
use crate::plot::PlotKind;
use crate::watch::{Stopped, Watch};

/// What is left beside an aisle is open floor from this width on, metres: the depth of a row that is missing.
const OPEN_STRIP_M: f64 = 1.0;
/// Two aisles side by side take at least this share of the usual width each.
const TWO_AISLES_SHARE: f64 = 0.85;

/// The aisles and the open floor of sections of bands; `places` are those of both axes, in the order of [`Axis::BOTH`].
pub(super) fn cut(
    frame: &RegionFrame,
    sections: &[BandSection],
    places: &[PlaceIndex; 2],
    watch: &Watch<'_>,
) -> Result<Vec<Parcel>, Stopped> {
    let mut parcels = Vec::new();
    let Some(width) = usual_width(sections) else {
        return Ok(sections.iter().map(BandSection::whole).collect());
    };
    let [mut along_u, mut along_v] = places.each_ref().map(|places| DirectionAisles::new(frame, width, places, watch));
    for section in sections {
        watch.check()?;
        let aisles = if section.axis == Axis::U { &mut along_u } else { &mut along_v };
        aisles.cut(section, &mut parcels)?;
    }
    Ok(parcels)
}

/// Width of the band at the middle of the length of all bands with places on both sides, cells.
fn usual_width(sections: &[BandSection]) -> Option<usize> {
    let size = |section: &BandSection| (section.across().len(), section.rect.range(section.axis).len());
    let mut sizes: Vec<(usize, usize)> = sections.iter().filter(|of| of.fronts == [true; 2]).map(size).collect();
    sizes.sort_unstable();
    let whole: usize = sizes.iter().map(|(_, length)| length).sum();
    let mut passed = 0;
    let middle = sizes.iter().find(|(_, length)| {
        passed += length;
        2 * passed >= whole
    });
    middle.map(|&(width, _)| width)
}

/// Lengths of the places of one axis by the lines that bound them along it, cells.
struct PlaceBorders {
    lengths: Vec<usize>,
    contact: usize,
}

impl PlaceBorders {
    fn of(frame: &RegionFrame, index: &PlaceIndex) -> Self {
        let mut lengths = vec![0; frame.whole().range(index.axis.other()).end + 1];
        for place in index.places.rects() {
            let across = place.range(index.axis.other());
            for border in [across.start, across.end] {
                lengths[border] += place.range(index.axis).len();
            }
        }
        Self { lengths, contact: index.contact }
    }

    /// Length of the places with a border within contact of a line.
    fn near(&self, line: usize) -> usize {
        self.lengths[line.saturating_sub(self.contact)..(line + self.contact + 1).min(self.lengths.len())].iter().sum()
    }
}

/// What is known of the aisles along one axis.
struct DirectionAisles<'a> {
    frame: &'a RegionFrame,
    /// Usual width, cells.
    width: usize,
    /// What is left beside an aisle is open floor from this width on, cells.
    strip: usize,
    borders: PlaceBorders,
    needs: AisleNeeds<'a>,
}

impl<'a> DirectionAisles<'a> {
    fn new(frame: &'a RegionFrame, width: usize, places: &'a PlaceIndex, watch: &'a Watch<'a>) -> Self {
        Self {
            frame,
            width,
            strip: frame.cells_of(OPEN_STRIP_M),
            borders: PlaceBorders::of(frame, places),
            needs: AisleNeeds::new(frame, places, watch),
        }
    }

    /// Adds the aisles of a section, and the open floor beside them.
    fn cut(&mut self, section: &BandSection, parcels: &mut Vec<Parcel>) -> Result<(), Stopped> {
        let (frame, across) = (self.frame, section.across());
        let (start, end, width) = (across.start, across.end, self.width);
        let has_room = |aisles: usize, more: usize| across.len() >= aisles * width + more;
        let is_two = across.len() as f64 >= 2.0 * TWO_AISLES_SHARE * width as f64;
        let room_before = |is_wall: bool| if is_wall { width } else { self.strip };
        match section.fronts {
            [true, true] if has_room(2, self.strip) => {
                section.add_aisle_of_side(frame, &(start..start + width), 0, parcels);
                parcels.push(section.part(start + width..end - width, PlotKind::OpenFloor));
                section.add_aisle_of_side(frame, &(end - width..end), 1, parcels);
            }
            [true, true] if has_room(1, self.strip) => match self.only_side(section)? {
                Some(0) => section.add_only_aisle(start..start + width, parcels),
                Some(_) => section.add_only_aisle(end - width..end, parcels),
                None if is_two => {
                    let middle = start.midpoint(end);
                    section.add_aisle_of_side(frame, &(start..middle), 0, parcels);
                    section.add_aisle_of_side(frame, &(middle..end), 1, parcels);
                }
                None => parcels.push(section.whole()),
            },
            [true, false] if has_room(1, room_before(section.walls[1])) => {
                section.add_only_aisle(start..start + width, parcels);
            }
            [false, true] if has_room(1, room_before(section.walls[0])) => {
                section.add_only_aisle(end - width..end, parcels);
            }
            _ => parcels.push(section.whole()),
        }
        Ok(())
    }

    /// The side, low or high, of the only aisle of a section with places on both sides, if anything decides it.
    fn only_side(&mut self, section: &BandSection) -> Result<Option<usize>, Stopped> {
        let across = section.across();
        let far_sides = [across.start + self.width, across.end - self.width];
        let [low_borders, high_borders] = far_sides.map(|line| self.borders.near(line));
        let [low_need, high_need] = self.needs.of_section(section)?;
        Ok(match (low_borders, low_need).cmp(&(high_borders, high_need)) {
            Ordering::Greater => Some(0),
            Ordering::Less => Some(1),
            Ordering::Equal => None,
        })
    }
}
