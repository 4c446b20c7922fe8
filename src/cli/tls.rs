//! TLS of the listener.

use std::path::PathBuf;

use crate::server::certificate::CertificateError;
use crate::server::tls::Tls;
use clap::Args;

/// TLS of the listener.
#[derive(Debug, Clone, Args)]
pub(super) struct TlsArgs {
    /// Certificate in PEM, with those of its authorities behind it: the service then speaks HTTPS. A new one is
    /// used within some ten seconds.
    #[arg(long, env = "STILLAGE_TLS_CERT", value_name = "FILE", requires = "tls_key")]
    tls_cert: Option<PathBuf>,
    /// Private key of the certificate in PEM.
    #[arg(long, env = "STILLAGE_TLS_KEY", value_name = "FILE", requires = "tls_cert")]
    tls_key: Option<PathBuf>,
}

impl TlsArgs {
    /// Whether the listener speaks TLS.
    pub(super) const fn is_given(&self) -> bool {
        self.tls_cert.is_some()
    }

    /// What speaks it.
    ///
    /// # Errors
    /// Which file is wrong, and why.
    pub(super) fn open(&self) -> Result<Option<Tls>, CertificateError> {
        let files = self.tls_cert.as_deref().zip(self.tls_key.as_deref());
        files.map(|(certificate, key)| Tls::open(certificate, key)).transpose()
    }
}
