//! What the columns of results are called: by their symbols, or by the words that budgets have for them.

use super::party;
use crate::import::columns::{self, Column};
use crate::import::coverage::HeaderCoverage;
use crate::import::heading::unit_of_header;
use gumption_text::column_heading;
use gumption_text::deviation_words::{DEVIATIONS, ERRORS};
use gumption_units::{Unit, nearest};

/// What a column holds. The number is that of the result in a row of two, or 0 in a table of laboratories.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Label,
    Value(u8),
    Expanded(u8),
    Standard(u8),
    Factor(u8),
    Correlation,
    Dof,
    Unit,
}

/// What a heading says.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum HeadingMeaning {
    /// What its column holds, and whether by its symbol.
    Role(Role, bool),
    /// That it is an uncertainty of these results, and not of which kind.
    SomeUncertainty(u8),
    /// That it is an error or a deviation, which is a result where no other column is one.
    Deviation(u8),
    /// Nothing that is known.
    Nothing,
}

/// Words for laboratories beside those that budgets have for quantities.
const LABORATORIES: [&str; 22] = [
    "lab",
    "lab code",
    "lab name",
    "laboratory",
    "laboratory code",
    "labor",
    "laboratorium",
    "laboratoire",
    "participant",
    "participating laboratory",
    "teilnehmer",
    "institute",
    "institut",
    "institution",
    "nmi",
    "code",
    "id",
    "sample",
    "measurand",
    "device",
    "prüfling",
    "messgröße",
];

/// Words for points of a measurement, which label pairs where no other column does.
const POINTS: [&str; 20] = [
    "artefact",
    "artifact",
    "point",
    "points",
    "test point",
    "measuring point",
    "measurement point",
    "calibration point",
    "item",
    "no",
    "nr",
    "run",
    "punkt",
    "messpunkt",
    "kalibrierpunkt",
    "prüfpunkt",
    "messstelle",
    "point de mesure",
    "point d'étalonnage",
    "position",
];

/// Whether a heading is that of points of a measurement.
pub(super) fn is_of_points(heading: &str) -> bool {
    POINTS.contains(&columns::plain(heading).as_str())
}

/// Words for results beside those that budgets have for estimates.
const VALUES: [&str; 13] = [
    "result",
    "results",
    "lab result",
    "measured value",
    "measurement result",
    "reported value",
    "reported result",
    "ergebnis",
    "messergebnis",
    "messwert",
    "résultat",
    "valeur mesurée",
    "x_i",
];

/// Symbols and words in brackets behind the name of a column that are none of its unit.
const SYMBOLS: [&str; 16] = [
    "x",
    "X",
    "xi",
    "x_i",
    "y",
    "yi",
    "y_i",
    "u",
    "U",
    "k",
    "u_i",
    "ui",
    "Ui",
    "U_i",
    "mean",
    "Mittelwert",
];

/// Whether the label of a row is that of a reference value or of a mean of results; `Reference
/// laboratory` is a laboratory.
pub(super) fn is_reference(label: &str) -> bool {
    const REFERENCES: [&str; 22] = [
        "consensus",
        "consensus value",
        "konsenswert",
        "valeur de consensus",
        "valeur assignée",
        "zugewiesener wert",
        "crv",
        "scrv",
        "reference",
        "ref",
        "reference value",
        "ref. value",
        "ref value",
        "assigned value",
        "kcrv",
        "x_ref",
        "xref",
        "referenz",
        "referenzwert",
        "bezugswert",
        "référence",
        "valeur de référence",
    ];
    let words = columns::plain(label);
    REFERENCES.contains(&words.as_str()) || is_mean(&words)
}

