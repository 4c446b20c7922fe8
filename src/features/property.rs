//! What is known of a property before any value of it is seen.

/// A property of the features of a collection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Property {
    /// Its name among the properties of a feature.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// What it says.
    pub description: &'static str,
    /// Unit of its numbers, in UCUM: `m`, `m2` or `deg`; absent where numbers have none.
    pub unit: Option<&'static str>,
    /// What its values are.
    pub kind: Kind,
    /// Whether a value may be missing.
    pub nullable: bool,
}

impl Property {
    /// A property without a unit that every feature of the collection has.
    #[must_use]
    pub const fn new(name: &'static str, kind: Kind, title: &'static str, description: &'static str) -> Self {
        Self { name, title, description, unit: None, kind, nullable: false }
    }

    /// Gives its numbers a unit (UCUM).
    #[must_use]
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = Some(unit);
        self
    }

    /// A feature may have no value.
    #[must_use]
    pub const fn nullable(mut self) -> Self {
        self.nullable = true;
        self
    }
}

/// What the values of a property are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// True or false.
    Boolean,
    /// A whole number from 0.
    Integer,
    /// A number, rounded to four decimals.
    Number,
    /// Any text.
    Text,
    /// One of these words.
    Word(&'static [&'static str]),
    /// Whole numbers.
    Integers,
    /// Numbers.
    Numbers,
    /// Texts.
    Texts,
    /// Some of these words.
    Words(&'static [&'static str]),
    /// x and y, map frame, metres.
    Position,
    /// A position and a heading.
    Pose,
    /// A box of any direction.
    Box,
}

impl Kind {
    /// Whether values have an order, so that features can be sorted by them.
    #[must_use]
    pub const fn is_scalar(self) -> bool {
        matches!(self, Self::Boolean | Self::Integer | Self::Number | Self::Text | Self::Word(_))
    }
}
