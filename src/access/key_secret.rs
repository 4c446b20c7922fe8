//! What turns a key into the hash that is stored. Who can write into the database alone cannot make a key with it.

use std::fmt;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::random::random_digits;

/// The name of its file in a data folder.
pub const KEY_SECRET_FILE: &str = "key-secret";

/// Length of the secret, bytes: what keyed blake3 takes.
const BYTES: usize = 32;

/// The key of the hash.
#[derive(Clone, PartialEq, Eq)]
pub struct KeySecret([u8; BYTES]);

/// Why the file of the secret cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum KeySecretError {
    /// It is missing, or cannot be read or written.
    #[error("{}, the secret that API keys are hashed with: {source}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Nobody said where it is.
    #[error(
        "a database that processes share needs --key-secret-file FILE, the same file for all of them; `stillage key create` makes it"
    )]
    NotNamed,
    /// It holds something else.
    #[error("{} holds no secret that API keys are hashed with: it is one line of 64 hexadecimal digits", .0.display())]
    Content(PathBuf),
}

impl KeySecret {
    /// A secret of these bytes.
    #[must_use]
    pub const fn of(bytes: [u8; BYTES]) -> Self {
        Self(bytes)
    }

    pub(super) const fn bytes(&self) -> &[u8; BYTES] {
        &self.0
    }

    /// Reads the secret from its file.
    ///
    /// # Errors
    /// When the file is not there or holds something else.
    pub fn read(path: &Path) -> Result<Self, KeySecretError> {
        let failed = |source| KeySecretError::File { path: path.to_owned(), source };
        let text = std::fs::read_to_string(path).map_err(failed)?;
        // A hash of blake3 is as long as its key.
        let bytes = blake3::Hash::from_hex(text.trim()).map_err(|_| KeySecretError::Content(path.to_owned()))?;
        Ok(Self(*bytes.as_bytes()))
    }

    /// Reads the secret from its file, which is made where it is missing, readable for its owner alone. Of several processes
    /// that make it at once, one does.
    ///
    /// # Errors
    /// When the file cannot be read or made, or holds something else.
    pub fn read_or_make(path: &Path) -> Result<Self, KeySecretError> {
        let failed = |source| KeySecretError::File { path: path.to_owned(), source };
        if !path.try_exists().map_err(failed)? {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
            // Files of this kind are for their owner alone.
            let mut file = tempfile::NamedTempFile::new_in(folder).map_err(failed)?;
            let digits = random_digits(BYTES).map_err(failed)?;
            writeln!(file, "{digits}").and_then(|()| file.as_file().sync_all()).map_err(failed)?;
            match file.persist_noclobber(path) {
                Err(error) if error.error.kind() != io::ErrorKind::AlreadyExists => return Err(failed(error.error)),
                _ => {}
            }
        }
        Self::read(path)
    }
}

impl fmt::Debug for KeySecret {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("KeySecret(..)")
    }
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::PermissionsExt as _;

    use super::*;

    #[test]
    fn it_is_made_once_for_its_owner_alone_and_then_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("key-secret");
        assert!(KeySecret::read(&path).expect_err("it is missing").to_string().contains("key-secret"));
        let made = KeySecret::read_or_make(&path).expect("it is made");
        assert_eq!(KeySecret::read_or_make(&path).expect("it is there"), made);
        assert_eq!(std::fs::metadata(&path).expect("a file").permissions().mode() & 0o777, 0o600);
        std::fs::write(&path, "secret").expect("it can be written");
        assert!(KeySecret::read(&path).expect_err("is no secret").to_string().contains("64 hexadecimal digits"));
    }
}
