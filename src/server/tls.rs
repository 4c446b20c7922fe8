//! TLS of the listener, with a certificate and its key from files in PEM.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::{self, PemObject as _};
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::rustls::{self, ServerConfig};

/// Why the files cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum TlsError {
    /// A file cannot be read.
    #[error("{}: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file holds something else.
    #[error("{} holds no {expected} in PEM (`-----BEGIN ...`)", .path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What it should hold.
        expected: &'static str,
    },
    /// The key is that of another certificate, or of a kind that is not known.
    #[error("the certificate and the key do not fit together: {0}")]
    Pair(#[source] rustls::Error),
}

/// Reads the certificate, with those of its authorities behind it, and its key. TLS 1.2 and 1.3 are spoken.
///
/// # Errors
/// Which file is wrong, and why.
pub fn acceptor(certificate: &Path, key: &Path) -> Result<TlsAcceptor, TlsError> {
    let certificates = CertificateDer::pem_file_iter(certificate).and_then(Iterator::collect);
    let certificates: Vec<_> = certificates.map_err(|error| wrong(certificate, "certificate", error))?;
    if certificates.is_empty() {
        return Err(TlsError::Content { path: certificate.to_owned(), expected: "certificate" });
    }
    let key = PrivateKeyDer::from_pem_file(key).map_err(|error| wrong(key, "private key", error))?;
    let config = ServerConfig::builder_with_provider(Arc::new(ring::default_provider()))
        .with_safe_default_protocol_versions()
        .map_err(TlsError::Pair)?;
    let mut config = config.with_no_client_auth().with_single_cert(certificates, key).map_err(TlsError::Pair)?;
    config.alpn_protocols = vec![b"http/1.1".to_vec()];
    Ok(TlsAcceptor::from(Arc::new(config)))
}

fn wrong(path: &Path, expected: &'static str, error: pem::Error) -> TlsError {
    let path = path.to_owned();
    match error {
        pem::Error::Io(source) => TlsError::File { path, source },
        _ => TlsError::Content { path, expected },
    }
}

#[cfg(test)]
mod tests {
    use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, duplex};
    use tokio_rustls::TlsConnector;
    use tokio_rustls::rustls::{ClientConfig, RootCertStore};

    use super::*;

    fn file(name: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("src/server").join(name)
    }

    #[tokio::test]
    async fn a_client_that_trusts_the_certificate_is_understood() {
        let (certificate, key) = (file("tls_test_certificate.pem"), file("tls_test_key.pem"));
        let acceptor = acceptor(&certificate, &key).expect("they fit");
        let mut roots = RootCertStore::empty();
        roots.add(CertificateDer::from_pem_file(&certificate).expect("a certificate")).expect("it can be trusted");
        let provider = Arc::new(ring::default_provider());
        let config = ClientConfig::builder_with_provider(provider).with_safe_default_protocol_versions();
        let config = config.expect("versions").with_root_certificates(roots).with_no_client_auth();
        let (near, far) = duplex(1 << 14);
        let server = tokio::spawn(async move {
            let mut stream = acceptor.accept(far).await.expect("a handshake");
            stream.write_all(b"hello").await.expect("it is written");
            stream.shutdown().await.expect("it ends");
        });
        let name = "localhost".try_into().expect("a name");
        let mut client = TlsConnector::from(Arc::new(config)).connect(name, near).await.expect("a handshake");
        let mut text = String::new();
        client.read_to_string(&mut text).await.expect("it is read");
        assert_eq!(text, "hello");
        server.await.expect("it ends");
    }

    #[test]
    fn what_cannot_be_used_is_named() {
        let (certificate, key) = (file("tls_test_certificate.pem"), file("tls_test_key.pem"));
        let refusal = |certificate: &Path, key: &Path| acceptor(certificate, key).err().expect("is wrong").to_string();
        assert!(refusal(&file("none.pem"), &key).contains("none.pem: No such file"));
        assert!(refusal(&key, &key).ends_with("tls_test_key.pem holds no certificate in PEM (`-----BEGIN ...`)"));
        assert!(refusal(&certificate, &certificate).contains("holds no private key in PEM"));
    }
}
