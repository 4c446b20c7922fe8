//! Where a deployment keeps its rows and its blobs, as people write it.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Where the rows are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DatabaseAddress {
    /// SQLite in a data folder: `sqlite:FOLDER`.
    Sqlite(PathBuf),
    /// A PostgreSQL server: `postgres://USER:PASSWORD@HOST:PORT/DATABASE`.
    #[cfg(feature = "postgres")]
    Postgres(String),
}

/// Where the blobs are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BlobAddress {
    /// Files below a folder: `file:///FOLDER`.
    Folder(PathBuf),
    /// A bucket of an S3-compatible store, and what the names in it begin with: `s3://BUCKET/PREFIX`.
    #[cfg(feature = "s3")]
    Bucket(String),
}

impl DatabaseAddress {
    /// Whether several processes may use it at the same time.
    #[must_use]
    pub const fn is_shared(&self) -> bool {
        !matches!(self, Self::Sqlite(_))
    }

    /// Its folder on this machine, if it has one.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        match self {
            Self::Sqlite(folder) => Some(folder),
            #[cfg(feature = "postgres")]
            Self::Postgres(_) => None,
        }
    }
}

impl BlobAddress {
    /// Their folder on this machine, if they have one.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        match self {
            Self::Folder(folder) => Some(folder),
            #[cfg(feature = "s3")]
            Self::Bucket(_) => None,
        }
    }
}

impl FromStr for DatabaseAddress {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(folder) = text.strip_prefix("sqlite:").map(|folder| folder.trim_start_matches("//")) {
            return if folder.is_empty() {
                Err("sqlite: needs a folder: sqlite:FOLDER".into())
            } else {
                Ok(Self::Sqlite(folder.into()))
            };
        }
        if text.starts_with("postgres://") || text.starts_with("postgresql://") {
            #[cfg(feature = "postgres")]
            return Ok(Self::Postgres(text.to_owned()));
            #[cfg(not(feature = "postgres"))]
            return Err("this program was built without PostgreSQL: build it with the feature postgres".into());
        }
        Err("a database is sqlite:FOLDER or postgres://USER:PASSWORD@HOST:PORT/DATABASE".into())
    }
}

impl FromStr for BlobAddress {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(folder) = text.strip_prefix("file://") {
            return if folder.starts_with('/') {
                Ok(Self::Folder(folder.into()))
            } else {
                Err("file:// needs a whole path: file:///FOLDER".into())
            };
        }
        if text.starts_with("s3://") {
            #[cfg(feature = "s3")]
            return Ok(Self::Bucket(text.to_owned()));
            #[cfg(not(feature = "s3"))]
            return Err("this program was built without S3: build it with the feature s3".into());
        }
        Err("blobs are at file:///FOLDER or s3://BUCKET/PREFIX".into())
    }
}

impl fmt::Display for DatabaseAddress {
    /// Without a password.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sqlite(folder) => write!(formatter, "sqlite:{}", folder.display()),
            #[cfg(feature = "postgres")]
            Self::Postgres(address) => match address.rsplit_once('@') {
                Some((_, place)) => write!(formatter, "postgres://{}", place.split('?').next().unwrap_or_default()),
                None => formatter.write_str(address.split('?').next().unwrap_or_default()),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_and_others_say_what_is_wanted() {
        let sqlite = DatabaseAddress::Sqlite("data".into());
        assert_eq!("sqlite:data".parse(), Ok(sqlite.clone()));
        assert_eq!("sqlite://data".parse(), Ok(sqlite));
        assert_eq!("file:///data/blobs".parse(), Ok(BlobAddress::Folder("/data/blobs".into())));
        let refusals =
            ["mysql://host/name", "sqlite:"].map(|text| text.parse::<DatabaseAddress>().expect_err("no database"));
        assert!(refusals.iter().all(|refusal| refusal.contains("sqlite:FOLDER")), "{refusals:?}");
        let refusals = ["file://data", "ftp://host"].map(|text| text.parse::<BlobAddress>().expect_err("no blobs"));
        assert!(refusals.iter().all(|refusal| refusal.contains("file:///FOLDER")), "{refusals:?}");
    }

    #[cfg(feature = "postgres")]
    #[test]
    fn a_password_is_not_shown() {
        let address: DatabaseAddress = "postgres://me:secret@host:5432/maps?sslpassword=x".parse().expect("an address");
        assert_eq!(address.to_string(), "postgres://host:5432/maps");
    }
}
