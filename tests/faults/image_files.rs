//! Files of images as nobody would save them, made byte by byte.

use std::io::{Cursor, Write as _};

use flate2::write::ZlibEncoder;
use flate2::{Compress, Compression, Crc, FlushCompress};
use image::codecs::tiff::TiffEncoder;
use image::{DynamicImage, ExtendedColorType, GrayImage, ImageEncoder as _, ImageFormat, Luma};

/// How a PNG begins.
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

/// A hall with two racks, 60 x 40 pixels.
pub fn hall() -> DynamicImage {
    let is_rack = |x: u32, y: u32| (10..50).contains(&x) && ((10..14).contains(&y) || (22..26).contains(&y));
    let is_wall = |x: u32, y: u32| x == 0 || y == 0 || x == 59 || y == 39;
    GrayImage::from_fn(60, 40, |x, y| Luma([if is_wall(x, y) || is_rack(x, y) { 0 } else { 254 }])).into()
}

/// A picture as a file.
pub fn saved(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).expect("can be saved");
    bytes.into_inner()
}

/// A binary PGM of the hall with more behind it.
pub fn pgm(behind: &[u8]) -> Vec<u8> {
    [b"P5\n60 40\n255\n", hall().as_bytes(), behind].concat()
}

/// A stream of zlib (RFC 1950) that becomes so many mebibytes of zeros: one block, again and again.
pub fn zeros(mebibytes: usize) -> Vec<u8> {
    let mut block = Vec::with_capacity(64 << 10);
    let mut compress = Compress::new(Compression::best(), false);
    compress.compress_vec(&vec![0; 1 << 20], &mut block, FlushCompress::Full).expect("there is room");
    // Adler-32 of zeros: their number, and 1.
    let sum = ((((mebibytes << 20) % 65_521) as u32) << 16) | 1;
    [&[0x78, 0x9c], block.repeat(mebibytes).as_slice(), &[0x03, 0x00], &sum.to_be_bytes()].concat()
}

/// Bytes as a stream of zlib.
pub fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).expect("memory takes it");
    encoder.finish().expect("memory takes it")
}

/// A chunk of a PNG.
pub fn chunk(kind: &str, content: &[u8]) -> Vec<u8> {
    let content = [kind.as_bytes(), content].concat();
    let mut sum = Crc::new();
    sum.update(&content);
    let length = (content.len() - 4) as u32;
    [length.to_be_bytes().as_slice(), &content, &sum.sum().to_be_bytes()].concat()
}

/// A PNG that says its size, bits of a sample and colour type, with some chunks before its pixels, which are as they are given.
pub fn png([width, height]: [u32; 2], [depth, colours]: [u8; 2], before: &[u8], pixels: &[u8]) -> Vec<u8> {
    let header = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[depth, colours, 0, 0, 0]].concat();
    [PNG, &chunk("IHDR", &header), before, &chunk("IDAT", pixels), &chunk("IEND", b"")].concat()
}

/// A grey PNG of 10 x 10 pixels with a chunk before them.
pub fn small_png(before: &[u8]) -> Vec<u8> {
    let row = [[0].as_slice(), &[254; 10]].concat();
    png([10, 10], [8, 0], before, &deflated(&row.repeat(10)))
}

/// A TIFF with these entries (tag, type, count, value) in its only directory, which names `next`, and bytes behind it.
pub fn tiff(entries: &[(u16, u16, u32, u32)], next: u32, behind: &[u8]) -> Vec<u8> {
    let mut bytes = b"II\x2a\x00\x08\x00\x00\x00".to_vec();
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend([tag.to_le_bytes(), kind.to_le_bytes()].concat());
        bytes.extend([count.to_le_bytes(), value.to_le_bytes()].concat());
    }
    bytes.extend(next.to_le_bytes());
    [bytes, behind.to_vec()].concat()
}

