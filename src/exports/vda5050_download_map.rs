//! The order to a vehicle to fetch a map, as VDA 5050 gives it.
//!
//! Source: VDA 5050 3.0.0, instant action `downloadMap` (6.3), github.com/VDA5050/VDA5050. The vehicle pulls a single
//! file over HTTP. Method: the link leads to the bundle of a version of the map; its hash is SHA-256. Limits: what a
//! vehicle makes of the file is its manufacturer's affair.

use serde::Serialize;

use super::source::ExportSource;
use super::vda5050_header::{Recipient, VERSION};

/// A message on the topic `instantActions`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct InstantActions {
    header_id: u32,
    timestamp: String,
    version: &'static str,
    manufacturer: String,
    serial_number: String,
    actions: [DownloadAction; 1],
}

/// An action of a vehicle.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct DownloadAction {
    action_type: &'static str,
    action_id: String,
    blocking_type: &'static str,
    action_parameters: [ActionParameter; 4],
}

/// A parameter of an action.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ActionParameter {
    key: &'static str,
    value: String,
}

/// The order to fetch the bundle of a version of a map; `hash` is the SHA-256 of the bundle, in hexadecimal digits.
#[must_use]
pub fn download_map(source: &ExportSource<'_>, recipient: &Recipient, link: &str, hash: String) -> InstantActions {
    let parameters = [
        ("mapId", source.map_id.to_owned()),
        ("mapVersion", source.version.to_owned()),
        ("mapDownloadLink", link.to_owned()),
        ("mapHash", hash),
    ];
    InstantActions {
        header_id: 0,
        timestamp: source.created_text(),
        version: VERSION,
        manufacturer: recipient.manufacturer.clone(),
        serial_number: recipient.serial_number.clone(),
        actions: [DownloadAction {
            action_type: "downloadMap",
            action_id: format!("download-{}-{}", source.map_id, source.version),
            blocking_type: "NONE",
            action_parameters: parameters.map(|(key, value)| ActionParameter { key, value }),
        }],
    }
}
