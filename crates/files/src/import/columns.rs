//! What the columns of a budget are called, in English and in German.

use super::grid::{Cells, number as number_of_cell};
use gumption_engine::special::normal;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Column {
    Symbol,
    Quantity,
    Estimate,
    Unit,
    Width,
    Std,
    Distribution,
    Divisor,
    Sensitivity,
    /// The unit of the sensitivity coefficient.
    UnitOfSensitivity,
    Dof,
    /// In the unit of the result; computed here, and compared.
    Contribution,
    /// What the program computes itself.
    Share,
}

/// The words of each column, without what stands in brackets.
const WORDS: &[(Column, &[&str])] = &[
    (Column::Symbol, &["symbol", "formelzeichen", "x_i", "xi", "zeichen"]),
    (
        Column::Quantity,
        &[
            "quantity",
            "input",
            "input quantity",
            "name",
            "source",
            "source of uncertainty",
            "uncertainty source",
            "component",
            "uncertainty component",
            "parameter",
            "description",
            "größe",
            "groesse",
            "eingangsgröße",
            "eingangsgroesse",
            "quelle",
            "unsicherheitsquelle",
            "einflussgröße",
            "einflussgroesse",
            "bezeichnung",
            "beschreibung",
            "unsicherheitsbeitrag",
        ],
    ),
    (
        Column::Estimate,
        &[
            "estimate",
            "value",
            "best estimate",
            "nominal",
            "nominal value",
            "mean",
            "input value",
            "schätzwert",
            "schaetzwert",
            "wert",
            "mittelwert",
            "nennwert",
            "bester schätzwert",
        ],
    ),
    (Column::Unit, &["unit", "units", "einheit", "einheiten"]),
    (
        Column::Width,
        &[
            "+-",
            "±",
            "+/-",
            "value +-",
            "value ±",
            "uncertainty",
            "expanded uncertainty",
            "u",
            "a",
            "limit",
            "limits",
            "half-width",
            "half width",
            "halfwidth",
            "semi-range",
            "tolerance",
            "stated uncertainty",
            "unsicherheit",
            "halbbreite",
            "halbweite",
            "grenze",
            "grenzen",
            "expanded measurement uncertainty",
            "erweiterte unsicherheit",
            "erweiterte messunsicherheit",
            "erw. unsicherheit",
            "erw. messunsicherheit",
            "toleranz",
            "angegebene unsicherheit",
        ],
    ),
    (
        Column::Std,
        &[
            "standard uncertainty",
            "std",
            "std uncertainty",
            "u_i",
            "ui",
            "std. uncertainty",
            "u_x",
            "standard deviation",
            "standardunsicherheit",
            "std. unsicherheit",
            "standardabweichung",
            "standardmessunsicherheit",
        ],
    ),
    (
        Column::Distribution,
        &[
            "distribution",
            "pdf",
            "probability distribution",
            "type of distribution",
            "shape",
            "verteilung",
            "wahrscheinlichkeitsverteilung",
            "verteilungsart",
            "verteilungsform",
        ],
    ),
    (
        Column::Divisor,
        &["divisor", "k", "coverage factor", "factor", "teiler", "erweiterungsfaktor", "faktor"],
    ),
    (
        Column::Sensitivity,
        &[
            "sensitivity",
            "sensitivity coefficient",
            "sensitivity coefficient ci",
            "c_i",
            "ci",
            "c",
            "sensitivity coefficient c_i",
            "sensitivität",
            "sensitivitätskoeffizient",
            "sensitivitaetskoeffizient",
            "empfindlichkeitskoeffizient",
            "empfindlichkeit",
        ],
    ),
    (
        Column::Dof,
        &[
            "dof",
            "degrees of freedom",
            "nu",
            "ν",
            "v",
            "v_i",
            "vi",
            "ν_i",
            "νi",
            "nu_i",
            "df",
            "freiheitsgrad",
            "freiheitsgrade",
            "effective degrees of freedom",
            "effektive freiheitsgrade",
        ],
    ),
    (
        Column::Contribution,
        &[
            "contribution",
            "uncertainty contribution",
            "u_i(y)",
            "ui(y)",
            "beitrag",
            "ci*ui",
            "c_i*u_i",
            "c*u",
        ],
    ),
    (Column::Share, &["index", "share", "anteil", "variance", "varianz", "percent"]),
    (
        Column::UnitOfSensitivity,
        &[
            "unit of sensitivity",
            "unit of sensitivity coefficient",
            "unit of c_i",
            "unit of ci",
            "unit c_i",
            "unit ci",
            "unit of c",
            "sensitivity unit",
            "c_i unit",
            "ci unit",
            "einheit c_i",
            "einheit ci",
            "einheit von c_i",
            "einheit von ci",
            "einheit des sensitivitätskoeffizienten",
            "einheit sensitivitätskoeffizient",
        ],
    ),
];

