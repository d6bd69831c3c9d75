//! What can be asked for.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use axum::Router;
use axum::body::{Body, Bytes};
use axum::extract::{DefaultBodyLimit, FromRequest, Path, Request, State};
use axum::http::{HeaderValue, StatusCode, header};
use axum::middleware::from_fn_with_state;
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use tokio::time::timeout;

use super::answers::{EvaluatedPage, Refusal, ServedAsset, TextOfFile};
use super::doorkeeper::{self, POLICY_OF_DOWNLOADS, POLICY_OF_REPORTS, query};
use super::events::events;
use super::folder::{Unopened, read};
use super::lane::{Lane, Undone};
use super::listing::listing;
use super::named_file::NamedFiles;
use super::saving::{LONGEST, Saved, Unsaved, save};
use super::server::House;
use super::watch::version;

/// The longest request, in bytes: a workbook of 10 MB in base64.
pub(crate) const MOST_BODY: usize = 16 << 20;

/// How long a request may take to arrive.
const ARRIVAL: Duration = Duration::from_secs(30);

/// All routes, behind the access control.
pub(crate) fn routes(house: &Arc<House>) -> Router {
    Router::new()
        .route("/", get(index))
        .route("/assets/{name}", get(asset))
        .route("/api/hello", get(hello))
        .route("/api/files", post(files))
        .route("/api/open", post(open))
        .route("/api/save", post(saved))
        .route("/api/call/{name}", post(call))
        .route("/api/export", post(export))
        .route("/api/page", post(page))
        .route("/api/page/{name}", get(shown))
        .route("/api/progress/{name}", get(progress))
        .route("/api/events", get(events))
        .fallback(async || refusal(StatusCode::NOT_FOUND, "there is nothing at this address"))
        .layer(DefaultBodyLimit::max(MOST_BODY))
        .layer(from_fn_with_state(Arc::clone(house), doorkeeper::keep))
        .with_state(Arc::clone(house))
}

/// A refusal with a reason.
pub(crate) fn refusal(status: StatusCode, message: &str) -> Response {
    let body = serde_json::json!({ "error": message }).to_string();
    (status, [(header::CONTENT_TYPE, "application/json")], body).into_response()
}

fn json<T: Serialize>(answer: &T) -> Response {
    match serde_json::to_string(answer) {
        Ok(text) => json_text(text),
        Err(error) => refusal(StatusCode::INTERNAL_SERVER_ERROR, &error.to_string()),
    }
}

fn json_text(text: String) -> Response {
    ([(header::CONTENT_TYPE, "application/json")], text).into_response()
}

/// The text of a request.
async fn text_of(house: &House, request: Request) -> Result<String, Response> {
    let too_large = || {
        let message = format!("the request is longer than {} MB", MOST_BODY >> 20);
        refusal(StatusCode::PAYLOAD_TOO_LARGE, &message)
    };
    let length = request.headers().get(header::CONTENT_LENGTH);
    let length = length.and_then(|length| length.to_str().ok()?.parse::<u64>().ok());
    if length.is_some_and(|length| length > MOST_BODY as u64) {
        return Err(too_large());
    }
    let busy = || refusal(StatusCode::SERVICE_UNAVAILABLE, "too many requests at once");
    let arrived = timeout(ARRIVAL, async {
        let _room = house.bodies.acquire().await.map_err(|_| busy())?;
        Bytes::from_request(request, &()).await.map_err(|rejected| match rejected.status() {
            StatusCode::PAYLOAD_TOO_LARGE => too_large(),
            status => refusal(status, "the request did not arrive whole"),
        })
    });
    let bytes = arrived
        .await
        .map_err(|_| refusal(StatusCode::REQUEST_TIMEOUT, "the request took too long"))??;
    String::from_utf8(bytes.into())
        .map_err(|_| refusal(StatusCode::BAD_REQUEST, "the request is not UTF-8"))
}

/// Parses the body of a request.
async fn request_of<T: DeserializeOwned>(house: &House, request: Request) -> Result<T, Response> {
    let text = text_of(house, request).await?;
    serde_json::from_str(&text)
        .map_err(|error| refusal(StatusCode::BAD_REQUEST, &format!("the request: {error}")))
}

impl IntoResponse for Undone {
    fn into_response(self) -> Response {
        let (status, message) = match self {
            Self::Busy => (
                StatusCode::SERVICE_UNAVAILABLE,
                "too much is being computed already; try again when it is done",
            ),
            Self::Endless => (StatusCode::SERVICE_UNAVAILABLE, "it took too long and was stopped"),
            Self::Failed => (
                StatusCode::INTERNAL_SERVER_ERROR,
                "an error of the program: please report the steps that led to it",
            ),
        };
        refusal(status, message)
    }
}

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        let (status, message) = match &self {
            Self::Mistakes { message, list } => {
                let body = serde_json::json!({ "error": message, "diagnostics": list });
                return (StatusCode::UNPROCESSABLE_ENTITY, json_text(body.to_string()))
                    .into_response();
            }
            Self::Unknown(message) => (StatusCode::NOT_FOUND, message),
            Self::Request(message) => (StatusCode::BAD_REQUEST, message),
            Self::Content(message) => (StatusCode::UNPROCESSABLE_ENTITY, message),
            Self::Stopped(message) => (StatusCode::SERVICE_UNAVAILABLE, message),
            Self::Internal(message) => (StatusCode::INTERNAL_SERVER_ERROR, message),
        };
        refusal(status, message)
    }
}

