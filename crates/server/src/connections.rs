//! Connections, limited in number.
//!
//! A client that connects and sends nothing, or sends slowly, loses its place: to the time limit,
//! or earlier to a new client. Only requests with a valid secret keep the place.

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

/// Maximum number of connections. A browser uses six, and one more for the events of each page.
const MOST: usize = 200;

/// Time limit for the headers of a request, and for an idle connection.
const HEADERS: Duration = Duration::from_secs(10);

/// Maximum size of the headers of a request, in bytes.
const MOST_HEADERS: usize = 64 << 10;

#[derive(Debug)]
struct Connection {
    task: AbortHandle,
    proven: Proven,
}

/// The open connections, the oldest first.
#[derive(Debug)]
pub(crate) struct Connections {
    routes: Router,
    open: Vec<Connection>,
}

impl Connections {
    pub(crate) fn new(routes: Router) -> Self {
        Self { routes, open: Vec::new() }
    }

    /// Serves a new connection, if necessary instead of the oldest one that has not proven its
    /// secret.
    pub(crate) fn serve(&mut self, stream: TcpStream) {
        self.open.retain(|connection| !connection.task.is_finished());
        if self.open.len() >= MOST {
            let unproven = |of: &Connection| !of.proven.0.load(Ordering::Relaxed);
            match self.open.iter().position(unproven) {
                Some(oldest) => self.open.remove(oldest).task.abort(),
                None => return,
            }
        }
        // small answers must not wait for more data
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
            // an error is the client's, which notices it itself
            let _ = connection.await;
        });
        self.open.push(Connection { task: task.abort_handle(), proven });
    }

    /// Ends all.
    pub(crate) fn close(&mut self) {
        self.open.drain(..).for_each(|connection| connection.task.abort());
    }
}
