//! Who asks.

use crate::records::Tenant;

/// Who asks for a use case. Everything is read and written for the caller's tenant: what belongs to another one is not
/// found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Caller {
    tenant: Tenant,
}

impl Caller {
    /// The operator of a service without keys: whoever reaches it.
    #[must_use]
    pub fn local() -> Self {
        Self::of(Tenant::local())
    }

    /// Somebody who acts for this tenant.
    #[must_use]
    pub const fn of(tenant: Tenant) -> Self {
        Self { tenant }
    }

    /// The tenant.
    #[must_use]
    pub const fn tenant(&self) -> &Tenant {
        &self.tenant
    }
}
