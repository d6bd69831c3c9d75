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
use super::progress::Progress;
use super::routes::routes;
use super::shown_pages::ShownPages;
use super::token::Token;
use super::watch::{self, Watch};

/// How often the flag that ends the server is checked.
const ATTENTION: Duration = Duration::from_millis(100);

/// How long computations may take to end when the server stops.
const FAREWELL: Duration = Duration::from_secs(3);

/// Maximum number of request bodies in memory at the same time.
const BODIES: usize = 8;

/// Threads that wait or compute: those of the lanes, and one that examines files.
const THREADS: usize = CALLS.at_once + MAKINGS.at_once + DISK.at_once + 1;

/// Time limits of requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RequestTimes {
    /// Time limit for an answer to the page, which contains what is computed by then.
    pub answer: Duration,
    /// Time limit for an export or a report page.
    pub export: Duration,
    /// How long either may continue after the stop before it is abandoned.
    pub grace: Duration,
}

impl Default for RequestTimes {
    /// A minute, five minutes, 20 seconds.
    fn default() -> Self {
        Self { answer: Duration::from_secs(60), export: Duration::from_secs(300), grace: GRACE }
    }
}

/// How long work may continue after the stop, at most.
const GRACE: Duration = Duration::from_secs(20);

/// Calls that follow the user's typing: the newest has priority.
const CALLS: Limits = Limits {
    at_once: 4,
    waiting: 32,
    time: Duration::from_secs(60),
    grace: GRACE,
    patience: Duration::from_secs(30),
    newest_first: true,
};

/// Exports and pages that the user waits for.
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

/// Options of a server.
#[derive(Clone)]
pub struct ServerOptions {
    /// The port; 0 for a free one.
    pub port: u16,
    /// The files.
    pub folder: OpenedFolder,
    /// The language of the page, if one is chosen.
    pub language: Option<&'static str>,
    /// What answers.
    pub answers: Arc<dyn Answers>,
    /// Time limits of requests.
    pub times: RequestTimes,
}

impl fmt::Debug for ServerOptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("ServerOptions");
        shown.field("port", &self.port).field("folder", &self.folder).finish_non_exhaustive()
    }
}

/// The state that requests share.
pub(crate) struct House {
    port: u16,
    /// The secret of the address, which gives access and is stored nowhere else.
    pub(crate) token: Token,
    /// The secret in the cookie, which every port of the machine may see.
    pub(crate) cookie: Token,
    /// The secret of the page, which calls and writing require.
    pub(crate) page: Token,
    /// Gives access once, to the browser that is started.
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
    pub(crate) progress: Progress,
}

impl House {
    /// The names of this server in requests.
    pub(crate) fn hosts(&self) -> Vec<String> {
        let names = ["127.0.0.1", "localhost"];
        let mut hosts: Vec<String> =
            names.iter().map(|name| format!("{name}:{}", self.port)).collect();
        // browsers leave out the default port of the protocol
        if self.port == 80 {
            hosts.extend(names.map(str::to_owned));
        }
        hosts
    }

    /// The name of the cookie; all ports of a machine share their cookies.
    pub(crate) fn cookie_name(&self) -> String {
        format!("gumption-{}", self.port)
    }
}

/// A server bound to the loopback interface, not yet running.
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
    /// Binds the port; only programs of this machine can reach it.
    ///
    /// # Errors
    /// The port is in use or not allowed, or the system gives no random numbers.
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
            progress: Progress::default(),
        };
        Ok(Self { listener, house: Arc::new(house), launch: text })
    }

    fn with(&self, token: &str) -> String {
        format!("http://127.0.0.1:{}/?token={token}", self.house.port)
    }

    /// The address with the token, to show to the user.
    pub fn address(&self) -> String {
        self.with(self.house.token.text())
    }

    /// An address for one visit, for a browser that is started with it: other users of the machine
    /// can read the arguments of programs.
    pub fn launch_address(&self) -> String {
        self.with(&self.launch)
    }

    /// Serves until the flag is set. With glibc, from here on the whole process maps memory of 1
    /// MiB and more separately, so that an idle server holds none of it.
    ///
    /// # Errors
    /// Threads or system resources are not available.
    pub fn run(self, stop: &AtomicBool) -> io::Result<()> {
        // tokio would end the process in the middle of a request if it cannot start a thread
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
                // a client that has disconnected already, or no more file handles: continue with
                // others
                Ok(Err(_)) => sleep(ATTENTION).await,
            }
        }
        connections.close();
        Ok(())
    }
}

/// Watches the files of the page while a client listens.
async fn look(house: Arc<House>) {
    loop {
        sleep(watch::EVERY).await;
        if house.watch.listeners() > 0 {
            let house = Arc::clone(&house);
            let _ = tokio::task::spawn_blocking(move || house.watch.look()).await;
        }
    }
}
