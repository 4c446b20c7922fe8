//! Pictures of a map, in its own pixels.

/// Names and titles of the pictures.
pub const NAMES: [(&str, &str); 4] = [
    ("image.png", "The occupancy grid"),
    ("categories.png", "Categories of the cells"),
    ("regions.png", "Regions"),
    ("semantic.png", "Faces by label, cogency of the edges"),
];
