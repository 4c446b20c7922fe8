//! Bound filters and their values for one thing: conditions (`condition`), shapes (`spatial`), patterns of LIKE
//! (`pattern`), and what CASEI and ACCENTI make of a text (`folding`).

pub mod condition;
pub mod folding;
pub mod pattern;
pub mod spatial;
