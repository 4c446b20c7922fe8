//! The HTTP edge: one list of routes, one file per resource.
//!
//! Handlers are thin: typed extractors, one call into [`crate::app`], one conversion out. What holds for every request
//! lies around them (see [`router`]), and every refusal leaves as a problem detail ([`problem`]). The OpenAPI document
//! is collected from the same list of routes.

#![allow(unused_qualifications, reason = "the macro of utoipa repeats the types of arguments")]

mod admin;
mod answers;
mod client_address;
mod dashboard;
mod docs;
mod extract;
pub(crate) mod fleet;
mod guard;
pub(crate) mod links;
pub(crate) mod maps;
mod ogc;
mod page;
mod paging;
pub(crate) mod problem;
mod public_address;
mod shared_service;

use std::sync::Arc;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::http::{HeaderName, HeaderValue, header};
use axum::middleware::{from_fn, from_fn_with_state};
use axum::{Extension, extract::Request, middleware::Next, response::Response};
use tower::{ServiceBuilder, util::MapRequest};
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

pub use client_address::ClientAddress;
pub use docs::Texts as OpenApiTexts;

use crate::app::App;
use crate::config::{Config, Role};
use crate::measures::Measures;

/// Bytes that a body may have where nothing else is said: overrides for a hundred thousand faces.
const BODY_BYTES: usize = 8 << 20;

/// The list of routes.
///
/// What holds for one route only stands at the route: the length of its body, the time for its answer and how much it
/// computes here, the refusals it can answer and its headers at its handler. The document is made from both.
fn routes(config: &Config, measures: &Measures) -> OpenApiRouter<Arc<App>> {
    let upload_bytes = config.limits.max_bytes + maps::upload::FORM_OVERHEAD_BYTES;
    let entrances = guard::admission::Entrances::new(config, BODY_BYTES, upload_bytes, measures);
    let admit = |entrance| from_fn_with_state(entrance, guard::admission::admit);
    // The length of their bodies is checked at the entrance. No clock runs for their answers, which may wait for a job.
    let uploads = OpenApiRouter::new()
        .routes(routes!(maps::map::create))
        .routes(routes!(ogc::processes::execute))
        .layer(DefaultBodyLimit::disable())
        .layer(admit(entrances.uploads));
    let heavy = computing().layer(from_fn(guard::in_time)).layer(admit(entrances.heavy));
    let light = reading_and_writing().layer(from_fn(guard::in_time)).layer(admit(entrances.light));
    OpenApiRouter::with_openapi(docs::openapi::head())
        .merge(about_the_service().layer(from_fn(guard::in_time)))
        .merge(light)
        .merge(heavy)
        .merge(uploads)
}

/// The routes that are answered however much there is to do.
fn about_the_service() -> OpenApiRouter<Arc<App>> {
    OpenApiRouter::new()
        .routes(routes!(docs::landing))
        .routes(routes!(admin::health::live))
        .routes(routes!(admin::health::ready))
        .routes(routes!(guard::observe::metrics))
}

/// The routes whose answers are computed: each keeps a core busy for milliseconds to seconds.
fn computing() -> OpenApiRouter<Arc<App>> {
    OpenApiRouter::new()
        .routes(routes!(maps::analyses::faces))
        .routes(routes!(maps::evaluations::create))
        .routes(routes!(maps::comparisons::compare))
        .routes(routes!(maps::comparisons::of_analysis))
        .routes(routes!(maps::comparisons::changes))
        .routes(routes!(maps::pictures::image))
        .routes(routes!(maps::pictures::categories))
        .routes(routes!(maps::pictures::regions))
        .routes(routes!(maps::pictures::semantic))
        .routes(routes!(maps::pictures::semantic_svg))
        .routes(routes!(maps::label_preview::create))
        .routes(routes!(maps::version_changes::list))
        .routes(routes!(fleet::route::get))
        .routes(routes!(fleet::distance_matrix::create))
        .routes(routes!(fleet::exports::get))
        .routes(routes!(fleet::graph_report::get))
        .routes(routes!(fleet::graph_report::picture))
}

