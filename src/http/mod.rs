//! The HTTP edge. (to be written)
use crate::app::App;
use std::sync::Arc;

/// The routes of the service.
#[must_use]
pub fn router(app: Arc<App>) -> axum::Router {
    let _ = app;
    todo!()
}
