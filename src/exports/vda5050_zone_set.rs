//! VDA 5050 zone set.
//!
//! Source: VDA 5050 3.0.0, topic `zoneSet`, github.com/VDA5050/VDA5050. The schema of the release and that of the
//! branch `main` name the limitation of a bidirected zone differently: both names are written, with one value.
//!
//! Method: a zone for each bounded face. A corridor is BIDIRECTED along the long side of its face, a junction has a
//! `SPEED_LIMIT`, storage and unidentified ground are BLOCKED, a work place has a PENALTY. Faces do not overlap, as the
//! standard asks of directed zones. Faces with holes are cut into zones without. The id of the set is the hash of its
//! zones, because the content of a set must never change under one id. Limits: a rule set that tells junctions from
//! corridors by their name alone, like that for offices, has no speed limits.

use jiff::Timestamp;
use serde::Serialize;
use stillage_core::arrangement::FaceId;

use super::hole_free::hole_free;
use super::source::{CREATOR, ExportSource};
use super::zones::Ground;

/// Version of the protocol.
const VERSION: &str = "3.0.0";

/// What zones cannot be read off a map.
#[derive(Debug, Clone, PartialEq)]
pub struct ZoneSetOptions {
    /// Manufacturer of the vehicle that the message goes to.
    pub manufacturer: String,
    /// Its serial number.
    pub serial_number: String,
    /// Greatest speed in junctions, metres per second.
    pub junction_speed: f64,
    /// Penalty of work places, 0 to 1.
    pub work_place_penalty: f64,
}

impl Default for ZoneSetOptions {
    /// 1 m/s, a slow walk, where ways meet; work places are nearly forbidden, as a penalty of 1 is the last resort.
    fn default() -> Self {
        let any = || "any".to_owned();
        Self { manufacturer: any(), serial_number: any(), junction_speed: 1.0, work_place_penalty: 0.9 }
    }
}

/// A message on the topic `zoneSet`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ZoneSetMessage {
    header_id: u32,
    timestamp: Timestamp,
    version: &'static str,
    manufacturer: String,
    serial_number: String,
    /// The zones of a map.
    pub zone_set: ZoneSet,
}

/// The zones of a map.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ZoneSet {
    map_id: String,
    /// Hash of the zones.
    pub zone_set_id: String,
    zone_set_descriptor: String,
    /// One or several for each face.
    pub zones: Vec<Zone>,
}

/// Ground with a rule.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Zone {
    zone_id: String,
    #[serde(flatten)]
    rule: ZoneRule,
    zone_descriptor: String,
    /// Its border, counter-clockwise.
    pub vertices: Vec<ZoneCorner>,
}

/// What holds in a zone.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "zoneType", rename_all = "SCREAMING_SNAKE_CASE", rename_all_fields = "camelCase")]
pub enum ZoneRule {
    /// No vehicle enters.
    Blocked,
    /// No vehicle is faster.
    SpeedLimit {
        /// Metres per second.
        maximum_speed: f64,
    },
    /// Vehicles avoid it.
    Penalty {
        /// 0 to 1: only if there is no other way.
        penalty_factor: f64,
    },
    /// Vehicles drive along a direction or against it.
    Bidirected {
        /// Radians.
        direction: f64,
        /// Its name in the branch `main`.
        bidirected_limitation: &'static str,
        /// Its name in the release.
        limitation: &'static str,
    },
}

/// A corner, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ZoneCorner {
    /// Map frame.
    pub x: f64,
    /// Map frame.
    pub y: f64,
}

/// The zones of a map as a message to a vehicle.
#[must_use]
pub fn zone_set(source: &ExportSource<'_>, options: &ZoneSetOptions) -> ZoneSetMessage {
    let zones: Vec<Zone> =
        source.analysis.subdivision.faces().flat_map(|face| zones_of(source, face, options)).collect();
    ZoneSetMessage {
        header_id: 0,
        timestamp: source.created,
        version: VERSION,
        manufacturer: options.manufacturer.clone(),
        serial_number: options.serial_number.clone(),
        zone_set: ZoneSet {
            map_id: source.map_id.to_owned(),
            zone_set_id: content_hash(source.map_id, &zones),
            zone_set_descriptor: format!("{} by {CREATOR}", source.name),
            zones,
        },
    }
}

fn zones_of(source: &ExportSource<'_>, face: FaceId, options: &ZoneSetOptions) -> Vec<Zone> {
    let label = source.semantic.label(face);
    let rule = rule(source, face, Ground::of(label), options);
    let corners = |ring: &Vec<stillage_core::Point>| -> Vec<ZoneCorner> {
        ring.iter().map(|&point| source.position(point)).map(|[x, y]| ZoneCorner { x, y }).collect()
    };
    let pieces = hole_free(&source.analysis.subdivision.rings(face));
    let zone = |(index, ring): (usize, &Vec<stillage_core::Point>)| Zone {
        zone_id: if pieces.len() > 1 { format!("face-{}-{}", face.0, index + 1) } else { format!("face-{}", face.0) },
        rule: rule.clone(),
        zone_descriptor: label.name.clone(),
        vertices: corners(ring),
    };
    pieces.iter().enumerate().map(zone).collect()
}

fn rule(source: &ExportSource<'_>, face: FaceId, ground: Ground, options: &ZoneSetOptions) -> ZoneRule {
    /// Vehicles may leave the direction, to pass one another or to turn to a location, but should not.
    const LIMITATION: &str = "SOFT";
    match ground {
        Ground::Blocked => ZoneRule::Blocked,
        Ground::Junction => ZoneRule::SpeedLimit { maximum_speed: options.junction_speed },
        Ground::WorkPlace => ZoneRule::Penalty { penalty_factor: options.work_place_penalty },
        Ground::Way => ZoneRule::Bidirected {
            direction: source.heading(source.analysis.faces[face.index()].heading),
            bidirected_limitation: LIMITATION,
            limitation: LIMITATION,
        },
    }
}

fn content_hash(map_id: &str, zones: &[Zone]) -> String {
    let content = serde_json::to_vec(&(map_id, zones)).expect("zones are texts and finite numbers");
    blake3::hash(&content).to_hex().to_string()
}
