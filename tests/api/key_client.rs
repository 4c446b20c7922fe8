//! A service that needs keys, and keys for it.

use stillage::access::{ApiKey, KeySecret, Scope, Scopes};
use stillage::config::KeyRule;
use stillage::records::{KeyRecord, Tenant};
use stillage::store::{self, now};

use crate::client::Api;
use crate::document::Sent;

/// A service that needs keys.
pub async fn guarded() -> Api {
    Api::with(|config| config.keys = KeyRule::Required).await
}

/// Makes a key as `stillage key create` does, while the service runs.
pub async fn key(api: &Api, tenant: &str, scopes: impl IntoIterator<Item = Scope>) -> String {
    let (key, record) = new_key(tenant, scopes.into_iter().collect());
    store_key(api, &key, &record).await;
    key.reveal()
}

pub fn new_key(tenant: &str, scopes: Scopes) -> (ApiKey, KeyRecord) {
    let key = ApiKey::generate().expect("there are random bytes");
    let (id, tenant) = (key.id().to_owned(), Tenant::new(tenant));
    (key, KeyRecord { id, tenant, name: String::new(), scopes, created: now(), expires: None, revoked: None })
}

pub async fn store_key(api: &Api, key: &ApiKey, record: &KeyRecord) {
    let config = api.app.config();
    let secret = KeySecret::read_or_make(&config.key_secret_path().expect("it is known")).expect("it can be read");
    let keys = store::open_keys(&config.database).await.expect("beside the service");
    keys.create_key(record, &key.hash(&secret)).await.expect("it is stored");
}

pub fn with_key(sent: &Sent, key: &str) -> Sent {
    sent.clone().with("authorization", format!("Bearer {key}"))
}
