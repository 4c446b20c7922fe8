//! Probabilistic relaxation: distributions over the categories move towards categories that go together.
//!
//! Source: A. Rosenfeld, R. Hummel and S. Zucker, *Scene labeling by relaxation operations* (1976, doi
//! 10.1109/TSMC.1976.4309519), as O. Mozos applies it to place maps (the paper's \[6\]). Each node has a distribution p
//! over the categories. The distributions of its neighbours j, with weights c, support category l by q(l) = sum over j
//! and l' of c(j) r(l, l') p(j, l'); p(l) becomes p(l) (1 + q(l)), divided by the sum of these over l.
//!
//! The compatibility r of two categories is that of H. Yamamoto (1979): 1 for certain neighbours, 0 for independent
//! ones,
//! -1 for categories that are never neighbours.
//!
//! Departures: the compatibilities are counted on this map's own categories before the first iteration, since there are
//! no labelled maps to learn them from; most categories then support themselves, so relaxation of cells smooths, and
//! relaxation of faces also learns patterns such as storage along corridors. And every category starts with a least
//! share (`distribution::LEAST_SHARE`), since a share of 0 would stay 0.
//!
//! | nodes | neighbours | weight |
//! | --- | --- | --- |
//! | measured cells ([`relax_cells`]) | the eight cells around | 1 |
//! | faces ([`relax_faces`]) | the faces across an edge | length of the edge |
//!
//! Limits: many iterations let large categories absorb small ones; a category that never touches itself gets no support
//! from itself. [`RelaxationReport`] says what changed.

mod cells;
mod compatibilities;
mod distribution;
mod faces;
mod lattice;
mod memberships;
mod report;

#[cfg(test)]
mod tests;

pub use cells::relax_cells;
pub use faces::{Adjacency, relax_faces};
pub use lattice::Lattice;
pub use memberships::Memberships;
pub use report::RelaxationReport;
