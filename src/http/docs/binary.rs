//! How the document speaks of files that are no text.

use utoipa::ToSchema;

/// The bytes of a file.
#[derive(Debug, ToSchema)]
#[schema(value_type = String, format = Binary)]
pub struct Binary(#[allow(dead_code, reason = "it describes a body; the bytes are never held in one")] Vec<u8>);