/// Words of rows that hold the result.
const RESULTS: &[&str] = &[
    "result",
    "combined",
    "combined standard uncertainty",
    "expanded uncertainty",
    "total",
    "sum",
    "measurand",
    "output",
    "ergebnis",
    "kombinierte standardunsicherheit",
    "summe",
    "gesamt",
    "erweiterte unsicherheit",
    "erweiterte messunsicherheit",
    "messgröße",
    "messgroesse",
    "coverage factor",
    "erweiterungsfaktor",
    "effective degrees of freedom",
    "combined uncertainty",
    "kombinierte unsicherheit",
    "kombinierte messunsicherheit",
    "standard uncertainty",
    "standardunsicherheit",
];

impl Column {
    /// What messages call it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Symbol => "symbol",
            Self::Quantity => "quantity",
            Self::Estimate => "estimate",
            Self::Unit => "unit",
            Self::Width => "stated uncertainty (+-)",
            Self::Std => "standard uncertainty",
            Self::Distribution => "distribution",
            Self::Divisor => "divisor",
            Self::Sensitivity => "sensitivity coefficient",
            Self::Dof => "degrees of freedom",
            Self::UnitOfSensitivity => "unit of the sensitivity coefficient",
            Self::Contribution => "contribution (computed here)",
            Self::Share => "share (computed here)",
        }
    }
}

/// A text without what stands in brackets, in small letters.
pub(super) fn plain(text: &str) -> String {
    let mut depth = 0_u32;
    let mut plain = String::new();
    for c in text.chars() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            c if depth == 0 => plain.push(c),
            _ => {}
        }
    }
    let words: Vec<&str> = plain.split_whitespace().collect();
    words.join(" ").trim_end_matches([':', '.']).to_lowercase()
}

/// What a header's cell names.
fn column(text: &str) -> Option<Column> {
    let compact: String = text.to_lowercase().split_whitespace().collect();
    match compact.as_str() {
        "u(xi)" | "u(x_i)" | "u(x)" => return Some(Column::Std),
        "u_i(y)" | "ui(y)" | "u(y)" => return Some(Column::Contribution),
        _ => {}
    }
    let words = plain(text);
    if words.is_empty() {
        return None;
    }
    let exact = WORDS.iter().find(|(_, all)| all.contains(&words.as_str()));
    // `estimate x_i`, `standard uncertainty u(x_i)`: the longest words that begin it
    let begins = || {
        let mut found: Option<(usize, Column)> = None;
        for (column, all) in WORDS {
            for word in all.iter().filter(|word| word.len() > 3) {
                let behind = words.strip_prefix(*word);
                if behind.is_some_and(|rest| rest.starts_with([' ', ',', '/']))
                    && found.is_none_or(|(length, _)| word.len() > length)
                {
                    found = Some((word.len(), *column));
                }
            }
        }
        found.map(|(_, column)| column)
    };
    exact.map(|(column, _)| *column).or_else(begins)
}

/// The header of a budget.
#[derive(Clone, Debug)]
pub(super) struct Header {
    /// Its line, from 0.
    pub(super) line: usize,
    /// Places of cells with what they hold.
    pub(super) columns: Vec<(usize, Column)>,
    /// Places of cells with other words.
    pub(super) unknown: Vec<usize>,
}

impl Header {
    /// The line that names the most columns, if a quantity and an uncertainty are among them.
    pub(super) fn find(cells: &Cells) -> Option<Self> {
        let mut best: Option<Self> = None;
        for line in 0..cells.lines() {
            let mut columns: Vec<(usize, Column)> = Vec::new();
            let mut unknown = Vec::new();
            for (place, cell) in cells.row(line).iter().enumerate() {
                match column(cell) {
                    Some(found) if !columns.iter().any(|(_, known)| *known == found) => {
                        columns.push((place, found));
                    }
                    _ if cell.trim().is_empty() => {}
                    _ => unknown.push(place),
                }
            }
            let has = |wanted: Column| columns.iter().any(|(_, column)| *column == wanted);
            if !has(Column::Quantity)
                && let Some((_, column)) =
                    columns.iter_mut().find(|(_, column)| *column == Column::Symbol)
            {
                *column = Column::Quantity;
            }
            let has = |wanted: Column| columns.iter().any(|(_, column)| *column == wanted);
            let enough = has(Column::Quantity) && (has(Column::Width) || has(Column::Std));
            if enough && best.as_ref().is_none_or(|best| columns.len() > best.columns.len()) {
                best = Some(Self { line, columns, unknown });
            }
        }
        best
    }

