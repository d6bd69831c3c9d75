//! The reports of the page in its language.

use gumption_report::PageParts;
use gumption_report::words::Language;

use crate::german::{self, RowNames};

/// Markup of a report in a language.
pub(crate) fn part(html: String, names: RowNames, language: Language) -> String {
    match language {
        Language::English => html,
        Language::German => german::part(&html, names),
    }
}

/// The parts of a page in a language.
pub(crate) fn parts(mut parts: PageParts, language: Language) -> PageParts {
    let said = |html: &mut String, names| *html = part(std::mem::take(html), names, language);
    for output in &mut parts.outputs {
        said(&mut output.verdict, RowNames::OfFile);
        said(&mut output.budget, RowNames::OfFile);
        said(&mut output.conclusions, RowNames::OfReport);
        said(&mut output.comparison, RowNames::OfReport);
        said(&mut output.distribution, RowNames::OfReport);
    }
    said(&mut parts.together, RowNames::OfFile);
    parts
}
