//! The sentences required for a certificate's uncertainties.

use super::CertificateReport;
use super::stated::{self, StatedRow};
use super::words::{self, Words};
use crate::number::exact;
use crate::printed::with_comma;
use gumption_analysis::certificate::Basis;
use gumption_analysis::certificate::contents::{Certificate, DecimalMark, Language, Rounding};

/// The language of sentences, and the decimal mark of their numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct SentenceLanguage {
    pub(super) language: Language,
    pub(super) mark: DecimalMark,
}

impl SentenceLanguage {
    /// The languages of a page, whose numbers all have the same decimal mark.
    pub(super) fn on_page(report: &CertificateReport<'_>) -> Vec<Self> {
        let Certificate { languages, decimal_mark, .. } = report.certificate;
        languages.iter().map(|language| Self { language: *language, mark: *decimal_mark }).collect()
    }

    /// A language on its own, with its usual decimal mark, unless the certificate was explicitly
    /// given another one than that of its first language.
    pub(super) fn by_itself(report: &CertificateReport<'_>, language: Language) -> Self {
        let Certificate { languages, decimal_mark, .. } = report.certificate;
        let usual = languages.first().is_none_or(|first| first.decimal_mark() == *decimal_mark);
        Self { language, mark: if usual { language.decimal_mark() } else { *decimal_mark } }
    }

    pub(super) fn words(self) -> &'static Words {
        words::of(self.language)
    }

    /// Numbers with the decimal mark.
    pub(super) fn in_marks(self, numbers: &str) -> String {
        in_marks(self.mark, numbers)
    }
}

/// The presentation next to which the sentences appear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SentencePlace {
    /// A table, which contains the degrees of freedom.
    Table,
    /// Numbers in D-SI, which have a coverage probability for every factor, but no degrees of
    /// freedom.
    Dsi,
}

/// The statement of coverage in a language.
pub(super) fn coverage(
    report: &CertificateReport<'_>,
    of: SentenceLanguage,
    beside: SentencePlace,
) -> Vec<String> {
    let words = of.words();
    let rows = stated::rows(report);
    // the numbers of the rows with an agreed factor whose probability is stated as well
    let agreed: Vec<usize> = match beside {
        SentencePlace::Table => Vec::new(),
        SentencePlace::Dsi => {
            let groups = stated::groups(report).into_iter();
            let reaching = groups.filter(|rows| stated::reach_something(rows)).flatten();
            reaching.filter(|r| r.statement.basis == Basis::Fixed).map(|row| row.number).collect()
        }
    };
    let mut said = Vec::new();
    let mut say = |sentence: &str, holds: &dyn Fn(&StatedRow<'_>) -> bool| {
        let held = rows.iter().filter(|row| holds(row)).map(|row| row.number);
        let held: Vec<usize> = held.collect();
        match held.len() {
            0 => {}
            count if count == rows.len() => said.push(sentence.to_owned()),
            _ => said.push(about(&held, words) + sentence),
        }
    };
    let raised = |row: &StatedRow<'_>| row.is_raised();
    for kind in kinds(&rows, &agreed) {
        say(&kind.sentence(of), &|row| kind.holds(row, &agreed));
    }
    // an uncertainty equal to the laboratory's capability was neither evaluated nor confirmed in
    // this way
    say(words.propagation, &|row| !row.statement.of_distribution && !raised(row));
    for (probability, factor, is_about_95) in raised_to(&rows) {
        let template = words.raised[usize::from(probability.is_none())];
        let sentence = template.replace("{p}", &self::probability(of, probability));
        let of_factor = words.of_capability[usize::from(!is_about_95)];
        let of_factor = of_factor.replace("{k}", &of.in_marks(&factor));
        let sentence = sentence.replace("{factor}", &of_factor);
        say(&sentence, &|row| {
            let same = row.statement.coverage_probability == probability;
            let is_like = row.asked.task.settings.coverage.is_about_95() == is_about_95;
            raised(row) && same && is_like && row.factor().text == factor
        });
    }
    say(words.confirmed, &|row| {
        !raised(row) && row.found.validation.is_some_and(|v| v.gum_valid == Some(true))
    });
    if beside == SentencePlace::Dsi {
        said.extend(degrees_of_freedom(&rows, &agreed, of));
    }
    said.push(words.time.to_owned());
    said.push(rounding(report, words));
    let kept: Vec<usize> =
        rows.iter().filter(|row| row.is_kept(report)).map(|row| row.number).collect();
    match kept.len() {
        0 => {}
        count if count == rows.len() => said.push(words.kept.to_owned()),
        _ => said.push(about(&kept, words) + words.kept),
    }
    said
}

/// Numbers with a decimal mark; clauses of norms keep their points.
pub(super) fn in_marks(mark: DecimalMark, numbers: &str) -> String {
    match mark {
        DecimalMark::Point => numbers.to_owned(),
        DecimalMark::Comma => with_comma(numbers),
    }
}

