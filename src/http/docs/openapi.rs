//! The OpenAPI 3.1 document: collected from the routes, completed by rules that hold for every operation.

use axum::http::Method;
use serde_json::Value;
use stillage_core::AnalysisOptions;
use utoipa::openapi::path::{Operation, Parameter, ParameterBuilder, ParameterIn};
use utoipa::openapi::schema::{ObjectBuilder, Type};
use utoipa::openapi::{OpenApi, RefOr, Required, ResponseBuilder, Schema};
use utoipa::{IntoResponses as _, OpenApi as _};

use super::refusals::{
    BadRequest, Forbidden, Internal, Invalid, Misdirected, NotAcceptable, PreconditionFailed, Timeout, TooLarge,
    Unavailable, UnsupportedMediaType,
};
use super::security;
use crate::http::extract::crs::CrsName;
use crate::http::extract::format;
use crate::http::ogc::collections::CollectionId;
use crate::http::problem::ProblemDocument;

/// Where the service lies, seen by clients without a proxy between.
pub const SERVER: &str = "/";

/// What the document says of itself.
#[derive(utoipa::OpenApi)]
#[openapi(
    info(
        title = "stillage",
        description = "An occupancy map goes in, a semantic map comes out: faces, edges, places, storage locations and \
            routes as GeoJSON.\n\nEvery error is a problem detail (RFC 9457). Unknown query parameters and members are \
            errors. Reads have strong ETags. Pages of other sites may read, not write.",
        license(name = "MIT OR Apache-2.0", identifier = "MIT OR Apache-2.0")
    ),
    servers((url = SERVER, description = "This service")),
    // Beside the problems, what occurs in parameters only.
    components(schemas(ProblemDocument, CollectionId, CrsName)),
    tags(
        (name = "maps", description = "Upload maps and look at them"),
        (name = "jobs", description = "Watch and dismiss analyses"),
        (name = "semantics", description = "Give meaning: categories, labels, rule sets"),
        (name = "corrections", description = "Say what no automatic reading got right: draw, cut, merge, erase, name"),
        (name = "features", description = "Faces, edges, locations and the rest as GeoJSON"),
        (name = "fleet", description = "Routes for robots"),
        (name = "service", description = "Health, metrics and this document")
    )
)]
struct Api;

/// The document before the routes are in it.
#[must_use]
pub fn head() -> OpenApi {
    Api::openapi()
}

/// The operations of a document, with the path and method of each.
pub fn operations(document: &OpenApi) -> impl Iterator<Item = (&str, Method, &Operation)> {
    document.paths.paths.iter().flat_map(|(path, item)| {
        let of_path = [
            (Method::GET, &item.get),
            (Method::PUT, &item.put),
            (Method::POST, &item.post),
            (Method::PATCH, &item.patch),
            (Method::DELETE, &item.delete),
        ];
        of_path.into_iter().filter_map(move |(method, operation)| Some((path.as_str(), method, operation.as_ref()?)))
    })
}

/// Completes the document once all routes are in it.
pub fn complete(document: &mut OpenApi) {
    for item in document.paths.paths.values_mut() {
        let operations = [
            (&mut item.get, true),
            (&mut item.put, false),
            (&mut item.post, false),
            (&mut item.patch, false),
            (&mut item.delete, false),
        ];
        for (operation, is_read) in operations {
            if let Some(operation) = operation {
                complete_operation(operation, is_read);
                security::complete(operation, is_read);
            }
        }
    }
    let components = document.components.get_or_insert_default();
    security::add_scheme(components);
    for (name, response) in super::refusals::components() {
        components.responses.insert(name.to_owned(), response.into());
    }
}

