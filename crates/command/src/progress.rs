//! Progress on the terminal.

use std::fmt::Write;
use std::io::IsTerminal;
use std::time::Duration;

use super::surroundings::in_call;
use gumption_engine::parallel;
use gumption_report::grouped;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

/// Maximum time between two updates of a bar.
const TICK: Duration = Duration::from_millis(200);

/// A bar that counts examples, diagnoses or other slow steps.
pub(super) fn counted(count: u64, things: &str, quiet: bool) -> ProgressBar {
    let template = format!("{{bar:30}} {{pos}} of {{len}} {things}, {{left}} left");
    styled(bar(Some(count), quiet), &template)
}

/// A bar on standard error, hidden if that is no terminal or with `--quiet`; a count if the number
/// of trials is unknown.
pub(super) fn bar(trials: Option<u64>, quiet: bool) -> ProgressBar {
    let hidden = quiet || in_call(|_| ()).is_some() || !std::io::stderr().is_terminal();
    let target =
        if hidden { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(10) };
    let bar = ProgressBar::with_draw_target(trials, target);
    // without its thread the bar still works
    if !hidden && parallel::spare_thread().is_ok() {
        // before the first step is done, and during a long one
        bar.enable_steady_tick(TICK);
    }
    let look = match trials {
        Some(_) => "{bar:30} {percent:>3} %  {made} of {all} trials, {rate}/s, {left} left",
        None => "{spinner} {made} trials, {rate}/s",
    };
    styled(bar, look)
}

fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    // an invalid template leaves the usual bar
    if let Ok(style) = ProgressStyle::with_template(template) {
        // digits in groups, as on every page
        let style = style
            .with_key("made", |state: &ProgressState, out: &mut dyn Write| {
                let _ = out.write_str(&grouped(state.pos()));
            })
            .with_key("all", |state: &ProgressState, out: &mut dyn Write| {
                let _ = out.write_str(&grouped(state.len().unwrap_or(0)));
            })
            .with_key("left", |state: &ProgressState, out: &mut dyn Write| {
                // the rate is unknown before the first step
                let _ = match state.pos() {
                    0 => out.write_str("?"),
                    _ => write!(out, "{:#}", HumanDuration(state.eta())),
                };
            })
            .with_key("rate", |state: &ProgressState, out: &mut dyn Write| {
                let _ = out.write_str(&grouped(state.per_sec() as u64));
            });
        bar.set_style(style);
    }
    bar
}

/// Number of steps of the bar of a share.
const PARTS: u64 = 1000;

/// A bar of the completed fraction, hidden if standard error is no terminal or with `--quiet`.
pub(super) fn share(quiet: bool) -> ProgressBar {
    styled(bar(Some(PARTS), quiet), "{bar:30} {percent:>3} %  {elapsed}")
}

/// Advances a bar of a fraction; it never goes back.
pub(super) fn tell(bar: &ProgressBar, share: f64) {
    let position = (share.clamp(0.0, 1.0) * PARTS as f64) as u64;
    bar.set_position(position.max(bar.position()));
}
