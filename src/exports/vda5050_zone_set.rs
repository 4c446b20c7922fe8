//! VDA 5050 zone set.
//!
//! Source: VDA 5050 3.0.0, topic `zoneSet`, github.com/VDA5050/VDA5050. The schema of the release and that of the
//! branch `main` name the limitation of a bidirected zone differently: both names are written, with one value.
//!
//! Method: a zone for each bounded face, by the rule of its label ([`ZoneRules`]). Faces do not overlap, as the standard
//! asks of directed zones. Faces with holes are cut into zones without. The id of the set is the hash of its zones, because
//! the content of a set must never change under one id.

use serde::Serialize;
use stillage_core::arrangement::FaceId;

use super::hole_free::hole_free;
use super::source::{CREATOR, ExportError, ExportSource};
use super::vda5050_header::{Recipient, VERSION};
use super::vda5050_zone_rules::{LabelRules, ZoneRule, ZoneRules};

/// A message on the topic `zoneSet`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ZoneSetMessage {
    header_id: u32,
    timestamp: String,
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

/// A corner, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ZoneCorner {
    /// Map frame.
    pub x: f64,
    /// Map frame.
    pub y: f64,
}

/// The zones of a map as a message to a vehicle.
///
/// # Errors
/// [`ExportError::UnknownLabel`] when a rule is for a label that the map does not have.
pub fn zone_set(
    source: &ExportSource<'_>,
    rules: &ZoneRules,
    recipient: &Recipient,
) -> Result<ZoneSetMessage, ExportError> {
    let rules = rules.by_label(&source.semantic.rule_set)?;
    let zones: Vec<Zone> =
        source.analysis.subdivision.faces().flat_map(|face| zones_of(source, face, &rules)).collect();
    Ok(ZoneSetMessage {
        header_id: 0,
        timestamp: source.created_text(),
        version: VERSION,
        manufacturer: recipient.manufacturer.clone(),
        serial_number: recipient.serial_number.clone(),
        zone_set: ZoneSet {
            map_id: source.map_id.to_owned(),
            zone_set_id: content_hash(source.map_id, &zones),
            zone_set_descriptor: format!("{} by {CREATOR}", source.name),
            zones,
        },
    })
}

/// The zones of a face; none where its label has none.
fn zones_of(source: &ExportSource<'_>, face: FaceId, rules: &LabelRules) -> Vec<Zone> {
    let direction = source.heading(source.analysis.faces[face.index()].heading);
    let Some(rule) = rules.rule(source.semantic.labels[face.index()], direction) else { return Vec::new() };
    let pieces = hole_free(&source.analysis.subdivision.rings(face));
    let zone = |(index, ring): (usize, &Vec<stillage_core::Point>)| Zone {
        zone_id: if pieces.len() > 1 { format!("face-{}-{}", face.0, index + 1) } else { format!("face-{}", face.0) },
        rule: rule.clone(),
        zone_descriptor: source.semantic.label(face).name.clone(),
        vertices: ring.iter().map(|&point| source.position(point)).map(|[x, y]| ZoneCorner { x, y }).collect(),
    };
    pieces.iter().enumerate().map(zone).collect()
}

fn content_hash(map_id: &str, zones: &[Zone]) -> String {
    let content = serde_json::to_vec(&(map_id, zones)).expect("zones are texts and finite numbers");
    blake3::hash(&content).to_hex().to_string()
}
