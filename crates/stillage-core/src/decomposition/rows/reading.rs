//! What rows are cut into places by.

/// What rows are cut into places by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reading {
    /// What divides the places: dividers, and gaps between goods.
    Dividers,
    /// Dividers, and the shape of the goods in the places.
    Goods,
}
