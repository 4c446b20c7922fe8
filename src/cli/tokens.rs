//! Which tokens of an identity provider are taken.

use clap::Args;

use crate::access::TokenRules;
use crate::config::TokenConfig;

/// Tokens (JWT) of an identity provider, which are taken in place of keys.
#[derive(Debug, Clone, Args)]
pub(super) struct TokenArgs {
    /// Keys of an identity provider, whose tokens are taken in place of keys: file or `https` address of a JWK Set.
    #[arg(long, env = "STILLAGE_JWT_KEYS", value_name = "FILE|URL", requires_all = ["jwt_issuer", "jwt_audience"])]
    jwt_keys: Option<String>,
    /// Who makes the tokens (`iss`).
    #[arg(long, env = "STILLAGE_JWT_ISSUER", value_name = "ISSUER", requires = "jwt_keys")]
    jwt_issuer: Option<String>,
    /// For whom they must be (`aud`): the name that the provider has for this service.
    #[arg(long, env = "STILLAGE_JWT_AUDIENCE", value_name = "AUDIENCE", requires = "jwt_keys")]
    jwt_audience: Option<String>,
    /// The claim of a token that names the tenant.
    #[arg(long, env = "STILLAGE_JWT_TENANT_CLAIM", default_value = "tenant", value_name = "CLAIM")]
    jwt_tenant_claim: String,
}

impl TokenArgs {
    /// The configuration that the arguments mean.
    pub(super) fn config(&self) -> Option<TokenConfig> {
        let (keys, issuer) = (self.jwt_keys.clone()?, self.jwt_issuer.clone()?);
        let (audience, tenant_claim) = (self.jwt_audience.clone()?, self.jwt_tenant_claim.clone());
        Some(TokenConfig { keys, rules: TokenRules { issuer, audience, tenant_claim } })
    }
}