impl IntoResponse for Unopened {
    fn into_response(self) -> Response {
        let status = match self {
            Self::Refused(_) => StatusCode::FORBIDDEN,
            Self::Missing => StatusCode::NOT_FOUND,
            Self::Unreadable(_) => StatusCode::UNPROCESSABLE_ENTITY,
        };
        refusal(status, &self.to_string())
    }
}

/// Runs work in a lane, and gives its answer or the reason why there is none.
async fn work<E: IntoResponse + Send + 'static>(
    lane: &Lane,
    house: &Arc<House>,
    work: impl FnOnce(&House, &Arc<AtomicBool>) -> Result<Response, E> + Send + 'static,
) -> Response {
    let house = Arc::clone(house);
    let done = lane.run(move |stop| work(&house, stop).unwrap_or_else(E::into_response)).await;
    done.unwrap_or_else(Undone::into_response)
}

async fn index(State(house): State<Arc<House>>) -> Response {
    of_page(&house, "index.html")
}

async fn asset(State(house): State<Arc<House>>, Path(name): Path<String>) -> Response {
    of_page(&house, &name)
}

fn of_page(house: &House, name: &str) -> Response {
    match house.answers.assets().iter().find(|asset| asset.name == name) {
        Some(&ServedAsset { content_type, content, .. }) => {
            ([(header::CONTENT_TYPE, content_type)], content).into_response()
        }
        None => refusal(StatusCode::NOT_FOUND, "the page has no such part"),
    }
}

async fn hello(State(house): State<Arc<House>>) -> Response {
    json(&serde_json::json!({
        "version": house.answers.version(),
        "lang": house.language,
        "folder": house.folder.name(),
    }))
}

async fn files(State(house): State<Arc<House>>, request: Request) -> Response {
    if let Err(refused) = request_of::<serde_json::Value>(&house, request).await {
        return refused;
    }
    let list = |house: &House, _: &Arc<AtomicBool>| {
        Ok::<_, Refusal>(json(&listing(&house.folder, &*house.answers)))
    };
    work(&house.disk, &house, list).await
}

#[derive(Deserialize)]
struct WantedPath {
    path: String,
}

#[derive(Serialize)]
struct Opened<'a> {
    path: &'a str,
    text: &'a str,
    version: String,
    kind: &'static str,
}

async fn open(State(house): State<Arc<House>>, request: Request) -> Response {
    let WantedPath { path } = match request_of(&house, request).await {
        Ok(wanted) => wanted,
        Err(refused) => return refused,
    };
    let open = move |house: &House, _: &Arc<AtomicBool>| {
        let content = read(&house.folder.path(&path)?, LONGEST)?;
        house.watch.add(&path, &content);
        let Ok(text) = std::str::from_utf8(&content) else {
            return Err(Unopened::Unreadable("it is not UTF-8 text".to_owned()));
        };
        let kind = house.answers.describe(&path, &content).kind;
        Ok(json(&Opened { path: &path, text, version: version(&content), kind }))
    };
    work(&house.disk, &house, open).await
}

#[derive(Deserialize)]
struct ToSave {
    path: String,
    text: String,
    version: Option<String>,
}

async fn saved(State(house): State<Arc<House>>, request: Request) -> Response {
    let ToSave { path, text, version: seen } = match request_of(&house, request).await {
        Ok(wanted) => wanted,
        Err(refused) => return refused,
    };
    let write = move |house: &House, _: &Arc<AtomicBool>| {
        let result = save(&house.folder, &path, &text, seen.as_deref(), &*house.answers);
        match result {
            Ok(Saved::Done) => {
                house.watch.written(&path, text.as_bytes());
                Ok(json(&serde_json::json!({ "version": version(text.as_bytes()) })))
            }
            Ok(Saved::Conflict(there)) => {
                let text = there.as_deref().map(String::from_utf8_lossy);
                let body = serde_json::json!({
                    "error": "another program has changed the file meanwhile",
                    "text": text,
                    "version": there.as_deref().map(version),
                });
                Ok((StatusCode::CONFLICT, json_text(body.to_string())).into_response())
            }
            Err(Unsaved::Path(error)) => Ok(error.into_response()),
            Err(Unsaved::System(message)) => {
                Err(Refusal::Internal(format!("cannot write `{path}`: {message}")))
            }
        }
    };
    work(&house.disk, &house, write).await
}

