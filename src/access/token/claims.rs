//! What a token says (RFC 7519, 4.1), and whether it holds now and here.

use jiff::{SignedDuration, Timestamp};
use serde_json::{Map, Value};

use super::rules::{TokenBearer, TokenRefusal, TokenRules};
use crate::access::Scopes;

/// How far the clocks of the provider and of this machine may be apart.
const LEEWAY: SignedDuration = SignedDuration::from_mins(1);

/// Longest subject that is kept, characters: as much as `OpenID` Connect allows (Core, 2).
const MAX_SUBJECT: usize = 255;

/// Reads the claims of a token whose signature was checked.
pub(super) fn read(text: &[u8], rules: &TokenRules, now: Timestamp) -> Result<TokenBearer, TokenRefusal> {
    let claims: Map<String, Value> = serde_json::from_slice(text).map_err(|_| TokenRefusal::Malformed)?;
    let wrong = |detail: &str| TokenRefusal::Claim(format!("the token does not open this service: {detail}"));
    if text_of(&claims, "iss") != Some(&rules.issuer) {
        return Err(wrong("its issuer (iss) is another one"));
    }
    let is_for_us = match claims.get("aud") {
        Some(Value::String(one)) => *one == rules.audience,
        Some(Value::Array(several)) => several.iter().any(|one| one.as_str() == Some(&rules.audience)),
        _ => false,
    };
    if !is_for_us {
        return Err(wrong("it is for another audience (aud)"));
    }
    let end = time_of(&claims, "exp").ok_or_else(|| wrong("it does not say when it ends (exp)"))?;
    let end = end.saturating_add(LEEWAY).unwrap_or(end);
    if end <= now {
        return Err(wrong("it has ended (exp): ask for a new one"));
    }
    let has_not_begun = |begin: Timestamp| begin.saturating_sub(LEEWAY).is_ok_and(|begin| begin > now);
    if claims.contains_key("nbf") && time_of(&claims, "nbf").is_none_or(has_not_begun) {
        return Err(wrong("it has not begun (nbf)"));
    }
    let tenant = text_of(&claims, &rules.tenant_claim).and_then(|name| name.parse().ok());
    let tenant = tenant.ok_or_else(|| wrong(&format!("it names no tenant ({})", rules.tenant_claim)))?;
    let subject = text_of(&claims, "sub").filter(|subject| (1..=MAX_SUBJECT).contains(&subject.chars().count()));
    let subject = subject.ok_or_else(|| wrong("it names no subject (sub)"))?.to_owned();
    Ok(TokenBearer { tenant, scopes: scopes(&claims), subject, end })
}

/// The scopes: words with blanks between them (`scope`, RFC 9068, 2.2.3), or a list (`scp`). Words that are no scopes of this
/// service are those of others.
fn scopes(claims: &Map<String, Value>) -> Scopes {
    let words = text_of(claims, "scope").map(str::to_owned);
    let list = claims.get("scp").and_then(Value::as_array);
    let listed = || list.into_iter().flatten().filter_map(Value::as_str).collect::<Vec<_>>().join(" ");
    Scopes::of_words(&words.unwrap_or_else(listed))
}

fn text_of<'a>(claims: &'a Map<String, Value>, name: &str) -> Option<&'a str> {
    claims.get(name).and_then(Value::as_str)
}

/// A time: seconds since 1970, with or without a fraction.
fn time_of(claims: &Map<String, Value>, name: &str) -> Option<Timestamp> {
    let seconds = claims.get(name).and_then(Value::as_f64)?;
    Timestamp::from_second(seconds as i64).ok()
}
