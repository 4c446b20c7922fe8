//! Categories of places.

use serde::Serialize;
use stillage_core::spec::AnnotationMethod;
use utoipa::ToSchema;

use super::link::Link;
use crate::app::MapContext;

/// A category of places, as the person who names it needs to see it.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Category)]
#[serde(rename_all = "camelCase")]
pub struct CategoryView {
    /// The category: a key of the assignment.
    id: u8,
    /// Whether it is a cluster of free cells, or stands for faces without any.
    kind: CategoryKind,
    /// Free cells that carry it (clusters), or cells of its faces (the others).
    cells: usize,
    /// Area of those cells, square metres.
    area_m2: f64,
    /// Mean of each feature over the measured cells, by name; lengths in metres.
    #[schema(value_type = std::collections::BTreeMap<String, f64>)]
    mean_features: serde_json::Map<String, serde_json::Value>,
    /// Faces whose category it is.
    faces: usize,
    /// Area of those faces, square metres.
    faces_area_m2: f64,
    /// Share of the cells of those faces that are free.
    free_fraction: f64,
    /// Share that is occupied.
    occupied_fraction: f64,
    /// Share that is unknown.
    unknown_fraction: f64,
    /// Label in force.
    #[schema(example = "co")]
    label: String,
    suggestion: SuggestionView,
}

/// What a category is made of.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum CategoryKind {
    /// Free cells that look alike.
    Cluster,
    /// Faces that hold obstacles and no free cell.
    Occupied,
    /// Faces among known places that hold no known cell.
    Unknown,
    /// Unexplored faces around the site.
    Outside,
}

/// A proposed label.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Suggestion)]
#[serde(rename_all = "camelCase")]
pub struct SuggestionView {
    #[schema(example = "co")]
    label: String,
    /// 0 to 1.
    confidence: f64,
    /// Why, for people.
    reason: String,
    /// Long over short side of its faces, on average.
    elongation: f64,
    /// Median area of its faces, square metres.
    median_area_m2: f64,
    /// Share of the length of their edges that one could pass.
    open_fraction: f64,
}

/// The categories of a map.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct CategoryList {
    /// By id.
    pub categories: Vec<CategoryView>,
    /// The rule set whose labels are meant.
    pub rule_set: String,
    /// Itself, and the labels in force.
    pub links: Vec<Link>,
}

impl CategoryView {
    /// A category of an analysed map.
    #[must_use]
    pub fn new(context: &MapContext, id: u8) -> Self {
        let (analysis, rules) = (&context.analysis, &context.semantic.rule_set);
        let (map, kinds) = (&analysis.categories, &analysis.face_categories);
        // Where faces are clustered, a category has no cells of its own.
        let votes = analysis.options.annotation.method == AnnotationMethod::Vote;
        let cluster = map.categories.get(usize::from(id)).filter(|_| votes);
        let faces = || analysis.faces.iter().skip(1).filter(|face| face.category == id);
        let cells = cluster.map_or_else(|| faces().map(|face| face.cells).sum(), |cluster| cluster.cells);
        let names = map.feature_names.iter();
        let means = cluster.map(|cluster| cluster.mean_features.as_slice()).unwrap_or_default();
        let suggestion = context.suggestions.iter().find(|suggestion| suggestion.category == id);
        let evidence = suggestion.map(|suggestion| suggestion.evidence.clone()).unwrap_or_default();
        let unidentified = &rules.label(rules.unidentified()).id;
        Self {
            id,
            kind: match cluster {
                _ if usize::from(id) < kinds.clusters => CategoryKind::Cluster,
                _ if id == kinds.occupied() => CategoryKind::Occupied,
                _ if id == kinds.unknown() => CategoryKind::Unknown,
                _ => CategoryKind::Outside,
            },
            cells,
            area_m2: cells as f64 * analysis.frame.resolution * analysis.frame.resolution,
            mean_features: names.zip(means).map(|(name, &mean)| (name.clone(), mean.into())).collect(),
            faces: faces().count(),
            faces_area_m2: faces().fold(0.0, |sum, face| sum + face.area),
            free_fraction: evidence.free_fraction,
            occupied_fraction: evidence.occupied_fraction,
            unknown_fraction: evidence.unknown_fraction,
            label: context.semantics.assignment.assignment.get(&id).unwrap_or(unidentified).clone(),
            suggestion: SuggestionView {
                label: suggestion.map_or(unidentified, |suggestion| &rules.label(suggestion.label).id).clone(),
                confidence: suggestion.map_or(0.0, |suggestion| suggestion.confidence),
                reason: suggestion.map(|suggestion| suggestion.reason.clone()).unwrap_or_default(),
                elongation: evidence.elongation,
                median_area_m2: evidence.median_area,
                open_fraction: evidence.open_fraction,
            },
        }
    }
}
