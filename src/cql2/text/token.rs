//! The words of `cql2-text`.

use std::fmt;

use stillage_core::excerpt;

use crate::cql2::error::FilterError;

/// A word with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Token {
    /// What it is.
    pub word: Word,
    /// Its first byte.
    pub start: usize,
}

/// A word.
#[derive(Debug, Clone, PartialEq)]
pub enum Word {
    /// A name or keyword.
    Name(String),
    /// A name between double quotes, which is never a keyword.
    Quoted(String),
    /// A text between single quotes.
    Text(String),
    /// A number without sign.
    Number(f64),
    /// A sign or a pair of signs.
    Sign(&'static str),
    /// Nothing comes any more.
    End,
}

impl Word {
    /// Whether it is this keyword, in any case.
    pub fn is_keyword(&self, keyword: &str) -> bool {
        matches!(self, Self::Name(name) if name.eq_ignore_ascii_case(keyword))
    }
}

impl fmt::Display for Word {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => formatter.write_str(&excerpt(name)),
            Self::Quoted(name) => write!(formatter, "\"{}\"", excerpt(name)),
            Self::Text(text) => write!(formatter, "'{}'", excerpt(text)),
            Self::Number(number) => number.fmt(formatter),
            Self::Sign(sign) => formatter.write_str(sign),
            Self::End => formatter.write_str("the end"),
        }
    }
}

/// The signs; the longer ones come first.
const SIGNS: [&str; 15] = ["<>", "<=", ">=", "<", ">", "=", "(", ")", ",", "+", "-", "*", "/", "%", "^"];

/// Which characters a name begins with (the standard's grammar, which takes them from XML).
const NAME_STARTS: [(char, char); 16] = [
    (':', ':'),
    ('_', '_'),
    ('A', 'Z'),
    ('a', 'z'),
    ('\u{C0}', '\u{D6}'),
    ('\u{D8}', '\u{F6}'),
    ('\u{F8}', '\u{2FF}'),
    ('\u{370}', '\u{37D}'),
    ('\u{37F}', '\u{1FFE}'),
    ('\u{200C}', '\u{200D}'),
    ('\u{2070}', '\u{218F}'),
    ('\u{2C00}', '\u{2FEF}'),
    ('\u{3001}', '\u{D7FF}'),
    ('\u{F900}', '\u{FDCF}'),
    ('\u{FDF0}', '\u{FFFD}'),
    ('\u{10000}', '\u{EFFFF}'),
];

/// Which characters it goes on with besides.
const NAME_PARTS: [(char, char); 4] = [('.', '.'), ('0', '9'), ('\u{300}', '\u{36F}'), ('\u{203F}', '\u{2040}')];

fn is_in(ranges: &[(char, char)], character: char) -> bool {
    ranges.iter().any(|&(first, last)| (first..=last).contains(&character))
}

/// The words of a text, the last one [`Word::End`].
///
/// # Errors
/// Where no word begins, or a text or name does not end.
pub fn read(text: &str) -> Result<Vec<Token>, FilterError> {
    let mut tokens = Vec::new();
    let mut start = 0;
    while let Some(first) = text[start..].chars().next() {
        if first.is_whitespace() {
            start += first.len_utf8();
            continue;
        }
        let (word, length) = word(&text[start..], first).map_err(|detail| FilterError::in_text(text, start, detail))?;
        tokens.push(Token { word, start });
        start += length;
    }
    tokens.push(Token { word: Word::End, start });
    Ok(tokens)
}

/// The word that a text begins with, and its length in bytes.
fn word(rest: &str, first: char) -> Result<(Word, usize), String> {
    match first {
        '\'' => quoted(rest, '\'').map(|(text, length)| (Word::Text(text), length)),
        '"' => quoted(rest, '"').map(|(name, length)| (Word::Quoted(name), length)),
        '0'..='9' | '.' => number(rest),
        _ if is_in(&NAME_STARTS, first) => {
            let is_part = |character| is_in(&NAME_STARTS, character) || is_in(&NAME_PARTS, character);
            let length = rest.find(|character| !is_part(character)).unwrap_or(rest.len());
            Ok((Word::Name(rest[..length].to_owned()), length))
        }
        _ => {
            let sign = SIGNS.into_iter().find(|sign| rest.starts_with(sign));
            sign.map(|sign| (Word::Sign(sign), sign.len())).ok_or_else(|| format!("{first:?} has no meaning here"))
        }
    }
}

/// A text between quotes: two quotes are one, and a backslash takes the meaning from the single one.
fn quoted(rest: &str, quote: char) -> Result<(String, usize), String> {
    let mut text = String::new();
    let mut characters = rest.char_indices().skip(1).peekable();
    while let Some((index, character)) = characters.next() {
        let next = characters.peek().map(|&(_, next)| next);
        match character {
            '\\' if quote == '\'' && next == Some(quote) => {
                text.push(quote);
                characters.next();
            }
            _ if character != quote => text.push(character),
            _ if next == Some(quote) => {
                text.push(quote);
                characters.next();
            }
            _ => return Ok((text, index + quote.len_utf8())),
        }
    }
    Err(format!("the text that begins here has no closing {quote}"))
}

/// A number: digits with a point and an exponent, if any.
fn number(rest: &str) -> Result<(Word, usize), String> {
    let digits = |from: usize| rest[from..].bytes().take_while(u8::is_ascii_digit).count();
    let mut length = digits(0);
    let mut has_digits = length > 0;
    if rest[length..].starts_with('.') {
        let fraction = digits(length + 1);
        has_digits |= fraction > 0;
        length += 1 + fraction;
    }
    if rest[length..].starts_with(['e', 'E']) {
        let sign = usize::from(rest[length + 1..].starts_with(['+', '-']));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    let number = rest[..length].parse().ok().filter(|number: &f64| has_digits && number.is_finite());
    number
        .map(|number| (Word::Number(number), length))
        .ok_or_else(|| format!("{} is no number", excerpt(&rest[..length])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<Word> {
        read(text).unwrap().into_iter().map(|token| token.word).collect()
    }

    #[test]
    fn texts_and_names_end_at_their_quotes() {
        assert_eq!(words(r"'it''s'")[0], Word::Text("it's".into()));
        assert_eq!(words(r"'it\'s'")[0], Word::Text("it's".into()));
        assert_eq!(words(r"'50\%'")[0], Word::Text(r"50\%".into()), "an escape of LIKE stays");
        assert_eq!(words("\"area m2\"")[0], Word::Quoted("area m2".into()));
        assert_eq!(read("a = 'b").unwrap_err().to_string(), "column 5: the text that begins here has no closing '");
    }

    #[test]
    fn numbers_have_no_sign() {
        for (text, number) in [("5", 5.0), ("5.", 5.0), (".5", 0.5), ("1.5E-3", 0.0015), ("2e3", 2000.0)] {
            assert_eq!(words(text), [Word::Number(number), Word::End], "{text}");
        }
        assert_eq!(words("5e"), [Word::Number(5.0), Word::Name("e".into()), Word::End]);
        assert_eq!(read("1e999").unwrap_err().to_string(), "column 1: 1e999 is no number");
        assert_eq!(read("ü + .").unwrap_err().to_string(), "column 5: . is no number");
    }

    #[test]
    fn signs_without_meaning_are_refused() {
        assert_eq!(read("a ; b").unwrap_err().to_string(), "column 3: ';' has no meaning here");
    }
}
