//! The floor of a hall with storage that nothing divides: aisles along the fronts of what stands there, crossings where two
//! aisles meet, and open floor.
//!
//! | step | module | what comes out |
//! | --- | --- | --- |
//! | 1 | [`chains`] | bodies that stand in one line: rows |
//! | 2 | [`fronts`] | strips of free ground along the long sides of the rows, up to the next row or wall |
//! | 3 | [`strip`] | one strip for both rows beside it |
//! | 4 | [`mod@divide`] | the ground of the hall as aisles, crossings and open floor |
//!
//! A strip is an aisle when it is wide enough for a vehicle, no wider than the widest aisle, and longer than wide; it ends
//! where the storage beside it ends. All else is open floor. Cost: O(cells of the strips + bodies^2).

mod chains;
mod divide;
mod fronts;
mod strip;

pub(crate) use divide::divide;
