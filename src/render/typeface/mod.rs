//! The letters of the pictures: `DejaVu Sans` with the Latin letters of European languages, digits and signs.
//!
//! `DejaVuSans-Latin.ttf` is the regular face of release 2.37, reduced to U+0020-007E, U+00A0-017F and some punctuation
//! by `pyftsubset`, without hints and layout tables; its licence lies beside it. A letter that is not in it shows as a
//! frame.

use std::sync::LazyLock;

use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

static FACE: LazyLock<Face<'static>> =
    LazyLock::new(|| Face::parse(include_bytes!("DejaVuSans-Latin.ttf"), 0).expect("the font in the program is whole"));

/// Families that a viewer may use for the same text, the first one that it has.
pub(super) const FAMILIES: &str = "'DejaVu Sans', Verdana, sans-serif";

/// Height of capitals, in ems.
pub(super) const CAPITALS: f64 = 0.729;

/// Width of a line of text, in ems.
pub(super) fn width(text: &str) -> f64 {
    glyphs(text).map(advance).sum()
}

/// The outlines of a line of text of one em, with its middle at the origin, y down; `None` when nothing is to be drawn.
pub(super) fn outlines(text: &str) -> Option<Path> {
    let mut outline = Outline { path: PathBuilder::new(), left: -width(text) / 2.0 };
    for glyph in glyphs(text) {
        FACE.outline_glyph(glyph, &mut outline);
        outline.left += advance(glyph);
    }
    outline.path.finish()?.transform(Transform::from_translate(0.0, (CAPITALS / 2.0) as f32))
}

fn glyphs(text: &str) -> impl Iterator<Item = GlyphId> {
    // Glyph 0 is the frame.
    text.chars().map(|letter| FACE.glyph_index(letter).unwrap_or(GlyphId(0)))
}

/// Distance to the next letter, in ems.
fn advance(glyph: GlyphId) -> f64 {
    f64::from(FACE.glyph_hor_advance(glyph).unwrap_or(0)) / f64::from(FACE.units_per_em())
}

/// Takes the outline of a letter in font units, y up.
struct Outline {
    path: PathBuilder,
    /// Where the letter begins, ems.
    left: f64,
}

impl Outline {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        let em = f32::from(FACE.units_per_em());
        (self.left as f32 + x / em, -y / em)
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
