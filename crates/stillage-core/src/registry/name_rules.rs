//! What names and groups may be.

/// Longest name, characters: fits one line of a list.
const LONGEST_NAME: usize = 200;
/// Longest name of a group, characters.
const LONGEST_GROUP: usize = 50;
/// Groups that one thing may be in.
const MOST_GROUPS: usize = 20;

/// A name as it is kept: without space at its ends.
///
/// # Errors
/// What it must be, to be put after its subject.
pub fn checked_name(text: &str) -> Result<String, &'static str> {
    let text = text.trim();
    let fits = (1..=LONGEST_NAME).contains(&text.chars().count()) && !text.chars().any(char::is_control);
    if fits { Ok(text.to_owned()) } else { Err("must have 1 to 200 characters, none of them a control character") }
}

/// A group as it is kept: without space at its ends.
///
/// # Errors
/// What it must be, to be put after its subject.
pub fn checked_group(text: &str) -> Result<String, &'static str> {
    let text = text.trim();
    let is_plain = !text.chars().any(|character| character.is_control() || character == '|');
    let fits = (1..=LONGEST_GROUP).contains(&text.chars().count()) && is_plain;
    if fits { Ok(text.to_owned()) } else { Err("must have 1 to 50 characters, no `|` and no control character") }
}

/// The groups of one thing as they are kept: each once, in the order in which they were given.
///
/// # Errors
/// What they must be, to be put after their subject.
pub fn checked_groups<T: AsRef<str>>(texts: impl IntoIterator<Item = T>) -> Result<Vec<String>, &'static str> {
    let mut groups: Vec<String> = Vec::new();
    for text in texts {
        let group = checked_group(text.as_ref())?;
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    if groups.len() <= MOST_GROUPS { Ok(groups) } else { Err("must be 20 groups at most") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_groups_are_short_plain_texts() {
        assert_eq!(checked_name(" Hall 3 "), Ok("Hall 3".to_owned()));
        assert!(["", " ", "two\nlines", &"x".repeat(201)].iter().all(|wrong| checked_name(wrong).is_err()));
        assert_eq!(checked_groups(["b", "a ", "b"]), Ok(vec!["b".to_owned(), "a".to_owned()]));
        assert!(checked_groups(["a|b"]).is_err() && checked_groups(["x".repeat(51)]).is_err());
        assert!(checked_groups((0..21).map(|number| number.to_string())).is_err());
    }
}
