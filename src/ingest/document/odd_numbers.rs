//! Numbers that YAML's versions and readers take for different ones.
//!
//! `0x10` is 16 for one reader and no number for `map_server`; `010` is 8 in YAML 1.1 and 10 in 1.2; `1:30` is 90 or a text;
//! `1_000` likewise. None of them is what a program writes for metres, so they are not read but named.

/// The notation of a number that readers disagree about; `None` for all else.
pub(super) fn notation(text: &str) -> Option<&'static str> {
    let text = text.trim();
    let plain = text.strip_prefix(['+', '-']).unwrap_or(text);
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    if let Some(radix) = radix(plain) {
        return Some(radix);
    }
    if plain.len() > 1 && plain.starts_with('0') && digits(plain) {
        return Some("octal, or a leading zero");
    }
    let without_marks = plain.replace('_', "");
    if without_marks.len() < plain.len() && without_marks.parse::<f64>().is_ok() {
        return Some("with underscores");
    }
    let mut places = plain.split(':');
    let is_sexagesimal = plain.contains(':') && places.all(|place| digits(&place.replacen('.', "", 1)));
    is_sexagesimal.then_some("sexagesimal")
}

/// The notation of an unsigned number with a prefix.
fn radix(text: &str) -> Option<&'static str> {
    let (prefix, digits) = text.split_at_checked(2)?;
    let (name, radix) = match prefix.to_ascii_lowercase().as_str() {
        "0x" => ("hexadecimal", 16),
        "0o" => ("octal", 8),
        "0b" => ("binary", 2),
        _ => return None,
    };
    let are_digits = !digits.is_empty() && digits.chars().all(|digit| digit == '_' || digit.is_digit(radix));
    are_digits.then_some(name)
}

/// The text with quotes around numbers that have a prefix, so that the reader of YAML leaves them as they are written.
pub(super) fn kept_as_written(text: &str) -> String {
    text.split_inclusive('\n').map(line_kept_as_written).collect()
}

fn line_kept_as_written(line: &str) -> String {
    let is_between = |character: char| character.is_whitespace() || ",[]{}".contains(character);
    let (mut kept, mut quotes) = (String::with_capacity(line.len()), 0);
    for piece in line.split_inclusive(is_between) {
        let token = piece.trim_end_matches(is_between);
        let is_plain = quotes % 2 == 0;
        if is_plain && radix(token.strip_prefix(['+', '-']).unwrap_or(token)).is_some() {
            kept.extend(["\"", token, "\"", &piece[token.len()..]]);
        } else {
            kept.push_str(piece);
        }
        quotes += piece.matches(['"', '\'']).count();
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notations_are_named_and_plain_numbers_have_none() {
        for (text, name) in [
            ("0x10", "hexadecimal"),
            ("-0XfF", "hexadecimal"),
            ("0o17", "octal"),
            ("0b1", "binary"),
            ("010", "octal, or a leading zero"),
            ("1_000.5", "with underscores"),
            ("1:30", "sexagesimal"),
            ("1:30:00.5", "sexagesimal"),
        ] {
            assert_eq!(notation(text), Some(name), "{text}");
        }
        for text in ["0", "0.05", "-10", "1e-2", "0e0", "map_1", "C:", "0x", "0xg", ":", "a:1", ""] {
            assert_eq!(notation(text), None, "{text}");
        }
    }

    #[test]
    fn only_plain_numbers_are_put_in_quotes() {
        let kept = |text: &str| kept_as_written(text);
        assert_eq!(
            kept("resolution: 0x10\norigin: [0b1, -0o7,0]\n"),
            "resolution: \"0x10\"\norigin: [\"0b1\", \"-0o7\",0]\n"
        );
        for text in ["image: \"a 0x10 b\"\n", "image: 'a 0x10 b'", "image: 0x10.pgm\n", "a: 010\n", "a: \"0x10\""] {
            assert_eq!(kept(text), text);
        }
        assert_eq!(kept("{image: \"a b\", resolution: 0x10}"), "{image: \"a b\", resolution: \"0x10\"}");
    }
}