/// All other routes.
fn reading_and_writing() -> OpenApiRouter<Arc<App>> {
    OpenApiRouter::new()
        .route(dashboard::ASSET_PATH, axum::routing::get(dashboard::asset))
        .routes(routes!(docs::openapi))
        .routes(routes!(docs::openapi_3_0))
        .routes(routes!(docs::problem_types::describe))
        .routes(routes!(admin::audit::list))
        .routes(routes!(admin::session::sign_in, admin::session::sign_out))
        .routes(routes!(maps::map::list))
        .routes(routes!(maps::map::get, maps::map::update, maps::deletion::delete))
        .routes(routes!(maps::deletion::list))
        .routes(routes!(maps::deletion::restore))
        .routes(routes!(maps::analyses::list, maps::analyses::create))
        .routes(routes!(maps::analyses::get))
        .routes(routes!(maps::analyses::activate))
        .routes(routes!(maps::analyses::diagnostics))
        .routes(routes!(maps::registry::get))
        .routes(routes!(maps::registry::confirm))
        .routes(routes!(maps::names::create))
        .routes(routes!(maps::semantics::categories))
        .routes(routes!(maps::semantics::get, maps::semantics::assign, maps::semantics::change))
        .routes(routes!(maps::semantics::versions))
        .routes(routes!(maps::semantics::version))
        .routes(routes!(maps::semantics::restore))
        .routes(routes!(maps::history::undo))
        .routes(routes!(maps::history::redo))
        .routes(routes!(maps::corrections::list, maps::corrections::create))
        .routes(routes!(maps::corrections::get, maps::corrections::change, maps::corrections::delete))
        .routes(routes!(docs::map_api))
        .routes(routes!(ogc::conformance::get))
        .routes(routes!(ogc::collections::list))
        .routes(routes!(ogc::collections::get))
        .routes(routes!(ogc::queryables::queryables))
        .routes(routes!(ogc::queryables::schema))
        .routes(routes!(ogc::items::list, ogc::item_writes::add))
        .routes(routes!(ogc::items::get, ogc::item_writes::update, ogc::item_writes::replace))
        .route(
            "/v1/maps/{mapId}/collections/{collectionId}/items",
            axum::routing::options(ogc::item_writes::options_of_all),
        )
        .route(
            "/v1/maps/{mapId}/collections/{collectionId}/items/{featureId}",
            axum::routing::options(ogc::item_writes::options),
        )
        .routes(routes!(fleet::at::get))
        .routes(routes!(fleet::nearest::get))
        .routes(routes!(fleet::exports::list))
        .routes(routes!(ogc::root::landing))
        .routes(routes!(ogc::root::conformance))
        .routes(routes!(ogc::processes::list))
        .routes(routes!(ogc::processes::get))
        .routes(routes!(ogc::processes::of_job))
        .routes(routes!(ogc::jobs::list))
        .routes(routes!(ogc::jobs::get, ogc::jobs::dismiss))
        .routes(routes!(ogc::jobs::retry))
        .routes(routes!(ogc::job_events::events))
        .routes(routes!(maps::rule_sets::list, maps::rule_sets::create))
        .routes(routes!(maps::cogency_matrix::get))
        .routes(routes!(maps::rule_sets::get, maps::rule_sets::replace, maps::rule_sets::delete))
}

/// The OpenAPI documents of the service, as they are served and as they lie in `openapi/`.
#[must_use]
pub fn openapi_texts() -> OpenApiTexts {
    OpenApiTexts::of(&docs::openapi::value(&document(routes(&Config::new("data"), &Measures::new())).1))
}

fn document<S: Clone + Send + Sync + 'static>(routes: OpenApiRouter<S>) -> (Router<S>, utoipa::openapi::OpenApi) {
    let (router, mut document) = routes.split_for_parts();
    docs::openapi::complete(&mut document);
    (router, document)
}

/// The routes of the service, with all that lies around them.
///
/// From the outside in: id, log line and metrics of the request; who sends it; answers that are given again; the last slash of the address;
/// its route; headers for browsers; entity tags by coding, around the compression; the address that proxies tell; bodies of
/// problems; what a deleted map answers; panics; checks of host, origin and scope; pace and coding of bodies; formats; unknown
/// parameters; `Accept`. Around each group of routes lies its entrance, which receives bodies and bounds what is under way, and
/// the clock of its answers.
pub fn router(app: Arc<App>) -> Router {
    if app.config().role == Role::Worker { of_worker(app) } else { of_service(app) }
}

