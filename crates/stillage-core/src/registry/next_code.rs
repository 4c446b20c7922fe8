//! A code that was never used, next to a proposed one.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::layout::LONGEST_CODE;

/// Bays of one side of an aisle are two apart: odd left, even right.
const STEP: u64 = 2;

/// The proposed code where it was never used; else the same code with a higher number for its bay, on the same side.
///
/// Where that would be longer than a code may be, the end of the proposed one makes room for a number.
///
/// The bay is the second number of a code (`03-012`, `03-012-2`), or the only one; a code without a number gets one.
pub(super) fn unused(proposed: &str, used: &BTreeSet<String>) -> String {
    if !used.contains(proposed) {
        return proposed.to_owned();
    }
    let numbers = numbers(proposed);
    let Some(place) = numbers.get(1).or_else(|| numbers.first()).cloned() else {
        return first_unused(|step| shortened(proposed, &format!("-{}", step + 1)), used);
    };
    let (before, digits, after) = (&proposed[..place.start], &proposed[place.clone()], &proposed[place.end..]);
    let number: u64 = digits.parse().unwrap_or(0);
    // Behind the last one of the aisle, so that a gap that somebody remembers is not filled.
    let bays = used.iter().filter_map(|code| code.strip_prefix(before)?.strip_suffix(after)?.parse::<u64>().ok());
    let last = bays.filter(|bay| bay % STEP == number % STEP).max().unwrap_or(number);
    let width = digits.len();
    let next = first_unused(|step| format!("{before}{:0width$}{after}", last.saturating_add(STEP * step)), used);
    if next.chars().count() <= LONGEST_CODE {
        return next;
    }
    first_unused(|step| shortened(proposed, &format!("-{}", step + 1)), used)
}

/// The first of many codes, counted from 1, that was never used: among one more than were used there is one.
fn first_unused(code: impl Fn(u64) -> String, used: &BTreeSet<String>) -> String {
    let codes = (1..=used.len() as u64 + 1).map(code);
    codes.into_iter().find(|code| !used.contains(code)).unwrap_or_default()
}

/// A code with something at its end, the code cut where the whole would be too long.
fn shortened(code: &str, end: &str) -> String {
    code.chars().take(LONGEST_CODE.saturating_sub(end.len())).chain(end.chars()).collect()
}

/// Where the numbers of a code stand.
fn numbers(code: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    for (at, _) in code.char_indices().filter(|(_, character)| character.is_ascii_digit()) {
        match found.last_mut() {
            Some(number) if number.end == at => number.end = at + 1,
            _ => found.push(at..at + 1),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn next(proposed: &str, used: &[&str]) -> String {
        unused(proposed, &used.iter().map(|code| (*code).to_owned()).collect())
    }

    #[test]
    fn an_unused_code_is_taken_as_it_is() {
        assert_eq!(next("03-012", &["03-010"]), "03-012");
    }

    #[test]
    fn the_numbering_goes_on_behind_the_last_bay_of_the_same_side() {
        assert_eq!(next("03-012", &["03-012", "03-013", "03-020", "03-021", "04-100"]), "03-022");
        assert_eq!(next("03-012-2", &["03-012-2", "03-012"]), "03-014-2");
        assert_eq!(next("A7", &["A7"]), "A9");
        assert_eq!(next("01-999", &["01-999"]), "01-1001");
    }

    #[test]
    fn a_code_without_a_number_gets_one() {
        assert_eq!(next("dock", &["dock", "dock-2"]), "dock-3");
    }

    #[test]
    fn no_code_grows_beyond_the_longest() {
        assert_eq!(next("high rack 01-00999", &["high rack 01-00999"]), "high rack 01-01001");
        assert_eq!(next("very high rack 1-9", &["very high rack 1-9"]), "very high rack 1-2");
        let dock = "the dock in the eas";
        assert_eq!(next(&dock[..18], &[&dock[..18]]), "the dock in the -2");
    }
}
