//! Processes and their results, in the words of OGC API Processes.

use serde::Serialize;
use serde_json::{Value, json};
use utoipa::ToSchema;

use super::link::Link;
use crate::app::ProcessDescription;

/// What can be computed: `processSummary` of OGC API Processes.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = ProcessSummary)]
#[serde(rename_all = "camelCase")]
pub struct ProcessSummaryView {
    #[schema(example = "semantic-map")]
    id: &'static str,
    title: &'static str,
    description: &'static str,
    /// Raised when the same map and options give another result.
    version: String,
    /// `sync-execute`, `async-execute`, `dismiss`
    job_control_options: [&'static str; 3],
    links: Vec<Link>,
}

impl ProcessSummaryView {
    /// What the service says of a process in its list.
    #[must_use]
    pub fn new(process: &ProcessDescription, links: Vec<Link>) -> Self {
        Self {
            id: process.id,
            title: process.title,
            description: process.description,
            version: process.version.to_string(),
            job_control_options: ["sync-execute", "async-execute", "dismiss"],
            links,
        }
    }
}

/// The processes.
#[derive(Debug, Serialize, ToSchema)]
pub struct ProcessList {
    /// Each in short.
    pub processes: Vec<ProcessSummaryView>,
    /// Itself.
    pub links: Vec<Link>,
}

/// A process with all that it takes and makes: `process` of OGC API Processes.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Process)]
pub struct ProcessView {
    #[serde(flatten)]
    summary: ProcessSummaryView,
    /// Each input by its name: title, schema, how often it occurs.
    #[schema(value_type = Object)]
    inputs: Value,
    /// Each output by its name: title and schema.
    #[schema(value_type = Object)]
    outputs: Value,
}

impl ProcessView {
    /// The analysis of a map; `options` is the address of the schema of its options.
    #[must_use]
    pub fn analysis(summary: ProcessSummaryView, options: &str) -> Self {
        let input =
            |title: &str, schema: Value| json!({"title": title, "schema": schema, "minOccurs": 0, "maxOccurs": 1});
        let binary = json!({"type": "string", "contentEncoding": "base64"});
        let inputs = json!({
            "mapId": input("Id of a map that was uploaded: it is analysed again", json!({"type": "string", "format": "uuid"})),
            "occupancyGrid": input("Or a nav_msgs/OccupancyGrid message", json!({"type": "object"})),
            "image": input("Or a picture in base64: PNG, PGM, BMP, TIFF, JPEG or WebP", binary),
            "metadata": input(
                "The metadata of map_server that belong to the picture, as YAML or as an object",
                json!({"oneOf": [{"type": "string"}, {"type": "object"}]})
            ),
            "name": input("Name for people of a map that is sent", json!({"type": "string"})),
            "options": input("Options of every stage that differ from the defaults", json!({"$ref": options})),
        });
        let link = json!({"type": "object", "format": "uri-reference", "required": ["href"]});
        let output = |title: &str, schema: &Value| json!({"title": title, "schema": schema});
        let outputs = json!({
            "analysis": output("Link to the analysis, which may be a proposal beside the one in force", &link),
            "map": output("Link to the map, the root of an OGC API of its own", &link),
            "faces": output("Link to its labelled faces", &link),
            "locations": output("Link to its storage locations", &link),
        });
        Self { summary, inputs, outputs }
    }
}

/// What an analysis made: `results` of OGC API Processes. Those that were not asked for are absent.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Results)]
pub struct ResultsView {
    /// The analysis, which may be a proposal beside the one that answers under the other links.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub analysis: Option<Link>,
    /// The map.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<Link>,
    /// Its labelled faces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<Link>,
    /// Its storage locations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub locations: Option<Link>,
}
