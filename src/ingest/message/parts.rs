//! The members of a message that make a map.

use crate::ingest::document::Node;

/// What a message says, whatever its notation.
#[derive(Debug)]
pub(super) struct MessageParts {
    /// JSON pointer to the message inside what was sent: empty, `/msg`, `/values/map` ...
    pub(super) pointer: String,
    /// Its `info`.
    pub(super) info: Option<Node>,
    /// Its `data`: -1 to 100, row-major from the lower left corner.
    pub(super) data: Option<Vec<i8>>,
}
