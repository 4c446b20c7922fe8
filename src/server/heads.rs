//! Heads of requests whose lines end with a line feed alone.
//!
//! The parser below takes them (RFC 9112, 2.2 lets it), and programs in front of the service may not: of what two programs read
//! differently, requests are smuggled. This watches the bytes on their way to the parser. A line feed of a head that has no
//! carriage return before it becomes a NUL, which the parser refuses with 400. Bytes of bodies are never touched: their length is
//! followed by the same headers that the parser follows, and where those are strange the watch ends.

/// Bytes of a line that are kept: `Transfer-Encoding: chunked` and `Content-Length` with twenty digits and some blanks fit.
const LINE_BYTES: usize = 128;

/// Follows the bytes of a connection.
#[derive(Debug, Default)]
pub struct HeadWatch {
    place: StreamPosition,
    /// The beginning of the line that is being read.
    line: Vec<u8>,
    /// The last byte of the line.
    last: u8,
    framing: Framing,
}

/// Where the next byte belongs.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
enum StreamPosition {
    /// To empty lines before a head.
    #[default]
    Before,
    Head,
    /// To the body, of which so many bytes are left.
    Body(u64),
    /// To the line that tells the length of a chunk.
    ChunkSize,
    /// To a chunk and the end of its line, of which so many bytes are left.
    Chunk(u64),
    Trailer,
    /// Nobody knows: nothing is watched any more.
    Lost,
}

/// What a head says about its body.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
enum Framing {
    #[default]
    None,
    Length(u64),
    Chunked,
    Strange,
}

impl HeadWatch {
    /// Looks at the bytes that come next. O(bytes), of bodies O(1).
    pub fn pass(&mut self, mut bytes: &mut [u8]) {
        while !bytes.is_empty() && self.place != StreamPosition::Lost {
            let taken = match self.place {
                StreamPosition::Body(left) | StreamPosition::Chunk(left) => {
                    let taken = usize::try_from(left).unwrap_or(usize::MAX).min(bytes.len());
                    let rest = left - taken as u64;
                    self.place = match self.place {
                        StreamPosition::Chunk(_) if rest == 0 => StreamPosition::ChunkSize,
                        StreamPosition::Chunk(_) => StreamPosition::Chunk(rest),
                        _ if rest == 0 => StreamPosition::Before,
                        _ => StreamPosition::Body(rest),
                    };
                    taken
                }
                _ => self.line_of(bytes),
            };
            bytes = &mut bytes[taken..];
        }
    }

    /// Reads up to the end of the line, or of the bytes; how many that were.
    fn line_of(&mut self, bytes: &mut [u8]) -> usize {
        let end = memchr::memchr(b'\n', bytes);
        let text = &bytes[..end.unwrap_or(bytes.len())];
        self.line.extend_from_slice(&text[..text.len().min(LINE_BYTES - self.line.len())]);
        self.last = text.last().copied().unwrap_or(self.last);
        let Some(end) = end else { return bytes.len() };
        if self.last == b'\r' {
            self.end_line();
        } else {
            bytes[end] = 0;
            self.place = StreamPosition::Lost;
        }
        self.line.clear();
        self.last = 0;
        end + 1
    }

    fn end_line(&mut self) {
        let line = self.line.strip_suffix(b"\r").unwrap_or(&self.line);
        self.place = match self.place {
            StreamPosition::Before | StreamPosition::Trailer if line.is_empty() => StreamPosition::Before,
            StreamPosition::Before => StreamPosition::Head,
            StreamPosition::Head if line.is_empty() => match std::mem::take(&mut self.framing) {
                Framing::None | Framing::Length(0) => StreamPosition::Before,
                Framing::Length(bytes) => StreamPosition::Body(bytes),
                Framing::Chunked => StreamPosition::ChunkSize,
                Framing::Strange => StreamPosition::Lost,
            },
            StreamPosition::Head => {
                self.framing = self.framing.and(line);
                StreamPosition::Head
            }
            StreamPosition::ChunkSize => match chunk_size(line) {
                Some(0) => StreamPosition::Trailer,
                // The chunk ends with a line end of its own.
                Some(bytes) => bytes.checked_add(2).map_or(StreamPosition::Lost, StreamPosition::Chunk),
                None => StreamPosition::Lost,
            },
            other => other,
        };
    }
}

impl Framing {
    /// What is known after a further header line.
    fn and(self, line: &[u8]) -> Self {
        let Some(colon) = line.iter().position(|&byte| byte == b':') else { return self };
        let (name, value) = (&line[..colon], line[colon + 1..].trim_ascii());
        if name.eq_ignore_ascii_case(b"content-length") {
            let length = std::str::from_utf8(value).ok().and_then(|digits| digits.parse().ok());
            return match (self, length) {
                (Self::None, Some(length)) => Self::Length(length),
                _ => Self::Strange,
            };
        }
        if name.eq_ignore_ascii_case(b"transfer-encoding") {
            let is_plain = self == Self::None && value.eq_ignore_ascii_case(b"chunked");
            return if is_plain { Self::Chunked } else { Self::Strange };
        }
        self
    }
}

/// The length of a chunk, without its extensions.
fn chunk_size(line: &[u8]) -> Option<u64> {
    let digits = line.split(|&byte| byte == b';').next()?.trim_ascii();
    u64::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// What the parser is given of a stream that arrives in pieces.
    fn passed(stream: &[u8], piece: usize) -> Vec<u8> {
        let mut watch = HeadWatch::default();
        let mut bytes = stream.to_vec();
        bytes.chunks_mut(piece.max(1)).for_each(|piece| watch.pass(piece));
        bytes
    }

    const GET: &[u8] = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
    const POST: &[u8] = b"POST / HTTP/1.1\r\ncontent-length: 9\r\n\r\na\nb\nc\r\n\n\n";
    const CHUNKED: &[u8] =
        b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n3;x=y\r\n\n\n\n\r\nA\r\n0123\n56\r\n9\r\n0\r\nX: y\r\n\r\n";

    #[test]
    fn a_line_feed_alone_in_a_head_does_not_reach_the_parser() {
        let bare: &[u8] = b"GET / HTTP/1.1\nHost: localhost\n\n";
        assert!(passed(bare, 7).starts_with(b"GET / HTTP/1.1\0Host"));
        for before in [GET, POST, CHUNKED, b"\r\n"] {
            let stream = [before, b"GET / HTTP/1.1\r\nHost: x\nA: b\r\n\r\n"].concat();
            let passed = passed(&stream, 11);
            assert_eq!(passed[..before.len()], *before);
            assert!(passed.ends_with(b"Host: x\0A: b\r\n\r\n"), "{:?}", String::from_utf8_lossy(&passed));
        }
    }

    #[test]
    fn behind_what_is_strange_nothing_is_touched() {
        for header in
            ["Content-Length: 1\r\nContent-Length: 2", "Content-Length: x", "Transfer-Encoding: gzip, chunked"]
        {
            let stream = format!("POST / HTTP/1.1\r\n{header}\r\n\r\n\n\n\n").into_bytes();
            assert_eq!(passed(&stream, 5), stream, "{header}");
        }
    }

    proptest! {
        #[test]
        fn what_is_right_passes_as_it_is_however_it_is_cut(
            order in prop::collection::vec(0..3_usize, 1..6),
            piece in 1..80_usize,
        ) {
            let stream: Vec<u8> = order.iter().flat_map(|&kind| [GET, POST, CHUNKED][kind]).copied().collect();
            prop_assert_eq!(passed(&stream, piece), stream);
        }
    }
}
