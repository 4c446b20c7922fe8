//! What is read, what is read with a warning, and what is refused with which words.

use std::fmt::Write as _;
use std::io::Cursor;

use expect_test::{Expect, expect};
use image::{DynamicImage, GrayAlphaImage, GrayImage, ImageBuffer, ImageFormat, Luma, LumaA, RgbImage, RgbaImage};
use proptest::prelude::*;

use super::*;

mod messages;
mod words;

const USUAL: &str = "image: map.png\nresolution: 0.05\norigin: [-1.0, 2.0, 0.5]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

const MESSAGE: &str = r#"{
    "header": {"stamp": {"sec": 1, "nanosec": 2}, "frame_id": "map"},
    "info": {
        "map_load_time": {"sec": 0, "nanosec": 0}, "resolution": 0.1, "width": 3, "height": 2,
        "origin": {
            "position": {"x": -1.5, "y": 2, "z": 0},
            "orientation": {"x": 0, "y": 0, "z": 0.7071067811865476, "w": 0.7071067811865476}
        }
    },
    "data": [0, 25, 65, 100, -1, 50]
}"#;

/// Two rows of three pixels: dark, unknown, bright over bright, bright, dark.
const GREYS: [u8; 6] = [0, 205, 254, 254, 254, 0];
/// The cells of [`GREYS`], first line on top.
const PICTURE: &str = "#?.\n..#\n";

fn encode(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn grey_png() -> Vec<u8> {
    encode(&GrayImage::from_raw(3, 2, GREYS.to_vec()).unwrap().into(), ImageFormat::Png)
}

fn read(image: Vec<u8>, metadata: &str) -> Result<DecodedMap, IngestError> {
    let source = MapSource::Image { image, metadata: metadata.as_bytes().to_vec() };
    decode(&source, &GridOptions::default(), &Limits::default())
}

fn read_message(json: &str) -> Result<DecodedMap, IngestError> {
    decode(&MapSource::Message(json.as_bytes().to_vec()), &GridOptions::default(), &Limits::default())
}

fn picture(grid: &OccupancyGrid) -> String {
    let mut text = String::new();
    for row in (0..grid.height()).rev() {
        text.extend(grid.row(row).iter().map(|cell| match cell {
            Occupancy::Occupied => '#',
            Occupancy::Free => '.',
            Occupancy::Unknown => '?',
        }));
        text.push('\n');
    }
    text
}

/// The answer to each case, a line each.
fn check<'a>(cases: impl IntoIterator<Item = (&'a str, Result<DecodedMap, IngestError>)>, expected: &Expect) {
    let mut report = String::new();
    for (name, answer) in cases {
        match answer {
            Ok(map) if map.warnings.is_empty() => writeln!(report, "{name}: read").unwrap(),
            Ok(map) => {
                for warning in map.warnings {
                    writeln!(report, "{name}: read, {}: {}", warning.code, warning.message).unwrap();
                }
            }
            Err(error) => writeln!(report, "{name}: {:?} {}: {}", error.refusal, error.pointer, error.message).unwrap(),
        }
    }
    expected.assert_eq(&report);
}

// ---- pictures ----