/// Whether plain words name a mean of results: `mean`, `weighted mean`, `pilot mean`, `mean of all`,
/// `moyenne pondérée`. A name that begins with such a word may be that of a laboratory.
fn is_mean(words: &str) -> bool {
    const MEANS: [&str; 13] = [
        "mean",
        "average",
        "median",
        "mittelwert",
        "mittel",
        "mittelwerte",
        "moyenne",
        "médiane",
        "mediane",
        "mediana",
        "kcrv",
        "crv",
        "consensus",
    ];
    // the noun comes first, with what it is of behind it
    const BEGINNINGS: [&str; 10] = [
        "mean value",
        "mean of ",
        "mean all",
        "average value",
        "average of ",
        "average all",
        "median of ",
        "mittelwert ",
        "moyenne ",
        "valeur moyenne",
    ];
    const WHOLE: [&str; 6] =
        ["media", "media ponderata", "media pesata", "valore medio", "x_mean", "xmean"];
    let last = words.rsplit([' ', '-', '_']).next().unwrap_or_default();
    MEANS.contains(&last)
        || WHOLE.contains(&words)
        || BEGINNINGS.iter().any(|beginning| words.starts_with(beginning))
}

/// What a heading says.
pub(super) fn said(heading: &str) -> HeadingMeaning {
    let plain = || said_of_any(heading);
    let Some((party, rest)) = party::split(heading) else { return plain() };
    match said_of_any(&rest) {
        HeadingMeaning::Role(Role::Value(0), _) => HeadingMeaning::Role(Role::Value(party), false),
        HeadingMeaning::Role(Role::Expanded(0), _) => {
            HeadingMeaning::Role(Role::Expanded(party), false)
        }
        HeadingMeaning::Role(Role::Standard(0), _) => {
            HeadingMeaning::Role(Role::Standard(party), false)
        }
        HeadingMeaning::Role(Role::Factor(0), _) => {
            HeadingMeaning::Role(Role::Factor(party), false)
        }
        HeadingMeaning::SomeUncertainty(0) => HeadingMeaning::SomeUncertainty(party),
        HeadingMeaning::Deviation(0) => HeadingMeaning::Deviation(party),
        _ => plain(),
    }
}

/// Whether a heading says in words whose results they are.
pub(super) fn is_of_party(heading: &str) -> bool {
    party::split(heading).is_some()
}

/// A heading without words that say whose results they are, which say nothing of units and coverage.
fn without_party(heading: &str) -> String {
    let is_party =
        party::split(heading).filter(|(_, rest)| said_of_any(rest) != HeadingMeaning::Nothing);
    is_party.map_or_else(|| heading.to_owned(), |(_, rest)| rest)
}

/// What a heading says, whosever results they are.
fn said_of_any(heading: &str) -> HeadingMeaning {
    let name = name(heading);
    let (stem, of) = numbered(&name);
    let role = match stem {
        "x" | "X" => Some(Role::Value(of)),
        "U" => Some(Role::Expanded(of)),
        "u" => Some(Role::Standard(of)),
        "k" | "K" => Some(Role::Factor(of)),
        "r" if of == 0 => Some(Role::Correlation),
        _ => None,
    };
    if let Some(role) = role {
        return HeadingMeaning::Role(role, true);
    }
    if of_symbol(&name).is_some() {
        return HeadingMeaning::Role(Role::Expanded(0), true);
    }
    let words = columns::plain(&name);
    if words == "label" {
        return HeadingMeaning::Role(Role::Label, true);
    }
    if LABORATORIES.contains(&words.as_str()) {
        return HeadingMeaning::Role(Role::Label, false);
    }
    if VALUES.contains(&words.as_str()) {
        return HeadingMeaning::Role(Role::Value(0), false);
    }
    let is_from = ["deviation from ", "abweichung vom ", "abweichung von ", "écart à "];
    let is_deviation = |word: &&str| *word == words.as_str();
    if ERRORS.iter().chain(&DEVIATIONS).any(is_deviation)
        || is_from.iter().any(|start| words.starts_with(start))
    {
        return HeadingMeaning::Deviation(0);
    }
    if words.contains("correlation coefficient") || words.contains("korrelationskoeffizient") {
        return HeadingMeaning::Role(Role::Correlation, false);
    }
    match columns::column(heading) {
        Some(Column::Quantity) => HeadingMeaning::Role(Role::Label, false),
        Some(Column::Estimate) => HeadingMeaning::Role(Role::Value(0), false),
        Some(Column::Unit) => HeadingMeaning::Role(Role::Unit, false),
        Some(Column::Dof) => HeadingMeaning::Role(Role::Dof, false),
        Some(Column::Standard | Column::Deviation) => {
            HeadingMeaning::Role(Role::Standard(0), false)
        }
        Some(Column::Factor) => HeadingMeaning::Role(Role::Factor(0), false),
        Some(of) if Column::WIDTHS.contains(&of) => match coverage_of_any(heading) {
            HeaderCoverage::None => HeadingMeaning::SomeUncertainty(0),
            HeaderCoverage::Factor(1.0) => HeadingMeaning::Role(Role::Standard(0), false),
            _ => HeadingMeaning::Role(Role::Expanded(0), false),
        },
        _ => HeadingMeaning::Nothing,
    }
}

