//! How the codes of locations are written.
//!
//! A template is text with fields in braces: `{aisle:02}-{bay:03}` writes aisle 3, bay 12 as `03-012`. A number after
//! the colon is the least width; shorter numbers are filled with zeros.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use super::code::{LONGEST_CODE, is_allowed};
use super::location::Side;

/// The template where nobody asks for another.
const DEFAULT: &str = "{aisle:02}-{bay:03}";

/// A number or word of a location that stands in its code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Field {
    Aisle,
    Bay,
    Row,
    Depth,
    /// `L` or `R`.
    Side,
}

impl Field {
    const ALL: [(&'static str, Self); 5] =
        [("aisle", Self::Aisle), ("bay", Self::Bay), ("row", Self::Row), ("depth", Self::Depth), ("side", Self::Side)];

    fn find(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == name).map(|&(_, field)| field)
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum TemplatePart {
    Text(String),
    Field(Field, usize),
}

/// How codes are written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct CodeTemplate {
    text: String,
    pieces: Vec<TemplatePart>,
}

/// What is wrong with a template.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("at character {at} of the template: {what}")]
pub struct TemplateProblem {
    /// Which character, from 1.
    pub at: usize,
    /// What is wrong, and what would do.
    pub what: String,
}

/// The numbers that go into a code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct CodeNumbers {
    pub aisle: u32,
    pub bay: u32,
    pub row: u32,
    pub depth: u32,
    pub side: Option<Side>,
}

impl CodeNumbers {
    /// The number of a field; 0 for the side, which is a letter.
    fn of(&self, field: Field) -> u32 {
        match field {
            Field::Aisle => self.aisle,
            Field::Bay => self.bay,
            Field::Row => self.row,
            Field::Depth => self.depth,
            Field::Side => 0,
        }
    }
}

impl Default for CodeTemplate {
    fn default() -> Self {
        Self::parse(DEFAULT).expect("the default template is valid")
    }
}

impl CodeTemplate {
    /// Reads a template.
    ///
    /// # Errors
    /// [`TemplateProblem`] when a brace or a field is wrong, or when it names neither `{bay}` nor an aisle or row with
    /// it: codes would not be unique.
    pub fn parse(text: &str) -> Result<Self, TemplateProblem> {
        let mut pieces = Vec::new();
        let mut rest = text;
        let at = |rest: &str| text.chars().count() - rest.chars().count() + 1;
        while !rest.is_empty() {
            let plain = rest.find(['{', '}']).unwrap_or(rest.len());
            if plain > 0 {
                pieces.push(TemplatePart::Text(rest[..plain].to_owned()));
                rest = &rest[plain..];
                continue;
            }
            let problem = |what: String| TemplateProblem { at: at(rest), what };
            let inner = rest.strip_prefix('{').ok_or_else(|| problem("a } without a {".to_owned()))?;
            let end = inner.find(['{', '}']).filter(|&end| inner[end..].starts_with('}'));
            let end = end.ok_or_else(|| problem("a { without a }".to_owned()))?;
            pieces.push(field(&inner[..end]).map_err(problem)?);
            rest = &inner[end + 1..];
        }
        let has = |wanted: Field| {
            pieces.iter().any(|piece| matches!(piece, TemplatePart::Field(field, _) if *field == wanted))
        };
        if !has(Field::Bay) || !(has(Field::Aisle) || has(Field::Row)) {
            let what = "codes would not be unique: name {bay} and {aisle}, like {aisle:02}-{bay:03}".to_owned();
            return Err(TemplateProblem { at: text.chars().count().max(1), what });
        }
        if let Some(at) = text.chars().position(|character| !is_allowed(character)) {
            let what = "commas and control characters do not belong into a code".to_owned();
            return Err(TemplateProblem { at: at + 1, what });
        }
        if text.trim() != text {
            return Err(TemplateProblem { at: 1, what: "a code neither begins nor ends with a space".to_owned() });
        }
        Ok(Self { text: text.to_owned(), pieces })
    }

    /// The text it was read from.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// The template with its numbers wide enough for some locations, so that all codes are of one width and sort as text.
    fn widened(&self, all: &[CodeNumbers]) -> Self {
        let digits = |field: Field| all.iter().map(|numbers| numbers.of(field)).max().unwrap_or(0).to_string().len();
        let widen = |piece: &TemplatePart| match *piece {
            TemplatePart::Field(field, width) => TemplatePart::Field(field, width.max(digits(field))),
            TemplatePart::Text(ref text) => TemplatePart::Text(text.clone()),
        };
        Self { text: self.text.clone(), pieces: self.pieces.iter().map(widen).collect() }
    }

