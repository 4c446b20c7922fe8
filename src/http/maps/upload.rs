//! The two shapes of an upload: a form with the files of `map_server`, or an OccupancyGrid message.

use axum::extract::multipart::{Field, MultipartError};
use axum::extract::{Multipart, Request};
use axum::http::{HeaderMap, StatusCode};
use stillage_core::AnalysisOptions;
use utoipa::ToSchema;

use crate::app::NewMap;
use crate::blocking::off_the_runtime;
use crate::coordinates::Survey;
use crate::http::extract::form::{self, Disposition};
use crate::http::extract::{self, broken_body, is_json, parse_json};
use crate::http::problem::{Problem, ProblemType};
use crate::ingest::{self, Limits, MapSource};
use crate::options::RequestedOptions;
use crate::views::georeference::{GeoreferenceView, UnusableMember};
use crate::views::id::Id;
use crate::views::name::Name;
use crate::views::options::AnalysisOptionsView;

/// Bytes that the part `metadata` or `options` may have: a hundred times what `map_server` writes.
const TEXT_PART_BYTES: usize = 64 << 10;
/// Bytes that the part `name`, `georeference` or `previous` may have.
const SMALL_PART_BYTES: usize = 4 << 10;
/// Media types of YAML: RFC 9512, and those from before it.
const YAML: [&str; 4] = ["application/yaml", "application/x-yaml", "text/yaml", "text/x-yaml"];
/// What a form adds to its image at most: the other parts and the boundaries.
pub const FORM_OVERHEAD_BYTES: usize = 256 << 10;

/// The form of an upload, for the document.
#[derive(Debug, ToSchema)]
#[schema(as = MapUpload)]
#[allow(dead_code, reason = "it describes the form; the parts are read one by one")]
pub struct MapUploadView {
    /// The picture: PNG, PGM (P2, P5, 8 or 16 bit), BMP, TIFF, JPEG or WebP.
    #[schema(value_type = String, format = Binary, content_media_type = "application/octet-stream")]
    image: Vec<u8>,
    /// The metadata of `map_server`, as YAML or as JSON: `image`, `resolution`, `origin`, `occupied_thresh`,
    /// `free_thresh`, `negate`, `mode`. The file that its `image` names is never opened.
    #[schema(value_type = String, example = "{image: map.pgm, resolution: 0.05, origin: [0, 0, 0], negate: 0, occupied_thresh: 0.65, free_thresh: 0.196}")]
    metadata: String,
    /// Name for people; that of the image file when absent.
    name: Option<Name>,
    /// Options of the first analysis.
    #[schema(required = false)]
    options: AnalysisOptionsView,
    /// Where the map lies on Earth.
    #[schema(required = false)]
    georeference: GeoreferenceView,
    /// Id of an earlier map of the same site: the new one is aligned to it, and codes stay with their places.
    previous: Option<Id>,
}

/// The georeference that is to be stored: nothing for a nominal one.
///
/// # Errors
/// 422 for numbers that are no place on Earth, and for pairs of points that give none.
pub fn stored(georeference: GeoreferenceView) -> Result<Option<Survey>, Problem> {
    let wrong = |UnusableMember { pointer, detail }| Problem::invalid(format!("/georeference{pointer}"), detail);
    georeference.read().map_err(wrong)
}

/// Reads an upload of either shape.
///
/// # Errors
/// 415 for another content type, 413 over a limit, 400 for a broken body, 422 for parts that are wrong.
pub async fn read<S: Send + Sync>(
    request: Request,
    state: &S,
    name: Option<Name>,
    limits: &Limits,
) -> Result<NewMap, Problem> {
    let idempotency_key = idempotency_key(request.headers())?;
    let content_type = extract::content_type(request.headers());
    let mut map = if is_json(request.headers()) || YAML.contains(&content_type.as_str()) {
        let bytes = extract::body(request, state).await?;
        new_map(MapSource::Message(bytes.into()))
    } else if content_type == "multipart/form-data" {
        read_form(form::open(request, state).await?, limits).await?
    } else {
        let detail = "send multipart/form-data (image and metadata), or application/json or application/yaml (an OccupancyGrid \
                      message)";
        return Err(Problem::new(ProblemType::UnsupportedMediaType, detail));
    };
    map.idempotency_key = idempotency_key;
    if let Some(Name(name)) = name {
        map.name = name;
    }
    Ok(map)
}

fn new_map(source: MapSource) -> NewMap {
    let options = AnalysisOptions::default();
    let name = "map".to_owned();
    NewMap { source, name, options, georeference: None, previous: None, idempotency_key: None }
}

/// The parts of a form as they come in.
#[derive(Default)]
struct Form {
    image: Option<Vec<u8>>,
    file_name: Option<String>,
    metadata: Option<Vec<u8>>,
    name: Option<Name>,
    options: Option<RequestedOptions>,
    georeference: Option<GeoreferenceView>,
    previous: Option<Id>,
}