/// The routes of a process that works on jobs: its health and its metrics.
fn of_worker(app: Arc<App>) -> Router {
    let measures = Arc::new(guard::observe::RequestMeasures::new(Arc::clone(app.measures())));
    let guard = guard::access::AccessGuard::new(Arc::clone(&app), &document(routes(app.config(), app.measures())).1);
    let sign_in = guard::sign_in::SignIn::new(Arc::clone(&app));
    Router::new()
        .route("/health/live", axum::routing::get(admin::health::live))
        .route("/health/ready", axum::routing::get(admin::health::ready))
        .route("/metrics", axum::routing::get(guard::observe::metrics))
        .layer(from_fn_with_state(guard, guard::access::allowed))
        .layer(from_fn(guard::observe::tell_route))
        .layer(from_fn(problem::render))
        .layer(from_fn_with_state(sign_in, guard::sign_in::sign_in))
        .layer(from_fn_with_state(measures, guard::observe::observe))
        .with_state(app)
}

fn of_service(app: Arc<App>) -> Router {
    let (router, document) = document(routes(app.config(), app.measures()));
    let known = Arc::new(guard::KnownParameters::of(&document));
    let guard = guard::access::AccessGuard::new(Arc::clone(&app), &document);
    let Config { trust_proxy, is_tls, .. } = *app.config();
    let listener = public_address::Listener { trust_proxy, is_tls };
    let measures = Arc::new(guard::observe::RequestMeasures::new(Arc::clone(app.measures())));
    let layers = ServiceBuilder::new()
        .layer(from_fn(guard::observe::tell_route))
        .layer(from_fn(browser_headers))
        .layer(from_fn(extract::conditional::tag_encodings))
        .layer(CompressionLayer::new())
        .layer(from_fn_with_state(listener, public_address::resolve))
        .layer(from_fn(problem::render))
        .layer(from_fn_with_state(Arc::clone(&app), maps::deletion::tell_restorable))
        .layer_fn(shared_service::SharedService::new)
        .layer(CatchPanicLayer::custom(problem::of_panic))
        .layer(from_fn(guard::hosts::one_host))
        .layer(from_fn_with_state(Arc::clone(&app), guard::hosts::own_host))
        .layer(from_fn(guard::other_origins))
        .layer(from_fn_with_state(guard, guard::access::allowed))
        .layer(from_fn(guard::pace::at_pace))
        .layer(from_fn(extract::coding::decoded))
        .layer(from_fn(extract::format::format_parameter))
        .layer(from_fn_with_state(known, guard::known_parameters))
        .layer(from_fn(extract::negotiation::negotiate))
        .layer(DefaultBodyLimit::max(BODY_BYTES))
        .layer(Extension(ogc::event_streams::EventStreams::new(app.config())))
        .layer(Extension(Arc::new(docs::Documents::of(&docs::openapi::value(&document)))))
        .layer_fn(shared_service::SharedService::new);
    let router = router.merge(docs::reference_page()).layer(layers).with_state(Arc::clone(&app));
    // Addresses are mended before they are looked up in the list of routes.
    let router = MapRequest::new(router, guard::without_last_slash as fn(Request) -> Request);
    Router::new()
        .fallback_service(router)
        .layer(from_fn_with_state(answers::Again::new(Arc::clone(&app)), answers::again))
        .layer(from_fn_with_state(guard::sign_in::SignIn::new(app), guard::sign_in::sign_in))
        .layer(from_fn_with_state(measures, guard::observe::observe))
}

/// Middleware: nothing is sniffed, framed or loaded from elsewhere.
async fn browser_headers(request: Request, next: Next) -> Response {
    let mut response = next.run(request).await;
    // The styles and icons that swagger-ui writes into its page. The dashboard has a stricter policy of its own.
    let policy = "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; frame-ancestors 'none'";
    let headers = response.headers_mut();
    headers.entry(header::CONTENT_SECURITY_POLICY).or_insert(HeaderValue::from_static(policy));
    headers.extend([
        (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
        (HeaderName::from_static("cross-origin-resource-policy"), HeaderValue::from_static("cross-origin")),
        (header::REFERRER_POLICY, HeaderValue::from_static("no-referrer")),
    ]);
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_documents_in_the_repository_are_those_of_the_code() {
        // `UPDATE_EXPECT=1 cargo test`, or `stillage openapi --write`, writes them anew.
        let texts = openapi_texts();
        expect_test::expect_file!["../../openapi/openapi.json"].assert_eq(&texts.version_3_1);
        expect_test::expect_file!["../../openapi/openapi-3.0.json"].assert_eq(&texts.version_3_0);
        expect_test::expect_file!["../../openapi/map-3.0.json"].assert_eq(&texts.of_map);
    }
}
