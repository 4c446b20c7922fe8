//! Under which address the client reached the service.
//!
//! That is the `Host` of the request, and behind proxies that are to be trusted (`--trust-proxy`) what the outermost one
//! says: `Forwarded` (RFC 7239), or `X-Forwarded-Proto`, `-Host`, `-Port` and `-Prefix`. Each proxy of a chain adds to the
//! end of these lists, so their first element is the outermost. Without `--trust-proxy` they are not looked at: anybody can
//! send them.

use axum::extract::{Request, State};
use axum::http::uri::Authority;
use axum::http::{HeaderMap, HeaderValue, Uri, header};
use axum::middleware::Next;
use axum::response::Response;

/// What the service knows of the address that it listens on.
#[derive(Debug, Clone, Copy)]
pub struct Listener {
    /// Whether what a proxy says is believed.
    pub trust_proxy: bool,
    /// Whether the listener speaks TLS.
    pub is_tls: bool,
}

/// Scheme, authority and path under which the client reached the service.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PublicAddress {
    /// `http` or `https`, where a proxy says so or the listener speaks TLS. Behind a proxy the service does not know by itself.
    scheme: Option<&'static str>,
    /// Host and port, without the scheme's own port.
    authority: Option<String>,
    /// Path that the proxy puts before those of the service: empty, or begins with a slash and ends without.
    prefix: String,
}

impl PublicAddress {
    /// The root of the service: `https://maps.example.com/stillage`.
    #[must_use]
    pub fn root(&self) -> String {
        let scheme = self.scheme.unwrap_or("http");
        self.authority.as_ref().map(|authority| format!("{scheme}://{authority}{}", self.prefix)).unwrap_or_default()
    }

    /// Whether the client reached the service by TLS.
    #[must_use]
    pub fn is_secure(&self) -> bool {
        self.scheme == Some("https")
    }

    /// The path of a resource as the client sees it.
    #[must_use]
    pub fn path(&self, path: &str) -> String {
        format!("{}{path}", self.prefix)
    }

    /// Whether an `Origin` is this address: pages of the service have it.
    #[must_use]
    pub fn is_origin(&self, origin: &str) -> bool {
        let Ok(origin) = origin.parse::<Uri>() else { return false };
        let (Some(scheme), Some(authority)) = (origin.scheme_str(), origin.authority()) else { return false };
        let same = |own: &String| without_own_port(scheme, own) == without_own_port(scheme, authority.as_str());
        self.scheme.is_none_or(|own| own == scheme) && self.authority.as_ref().is_some_and(same)
    }

    /// The host, without its port.
    #[must_use]
    pub fn host(&self) -> Option<&str> {
        let authority = self.authority.as_deref()?;
        // The colons of an IPv6 address stand in brackets.
        let port = authority.rfind(':').filter(|&colon| authority[colon..].find(']').is_none());
        Some(&authority[..port.unwrap_or(authority.len())])
    }

    /// The address of a request.
    fn of(headers: &HeaderMap, uri: &Uri, listener: Listener) -> Self {
        let host = text(headers, "host").or_else(|| uri.authority().map(Authority::as_str)).map(str::to_owned);
        let said = if listener.trust_proxy { Said::by_proxies(headers) } else { Said::default() };
        let scheme = match said.scheme.as_deref() {
            Some("https") => Some("https"),
            Some("http") => Some("http"),
            _ => listener.is_tls.then_some("https"),
        };
        let is_valid = |host: &String| host.parse::<Authority>().is_ok();
        let authority = said.host.filter(is_valid).or(host).map(|host| match said.port {
            Some(port) if host.parse::<Authority>().is_ok_and(|host| host.port().is_none()) => format!("{host}:{port}"),
            _ => host,
        });
        let authority = authority.map(|authority| without_own_port(scheme.unwrap_or("http"), &authority));
        Self { scheme, authority, prefix: said.prefix.unwrap_or_default() }
    }
}

/// What the outermost proxy says.
#[derive(Debug, Default)]
struct Said {
    scheme: Option<String>,
    host: Option<String>,
    port: Option<u16>,
    prefix: Option<String>,
}

impl Said {
    fn by_proxies(headers: &HeaderMap) -> Self {
        let first = |name| text(headers, name).and_then(|list| list.split(',').next()).map(str::trim);
        let forwarded = text(headers, "forwarded").unwrap_or_default();
        let parameter = |name| forwarded_parameter(forwarded, name);
        let path = first("x-forwarded-prefix").map(|path| path.trim_end_matches('/'));
        Self {
            scheme: parameter("proto").or(first("x-forwarded-proto").map(str::to_owned)).map(|it| it.to_lowercase()),
            host: parameter("host").or(first("x-forwarded-host").map(str::to_owned)),
            port: first("x-forwarded-port").and_then(|port| port.parse().ok()),
            prefix: path.filter(|path| is_path(path)).map(str::to_owned),
        }
    }
}

/// A parameter of the first element of `Forwarded`: `for=192.0.2.60;proto=https;host="maps.example.com:8443", for=...`.
fn forwarded_parameter(forwarded: &str, name: &str) -> Option<String> {
    let element = forwarded.split(',').next()?;
    let pairs = element.split(';').filter_map(|pair| pair.split_once('='));
    let (_, value) = pairs.into_iter().find(|(key, _)| key.trim().eq_ignore_ascii_case(name))?;
    Some(value.trim().trim_matches('"').to_owned())
}