/// The coverage probabilities and factors of rows whose uncertainty is the laboratory's capability,
/// and whether they refer to capabilities.
fn raised_to(rows: &[StatedRow<'_>]) -> Vec<(Option<f64>, String, bool)> {
    let mut found = Vec::new();
    for row in rows.iter().filter(|row| row.is_raised()) {
        let is_about_95 = row.asked.task.settings.coverage.is_about_95();
        let of = (row.statement.coverage_probability, row.factor().text, is_about_95);
        if !found.contains(&of) {
            found.push(of);
        }
    }
    found
}

/// The degrees of freedom of the rows whose factor or probability follows from them.
fn degrees_of_freedom(
    rows: &[StatedRow<'_>],
    agreed: &[usize],
    of: SentenceLanguage,
) -> Option<String> {
    let words = of.words();
    let follows = |row: &&StatedRow<'_>| {
        !row.is_raised() && (row.statement.basis == Basis::Student || agreed.contains(&row.number))
    };
    let one = |row: &StatedRow<'_>| {
        let dof = of.in_marks(&row.evaluated_dof().text);
        format!("{} {}: {dof}", words.row, row.number)
    };
    let listed: Vec<String> = rows.iter().filter(follows).map(one).collect();
    (!listed.is_empty()).then(|| words.dof_list.replace("{list}", &listed.join("; ")))
}

/// A kind of statement: rows of one kind share a sentence.
#[derive(Clone, Debug, PartialEq)]
struct SentenceKind {
    basis: Basis,
    probability: Option<f64>,
    /// Whether an interval is from figures without the noise of trials.
    without_trials: bool,
    /// The factor, if the sentence names it.
    factor: Option<String>,
    /// Whether an agreed factor is stated with its probability.
    agreed: bool,
}

impl SentenceKind {
    fn of(row: &StatedRow<'_>, agreed: &[usize]) -> Self {
        let named = matches!(row.statement.basis, Basis::Normal | Basis::Fixed);
        Self {
            basis: row.statement.basis,
            probability: row.statement.coverage_probability,
            without_trials: row.statement.without_trials,
            factor: named.then(|| row.factor().text),
            agreed: agreed.contains(&row.number),
        }
    }

    fn holds(&self, row: &StatedRow<'_>, agreed: &[usize]) -> bool {
        !row.is_raised() && Self::of(row, agreed) == *self
    }

    fn sentence(&self, of: SentenceLanguage) -> String {
        let words = of.words();
        let sentence = match self.basis {
            Basis::Normal => words.normal,
            Basis::Student => words.student,
            Basis::Fixed if self.agreed => words.agreed,
            Basis::Fixed => words.fixed,
            Basis::Shortest if self.without_trials => words.without_trials,
            Basis::Shortest => words.shortest,
        };
        let factor = of.in_marks(self.factor.as_deref().unwrap_or_default());
        sentence.replace("{k}", &factor).replace("{p}", &probability(of, self.probability))
    }
}

fn kinds(rows: &[StatedRow<'_>], agreed: &[usize]) -> Vec<SentenceKind> {
    let mut kinds: Vec<SentenceKind> = Vec::new();
    // a capability is not a multiple of an evaluated uncertainty
    let evaluated = rows.iter().filter(|row| !row.is_raised());
    for kind in evaluated.map(|row| SentenceKind::of(row, agreed)) {
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds
}

/// "approximately 95 %" for 0.9545, as accreditation practice prints it (EA-4/02, 5.1).
fn probability(of: SentenceLanguage, p: Option<f64>) -> String {
    match p {
        Some(0.9545) => of.words().approximately.replace("{p}", "95 %"),
        Some(p) => format!("{} %", of.in_marks(&exact(stated::percent_of_coverage(p)))),
        None => String::new(),
    }
}

/// "Rows 1, 2 and 5: "
pub(super) fn about(rows: &[usize], words: &Words) -> String {
    let [one, several] = words.rows;
    let beginning = if rows.len() == 1 { one } else { several };
    beginning.replace("{rows}", &listed(rows, words))
}

/// "1, 2 and 5"; consecutive rows as "1 - 4".
fn listed(rows: &[usize], words: &Words) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &row in rows {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == row => *last = row,
            _ => runs.push((row, row)),
        }
    }
    let mut parts: Vec<String> = Vec::new();
    for (first, last) in runs {
        match last - first {
            0 => parts.push(first.to_string()),
            1 => parts.extend([first.to_string(), last.to_string()]),
            _ => parts.push(format!("{first} to {last}").replace(" to ", "\u{2013}")),
        }
    }
    gumption_units::listed(&parts, words.and)
}

fn rounding(report: &CertificateReport<'_>, words: &Words) -> String {
    let digits = match report.certificate.digits {
        1 => words.digits[0].to_owned(),
        digits => words.digits[1].replace("{digits}", &digits.to_string()),
    };
    let rule = Rounding::ALL.iter().position(|rule| *rule == report.certificate.rounding);
    let rule = rule.map_or("", |rule| words.rules[rule]);
    words.rounding.replace("{digits}", &digits).replace("{rule}", rule)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_rows() {
        let words = words::of(Language::English);
        assert_eq!(listed(&[1], words), "1");
        assert_eq!(listed(&[1, 2], words), "1 and 2");
        assert_eq!(listed(&[1, 3, 4, 5, 9], words), "1, 3–5 and 9");
    }
}