/// The stem of `U1` and of `U_1`, and its number.
fn numbered(name: &str) -> (&str, u8) {
    for (number, of) in [('1', 1), ('2', 2)] {
        if let Some(stem) = name.strip_suffix(number) {
            return (stem.strip_suffix('_').unwrap_or(stem), of);
        }
    }
    (name, 0)
}

/// The coverage probability in per cent of the symbols `U95` and `U_95`.
fn of_symbol(name: &str) -> Option<f64> {
    let digits = name.strip_prefix('U')?.trim_start_matches('_');
    let is_probability =
        digits.len() >= 2 && digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    digits.parse().ok().filter(|p| is_probability && (50.0..100.0).contains(p))
}

/// What the heading of expanded uncertainties says of their coverage.
pub(super) fn coverage(heading: &str) -> HeaderCoverage {
    let own = without_party(heading);
    coverage_of_any(&own)
}

fn coverage_of_any(heading: &str) -> HeaderCoverage {
    match of_symbol(&name(heading)) {
        Some(percent) => HeaderCoverage::Probability(percent / 100.0),
        None => HeaderCoverage::of(heading),
    }
}

/// A heading without brackets that speak of the coverage: `U (k=2) / mV` is `U / mV`.
pub(super) fn without_coverage(heading: &str) -> String {
    let speaks_of_it = |inside: &str| {
        let has_digit = inside.contains(|c: char| c.is_ascii_digit());
        let is_probability = has_digit && inside.trim_end().ends_with('%');
        is_probability || HeaderCoverage::of(inside) != HeaderCoverage::None && inside != "U"
    };
    let spans: Vec<(usize, usize)> = brackets(heading)
        .filter(|(_, _, inside)| speaks_of_it(inside))
        .map(|(open, close, _)| (open, close))
        .collect();
    let mut text = heading.to_owned();
    for (open, close) in spans.into_iter().rev() {
        text.replace_range(open..close, "");
    }
    text.trim().to_owned()
}

/// The brackets of a text: where they begin and end, and what stands inside.
fn brackets(text: &str) -> impl Iterator<Item = (usize, usize, &str)> {
    let opens = text.char_indices().filter(|(_, c)| matches!(c, '(' | '['));
    opens.filter_map(move |(at, c)| {
        let close = if c == '(' { ')' } else { ']' };
        let behind = text.get(at + 1..)?;
        let end = behind.find(close)?;
        Some((at, at + 1 + end + 1, behind.get(..end)?))
    })
}

/// The name of a column without its unit and what stands in brackets.
pub(super) fn name(heading: &str) -> String {
    let bare = without_coverage(heading);
    let bare = column_heading::bare(&bare);
    let bare = bare.split(['(', '[']).next().unwrap_or_default();
    bare.split([',', ';']).next().unwrap_or_default().trim().to_owned()
}

