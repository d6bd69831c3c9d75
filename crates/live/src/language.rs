//! The language of the page's messages.

use gumption_report::PageParts;
use serde::Deserialize;

use crate::german::{self, RowNames};

/// The languages of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Language {
    /// English, the language of the reports.
    #[default]
    En,
    /// German.
    De,
}

impl Language {
    /// Markup of a report in this language.
    pub(crate) fn part(self, html: String, names: RowNames) -> String {
        match self {
            Self::En => html,
            Self::De => german::part(&html, names),
        }
    }

    /// The parts of a page in this language.
    pub(crate) fn parts(self, mut parts: PageParts) -> PageParts {
        for output in &mut parts.outputs {
            for of_file in [&mut output.verdict, &mut output.budget] {
                *of_file = self.part(std::mem::take(of_file), RowNames::OfFile);
            }
            for own in [&mut output.conclusions, &mut output.comparison, &mut output.distribution] {
                *own = self.part(std::mem::take(own), RowNames::OfReport);
            }
        }
        parts.together = self.part(parts.together, RowNames::OfFile);
        parts
    }

    /// A note on an evaluation in this language.
    pub(crate) fn note(self, text: String) -> String {
        match self {
            Self::En => text,
            Self::De => german::note(&text),
        }
    }
}
