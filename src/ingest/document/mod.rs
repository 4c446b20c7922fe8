//! A small document, YAML or JSON, as a tree that keeps what loaders need to complain well.
//!
//! Both notations become the same [`Node`]: numbers stay apart from text, duplicate keys survive, and numbers may be
//! NaN or infinite, so that every complaint is made in one place and with a pointer.

mod fields;
mod node;
mod notation;
mod numpy;
mod odd_numbers;

pub(super) use fields::{Fields, number};
pub(super) use node::Node;
pub(super) use notation::parse;
