//! The metadata beside a map image: the YAML of `map_server`, or the same keys as JSON.
//!
//! Required are `image`, `resolution`, `origin` (3 elements), `free_thresh`, `occupied_thresh` and `negate`, as in
//! `nav2_map_server` (`loadMapYaml`); `mode` may be absent. Unlike there, values that cannot mean a map are refused
//! (thresholds out of order, NaN), and keys that mean nothing are pointed out.

use stillage_core::analysis::Diagnostic;
use stillage_core::excerpt;
use stillage_core::{GridFrame, Point};

use super::IngestError;
use super::document::{self, Fields, Node};
use super::verdict::{Mode, Thresholds};

/// Where the metadata lies in an upload.
const POINTER: &str = "/metadata";
const KNOWN_KEYS: [&str; 7] = ["image", "resolution", "origin", "free_thresh", "occupied_thresh", "negate", "mode"];
/// Finest and coarsest cell, metres: beyond lie mistakes of the unit.
const RESOLUTIONS: [f64; 2] = [1e-4, 100.0];
/// Farthest origin, metres: half the width of the world in EPSG:3857, the nominal frame of a map.
const FARTHEST_ORIGIN: f64 = 20_037_508.0;

/// What the metadata says.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Metadata {
    pub(super) frame: GridFrame,
    pub(super) mode: Mode,
    pub(super) negate: bool,
    pub(super) thresholds: Thresholds,
}

/// Reads the metadata; what is odd but plain goes to `warnings`.
pub(super) fn parse(bytes: &[u8], warnings: &mut Vec<Diagnostic>) -> Result<Metadata, IngestError> {
    let document = document::parse(bytes, POINTER)?;
    if document == Node::Null {
        return Err(IngestError::invalid(
            POINTER,
            "the metadata is empty: it needs the keys of a map_server YAML file",
        ));
    }
    let fields = Fields::of(&document, POINTER)?;
    if fields.find("maps").is_some() && fields.find("image").is_none() {
        let message = "this file lists several maps: upload each of them on its own, with its own metadata";
        return Err(fields.wrong("maps", message.to_owned()));
    }
    warn_of_image_path(&image(&fields)?, warnings);
    let resolution = resolution(fields.number("resolution", warnings)?, &fields.pointer_to("resolution"))?;
    let (origin, yaw) = origin(&fields, warnings)?;
    let thresholds = thresholds(&fields, warnings)?;
    let negate = negate(&fields)?;
    let mode = mode(&fields)?;
    for key in fields.keys().filter(|key| !KNOWN_KEYS.contains(key)) {
        let message = format!("the metadata key `{}` is not known and was ignored", excerpt(key));
        warnings.push(Diagnostic::new("unknown-key", message));
    }
    Ok(Metadata { frame: GridFrame { resolution, origin, yaw }, mode, negate, thresholds })
}

/// The `image` entry of a metadata file, for callers that have the folder it speaks of.
///
/// # Errors
/// [`IngestError`] when the file cannot be read, or has no such entry.
pub fn image_entry(metadata: &[u8]) -> Result<String, IngestError> {
    let document = document::parse(metadata, POINTER)?;
    image(&Fields::of(&document, POINTER)?)
}

fn image(fields: &Fields<'_>) -> Result<String, IngestError> {
    match fields.get("image")? {
        Node::Text(path) if !path.trim().is_empty() => Ok(path.trim().to_owned()),
        _ => Err(fields.wrong("image", "`image` must name the image file of the map".to_owned())),
    }
}

/// The path is never followed, but one that leads elsewhere hints at the wrong pair of files.
fn warn_of_image_path(path: &str, warnings: &mut Vec<Diagnostic>) {
    let elsewhere = path.starts_with(['/', '~', '\\'])
        || path.contains("://")
        || path.contains(":\\")
        || path.split(['/', '\\']).any(|component| component == "..");
    if elsewhere {
        let message = format!(
            "`image` names a file elsewhere (\"{}\"): the image of this upload was used instead",
            excerpt(path)
        );
        warnings.push(Diagnostic::new("image-path", message));
    }
}

/// Checks the side of a cell.
pub(super) fn resolution(value: f64, pointer: &str) -> Result<f64, IngestError> {
    let [finest, coarsest] = RESOLUTIONS;
    if (finest..=coarsest).contains(&value) {
        return Ok(value);
    }
    let message = format!(
        "the resolution is {value} m per cell, it must lie between {finest} and {coarsest}: give the side of a cell in metres"
    );
    Err(IngestError::invalid(pointer, message))
}