/// A grey TIFF of one strip that says its size, compression and bytes; the strip begins behind 8 bytes of nothing.
pub fn grey_tiff(side: u32, compression: u32, length: u32, next: u32, strip: &[u8]) -> Vec<u8> {
    // Header, count, nine entries, next.
    let at = 8 + 2 + 9 * 12 + 4 + 8;
    let entries = [
        (256, 4, 1, side),
        (257, 4, 1, side),
        (258, 3, 1, 8),
        (259, 3, 1, compression),
        (262, 3, 1, 1),
        (273, 4, 1, at),
        (277, 3, 1, 1),
        (278, 4, 1, side),
        (279, 4, 1, length),
    ];
    tiff(&entries, next, &[&[0; 8], strip].concat())
}

/// A TIFF of floating-point samples, or of another kind.
pub fn tiff_of(kind: ExtendedColorType, bytes: &[u8]) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    TiffEncoder::new(&mut file).write_image(bytes, 4, 4, kind).expect("can be saved");
    file.into_inner()
}

/// A BMP of 24 bits, or of 8 bits with runs, that says its size.
pub fn bmp([width, height]: [i32; 2], compression: u32, pixels: &[u8]) -> Vec<u8> {
    let (bits, palette) = if compression == 0 { (24_u16, 0) } else { (8, 1_024) };
    let mut bytes = b"BM".to_vec();
    bytes.extend([200_u32, 0, 54 + palette, 40].into_iter().flat_map(u32::to_le_bytes));
    bytes.extend([width, height].into_iter().flat_map(i32::to_le_bytes));
    bytes.extend([1, bits].into_iter().flat_map(u16::to_le_bytes));
    bytes.extend([compression, 0, 0, 0, 0, 0].into_iter().flat_map(u32::to_le_bytes));
    [bytes, vec![0; palette as usize], pixels.to_vec()].concat()
}

/// A lossless WebP that says 16,384 x 16,384 pixels, alone or in a container that says 16,777,216 x 16,777,216.
pub fn webp(in_container: bool) -> Vec<u8> {
    let part = |kind: &[u8], content: &[u8]| [kind, &(content.len() as u32).to_le_bytes(), content].concat();
    let picture = part(b"VP8L", b"\x2f\xff\xff\xff\xff\0\0\0\0\0");
    let container = part(b"VP8X", b"\x10\0\0\0\xff\xff\xff\xff\xff\xff");
    let content = if in_container {
        [b"WEBP".as_slice(), &container, &picture].concat()
    } else {
        [b"WEBP".as_slice(), &picture].concat()
    };
    part(b"RIFF", &content)
}

/// A grey JPEG of 8 x 8 pixels in so many colours: one bit for each block, all of it the middle grey.
pub fn jpeg(colours: u8, is_progressive: bool) -> Vec<u8> {
    let segment =
        |marker: u8, content: &[u8]| [&[0xff, marker], &(content.len() as u16 + 2).to_be_bytes()[..], content].concat();
    let each = |of: &dyn Fn(u8) -> Vec<u8>| (1..=colours).flat_map(of).collect::<Vec<u8>>();
    let frame = [&[8, 0, 8, 0, 8, colours], each(&|id| vec![id, 0x11, 0]).as_slice()].concat();
    // One code of one bit, for the difference 0, or for the end of a block.
    let table = |class: u8| segment(0xc4, &[&[class, 1], [0; 15].as_slice(), &[0]].concat());
    let last = if is_progressive { 0 } else { 63 };
    let scan = [&[colours], each(&|id| vec![id, 0]).as_slice(), &[0, last, 0]].concat();
    [
        vec![0xff, 0xd8],
        segment(0xdb, &[&[0], [1; 64].as_slice()].concat()),
        segment(if is_progressive { 0xc2 } else { 0xc0 }, &frame),
        table(0x00),
        table(0x10),
        segment(0xda, &scan),
        vec![0],
        vec![0xff, 0xd9],
    ]
    .concat()
}