async fn read_form(mut parts: Multipart, limits: &Limits) -> Result<NewMap, Problem> {
    let mut form = Form::default();
    while let Some(mut part) = parts.next_field().await.map_err(|error| broken_form(&error))? {
        let part = &mut part;
        let disposition = Disposition::of(part.headers());
        match disposition.name.unwrap_or_default().as_str() {
            "image" => {
                form.file_name = disposition.file_name;
                once(&mut form.image, "image", read_part(part, "image", limits.max_bytes).await?)?;
            }
            "metadata" => once(&mut form.metadata, "metadata", read_part(part, "metadata", TEXT_PART_BYTES).await?)?,
            "name" => {
                let name = String::from_utf8(read_part(part, "name", SMALL_PART_BYTES).await?);
                let name = name.map_err(|_| "must be UTF-8").and_then(Name::try_from);
                once(&mut form.name, "name", name.map_err(|detail| Problem::invalid("/name", detail))?)?;
            }
            "options" => {
                let bytes = read_part(part, "options", TEXT_PART_BYTES).await?;
                once(&mut form.options, "options", parse_json("/options", &bytes)?)?;
            }
            "georeference" => {
                let bytes = read_part(part, "georeference", SMALL_PART_BYTES).await?;
                once(&mut form.georeference, "georeference", parse_json("/georeference", &bytes)?)?;
            }
            "previous" => {
                let text = String::from_utf8(read_part(part, "previous", SMALL_PART_BYTES).await?).unwrap_or_default();
                let id = Id::try_from(text.trim().to_owned());
                let wrong = |_| Problem::invalid("/previous", "is not the id of a map: GET /v1/maps lists them");
                once(&mut form.previous, "previous", id.map_err(wrong)?)?;
            }
            unknown => {
                let detail =
                    "is not a part of the form: those are image, metadata, name, options, georeference and previous";
                return Err(Problem::invalid(format!("/{}", extract::pointer_step(unknown)), detail));
            }
        }
    }
    form.into_map()
}

impl Form {
    fn into_map(self) -> Result<NewMap, Problem> {
        let missing = |name: &str| Problem::invalid(format!("/{name}"), "the form needs this part");
        let metadata = self.metadata.ok_or_else(|| missing("metadata"))?;
        if ingest::is_message(&metadata) {
            let detail = "is an OccupancyGrid message, which needs no image: send it as the body of the request, with \
                          Content-Type application/json or application/yaml";
            return Err(Problem::invalid("/metadata", detail));
        }
        let file_stem = || {
            let file_name = self.file_name.as_deref()?.rsplit(['/', '\\']).next()?;
            let file_name = file_name.strip_suffix(".gz").unwrap_or(file_name);
            let stem = file_name.rsplit_once('.').map_or(file_name, |(stem, _)| stem);
            Name::try_from(stem.to_owned()).ok()
        };
        let image = self.image.ok_or_else(|| missing("image"))?;
        let mut map = new_map(MapSource::Image { image, metadata });
        if let Some(Name(name)) = self.name.or_else(file_stem) {
            map.name = name;
        }
        map.previous = self.previous.map(|id| id.0);
        map.options = self.options.unwrap_or_default().0;
        map.georeference = match self.georeference {
            Some(georeference) => stored(georeference)?,
            None => None,
        };
        Ok(map)
    }
}

/// Keeps a part; a second one of the same name is an error.
fn once<T>(slot: &mut Option<T>, name: &str, value: T) -> Result<(), Problem> {
    match slot.replace(value) {
        None => Ok(()),
        Some(_) => Err(Problem::invalid(format!("/{name}"), "the form has this part twice")),
    }
}

/// Reads a part up to a limit, without holding more than that, and takes it out of its coding.
async fn read_part(part: &mut Field<'_>, name: &str, limit: usize) -> Result<Vec<u8>, Problem> {
    let mut bytes = Vec::new();
    while let Some(chunk) = part.chunk().await.map_err(|error| broken_form(&error))? {
        if bytes.len() + chunk.len() > limit {
            let detail = format!("the part is over its limit of {limit} bytes");
            return Err(Problem::at(ProblemType::TooLarge, format!("/{name}"), detail));
        }
        bytes.extend_from_slice(&chunk);
    }
    let (headers, name) = (part.headers().clone(), name.to_owned());
    off_the_runtime(move || form::plain_content(&name, &headers, bytes, limit)).await
}

fn broken_form(error: &MultipartError) -> Problem {
    match error.status() {
        StatusCode::PAYLOAD_TOO_LARGE => Problem::new(ProblemType::TooLarge, "the form is over the limit of an upload"),
        _ => broken_body(error),
    }
}

/// The `Idempotency-Key` of a request.
fn idempotency_key(headers: &HeaderMap) -> Result<Option<String>, Problem> {
    let Some(key) = headers.get("idempotency-key") else { return Ok(None) };
    match key.to_str() {
        Ok(key) if (1..=255).contains(&key.len()) => Ok(Some(key.to_owned())),
        _ => {
            Err(Problem::new(ProblemType::BadRequest, "Idempotency-Key must have 1 to 255 printable ASCII characters"))
        }
    }
}
