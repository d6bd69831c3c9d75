//! Progress without a terminal and a clock, as in a browser: none.

/// An invisible progress bar.
#[derive(Debug)]
pub(super) struct NoBar;

impl NoBar {
    pub(super) fn inc(&self, _: u64) {}

    pub(super) fn finish_and_clear(&self) {}
}

pub(super) fn counted(_: u64, _: &str, _: bool) -> NoBar {
    NoBar
}

pub(super) fn bar(_: Option<u64>, _: bool) -> NoBar {
    NoBar
}

pub(super) fn share(_: bool) -> NoBar {
    NoBar
}

pub(super) fn tell(_: &NoBar, _: f64) {}