async fn call(
    State(house): State<Arc<House>>,
    Path(name): Path<String>,
    request: Request,
) -> Response {
    let of = query(request.uri().query().unwrap_or(""), "path").filter(|path| !path.is_empty());
    let text = match text_of(&house, request).await {
        Ok(text) => text,
        Err(refused) => return refused,
    };
    let call = move |house: &House, stop: &Arc<AtomicBool>| {
        if let Some(of) = &of
            && let Err(error @ Unopened::Refused(_)) = house.folder.path(of)
        {
            return Ok(error.into_response());
        }
        let files = NamedFiles::new(&house.folder, &house.watch, of.as_deref());
        house.answers.call(&name, &text, &files, stop).map(json_text)
    };
    work(&house.calls, &house, call).await
}

#[derive(Deserialize)]
struct ToExport {
    path: Option<String>,
    text: String,
    format: String,
}

/// The text with the folder of its file.
fn placed(house: &House, path: Option<String>, text: String) -> Result<TextOfFile, Unopened> {
    let path = path.filter(|path| !path.is_empty()).unwrap_or_else(|| "model.json".to_owned());
    let files = NamedFiles::new(&house.folder, &house.watch, Some(&path));
    let folder = files.disk()?;
    let root = house.folder.root().to_owned();
    Ok(TextOfFile { path, text, folder, root })
}

async fn export(State(house): State<Arc<House>>, request: Request) -> Response {
    let ToExport { path, text, format } = match request_of(&house, request).await {
        Ok(wanted) => wanted,
        Err(refused) => return refused,
    };
    let make = move |house: &House, stop: &Arc<AtomicBool>| {
        let file = match placed(house, path, text) {
            Ok(file) => file,
            Err(error) => return Ok(error.into_response()),
        };
        let made = house.answers.export(&file, &format, stop)?;
        let disposition = disposition(&made.name);
        let headers = [
            (header::CONTENT_TYPE, HeaderValue::from_static(made.content_type)),
            (header::CONTENT_DISPOSITION, disposition),
            // a page that is opened instead of saved can do nothing
            (header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY_OF_DOWNLOADS)),
        ];
        Ok::<_, Refusal>((headers, Body::from(made.content)).into_response())
    };
    work(&house.makings, &house, make).await
}

/// Characters that stay unescaped in a name (RFC 8187).
const PLAIN: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_');

/// The header for a file to be saved under this name.
fn disposition(name: &str) -> HeaderValue {
    let ascii: String = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() || "-._".contains(c) { c } else { '_' })
        .collect();
    let whole = utf8_percent_encode(name, PLAIN);
    let text = format!("attachment; filename=\"{ascii}\"; filename*=UTF-8''{whole}");
    HeaderValue::try_from(text).unwrap_or(HeaderValue::from_static("attachment"))
}

#[derive(Deserialize)]
struct ToShow {
    path: Option<String>,
    text: String,
    /// A name by which the share that is done can be asked for.
    #[serde(default)]
    progress: Option<String>,
}

#[derive(Serialize)]
struct PageToShow {
    html: String,
    address: String,
    answer: Option<Box<RawValue>>,
}

async fn page(State(house): State<Arc<House>>, request: Request) -> Response {
    let ToShow { path, text, progress } = match request_of(&house, request).await {
        Ok(wanted) => wanted,
        Err(refused) => return refused,
    };
    let make = move |house: &House, stop: &Arc<AtomicBool>| {
        let file = match placed(house, path, text) {
            Ok(file) => file,
            Err(error) => return Ok(error.into_response()),
        };
        let work = house.progress.begin(progress);
        let EvaluatedPage { html, answer } =
            house.answers.page(&file, &|share| work.tell(share), stop)?;
        let internal = |error: String| Refusal::Internal(error);
        let name = house.pages.keep(&html).map_err(|error| internal(error.to_string()))?;
        let address = format!("api/page/{name}");
        let answer = answer.map(RawValue::from_string).transpose();
        let answer = answer.map_err(|error| internal(error.to_string()))?;
        Ok::<_, Refusal>(json(&PageToShow { html, address, answer }))
    };
    work(&house.makings, &house, make).await
}

/// The share that is done of a page that is being made; null where there is none of that name.
async fn progress(State(house): State<Arc<House>>, Path(name): Path<String>) -> Response {
    json(&serde_json::json!({ "share": house.progress.of(&name) }))
}

async fn shown(State(house): State<Arc<House>>, Path(name): Path<String>) -> Response {
    match house.pages.get(&name) {
        Some(html) => {
            let headers = [
                (header::CONTENT_TYPE, "text/html; charset=utf-8"),
                (header::CONTENT_SECURITY_POLICY, POLICY_OF_REPORTS),
            ];
            (headers, html.to_string()).into_response()
        }
        None => refusal(StatusCode::NOT_FOUND, "the page is not kept any more; make it again"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_downloads_hold_nothing_but_a_name() {
        let found = disposition("Größe \"1\"\r\nX: y.xlsx");
        let text = "attachment; filename=\"Gr__e__1___X__y.xlsx\"; \
                    filename*=UTF-8''Gr%C3%B6%C3%9Fe%20%221%22%0D%0AX%3A%20y.xlsx";
        assert_eq!(found.to_str().unwrap(), text);
    }
}