#[test]
fn every_format_and_depth_reads_as_the_same_map() {
    let grey = || GrayImage::from_raw(3, 2, GREYS.to_vec()).unwrap();
    let sixteen: Vec<u16> = GREYS.iter().map(|&grey| u16::from(grey) * 257 + 200 * u16::from(grey < 254)).collect();
    let sixteen = ImageBuffer::<Luma<u16>, _>::from_raw(3, 2, sixteen).unwrap();
    let with_alpha = |alpha| GrayAlphaImage::from_fn(3, 2, |x, y| LumaA([grey().get_pixel(x, y)[0], alpha]));
    let dynamic = || DynamicImage::from(grey());
    let ascii =
        |magic: &str, body: &str| format!("{magic}\n# CREATOR: map_saver.cpp 0.050 m/pix\n3 2\n{body}").into_bytes();
    let binary = |header: &str, body: &[u8]| [header.as_bytes(), body].concat();
    let sixteen_pgm: Vec<u8> = sixteen.iter().flat_map(|sample| sample.to_be_bytes()).collect();
    let images = [
        ("PNG grey 8", encode(&dynamic(), ImageFormat::Png)),
        ("PNG grey 16", encode(&sixteen.clone().into(), ImageFormat::Png)),
        ("PNG grey and alpha", encode(&with_alpha(255).into(), ImageFormat::Png)),
        ("PNG RGB", encode(&dynamic().into_rgb8().into(), ImageFormat::Png)),
        ("PNG RGBA", encode(&dynamic().into_rgba8().into(), ImageFormat::Png)),
        ("PNG RGB 16", encode(&DynamicImage::from(sixteen.clone()).into_rgb16().into(), ImageFormat::Png)),
        ("PNG palette", palette_png(None)),
        ("BMP", encode(&dynamic().into_rgb8().into(), ImageFormat::Bmp)),
        ("TIFF grey 8", encode(&dynamic(), ImageFormat::Tiff)),
        ("TIFF grey 16", encode(&sixteen.clone().into(), ImageFormat::Tiff)),
        ("TIFF RGBA", encode(&dynamic().into_rgba8().into(), ImageFormat::Tiff)),
        ("WebP", encode(&dynamic().into_rgba8().into(), ImageFormat::WebP)),
        ("PGM ASCII", ascii("P2", "255\n0 205 254\n254 254 0\n")),
        (
            "PGM ASCII, maximum 100",
            ascii("P2", "100\n0 80 100 # comment\n100 100 0\n".replace(" # comment", "").as_str()),
        ),
        ("PGM binary", binary("P5\n# CREATOR: GIMP PNM Filter Version 1.1\n3 2\n255\n", &GREYS)),
        ("PGM binary 16", binary("P5 3 2 65535\n", &sixteen_pgm)),
        ("PPM ASCII", ascii("P3", "255\n0 0 0 205 205 205 254 254 254\n254 254 254 254 254 254 0 0 0\n")),
        ("PPM binary", binary("P6\r\n3 2\r\n255\n", &dynamic().into_rgb8().into_raw())),
    ];
    for (name, image) in images {
        let map = read(image, USUAL).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(picture(&map.grid), PICTURE, "{name}");
        assert_eq!(map.warnings, [], "{name}");
    }
}

#[test]
fn bitmaps_are_black_and_white() {
    // In a PBM 1 is black.
    for image in [b"P1\n3 2\n1 0 0\n0 0 1\n".to_vec(), b"P4\n3 2\n\x80\x20".to_vec()] {
        assert_eq!(picture(&read(image, USUAL).unwrap().grid), "#..\n..#\n");
    }
}