/// The unit that a heading states, as text.
///
/// # Errors
/// What stands in the place of a unit and is none, as a sentence.
pub(super) fn unit(
    heading: &str,
    parse: impl Fn(&str) -> Result<Unit, String>,
) -> Result<Option<UnitOfHeading>, String> {
    let own = without_party(heading);
    let is_of_value = brackets(&own).any(|(_, _, inside)| {
        inside.split_once(' ').is_some_and(|(_, inside)| columns::is_of_estimate(inside))
    });
    let of = |text: &str| parse(text).map(|unit| UnitOfHeading { unit, is_of_value });
    // of words of uncertainties nothing else may be there
    let is_value = matches!(
        said(heading),
        HeadingMeaning::Role(Role::Value(_), _) | HeadingMeaning::Deviation(_)
    );
    if let Some(text) = unit_of_header(&own, is_value)? {
        return of(&text)
            .map(Some)
            .map_err(|error| format!("`{heading}`: `{text}` is no unit: {error}"));
    }
    let bare = without_coverage(&own);
    match column_heading::named(&bare) {
        Some((_, text)) if !SYMBOLS.contains(&text) => {
            of(text).map(Some).map_err(|error| format!("`{heading}`: `{text}` is no unit: {error}"))
        }
        _ => Ok(None),
    }
}

/// The unit of a heading.
#[derive(Clone, Debug)]
pub(super) struct UnitOfHeading {
    pub(super) unit: Unit,
    /// Whether its words say that it is a share of the value: `% of reading`.
    pub(super) is_of_value: bool,
}

