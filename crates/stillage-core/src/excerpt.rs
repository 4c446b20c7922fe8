//! What a refusal repeats of the input.

/// Most characters of a text that are repeated.
const LONGEST: usize = 40;

/// The beginning of a text, short enough to be repeated.
#[must_use]
pub fn excerpt(text: &str) -> String {
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_is_cut_between_characters() {
        assert_eq!(excerpt("Halle Süd"), "Halle Süd");
        assert_eq!(excerpt(&"ü".repeat(41)), format!("{}...", "ü".repeat(40)));
    }
}
