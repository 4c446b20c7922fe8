//! What somebody may have meant by a word that nothing has.

/// How many are told.
const TOLD: usize = 3;

/// The words most like a wrong one, for people: `A, B or C`; `None` where there are no words. Fewest letters inserted, left
/// out or exchanged come first (Levenshtein 1966), upper and lower case being the same. O(words x letters²).
pub fn did_you_mean<'a>(wrong: &str, words: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let wrong: Vec<char> = wrong.to_lowercase().chars().collect();
    let mut near: Vec<(usize, &str)> = words.into_iter().map(|word| (edits(&wrong, word), word)).collect();
    near.sort_unstable();
    near.dedup();
    let words: Vec<&str> = near.into_iter().take(TOLD).map(|(_, word)| word).collect();
    match words.as_slice() {
        [] => None,
        [only] => Some((*only).to_owned()),
        [others @ .., last] => Some(format!("{} or {last}", others.join(", "))),
    }
}

/// How many letters have to be inserted, left out or exchanged.
fn edits(from: &[char], to: &str) -> usize {
    let mut row: Vec<usize> = (0..=from.len()).collect();
    for (index, letter) in to.to_lowercase().chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], index + 1);
        for (place, &other) in from.iter().enumerate() {
            let exchanged = diagonal + usize::from(other != letter);
            diagonal = row[place + 1];
            row[place + 1] = exchanged.min(diagonal + 1).min(row[place] + 1);
        }
    }
    row[from.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_words_are_told() {
        let codes = ["01-001", "01-003", "02-001", "12-345"];
        assert_eq!(did_you_mean("01-002", codes).as_deref(), Some("01-001, 01-003 or 02-001"));
        assert_eq!(did_you_mean("gate", ["Gate A"]).as_deref(), Some("Gate A"));
        assert_eq!(did_you_mean("x", []), None);
        let letters = |text: &str| text.chars().collect::<Vec<_>>();
        assert_eq!((edits(&letters("kitten"), "sitting"), edits(&[], "abc"), edits(&letters("abc"), "")), (3, 3, 3));
    }
}
