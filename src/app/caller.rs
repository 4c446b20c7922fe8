//! Who asks.

use jiff::Timestamp;

use crate::access::{Scope, Scopes, Session, TokenBearer};
use crate::records::{KeyRecord, Tenant};

/// Who asks for a use case. Everything is read and written for the caller's tenant: what belongs to another one is not
/// found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Caller {
    tenant: Tenant,
    scopes: Scopes,
    name: String,
    shown: Shown,
    /// When it is nobody any more.
    end: Option<Timestamp>,
}

/// What a caller signed in with.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Shown {
    Nothing,
    /// A key of this id.
    Key(String),
    /// A token about this subject.
    Token(String),
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
        Self { name: tenant.to_string(), tenant, scopes: Scopes::all(), shown: Shown::Nothing, end: None }
    }

    /// Whoever has this key.
    #[must_use]
    pub fn with_key(key: &KeyRecord) -> Self {
        Self {
            tenant: key.tenant.clone(),
            scopes: key.scopes,
            name: key.id.clone(),
            shown: Shown::Key(key.id.clone()),
            end: key.expires,
        }
    }

    /// Whoever has this token.
    #[must_use]
    pub fn with_token(TokenBearer { tenant, scopes, subject, end }: TokenBearer) -> Self {
        Self { tenant, scopes, name: format!("sub:{subject}"), shown: Shown::Token(subject), end: Some(end) }
    }

    /// The same until a time at the latest, where there is one.
    #[must_use]
    pub fn until(self, end: Option<Timestamp>) -> Self {
        Self { end: self.end.into_iter().chain(end).min(), ..self }
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
        match &self.shown {
            Shown::Key(id) => Some(id),
            Shown::Nothing | Shown::Token(_) => None,
        }
    }

    /// A session in place of what the caller signed in with, which ends at the latest when that does; `None` where nothing was
    /// needed.
    #[must_use]
    pub fn session(&self, end: Timestamp) -> Option<Session> {
        let end = self.end.map_or(end, |own| own.min(end));
        match &self.shown {
            Shown::Nothing => None,
            Shown::Key(id) => Some(Session::OfKey { key: id.clone(), end }),
            Shown::Token(subject) => {
                let (tenant, scopes, subject) = (self.tenant.clone(), self.scopes, subject.clone());
                Some(Session::OfToken(TokenBearer { tenant, scopes, subject, end }))
            }
        }
    }

    /// Who it is, as the log of changes has it: the id of the key, or `sub:` and the subject of the token.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
}
