//! Names of parts and files in `Content-Disposition` (RFC 7578, RFC 6266).
//!
//! Names of files arrive as UTF-8 (curl, Python), with `"` as `%22` (browsers, WHATWG HTML), as `filename*` (RFC 5987) and as
//! encoded words (RFC 2047; .NET sends both). Character sets are UTF-8 and Latin-1, which Windows-1252 is read as.

use axum::http::{HeaderMap, header};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// What a part says of itself.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Disposition {
    /// Name of the part.
    pub name: Option<String>,
    /// Name of its file, readable; it may be a path.
    pub file_name: Option<String>,
}

impl Disposition {
    /// Reads the headers of a part.
    #[must_use]
    pub fn of(headers: &HeaderMap) -> Self {
        headers.get(header::CONTENT_DISPOSITION).map(|value| Self::read(&text(value.as_bytes()))).unwrap_or_default()
    }

    fn read(value: &str) -> Self {
        let parameters = parameters(value);
        let find = |wanted: &str| parameters.iter().find(|(name, _)| name == wanted).map(|(_, value)| value.as_str());
        let extended = find("filename*").and_then(extended_value);
        let plain = || find("filename").map(|value| encoded_words(value).replace("%22", "\""));
        Self { name: find("name").map(str::to_owned), file_name: extended.or_else(plain) }
    }
}

/// The parameters behind the first `;`: names in lower case, values without quotes.
fn parameters(value: &str) -> Vec<(String, String)> {
    let mut parameters = Vec::new();
    let mut rest = value.split_once(';').map_or("", |(_, rest)| rest);
    while let Some((name, after)) = rest.split_once('=') {
        let name = name.trim_matches([';', ' ', '\t']).to_ascii_lowercase();
        let value;
        (value, rest) = if let Some(quoted) = after.trim_start().strip_prefix('"') {
            quoted_string(quoted)
        } else {
            let (token, rest) = after.split_at(after.find(';').unwrap_or(after.len()));
            (token.trim().to_owned(), rest)
        };
        parameters.push((name, value));
    }
    parameters
}

/// A text up to its closing quote, and what follows. A backslash escapes quotes and backslashes only: `C:\maps\hall.png`
/// is sent as it is.
fn quoted_string(text: &str) -> (String, &str) {
    let mut value = String::new();
    let mut characters = text.char_indices().peekable();
    while let Some((at, character)) = characters.next() {
        match character {
            '"' => return (value, &text[at + 1..]),
            '\\' => match characters.next_if(|(_, next)| matches!(next, '"' | '\\')) {
                Some((_, escaped)) => value.push(escaped),
                None => value.push('\\'),
            },
            other => value.push(other),
        }
    }
    (value, "")
}

/// `utf-8''Halle%20S%C3%BCd.png` (RFC 5987).
fn extended_value(value: &str) -> Option<String> {
    let mut pieces = value.splitn(3, '\'');
    let (charset, _, encoded) = (pieces.next()?, pieces.next()?, pieces.next()?);
    decode(charset, &unescape(encoded, '%'))
}

/// A text with its encoded words decoded: `=?utf-8?B?SGFsbGUgU8O8ZC5wbmc=?=` (RFC 2047). Blanks between two of them are left
/// out, as one word may be too short for a name.
fn encoded_words(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    let mut after_word = false;
    while let Some((word, start, end)) = next_word(rest) {
        let between = &rest[..start];
        if !(after_word && between.trim().is_empty()) {
            plain.push_str(between);
        }
        plain.push_str(&word);
        rest = &rest[end..];
        after_word = true;
    }
    plain + rest
}

/// The first encoded word of a text, decoded, and where it begins and ends.
fn next_word(text: &str) -> Option<(String, usize, usize)> {
    let start = text.find("=?")?;
    let mut pieces = text[start + 2..].splitn(4, '?');
    let (charset, encoding, content, rest) = (pieces.next()?, pieces.next()?, pieces.next()?, pieces.next()?);
    let rest = rest.strip_prefix('=')?;
    let bytes = match encoding {
        "B" | "b" => STANDARD.decode(content).ok()?,
        "Q" | "q" => unescape(&content.replace('_', " "), '='),
        _ => return None,
    };
    Some((decode(charset, &bytes)?, start, text.len() - rest.len()))
}

