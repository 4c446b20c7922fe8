//! The refusals of an operation, as the document shows them.
//!
//! A handler names its own in `responses(...)`, such as `NotFound` or `NotAnalysed`. Those that follow from the shape of
//! an operation (it is a write, has a body, has a condition) are added by [`mod@super::openapi`]. Each is one component of
//! the document that the operations refer to.

use std::collections::BTreeMap;

use utoipa::IntoResponses;
use utoipa::ToSchema as _;
use utoipa::openapi::header::HeaderBuilder;
use utoipa::openapi::schema::{ObjectBuilder, Type};
use utoipa::openapi::{ContentBuilder, Ref, RefOr, Response, ResponseBuilder};

use crate::http::problem::{PROBLEM_JSON, ProblemDocument};

macro_rules! refusals {
    ($($(#[$doc:meta])* $name:ident = $status:literal, $description:literal;)*) => {
        $(
            $(#[$doc])*
            #[derive(Debug)]
            pub struct $name;

            impl IntoResponses for $name {
                fn responses() -> BTreeMap<String, RefOr<Response>> {
                    let reference = RefOr::Ref(Ref::from_response_name(stringify!($name)));
                    BTreeMap::from([($status.to_string(), reference)])
                }
            }
        )*

        /// Every refusal as a component of the document, by its name.
        pub fn components() -> impl Iterator<Item = (&'static str, Response)> {
            [$((stringify!($name), component($status, $description))),*].into_iter()
        }
    };
}

refusals! {
    /// 400: of every operation.
    BadRequest = 400, "The request is malformed, or a parameter is unknown or has a bad value";
    /// 401: of every operation that needs a key.
    Unauthorized = 401, "The request has no key, or one that opens nothing: where keys are required";
    /// 403: of every write.
    Forbidden = 403, "A page of another site tried to write, the resource is read-only, a quota is reached, or the key lacks a scope";
    /// 403: of every read that needs a key.
    MissingScope = 403, "The key lacks the scope that the operation needs";
    /// 404: named by handlers.
    NotFound = 404, "There is no such resource";
    /// 405: named by handlers that serve several kinds of resources.
    MethodNotAllowed = 405, "The resource does not answer this method";
    /// 406: of every read that has content.
    NotAcceptable = 406, "No representation of an accepted media type";
    /// 408: of every body.
    Timeout = 408, "The body arrived too slowly";
    /// 409: named by handlers that read an analysed map.
    NotAnalysed = 409, "The map has no finished analysis yet";
    /// 409: named by handlers that bring two maps together.
    NotSameSite = 409, "The maps show different sites";
    /// 409: named by handlers.
    Conflict = 409, "The state of the resource forbids the request";
    /// 412: of every `If-Match`.
    PreconditionFailed = 412, "The resource has changed since the ETag in If-Match was read";
    /// 413: of every body.
    TooLarge = 413, "The request is over a limit";
    /// 415: of every body.
    UnsupportedMediaType = 415, "The format is not supported";
    /// 421: of every operation.
    Misdirected = 421, "The service does not answer under this host";
    /// 422: of every body.
    Invalid = 422, "The content is invalid";
    /// 428: named by handlers that write only with `If-Match`.
    PreconditionRequired = 428, "If-Match is missing";
    /// 429: of every operation that needs a key.
    TooManyRequests = 429, "Where keys are required: too many requests of the key, waiting jobs of its tenant, or wrong keys of the address";
    /// 500: of every operation.
    Internal = 500, "The service failed";
    /// 503: of every operation.
    Unavailable = 503, "The service cannot answer now, has as much to do as it can, or its queue is full";
    /// 507: named by handlers that store something large.
    NoSpace = 507, "The server is short of disk space";
}

fn component(status: u16, description: &str) -> Response {
    let schema = Ref::from_schema_name(ProblemDocument::name());
    let builder = ResponseBuilder::new().description(description);
    let builder = builder.content(PROBLEM_JSON, ContentBuilder::new().schema(Some(schema)).build());
    let seconds = ObjectBuilder::new().schema_type(Type::Integer);
    let retry_after = HeaderBuilder::new().schema(Some(seconds)).description(Some("Seconds to wait"));
    let text = ObjectBuilder::new().schema_type(Type::String);
    let challenge = HeaderBuilder::new().schema(Some(text)).description(Some("How to sign in (RFC 6750)"));
    match status {
        401 => builder.header("WWW-Authenticate", challenge.build()).build(),
        429 | 503 | 507 => builder.header("Retry-After", retry_after.build()).build(),
        _ => builder.build(),
    }
}
