//! A running service, as commands ask it in place of a map file.

use std::time::Duration;

use serde::Deserialize;

use super::failure::Failure;
use crate::http::links::encode;

/// Longest wait for an answer: a large map that nobody asked about before is read first.
const TIMEOUT: Duration = Duration::from_mins(2);
/// Largest answer, bytes: a bundle of a large map has some ten million.
const MOST_BYTES: u64 = 1 << 30;

/// What of a problem detail (RFC 9457) is told to people.
#[derive(Deserialize)]
struct ProblemText {
    #[serde(default)]
    title: String,
    #[serde(default)]
    detail: String,
}

/// The answer to a question about a map of a service; `map` is its address, `http://localhost:8080/v1/maps/ID`.
pub(super) fn get(map: &str, path: &str, query: &[(String, String)]) -> Result<Vec<u8>, Failure> {
    let query: Vec<String> = query.iter().map(|(name, value)| format!("{}={}", encode(name), encode(value))).collect();
    let mark = if query.is_empty() { "" } else { "?" };
    let address = format!("{}/{path}{mark}{}", map.trim_end_matches('/'), query.join("&"));
    let configuration = ureq::Agent::config_builder().http_status_as_error(false).timeout_global(Some(TIMEOUT));
    let agent = ureq::Agent::new_with_config(configuration.build());
    let unreachable = |error: ureq::Error| {
        Failure::Input(format!("{address} cannot be reached ({error}): is it http://HOST:PORT/v1/maps/ID?"))
    };
    let mut response = agent.get(&address).call().map_err(unreachable)?;
    let is_success = response.status().is_success();
    let body = response.body_mut().with_config().limit(MOST_BYTES).read_to_vec().map_err(unreachable)?;
    if is_success {
        return Ok(body);
    }
    let status = response.status();
    Err(Failure::Input(match serde_json::from_slice::<ProblemText>(&body) {
        Ok(problem) if !problem.detail.is_empty() => problem.detail,
        Ok(problem) if !problem.title.is_empty() => problem.title,
        _ => format!("{address} answers {status}: is it the address of a map, http://HOST:PORT/v1/maps/ID?"),
    }))
}
