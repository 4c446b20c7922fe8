//! What a code may be.

/// Longest code, characters: that of a storage bin in SAP.
pub const LONGEST_CODE: usize = 18;

/// What is wrong with a code.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct CodeProblem(String);

/// Checks a code that people give: 1 to [`LONGEST_CODE`] characters, no comma, no control characters, no space at its
/// ends.
///
/// # Errors
/// [`CodeProblem`] says which of these it breaks.
pub fn check_code(code: &str) -> Result<(), CodeProblem> {
    let length = code.chars().count();
    if !(1..=LONGEST_CODE).contains(&length) {
        return Err(CodeProblem(format!("a code has 1 to {LONGEST_CODE} characters, this one has {length}")));
    }
    if let Some(wrong) = code.chars().find(|&character| !is_allowed(character)) {
        let what = if wrong == ',' { "a comma: it stands between the codes of a list" } else { "a control character" };
        return Err(CodeProblem(format!("a code may not have {what}")));
    }
    if code.trim() != code {
        return Err(CodeProblem("a code neither begins nor ends with a space".to_owned()));
    }
    Ok(())
}

/// Whether a character may stand in a code.
pub(super) fn is_allowed(character: char) -> bool {
    !character.is_control() && character != ','
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_short_plain_texts() {
        for right in ["03-012", "A", "Regal 7/Fach 12", "123456789012345678", "ÄÖÜ-ÄÖÜ-ÄÖÜ-ÄÖÜ-ÄÖ"] {
            assert_eq!(check_code(right), Ok(()), "{right}");
        }
        let problem = |code: &str| check_code(code).expect_err(code).to_string();
        assert_eq!(problem("1234567890123456789"), "a code has 1 to 18 characters, this one has 19");
        assert_eq!(problem("1,2"), "a code may not have a comma: it stands between the codes of a list");
        assert_eq!(problem("1\t2"), "a code may not have a control character");
        assert_eq!(problem(" 1"), "a code neither begins nor ends with a space");
        assert!(check_code("").is_err());
    }
}
