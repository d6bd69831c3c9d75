//! Formats errors: `FILE:LINE:COLUMN: message`, then the underlined place.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use gumption_text::{Diagnostic, DiagnosticKind, Diagnostics};

/// Longer lines are cut around the position.
const LONGEST: usize = 160;

/// Maximum number of errors shown: a list of a million faulty cells helps nobody.
const MOST: usize = 200;

/// All errors as text, with or without colours.
pub(crate) fn render(diagnostics: &Diagnostics, colours: bool) -> String {
    let renderer = if colours { Renderer::styled() } else { Renderer::plain() };
    let mut text: String =
        diagnostics.0.iter().take(MOST).map(|diagnostic| one(diagnostic, &renderer)).collect();
    if diagnostics.0.len() > MOST {
        let more = diagnostics.0.len() - MOST;
        text.push_str(&format!("and {more} more; `check --format json` lists them\n"));
    }
    text
}

/// The command that helps with an error, to follow its message.
pub(crate) fn command(kind: &DiagnosticKind) -> &'static str {
    match kind {
        DiagnosticKind::Outside { .. } => "; `--allow-path DIR` allows another folder",
        DiagnosticKind::SavedChanged { .. } => ", or accept it with `--accept-changed`",
        DiagnosticKind::MissingKey { key: "observations", .. } => {
            "; `gumption run` evaluates a model file without them"
        }
        DiagnosticKind::NoModel => "; `gumption models` lists typed models",
        DiagnosticKind::UnknownModel { nearest: None, .. } => "; `gumption models` lists them",
        DiagnosticKind::UnknownEffect { nearest: None, .. } => {
            "; `gumption models --effects` lists them"
        }
        DiagnosticKind::NotResult { .. } => "; `gumption run --save` writes one",
        _ => "",
    }
}

fn one(diagnostic: &Diagnostic, renderer: &Renderer) -> String {
    let mut text = format!("{diagnostic}{}\n", command(&diagnostic.kind));
    let source = &diagnostic.source.text;
    let (line, _) = diagnostic.position();
    let start =
        source.get(..diagnostic.span.start).and_then(|b| b.rfind('\n')).map_or(0, |n| n + 1);
    let Some(content) = source.get(start..).and_then(|rest| rest.lines().next()) else {
        return text;
    };
    if content.trim().is_empty() {
        return text;
    }
    // a range over several lines is underlined on its first
    let from = (diagnostic.span.start - start).min(content.len());
    let to = diagnostic.span.end.saturating_sub(start).clamp(from, content.len());
    let (content, from, to) = cut(content, from, to);
    let label = match diagnostic.kind.suggestion() {
        Some(suggestion) => format!("did you mean `{suggestion}`?"),
        None => String::new(),
    };
    let mut annotation = AnnotationKind::Primary.span(from..to);
    if !label.is_empty() {
        annotation = annotation.label(label);
    }
    let snippet = Snippet::source(content).line_start(line).annotation(annotation);
    text.push_str(&renderer.render(&[Group::with_level(Level::ERROR).element(snippet)]));
    text.push('\n');
    text
}

/// The part of a long line around the position.
fn cut(line: &str, from: usize, to: usize) -> (&str, usize, usize) {
    if line.len() <= LONGEST {
        return (line, from, to);
    }
    let boundary = |mut at: usize| {
        while !line.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let first = boundary(from.saturating_sub(LONGEST / 2));
    let last = boundary((first + LONGEST).min(line.len()));
    let to = boundary(to.min(last));
    let part = line.get(first..last).unwrap_or(line);
    (part, from - first, to.max(from) - first)
}
