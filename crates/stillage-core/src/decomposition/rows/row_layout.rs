//! What a region is laid out as.

use crate::decomposition::parcel::Parcel;

/// The bands and bodies of a region as parcels.
pub(crate) struct RowLayout {
    pub parcels: Vec<Parcel>,
    /// Whether the goods in the rows repeat.
    pub is_periodic: bool,
    /// Number of storage lanes that were cut: places, those one behind the other counted once.
    pub lanes: usize,
}
