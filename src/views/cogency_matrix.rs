//! The cogency of every pair of labels.

use serde::Serialize;
use stillage_core::semantics::{Cogency, Label, LabelId, RuleSet};
use utoipa::ToSchema;

use super::link::Link;
use super::rule_set::CogencyView;

/// What an edge between faces of two labels means, for every pair of labels of a rule set.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = CogencyMatrix)]
#[serde(rename_all = "camelCase")]
pub struct CogencyMatrixView {
    #[schema(example = "site")]
    rule_set: String,
    /// The labels, in the order of the rows and of the columns.
    pub labels: Vec<MatrixLabelView>,
    /// A row for each label, with an entry for each label. The order of two labels makes no difference.
    #[schema(value_type = Vec<Vec<CogencyView>>)]
    pub cogency: Vec<Vec<Cogency>>,
    links: Vec<Link>,
}

/// A label of the matrix.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MatrixLabel)]
pub struct MatrixLabelView {
    /// Its id.
    #[schema(example = "co")]
    pub id: String,
    /// Its name for people.
    #[schema(example = "corridor")]
    pub name: String,
    /// `#rrggbb`
    #[schema(example = "#56b4e9")]
    pub color: String,
}

impl CogencyMatrixView {
    /// The matrix of a rule set.
    #[must_use]
    pub fn new(id: String, rules: &RuleSet, links: Vec<Link>) -> Self {
        let ids = || (0..rules.labels().len() as u8).map(LabelId);
        let label = |label: &Label| MatrixLabelView {
            id: label.id.clone(),
            name: label.name.clone(),
            color: label.color.clone(),
        };
        Self {
            rule_set: id,
            labels: rules.labels().iter().map(label).collect(),
            cogency: ids().map(|row| ids().map(|column| rules.cogency(row, column)).collect()).collect(),
            links,
        }
    }
}