    /// The codes of locations, in their order; the codes that are too long, where there are some.
    pub(super) fn write_all(&self, all: &[CodeNumbers]) -> Result<Vec<String>, Vec<String>> {
        let template = self.widened(all);
        let codes: Vec<String> = all.iter().map(|&numbers| template.write(numbers)).collect();
        let is_long = |code: &&String| code.chars().count() > LONGEST_CODE;
        let mut long: Vec<String> = codes.iter().filter(is_long).cloned().collect();
        long.sort();
        if long.is_empty() { Ok(codes) } else { Err(long) }
    }

    /// The code of a location. Locations behind others carry their depth at the end, unless the template names it.
    fn write(&self, numbers: CodeNumbers) -> String {
        let mut code = String::new();
        let mut names_depth = false;
        for piece in &self.pieces {
            match piece {
                TemplatePart::Text(text) => code.push_str(text),
                TemplatePart::Field(Field::Side, _) => code.push_str(match numbers.side {
                    Some(Side::Left) => "L",
                    Some(Side::Right) => "R",
                    None => "X",
                }),
                TemplatePart::Field(field, width) => {
                    names_depth |= *field == Field::Depth;
                    write!(code, "{:0width$}", numbers.of(*field)).expect("text takes every number");
                }
            }
        }
        if numbers.depth > 1 && !names_depth {
            write!(code, "-{}", numbers.depth).expect("text takes every number");
        }
        code
    }
}

/// Reads `name` or `name:width`.
fn field(text: &str) -> Result<TemplatePart, String> {
    let (name, width) = text.split_once(':').unwrap_or((text, "1"));
    let known = || Field::ALL.map(|(name, _)| format!("{{{name}}}")).join(", ");
    let field =
        Field::find(name.trim()).ok_or_else(|| format!("there is no field {{{name}}}; there are {}", known()))?;
    let width = width.trim().parse().ok().filter(|width| (1..=9).contains(width));
    let width = width.ok_or_else(|| format!("the width of {{{name}}} is a number from 1 to 9, like {{{name}:03}}"))?;
    Ok(TemplatePart::Field(field, width))
}

impl TryFrom<String> for CodeTemplate {
    type Error = TemplateProblem;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        Self::parse(&text)
    }
}

impl From<CodeTemplate> for String {
    fn from(template: CodeTemplate) -> Self {
        template.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NUMBERS: CodeNumbers = CodeNumbers { aisle: 3, bay: 12, row: 5, depth: 1, side: Some(Side::Left) };

    fn written(template: &str, numbers: CodeNumbers) -> String {
        CodeTemplate::parse(template).expect("it is valid").write(numbers)
    }

    #[test]
    fn numbers_are_filled_with_zeros_and_grow_where_they_must() {
        assert_eq!(CodeTemplate::default().write(NUMBERS), "03-012");
        assert_eq!(written("A{aisle}/{side}{bay:4}", NUMBERS), "A3/L0012");
        assert_eq!(written("{aisle:02}-{bay:03}", CodeNumbers { aisle: 120, bay: 1000, ..NUMBERS }), "120-1000");
    }

    #[test]
    fn places_behind_others_carry_their_depth() {
        let behind = CodeNumbers { depth: 2, ..NUMBERS };
        assert_eq!(CodeTemplate::default().write(behind), "03-012-2");
        assert_eq!(written("{row:02}.{bay:02}.{depth}", behind), "05.12.2");
    }

    #[test]
    fn a_wrong_template_says_where_and_what_would_do() {
        let problem = |template: &str| CodeTemplate::parse(template).expect_err("it is wrong").to_string();
        assert_eq!(problem("{aisle}-{bay"), "at character 9 of the template: a { without a }");
        assert_eq!(problem("{aisle}}"), "at character 8 of the template: a } without a {");
        assert!(problem("{gang}-{bay}").ends_with("there are {aisle}, {bay}, {row}, {depth}, {side}"));
        assert!(problem("{aisle}-{bay:33}").ends_with("a number from 1 to 9, like {bay:03}"));
        assert!(problem("{aisle}").contains("would not be unique"));
        assert!(problem("{aisle},{bay}").starts_with("at character 8 of the template: commas"));
    }
}
