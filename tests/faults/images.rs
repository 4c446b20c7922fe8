//! Images that mean no good, or that are odd and mean well.

use image::{ExtendedColorType, ImageFormat};
use serde_json::Value;

use crate::image_files::{
    bmp, chunk, deflated, grey_tiff, hall, jpeg, pgm, png, saved, small_png, tiff, tiff_of, webp, zeros,
};
use crate::server::{Server, body, status};

/// Most cells of a map here: what is larger need not be large to be refused.
const MAX_CELLS: &str = "4000000";
/// What a refusal may take of memory, bytes, however the image swells: the service allows four bytes for each cell, twice, and
/// 16 MiB for what is no pixel.
const MOST_MEMORY: u64 = 64 << 20;
/// Longest explanation of a refusal, bytes.
const LONGEST_DETAIL: usize = 200;
/// Words of those who write decoders.
const JARGON: [&str; 12] = [
    "decoder",
    "Error",
    "IHDR",
    "IDAT",
    "zlib",
    "inflate",
    "chunk",
    "marker",
    "overflow",
    "panic",
    "IFD",
    "limit exceeded",
];

const FORMATS: [ImageFormat; 6] =
    [ImageFormat::Png, ImageFormat::Pnm, ImageFormat::Bmp, ImageFormat::Tiff, ImageFormat::Jpeg, ImageFormat::WebP];

