//! Connections, so many at once.
//!
//! Whoever connects and says nothing, or says it slowly, loses his place: to the time limit, and
//! before that to whoever comes new. Only requests of those who may ask keep it.

use std::sync::atomic::Ordering;
use std::time::Duration;

use axum::Router;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpStream;
use tokio::task::AbortHandle;

use super::doorkeeper::Proven;

/// Connections at once. A browser has six, and another for each page's events.
const MOST: usize = 200;

/// How long the headers of a request may take, and how long a connection may be idle.
const HEADERS: Duration = Duration::from_secs(10);

/// Bytes that the headers of a request may have.
const MOST_HEADERS: usize = 64 << 10;

#[derive(Debug)]
struct Connection {
    task: AbortHandle,
    proven: Proven,
}

/// The connections that are open, the oldest first.
#[derive(Debug)]
pub(crate) struct Connections {
    routes: Router,
    open: Vec<Connection>,
}

impl Connections {
    pub(crate) fn new(routes: Router) -> Self {
        Self { routes, open: Vec::new() }
    }

    /// Serves a new one, if need be in place of the oldest that has proven nothing.
    pub(crate) fn serve(&mut self, stream: TcpStream) {
        self.open.retain(|connection| !connection.task.is_finished());
        if self.open.len() >= MOST {
            let unproven = |of: &Connection| !of.proven.0.load(Ordering::Relaxed);
            match self.open.iter().position(unproven) {
                Some(oldest) => self.open.remove(oldest).task.abort(),
                None => return,
            }
        }
        // small answers are not to wait for more
        let _ = stream.set_nodelay(true);
        let proven = Proven::default();
        let routes = TowerToHyperService::new(self.routes.clone());
        let of_this = proven.clone();
        let service = service_fn(move |mut request: hyper::Request<Incoming>| {
            request.extensions_mut().insert(of_this.clone());
            routes.call(request)
        });
        let mut http = http1::Builder::new();
        http.timer(TokioTimer::new()).header_read_timeout(HEADERS).max_buf_size(MOST_HEADERS);
        let connection = http.serve_connection(TokioIo::new(stream), service);
        let task = tokio::spawn(async move {
            // an error is that of the other side, who hears of it himself
            let _ = connection.await;
        });
        self.open.push(Connection { task: task.abort_handle(), proven });
    }

    /// Ends all.
    pub(crate) fn close(&mut self) {
        self.open.drain(..).for_each(|connection| connection.task.abort());
    }
}
