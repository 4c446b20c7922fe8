//! Image bytes -> grey levels, with the format told by the content and every size checked before it is allocated.
//!
//! Colours become grey by `GraphicsMagick`'s integer Rec. 601 luma, 16 bits become 8 by division by 257, as nav2 reads
//! them (equal to the channels' mean wherever the picture is grey). Animations give their first frame.
//!
//! Against bombs: the header is read under a small allowance of its own (an iCCP or text chunk may not inflate), the
//! dimensions it states are compared with the limits, and only then decoding starts, under an allowance derived from
//! those dimensions. Cost: O(pixels); at most the decoded picture and its grey copy are in memory.

use std::io::Cursor;

use image::{DynamicImage, ImageBuffer, ImageDecoder, ImageError, ImageFormat, ImageReader, Pixel, Primitive};

use super::{IngestError, Limits};

/// Where the image lies in an upload.
const POINTER: &str = "/image";
/// What a decoder may allocate beside the picture: headers, colour profiles, tables.
const OVERHEAD: u64 = 16 << 20;
/// Bytes of a decoded pixel at the cell limit: RGBA. Deeper pictures are read as long as they fit the same budget.
const BYTES_PER_CELL: u64 = 4;

/// The grey levels of a picture, top row first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) grey: Vec<u8>,
    /// Which pixels are not fully opaque; empty when all are.
    pub(super) transparent: Vec<bool>,
}

impl Picture {
    /// Whether no pixel at all is opaque: then the fourth channel was not meant as opacity.
    pub(super) fn is_nowhere_opaque(&self) -> bool {
        !self.transparent.is_empty() && !self.transparent.contains(&false)
    }
}

/// Decodes a picture.
pub(super) fn decode(bytes: &[u8], limits: &Limits) -> Result<Picture, IngestError> {
    let format = sniff(bytes)?;
    let header = reader(bytes, format, limits, OVERHEAD).into_decoder().map_err(|error| refuse(format, &error))?;
    let (width, height) = header.dimensions();
    limits.check_size(u64::from(width), u64::from(height), [POINTER; 2])?;
    let (decoded, most) = (header.total_bytes(), limits.max_cells.saturating_mul(BYTES_PER_CELL));
    if decoded > most {
        let message = format!("the image takes {decoded} bytes decoded, the most is {most}: save it as 8-bit grey");
        return Err(IngestError::too_large(POINTER, message));
    }
    drop(header);
    if format == ImageFormat::Jpeg && !jpeg_is_complete(bytes) {
        return Err(IngestError::invalid(POINTER, "the JPEG image is cut off: upload it again"));
    }
    // TIFF and WebP decoders hold a second copy of what they decode.
    let allowance = decoded.saturating_mul(2).saturating_add(OVERHEAD);
    let image = reader(bytes, format, limits, allowance).decode().map_err(|error| refuse(format, &error))?;
    let (grey, transparent) = grey_levels(image);
    Ok(Picture { width: width as usize, height: height as usize, grey, transparent })
}

/// Tells the format by the first bytes: file names lie.
fn sniff(bytes: &[u8]) -> Result<ImageFormat, IngestError> {
    use ImageFormat::{Bmp, Jpeg, Png, Pnm, Tiff, WebP};
    match image::guess_format(bytes) {
        Ok(format @ (Png | Pnm | Bmp | Tiff | Jpeg | WebP)) => Ok(format),
        _ if bytes.is_empty() => Err(IngestError::invalid(POINTER, "the image is empty")),
        Ok(other) => {
            Err(IngestError::unsupported(POINTER, format!("{} images are not read: save it as PNG", name(other))))
        }
        Err(_) => Err(IngestError::unsupported(
            POINTER,
            "this is no image of a known format: PNG, PGM (and its kin), BMP, TIFF, JPEG and WebP are read",
        )),
    }
}

