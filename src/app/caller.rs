//! Who asks.

use jiff::Timestamp;

use crate::access::{Scope, Scopes, TokenBearer};
use crate::records::{KeyRecord, Tenant};

/// Who asks for a use case. Everything is read and written for the caller's tenant: what belongs to another one is not
/// found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Caller {
    tenant: Tenant,
    scopes: Scopes,
    name: String,
    /// The id of the key, where it is one.
    key: Option<String>,
    /// When it is nobody any more.
    end: Option<Timestamp>,
}

impl Caller {
    /// The operator of a service without keys: whoever reaches it.
    #[must_use]
    pub fn local() -> Self {
        Self::of(Tenant::local())
    }

    /// Somebody who may do everything for this tenant.
    #[must_use]
    pub fn of(tenant: Tenant) -> Self {
        Self { name: tenant.to_string(), tenant, scopes: Scopes::all(), key: None, end: None }
    }

    /// Whoever has this key.
    #[must_use]
    pub fn with_key(key: &KeyRecord) -> Self {
        Self {
            tenant: key.tenant.clone(),
            scopes: key.scopes,
            name: key.id.clone(),
            key: Some(key.id.clone()),
            end: key.expires,
        }
    }

    /// Whoever has this token.
    #[must_use]
    pub fn with_token(TokenBearer { tenant, scopes, subject, end }: TokenBearer) -> Self {
        Self { tenant, scopes, name: format!("sub:{subject}"), key: None, end: Some(end) }
    }

    /// The same until a time at the latest.
    #[must_use]
    pub fn until(self, end: Timestamp) -> Self {
        Self { end: Some(self.end.map_or(end, |known| known.min(end))), ..self }
    }

    /// The tenant.
    #[must_use]
    pub const fn tenant(&self) -> &Tenant {
        &self.tenant
    }

    /// Whether the caller has a scope.
    #[must_use]
    pub const fn may(&self, scope: Scope) -> bool {
        self.scopes.has(scope)
    }

    /// Whether what the caller signed in with has ended by itself.
    #[must_use]
    pub fn has_ended_at(&self, time: Timestamp) -> bool {
        self.end.is_some_and(|end| end <= time)
    }

    /// The id of the caller's key.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        self.key.as_deref()
    }

    /// Who it is, as the log of changes has it: the id of the key, or `sub:` and the subject of the token.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
}
