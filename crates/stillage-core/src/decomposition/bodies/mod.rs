//! What lies between aisles: its direction, the depth of its places, and its layers.

pub(crate) mod depth;
mod extent;
mod layer_count;
pub(crate) mod layers;
