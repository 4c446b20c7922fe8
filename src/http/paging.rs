//! Lists page by page.

/// Cuts a list that was asked for with one entry more than the page holds; the last entry left is where the next page
/// begins.
#[must_use]
pub fn cut<T>(mut entries: Vec<T>, limit: u32) -> (Vec<T>, bool) {
    let more = entries.len() > limit as usize;
    entries.truncate(limit as usize);
    (entries, more)
}
