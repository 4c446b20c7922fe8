//! The paper author's line and segment sets with his expected counts (GPL data, read in place, never copied).
//!
//! His counts are of the graph without its loose ends, which he drops once; what then hangs loose stays. Ours are of
//! the finished subdivision, where every edge separates two faces. The tests state both.

use std::path::PathBuf;

use super::*;
use crate::geometry::Point;

/// Vertices, half-edges and bounded faces.
type Counts = [usize; 3];

/// The text of a test case; `None` where the shared maps are missing.
fn case(name: &str) -> Option<String> {
    let shared = std::env::var_os("STILLAGE_SHARED")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared"), PathBuf::from);
    let path = shared.join("maps/golden/arrangement-testcases").join(name);
    let text = std::fs::read_to_string(&path).ok();
    if text.is_none() {
        assert!(std::env::var("CI").as_deref() != Ok("true"), "{} is missing", path.display());
        println!("skipped: {} is missing", path.display());
    }
    text
}

/// Reads the `lines:` (made long enough to count as infinite) and `segments:` of a case.
fn parse(text: &str) -> Vec<SourceSegment> {
    // Longer than any case is wide, so that all crossings are kept and the ends dangle.
    const FAR: f64 = 1_000.0;
    let mut segments = Vec::new();
    let mut is_line = false;
    for row in text.lines() {
        let row = row.trim();
        match row {
            "lines:" => is_line = true,
            "segments:" => is_line = false,
            _ => {}
        }
        let Some(numbers) = row.strip_prefix("- [").and_then(|rest| rest.strip_suffix(']')) else { continue };
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.trim().parse().expect("a number")).collect();
        let (mut start, mut end) = (Point::new(numbers[0], numbers[1]), Point::new(numbers[2], numbers[3]));
        if is_line {
            let along = (end - start).normalize() * FAR;
            (start, end) = (start - along, end + along);
        }
        let source = EdgeSource::Line(segments.len() as u32);
        segments.push(SourceSegment { start, end, source });
    }
    segments
}

/// His way of counting: pieces with an end that nothing else touches are dropped once; faces by Euler's formula.
fn counts_without_loose_ends(segments: &[SourceSegment]) -> Counts {
    let mut pieces = noding::node(snap(segments).0, &Watch::unwatched()).expect("nobody stops it");
    let ends: Vec<_> = pieces.iter().flat_map(|piece| [piece.segment.low, piece.segment.high]).collect();
    let is_loose = |end| ends.iter().filter(|&&other| other == end).count() == 1;
    pieces.retain(|piece| !is_loose(piece.segment.low) && !is_loose(piece.segment.high));
    let mut vertices: Vec<_> = pieces.iter().flat_map(|piece| [piece.segment.low, piece.segment.high]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    // All his cases used here are connected: V - E + F = 1 for the bounded faces.
    [vertices.len(), 2 * pieces.len(), 1 + pieces.len() - vertices.len()]
}

fn check(name: &str, his: Counts, ours: Counts) {
    let Some(text) = case(name) else { return };
    let expected = |key: &str| -> usize {
        let value = text.lines().find_map(|row| row.split_once(key)).expect("the case names its counts").1;
        value.trim().parse().expect("a count")
    };
    assert_eq!(his, [expected("number_of_nodes:"), expected("number_of_edges:"), expected("number_of_faces:")]);
    let segments = parse(&text);
    assert_eq!(counts_without_loose_ends(&segments), his, "{name}, counted his way");
    let subdivision = arrange(&segments, &Watch::unwatched()).expect("nobody stops it");
    subdivision.check_invariants().expect("the subdivision is sound");
    let counts = [subdivision.vertex_count(), 2 * subdivision.edge_count(), subdivision.faces().len()];
    assert_eq!(counts, ours, "{name}, as a subdivision");
}

#[test]
fn forty_lines() {
    check("intensive_lineOnly.yaml_", [400, 1_520, 361], [400, 1_520, 361]);
}

#[test]
fn eleven_segments() {
    check("example_03.yaml", [17, 58, 13], [17, 58, 13]);
}

/// Two parallels and one line across: one edge is left between the crossings, and it bounds nothing.
#[test]
fn an_h_of_three_segments() {
    check("example_09.yaml", [2, 2, 0], [0, 0, 0]);
}

/// A square with a hook inside: its loose end goes, his first piece of it stays although it bounds nothing.
#[test]
fn a_square_with_a_hook() {
    check("example_10.yaml", [6, 12, 1], [5, 10, 1]);
}
