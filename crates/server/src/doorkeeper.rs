//! Who may send requests, and what a browser may do with an answer.
//!
//! A browser also runs pages of strangers. They can send requests to this server, but not under its
//! name and not from its own pages. `Host` differs if a name of theirs leads to this machine (DNS
//! rebinding), `Origin` and `Sec-Fetch-Site` reveal other sites, and the header of every writing
//! request cannot be sent across sites at all. Other users of the machine do not have the token of
//! the address.
//!
//! A browser sends its cookies to every port of a machine, and therefore also to a server of
//! another user. Hence the cookie only gives access to the assets of the page; calls of the program
//! and writing require the secret of the page as well. That secret is sent in the answer to the
//! address's token, after the `#` of the redirect, which browsers do not pass on.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, PoisonError};

use axum::extract::{Request, State};
use axum::http::header::{self, HeaderMap, HeaderName};
use axum::http::{HeaderValue, Method, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::routes::refusal;
use super::server::House;

/// Policy for pages of this server: show its content, and run its own scripts.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
                      img-src 'self' data:; connect-src 'self'; worker-src 'self'; \
                      frame-src 'self'; frame-ancestors 'self'; base-uri 'none'; \
                      form-action 'none'";

/// Policy for files that are downloaded: one that is opened instead shows its own styles and pictures.
pub(crate) const POLICY_OF_DOWNLOADS: &str = "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'; \
     base-uri 'none'; form-action 'none'";

/// Policy for report pages: show their own styles and pictures, whoever opens them, and run nothing.
/// They are of the origin of the live page, so that it can keep their place when they change.
pub(crate) const POLICY_OF_REPORTS: &str = "sandbox allow-same-origin; default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'; \
     base-uri 'none'; form-action 'none'";

/// The header of every request other than for assets: the secret of the page.
const OWN_HEADER: &str = "x-gumption";

/// Whether a valid secret has come over a connection.
#[derive(Clone, Debug, Default)]
pub(crate) struct Proven(pub(crate) Arc<AtomicBool>);

/// Why a request is rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Barred {
    Host,
    Origin,
    NoToken,
    Header,
    ContentType,
}

/// Who is let in.
enum Admitted {
    /// With the cookie.
    Known,
    /// With the token of the address: sets the cookie.
    New,
}

/// Checks every request before anything else, and makes every answer safe to display.
pub(crate) async fn keep(
    State(house): State<Arc<House>>,
    request: Request,
    next: Next,
) -> Response {
    let mut response = match admitted(&house, &request) {
        Ok(Admitted::Known) => {
            if let Some(Proven(proven)) = request.extensions().get() {
                proven.store(true, Ordering::Relaxed);
            }
            next.run(request).await
        }
        Ok(Admitted::New) => welcome(&house),
        Err(barred) => barred.response(),
    };
    harden(response.headers_mut());
    response
}

impl Barred {
    fn response(self) -> Response {
        let (status, message) = match self {
            Self::Host => (StatusCode::FORBIDDEN, "this server answers to 127.0.0.1 alone"),
            Self::Origin => (StatusCode::FORBIDDEN, "this server answers its own pages alone"),
            Self::NoToken => (
                StatusCode::UNAUTHORIZED,
                "open the address that `gumption open` printed, with its token; a token of an \
                 earlier start, or a token that the browser has used, is not accepted again",
            ),
            Self::Header => (
                StatusCode::FORBIDDEN,
                "this page has not got its secret (the header `X-Gumption`): open the address that \
                 `gumption open` has printed",
            ),
            Self::ContentType => {
                (StatusCode::UNSUPPORTED_MEDIA_TYPE, "requests are `application/json`")
            }
        };
        let mut response = refusal(status, message);
        // rejected clients need not stay connected
        response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
        response
    }
}

