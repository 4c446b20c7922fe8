//! Texts without the differences that do not count.

use unicode_normalization::UnicodeNormalization as _;
use unicode_normalization::char::is_combining_mark;

/// Which differences between texts do not count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Folding {
    /// Upper and lower case (`CASEI`).
    Case,
    /// Accents and other marks on letters (`ACCENTI`).
    Accents,
}

impl Folding {
    /// The text of which all texts that differ no further have the same.
    #[must_use]
    pub fn fold(self, text: &str) -> String {
        match self {
            // Up and down again: ß becomes ss, and both small sigmas one (as Unicode's full case folding has it).
            Self::Case => text.chars().flat_map(char::to_uppercase).flat_map(char::to_lowercase).collect(),
            Self::Accents => text.nfd().filter(|&character| !is_combining_mark(character)).nfc().collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn case_does_not_count() {
        for (one, other) in [("KØBENHAVN", "København"), ("Straße", "STRASSE"), ("Οδος", "ΟΔΟΣ")] {
            assert_eq!(Folding::Case.fold(one), Folding::Case.fold(other));
        }
        assert_ne!(Folding::Case.fold("Athens"), Folding::Case.fold("Äthens"));
    }

    #[test]
    fn accents_do_not_count_however_they_are_written() {
        assert_eq!(Folding::Accents.fold("Chișinău"), "Chisinau");
        assert_eq!(Folding::Accents.fold("Beyonce\u{301}"), Folding::Accents.fold("Beyoncé"));
        assert_ne!(Folding::Accents.fold("Kiev"), Folding::Accents.fold("kiev"));
    }
}