/// A file, and the status of its answer.
type File = (&'static str, Vec<u8>, u16);

/// Files whose sizes are not those that they say.
fn lies() -> Vec<File> {
    let png = |size: [u32; 2]| png(size, [8, 0], b"", &deflated(&[0; 10]));
    let hall = hall();
    let size = |width: u16, height: u16| [height.to_be_bytes(), width.to_be_bytes()].concat();
    let mut wide_jpeg = saved(&hall, ImageFormat::Jpeg);
    let at = wide_jpeg.windows(4).position(|bytes| bytes == size(60, 40)).expect("it says its size");
    wide_jpeg[at..at + 4].fill(0xff);
    vec![
        ("a PNG of 2^32 pixels a side", png([u32::MAX; 2]), 413),
        ("a PNG of 2^31 x 1", png([i32::MAX as u32, 1]), 413),
        ("a PNG of 2000 x 2000 without pixels", png([2_000; 2]), 422),
        ("a PNG of 0 x 10", png([0, 10]), 422),
        ("a PGM of 10^16 pixels", b"P5\n99999999 99999999\n255\n\xfe\xfe".to_vec(), 413),
        ("a PGM of 2^64 x 1", b"P5\n18446744073709551617 1\n255\n\xfe".to_vec(), 422),
        ("a PGM of 2000 x 2000 without pixels", b"P5\n2000 2000\n255\n\xfe\xfe".to_vec(), 422),
        ("a PGM in digits of 2000 x 2000 without pixels", b"P2\n2000 2000\n255\n254 254 0\n".to_vec(), 422),
        ("a PGM of -5 x 10", b"P5\n-5 10\n255\n\xfe\xfe".to_vec(), 422),
        ("a PGM whose white is 0", b"P5\n1 1\n0\n\0".to_vec(), 422),
        ("a PGM whose white is 70000", b"P5\n1 1\n70000\n\0\0".to_vec(), 422),
        ("a PGM that is a comment", [b"P5\n#".as_slice(), &vec![b'a'; 1_000_000]].concat(), 422),
        ("a BMP of 2^31 pixels a side", bmp([i32::MAX; 2], 0, &[0; 100]), 422),
        ("a BMP upside down, of 2^31 pixels", bmp([10, i32::MIN], 0, &[0; 100]), 422),
        ("a WebP of 16,384 pixels a side", webp(false), 422),
        ("a WebP of 2^24 pixels a side", webp(true), 422),
        ("a JPEG of 65,535 pixels a side", wide_jpeg, 413),
        ("a TIFF of 2^32 pixels a side", grey_tiff(u32::MAX, 1, 16, 0, &[0; 16]), 413),
        (
            "a TIFF of 2^31 strips",
            tiff(&[(256, 4, 1, 4), (257, 4, 1, 4), (273, 4, 0x7fff_ffff, 200), (279, 4, 0x7fff_ffff, 200)], 0, b""),
            415,
        ),
        ("a TIFF whose directory lies outside", b"II\x2a\0\xf0\xff\xff\xff".to_vec(), 422),
    ]
}

/// Small files that become large.
fn bombs() -> Vec<File> {
    let text = |kind: &str, head: &[u8]| small_png(&chunk(kind, &[head, &zeros(256)].concat()));
    vec![
        ("a PNG of 8000 x 8000 pixels, 8 KB", png([8_000; 2], [1, 0], b"", &zeros(8)), 413),
        ("a PNG of 2000 x 2000 in 64 bits a pixel", png([2_000; 2], [16, 6], b"", &zeros(31)), 413),
        ("a PNG with 256 MiB behind its pixels", png([2_000; 2], [8, 0], b"", &zeros(260)), 202),
        ("a PNG with a colour profile of 256 MiB", text("iCCP", b"x\0\0"), 202),
        ("a PNG with a text of 256 MiB", text("zTXt", b"x\0\0"), 202),
        ("a PNG with a translated text of 256 MiB", text("iTXt", b"x\0\x01\0\0\0"), 202),
        (
            "a TIFF of 2000 x 2000 that becomes 256 MiB",
            grey_tiff(2_000, 8, zeros(256).len() as u32, 0, &zeros(256)),
            202,
        ),
        (
            "a BMP of 2000 x 2000 in 100 bytes",
            bmp([2_000; 2], 1, &[b"\xff\0".repeat(50).as_slice(), b"\0\x01"].concat()),
            202,
        ),
    ]
}

/// Files with an end, or a middle, that is not theirs.
fn broken() -> Vec<File> {
    let noise: Vec<u8> = (0..6_000_u32).map(|index| (index.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let mut files = vec![
        (
            "a TIFF whose directory is followed by itself, without pixels",
            tiff(&[(256, 4, 1, 4), (257, 4, 1, 4)], 8, b""),
            422,
        ),
        ("a TIFF whose directory is followed by itself", grey_tiff(4, 1, 16, 8, &[0xfe; 16]), 422),
        ("a TIFF in LZW that is noise", grey_tiff(100, 5, 6_000, 0, &noise), 422),
        ("noise", noise, 415),
        ("nothing", Vec::new(), 422),
    ];
    for format in FORMATS {
        let whole = saved(&hall(), format);
        files.push(("half a file", whole[..whole.len() / 2].to_vec(), 422));
        files.push(("twelve bytes of a file", whole[..12].to_vec(), 422));
    }
    files
}

/// Files of other kinds, some of which act upon being opened.
fn strangers() -> Vec<File> {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg"><image href="http://127.0.0.1:1/"/></svg>"#;
    let entity = r#"<?xml version="1.0"?><!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><svg>&x;</svg>"#;
    vec![
        (
            "a GIF",
            b"GIF89a\xff\xff\xff\xff\x80\0\0\0\0\0\xff\xff\xff,\0\0\0\0\xff\xff\xff\xff\0\x02\x02L\x01\0;".to_vec(),
            415,
        ),
        ("an SVG", svg.into(), 415),
        ("an SVG with a file in it", entity.into(), 415),
        ("a page", b"<html><script>alert(1)</script></html>".to_vec(), 415),
        ("a PDF", b"%PDF-1.4\n".to_vec(), 415),
        ("a program", b"\x7fELF\x02\x01\x01\0\0\0\0\0\0\0\0\0".to_vec(), 415),
        ("an archive", b"PK\x03\x04\x14\0\0\0".to_vec(), 415),
        ("a TIFF of fractions", tiff_of(ExtendedColorType::Rgb32F, &[0; 4 * 4 * 12]), 202),
    ]
}

/// Files that mean well.
fn odd() -> Vec<(&'static str, Vec<u8>)> {
    let (hall, png) = (hall(), ImageFormat::Png);
    let grey = hall.as_bytes();
    let wide: Vec<u8> = grey.iter().flat_map(|grey| [*grey; 2]).collect();
    let digits: Vec<String> = grey.iter().map(u8::to_string).collect();
    let saved_png = saved(&hall, png);
    let behind = |more: &[u8]| [saved_png.as_slice(), more].concat();
    let (start, end) = saved_png.split_at(saved_png.len() - 12);
    vec![
        ("16 bits", saved(&hall.to_luma16().into(), png)),
        ("colours and opacity", saved(&hall.to_rgba8().into(), png)),
        ("grey and opacity", saved(&hall.to_luma_alpha8().into(), png)),
        ("16 bits in a PGM", [b"P5\n60 40\n65535\n", wide.as_slice()].concat()),
        ("digits", format!("P2\n# made by hand\n60 40\n255\n{}", digits.join(" ")).into()),
        ("a comment of a megabyte", [b"P5\n#", vec![b'a'; 1_000_000].as_slice(), b"\n1 1\n255\n\xfe"].concat()),
        ("a bitmap in digits", b"P1\n4 4\n0 1 0 1 0 1 0 1 0 1 0 1 0 1 0 1\n".to_vec()),
        ("a bitmap", b"P4\n8 4\n\x55\x55\x55\x55".to_vec()),
        ("any map", [b"P7\nWIDTH 60\nHEIGHT 40\nDEPTH 1\nMAXVAL 255\nTUPLTYPE GRAYSCALE\nENDHDR\n", grey].concat()),
        ("a JPEG that comes in steps", jpeg(1, true)),
        ("a JPEG in four inks", jpeg(4, false)),
        ("a wrong sum beside the pixels", [start, b"\0\0\0\x04tEXta\0bc\0\0\0\0", end].concat()),
        ("a page behind a PGM", pgm(b"<html><script>alert(1)</script>")),
        ("a page behind a PNG", behind(b"<html><script>alert(1)</script></html>")),
        ("an archive behind a PNG", behind(b"PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0")),
    ]
}

/// What uploading an image answers.
fn upload(server: &Server, image: &[u8]) -> String {
    let metadata =
        "image: map.png\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
    let part = |name: &str, content: &[u8]| {
        let head = format!("--edge\r\nContent-Disposition: form-data; name=\"{name}\"; filename=\"map\"\r\n\r\n");
        [head.as_bytes(), content, b"\r\n"].concat()
    };
    let form = [part("metadata", metadata.as_bytes()), part("image", image), b"--edge--\r\n".to_vec()].concat();
    let head = format!(
        "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Type: multipart/form-data; boundary=edge\r\nConnection: close\r\n\
         Content-Length: {}\r\n\r\n",
        form.len()
    );
    server.answer(&[head.as_bytes(), &form].concat())
}

#[test]
fn hostile_images_are_refused_in_words_and_take_little_memory() {
    let server = Server::start_watched(&["--max-cells", MAX_CELLS, "--job-slots", "0"]);
    upload(&server, &saved(&hall(), ImageFormat::Png));
    let mut wrong = Vec::new();
    for (name, image, expected) in [lies(), bombs(), broken(), strangers()].concat() {
        server.forget_peak();
        let before = server.memory();
        let answer = upload(&server, &image);
        let grown = server.peak().saturating_sub(before);
        let problem: Value = serde_json::from_str(body(&answer)).expect("is JSON");
        let detail = problem["detail"].as_str().unwrap_or_default();
        let is_in_words =
            (1..=LONGEST_DETAIL).contains(&detail.len()) && !JARGON.iter().any(|word| detail.contains(word));
        let is_refused_well = is_in_words && problem["errors"][0]["pointer"] == "/image";
        if status(&answer) != expected || grown > MOST_MEMORY || !(expected == 202 || is_refused_well) {
            wrong.push(format!("{name}: {}, {} MiB, {detail}", status(&answer), grown >> 20));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert_eq!(server.logged(), "");
}

#[test]
fn odd_images_that_mean_a_map_are_analysed() {
    let server = Server::start_watched(&[]);
    let files = odd();
    for (name, image) in &files {
        let answer = upload(&server, image);
        assert_eq!(status(&answer), 202, "{name}: {answer}");
    }
    server.wait_until_idle();
    let jobs = server.json("/v1/jobs?status=successful&limit=100");
    assert_eq!(jobs["jobs"].as_array().map(Vec::len), Some(files.len()), "{jobs}");
    assert_eq!(server.logged(), "");
}
