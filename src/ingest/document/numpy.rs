//! Numbers as `yaml.dump` writes numpy scalars: the call that would make one, with a data type and the bytes.
//!
//! ```yaml
//! resolution: !!python/object/apply:numpy.core.multiarray.scalar
//! - !!python/object/apply:numpy.dtype
//!   args: [f8, false, true]
//!   state: !!python/tuple [3, <, null, null, null, -1, -1, 0]
//! - !!binary mpmZmZmZqT8=
//! ```

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::node::Node;

/// The number that a call of numpy's `scalar` makes; `None` for anything else.
pub(super) fn scalar(node: &Node) -> Option<f64> {
    let Node::List(arguments) = node else { return None };
    let [Node::Mapping(data_type), Node::Text(bytes)] = arguments.as_slice() else { return None };
    let member = |name: &str| match data_type.iter().find(|(key, _)| key == name) {
        Some((_, Node::List(items))) => items.as_slice(),
        _ => &[],
    };
    let [Node::Text(code), ..] = member("args") else { return None };
    let big_endian = matches!(member("state").get(1), Some(Node::Text(order)) if order == ">");
    let bytes: String = bytes.split_whitespace().collect();
    let mut bytes = STANDARD.decode(bytes).ok()?;
    if big_endian {
        bytes.reverse();
    }
    match code.as_str() {
        "f8" => bytes.try_into().ok().map(f64::from_le_bytes),
        "f4" => bytes.try_into().ok().map(f32::from_le_bytes).map(f64::from),
        "i8" => bytes.try_into().ok().map(i64::from_le_bytes).map(|value| value as f64),
        "i4" => bytes.try_into().ok().map(i32::from_le_bytes).map(f64::from),
        _ => None,
    }
}
