//! The patterns of LIKE.

/// A pattern: `%` is any characters or none, `_` is one character, `\` takes the meaning from either.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LikePattern(Vec<Step>);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Step {
    Character(char),
    AnyOne,
    AnyNumber,
}

impl LikePattern {
    /// Reads a pattern.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let mut steps = Vec::new();
        let mut characters = text.chars().peekable();
        while let Some(character) = characters.next() {
            steps.push(match character {
                '%' => Step::AnyNumber,
                '_' => Step::AnyOne,
                '\\' => Step::Character(characters.next_if(|next| matches!(next, '%' | '_' | '\\')).unwrap_or('\\')),
                _ => Step::Character(character),
            });
        }
        steps.dedup_by(|one, other| *one == Step::AnyNumber && *other == Step::AnyNumber);
        Self(steps)
    }

    /// Whether a whole text fits. O(pattern x text): only the last `%` is ever taken back.
    #[must_use]
    pub fn fits(&self, text: &str) -> bool {
        let mut rest = text.chars();
        let mut position = 0;
        // Where to go on when a step does not fit: after the last `%`, one character further on.
        let mut retry: Option<(usize, std::str::Chars<'_>)> = None;
        loop {
            match self.0.get(position) {
                Some(Step::AnyNumber) => {
                    position += 1;
                    retry = Some((position, rest.clone()));
                    continue;
                }
                Some(&step) => {
                    let next = rest.next();
                    if next.is_some_and(|next| step == Step::AnyOne || step == Step::Character(next)) {
                        position += 1;
                        continue;
                    }
                }
                None if rest.as_str().is_empty() => return true,
                None => {}
            }
            let Some((after, from)) = &mut retry else { return false };
            if from.next().is_none() {
                return false;
            }
            (position, rest) = (*after, from.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_fit_whole_texts() {
        for (pattern, fits, fails) in [
            ("B_r%", "Berlin", "Bonn"),
            ("%office%", "back office 2", "offic"),
            ("%", "", "no text fails"),
            ("a%b%c", "aXbXbc", "aXc"),
            ("_", "ø", "oe"),
            (r"50\%", "50%", "500"),
            (r"a\_b", "a_b", "aXb"),
            ("", "", "x"),
        ] {
            assert!(LikePattern::new(pattern).fits(fits), "{pattern} fits {fits}");
            assert!(pattern == "%" || !LikePattern::new(pattern).fits(fails), "{pattern} does not fit {fails}");
        }
    }

    #[test]
    fn many_wildcards_take_no_time() {
        let (pattern, text) = ("%a".repeat(2000), "a".repeat(1999) + "b");
        assert!(!LikePattern::new(&pattern).fits(&text));
    }
}