/// Whether a prefix is a path of plain segments, so that it can stand in a link: `//host` would be another host.
fn is_path(prefix: &str) -> bool {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~%/".contains(&byte);
    prefix.starts_with('/') && !prefix.contains("//") && prefix.bytes().all(is_plain)
}

/// Host in lower case, and the port where it is not the one of the scheme.
fn without_own_port(scheme: &str, authority: &str) -> String {
    let own = if scheme == "https" { ":443" } else { ":80" };
    authority.strip_suffix(own).unwrap_or(authority).to_ascii_lowercase()
}

fn text<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a str> {
    headers.get(name).and_then(|value| value.to_str().ok())
}

/// Middleware: finds the address, for links, for problems and for the check of origins, and puts the prefix before
/// `Location`.
pub async fn resolve(State(listener): State<Listener>, mut request: Request, next: Next) -> Response {
    let address = PublicAddress::of(request.headers(), request.uri(), listener);
    request.extensions_mut().insert(address.clone());
    let mut response = next.run(request).await;
    if let Some(location) = text(response.headers(), "location").filter(|path| path.starts_with('/'))
        && let Ok(location) = HeaderValue::try_from(address.path(location))
    {
        response.headers_mut().insert(header::LOCATION, location);
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn address(trust_proxy: bool, headers: &[(&'static str, &'static str)]) -> PublicAddress {
        address_in(Listener { trust_proxy, is_tls: false }, headers)
    }

    fn address_in(listener: Listener, headers: &[(&'static str, &'static str)]) -> PublicAddress {
        let header = |&(name, value): &(&'static str, &'static str)| {
            (header::HeaderName::from_static(name), HeaderValue::from_static(value))
        };
        PublicAddress::of(&headers.iter().map(header).collect(), &Uri::from_static("/v1/maps"), listener)
    }

    #[test]
    fn links_follow_the_outermost_proxy() {
        let root = |headers: &[_]| address(true, headers).root();
        let host = ("host", "10.0.0.5:8080");
        assert_eq!(root(&[host]), "http://10.0.0.5:8080");
        let proto = ("x-forwarded-proto", "https, http");
        assert_eq!(root(&[("host", "maps.example.com"), proto]), "https://maps.example.com");
        assert_eq!(root(&[("host", "maps.example.com:443"), proto]), "https://maps.example.com");
        let public = ("x-forwarded-host", "maps.example.com, inner:8080");
        assert_eq!(root(&[host, proto, public]), "https://maps.example.com");
        assert_eq!(root(&[host, proto, public, ("x-forwarded-port", "443, 80")]), "https://maps.example.com");
        assert_eq!(root(&[host, proto, public, ("x-forwarded-port", "8443")]), "https://maps.example.com:8443");
        let prefix = ("x-forwarded-prefix", "/stillage/");
        assert_eq!(root(&[host, proto, public, prefix]), "https://maps.example.com/stillage");
        let forwarded = ("forwarded", "for=192.0.2.60;Proto=https;host=\"a.example:8443\", for=10.0.0.1;host=b");
        assert_eq!(root(&[host, ("x-forwarded-proto", "http"), public, forwarded]), "https://a.example:8443");
    }

    #[test]
    fn a_listener_with_tls_has_links_with_https() {
        let own = address_in(Listener { trust_proxy: false, is_tls: true }, &[("host", "maps.example.com:443")]);
        assert_eq!(own.root(), "https://maps.example.com");
        assert!(
            own.is_secure() && own.is_origin("https://maps.example.com") && !own.is_origin("http://maps.example.com")
        );
    }

    #[test]
    fn what_cannot_stand_in_a_link_is_ignored() {
        let root = |name, value| address(true, &[("host", "robots"), (name, value)]).root();
        for (name, value) in [
            ("x-forwarded-proto", "javascript"),
            ("x-forwarded-host", "a b"),
            ("x-forwarded-host", ""),
            ("x-forwarded-port", "many"),
            ("x-forwarded-prefix", "//evil.example"),
            ("x-forwarded-prefix", "/\"><script>"),
            ("x-forwarded-prefix", "stillage"),
        ] {
            assert_eq!(root(name, value), "http://robots", "{name}: {value}");
        }
    }

    #[test]
    fn nobody_is_believed_without_being_told() {
        let headers = [
            ("host", "robots:8080"),
            ("x-forwarded-proto", "https"),
            ("x-forwarded-host", "evil.example"),
            ("forwarded", "host=evil.example"),
        ];
        assert_eq!(address(false, &headers).root(), "http://robots:8080");
        assert!(!address(false, &headers).is_origin("https://evil.example"));
    }

    #[test]
    fn only_pages_of_this_address_have_its_origin() {
        let own = address(false, &[("host", "localhost:8080")]);
        assert!(own.is_origin("http://localhost:8080"));
        for other in ["http://localhost:9090", "https://example.org", "null", "http://localhost"] {
            assert!(!own.is_origin(other), "{other}");
        }
        // A proxy that ends TLS and says nothing about it.
        assert!(address(false, &[("host", "maps.example.com:443")]).is_origin("https://maps.example.com"));
        assert!(address(false, &[("host", "Maps.example.com")]).is_origin("https://maps.example.com:443"));
        let secure = [("host", "10.0.0.5"), ("x-forwarded-proto", "https"), ("x-forwarded-host", "maps.example.com")];
        assert!(address(true, &secure).is_origin("https://maps.example.com"));
        assert!(!address(true, &secure).is_origin("http://maps.example.com"));
        assert!(!address(true, &secure).is_origin("http://10.0.0.5"));
    }
}
