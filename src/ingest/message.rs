//! A `nav_msgs/OccupancyGrid` message as JSON (the form of rosbridge).
//!
//! `info {resolution, width, height, origin {position, orientation}}` and `data`, row-major from the lower left corner,
//! -1 to 100. The orientation must be a turn about the vertical. `header` and anything else is ignored.
//! A cell is judged by its value in per cent; see [`Thresholds::OF_MESSAGES`]. Cost: O(bytes), one byte a cell.

use std::fmt;

use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use stillage_core::analysis::Diagnostic;
use stillage_core::spec::GridOptions;
use stillage_core::{GridFrame, OccupancyGrid, Point};

use super::document::{Fields, Node};
use super::verdict::Thresholds;
use super::{DecodedMap, IngestError, Limits, metadata};

/// Largest squared tilt of a unit quaternion that still counts as a turn about the vertical: about 0.1 degrees.
const MAX_TILT: f64 = 1e-6;

#[derive(Deserialize)]
struct Message {
    info: Option<Node>,
    data: Option<Cells>,
}

/// Reads a message.
pub(super) fn decode(bytes: &[u8], options: &GridOptions, limits: &Limits) -> Result<DecodedMap, IngestError> {
    let mut warnings = Vec::new();
    let thresholds = Thresholds::OF_MESSAGES.overridden(options)?;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.trim_ascii_start().first() != Some(&b'{') {
        return Err(IngestError::invalid(
            "",
            "this is no OccupancyGrid message: expected a JSON object with `info` and `data`",
        ));
    }
    let message: Message = serde_json::from_slice(bytes).map_err(|error| unreadable(&error))?;
    let missing = |name| IngestError::invalid(format!("/{name}"), format!("`{name}` is missing"));
    let info = message.info.ok_or_else(|| missing("info"))?;
    let info = Fields::of(&info, "/info")?;
    let width = side(&info, "width", &mut warnings)?;
    let height = side(&info, "height", &mut warnings)?;
    limits.check_size(width, height, ["/info/width", "/info/height"])?;
    let frame = frame(&info, &mut warnings)?;
    let Cells(values) = message.data.ok_or_else(|| missing("data"))?;
    if values.len() as u64 != width * height {
        let (found, expected) = (values.len(), width * height);
        let text = format!("`data` has {found} cells, but width x height is {width} x {height} = {expected}");
        return Err(IngestError::invalid("/data", text));
    }
    let cells = values.into_iter().map(|value| thresholds.judge_value(value)).collect();
    let grid = OccupancyGrid::new(width as usize, height as usize, frame, cells);
    Ok(DecodedMap { grid, warnings })
}

fn unreadable(error: &serde_json::Error) -> IngestError {
    let reason = error.to_string();
    let about_data = error.is_data() && [DATA, "JSON number"].iter().any(|words| reason.contains(words));
    let pointer = if about_data { "/data" } else { "" };
    IngestError::invalid(pointer, format!("the OccupancyGrid JSON cannot be read: {reason}"))
}

/// A number of cells: whole and not negative. Larger ones than any limit stay larger.
fn side(info: &Fields<'_>, key: &str, warnings: &mut Vec<Diagnostic>) -> Result<u64, IngestError> {
    let value = info.number(key, warnings)?;
    if value < 0.0 || value.fract() != 0.0 {
        return Err(info.wrong(key, format!("`{key}` is {value}, it must be a whole number of cells")));
    }
    Ok(value as u64)
}

fn frame(info: &Fields<'_>, warnings: &mut Vec<Diagnostic>) -> Result<GridFrame, IngestError> {
    let resolution = metadata::resolution(info.number("resolution", warnings)?, &info.pointer_to("resolution"))?;
    let origin = Fields::of(info.get("origin")?, "/info/origin")?;
    let position = Fields::of(origin.get("position")?, "/info/origin/position")?;
    let mut coordinate = |key| metadata::origin_coordinate(position.number(key, warnings)?, &position.pointer_to(key));
    let corner = Point::new(coordinate("x")?, coordinate("y")?);
    let yaw = match origin.find("orientation") {
        Some(orientation) => yaw(&Fields::of(orientation, "/info/origin/orientation")?, warnings)?,
        None => 0.0,
    };
    Ok(GridFrame { resolution, origin: corner, yaw })
}

/// The turn about the vertical, radians.
fn yaw(orientation: &Fields<'_>, warnings: &mut Vec<Diagnostic>) -> Result<f64, IngestError> {
    let mut part = |key| orientation.number(key, warnings);
    let [x, y, z, w] = [part("x")?, part("y")?, part("z")?, part("w")?];
    let wrong = |message: &str| Err(IngestError::invalid("/info/origin/orientation", message));
    let norm = x.hypot(y).hypot(z.hypot(w));
    if norm < f64::EPSILON || !norm.is_finite() {
        return wrong("the orientation is no rotation (its length is 0): write x 0, y 0, z 0, w 1 for none");
    }
    let [x, y, z, w] = [x / norm, y / norm, z / norm, w / norm];
    if x * x + y * y > MAX_TILT {
        return wrong("the orientation tilts the map out of the plane: only a turn about z is a map");
    }
    Ok((2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z)))
}

/// Marks complaints about `data`.
const DATA: &str = "data[";

/// The cells of a message.
struct Cells(Vec<i8>);

impl<'de> Deserialize<'de> for Cells {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct CellsVisitor;

        impl<'de> Visitor<'de> for CellsVisitor {
            type Value = Cells;

            fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
                formatter.write_str("data[]: a list of whole numbers from -1 to 100")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut values: A) -> Result<Cells, A::Error> {
                let mut cells = Vec::new();
                loop {
                    let index = cells.len();
                    let wrong = || de::Error::custom(format!("{DATA}{index}] is not a whole number from -1 to 100"));
                    match values.next_element::<serde_json::Number>()? {
                        None => return Ok(Cells(cells)),
                        Some(value) => match value.as_i64().and_then(|value| i8::try_from(value).ok()) {
                            Some(value @ -1..=100) => cells.push(value),
                            _ => return Err(wrong()),
                        },
                    }
                }
            }
        }

        deserializer.deserialize_seq(CellsVisitor)
    }
}