/// Whether a column of which nothing else is known can change what the results are: it looks like an
/// uncertainty, a factor or a correlation, or like the name of a column that is read.
pub(super) fn is_like_uncertainty(heading: &str, known: &[&str]) -> bool {
    const PARTS: [&str; 16] = [
        "uncert",
        "unsich",
        "incert",
        "std",
        "dev",
        "abweichung",
        "écart",
        "ecart",
        "sigma",
        "σ",
        "±",
        "+-",
        "+/-",
        "k=",
        "correl",
        "korrel",
    ];
    let words = heading.to_lowercase();
    let name = name(heading);
    // a symbol with an index: `u_c`, `U_ref`, `kp`, `x_ref`
    let mut letters = name.chars();
    let is_symbol = letters.next().is_some_and(|c| "uUkrsxXνv".contains(c))
        && (name.chars().count() <= 2 || letters.next() == Some('_'))
        || name.starts_with("U ")
        || name.starts_with("u ");
    let holds_texts = |column: &Column| {
        use Column::{Description, Quantity, Remark, Symbol};
        matches!(column, Symbol | Quantity | Description | Remark)
    };
    let is_other = columns::column(heading).is_some_and(|column| !holds_texts(&column));
    let near = known.iter().filter(|known| known.len() > 3).copied();
    is_symbol
        || is_other
        || PARTS.iter().any(|part| words.contains(part))
        || nearest(&name, near).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_symbols() {
        let role = |heading: &str| match said(heading) {
            HeadingMeaning::Role(role, _) => Some(role),
            _ => None,
        };
        for (heading, expected) in [
            ("label", Role::Label),
            ("Label", Role::Label),
            ("Lab", Role::Label),
            ("Laboratory", Role::Label),
            ("Labor", Role::Label),
            ("Participant", Role::Label),
            ("Name", Role::Label),
            ("x", Role::Value(0)),
            ("X", Role::Value(0)),
            ("x [mg/kg]", Role::Value(0)),
            ("Value / mV", Role::Value(0)),
            ("Messwert (mV)", Role::Value(0)),
            ("Result", Role::Value(0)),
            ("U", Role::Expanded(0)),
            ("U(k=2)", Role::Expanded(0)),
            ("U (k=2) / µV", Role::Expanded(0)),
            ("U(95 %)", Role::Expanded(0)),
            ("U95", Role::Expanded(0)),
            ("U (% of reading)", Role::Expanded(0)),
            ("Expanded uncertainty", Role::Expanded(0)),
            ("Uncertainty (k=2)", Role::Expanded(0)),
            ("u", Role::Standard(0)),
            ("u(x)", Role::Standard(0)),
            ("Standard uncertainty [mV]", Role::Standard(0)),
            ("Standardunsicherheit", Role::Standard(0)),
            ("k", Role::Factor(0)),
            ("coverage factor", Role::Factor(0)),
            ("dof", Role::Dof),
            ("ν", Role::Dof),
            ("Unit", Role::Unit),
            ("x1 [V]", Role::Value(1)),
            ("u2", Role::Standard(2)),
            ("K1", Role::Factor(1)),
            ("r", Role::Correlation),
        ] {
            assert_eq!(role(heading), Some(expected), "{heading}");
        }
        for (heading, expected) in [
            ("Lab value [V]", Role::Value(1)),
            ("U_lab (k=2)", Role::Expanded(1)),
            ("U95 lab", Role::Expanded(1)),
            ("Ref U", Role::Expanded(2)),
            ("Ref. u", Role::Standard(2)),
            ("Assigned value", Role::Value(2)),
            ("Laborwert", Role::Value(1)),
            ("Erweiterte Unsicherheit Labor", Role::Expanded(1)),
            ("Referenzwert [mV]", Role::Value(2)),
            ("U of reference value", Role::Expanded(2)),
            ("Valeur du laboratoire", Role::Value(1)),
            ("k_ref", Role::Factor(2)),
            // of these the words are a name
            ("Lab code", Role::Label),
        ] {
            assert_eq!(role(heading), Some(expected), "{heading}");
        }
        assert_eq!(said("Uncertainty"), HeadingMeaning::SomeUncertainty(0));
        assert_eq!(said("Unsicherheit Labor"), HeadingMeaning::SomeUncertainty(1));
        assert_eq!(said("Abweichung [V]"), HeadingMeaning::Deviation(0));
        assert_eq!(said("Standard deviation"), HeadingMeaning::Role(Role::Standard(0), false));
        assert_eq!(coverage("U95 lab"), HeaderCoverage::Probability(0.95));
        for heading in ["date", "method", "n", "remark"] {
            assert_eq!(said(heading), HeadingMeaning::Nothing, "{heading}");
            assert!(!is_like_uncertainty(heading, &["label"]), "{heading}");
        }
        for heading in ["u_c", "s", "std. of readings", "kp", "correlation", "lable", "U_ref [mV]"]
        {
            assert!(is_like_uncertainty(heading, &["label"]), "{heading}");
        }
    }

    #[test]
    fn means_are_no_laboratories() {
        for label in [
            "Mean",
            "Average",
            "Weighted mean",
            "Consensus value",
            "CRV",
            "Mittelwert",
            "Moyenne",
            "Median",
            "Pilot mean",
            "Mean value",
            "mean (n = 8)",
            "Mean of all",
            "Robust mean",
            "Gewichteter Mittelwert",
            "Moyenne pondérée",
            "Media",
            "KCRV (median)",
            "Consensus",
        ] {
            assert!(is_reference(label), "{label}");
        }
        for label in
            ["NPL", "MEAN WELL", "Media Lab", "Meaney", "Reference laboratory", "Pilot", "Lab 1"]
        {
            assert!(!is_reference(label), "{label}");
        }
    }

    #[test]
    fn units_and_coverages() {
        let unit = |heading: &str| {
            let found = unit(heading, |text| Unit::parse(text).map_err(|error| error.to_string()));
            found.map(|of| of.map(|of| of.unit.text().to_owned()))
        };
        for (heading, expected) in [
            ("x", None),
            ("x [V]", Some("V")),
            ("U (k=2) / µV", Some("µV")),
            ("U(k=2) [mV]", Some("mV")),
            ("U in mV (k=2)", Some("mV")),
            ("Expanded uncertainty (U)", None),
            ("u(x)", None),
            ("U (95 %)", None),
            ("U (95 %) [%]", Some("%")),
            ("U (% of reading)", Some("%")),
        ] {
            assert_eq!(unit(heading), Ok(expected.map(str::to_owned)), "{heading}");
        }
        assert!(unit("U [Vv]").unwrap_err().contains("`Vv` is no unit"));
        assert_eq!(coverage("U95"), HeaderCoverage::Probability(0.95));
        assert_eq!(coverage("U (k = 3) [mV]"), HeaderCoverage::Factor(3.0));
        assert_eq!(coverage("U [%]"), HeaderCoverage::Expanded);
    }
}
