//! The certificate of the listener and its key, from files that may change while it listens.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError, RwLock};

use tokio_rustls::rustls;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::{self, PemObject};
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::rustls::server::{ClientHello, ResolvesServerCert};
use tokio_rustls::rustls::sign::CertifiedKey;

/// Why the files cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CertificateError {
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
    Pair(#[from] rustls::Error),
}

/// The certificate with those of its authorities behind it, and its key: what handshakes are made with.
pub(super) struct Certificate {
    certificate: PathBuf,
    key: PathBuf,
    in_use: RwLock<Arc<CertifiedKey>>,
    /// What the files held when they were looked at last.
    seen: Mutex<String>,
}

impl Certificate {
    /// Reads the files for the first time.
    pub(super) fn read(certificate: &Path, key: &Path) -> Result<Self, CertificateError> {
        let (seen, pair) = look(certificate, key);
        let (certificate, key) = (certificate.to_owned(), key.to_owned());
        Ok(Self { certificate, key, in_use: RwLock::new(Arc::new(pair?)), seen: Mutex::new(seen) })
    }

    /// Looks at the files again. A pair that is new and can be used is used for the next handshakes; one that cannot is told
    /// once, and the old one stays.
    pub(super) fn look_again(&self) {
        let (seen, pair) = look(&self.certificate, &self.key);
        let before = std::mem::replace(&mut *self.seen.lock().unwrap_or_else(PoisonError::into_inner), seen.clone());
        if before == seen {
            return;
        }
        match pair {
            Ok(pair) => {
                *self.in_use.write().unwrap_or_else(PoisonError::into_inner) = Arc::new(pair);
                tracing::info!(file = %self.certificate.display(), "a new certificate is in use");
            }
            Err(error) => tracing::warn!(%error, "the new certificate cannot be used: the one before stays in use"),
        }
    }
}

impl ResolvesServerCert for Certificate {
    fn resolve(&self, _: ClientHello<'_>) -> Option<Arc<CertifiedKey>> {
        Some(Arc::clone(&self.in_use.read().unwrap_or_else(PoisonError::into_inner)))
    }
}

impl fmt::Debug for Certificate {
    /// Without the key.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Certificate").field("certificate", &self.certificate).finish_non_exhaustive()
    }
}

/// What the files hold, as a text that changes with it, and as a pair.
fn look(certificate: &Path, key: &Path) -> (String, Result<CertifiedKey, CertificateError>) {
    let read =
        |path: &Path| std::fs::read(path).map_err(|source| CertificateError::File { path: path.to_owned(), source });
    match read(certificate).and_then(|chain| Ok((chain, read(key)?))) {
        Ok((chain, secret)) => {
            let seen = format!("{} {}", blake3::hash(&chain), blake3::hash(&secret));
            (seen, pair(&chain, certificate, &secret, key))
        }
        Err(error) => (error.to_string(), Err(error)),
    }
}

fn pair(chain: &[u8], certificate: &Path, secret: &[u8], key: &Path) -> Result<CertifiedKey, CertificateError> {
    let wrong = |path: &Path, expected| CertificateError::Content { path: path.to_owned(), expected };
    let chain: Result<Vec<_>, pem::Error> = CertificateDer::pem_slice_iter(chain).collect();
    let chain = chain.ok().filter(|chain| !chain.is_empty()).ok_or_else(|| wrong(certificate, "certificate"))?;
    let secret = PrivateKeyDer::from_pem_slice(secret).map_err(|_| wrong(key, "private key"))?;
    Ok(CertifiedKey::from_der(chain, secret, &ring::default_provider())?)
}
