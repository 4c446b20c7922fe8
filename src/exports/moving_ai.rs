//! Grid map of the `MovingAI` benchmarks, for planners of many agents.
//!
//! Source: N. Sturtevant, *Benchmarks for Grid-Based Pathfinding* (2012), movingai.com/benchmarks/formats.html.
//!
//! Method: a character a cell, its first row on top: `.` for a free cell of a drivable face, `@` for all others. Cost:
//! O(cells). Limits: an agent of these benchmarks is as large as a cell; the format has neither scale nor origin.

use stillage_core::Occupancy;

use super::source::ExportSource;
use super::zones::Ground;

/// The drivable cells of a map.
#[must_use]
pub fn map(source: &ExportSource<'_>) -> Vec<u8> {
    let is_open = |ground: Option<Ground>| matches!(ground, Some(Ground::Way | Ground::Junction));
    let open: Vec<bool> = Ground::of_faces(source).into_iter().map(is_open).collect();
    let (width, height) = (source.grid.width(), source.grid.height());
    let mut bytes = format!("type octile\nheight {height}\nwidth {width}\nmap\n").into_bytes();
    for row in (0..height).rev() {
        for (face, run) in source.cells.runs(row * width..(row + 1) * width) {
            let is_passable = |cell: &Occupancy| *cell == Occupancy::Free && open[face.index()];
            bytes.extend(source.grid.cells()[run].iter().map(|cell| if is_passable(cell) { b'.' } else { b'@' }));
        }
        bytes.push(b'\n');
    }
    bytes
}
