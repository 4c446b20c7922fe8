//! A map with its truth drawn over it, to be looked at.

use crate::raster::Lattice;
use crate::shape::Convex;
use crate::site::{About, Content, Fact};

/// How strongly a colour covers the map, of 255.
const COVER: u32 = 90;

/// Colour of a fact, and whether its area is filled.
fn colour(about: &About) -> Option<([u8; 3], bool)> {
    match about {
        About::Place(place) if place.content == Content::Nothing => Some(([230, 140, 0], true)),
        About::Place(_) => Some(([0, 150, 40], true)),
        About::Corridor { .. } => Some(([40, 110, 255], true)),
        About::Junction => Some(([240, 220, 0], true)),
        About::Room => Some(([170, 60, 200], true)),
        About::Pillar { .. } | About::Wall => Some(([220, 0, 0], true)),
        About::Region { .. } => None,
    }
}

/// Pixels in three colours, highest row first.
pub(crate) fn overlay(lattice: &Lattice, greys: &[u8], facts: &[Fact]) -> Vec<u8> {
    let mut pixels: Vec<[u8; 3]> = greys.iter().map(|&grey| [grey; 3]).collect();
    for fact in facts {
        let Some((colour, filled)) = colour(&fact.about) else { continue };
        if filled {
            lattice.for_each_cell(&fact.shape, |cell| pixels[cell] = blend(pixels[cell], colour, COVER));
        }
        if matches!(fact.about, About::Place(_)) {
            outline(lattice, &fact.shape, |cell| pixels[cell] = blend(pixels[cell], colour, 200));
        }
    }
    pixels.chunks_exact(lattice.width.max(1)).rev().flatten().flatten().copied().collect()
}

fn blend(below: [u8; 3], above: [u8; 3], cover: u32) -> [u8; 3] {
    let mix =
        |channel: usize| ((u32::from(below[channel]) * (255 - cover) + u32::from(above[channel]) * cover) / 255) as u8;
    [mix(0), mix(1), mix(2)]
}

/// The cells along the border of a shape.
fn outline(lattice: &Lattice, shape: &Convex, mut act: impl FnMut(usize)) {
    let points = shape.points();
    for (index, &from) in points.iter().enumerate() {
        let way = points[(index + 1) % points.len()] - from;
        let steps = (way.norm() / lattice.resolution).ceil() as usize;
        for step in 0..steps {
            lattice.cell_of(from + way * (step as f64 / steps as f64)).into_iter().for_each(&mut act);
        }
    }
}