#[test]
fn lossy_jpeg_keeps_the_verdicts() {
    // Blocks of 8 x 8 pixels are what JPEG keeps.
    let blocks = GrayImage::from_fn(24, 16, |x, y| Luma([GREYS[(x / 8 + 3 * (y / 8)) as usize]]));
    let usual = USUAL.replace("0.196", "0.1");
    let jpeg = encode(&blocks.into(), ImageFormat::Jpeg);
    let grid = read(jpeg.clone(), &usual).unwrap().grid;
    let cell = |column: i64, row: i64| grid.at(column * 8 + 4, row * 8 + 4);
    assert_eq!([cell(0, 1), cell(1, 1), cell(2, 1)], [Occupancy::Occupied, Occupancy::Unknown, Occupancy::Free]);
    check(
        [("cut off", read(jpeg[..jpeg.len() - 10].to_vec(), &usual))],
        &expect![[r#"
            cut off: Invalid /image: the JPEG image is cut off: upload it again
        "#]],
    );
}

/// A 2-bit palette PNG of [`GREYS`], with the transparency of its entries.
fn palette_png(transparency: Option<&[u8]>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Two);
    encoder.set_palette([0, 0, 0, 205, 205, 205, 254, 254, 254].as_slice());
    if let Some(transparency) = transparency {
        encoder.set_trns(transparency);
    }
    encoder.write_header().unwrap().write_image_data(&[0b0001_1000, 0b1010_0000]).unwrap();
    bytes
}

#[test]
fn what_is_not_opaque_is_unknown_except_in_raw_mode() {
    let image = palette_png(Some(&[255, 255, 254]));
    assert_eq!(picture(&read(image.clone(), USUAL).unwrap().grid), "#??\n??#\n");
    let scale = format!("{USUAL}mode: scale\n");
    assert_eq!(picture(&read(image.clone(), &scale).unwrap().grid), "#??\n??#\n");
    // Raw: grey 0 is 0 per cent, 205 and 254 are no per cent.
    let raw = format!("{USUAL}mode: raw\n");
    assert_eq!(picture(&read(image, &raw).unwrap().grid), ".??\n??.\n");
}

#[test]
fn opacity_that_no_pixel_has_is_no_opacity() {
    // 32-bit pictures whose fourth byte was never set, and exports with the layer at 99 %.
    for alpha in [0, 254] {
        let image = GrayAlphaImage::from_fn(3, 2, |x, y| LumaA([GREYS[(x + 3 * y) as usize], alpha]));
        let map = read(encode(&image.into(), ImageFormat::Png), USUAL).unwrap();
        assert_eq!((picture(&map.grid).as_str(), map.warnings[0].code.as_str()), (PICTURE, "opacity-ignored"));
    }
    let transparent_floor =
        GrayAlphaImage::from_fn(3, 2, |x, y| [LumaA([0, 255]), LumaA([254, 0])][usize::from(x + y > 0)]);
    check(
        [("transparent floor", read(encode(&transparent_floor.into(), ImageFormat::Png), USUAL))],
        &expect![[r#"
        transparent floor: read, transparent-floor: no opaque pixel is free: transparent pixels were read as unknown, as nav2 reads them; if they are the floor, save the image without transparency
    "#]],
    );
}

#[test]
fn colours_become_grey_by_luma() {
    // Pure green is brighter (150) than pure red (76) than pure blue (29).
    let colours = RgbImage::from_raw(3, 1, vec![255, 0, 0, 0, 255, 0, 0, 0, 255]).unwrap();
    let thresholds = USUAL.replace("0.65", "0.8").replace("0.196", "0.5");
    let grid = read(encode(&colours.into(), ImageFormat::Png), &thresholds).unwrap().grid;
    assert_eq!(picture(&grid), "?.#\n");
}

#[test]
fn the_frame_of_the_map_is_that_of_the_file() {
    let frame = *read(grey_png(), USUAL).unwrap().grid.frame();
    assert_eq!((frame.resolution, frame.origin.x, frame.origin.y, frame.yaw), (0.05, -1.0, 2.0, 0.5));
}

#[test]
fn options_override_the_thresholds_of_the_file() {
    let source = MapSource::Image { image: grey_png(), metadata: USUAL.replace("0.196", "0.25").into_bytes() };
    let limits = Limits::default();
    let as_meant = decode(&source, &GridOptions::default(), &limits).unwrap();
    assert_eq!((picture(&as_meant.grid).as_str(), as_meant.warnings[0].code.as_str()), (PICTURE, "unknown-kept"));
    let options = GridOptions { semantics: GridSemantics::Nav2, ..GridOptions::default() };
    let as_written = decode(&source, &options, &limits).unwrap();
    assert_eq!(picture(&as_written.grid), "#..\n..#\n");
    assert_eq!(as_written.warnings[0].code, "unknown-lost");
    let options = GridOptions { free_threshold: Some(0.196), ..GridOptions::default() };
    let overridden = decode(&source, &options, &limits).unwrap();
    assert_eq!(picture(&overridden.grid), PICTURE);
    assert_eq!(overridden.warnings, []);
    let options = GridOptions { free_threshold: Some(0.7), ..GridOptions::default() };
    assert_eq!(decode(&source, &options, &limits).unwrap_err().pointer, "/options/grid/freeThreshold");
}

#[test]
fn a_single_pixel_is_a_map() {
    for (grey, cell) in [(0, "#\n"), (205, "?\n"), (255, ".\n")] {
        let image = GrayImage::from_raw(1, 1, vec![grey]).unwrap();
        assert_eq!(picture(&read(encode(&image.into(), ImageFormat::Png), USUAL).unwrap().grid), cell);
    }
}

// ---- pictures that are refused ----

/// A PNG whose header states a size, with hardly any data.
fn lying_png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut header = width.to_be_bytes().to_vec();
    header.extend(height.to_be_bytes());
    header.extend([8, 0, 0, 0, 0]);
    for (kind, data) in [(b"IHDR", header.as_slice()), (b"IDAT", &[0x78, 0x9c, 0x01, 0x00])] {
        bytes.extend((data.len() as u32).to_be_bytes());
        let start = bytes.len();
        bytes.extend(kind);
        bytes.extend(data);
        bytes.extend(crc32(&bytes[start..]).to_be_bytes());
    }
    bytes
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

fn lying_bmp(width: i32, height: i32) -> Vec<u8> {
    let mut bytes = b"BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0".to_vec();
    bytes.extend(width.to_le_bytes());
    bytes.extend(height.to_le_bytes());
    bytes.extend(b"\x01\0\x18\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0");
    bytes.resize(70, 0);
    bytes
}

/// A grey TIFF of one strip with hardly any data.
fn lying_tiff(width: u32, height: u32) -> Vec<u8> {
    let entries: [(u16, u32); 8] =
        [(256, width), (257, height), (258, 8), (259, 1), (262, 1), (273, 8), (278, height), (279, 4)];
    let mut bytes = b"II\x2a\0\x08\0\0\0".to_vec();
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, value) in entries {
        bytes.extend(tag.to_le_bytes());
        bytes.extend(4_u16.to_le_bytes());
        bytes.extend(1_u32.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend(0_u32.to_le_bytes());
    bytes
}

#[test]
fn headers_that_lie_are_refused_before_anything_is_allocated() {
    let pgm = |width: u64, height: u64| format!("P5 {width} {height} 255\nabc").into_bytes();
    check(
        [
            ("PNG, 2^31 squared", read(lying_png(2_147_483_647, 2_147_483_647), USUAL)),
            ("PNG, too many cells", read(lying_png(20_000, 20_000), USUAL)),
            ("PNG, within limits", read(lying_png(9_000, 9_000), USUAL)),
            ("PNG, 0 wide", read(lying_png(0, 5), USUAL)),
            ("PGM, 2^32 squared", read(pgm(4_294_967_295, 4_294_967_295), USUAL)),
            ("PGM, beyond 2^32", read(pgm(4_294_967_296, 1), USUAL)),
            ("PGM, too high", read(pgm(1, 40_000), USUAL)),
            ("PGM, within limits", read(pgm(9_000, 9_000), USUAL)),
            ("PGM, 0 x 0", read(pgm(0, 0), USUAL)),
            ("PGM ASCII, within limits", read(b"P2 9000 9000 255 1 2 3".to_vec(), USUAL)),
            ("BMP, 2^31 squared", read(lying_bmp(i32::MAX, i32::MAX), USUAL)),
            ("BMP, too many cells", read(lying_bmp(30_000, 30_000), USUAL)),
            ("BMP, within limits", read(lying_bmp(9_000, 9_000), USUAL)),
            ("TIFF, 2^32 squared", read(lying_tiff(u32::MAX, u32::MAX), USUAL)),
            ("TIFF, too many cells", read(lying_tiff(30_000, 30_000), USUAL)),
            ("TIFF, within limits", read(lying_tiff(9_000, 9_000), USUAL)),
        ],
        &expect![[r#"
            PNG, 2^31 squared: TooLarge /image: the PNG image says that it is larger than the limits allow
            PNG, too many cells: TooLarge /image: the map has 400000000 cells, the most is 100000000: crop it, or use a coarser resolution
            PNG, within limits: Invalid /image: the PNG image is cut off: save or upload it again
            PNG, 0 wide: Invalid /image: the PNG image is broken: save or upload it again
            PGM, 2^32 squared: TooLarge /image: the PGM image says that it is larger than the limits allow
            PGM, beyond 2^32: Invalid /image: the PGM image is broken: save or upload it again
            PGM, too high: TooLarge /image: the map is 40000 cells high, the most is 32768: crop it, or use a coarser resolution
            PGM, within limits: Invalid /image: the PGM image is cut off: save or upload it again
            PGM, 0 x 0: Invalid /image: the map is 0 cells wide: a map needs at least one cell
            PGM ASCII, within limits: Invalid /image: the PGM image is broken: save or upload it again
            BMP, 2^31 squared: Invalid /image: the BMP image is broken: save or upload it again
            BMP, too many cells: TooLarge /image: the map has 900000000 cells, the most is 100000000: crop it, or use a coarser resolution
            BMP, within limits: Invalid /image: the BMP image is cut off: save or upload it again
            TIFF, 2^32 squared: TooLarge /image: the TIFF image says that it is larger than the limits allow
            TIFF, too many cells: TooLarge /image: the map has 900000000 cells, the most is 100000000: crop it, or use a coarser resolution
            TIFF, within limits: Invalid /image: the TIFF image is cut off: save or upload it again
        "#]],
    );
}

#[test]
fn what_is_no_whole_image_is_refused() {
    let png = encode(&GrayImage::from_fn(64, 64, |x, y| Luma([(x * y) as u8])).into(), ImageFormat::Png);
    let with_end = |length: usize| png[..length].to_vec();
    check(
        [
            ("empty", read(Vec::new(), USUAL)),
            ("text", read(b"not an image".to_vec(), USUAL)),
            ("GIF", read(b"GIF89a\x01\0\x01\0\0\0\0;".to_vec(), USUAL)),
            ("SVG", read(b"<svg xmlns='http://www.w3.org/2000/svg'/>".to_vec(), USUAL)),
            ("PNG signature only", read(with_end(8), USUAL)),
            ("PNG cut in the data", read(with_end(png.len() / 2), USUAL)),
            ("PGM cut in the header", read(b"P5 3".to_vec(), USUAL)),
            ("PGM cut in the data", read(b"P5 3 2 255\nabcde".to_vec(), USUAL)),
            ("PGM, maximum 0", read(b"P5 3 2 0\nabcdef".to_vec(), USUAL)),
            ("PGM ASCII, a word", read(b"P2 1 1 255 abc".to_vec(), USUAL)),
        ],
        &expect![[r#"
            empty: Invalid /image: the image is empty
            text: UnsupportedFormat /image: this is no image of a known format: PNG, PGM (and its kin), BMP, TIFF, JPEG and WebP are read
            GIF: UnsupportedFormat /image: GIF images are not read: save it as PNG
            SVG: UnsupportedFormat /image: this is no image of a known format: PNG, PGM (and its kin), BMP, TIFF, JPEG and WebP are read
            PNG signature only: Invalid /image: the PNG image is cut off: save or upload it again
            PNG cut in the data: Invalid /image: the PNG image is cut off: save or upload it again
            PGM cut in the header: Invalid /image: the PGM image is cut off: save or upload it again
            PGM cut in the data: Invalid /image: the PGM image is cut off: save or upload it again
            PGM, maximum 0: Invalid /image: the PGM image is broken: save or upload it again
            PGM ASCII, a word: Invalid /image: the PGM image is broken: save or upload it again
        "#]],
    );
}

#[test]
fn an_upload_beyond_the_limit_of_bytes_is_not_looked_at() {
    let limits = Limits { max_bytes: 10, ..Limits::default() };
    let source = MapSource::Message(vec![b' '; 11]);
    assert_eq!(decode(&source, &GridOptions::default(), &limits).unwrap_err().refusal, Refusal::TooLarge);
}

// ---- anything at all ----

/// Whole files of every kind, to be damaged.
fn seeds() -> Vec<Vec<u8>> {
    let grey = DynamicImage::from(GrayImage::from_fn(9, 7, |x, y| Luma([(x * 31 + y * 17) as u8])));
    let rgba = DynamicImage::from(RgbaImage::from(grey.to_rgba8()));
    vec![
        encode(&grey, ImageFormat::Png),
        encode(&rgba, ImageFormat::Png),
        palette_png(Some(&[0, 128])),
        encode(&grey, ImageFormat::Tiff),
        encode(&grey.to_rgb8().into(), ImageFormat::Bmp),
        encode(&grey, ImageFormat::Jpeg),
        encode(&rgba, ImageFormat::WebP),
        b"P5\n# comment\n3 2\n255\nabcdef".to_vec(),
        b"P2 3 2 255 1 2 3 4 5 6".to_vec(),
        b"P1 3 2 1 0 1 0 1 0".to_vec(),
        b"P6 1 1 65535 abcdef".to_vec(),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_damaged_image_never_panics(
        seed in 0_usize..11,
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8),
        end in any::<prop::sample::Index>(),
    ) {
        let mut image = seeds().swap_remove(seed);
        for (position, byte) in damage {
            let position = position.index(image.len());
            image[position] = byte;
        }
        image.truncate(image.len() - end.index(image.len()) / 2);
        let limits = Limits { max_cells: 1_000_000, ..Limits::default() };
        let source = MapSource::Image { image, metadata: USUAL.as_bytes().to_vec() };
        if let Ok(map) = decode(&source, &GridOptions::default(), &limits) {
            prop_assert!(map.grid.width() * map.grid.height() <= 1_000_000);
        }
    }

    #[test]
    fn damaged_words_never_panic(
        message in any::<bool>(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = if message { MESSAGE } else { USUAL }.as_bytes().to_vec();
        for (position, byte) in damage {
            let position = position.index(bytes.len());
            bytes[position] = byte;
        }
        let source = if message {
            MapSource::Message(bytes)
        } else {
            MapSource::Image { image: grey_png(), metadata: bytes }
        };
        let _ = decode(&source, &GridOptions::default(), &Limits::default());
    }
}
