//! The certificate as a document.

use super::layout::TitledSheet;
use super::sentences::{SentenceLanguage, SentencePlace};
use super::words::{self, Words, beside};
use super::{
    CertificateReport, administrative, conformity, file_name, functions, layout, measurement,
    sentences, sheets, stated, trials_made,
};
use crate::document::{Block, Document, Foot};
use crate::plain;
use gumption_analysis::certificate::contents::{DecimalMark, Language, Localized};
use gumption_engine::task::Trials;

/// The whole document.
pub(super) fn of(report: &CertificateReport<'_>) -> Document {
    let certificate = report.certificate;
    let languages = certificate.languages.as_slice();
    let mut document = Document {
        title: administrative::title(report),
        language: languages.first().map_or("en", |language| language.code()),
        comma: certificate.decimal_mark == DecimalMark::Comma,
        head: administrative::head(report),
        foot: Some(foot(report)),
        ..Document::default()
    };
    let about = administrative::sheet(report);
    if about.rows() > 0 {
        document.table(about);
    }
    document.section(beside(languages, |w| w.results));
    for TitledSheet { title, sheet } in layout::tables(report) {
        if !title.is_empty() {
            document.section(title);
        }
        document.table(sheet);
    }
    document.section(beside(languages, |w| w.uncertainty));
    for of in SentenceLanguage::on_page(report) {
        document.text_in(
            of.language.code(),
            sentences::coverage(report, of, SentencePlace::Table).join(" "),
        );
    }
    functions::sections(&mut document, report);
    if certificate.correlations && sheets::are_correlated(report) {
        document.section(beside(languages, |w| w.correlation));
        if certificate.lines.len() <= sheets::MOST_CORRELATED {
            document.table(sheets::correlations(report));
            let raised = stated::rows(report).iter().any(|row| row.is_raised());
            for language in languages {
                let words = words::of(*language);
                let more = if raised { words.correlated_raised } else { "" };
                let shared: Vec<String> =
                    report.issued.shared_inputs.iter().map(|name| plain(name)).collect();
                let shared = gumption_units::listed(&shared, words.and);
                let shared = words.shared.replace("{inputs}", &shared);
                document.text_in(
                    language.code(),
                    format!("{} {shared} {more}", words.correlated).trim_end(),
                );
            }
        } else {
            for language in languages {
                let rows = certificate.lines.len().to_string();
                let said = words::of(*language).many.replace("{rows}", &rows);
                document.text_in(language.code(), said);
            }
        }
    }
    if !conformity::decisions(report).is_empty() {
        document.section(beside(languages, |w| w.conformity));
        for of in SentenceLanguage::on_page(report) {
            document.list_in(of.language.code(), conformity::on_page(report, of));
        }
    }
    measurement::sections(&mut document, report);
    document.section(beside(languages, |w| w.remarks));
    for language in languages {
        document.list_in(language.code(), remarks(report, *language));
    }
    document.blocks.push(Block::Signature(signature(report).into()));
    document.section(beside(languages, |w| w.provenance));
    document.blocks.push(Block::List(provenance(report)));
    document.blocks.push(Block::End(beside(languages, |w| w.end)));
    document
}

/// The remarks in a language: the laboratory's own, and those required by ISO/IEC 17025.
pub(super) fn remarks(report: &CertificateReport<'_>, language: Language) -> Vec<String> {
    let languages = &report.certificate.languages;
    let remarks = report.certificate.administrative.remarks.iter();
    let remarks = remarks.filter_map(|remark| own(remark, language, languages)).map(plain);
    let asked = [words::of(language).relates, words::of(language).copies];
    remarks.chain(asked.into_iter().map(str::to_owned)).collect()
}

/// The text below the lines for signatures.
pub(super) fn signature(report: &CertificateReport<'_>) -> [String; 2] {
    let languages = &report.certificate.languages;
    let signer = report.certificate.administrative.responsible.as_ref().map(|name| plain(name));
    let [place, signature] = [0, 1].map(|place| beside(languages, |w| w.signed[place]));
    let signature = signer.map_or(signature.clone(), |name| format!("{signature}: {name}"));
    [place, signature]
}

/// The laboratory's remark in a language: its text in that language. A text that is the same in all
/// languages, or missing in all of them, appears with the first one.
fn own<'r>(remark: &'r Localized, language: Language, languages: &[Language]) -> Option<&'r str> {
    let written = |language: &Language| remark.texts.iter().any(|(of, _)| *of == Some(*language));
    let first = languages.first() == Some(&language);
    let stands = written(&language) || (first && !languages.iter().any(written));
    stands.then(|| remark.get(language))
}

/// Every page names the certificate and its page number (ISO/IEC 17025, 7.8.2.1 d).
fn foot(report: &CertificateReport<'_>) -> Foot {
    let languages = report.certificate.languages.as_slice();
    let about = match &report.certificate.administrative.number {
        Some(number) => format!("{}: {}", beside(languages, |w| w.number), plain(number)),
        None => administrative::title(report),
    };
    Foot { about, page: beside(languages, |w| w.page) }
}

/// Program, settings and digests.
pub(super) fn provenance(report: &CertificateReport<'_>) -> Vec<String> {
    let languages = report.certificate.languages.as_slice();
    let word = |word: fn(&Words) -> &'static str| beside(languages, word);
    let mut lines = vec![
        format!("{}: gumption {}", word(|w| w.program), env!("CARGO_PKG_VERSION")),
        format!("{}: {}", word(|w| w.certificate_file), report.digest),
    ];
    // folders are internal to the laboratory: the customer sees only names
    for (number, model) in report.models.iter().enumerate() {
        let name = plain(file_name(model.name));
        let mut line = format!("{} {name}, SHA-256: {}", word(|w| w.model_file), model.digest);
        let asked = report.certificate.evaluations.iter().find(|asked| asked.file == number);
        if let Some(settings) = asked.map(|asked| asked.task.settings) {
            let made = match trials_made::of_file(report, number) {
                None => "0".to_owned(),
                Some([least, most]) if least == most => least.to_string(),
                Some([least, most]) => format!("{least}\u{2013}{most}"),
            };
            let trials = match settings.trials {
                Trials::Fixed(_) => made,
                Trials::Adaptive => format!("{} ({made})", word(|w| w.adaptive)),
            };
            let (of_trials, of_seed) = (word(|w| w.trials), word(|w| w.seed));
            line += &format!("; {of_trials}: {trials}; {of_seed}: {}", settings.seed);
        }
        lines.push(line);
        lines.extend(model.files.iter().map(|(table, digest)| {
            let name = plain(file_name(table));
            format!("{} {name}, SHA-256: {digest}", word(|w| w.table))
        }));
    }
    lines
}