fn reader<'a>(bytes: &'a [u8], format: ImageFormat, limits: &Limits, allowance: u64) -> ImageReader<Cursor<&'a [u8]>> {
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut decoder_limits = image::Limits::no_limits();
    decoder_limits.max_alloc = Some(allowance);
    // The sides are checked by `Limits`, with a better message: here they are the second line of defence.
    decoder_limits.max_image_width = Some(limits.max_side.max(u32::from(u16::MAX)));
    decoder_limits.max_image_height = decoder_limits.max_image_width;
    reader.limits(decoder_limits);
    reader
}

/// The refusal of a picture, without the decoder's own words.
fn refuse(format: ImageFormat, error: &ImageError) -> IngestError {
    let format = name(format);
    match error {
        ImageError::Limits(_) => {
            IngestError::too_large(POINTER, format!("the {format} image says that it is larger than the limits allow"))
        }
        ImageError::Unsupported(_) => {
            let message = format!(
                "this kind of {format} image (its colours or compression) is not read: save it as 8-bit grey PNG"
            );
            IngestError::unsupported(POINTER, message)
        }
        ImageError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            IngestError::invalid(POINTER, format!("the {format} image is cut off: save or upload it again"))
        }
        _ => IngestError::invalid(POINTER, format!("the {format} image is broken: save or upload it again")),
    }
}

/// What people call a format. The kin of PGM go by its name.
fn name(format: ImageFormat) -> String {
    match format {
        ImageFormat::Pnm => "PGM".to_owned(),
        other => other.extensions_str().first().copied().unwrap_or_default().to_uppercase(),
    }
}

/// Whether an end-of-image marker follows the last start of a scan. The decoder would fill what is missing with grey.
fn jpeg_is_complete(bytes: &[u8]) -> bool {
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    last([0xff, 0xd9]) > last([0xff, 0xda])
}

/// Grey levels, and which pixels are not opaque (empty when all are).
fn grey_levels(image: DynamicImage) -> (Vec<u8>, Vec<bool>) {
    match image {
        DynamicImage::ImageLuma8(image) => (image.into_raw(), Vec::new()),
        DynamicImage::ImageLuma16(image) => convert(&image),
        DynamicImage::ImageLumaA8(image) => convert(&image),
        DynamicImage::ImageLumaA16(image) => convert(&image),
        DynamicImage::ImageRgb8(image) => convert(&image),
        DynamicImage::ImageRgb16(image) => convert(&image),
        DynamicImage::ImageRgba8(image) => convert(&image),
        DynamicImage::ImageRgba16(image) => convert(&image),
        other => convert(&other.into_rgba16()),
    }
}

fn convert<P>(image: &ImageBuffer<P, Vec<P::Subpixel>>) -> (Vec<u8>, Vec<bool>)
where
    P: Pixel,
    P::Subpixel: Primitive + Into<u32>,
{
    let opaque: u32 = P::Subpixel::DEFAULT_MAX_VALUE.into();
    let samples = |pixel: &P| -> [u32; 4] {
        let mut samples = pixel.channels().iter().map(|&sample| sample.into());
        std::array::from_fn(|_| samples.next().unwrap_or(0))
    };
    let has_colour = P::CHANNEL_COUNT >= 3;
    let grey = image.pixels().map(|pixel| {
        let [red, green, blue, _] = samples(pixel);
        // GraphicsMagick, PixelIntensityRec601: (306 R + 601 G + 117 B) / 1024.
        let luma = if has_colour { (306 * red + 601 * green + 117 * blue) >> 10 } else { red };
        (if opaque > 0xff { luma / 257 } else { luma }) as u8
    });
    let grey = grey.collect();
    let mut transparent = Vec::new();
    if matches!(P::CHANNEL_COUNT, 2 | 4) {
        let alpha = usize::from(P::CHANNEL_COUNT) - 1;
        transparent = image.pixels().map(|pixel| samples(pixel)[alpha] < opaque).collect();
        if !transparent.contains(&true) {
            transparent = Vec::new();
        }
    }
    (grey, transparent)
}
