//! What an execution asks for: `execute` of OGC API Processes.

use std::collections::BTreeMap;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;
use serde_json::Value;
use stillage_core::AnalysisOptions;
use utoipa::ToSchema;
use uuid::Uuid;

use crate::app::NewMap;
use crate::http::extract::pointer_step;
use crate::http::problem::Problem;
use crate::ingest::MapSource;
use crate::options::RequestedOptions;
use crate::views::id::Id;
use crate::views::name::Name;
use crate::views::occupancy_grid::OccupancyGridMessage;
use crate::views::options::AnalysisOptionsView;

/// The outputs of an analysis.
const OUTPUTS: [&str; 4] = ["analysis", "map", "faces", "locations"];

/// What is to be computed.
#[derive(Debug, Deserialize, ToSchema)]
#[schema(as = Execute)]
#[serde(deny_unknown_fields)]
pub struct ExecuteBody {
    inputs: ExecuteInputs,
    /// The outputs that a synchronous answer holds, by name; all when absent.
    #[schema(value_type = Option<Object>, example = json!({"faces": {}}))]
    outputs: Option<BTreeMap<String, Value>>,
    /// The form of a synchronous answer. When absent: the value alone where one output is named, else a document.
    response: Option<ResponseForm>,
}

/// The form of an answer.
#[derive(Debug, Clone, Copy, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
enum ResponseForm {
    /// A JSON object with a member for each output.
    Document,
    /// The value of the one output that is named.
    Raw,
}

/// A map, and how it is analysed. The map is one of three: `mapId`, `occupancyGrid`, or `image` with `metadata`. A value may
/// stand in an object as its `value`.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
struct ExecuteInputs {
    /// A map that was uploaded: it is analysed again.
    map_id: Option<Id>,
    /// A `nav_msgs/OccupancyGrid` message.
    #[schema(value_type = Option<OccupancyGridMessage>)]
    occupancy_grid: Option<Value>,
    /// A picture in base64.
    #[schema(value_type = Option<String>)]
    image: Option<Value>,
    /// The metadata of `map_server` for the picture: YAML, or the same keys as an object.
    #[schema(value_type = Option<Object>)]
    metadata: Option<Value>,
    /// Name for people of a map that is sent.
    name: Option<Name>,
    /// Options of every stage that differ from a preset, or from the defaults.
    #[serde(default)]
    #[schema(value_type = AnalysisOptionsView, required = false)]
    options: RequestedOptions,
}

/// What is to be analysed.
#[derive(Debug)]
pub enum Analysed {
    /// A map that was uploaded, with these options.
    Stored(Uuid, AnalysisOptions),
    /// A map that is sent.
    Sent(NewMap),
}

/// An execution that makes sense.
#[derive(Debug)]
pub struct Execution {
    /// What is to be analysed.
    pub analysed: Analysed,
    outputs: Option<BTreeMap<String, Value>>,
    response: Option<ResponseForm>,
}

impl Execution {
    /// Whether an output is to be in the answer.
    pub fn wants(&self, output: &str) -> bool {
        self.outputs.as_ref().is_none_or(|outputs| outputs.contains_key(output))
    }

    /// The output whose value is the whole answer, if there is one.
    pub fn raw_output(&self) -> Option<&str> {
        let outputs = self.outputs.as_ref().filter(|_| !matches!(self.response, Some(ResponseForm::Document)))?;
        outputs.keys().next().filter(|_| outputs.len() == 1).map(String::as_str)
    }

    /// Where in the body a pointer into an upload or into options leads.
    pub fn pointer(&self, pointer: &str) -> String {
        let is_message = matches!(&self.analysed, Analysed::Sent(map) if matches!(map.source, MapSource::Message(_)));
        let is_beside = ["/options", "/name"].iter().any(|member| pointer.starts_with(member));
        let root = if is_message && !is_beside { "/inputs/occupancyGrid" } else { "/inputs" };
        format!("{root}{pointer}")
    }
}

