//! The server as a whole.

use std::fmt;
use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use tokio::sync::Semaphore;
use tokio::time::{sleep, timeout};

use super::answers::Answers;
use super::connections::Connections;
use super::folder::OpenedFolder;
use super::lane::{Lane, Limits};
use super::memory;
use super::routes::routes;
use super::shown_pages::ShownPages;
use super::token::Token;
use super::watch::{self, Watch};

/// How often the flag that ends the server is looked at.
const ATTENTION: Duration = Duration::from_millis(100);

/// How long computations may take to end with the server.
const FAREWELL: Duration = Duration::from_secs(3);

/// Requests that are read into memory at once.
const BODIES: usize = 8;

/// Threads for work that waits or computes: those of the lanes, and one that looks at files.
const THREADS: usize = CALLS.at_once + MAKINGS.at_once + DISK.at_once + 1;

/// How long requests may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RequestTimes {
    /// An answer of the page: what there is by then is the answer.
    pub answer: Duration,
    /// An export, or a page of a report.
    pub export: Duration,
    /// How long either may go on after it was stopped before it is given up.
    pub grace: Duration,
}

impl Default for RequestTimes {
    /// A minute, five minutes, 20 seconds.
    fn default() -> Self {
        Self { answer: Duration::from_secs(60), export: Duration::from_secs(300), grace: GRACE }
    }
}

/// How long work goes on after it was stopped, at most.
const GRACE: Duration = Duration::from_secs(20);

/// What follows the hand of the user: the newest counts.
const CALLS: Limits = Limits {
    at_once: 4,
    waiting: 32,
    time: Duration::from_secs(60),
    grace: GRACE,
    patience: Duration::from_secs(30),
    newest_first: true,
};

/// Exports and pages, for which somebody waits.
const MAKINGS: Limits = Limits {
    at_once: 2,
    waiting: 8,
    time: Duration::from_secs(300),
    grace: GRACE,
    patience: Duration::from_secs(60),
    newest_first: false,
};

/// Files of the folder.
const DISK: Limits = Limits {
    at_once: 4,
    waiting: 64,
    time: Duration::from_secs(30),
    grace: GRACE,
    patience: Duration::from_secs(30),
    newest_first: false,
};

/// What a server is started with.
#[derive(Clone)]
pub struct ServerOptions {
    /// The port; 0 for a free one.
    pub port: u16,
    /// The files.
    pub folder: OpenedFolder,
    /// The language of the page, where one is wished.
    pub language: Option<&'static str>,
    /// What answers.
    pub answers: Arc<dyn Answers>,
    /// How long requests may take.
    pub times: RequestTimes,
}

impl fmt::Debug for ServerOptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("ServerOptions");
        shown.field("port", &self.port).field("folder", &self.folder).finish_non_exhaustive()
    }
}

/// What requests have to do with.
pub(crate) struct House {
    port: u16,
    /// That of the address, which opens the door and is nowhere else.
    pub(crate) token: Token,
    /// The cookie's, which every port of the machine may get to see.
    pub(crate) cookie: Token,
    /// The page's own, without which nothing is asked or written.
    pub(crate) page: Token,
    /// Opens the door once, for the browser that is started.
    pub(crate) launch: Mutex<Option<Token>>,
    pub(crate) folder: OpenedFolder,
    pub(crate) language: Option<&'static str>,
    pub(crate) answers: Arc<dyn Answers>,
    pub(crate) watch: Watch,
    pub(crate) calls: Lane,
    pub(crate) makings: Lane,
    pub(crate) disk: Lane,
    pub(crate) bodies: Semaphore,
    pub(crate) pages: ShownPages,
}

impl House {
    /// The names that this server has in requests.
    pub(crate) fn hosts(&self) -> Vec<String> {
        let names = ["127.0.0.1", "localhost"];
        let mut hosts: Vec<String> =
            names.iter().map(|name| format!("{name}:{}", self.port)).collect();
        // the port of the protocol itself is left out by browsers
        if self.port == 80 {
            hosts.extend(names.map(str::to_owned));
        }
        hosts
    }

