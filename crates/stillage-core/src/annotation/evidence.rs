//! Whether a face or an edge was seen, or only follows from its surroundings.

use serde::{Deserialize, Serialize};

/// Whether a face or an edge was seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Evidence {
    /// Goods, posts or walls along the border show it.
    Observed,
    /// It follows from its surroundings only: from the pitch of a row, or a line continued through open or unknown
    /// space.
    Interpolated,
}