/// Checks a coordinate of the origin.
pub(super) fn origin_coordinate(value: f64, pointer: &str) -> Result<f64, IngestError> {
    if value.abs() <= FARTHEST_ORIGIN {
        return Ok(value);
    }
    let message =
        format!("the origin lies {value} m away, farther than the world is wide: give it in metres of the map frame");
    Err(IngestError::invalid(pointer, message))
}

fn origin(fields: &Fields<'_>, warnings: &mut Vec<Diagnostic>) -> Result<(Point, f64), IngestError> {
    let tuple;
    let elements = match fields.get("origin")? {
        Node::List(elements) => elements,
        Node::Text(text) if text.starts_with('(') && text.ends_with(')') => {
            let message = "`origin` is the text of a Python tuple: it was read as a list; write [x, y, yaw]";
            warnings.push(Diagnostic::new("tuple-origin", message));
            tuple = tuple_elements(text);
            &tuple
        }
        _ => {
            return Err(fields.wrong("origin", "`origin` must be a list: [x, y, yaw] in metres and radians".to_owned()));
        }
    };
    let [x, y, yaw] = elements.as_slice() else {
        let count = elements.len();
        // The sentence of nav2_map_server, so that a search finds its threads.
        let message = format!(
            "value of the 'origin' tag should have 3 elements, not {count}: write [x, y, yaw] in metres and radians"
        );
        return Err(fields.wrong("origin", message));
    };
    let pointer = fields.pointer_to("origin");
    let mut coordinate = |node, axis: usize, name| {
        let pointer = format!("{pointer}/{axis}");
        origin_coordinate(document::number(node, &pointer, name, warnings)?, &pointer)
    };
    let position = Point::new(coordinate(x, 0, "the origin's x")?, coordinate(y, 1, "the origin's y")?);
    let yaw = document::number(yaw, &format!("{pointer}/2"), "the origin's yaw", warnings).map_err(|mut error| {
        error.message.push_str(
            ": map_saver writes `-nan` when the map's orientation was broken; set the third element to the turn of the \
             map in radians, usually 0.0",
        );
        error
    })?;
    Ok((position, yaw))
}

/// The elements of `(x, y, yaw)`.
fn tuple_elements(text: &str) -> Vec<Node> {
    let elements = text.trim_matches(['(', ')']).split(',').map(str::trim).filter(|element| !element.is_empty());
    elements.map(|element| element.parse().map_or_else(|_| Node::Text(element.to_owned()), Node::Number)).collect()
}

fn thresholds(fields: &Fields<'_>, warnings: &mut Vec<Diagnostic>) -> Result<Thresholds, IngestError> {
    let mut share = |key| {
        let value = fields.number(key, warnings)?;
        if (0.0..=1.0).contains(&value) {
            return Ok(value);
        }
        Err(fields.wrong(key, format!("`{key}` is {value}, it must lie between 0 and 1")))
    };
    let thresholds = Thresholds { free: share("free_thresh")?, occupied: share("occupied_thresh")? };
    thresholds.in_order(&fields.pointer_to("free_thresh"))
}

/// An integer or a bool, as in `nav2_map_server`.
fn negate(fields: &Fields<'_>) -> Result<bool, IngestError> {
    let text = match fields.get("negate")? {
        Node::Bool(value) => value.to_string(),
        Node::Number(value) => value.to_string(),
        Node::Text(text) => text.trim().to_ascii_lowercase(),
        _ => String::new(),
    };
    match text.as_str() {
        "0" | "-0" | "false" | "no" | "off" => Ok(false),
        "1" | "true" | "yes" | "on" => Ok(true),
        _ => Err(fields.wrong("negate", "`negate` must be 0, 1, true or false".to_owned())),
    }
}

fn mode(fields: &Fields<'_>) -> Result<Mode, IngestError> {
    match fields.find("mode") {
        None => Ok(Mode::Trinary),
        Some(Node::Text(text)) if text == "trinary" => Ok(Mode::Trinary),
        Some(Node::Text(text)) if text == "scale" => Ok(Mode::Scale),
        Some(Node::Text(text)) if text == "raw" => Ok(Mode::Raw),
        Some(_) => Err(fields.wrong("mode", "`mode` must be trinary, scale or raw".to_owned())),
    }
}