    /// The name of the cookie; cookies are one jar for all ports of a machine.
    pub(crate) fn cookie_name(&self) -> String {
        format!("gumption-{}", self.port)
    }
}

/// A server on the loopback interface, bound and not yet running.
pub struct LocalServer {
    listener: TcpListener,
    house: Arc<House>,
    launch: String,
}

impl fmt::Debug for LocalServer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LocalServer").field("port", &self.house.port).finish_non_exhaustive()
    }
}

impl LocalServer {
    /// Takes the port; nobody but programs of this machine can reach it.
    ///
    /// # Errors
    /// A port that is taken or not allowed; no random numbers from the system.
    pub fn bind(options: ServerOptions) -> io::Result<Self> {
        let ServerOptions { port, folder, language, answers, times } = options;
        let RequestTimes { answer, export, grace } = times;
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        listener.set_nonblocking(true)?;
        let launch = Token::new()?;
        let text = launch.text().to_owned();
        let house = House {
            port: listener.local_addr()?.port(),
            token: Token::new()?,
            cookie: Token::new()?,
            page: Token::new()?,
            launch: Mutex::new(Some(launch)),
            watch: Watch::new(folder.clone()),
            folder,
            language,
            answers,
            calls: Lane::new(Limits { time: answer, grace, ..CALLS }),
            makings: Lane::new(Limits { time: export, grace, ..MAKINGS }),
            disk: Lane::new(DISK),
            bodies: Semaphore::new(BODIES),
            pages: ShownPages::default(),
        };
        Ok(Self { listener, house: Arc::new(house), launch: text })
    }

    fn with(&self, token: &str) -> String {
        format!("http://127.0.0.1:{}/?token={token}", self.house.port)
    }

    /// The address with the token, for the user's eyes.
    pub fn address(&self) -> String {
        self.with(self.house.token.text())
    }

    /// An address that is good for one visit, for a browser that is started with it: the arguments of
    /// programs can be read by other users of the machine.
    pub fn launch_address(&self) -> String {
        self.with(&self.launch)
    }

    /// Serves until the flag is set. With glibc, memory of 1 MiB and more is mapped for itself in the
    /// whole process from here on, so that an idle server holds none of it.
    ///
    /// # Errors
    /// Threads or system resources that cannot be had.
    pub fn run(self, stop: &AtomicBool) -> io::Result<()> {
        // tokio, where it gets no thread, would end the process in the middle of a request
        std::thread::Builder::new().spawn(|| ())?;
        memory::return_large_arrays();
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_io()
            .enable_time()
            .max_blocking_threads(THREADS)
            .thread_keep_alive(Duration::from_secs(5))
            .build()?;
        let house = Arc::clone(&self.house);
        let served = runtime.block_on(self.serve(stop));
        for lane in [&house.calls, &house.makings, &house.disk] {
            lane.stop();
        }
        runtime.shutdown_timeout(FAREWELL);
        served
    }

    async fn serve(self, stop: &AtomicBool) -> io::Result<()> {
        let listener = tokio::net::TcpListener::from_std(self.listener)?;
        let mut connections = Connections::new(routes(&self.house));
        tokio::spawn(look(Arc::clone(&self.house)));
        while !stop.load(Ordering::Relaxed) {
            match timeout(ATTENTION, listener.accept()).await {
                Err(_) => {}
                Ok(Ok((stream, _))) => connections.serve(stream),
                // one that has hung up already, or no more files for this process: others go on
                Ok(Err(_)) => sleep(ATTENTION).await,
            }
        }
        connections.close();
        Ok(())
    }
}

/// Looks at the files of the page while somebody listens.
async fn look(house: Arc<House>) {
    loop {
        sleep(watch::EVERY).await;
        if house.watch.listeners() > 0 {
            let house = Arc::clone(&house);
            let _ = tokio::task::spawn_blocking(move || house.watch.look()).await;
        }
    }
}
