//! The semantic map drawn like the paper's Fig. 9: faces in the colour of their label, obstacles dark, edges by
//! cogency, codes in the storage locations that have room for them, and a legend with a scale bar below.

use std::collections::HashMap;

use stillage_core::arrangement::FaceId;
use stillage_core::geometry::{Point, polygon};
use stillage_core::layout::Location;
use stillage_core::semantics::{Cogency, SemanticMap};
use stillage_core::{Analysis, OccupancyGrid};

use super::drawing::{Drawing, Shape, Text};
use super::encoding::encode;
use super::frame::Frame;
use super::legend::Legend;
use super::style::{INK, PAPER, parse_colour, stroke};
use super::{raster, svg, typeface};

/// Thickness of the thin lines to an em.
const EM_PER_THICKNESS: f64 = 14.0;
/// Em below which a code cannot be read and is left out, pixels.
const SMALLEST_CODE: f64 = 7.5;
/// Share of a location's sides that its code may take.
const CODE_SHARE: f64 = 0.84;

/// Draws the semantic map, as PNG.
#[must_use]
pub fn semantic_png(
    grid: &OccupancyGrid,
    analysis: &Analysis,
    semantic: &SemanticMap,
    locations: &[Location],
) -> Vec<u8> {
    let drawing = drawing(grid, analysis, semantic, locations);
    encode(drawing.width, drawing.height, png::ColorType::Rgb, None, &raster::pixels(&drawing))
}

/// Draws the semantic map, as SVG: the same picture, with the label and the code of a face under the pointer.
#[must_use]
pub fn semantic_svg(
    grid: &OccupancyGrid,
    analysis: &Analysis,
    semantic: &SemanticMap,
    locations: &[Location],
) -> Vec<u8> {
    svg::write(&drawing(grid, analysis, semantic, locations)).into_bytes()
}

fn drawing<'a>(
    grid: &'a OccupancyGrid,
    analysis: &Analysis,
    semantic: &SemanticMap,
    locations: &[Location],
) -> Drawing<'a> {
    let frame = Frame::of(grid);
    let mut shapes = faces(analysis, semantic, locations, &frame);
    shapes.push(Shape::Cells { grid, scale: frame.scale });
    shapes.extend(edges(analysis, semantic, &frame, frame.em / EM_PER_THICKNESS));
    let codes = locations.iter().filter_map(|location| code(location, middle(analysis, location), &frame, frame.em));
    shapes.extend(codes.map(Shape::Text));
    Legend::of_labels(semantic, &frame).below(&frame, shapes)
}

/// The faces, with their label and code as titles.
fn faces<'a>(analysis: &Analysis, semantic: &SemanticMap, locations: &[Location], frame: &Frame) -> Vec<Shape<'a>> {
    let codes: HashMap<FaceId, &str> = locations.iter().map(|location| (location.face, &*location.code)).collect();
    let faces = analysis.subdivision.faces().filter(|&face| face != FaceId::OUTER);
    let area = |face: FaceId| {
        let label = semantic.label(face);
        let rings = analysis.subdivision.rings(face);
        Shape::Area {
            rings: rings.iter().map(|ring| ring.iter().map(|&point| frame.pixel(point)).collect()).collect(),
            colour: parse_colour(&label.color),
            title: codes.get(&face).map_or_else(|| label.name.clone(), |code| format!("{} {code}", label.name)),
        }
    };
    faces.map(area).collect()
}

/// The edges by cogency; what matters most is drawn last.
fn edges<'a>(analysis: &Analysis, semantic: &SemanticMap, frame: &Frame, thickness: f64) -> [Shape<'a>; 3] {
    [Cogency::Invalid, Cogency::Cogent, Cogency::StorageAccess].map(|cogency| {
        let edges = analysis.subdivision.edges().filter(|edge| semantic.cogency[edge.index()] == cogency);
        let segments = edges.map(|edge| analysis.subdivision.segment(edge).map(|point| frame.pixel(point)));
        Shape::Lines { segments: segments.collect(), stroke: stroke(cogency, thickness) }
    })
}

/// Where the code of a location stands: in its centre, or at the node of its face where a bent face goes around its centre.
fn middle(analysis: &Analysis, location: &Location) -> Point {
    let rings = analysis.subdivision.rings(location.face);
    let is_inside = polygon::contains(&rings, location.center);
    if is_inside { location.center } else { analysis.graph.position(location.face) }
}

/// The code of a location, along the side where it is larger, if it can be read there.
fn code(location: &Location, middle: Point, frame: &Frame, most: f64) -> Option<Text> {
    let Location { code, width, depth, heading, .. } = location;
    let letters = typeface::width(code).max(1.0);
    let along = |angle: f64, length: f64, across: f64| {
        let size = (length / letters).min(across) * frame.per_metre * CODE_SHARE;
        // Never upside down.
        (size.min(0.8 * most), (90.0 - angle.to_degrees()).rem_euclid(180.0) - 90.0)
    };
    let ways = [along(heading + std::f64::consts::FRAC_PI_2, *width, *depth), along(*heading, *depth, *width)];
    let (size, turn) = if ways[1].0 > ways[0].0 { ways[1] } else { ways[0] };
    (size >= SMALLEST_CODE).then(|| Text {
        content: code.clone(),
        middle: frame.pixel(middle),
        size,
        turn,
        colour: INK,
        halo: Some(PAPER),
    })
}