    /// The cell of a line in a column; empty where there is none.
    pub(super) fn cell<'c>(&self, cells: &'c Cells, line: usize, column: Column) -> &'c str {
        let place = self.columns.iter().find(|(_, of)| *of == column);
        place.map_or("", |(place, _)| cells.text(line, *place))
    }
}

/// What a column of expanded uncertainties says of its coverage in its header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum HeaderCoverage {
    /// Nothing: the header does not speak of expanded uncertainties.
    None,
    /// The factor: `U (k=2)`, `U (p=95 %)`.
    Factor(f64),
    /// That they are expanded, and no more.
    Expanded,
}

impl HeaderCoverage {
    /// Of a header's cell.
    pub(super) fn of(text: &str) -> Self {
        let compact: String = text.to_lowercase().split_whitespace().collect();
        let behind = |sign: &str| {
            let number = compact.split_once(sign)?.1;
            let end = |c: char| !(c.is_ascii_digit() || matches!(c, '.' | ',' | '%'));
            let number = number.split(end).next()?.trim_end_matches([',', '.']);
            number_of_cell(number, true)
        };
        if let Some(factor) = behind("k=").filter(|factor| *factor > 0.0) {
            return Self::Factor(factor);
        }
        let share = behind("p=").map(|p| if p > 1.0 { p / 100.0 } else { p });
        if let Some(p) = share.filter(|p| *p > 0.0 && *p < 1.0) {
            return Self::Factor(normal::quantile(0.5 + 0.5 * p));
        }
        let words = ["expanded", "erweiterte", "erw."];
        if words.iter().any(|word| compact.starts_with(word)) || plain_case(text) == "U" {
            Self::Expanded
        } else {
            Self::None
        }
    }
}

/// A header without what stands in brackets.
fn plain_case(text: &str) -> &str {
    text.split(['(', '[']).next().unwrap_or_default().trim()
}

/// Whether a row's words are those of a coverage factor.
pub(super) fn is_factor(words: &str) -> bool {
    const FACTORS: [&str; 7] = [
        "k",
        "k factor",
        "k-factor",
        "k-faktor",
        "coverage factor",
        "erweiterungsfaktor",
        "überdeckungsfaktor",
    ];
    let words = plain(words);
    FACTORS.iter().any(|of| words == *of || words == format!("{of} k"))
}

/// Whether a row that is one of results holds an uncertainty and not the result's estimate.
pub(super) fn is_of_uncertainty(words: &str) -> bool {
    let words = plain(words);
    ["uncertainty", "unsicherheit", "freedom", "freiheitsgrad"].iter().any(|of| words.contains(of))
        || words == "combined"
        || is_factor(&words)
}

/// Whether a row's words are those of a result.
pub(super) fn is_result(words: &str) -> bool {
    let words = plain(words);
    RESULTS.iter().any(|of| words == *of)
        || ["combined ", "expanded ", "kombinierte ", "erweiterte "]
            .iter()
            .any(|begin| words.starts_with(begin))
}

/// The distribution that a text names.
pub(super) fn distribution(text: &str) -> Option<&'static str> {
    let words = text.trim().to_lowercase();
    let begins = |all: &[&str]| all.iter().any(|word| words.starts_with(word));
    if words.is_empty() {
        None
    } else if begins(&["norm", "gau", "student", "t-"]) || matches!(words.as_str(), "n" | "t") {
        Some("normal")
    } else if begins(&["rect", "uniform", "rechteck", "gleich"]) || words == "r" {
        Some("rectangular")
    } else if begins(&["triang", "dreieck"]) {
        Some("triangular")
    } else if begins(&["u-sh", "u sh", "arc", "u-f", "u sha"]) || words == "u" {
        Some("arcsine")
    } else {
        None
    }
}

/// Words as a name of formulas: other signs become `_`.
pub(super) fn identifier(words: &str) -> String {
    let mut name = String::new();
    for c in words.trim().chars() {
        if c.is_alphabetic() || c.is_ascii_digit() || c == '_' {
            name.push(c);
        } else if !name.ends_with('_') {
            name.push('_');
        }
    }
    let name = name.trim_matches('_');
    if name.starts_with(|c: char| c.is_ascii_digit()) {
        format!("x_{name}")
    } else {
        name.to_owned()
    }
}
