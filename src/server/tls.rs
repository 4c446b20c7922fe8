//! TLS of the listener: 1.2 and 1.3, with a certificate and its key from files in PEM.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::ServerConfig;
use tokio_rustls::rustls::crypto::ring;

use super::certificate::{Certificate, CertificateError};
use crate::blocking::off_the_runtime;

/// How often the files are looked at: two reads of some kilobytes.
pub(super) const RENEWAL_PERIOD: Duration = Duration::from_secs(10);

/// What speaks TLS.
#[derive(Debug)]
pub struct Tls {
    certificate: Arc<Certificate>,
    config: Arc<ServerConfig>,
}

impl Tls {
    /// Reads the certificate, with those of its authorities behind it, and its key.
    ///
    /// # Errors
    /// Which file is wrong, and why.
    pub fn open(certificate: &Path, key: &Path) -> Result<Self, CertificateError> {
        let certificate = Arc::new(Certificate::read(certificate, key)?);
        let config = ServerConfig::builder_with_provider(Arc::new(ring::default_provider()))
            .with_safe_default_protocol_versions()?;
        let mut config = config.with_no_client_auth().with_cert_resolver(Arc::<Certificate>::clone(&certificate));
        config.alpn_protocols = vec![b"http/1.1".to_vec()];
        Ok(Self { certificate, config: Arc::new(config) })
    }

    /// Makes handshakes, with the certificate that is in use at the time.
    pub(super) fn acceptor(&self) -> TlsAcceptor {
        TlsAcceptor::from(Arc::clone(&self.config))
    }

    /// Looks at the files again and again, and takes a new certificate in use. Never returns.
    pub(super) async fn renew(self, period: Duration) {
        loop {
            tokio::time::sleep(period).await;
            let certificate = Arc::clone(&self.certificate);
            off_the_runtime(move || certificate.look_again()).await;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io;
    use std::path::PathBuf;
    use std::time::Instant;

    use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, duplex};
    use tokio_rustls::TlsConnector;
    use tokio_rustls::rustls::pki_types::CertificateDer;
    use tokio_rustls::rustls::pki_types::pem::PemObject as _;
    use tokio_rustls::rustls::{ClientConfig, RootCertStore};

    use super::*;

    /// How long a new certificate may take that is looked for every 5 ms, on a busy machine.
    const PATIENCE: Duration = Duration::from_secs(20);

    fn file(name: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("src/server").join(name)
    }

    /// What a client that trusts a certificate reads.
    async fn said_to_who_trusts(certificate: &str, acceptor: TlsAcceptor) -> io::Result<String> {
        let mut roots = RootCertStore::empty();
        roots.add(CertificateDer::from_pem_file(file(certificate)).expect("a certificate")).expect("it can be trusted");
        let provider = Arc::new(ring::default_provider());
        let config = ClientConfig::builder_with_provider(provider).with_safe_default_protocol_versions();
        let config = config.expect("versions").with_root_certificates(roots).with_no_client_auth();
        let (near, far) = duplex(1 << 14);
        let server = tokio::spawn(async move {
            let mut stream = acceptor.accept(far).await?;
            stream.write_all(b"hello").await?;
            stream.shutdown().await
        });
        let name = "localhost".try_into().expect("a name");
        let mut client = TlsConnector::from(Arc::new(config)).connect(name, near).await?;
        let mut text = String::new();
        client.read_to_string(&mut text).await?;
        server.await.expect("it ends")?;
        Ok(text)
    }

    #[tokio::test]
    async fn a_client_that_trusts_the_certificate_is_understood() {
        let tls = Tls::open(&file("tls_test_certificate.pem"), &file("tls_test_key.pem")).expect("they fit");
        let said = said_to_who_trusts("tls_test_certificate.pem", tls.acceptor()).await;
        assert_eq!(said.expect("a handshake"), "hello");
        assert!(said_to_who_trusts("tls_test_next_certificate.pem", tls.acceptor()).await.is_err());
    }

    #[tokio::test]
    async fn a_new_certificate_is_used_without_a_restart_and_a_broken_one_is_not() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let place = |name: &str| folder.path().join(name);
        let copy = |from: &str, to: &str| std::fs::copy(file(from), place(to)).expect("it can be copied");
        copy("tls_test_certificate.pem", "certificate.pem");
        copy("tls_test_key.pem", "key.pem");
        let tls = Tls::open(&place("certificate.pem"), &place("key.pem")).expect("they fit");
        let acceptor = tls.acceptor();
        let (old, new) = ("tls_test_certificate.pem", "tls_test_next_certificate.pem");
        let is_used = async |certificate: &str| said_to_who_trusts(certificate, acceptor.clone()).await.is_ok();
        let look = Arc::clone(&tls.certificate);
        for broken in ["-----BEGIN", ""] {
            std::fs::write(place("key.pem"), broken).expect("it can be written");
            look.look_again();
            assert!(is_used(old).await, "the key is {broken:?}");
        }
        copy(new, "certificate.pem");
        copy("tls_test_key.pem", "key.pem");
        look.look_again();
        assert!(is_used(old).await && !is_used(new).await, "they do not fit together");

        let renewal = tokio::spawn(tls.renew(Duration::from_millis(5)));
        copy("tls_test_next_key.pem", "key.pem");
        let begun = Instant::now();
        while !is_used(new).await {
            assert!(begun.elapsed() < PATIENCE, "the new certificate is not used");
        }
        assert!(!is_used(old).await);
        renewal.abort();
    }

    #[test]
    fn what_cannot_be_used_is_named() {
        let (certificate, key) = (file("tls_test_certificate.pem"), file("tls_test_key.pem"));
        let refusal = |certificate: &Path, key: &Path| Tls::open(certificate, key).expect_err("is wrong").to_string();
        assert!(refusal(&file("none.pem"), &key).contains("none.pem: No such file"));
        assert!(refusal(&key, &key).ends_with("tls_test_key.pem holds no certificate in PEM (`-----BEGIN ...`)"));
        assert!(refusal(&certificate, &certificate).contains("holds no private key in PEM"));
        assert!(refusal(&certificate, &file("tls_test_next_key.pem")).contains("do not fit together"));
    }
}
