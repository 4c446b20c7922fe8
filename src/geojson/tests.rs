//! The collections of a whole map.
