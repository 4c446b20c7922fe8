//! Corrections: what people say about an analysed map that no automatic reading got right.
//!
//! ```text
//! Analysis, its CellFaces, a list of corrections ── apply ── Corrected: Analysis, CellFaces, labels, names, outcomes
//! ```
//!
//! | item | what it is |
//! | --- | --- |
//! | [`Correction`] | one correction as data, in metres of the map frame; it survives another analysis and another scan |
//! | [`CorrectionProblem`] | why a correction makes no sense, or does not fit onto a map |
//! | [`Outcome`] | what became of a correction: the faces that it made or touched, or why it did not fit |
//! | [`apply()`] | an analysis with a list of corrections |
//!
//! | module | what it does |
//! | --- | --- |
//! | [`correction`], [`check`] | the data; what can be checked without a map |
//! | [`mod@apply`] | the list, one after the other, also after a list that was applied |
//! | [`draft`] | the map while it is corrected: its arrangement, and what is said of its faces and doors |
//! | [`snap`] | what is drawn joins what is there |
//! | [`paint`], [`cut`], [`erase`], [`passage`] | faces that are drawn; split and merged; taken away; doors |
//! | [`assemble`] | the corrected analysis: only what was redrawn is measured again |
//!
//! A list is applied in order, each correction to what those before it left. The result follows from the analysis and
//! the list alone, on any number of threads.

mod apply;
mod assemble;
mod check;
mod correction;
mod cut;
mod draft;
mod erase;
mod failure;
mod outcome;
mod paint;
mod passage;
mod snap;
#[cfg(test)]
mod tests;

pub use apply::{CorrectedBefore, apply, apply_after};
pub use check::CorrectionProblem;
pub use correction::Correction;
pub use draft::Said;
pub use outcome::{Corrected, Outcome};
