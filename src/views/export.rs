//! The exports of a map, as they are listed.

use serde::Serialize;
use utoipa::ToSchema;

use super::link::Link;
use crate::exports::{Export, option};

/// The exports of a map.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
pub struct ExportList {
    /// Each a file.
    pub exports: Vec<ExportView>,
    /// Itself, and the map.
    pub links: Vec<Link>,
}

/// A file that another program reads.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
#[schema(as = Export)]
pub struct ExportView {
    /// Name of the file.
    #[schema(example = "lif.json")]
    name: &'static str,
    /// Name of the format on the command line.
    #[schema(example = "lif")]
    format: &'static str,
    /// Media type of the file.
    #[schema(example = "application/json")]
    media_type: &'static str,
    /// What it is for.
    purpose: &'static str,
    /// Query parameters that it takes.
    options: Vec<ExportOptionView>,
    /// The file.
    links: [Link; 1],
}

/// A query parameter of an export.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "camelCase")]
#[schema(as = ExportOption)]
pub struct ExportOptionView {
    /// Its name.
    #[schema(example = "footprintRadiusM")]
    name: &'static str,
    /// What it says, and what holds without it.
    description: &'static str,
    /// A value that it may have.
    #[schema(example = "0.35")]
    example: &'static str,
}

impl ExportView {
    /// An export with the link to its file.
    #[must_use]
    pub fn new(export: &Export, link: Link) -> Self {
        let options = export.options.iter().filter_map(|name| option(name));
        Self {
            name: export.name,
            format: export.format,
            media_type: export.media_type,
            purpose: export.purpose,
            options: options
                .map(|option| ExportOptionView {
                    name: option.name,
                    description: option.description,
                    example: option.example,
                })
                .collect(),
            links: [link],
        }
    }
}
