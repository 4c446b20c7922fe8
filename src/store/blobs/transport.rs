//! Requests to an object store, through the HTTP client of the command line. Each takes a thread of the runtime's pool for
//! blocking work while it lasts: blobs are few and big.

use std::time::Duration;

use async_trait::async_trait;
use bytes::{Bytes, BytesMut};
use object_store::ClientOptions;
use object_store::client::{
    HttpClient, HttpConnector, HttpError, HttpErrorKind, HttpRequest, HttpRequestBody, HttpResponse, HttpService,
};
use ureq::tls::{PemItem, RootCerts, TlsConfig, parse_pem};

use crate::blocking::off_the_runtime;
use crate::store::StoreError;

/// Longest wait for a connection.
const CONNECT_TIMEOUT: Duration = Duration::from_secs(5);

/// Longest time of a request: the largest blobs have some hundred megabytes.
const TIMEOUT: Duration = Duration::from_mins(2);

/// Largest answer, bytes.
const MOST_BYTES: u64 = 4 << 30;

/// Names the file of the authorities whose certificates are believed, in place of those that browsers believe, as for the
/// programs of AWS (<https://docs.aws.amazon.com/sdkref/latest/guide/feature-gen-config.html>).
const AUTHORITIES: &str = "AWS_CA_BUNDLE";

/// Makes the client.
#[derive(Debug)]
pub struct Transport {
    authorities: RootCerts,
}

/// The client.
#[derive(Debug)]
struct Agent(ureq::Agent);

impl Transport {
    /// Requests as the environment wants them.
    ///
    /// # Errors
    /// [`StoreError::Authorities`] when the file of authorities cannot be read or holds none.
    pub fn from_env() -> Result<Self, StoreError> {
        let Some(path) = std::env::var_os(AUTHORITIES).filter(|path| !path.is_empty()) else {
            return Ok(Self { authorities: RootCerts::WebPki });
        };
        let refused = |reason| StoreError::Authorities { path: path.clone().into(), reason };
        let bytes = std::fs::read(&path).map_err(|error| refused(error.to_string()))?;
        Ok(Self { authorities: authorities(&bytes).map_err(refused)? })
    }
}

/// The certificates in a file in the PEM format.
fn authorities(pem: &[u8]) -> Result<RootCerts, String> {
    let mut certificates = Vec::new();
    for item in parse_pem(pem) {
        match item {
            Ok(PemItem::Certificate(certificate)) => certificates.push(certificate),
            Ok(_) => {}
            Err(_) => return Err("it is not in the PEM format".into()),
        }
    }
    if certificates.is_empty() {
        Err("it holds no certificate in the PEM format".into())
    } else {
        Ok(certificates.into())
    }
}

impl HttpConnector for Transport {
    fn connect(&self, _: &ClientOptions) -> object_store::Result<HttpClient> {
        let config = ureq::Agent::config_builder()
            .http_status_as_error(false)
            .tls_config(TlsConfig::builder().root_certs(self.authorities.clone()).build())
            .timeout_connect(Some(CONNECT_TIMEOUT))
            .timeout_global(Some(TIMEOUT))
            .max_redirects(0);
        Ok(HttpClient::new(Agent(config.build().new_agent())))
    }
}

#[async_trait]
impl HttpService for Agent {
    async fn call(&self, request: HttpRequest) -> Result<HttpResponse, HttpError> {
        let agent = self.0.clone();
        let (parts, body) = request.into_parts();
        let body = whole(body).await?;
        off_the_runtime(move || {
            // A body of no bytes is no body, so that a GET or DELETE has none.
            let answer = if body.is_empty() && parts.method != "PUT" && parts.method != "POST" {
                agent.run(ureq::http::Request::from_parts(parts, ()))
            } else {
                agent.run(ureq::http::Request::from_parts(parts, &body[..]))
            };
            let (head, mut body) = answer.map_err(failed)?.into_parts();
            let bytes = body.with_config().limit(MOST_BYTES).read_to_vec().map_err(failed)?;
            Ok(HttpResponse::from_parts(head, Bytes::from(bytes).into()))
        })
        .await
    }
}

/// The bytes of a request.
async fn whole(mut body: HttpRequestBody) -> Result<Bytes, HttpError> {
    use axum::body::HttpBody as _;
    if let Some(bytes) = body.as_bytes() {
        return Ok(bytes.clone());
    }
    let mut bytes = BytesMut::with_capacity(body.content_length());
    while let Some(frame) = std::future::poll_fn(|context| std::pin::Pin::new(&mut body).poll_frame(context)).await {
        if let Ok(data) = frame?.into_data() {
            bytes.extend_from_slice(&data);
        }
    }
    Ok(bytes.freeze())
}

/// What went wrong, in the words by which the store's driver tries again.
fn failed(error: ureq::Error) -> HttpError {
    let kind = match &error {
        ureq::Error::Timeout(_) => HttpErrorKind::Timeout,
        ureq::Error::ConnectionFailed | ureq::Error::HostNotFound => HttpErrorKind::Connect,
        ureq::Error::Io(fault) if fault.kind() == std::io::ErrorKind::ConnectionRefused => HttpErrorKind::Connect,
        ureq::Error::Io(_) | ureq::Error::Protocol(_) => HttpErrorKind::Interrupted,
        _ => HttpErrorKind::Unknown,
    };
    HttpError::new(kind, error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_without_a_certificate_is_refused() {
        let key = "-----BEGIN PRIVATE KEY-----\nAAAA\n-----END PRIVATE KEY-----\n";
        for text in ["", "no certificate", key] {
            let refusal = authorities(text.as_bytes()).expect_err("there is none");
            assert_eq!(refusal, "it holds no certificate in the PEM format");
        }
        let certificate = "-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n";
        assert!(matches!(authorities(certificate.as_bytes()), Ok(RootCerts::Specific(all)) if all.len() == 1));
    }
}
