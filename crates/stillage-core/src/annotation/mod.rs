//! Annotation: categories and measurements of faces and edges, from the cells in and along them (paper, II-B).
//!
//! | module | what comes out |
//! | --- | --- |
//! | [`mod@annotate`] | the annotations of all faces and edges |
//! | [`faces`], [`edges`] | measurements of every face and edge |
//! | [`evidence`] | whether a face or edge was seen |
//! | [`plot_kinds`] | what each face was cut out for |
//! | [`outside`] | which faces are unexplored ground around the site |
//! | [`clusters`] | categories of faces by clustering the faces |
//! | [`membership`] | distributions of faces over the categories; their relaxation |
//! | [`face_categories`] | the numbers of the categories |
//! | [`anew`] | the annotations of a redrawn subdivision: only what changed is measured again |
//! | [`merge`] | a subdivision in which faces that nothing divides are one; made before the rest is measured |
//!
//! A face gets its category by clustering faces, or by the vote of its cells as in the paper.

mod anew;
mod annotate;
mod clusters;
mod edges;
mod evidence;
mod face_categories;
mod faces;
mod membership;
mod merge;
mod outside;
mod plot_kinds;

#[cfg(test)]
mod tests;

pub(crate) use anew::{Redrawn, annotate_anew};

pub use annotate::{Annotations, Subject, annotate};
pub use edges::EdgeAnnotation;
pub use evidence::Evidence;
pub use face_categories::FaceCategories;
pub use faces::FaceAnnotation;
pub use merge::{PlannedGround, merge_alike};
