//! Lists page by page.

use axum::http::{HeaderMap, header};

use super::links;
use crate::views::link::Link;

/// Cuts a list that was asked for with one entry more than the page holds; the last entry left is where the next page
/// begins.
#[must_use]
pub fn cut<T>(mut entries: Vec<T>, limit: u32) -> (Vec<T>, bool) {
    let more = entries.len() > limit as usize;
    entries.truncate(limit as usize);
    (entries, more)
}

/// The header that leads to the next page, if there is one.
#[must_use]
pub fn next_header(next: Option<&Link>) -> HeaderMap {
    next.into_iter().map(|link| (header::LINK, links::header(link))).collect()
}
