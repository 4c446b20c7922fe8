//! What lies between aisles: its direction, the depth of its places, and its layers one behind the other.

pub(crate) mod body;
pub(crate) mod depth;
mod extent;
mod layer_count;
pub(crate) mod layers;

pub(crate) use body::Body;
