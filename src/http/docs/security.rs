//! What the document says of keys. A handler names the scope of its operation where it is not that of its method:
//! `security(("key" = ["read"]), ())`, or `security(())` where everybody may ask.

use utoipa::IntoResponses as _;
use utoipa::openapi::Components;
use utoipa::openapi::path::Operation;
use utoipa::openapi::security::{HttpAuthScheme, HttpBuilder, SecurityRequirement, SecurityScheme};

use super::refusals::{MissingScope, TooManyRequests, Unauthorized};
use crate::access::Scope;

/// The name of the scheme.
const SCHEME: &str = "key";

/// What the document says of the scheme.
const DESCRIPTION: &str = "A key of `stillage key create`. A service that was started without `--keys required` asks for none. \
    In version 3.1 of this document the word at an operation is the scope that its key needs.";

/// The scope of operations that name none.
#[must_use]
pub const fn scope_of_method(is_read: bool) -> Scope {
    if is_read { Scope::Read } else { Scope::Write }
}

/// The scope that an operation of a complete document needs; `None` where it needs no key.
#[must_use]
pub fn scope(operation: &Operation) -> Option<Scope> {
    let requirements = serde_json::to_value(operation.security.as_ref()?).ok()?;
    let scopes = requirements.as_array()?.iter().find_map(|requirement| requirement.get(SCHEME))?;
    scopes.get(0)?.as_str()?.parse().ok()
}

/// Adds the scheme to the components of the document.
pub fn add_scheme(components: &mut Components) {
    let bearer = HttpBuilder::new().scheme(HttpAuthScheme::Bearer).description(Some(DESCRIPTION)).build();
    components.security_schemes.insert(SCHEME.to_owned(), SecurityScheme::Http(bearer).into());
}

/// Completes an operation: the scope of its method where it names none, and what is answered to those who lack it. The empty
/// alternative is that of a service without keys.
pub fn complete(operation: &mut Operation, is_read: bool) {
    let requirements = operation.security.get_or_insert_with(|| {
        let scope = scope_of_method(is_read).name();
        vec![SecurityRequirement::new(SCHEME, [scope]), SecurityRequirement::default()]
    });
    if requirements.iter().all(|requirement| *requirement == SecurityRequirement::default()) {
        return;
    }
    let refusals = [Unauthorized::responses(), MissingScope::responses(), TooManyRequests::responses()];
    for (status, refusal) in refusals.into_iter().flatten() {
        operation.responses.responses.entry(status).or_insert(refusal);
    }
}
