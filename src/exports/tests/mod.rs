//! Exports of a hall: whole, and with three locations and a small graph for what is compared word by word.

mod cells;
mod fleet;
mod lif;
mod site;
mod tables;
mod whole;

pub(super) use site::Site;