fn admitted(house: &House, request: &Request) -> Result<Admitted, Barred> {
    let headers = request.headers();
    let host = only(headers, &header::HOST).ok_or(Barred::Host)?;
    let own = house.hosts();
    if !own.iter().any(|own| own.eq_ignore_ascii_case(host)) {
        return Err(Barred::Host);
    }
    // the form for proxies names its own host
    if request.uri().authority().is_some_and(|of| !of.as_str().eq_ignore_ascii_case(host)) {
        return Err(Barred::Host);
    }
    if headers.contains_key(header::ORIGIN) {
        let own = |origin: &str| {
            origin.strip_prefix("http://").is_some_and(|of| of.eq_ignore_ascii_case(host))
        };
        if !only(headers, &header::ORIGIN).is_some_and(own) {
            return Err(Barred::Origin);
        }
    }
    let reads = matches!(*request.method(), Method::GET | Method::HEAD);
    let site = HeaderName::from_static("sec-fetch-site");
    if headers.contains_key(&site) {
        // `none` means that the user typed the address, or that a program opened it
        match only(headers, &site) {
            Some("same-origin") => {}
            Some("none") if reads => {}
            _ => return Err(Barred::Origin),
        }
    }
    let given = query(request.uri().query().unwrap_or(""), "token");
    if let Some(given) = given.filter(|_| reads && request.uri().path() == "/") {
        return if house.takes(&given) { Ok(Admitted::New) } else { Err(Barred::NoToken) };
    }
    if !cookies(headers, &house.cookie_name()).any(|given| house.cookie.is(given)) {
        return Err(Barred::NoToken);
    }
    if !reads {
        let secret = only(headers, &HeaderName::from_static(OWN_HEADER));
        if !secret.is_some_and(|given| house.page.is(given)) {
            return Err(Barred::Header);
        }
        let kind = only(headers, &header::CONTENT_TYPE).unwrap_or("");
        let kind = kind.split(';').next().unwrap_or("").trim();
        if !kind.eq_ignore_ascii_case("application/json") {
            return Err(Barred::ContentType);
        }
    }
    Ok(Admitted::Known)
}

impl House {
    /// Whether this token gives access. The token of the started browser does so once: other users
    /// of the machine can read a program's arguments.
    fn takes(&self, given: &str) -> bool {
        if self.token.is(given) {
            return true;
        }
        let mut launch = self.launch.lock().unwrap_or_else(PoisonError::into_inner);
        let right = launch.as_ref().is_some_and(|launch| launch.is(given));
        if right {
            *launch = None;
        }
        right
    }
}

/// Sets the cookie, and redirects to the address with the secret of the page instead of the token.
fn welcome(house: &House) -> Response {
    let (name, value) = (house.cookie_name(), house.cookie.text());
    let cookie = format!("{name}={value}; Path=/; HttpOnly; SameSite=Strict");
    let page = format!("/#{}", house.page.text());
    let to = [(header::LOCATION, page), (header::SET_COOKIE, cookie)];
    (StatusCode::SEE_OTHER, to).into_response()
}

/// Security headers of every answer.
fn harden(headers: &mut HeaderMap) {
    let set = [
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::CACHE_CONTROL, "no-store"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::X_FRAME_OPTIONS, "SAMEORIGIN"),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    ];
    for (name, value) in set {
        headers.insert(name, HeaderValue::from_static(value));
    }
    // report pages have their own policy
    headers
        .entry(header::CONTENT_SECURITY_POLICY)
        .or_insert_with(|| HeaderValue::from_static(POLICY));
}

/// The value of a header that occurs once; repeated ones may be read differently by others.
fn only<'h>(headers: &'h HeaderMap, name: &HeaderName) -> Option<&'h str> {
    let mut values = headers.get_all(name).iter();
    let first = values.next()?;
    if values.next().is_some() { None } else { first.to_str().ok() }
}

/// The values of a cookie.
fn cookies<'h>(headers: &'h HeaderMap, name: &str) -> impl Iterator<Item = &'h str> {
    let texts = headers.get_all(header::COOKIE).iter().filter_map(|value| value.to_str().ok());
    let pairs = texts.flat_map(|text| text.split(';')).filter_map(|pair| pair.split_once('='));
    pairs.filter(move |(of, _)| of.trim() == name).map(|(_, value)| value.trim())
}

/// The value of a parameter in the query of an address.
pub(crate) fn query(query: &str, name: &str) -> Option<String> {
    let mut pairs = query.split('&').filter_map(|pair| pair.split_once('='));
    let (_, value) = pairs.find(|(of, _)| *of == name)?;
    let spaced = value.replace('+', " ");
    let decoded = percent_encoding::percent_decode_str(&spaced).decode_utf8();
    decoded.ok().map(std::borrow::Cow::into_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn queries_are_decoded() {
        assert_eq!(query("a=1&path=b%2Fc+d%20%C2%B5", "path").as_deref(), Some("b/c d \u{b5}"));
        assert_eq!(query("path=%ff", "path"), None);
        assert_eq!(query("", "path"), None);
    }

    #[test]
    fn a_header_that_is_there_twice_counts_as_none() {
        let mut headers = HeaderMap::new();
        headers.append(header::HOST, HeaderValue::from_static("a"));
        assert_eq!(only(&headers, &header::HOST), Some("a"));
        headers.append(header::HOST, HeaderValue::from_static("b"));
        assert_eq!(only(&headers, &header::HOST), None);
    }
}
