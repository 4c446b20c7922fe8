//! The host names under which the service answers.
//!
//! A page of another site may have a name that leads to this machine (DNS rebinding): for the browser it is then a page of
//! this service, which may write. Its requests carry that name as their host, so a service that knows its own names can tell
//! them apart. An address is no name that somebody could lead elsewhere, so every address is allowed.

use std::net::IpAddr;
use std::str::FromStr;

/// Why a text is no pattern of host names.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no host: write a name without scheme, port and path, such as maps.example.com, *.example.com or *")]
pub struct NoHostPattern(String);

/// A host name that is allowed, or all names of a kind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum HostPattern {
    /// Every name: `*`.
    Any,
    /// This name.
    Name(String),
    /// Every name that ends with this one and a dot before it: `*.example.com`.
    Below(String),
}

impl FromStr for HostPattern {
    type Err = NoHostPattern;

    fn from_str(text: &str) -> Result<Self, NoHostPattern> {
        let text = text.trim();
        if text == "*" {
            return Ok(Self::Any);
        }
        let name = text.strip_prefix("*.").unwrap_or(text);
        let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._".contains(&byte);
        if name.is_empty() || name.starts_with('.') || !name.bytes().all(is_plain) {
            return Err(NoHostPattern(text.to_owned()));
        }
        let name_only = name.trim_end_matches('.').to_owned();
        Ok(if name.len() == text.len() { Self::Name(name_only) } else { Self::Below(name_only) })
    }
}

impl HostPattern {
    fn allows(&self, host: &str) -> bool {
        match self {
            Self::Any => true,
            Self::Name(name) => host.eq_ignore_ascii_case(name),
            Self::Below(name) => is_below(host, name),
        }
    }
}

/// Whether a host is a name below another one.
fn is_below(host: &str, name: &str) -> bool {
    let split = host.len().checked_sub(name.len() + 1).and_then(|at| host.split_at_checked(at));
    split.is_some_and(|(_, end)| end.starts_with('.') && end[1..].eq_ignore_ascii_case(name))
}

/// The hosts under which the service answers: addresses, `localhost` and the names below it (RFC 6761, 6.3: they lead to this
/// machine), and the names it was told.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct AllowedHosts(Vec<HostPattern>);

impl AllowedHosts {
    /// Whether the service answers under a host, given without its port.
    #[must_use]
    pub fn allows(&self, host: &str) -> bool {
        let host = host.strip_suffix('.').unwrap_or(host);
        let address = host.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')).unwrap_or(host);
        address.parse::<IpAddr>().is_ok()
            || host.eq_ignore_ascii_case("localhost")
            || is_below(host, "localhost")
            || self.0.iter().any(|pattern| pattern.allows(host))
    }
}

impl From<Vec<HostPattern>> for AllowedHosts {
    fn from(patterns: Vec<HostPattern>) -> Self {
        Self(patterns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn allowed(patterns: &[&str]) -> AllowedHosts {
        patterns.iter().map(|text| text.parse().expect("is a pattern")).collect::<Vec<HostPattern>>().into()
    }

    #[test]
    fn without_being_told_it_answers_on_this_machine_and_under_addresses() {
        let hosts = allowed(&[]);
        for host in ["localhost", "LOCALHOST.", "maps.localhost", "127.0.0.1", "127.8.0.1", "[::1]", "192.168.1.5"] {
            assert!(hosts.allows(host), "{host}");
        }
        for host in ["rebound.example", "localhost.example", "notlocalhost", "127.0.0.1.example", "", "stillage"] {
            assert!(!hosts.allows(host), "{host}");
        }
    }

    #[test]
    fn names_are_allowed_one_by_one_below_another_or_all() {
        let hosts = allowed(&["maps.example.com", "*.site.example"]);
        for host in ["Maps.Example.com", "maps.example.com.", "a.site.example", "a.b.site.example"] {
            assert!(hosts.allows(host), "{host}");
        }
        for host in ["example.com", "a.maps.example.com", "site.example", "xsite.example"] {
            assert!(!hosts.allows(host), "{host}");
        }
        assert!(allowed(&["*"]).allows("whatever.example"));
    }

    #[test]
    fn what_is_no_name_is_refused() {
        for text in ["", "http://maps.example.com", "maps.example.com:8080", "a/b", "*.", "*x", ".example.com"] {
            assert!(text.parse::<HostPattern>().is_err(), "{text}");
        }
    }
}
