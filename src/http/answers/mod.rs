//! Answers that are given again as they are.
//!
//! What an analysed map answers follows from its state, from the address and from a few headers, so that it is made, written
//! and compressed once. Whoever asks again before the map changes gets the same bytes, or 304 by the tag alone, before the
//! request reaches its route.
//!
//! | file | what it does |
//! | --- | --- |
//! | `question` | what of a request decides the answer |
//! | `remembered` | an answer, with what it takes to give it again |
//! | `answer_cache` | those asked for last, within some memory |
//! | `again` | the middleware |

mod again;
mod answer_cache;
mod question;
mod remembered;

pub use again::{Again, again};