/// Adds what follows from the shape of an operation: the refusals of its kind, and the conditional read.
fn complete_operation(operation: &mut Operation, is_read: bool) {
    for parameter in operation.parameters.iter_mut().flatten() {
        // A header is there or not; it is never null.
        if let RefOr::T(parameter @ Parameter { parameter_in: ParameterIn::Header, .. }) = parameter
            && let Some(RefOr::T(Schema::Object(schema))) = &mut parameter.schema
        {
            schema.schema_type = Type::String.into();
        }
    }
    if is_read {
        let format = format_parameter(operation).map(RefOr::T);
        operation.parameters.get_or_insert_default().extend(format);
    }
    let has_if_match = operation.parameters.iter().flatten().any(|parameter| {
        matches!(parameter, RefOr::T(Parameter { name, parameter_in: ParameterIn::Header, .. }) if name == "If-Match")
    });
    let has_body = operation.request_body.is_some();
    let rules = [
        (true, BadRequest::responses()),
        (!is_read, Forbidden::responses()),
        (is_read, NotAcceptable::responses()),
        (has_body, Timeout::responses()),
        (has_if_match, PreconditionFailed::responses()),
        (has_body, TooLarge::responses()),
        (has_body, UnsupportedMediaType::responses()),
        (true, Misdirected::responses()),
        (has_body, Invalid::responses()),
        (true, Internal::responses()),
        (true, Unavailable::responses()),
    ];
    for (status, refusal) in rules.into_iter().filter(|(holds, _)| *holds).flat_map(|(_, responses)| responses) {
        operation.responses.responses.entry(status).or_insert(refusal);
    }
    let has_tag =
        matches!(operation.responses.responses.get("200"), Some(RefOr::T(ok)) if ok.headers.contains_key("ETag"));
    if is_read && has_tag {
        let unchanged = ResponseBuilder::new().description("The client has the newest state already").build();
        operation.responses.responses.insert("304".to_owned(), unchanged.into());
        let condition = ParameterBuilder::new()
            .name("If-None-Match")
            .parameter_in(ParameterIn::Header)
            .required(Required::False)
            .description(Some("ETags that the client has"))
            .schema(Some(ObjectBuilder::new().schema_type(Type::String)));
        operation.parameters.get_or_insert_default().push(condition.build().into());
    }
}

/// The parameter `f` of a read, where its formats have short names.
fn format_parameter(operation: &Operation) -> Option<Parameter> {
    let Some(RefOr::T(answer)) = operation.responses.responses.get("200") else { return None };
    let media_types: Vec<&str> = answer.content.keys().map(String::as_str).collect();
    let names = format::names(&media_types)?;
    let schema = ObjectBuilder::new().schema_type(Type::String).enum_values(Some(names));
    let builder = ParameterBuilder::new().name("f").parameter_in(ParameterIn::Query).required(Required::False);
    Some(builder.description(Some("Format, where `Accept` cannot be set")).schema(Some(schema)).build())
}

/// The schemas of the options, with the member of [`AnalysisOptions`] that each describes.
const OPTIONS: [(&str, &str); 9] = [
    ("AnalysisOptions", ""),
    ("GridOptions", "/grid"),
    ("CategorizationOptions", "/categorization"),
    ("RelaxationOptions", "/categorization/relaxation"),
    ("OrientationOptions", "/orientation"),
    ("RegionOptions", "/regions"),
    ("DecompositionOptions", "/decomposition"),
    ("AnnotationOptions", "/annotation"),
    ("DeclutterOptions", "/declutter"),
];

/// The document as JSON, with the defaults of the core.
#[must_use]
pub fn value(document: &OpenApi) -> Value {
    let mut document = serde_json::to_value(document).expect("the document is plain data");
    let options = serde_json::to_value(AnalysisOptions::default()).expect("options are plain data");
    for (schema, member) in OPTIONS {
        let properties = document.pointer_mut(&format!("/components/schemas/{schema}/properties"));
        for (name, property) in properties.and_then(Value::as_object_mut).into_iter().flatten() {
            let default =
                options.pointer(&format!("{member}/{name}")).filter(|value| !value.is_null() && !value.is_object());
            let property = property.as_object_mut().expect("a schema is an object");
            match default {
                Some(default) => property.insert("default".to_owned(), default.clone()),
                // What the view itself has for a default means nothing.
                None => property.remove("default"),
            };
        }
    }
    super::integers::tell_ranges(&mut document);
    document
}

/// A document as it is served and stored: pretty, with a last line break.
#[must_use]
pub fn text(document: &Value) -> String {
    let mut text = serde_json::to_string_pretty(document).expect("the document is plain data");
    text.push('\n');
    text
}
