//! The operators and functions of the standard, with their names in `cql2-json` and the number of their arguments.

use std::ops::RangeInclusive;

/// What the standard defines (OGC 21-065r2).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are named as in the standard")]
pub enum Operator {
    And,
    Or,
    Not,
    Comparison(Comparison),
    Like,
    Between,
    In,
    IsNull,
    CaseI,
    AccentI,
    Arithmetic(Arithmetic),
    Spatial(SpatialRelation),
    Temporal(TemporalRelation),
    Array(ArrayRelation),
}

/// The order of two scalars.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are named as in the standard")]
pub enum Comparison {
    Equal,
    NotEqual,
    Less,
    Greater,
    LessOrEqual,
    GreaterOrEqual,
}

/// How two numbers become one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are named as in the standard")]
pub enum Arithmetic {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    /// The whole part of the quotient.
    WholeDivide,
    Power,
}

/// How two shapes lie to one another (DE-9IM, OGC 06-103r4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are named as in the standard")]
pub enum SpatialRelation {
    Contains,
    Crosses,
    Disjoint,
    Equals,
    Intersects,
    Overlaps,
    Touches,
    Within,
}

/// How two stretches of time lie to one another (Allen's interval algebra).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are named as in the standard")]
pub enum TemporalRelation {
    After,
    Before,
    Contains,
    Disjoint,
    During,
    Equals,
    FinishedBy,
    Finishes,
    Intersects,
    Meets,
    MetBy,
    OverlappedBy,
    Overlaps,
    StartedBy,
    Starts,
}

/// How two arrays lie to one another, as sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "they are named as in the standard")]
pub enum ArrayRelation {
    ContainedBy,
    Contains,
    Equals,
    Overlaps,
}

/// The operators by their names in `cql2-json`.
const NAMES: [(&str, Operator); 49] = [
    ("and", Operator::And),
    ("or", Operator::Or),
    ("not", Operator::Not),
    ("=", Operator::Comparison(Comparison::Equal)),
    ("<>", Operator::Comparison(Comparison::NotEqual)),
    ("<", Operator::Comparison(Comparison::Less)),
    (">", Operator::Comparison(Comparison::Greater)),
    ("<=", Operator::Comparison(Comparison::LessOrEqual)),
    (">=", Operator::Comparison(Comparison::GreaterOrEqual)),
    ("like", Operator::Like),
    ("between", Operator::Between),
    ("in", Operator::In),
    ("isNull", Operator::IsNull),
    ("casei", Operator::CaseI),
    ("accenti", Operator::AccentI),
    ("+", Operator::Arithmetic(Arithmetic::Add)),
    ("-", Operator::Arithmetic(Arithmetic::Subtract)),
    ("*", Operator::Arithmetic(Arithmetic::Multiply)),
    ("/", Operator::Arithmetic(Arithmetic::Divide)),
    ("%", Operator::Arithmetic(Arithmetic::Remainder)),
    ("div", Operator::Arithmetic(Arithmetic::WholeDivide)),
    ("^", Operator::Arithmetic(Arithmetic::Power)),
    ("s_contains", Operator::Spatial(SpatialRelation::Contains)),
    ("s_crosses", Operator::Spatial(SpatialRelation::Crosses)),
    ("s_disjoint", Operator::Spatial(SpatialRelation::Disjoint)),
    ("s_equals", Operator::Spatial(SpatialRelation::Equals)),
    ("s_intersects", Operator::Spatial(SpatialRelation::Intersects)),
    ("s_overlaps", Operator::Spatial(SpatialRelation::Overlaps)),
    ("s_touches", Operator::Spatial(SpatialRelation::Touches)),
    ("s_within", Operator::Spatial(SpatialRelation::Within)),
    ("t_after", Operator::Temporal(TemporalRelation::After)),
    ("t_before", Operator::Temporal(TemporalRelation::Before)),
    ("t_contains", Operator::Temporal(TemporalRelation::Contains)),
    ("t_disjoint", Operator::Temporal(TemporalRelation::Disjoint)),
    ("t_during", Operator::Temporal(TemporalRelation::During)),
    ("t_equals", Operator::Temporal(TemporalRelation::Equals)),
    ("t_finishedBy", Operator::Temporal(TemporalRelation::FinishedBy)),
    ("t_finishes", Operator::Temporal(TemporalRelation::Finishes)),
    ("t_intersects", Operator::Temporal(TemporalRelation::Intersects)),
    ("t_meets", Operator::Temporal(TemporalRelation::Meets)),
    ("t_metBy", Operator::Temporal(TemporalRelation::MetBy)),
    ("t_overlappedBy", Operator::Temporal(TemporalRelation::OverlappedBy)),
    ("t_overlaps", Operator::Temporal(TemporalRelation::Overlaps)),
    ("t_startedBy", Operator::Temporal(TemporalRelation::StartedBy)),
    ("t_starts", Operator::Temporal(TemporalRelation::Starts)),
    ("a_containedBy", Operator::Array(ArrayRelation::ContainedBy)),
    ("a_contains", Operator::Array(ArrayRelation::Contains)),
    ("a_equals", Operator::Array(ArrayRelation::Equals)),
    ("a_overlaps", Operator::Array(ArrayRelation::Overlaps)),
];

impl Operator {
    /// The operator of a name, in any case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        NAMES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|&(_, operator)| operator)
    }

    /// Its name in `cql2-json`.
    #[must_use]
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(_, known)| *known == self).map_or("", |&(name, _)| name)
    }

    /// Whether it is written as a function in `cql2-text`.
    #[must_use]
    pub const fn is_function(self) -> bool {
        matches!(self, Self::CaseI | Self::AccentI | Self::Spatial(_) | Self::Temporal(_) | Self::Array(_))
    }

    /// How many arguments it takes.
    #[must_use]
    pub const fn arguments(self) -> RangeInclusive<usize> {
        match self {
            Self::And | Self::Or => 2..=usize::MAX,
            Self::Not | Self::IsNull | Self::CaseI | Self::AccentI => 1..=1,
            Self::Between => 3..=3,
            _ => 2..=2,
        }
    }
}
