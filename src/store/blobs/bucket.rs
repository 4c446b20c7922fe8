//! Blobs in a bucket of an S3-compatible store, named `PREFIX/ab/abcd...`.
//!
//! Several of these stores let two conditional puts win. Nothing rests on that here: a blob has the hash of its bytes for a
//! name, so that writing it again writes the same, and what counts is the row that names it.

use std::time::{Duration, SystemTime};

use async_trait::async_trait;
use futures::TryStreamExt;
use object_store::aws::{AmazonS3, AmazonS3Builder};
use object_store::{BackoffConfig, ObjectMeta, ObjectStore, ObjectStoreExt, PutPayload, RetryConfig};

use super::reading::{length, location, read_whole};
use super::transport::Transport;
use super::{Blob, BlobId, Blobs};
use crate::store::StoreError;

/// How long a request is tried again before it fails: a job waits and is tried again then, a client gets 503. Few requests that
/// need blobs are worked on at the same time, so those behind wait as well.
const RETRY_TIMEOUT: Duration = Duration::from_secs(3);

/// Longest wait between two tries.
const LONGEST_WAIT: Duration = Duration::from_millis(500);

/// The bucket, and what the names of the blobs in it begin with.
#[derive(Debug)]
pub struct BucketBlobs {
    bucket: AmazonS3,
    prefix: String,
}

impl BucketBlobs {
    /// The blobs at `s3://BUCKET/PREFIX`. Keys, region and the address of the store are read from the environment
    /// (`AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY`, `AWS_REGION`, `AWS_ENDPOINT_URL`, `AWS_ALLOW_HTTP`, `AWS_CA_BUNDLE`).
    ///
    /// # Errors
    /// When something of that is missing or makes no sense.
    pub fn open(address: &str) -> Result<Self, StoreError> {
        let place = address.trim_start_matches("s3://");
        let (bucket, prefix) = place.split_once('/').unwrap_or((place, ""));
        let backoff = BackoffConfig { max_backoff: LONGEST_WAIT, ..BackoffConfig::default() };
        let retry = RetryConfig { retry_timeout: RETRY_TIMEOUT, max_retries: usize::MAX, backoff };
        let builder = AmazonS3Builder::from_env().with_bucket_name(bucket).with_retry(retry);
        let bucket = builder.with_http_connector(Transport::from_env()?).build()?;
        Ok(Self { bucket, prefix: prefix.to_owned() })
    }

    /// What lies below the prefix.
    async fn list(&self) -> Result<Vec<ObjectMeta>, StoreError> {
        let prefix = object_store::path::Path::from(self.prefix.as_str());
        Ok(self.bucket.list(Some(&prefix)).try_collect().await?)
    }
}

#[async_trait]
impl Blobs for BucketBlobs {
    async fn put(&self, blob: &Blob) -> Result<(), StoreError> {
        let payload = PutPayload::from_bytes(blob.bytes().clone());
        Ok(self.bucket.put(&location(&self.prefix, blob.id()), payload).await.map(drop)?)
    }

    async fn get(&self, id: &BlobId) -> Result<Blob, StoreError> {
        read_whole(&self.bucket, &location(&self.prefix, id), id).await
    }

    async fn length(&self, id: &BlobId) -> Result<Option<u64>, StoreError> {
        length(&self.bucket, &location(&self.prefix, id)).await
    }

    async fn remove(&self, id: &BlobId) -> Result<(), StoreError> {
        match self.bucket.delete(&location(&self.prefix, id)).await {
            Ok(()) | Err(object_store::Error::NotFound { .. }) => Ok(()),
            Err(error) => Err(error.into()),
        }
    }

    async fn older_than(&self, age: Duration) -> Result<Vec<BlobId>, StoreError> {
        let now = SystemTime::now();
        let is_old = |object: &ObjectMeta| {
            age.is_zero() || now.duration_since(object.last_modified.into()).is_ok_and(|elapsed| elapsed >= age)
        };
        let objects = self.list().await?;
        let old = objects.iter().filter(|object| is_old(object)).filter_map(|object| object.location.filename());
        let mut ids: Vec<BlobId> = old.filter_map(BlobId::find).collect();
        ids.sort_unstable();
        Ok(ids)
    }

    /// A put that is cut off leaves nothing.
    async fn remove_unfinished(&self, _: Duration) -> Result<(), StoreError> {
        Ok(())
    }
}
