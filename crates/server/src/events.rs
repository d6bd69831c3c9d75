//! Sends changes on the disk to the page as events (server-sent events).

use std::convert::Infallible;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;

use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use hyper::body::{Body as HttpBody, Frame};
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::mpsc;
use tokio::time::timeout;

use super::routes::refusal;
use super::server::House;

/// Pages that listen, at most.
const MOST: usize = 32;

/// Interval of messages without an event, which reveal closed connections.
const HEARTBEAT: Duration = Duration::from_secs(5);

/// Maximum number of events that wait for a slow reader.
const WAITING: usize = 8;

/// A body that is sent piece by piece.
struct Stream(mpsc::Receiver<Bytes>);

impl HttpBody for Stream {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        self.0.poll_recv(context).map(|bytes| bytes.map(|bytes| Ok(Frame::data(bytes))))
    }
}

/// `GET /api/events`
pub(crate) async fn events(State(house): State<Arc<House>>) -> Response {
    if house.watch.listeners() >= MOST {
        let message = "too many pages listen already; close some of them";
        return refusal(StatusCode::SERVICE_UNAVAILABLE, message);
    }
    let mut changes = house.watch.listen();
    let (sender, receiver) = mpsc::channel(WAITING);
    tokio::spawn(async move {
        let mut event = Bytes::from_static(b": watching\n\n");
        while sender.send(event).await.is_ok() {
            event = match timeout(HEARTBEAT, changes.recv()).await {
                Err(_) | Ok(Err(RecvError::Lagged(_))) => Bytes::from_static(b":\n\n"),
                Ok(Err(RecvError::Closed)) => return,
                Ok(Ok(change)) => {
                    let Ok(data) = serde_json::to_string(&change) else { return };
                    Bytes::from(format!("event: changed\ndata: {data}\n\n"))
                }
            };
        }
    });
    let kind = [(header::CONTENT_TYPE, "text/event-stream")];
    (kind, Body::new(Stream(receiver))).into_response()
}
