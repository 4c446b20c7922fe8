//! Texts in YAML.
//!
//! Source: YAML 1.2.2, 5.7 and 7.3.1, yaml.org/spec/1.2.2. Numbers are written as Rust writes them, with a point.

/// A text in double quotes that every YAML reader takes for that text: `no`, `1e3` and `a: b` stay texts.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => out.extend(['\\', character]),
            // Line breaks of Unicode and marks that readers strip or refuse.
            control if control.is_control() || matches!(control, '\u{2028}' | '\u{2029}' | '\u{feff}') => {
                out.extend([format!("\\u{:04x}", u32::from(control))]);
            }
            plain => out.push(plain),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn texts_stay_texts() {
        assert_eq!(quoted("Hall 3"), r#""Hall 3""#);
        assert_eq!(quoted("a\"b\\c\n\u{85}é"), r#""a\"b\\c\u000a\u0085é""#);
    }
}
