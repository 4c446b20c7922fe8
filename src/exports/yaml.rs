//! Texts and numbers in YAML.
//!
//! Source: YAML 1.2.2, 5.1, 5.7 and 7.3.1, yaml.org/spec/1.2.2.

/// Decimals of a number: of metres and radians alike far below what a map can show.
const DECIMALS: usize = 12;

/// A number in plain decimals with a point: readers of YAML 1.1 take `1e-17` for a text and `1` for an integer.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.DECIMALS$}");
    let short = text.trim_end_matches('0');
    let short = if short.ends_with('.') { format!("{short}0") } else { short.to_owned() };
    if short == "-0.0" { "0.0".to_owned() } else { short }
}

/// A text in double quotes that every YAML reader takes for that text: `no`, `1e3` and `a: b` stay texts.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => out.extend(['\\', character]),
            // Line breaks of Unicode, and what readers strip or refuse.
            control if control.is_control() || is_refused(control) => {
                out.extend([format!("\\u{:04x}", u32::from(control))]);
            }
            plain => out.push(plain),
        }
    }
    out.push('"');
    out
}

/// Whether a character may not stand in YAML as it is: separators of lines, the byte order mark, no characters at all.
const fn is_refused(character: char) -> bool {
    matches!(character, '\u{2028}' | '\u{2029}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}')
}

#[cfg(test)]
mod tests {
    use super::{number, quoted};

    #[test]
    fn texts_stay_texts() {
        assert_eq!(quoted("Hall 3"), r#""Hall 3""#);
        assert_eq!(quoted("a\"b\\c\n\u{85}é"), r#""a\"b\\c\u000a\u0085é""#);
        assert_eq!(quoted("\0\u{7f}\u{fffe}\u{ffff}"), r#""\u0000\u007f\ufffe\uffff""#);
    }

    #[test]
    fn numbers_are_plain_decimals() {
        let texts = [1e-17, -1e-17, 0.05, -12.25, 3.0, 1e-6, 1e20].map(number);
        assert_eq!(texts, ["0.0", "0.0", "0.05", "-12.25", "3.0", "0.000001", "100000000000000000000.0"]);
    }
}
