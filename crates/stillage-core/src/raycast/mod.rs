//! Beams: distances from free cells to the next obstacle, in many directions.
//!
//! | function | method | cost of a beam |
//! | --- | --- | --- |
//! | [`march()`] | follows one beam exactly, cell by cell: the definition | its length in cells |
//! | [`Sweep`] | all cells along digital lines within an eighth of a cell of their centres: behind the features | constant |
//!
//! Beams start at the centre of a cell, evenly around, the first along x, counter-clockwise. A beam ends where it
//! enters the first cell that stops it: an occupied cell, an unknown cell if [`BeamOptions::unknown_blocks`], or the
//! end of the grid. The beams of all cells are never stored together: a sweep gives those of one tile and one direction
//! at a time.

mod beams;
mod directions;
mod grid_walk;
mod lines;
mod march;
mod mask;
mod sweep;
mod tile;
mod tile_sweep;

pub use beams::{BeamOptions, beam_direction};
pub use march::{march, march_around};
pub use sweep::{Sweep, border_bytes_per_cell};
pub use tile::{PLANE_LENGTH, PLANE_PITCH, Tile};
pub use tile_sweep::TileScratch;
