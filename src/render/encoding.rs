//! Pixels -> PNG.

use std::borrow::Cow;

/// The colours of a palette picture: three bytes each, and how opaque they are (all of them where it is empty).
pub(super) struct Palette {
    pub(super) colours: Vec<u8>,
    pub(super) opacities: Vec<u8>,
}

impl Palette {
    pub(super) fn opaque(colours: Vec<u8>) -> Self {
        Self { colours, opacities: Vec::new() }
    }
}

/// Encodes pixels of one byte per channel. A picture without pixels, which PNG does not know, becomes one pixel of 0.
pub(super) fn encode(
    width: usize,
    height: usize,
    kind: png::ColorType,
    palette: Option<Palette>,
    pixels: &[u8],
) -> Vec<u8> {
    let (width, height, pixels) = match pixels {
        [] => (1, 1, Cow::Owned(vec![0; kind.samples()])),
        pixels => (width as u32, height as u32, Cow::Borrowed(pixels)),
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(kind);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    if let Some(Palette { colours, opacities }) = palette {
        encoder.set_palette(colours);
        if !opacities.is_empty() {
            encoder.set_trns(opacities);
        }
    }
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&pixels))
        .expect("the pixels match the size, and memory takes every byte");
    bytes
}
