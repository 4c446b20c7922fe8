//! A message -> occupancy grid.
//!
//! A cell is judged by its value in per cent; see [`Thresholds::OF_MESSAGES`]. Where no value is above 1, 1 is occupied: "0
//! represents unoccupied, 1 represents definitely occupied, and -1 represents unknown" (`nav_msgs/OccupancyGrid` of ROS 2
//! Jazzy). Cost: O(bytes), one byte a cell.

use stillage_core::analysis::Diagnostic;
use stillage_core::spec::{GridOptions, GridSemantics};
use stillage_core::{GridFrame, Occupancy, OccupancyGrid, Point};

use super::parts::MessageParts;
use super::{echo, json};
use crate::ingest::document::Fields;
use crate::ingest::verdict::Thresholds;
use crate::ingest::{DecodedMap, IngestError, Limits, metadata};

/// Largest squared tilt of a unit quaternion that still counts as a turn about the vertical: about 0.1 degrees.
const MAX_TILT: f64 = 1e-6;

/// Reads a message.
pub(in crate::ingest) fn decode(
    bytes: &[u8],
    options: &GridOptions,
    limits: &Limits,
) -> Result<DecodedMap, IngestError> {
    let thresholds = Thresholds::OF_MESSAGES.overridden(options)?;
    let parts = read(bytes)?;
    let pointer = parts.pointer.clone();
    let map = assemble(parts, thresholds, options, limits);
    map.map_err(|error| IngestError { pointer: pointer + &error.pointer, ..error })
}

/// Reads a message of either notation.
fn read(bytes: &[u8]) -> Result<MessageParts, IngestError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.trim_ascii_start().first() == Some(&b'{') {
        return json::read(bytes);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if echo::is_message(text) => echo::read(text),
        _ => {
            let message = "this is no OccupancyGrid message: expected an object with `info` and `data`, as JSON or as \
                           the YAML of `topic echo`";
            Err(IngestError::invalid("", message))
        }
    }
}

fn assemble(
    parts: MessageParts,
    thresholds: Thresholds,
    options: &GridOptions,
    limits: &Limits,
) -> Result<DecodedMap, IngestError> {
    let mut warnings = Vec::new();
    let missing = |name| IngestError::invalid(format!("/{name}"), format!("`{name}` is missing"));
    let info = parts.info.ok_or_else(|| missing("info"))?;
    let info = Fields::of(&info, "/info")?;
    let width = side(&info, "width", &mut warnings)?;
    let height = side(&info, "height", &mut warnings)?;
    limits.check_size(width, height, ["/info/width", "/info/height"])?;
    let frame = frame(&info, &mut warnings)?;
    let values = parts.data.ok_or_else(|| missing("data"))?;
    if values.len() as u64 != width * height {
        let (found, expected) = (values.len(), width * height);
        let text = format!("`data` has {found} cells, but width x height is {width} x {height} = {expected}");
        return Err(IngestError::invalid("/data", text));
    }
    let judge: fn(Thresholds, i8) -> Occupancy = if has_ones_for_occupied(&values, options) {
        let message = "no value of `data` is above 1, so 1 was read as occupied and not as 1 per cent, in the words of \
                       ROS 2; to keep per cent, set options.grid.semantics: \"nav2\"";
        warnings.push(Diagnostic::new("ones-occupied", message));
        |_: Thresholds, value: i8| match value {
            0 => Occupancy::Free,
            1 => Occupancy::Occupied,
            _ => Occupancy::Unknown,
        }
    } else {
        Thresholds::judge_value
    };
    let cells = values.into_iter().map(|value| judge(thresholds, value)).collect();
    let grid = OccupancyGrid::new(width as usize, height as usize, frame, cells);
    Ok(DecodedMap { grid, warnings })
}

/// Whether the values are -1, 0 and 1 only, and nobody asked for per cent.
fn has_ones_for_occupied(values: &[i8], options: &GridOptions) -> bool {
    let per_cent = options.semantics != GridSemantics::Intended
        || options.free_threshold.is_some()
        || options.occupied_threshold.is_some();
    !per_cent && values.iter().max() == Some(&1)
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
