//! Pictures of a map. (to be written)
