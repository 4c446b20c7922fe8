//! The features nearest to a point.

use stillage_core::Point;

use crate::features::feature::Feature;

/// A feature and how far it is.
#[derive(Debug, Clone, Copy)]
pub struct NearFeature<'a> {
    /// The feature.
    pub feature: &'a Feature,
    /// Distance of its shape from the point, metres; 0 where the point lies in it.
    pub distance: f64,
}

/// So many of the features, the nearest first; of those that are equally far, by id. Features without a shape are nowhere.
/// O(positions + n log n).
#[must_use]
pub fn nearest<'a>(
    features: impl IntoIterator<Item = &'a Feature>,
    point: Point,
    count: usize,
) -> Vec<NearFeature<'a>> {
    let measured =
        features.into_iter().map(|feature| NearFeature { feature, distance: feature.geometry.distance(point) });
    let mut near: Vec<NearFeature<'a>> = measured.filter(|near| near.distance.is_finite()).collect();
    near.sort_by(|first, second| {
        first.distance.total_cmp(&second.distance).then_with(|| first.feature.id.cmp(&second.feature.id))
    });
    near.truncate(count);
    near
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::features::tests::hall_view;
    use crate::features::{Collection, FeatureId, features};

    #[test]
    fn the_nearest_come_first() {
        let vertices = features(&hall_view(), Collection::Vertices);
        let at = |feature: &Feature| *feature.geometry.points().next().expect("a vertex is a point");
        let wanted = &vertices[3];
        let near = nearest(&vertices, at(wanted), 5);
        assert_eq!((near.len(), &near[0].feature.id, near[0].distance), (5, &FeatureId::Number(3), 0.0));
        assert!(near.is_sorted_by(|first, second| first.distance <= second.distance));
        let farther = vertices.iter().filter(|feature| (at(feature) - at(wanted)).norm() < near[4].distance);
        assert!(farther.count() < 5, "no other is nearer");
    }
}