impl ExecuteBody {
    /// Checks that there is one map, that the outputs are outputs, and that a raw answer has one.
    ///
    /// # Errors
    /// 422 with the pointer of the input.
    pub fn read(self) -> Result<Execution, Problem> {
        for name in self.outputs.iter().flat_map(BTreeMap::keys) {
            if !OUTPUTS.contains(&name.as_str()) {
                let detail = format!("is not an output: those are {}", OUTPUTS.join(", "));
                return Err(Problem::invalid(format!("/outputs/{}", pointer_step(name)), detail));
            }
        }
        if matches!(self.response, Some(ResponseForm::Raw)) && self.outputs.as_ref().map(BTreeMap::len) != Some(1) {
            let detail = "a raw answer is one value: name one output in outputs, or ask for a document";
            return Err(Problem::invalid("/response", detail));
        }
        let ExecuteInputs { map_id, occupancy_grid, image, metadata, name, options } = self.inputs;
        if metadata.is_some() && image.is_none() {
            return Err(Problem::invalid("/inputs/metadata", "belongs to an image, and there is none"));
        }
        let options = options.0;
        let sent = |source| {
            let name = name.as_ref().map_or_else(|| "map".to_owned(), |name| name.0.clone());
            let map = NewMap {
                source,
                name,
                options: options.clone(),
                georeference: None,
                previous: None,
                idempotency_key: None,
            };
            Analysed::Sent(map)
        };
        let analysed = match (map_id, occupancy_grid, image) {
            (Some(id), None, None) if name.is_none() => Analysed::Stored(id.0, options),
            (Some(_), None, None) => {
                return Err(Problem::invalid("/inputs/name", "names a map that is sent: PATCH renames this one"));
            }
            (None, Some(message), None) => {
                let message = inline("occupancyGrid", message)?;
                sent(MapSource::Message(message.to_string().into_bytes()))
            }
            (None, None, Some(image)) => {
                let metadata =
                    metadata.ok_or_else(|| Problem::invalid("/inputs/metadata", "an image needs its metadata"))?;
                sent(MapSource::Image { image: picture(image)?, metadata: text(inline("metadata", metadata)?) })
            }
            _ => {
                return Err(Problem::invalid("/inputs", "needs one map: mapId, occupancyGrid, or image with metadata"));
            }
        };
        Ok(Execution { analysed, outputs: self.outputs, response: self.response })
    }
}

/// A value by itself, or as the `value` of an object.
fn inline(name: &str, value: Value) -> Result<Value, Problem> {
    let Value::Object(mut members) = value else { return Ok(value) };
    if members.contains_key("href") {
        let detail = "addresses are not fetched: send the content itself";
        return Err(Problem::invalid(format!("/inputs/{name}/href"), detail));
    }
    Ok(members.remove("value").unwrap_or(Value::Object(members)))
}

fn text(value: Value) -> Vec<u8> {
    match value {
        Value::String(text) => text.into_bytes(),
        other => other.to_string().into_bytes(),
    }
}

fn picture(value: Value) -> Result<Vec<u8>, Problem> {
    let wrong = |detail: &str| Problem::invalid("/inputs/image", detail);
    let Value::String(text) = inline("image", value)? else { return Err(wrong("must be a picture in base64")) };
    let plain: Vec<u8> = text.into_bytes().into_iter().filter(|byte| !byte.is_ascii_whitespace()).collect();
    STANDARD.decode(plain).map_err(|_| wrong("is not base64"))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn read(inputs: &Value) -> Result<Execution, Problem> {
        serde_json::from_value::<ExecuteBody>(json!({"inputs": inputs})).expect("is a body").read()
    }

    #[test]
    fn a_map_is_sent_in_one_of_three_ways() {
        let id = "019ab3c2-0000-7000-8000-000000000000";
        assert!(matches!(read(&json!({"mapId": id})).expect("is right").analysed, Analysed::Stored(..)));
        let message = read(&json!({"occupancyGrid": {"value": {"data": []}}, "name": "Hall"})).expect("is right");
        assert_eq!(message.pointer("/info"), "/inputs/occupancyGrid/info");
        assert_eq!(message.pointer("/options/seed"), "/inputs/options/seed");
        let Analysed::Sent(map) = message.analysed else { panic!("is sent") };
        assert_eq!((map.name.as_str(), map.source), ("Hall", MapSource::Message(br#"{"data":[]}"#.to_vec())));
        let picture = json!({"image": {"value": "UDU=", "encoding": "base64"}, "metadata": {"resolution": 1}});
        let Analysed::Sent(map) = read(&picture).expect("is right").analysed else { panic!("is sent") };
        assert_eq!(map.source, MapSource::Image { image: b"P5".to_vec(), metadata: br#"{"resolution":1}"#.to_vec() });
    }

    #[test]
    fn what_is_no_map_is_refused_by_its_input() {
        let id = "019ab3c2-0000-7000-8000-000000000000";
        for (inputs, pointer) in [
            (json!({}), "/inputs"),
            (json!({"mapId": id, "occupancyGrid": {}}), "/inputs"),
            (json!({"mapId": id, "name": "Hall"}), "/inputs/name"),
            (json!({"mapId": id, "metadata": ""}), "/inputs/metadata"),
            (json!({"image": "UDU="}), "/inputs/metadata"),
            (json!({"image": "?", "metadata": ""}), "/inputs/image"),
            (json!({"image": {"href": "http://elsewhere.example/a.png"}, "metadata": ""}), "/inputs/image/href"),
        ] {
            let problem = read(&inputs).expect_err("is refused");
            assert_eq!(problem.errors()[0].pointer.as_deref(), Some(pointer), "{inputs}");
        }
    }
}
