//! How shapes lie to one another (DE-9IM, by the `geo` crate), the boxes around them first.

use std::borrow::Cow;

use geo::{
    BoundingRect as _, Coord, CoordsIter as _, Geometry, Intersects as _, MultiPolygon, Rect, Relate as _,
    Validation as _,
};
use geo::{LineString, Point};

use crate::cql2::operator::SpatialRelation;
use crate::cql2::value::Located;

/// A shape of a filter, in the coordinates of the data.
#[derive(Debug, Clone, PartialEq)]
pub struct LiteralShape {
    geometry: Geometry,
    bounds: Rect,
}

impl Located for LiteralShape {
    fn bounds(&self) -> Rect {
        self.bounds
    }

    fn shape(&self) -> Cow<'_, Geometry> {
        Cow::Borrowed(&self.geometry)
    }
}

impl LiteralShape {
    /// A shape with the box around it.
    ///
    /// # Errors
    /// When it has positions that are no positions of the data, or its rings cross.
    pub fn new(geometry: Geometry) -> Result<Self, &'static str> {
        let is_finite = geometry.coords_iter().all(|position| position.x.is_finite() && position.y.is_finite());
        let bounds = geometry.bounding_rect().filter(|_| is_finite);
        let bounds = bounds.ok_or("the geometry lies outside its coordinate system: see filter-crs")?;
        if !geometry.is_valid() {
            return Err("the geometry is invalid: a ring crosses or touches itself or another one, or has no area");
        }
        Ok(Self { geometry, bounds })
    }
}

/// The shape of a box: an area, or a path or point where it has no width or height.
#[must_use]
pub fn box_shape([west, south, east, north]: [f64; 4]) -> Geometry {
    let (low, high) = (Coord { x: west, y: south }, Coord { x: east, y: north });
    match (west < east, south < north) {
        (true, true) => Rect::new(low, high).to_polygon().into(),
        (false, false) => Point(low).into(),
        _ => LineString(vec![low, high]).into(),
    }
}

/// The shape of a box across the antimeridian, in degrees.
#[must_use]
pub fn box_across_antimeridian([west, south, east, north]: [f64; 4]) -> Geometry {
    let part = |west, east| Rect::new(Coord { x: west, y: south }, Coord { x: east, y: north }).to_polygon();
    MultiPolygon(vec![part(west, 180.0), part(-180.0, east)]).into()
}

/// Whether two shapes lie as the relation says.
#[must_use]
pub fn relates(relation: SpatialRelation, one: &dyn Located, other: &dyn Located) -> bool {
    let (bounds, others) = (one.bounds(), other.bounds());
    if !bounds.intersects(&others) {
        return relation == SpatialRelation::Disjoint;
    }
    let is_possible = match relation {
        SpatialRelation::Within => lies_in(&bounds, &others),
        SpatialRelation::Contains => lies_in(&others, &bounds),
        SpatialRelation::Equals => bounds == others,
        _ => true,
    };
    if !is_possible {
        return false;
    }
    let (shape, other) = (one.shape(), other.shape());
    // Cheaper than the whole matrix.
    match relation {
        SpatialRelation::Intersects => return shape.intersects(&*other),
        SpatialRelation::Disjoint => return !shape.intersects(&*other),
        _ => {}
    }
    let matrix = shape.relate(&*other);
    match relation {
        SpatialRelation::Contains => matrix.is_contains(),
        SpatialRelation::Crosses => matrix.is_crosses(),
        SpatialRelation::Equals => matrix.is_equal_topo(),
        SpatialRelation::Overlaps => matrix.is_overlaps(),
        SpatialRelation::Touches => matrix.is_touches(),
        SpatialRelation::Within => matrix.is_within(),
        SpatialRelation::Intersects => matrix.is_intersects(),
        SpatialRelation::Disjoint => matrix.is_disjoint(),
    }
}

fn lies_in(inner: &Rect, outer: &Rect) -> bool {
    let (low, high) = (inner.min(), inner.max());
    low.x >= outer.min().x && low.y >= outer.min().y && high.x <= outer.max().x && high.y <= outer.max().y
}
