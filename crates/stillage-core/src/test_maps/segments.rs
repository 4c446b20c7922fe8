//! Subdivisions of a few segments.

use crate::arrangement::{EdgeSource, SourceSegment, Subdivision, arrange};
use crate::geometry::Point;
use crate::watch::Watch;

/// The subdivision of segments: x and y of both ends, metres.
pub(crate) fn subdivide(ends: &[[f64; 4]]) -> Subdivision {
    let segment = |&[x0, y0, x1, y1]: &[f64; 4]| SourceSegment {
        start: Point::new(x0, y0),
        end: Point::new(x1, y1),
        source: EdgeSource::Boundary,
    };
    arrange(&ends.iter().map(segment).collect::<Vec<_>>(), &Watch::unwatched()).expect("nobody stops it")
}

/// The subdivision of the four sides of a box, and of further segments.
pub(crate) fn boxed([x0, y0, x1, y1]: [f64; 4], more: &[[f64; 4]]) -> Subdivision {
    let sides = [[x0, y0, x1, y0], [x1, y0, x1, y1], [x0, y1, x1, y1], [x0, y0, x0, y1]];
    subdivide(&[&sides, more].concat())
}