/// Bytes of a text in which a mark and two hexadecimal digits stand for a byte.
fn unescape(text: &str, mark: char) -> Vec<u8> {
    let mut pieces = text.split(mark);
    let mut bytes = pieces.next().unwrap_or_default().as_bytes().to_vec();
    for piece in pieces {
        if let Some(byte) = piece.get(..2).and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            bytes.push(byte);
            bytes.extend_from_slice(&piece.as_bytes()[2..]);
        } else {
            bytes.push(mark as u8);
            bytes.extend_from_slice(piece.as_bytes());
        }
    }
    bytes
}

/// Bytes in a character set; `None` for one that is not known.
fn decode(charset: &str, bytes: &[u8]) -> Option<String> {
    match charset.to_ascii_lowercase().as_str() {
        "utf-8" | "utf8" | "us-ascii" => Some(text(bytes)),
        "iso-8859-1" | "latin1" | "windows-1252" => Some(latin_1(bytes)),
        _ => None,
    }
}

/// UTF-8, or Latin-1 where it is not.
fn text(bytes: &[u8]) -> String {
    std::str::from_utf8(bytes).map_or_else(|_| latin_1(bytes), str::to_owned)
}

fn latin_1(bytes: &[u8]) -> String {
    bytes.iter().copied().map(char::from).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file_name(value: &[u8]) -> String {
        let value = [b"form-data; name=\"image\"; ", value].concat();
        let headers = [(header::CONTENT_DISPOSITION, value.as_slice().try_into().unwrap())].into_iter().collect();
        let disposition = Disposition::of(&headers);
        assert_eq!(disposition.name.as_deref(), Some("image"));
        disposition.file_name.unwrap_or_default()
    }

    #[test]
    fn file_names_are_readable_however_they_are_sent() {
        for value in [
            "filename=\"Halle Süd.png\"".as_bytes(),
            b"filename=\"Halle S\xfcd.png\"",
            b"filename=\"=?utf-8?B?SGFsbGUgU8O8ZC5wbmc=?=\"; filename*=utf-8''Halle%20S%C3%BCd.png",
            b"filename=\"=?utf-8?B?SGFsbGUgU8O8ZC5wbmc=?=\"",
            b"filename=\"=?iso-8859-1?Q?Halle_S=FCd?= =?utf-8?q?=2Epng?=\"",
            b"filename=hall.png; filename*=ISO-8859-1'de'Halle%20S%FCd.png",
        ] {
            assert_eq!(file_name(value), "Halle Süd.png", "{}", String::from_utf8_lossy(value));
        }
        assert_eq!(file_name(br#"filename="C:\maps\hall.png""#), r"C:\maps\hall.png");
        assert_eq!(file_name(br#"filename="a \"b\"; c=d.png""#), r#"a "b"; c=d.png"#);
        assert_eq!(file_name(br#"filename="a %22b%22.png""#), r#"a "b".png"#);
        assert_eq!(file_name(b"filename=\"100 % =?full.png\""), "100 % =?full.png");
        assert_eq!(file_name(b"filename=\"hall.png\"; filename*=koi8-r''%C8"), "hall.png");
        assert_eq!(file_name(b""), "");
    }

    #[test]
    fn names_come_without_quotes_too() {
        let read = |value: &str| Disposition::read(value).name;
        assert_eq!(read("form-data; name=image; filename=a.png").as_deref(), Some("image"));
        assert_eq!(read("form-data;NAME = \"image\"").as_deref(), Some("image"));
        assert_eq!(read("form-data; filename=\"name=x\"").as_deref(), None);
        assert_eq!(read("form-data").as_deref(), None);
    }
}
