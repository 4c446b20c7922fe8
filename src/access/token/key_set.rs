//! The public keys of an identity provider (JWK Set, RFC 7517 and 7518).

use std::fmt;

use base64::Engine as _;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use ring::signature::{
    ECDSA_P256_SHA256_FIXED, ED25519, RSA_PKCS1_2048_8192_SHA256, RsaPublicKeyComponents, UnparsedPublicKey,
};
use serde::Deserialize;

use super::rules::TokenRefusal;

/// A text that is no set of keys, or has none that is used here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("it is no JWK Set with a public key for RS256 (RSA), ES256 (P-256) or EdDSA (Ed25519)")]
pub struct NoKeySet;

/// The keys that tokens are signed with.
#[derive(Debug, Clone)]
pub struct TokenKeySet(Vec<TokenKey>);

/// A key, which is good for one algorithm.
#[derive(Clone)]
struct TokenKey {
    id: Option<String>,
    material: KeyMaterial,
}

/// What signatures are checked with.
#[derive(Clone)]
enum KeyMaterial {
    /// Modulus and exponent.
    Rsa(Vec<u8>, Vec<u8>),
    /// A point on P-256, uncompressed.
    P256(Vec<u8>),
    Ed25519(Vec<u8>),
}

#[derive(Debug, Deserialize)]
struct JwkSet {
    keys: Vec<Jwk>,
}

/// The members of a key that are read; others may be there.
#[derive(Debug, Deserialize)]
struct Jwk {
    kty: String,
    kid: Option<String>,
    r#use: Option<String>,
    alg: Option<String>,
    crv: Option<String>,
    n: Option<String>,
    e: Option<String>,
    x: Option<String>,
    y: Option<String>,
}

impl TokenKeySet {
    /// Reads a JWK Set. Keys of other kinds, and those that are not for signatures, are left out.
    ///
    /// # Errors
    /// Where no key is left.
    pub fn read(text: &[u8]) -> Result<Self, NoKeySet> {
        let set: JwkSet = serde_json::from_slice(text).map_err(|_| NoKeySet)?;
        let keys: Vec<TokenKey> = set.keys.iter().filter_map(Jwk::key).collect();
        if keys.is_empty() { Err(NoKeySet) } else { Ok(Self(keys)) }
    }

    /// Checks a signature with the keys that fit: of the id, where the token names one, and of the algorithm, which only the key
    /// decides.
    pub(super) fn verify(
        &self,
        algorithm: &str,
        id: Option<&str>,
        signed: &[u8],
        signature: &[u8],
    ) -> Result<(), TokenRefusal> {
        let fits = |key: &&TokenKey| id.is_none_or(|id| key.id.as_deref() == Some(id));
        let mut candidates = self.0.iter().filter(fits).filter(|key| key.material.algorithm() == algorithm);
        let is_signed = candidates.any(|key| key.material.has_signed(signed, signature));
        is_signed.then_some(()).ok_or(TokenRefusal::Signature)
    }
}

impl Jwk {
    fn key(&self) -> Option<TokenKey> {
        let bytes = |member: &Option<String>| BASE64_URL_SAFE_NO_PAD.decode(member.as_ref()?).ok();
        let material = match (self.kty.as_str(), self.crv.as_deref()) {
            ("RSA", _) => KeyMaterial::Rsa(bytes(&self.n)?, bytes(&self.e)?),
            ("EC", Some("P-256")) => {
                let (x, y) = (bytes(&self.x)?, bytes(&self.y)?);
                KeyMaterial::P256([[4].as_slice(), &x, &y].concat())
            }
            ("OKP", Some("Ed25519")) => KeyMaterial::Ed25519(bytes(&self.x)?),
            _ => return None,
        };
        let is_for_signatures = self.r#use.as_deref().is_none_or(|usage| usage == "sig");
        let is_for_algorithm = self.alg.as_deref().is_none_or(|algorithm| algorithm == material.algorithm());
        (is_for_signatures && is_for_algorithm).then(|| TokenKey { id: self.kid.clone(), material })
    }
}

impl KeyMaterial {
    const fn algorithm(&self) -> &'static str {
        match self {
            Self::Rsa(..) => "RS256",
            Self::P256(_) => "ES256",
            Self::Ed25519(_) => "EdDSA",
        }
    }

    fn has_signed(&self, signed: &[u8], signature: &[u8]) -> bool {
        match self {
            Self::Rsa(n, e) => {
                RsaPublicKeyComponents { n, e }.verify(&RSA_PKCS1_2048_8192_SHA256, signed, signature).is_ok()
            }
            Self::P256(point) => {
                UnparsedPublicKey::new(&ECDSA_P256_SHA256_FIXED, point).verify(signed, signature).is_ok()
            }
            Self::Ed25519(key) => UnparsedPublicKey::new(&ED25519, key).verify(signed, signature).is_ok(),
        }
    }
}

impl fmt::Debug for TokenKey {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} {:?}", self.material.algorithm(), self.id)
    }
}
