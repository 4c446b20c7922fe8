//! A `nav_msgs/OccupancyGrid` message, as JSON ([`json`]) or as the YAML that `topic echo` prints ([`echo`]).
//!
//! `info {resolution, width, height, origin {position, orientation}}` and `data`, row-major from the lower left corner,
//! -1 to 100. The orientation must be a turn about the vertical. `header` and anything else is ignored.

mod cells;
mod decode;
mod echo;
mod json;
mod parts;

pub(super) use decode::decode;

/// Whether a file is an `OccupancyGrid` message rather than the metadata of a map image: it has the message's own keys.
#[must_use]
pub fn is_message(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if start.starts_with(b"{") {
        let has = |key: &[u8]| start.windows(key.len()).any(|window| window == key);
        return has(b"\"info\"") && has(b"\"data\"");
    }
    std::str::from_utf8(bytes).is_ok_and(echo::is_message)
}

#[cfg(test)]
mod tests {
    use super::is_message;

    #[test]
    fn messages_are_told_from_metadata() {
        assert!(is_message(br#" {"info": {"width": 1}, "data": [0]}"#));
        assert!(is_message(b"info:\n  width: 1\ndata: [0]\n---\n"));
        assert!(!is_message(br#"{"image": "map.png"}"#));
        assert!(!is_message(b"image: info\ndata: 1\n"));
    }
}
