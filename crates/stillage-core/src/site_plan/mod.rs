//! The site plan: which ground is rooms and which is halls with rows of places, and the lines that divide both.
//!
//! The whole site is divided into rooms ([`crate::rooms`]). A zone, that is, rooms that open widely into one another,
//! is a hall when it is large and places lie on a good part of it; rows are laid out in halls
//! ([`crate::decomposition`]) as if the other zones did not exist, and all other zones keep their rooms. So offices in
//! the corner of a hall are offices, what lies behind its gates is no floor of the hall, and a site without rows is
//! rooms throughout.
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`mod@plan`] | the lines of rows and rooms, what they enclose, and the rooms |
//! | [`survey`] | the rooms and the rows, by goods or by equal marks |
//! | [`halls`] | which rooms are halls, and the rows in them |
//! | [`storage`] | which of the other rooms hold storage |
//!
//! Cost: that of the rooms, and that of the rows once for each time that a zone turns out to be no hall; twice both where
//! equal marks tell more than goods.

mod halls;
mod plan;
mod storage;
mod survey;

#[cfg(test)]
mod tests;

pub use plan::{SitePlan, plan};
