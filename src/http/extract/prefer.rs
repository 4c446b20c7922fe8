//! What a client would like best (`Prefer`, RFC 7240).

use std::convert::Infallible;
use std::time::Duration;

use axum::extract::FromRequestParts;
use axum::http::HeaderMap;
use axum::http::request::Parts;

/// The preferences of a request. Those that nothing here knows are left out, as the standard has it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Prefer {
    /// To be answered before the work is done.
    pub is_async: bool,
    /// How long the answer may take, seconds.
    wait_s: Option<u64>,
}

impl Prefer {
    /// Reads the headers of a request.
    #[must_use]
    pub fn of(headers: &HeaderMap) -> Self {
        let values = headers.get_all("prefer").iter().filter_map(|value| value.to_str().ok());
        let mut prefer = Self::default();
        for preference in values.flat_map(|value| value.split([',', ';'])).map(str::trim) {
            match preference.split_once('=') {
                None if preference.eq_ignore_ascii_case("respond-async") => prefer.is_async = true,
                Some((name, value)) if name.trim().eq_ignore_ascii_case("wait") => {
                    prefer.wait_s = value.trim().trim_matches('"').parse().ok();
                }
                _ => {}
            }
        }
        prefer
    }

    /// How long work is waited for, at most `most`.
    #[must_use]
    pub fn patience(&self, most: Duration) -> Duration {
        match (self.wait_s, self.is_async) {
            (Some(seconds), _) => Duration::from_secs(seconds).min(most),
            (None, true) => Duration::ZERO,
            (None, false) => most,
        }
    }
}

impl<S: Sync> FromRequestParts<S> for Prefer {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        Ok(Self::of(&parts.headers))
    }
}

#[cfg(test)]
mod tests {
    use axum::http::HeaderValue;

    use super::*;

    #[test]
    fn preferences_tell_how_long_work_is_waited_for() {
        let most = Duration::from_secs(25);
        let patience = |value| {
            let headers = HeaderMap::from_iter([("prefer".parse().expect("a name"), HeaderValue::from_static(value))]);
            Prefer::of(&headers).patience(most).as_secs()
        };
        for (value, seconds) in [
            ("respond-async", 0),
            ("Respond-Async, wait=10", 10),
            ("wait=3", 3),
            ("wait=999", 25),
            ("respond-sync", 25),
        ] {
            assert_eq!(patience(value), seconds, "{value}");
        }
    }
}
