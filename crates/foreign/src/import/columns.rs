//! What the columns of a budget are called, in English, German and French.

use super::both::LastOfBoth;
use super::coverage::{HeaderCoverage, Statement};
use super::grid::Cells;
use super::heading::{unit_of_header, unit_of_line};
use super::number::{number_with_unit, value};
use super::symbol;
use gumption_engine::decimal::significant;
use gumption_engine::number::smallest_first;
use gumption_text::named_shape::NamedShape;
use gumption_text::value_text::PLUS_MINUS;
use gumption_units::Unit;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Column {
    Symbol,
    Quantity,
    Estimate,
    /// What is added to the estimates.
    Correction,
    Unit,
    /// The unit of the uncertainties alone.
    UnitOfUncertainty,
    Width,
    /// The limits of a quantity, or of its deviations from the estimate.
    Lower,
    Upper,
    Std,
    /// A standard uncertainty as a share of the estimate.
    Relative,
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
    /// Whether the evaluation is of type A or B.
    Evaluation,
}

/// Words of units at the head of a column, and before a colon in a title.
pub(super) const UNITS: [&str; 8] =
    ["unit", "units", "einheit", "einheiten", "unité", "unités", "unidad", "unidades"];

/// Words of measured values and other weak words, which head estimates where no other column is one.
pub(super) const MEASURED: [&str; 27] = [
    "measured value",
    "measured",
    "measurement",
    "reading",
    "indication",
    "observed value",
    "messwert",
    "gemessener wert",
    "anzeige",
    "anzeigewert",
    "ablesung",
    "valeur mesurée",
    "lecture",
    "x",
    "average",
    "average value",
    "est",
    "est. value",
    "estimated value",
    "central value",
    "result",
    "amount",
    "ergebnis",
    "durchschnitt",
    "durchschnittswert",
    "résultat",
    "valeur moyenne",
];

/// The words of each column, without what stands in brackets.
pub(super) const WORDS: &[(Column, &[&str])] = &[
    (
        Column::Symbol,
        &["sym", "símbolo", "symbol", "formelzeichen", "x_i", "xi", "zeichen", "symbole"],
    ),
    (
        Column::Quantity,
        &[
            "quantity",
            "input",
            "input quantity",
            "influence quantity",
            "influence factor",
            "influence",
            "influences",
            "effect",
            "contributor",
            "error source",
            "source of error",
            "sources of uncertainty",
            "uncertainty contribution source",
            "input parameter",
            "input variable",
            "variable",
            "term",
            "name",
            "source",
            "source of uncertainty",
            "uncertainty source",
            "component",
            "uncertainty component",
            "parameter",
            "description",
            "größe",
            "grösse",
            "groesse",
            "messgröße",
            "messgrösse",
            "messgroesse",
            "eingangsgröße",
            "eingangsgrösse",
            "eingangsgroesse",
            "quelle",
            "unsicherheitsquelle",
            "einflussgröße",
            "einflussgrösse",
            "einflussgroesse",
            "einfluss",
            "einflüsse",
            "einflussfaktor",
            "beitragsgröße",
            "unsicherheitskomponente",
            "komponente",
            "parameter x_i",
            "bezeichnung",
            "beschreibung",
            "grandeur",
            "grandeur d'entrée",
            "grandeur d'influence",
            "source d'incertitude",
            "composante",
            "désignation",
            "sources d'incertitude",
            "facteur d'influence",
            "origine",
            "cause",
            "paramètre",
            "magnitud",
            "magnitud de entrada",
            "magnitud de influencia",
            "fuente",
            "fuente de incertidumbre",
            "fuentes de incertidumbre",
            "componente",
            "componente de incertidumbre",
            "descripción",
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
            "estimation",
            "valeur",
            "valeur estimée",
            "meilleure estimation",
            "valeur nominale",
            "moyenne",
            "valor",
            "estimación",
            "valor estimado",
            "mejor estimación",
            "valor nominal",
            "media",
        ],
    ),
    (Column::Unit, &UNITS),
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
            "expanded u",
            "expanded unc",
            "exp. unc",
            "exp. uncertainty",
            "u",
            "a",
            "limit",
            "limits",
            "error limit",
            "error limits",
            "accuracy",
            "max error",
            "max. error",
            "maximum error",
            "genauigkeit",
            "limits of error",
            "limit of error",
            "half-width",
            "half width",
            "halfwidth",
            "semi-range",
            "tolerance",
            "maximum permissible error",
            "max. permissible error",
            "max permissible error",
            "mpe",
            "stated uncertainty",
            "unsicherheit",
            "halbbreite",
            "halbe breite",
            "halbe weite",
            "halbweite",
            "grenze",
            "grenzen",
            "expanded measurement uncertainty",
            "erweiterte unsicherheit",
            "erweiterte messunsicherheit",
            "erw. unsicherheit",
            "erw. messunsicherheit",
            "toleranz",
            "fehlergrenze",
            "fehlergrenzen",
            "angegebene unsicherheit",
            "incertitude",
            "incertitude élargie",
            "demi-largeur",
            "demi-étendue",
            "limite",
            "limites",
            "tolérance",
            "erreur maximale tolérée",
            "full width",
            "full range",
            "total width",
            "vollbreite",
            "gesamtbreite",
            "spannweite",
            "étendue",
            "incertidumbre",
            "incertidumbre expandida",
            "semiamplitud",
            "semiancho",
            "semirango",
            "límite",
            "límites",
            "tolerancia",
            "error máximo permitido",
        ],
    ),
    (
        Column::Lower,
        &[
            "lower",
            "lower limit",
            "lower bound",
            "min",
            "minimum",
            "a-",
            "a_-",
            "untere grenze",
            "untergrenze",
            "limite inférieure",
        ],
    ),
    (
        Column::Upper,
        &[
            "upper",
            "upper limit",
            "upper bound",
            "max",
            "maximum",
            "a+",
            "a_+",
            "obere grenze",
            "obergrenze",
            "limite supérieure",
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
            "std unc",
            "std. unc",
            "stand unc",
            "stand. unc",
            "stand. uncertainty",
            "standard unc",
            "u_x",
            "standard deviation",
            "std. dev",
            "std dev",
            "std.dev",
            "stand. dev",
            "st. dev",
            "stdev",
            "stddev",
            "standardunsicherheit",
            "std. unsicherheit",
            "standardabweichung",
            "standardmessunsicherheit",
            "std.-unsicherheit",
            "std.-messunsicherheit",
            "std. messunsicherheit",
            "incertitude-type",
            "incertitude type",
            "sd",
            "incertidumbre típica",
            "incertidumbre estándar",
            "desviación típica",
            "desviación estándar",
            "écart-type",
            "écart type",
        ],
    ),
    (
        Column::Relative,
        &[
            "relative standard uncertainty",
            "rel. standard uncertainty",
            "relative std. uncertainty",
            "relative u",
            "rel. u",
            "rel u",
            "u_rel",
            "urel",
            "u(x)/x",
            "u(xi)/xi",
            "u(x_i)/x_i",
            "relative standardunsicherheit",
            "rel. standardunsicherheit",
            "relative standardmessunsicherheit",
            "rel. standardmessunsicherheit",
            "incertitude-type relative",
            "incertitude type relative",
        ],
    ),
    (
        Column::Distribution,
        &[
            "distribution",
            "pdf",
            "probability distribution",
            "type of distribution",
            "prob. distribution",
            "prob. dist",
            "prob dist",
            "dist",
            "distr",
            "shape",
            "verteilung",
            "wahrscheinlichkeitsverteilung",
            "verteilungsart",
            "verteilungsform",
            "verteilungsfunktion",
            "verteilungsdichte",
            "dichtefunktion",
            "wahrscheinlichkeitsdichte",
            "probability density",
            "probability density function",
            "densité de probabilité",
            "distribución",
            "distribución de probabilidad",
            "tipo de distribución",
            "loi",
            "loi de probabilité",
            "distribution de probabilité",
        ],
    ),
    (
        Column::Divisor,
        &[
            "divisor",
            "div",
            "divided by",
            "k",
            "k factor",
            "k-factor",
            "coverage factor",
            "cf",
            "factor",
            "teiler",
            "erweiterungsfaktor",
            "überdeckungsfaktor",
            "k-faktor",
            "faktor",
            "diviseur",
            "facteur d'élargissement",
            "facteur",
            "multiplier",
            "factor de cobertura",
        ],
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
            "|ci|",
            "|c_i|",
            "sensitivity coeff",
            "sens",
            "sens coeff",
            "sens coef",
            "sens. coef",
            "sensitivity coef",
            "sens. coeff",
            "sens.-koeff",
            "sens. koeff",
            "sens.-koeffizient",
            "sensitivitäts-koeff",
            "sensitivitäts-koeffizient",
            "coefficient de sensibilité",
            "coeficiente de sensibilidad",
            "coef. de sensibilidad",
            "sensibilidad",
            "sensibilité",
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
            "degrés de liberté",
            "ddl",
            "grados de libertad",
        ],
    ),
    (
        Column::Contribution,
        &[
            "contribution",
            "contributions",
            "beiträge",
            "unsicherheitsbeiträge",
            "uncertainty contribution",
            "u_i(y)",
            "ui(y)",
            "beitrag",
            "unsicherheitsbeitrag",
            "uns.-beitrag",
            "uns. beitrag",
            "unsicherheits-beitrag",
            "contribution à l'incertitude",
            "contribución",
            "contribución a la incertidumbre",
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
    "résultat",
    "résultat de mesure",
    "mesurande",
    "messergebnis",
    "messresultat",
    "ausgangsgröße",
    "standardmessunsicherheit",
    "beigeordnete standardmessunsicherheit",
    "quadratic sum",
    "quadratische summe",
    "somme quadratique",
    "sum in quadrature",
    "quadrature sum",
    "geometrische summe",
    "measurement result",
    "overall",
    "overall uncertainty",
    "rss",
    "root sum square",
    "root sum of squares",
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
    "somme",
    "expanded",
    "expanded u",
    "erweitert",
    "élargie",
    "total uncertainty",
    "total standard uncertainty",
    "gesamtunsicherheit",
    "incertitude totale",
    "resultado",
    "mensurando",
    "suma",
    "total combinado",
    "suma cuadrática",
    "incertidumbre total",
    "factor de cobertura",
];

/// Whether a row's words are those of the sum of some rows above it.
pub(super) fn is_subtotal(words: &str) -> bool {
    const SUBTOTALS: [&str; 6] =
        ["subtotal", "sub-total", "sub total", "zwischensumme", "sous-total", "sous total"];
    let words = plain(words);
    SUBTOTALS
        .iter()
        .any(|of| words.strip_prefix(of).is_some_and(|rest| !rest.starts_with(char::is_alphabetic)))
}

/// Whether a text is the symbol of an expanded uncertainty with its coverage, `U (k=2)`.
pub(super) fn is_expanded_symbol(text: &str) -> bool {
    plain_case(text) == "U" && HeaderCoverage::of(text).factor(None).is_some()
}

/// Whether a heading is the symbol of standard uncertainties, `u`.
pub(super) fn is_standard_symbol(heading: &str) -> bool {
    plain_case(symbol::before_unit(heading)) == "u"
}

/// Whether a heading speaks of nominal values.
pub(crate) fn is_nominal(heading: &str) -> bool {
    let words = plain(heading);
    let small = heading.to_lowercase();
    ["nominal", "nennwert", "valeur nominale"].iter().any(|of| words.starts_with(of))
        || ["(nominal", "(nennwert"].iter().any(|of| small.contains(of))
}

/// Whether a heading is the symbol of standard deviations of readings; a capital letter may be anything.
fn is_deviation_symbol(heading: &str) -> bool {
    matches!(symbol::before_unit(heading).trim(), "s" | "s_i" | "s(x)" | "s(x_i)" | "s(xi)")
}

/// Whether a heading speaks of a standard deviation.
pub(super) fn is_deviation(heading: &str) -> bool {
    let words = plain(heading);
    if is_deviation_symbol(heading) {
        return true;
    }
    [
        "standard deviation",
        "desviación",
        "sd",
        "standardabweichung",
        "écart-type",
        "écart type",
        "std",
        "st. dev",
        "stand. dev",
    ]
    .iter()
    .any(|deviation| words.starts_with(deviation))
        && !words.contains("unc")
        && !words.contains("unsich")
        && !words.contains("mean")
        && !words.contains("mittel")
}

/// A quotient is a printed standard uncertainty where it differs from it by no more than this share:
/// two digits, of which the least are 1.0, are rounded by up to 5 %.
const ROUNDED: f64 = 0.05;

impl Column {
    /// Columns of which each states an uncertainty; a lower limit has an upper one beside it.
    pub(super) const UNCERTAIN: [Self; 4] = [Self::Width, Self::Std, Self::Relative, Self::Upper];

    /// Whether its cells are numbers of a quantity, in units.
    fn is_of_numbers(self) -> bool {
        self.is_of_place()
            || matches!(
                self,
                Self::Correction | Self::Width | Self::Std | Self::Relative | Self::Contribution
            )
    }

    /// Whether its cells are values of a quantity, which may lie below zero.
    pub(super) fn is_of_place(self) -> bool {
        matches!(self, Self::Estimate | Self::Lower | Self::Upper)
    }

    /// What messages call it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Symbol => "symbol",
            Self::Quantity => "quantity",
            Self::Estimate => "estimate",
            Self::Correction => "correction",
            Self::Unit => "unit",
            Self::UnitOfUncertainty => "unit of the uncertainty",
            Self::Width => "stated uncertainty (+-)",
            Self::Lower => "lower limit",
            Self::Upper => "upper limit",
            Self::Std => "standard uncertainty",
            Self::Relative => "relative standard uncertainty",
            Self::Distribution => "distribution",
            Self::Divisor => "divisor",
            Self::Sensitivity => "sensitivity coefficient",
            Self::Dof => "degrees of freedom",
            Self::UnitOfSensitivity => "unit of the sensitivity coefficient",
            Self::Contribution => "contribution (computed here)",
            Self::Share => "share (computed here)",
            Self::Evaluation => "type of evaluation",
        }
    }
}

/// A text without what stands in brackets, in small letters.
pub(crate) fn plain(text: &str) -> String {
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
pub(crate) fn column(text: &str) -> Option<Column> {
    let compact: String = text.to_lowercase().split_whitespace().collect();
    match compact.as_str() {
        "u(xi)" | "u(x_i)" | "u(x)" => return Some(Column::Std),
        "u(xi)/xi" | "u(x_i)/x_i" | "u(x)/x" => return Some(Column::Relative),
        // the symbol of relative ones in ISO 376 and others
        "w(xi)" | "w(x_i)" | "w(x)" => return Some(Column::Relative),
        "u_i(y)" | "ui(y)" | "u(y)" => return Some(Column::Contribution),
        _ if is_dof(&compact) => return Some(Column::Dof),
        _ => {}
    }
    if let Some(column) = unit_column(text) {
        return Some(column);
    }
    if let Some((column, _)) = symbol::of_uncertainties(text) {
        return Some(column);
    }
    // `Value (±)` is no value
    if PLUS_MINUS.into_iter().any(|sign| compact.contains(sign)) {
        return Some(Column::Width);
    }
    let words = plain(text);
    if words.is_empty() {
        return None;
    }
    // as cells break words: `Standardmess-unsicherheit`
    let joined = words.replace("- ", "").replace('-', "");
    let product = compact.replace(['·', '×', '⋅'], "*").replace('|', "");
    let exact = WORDS
        .iter()
        .find(|(_, all)| all.contains(&words.as_str()))
        .or_else(|| WORDS.iter().find(|(_, all)| all.contains(&joined.as_str())))
        .or_else(|| WORDS.iter().find(|(_, all)| all.contains(&product.as_str())));
    // `estimate x_i`, `standard uncertainty u(x_i)`: the longest words that begin it
    let begins = || {
        let mut found: Option<(usize, Column)> = None;
        for (column, all) in WORDS {
            for word in all.iter().filter(|word| word.len() > 3) {
                let behind = words.strip_prefix(*word);
                // the accuracy class of an instrument is no accuracy
                let continues =
                    |rest: &str| rest.starts_with([' ', ',', '/']) && !rest.contains("class");
                if behind.is_some_and(continues)
                    && found.is_none_or(|(length, _)| word.len() > length)
                {
                    found = Some((word.len(), *column));
                }
            }
        }
        found.map(|(_, column)| column)
    };
    // `resolution / half-width`: one of two names
    let one_of_two = || {
        let mut named =
            words.split(" / ").filter(|part| part.chars().count() > 3).filter_map(|part| {
                let found = WORDS.iter().find(|(_, all)| all.contains(&part.trim()));
                found.map(|(column, _)| *column)
            });
        named.next().filter(|_| named.next().is_none())
    };
    // `u / mm`
    let quotient = || {
        let before = symbol::before_unit(text);
        match (before != text).then(|| column(before))?? {
            // a symbol has no unit, its estimate has
            Column::Symbol => Some(Column::Estimate),
            found => Some(found).filter(|found| found.is_of_numbers()),
        }
    };
    // `U (k=2) µm`
    let with_unit = || {
        let (word, unit) = words.split_once(' ')?;
        let written = text.trim().get(text.trim().len().checked_sub(unit.len())?..)?;
        let is_unit = written.parse::<f64>().is_err()
            && (Unit::parse(written).is_ok() || unit_as_meant(written).is_some());
        let found = WORDS.iter().find(|(_, all)| all.contains(&word))?;
        Some(found.0).filter(|found| is_unit && found.is_of_numbers())
    };
    exact
        .map(|(column, _)| *column)
        .or_else(begins)
        .or_else(one_of_two)
        .or_else(quotient)
        .or_else(with_unit)
}

/// What a header that speaks of units beside another column's words names: `Uncertainty unit`, `Unit of
/// estimate`; `None` where it speaks of units alone, or of other ones.
fn unit_column(text: &str) -> Option<Column> {
    const UNCERTAINTIES: [&str; 6] = ["unc", "uncert", "uncertainty", "u", "unsicherheit", "±"];
    let words = text.to_lowercase();
    let sign = |c: char| !(c.is_alphanumeric() || matches!(c, '±' | '_'));
    let words: Vec<&str> = words.split(sign).filter(|word| !word.is_empty()).collect();
    let (units, others): (Vec<&str>, Vec<&str>) =
        words.iter().partition(|word| UNITS.contains(*word));
    let is_joined = !others.iter().any(|word| matches!(*word, "per" | "pro" | "par"));
    if units.is_empty() || others.is_empty() || !is_joined {
        return None;
    }
    let of = |word: &&str| {
        let is_uncertain = UNCERTAINTIES.contains(word)
            || ["uncertaint", "unsicherheit", "incertitude", "halbbreite"]
                .iter()
                .any(|part| word.contains(part));
        let found = WORDS.iter().find(|(_, all)| all.contains(word)).map(|(column, _)| *column);
        if is_uncertain { Some(Column::Width) } else { found }
    };
    let found: Vec<Column> = others.iter().filter_map(of).collect();
    if found.iter().any(|column| matches!(column, Column::Width | Column::Std)) {
        Some(Column::UnitOfUncertainty)
    } else if found.contains(&Column::Estimate) {
        Some(Column::Unit)
    } else {
        None
    }
}

/// Whether a header without its spaces speaks of degrees of freedom: `νi`, `veff`, `vi or veff`.
fn is_dof(compact: &str) -> bool {
    let is_one = |part: &str| {
        let part = part.replace(['_', '(', ')'], "");
        matches!(part.as_str(), "νi" | "vi" | "nui" | "νeff" | "veff" | "nueff" | "ν" | "dof")
    };
    let parts: Vec<&str> = ["or", "oder", "ou", "/", ","]
        .into_iter()
        .find(|word| compact.contains(word))
        .map_or_else(|| vec![compact], |word| compact.split(word).collect());
    parts.into_iter().all(is_one)
}

/// What a cell right below the header says of the numbers of its column.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Below {
    /// Their unit: `mV`, `in mV`, `[mV]`, `u_i / mV`.
    Unit(String),
    /// Their symbol.
    Symbol,
    /// A word that may be a symbol.
    Word,
    /// What looks like a unit, or can be one as well as a symbol.
    Doubtful,
    /// What belongs to no header.
    Row,
}

impl Below {
    fn of(column: Column, text: &str, is_of_symbols: bool) -> Self {
        let bare = without_in(text.trim_matches(['(', ')', '[', ']']).trim());
        let bare = bare.trim_matches(['(', ')', '[', ']']);
        let is_unit = Unit::parse(bare).is_ok();
        if is_of_symbols && is_symbol_of(column, text) {
            return if bare == "s" { Self::Doubtful } else { Self::Symbol };
        }
        if is_symbol(text) {
            return Self::Symbol;
        }
        if is_unit {
            return Self::Unit(bare.to_owned());
        }
        // the sign of a quotient without spaces: `u_i/mV`
        let behind = text
            .split_once('/')
            .filter(|(symbol, _)| is_symbol(symbol.trim()) || is_symbol_of(column, symbol.trim()));
        let behind = behind.map(|(_, unit)| unit.trim_matches(['(', ')', '[', ']', ' ']));
        let statement = Statement::of(&format!("; {text}"));
        let rest = statement.as_ref().map_or("", |statement| &statement.rest);
        let is_stated = |of: &Statement| of.coverage.factor(None).is_some() || of.dof.is_some();
        let has_number =
            rest.contains(|c: char| c.is_ascii_digit() || matches!(c, '#' | '?' | '±'));
        if statement.as_ref().map_or(true, is_stated) && !has_number {
            return Self::Doubtful;
        }
        match (behind.filter(|unit| Unit::parse(unit).is_ok()), unit_of_line(text)) {
            (Some(unit), _) => Self::Unit(unit.to_owned()),
            (None, Ok(Some(unit))) => Self::Unit(unit),
            _ if has_number => Self::Row,
            (None, _) if super::columns::column(text).is_some() => Self::Symbol,
            _ if text.contains(['/', '[', '%']) || text.starts_with("in ") => Self::Doubtful,
            // one word, which may be a symbol
            _ if text.chars().count() <= 8 && !text.contains(char::is_whitespace) => Self::Word,
            _ => Self::Row,
        }
    }
}

/// Whether a text is a symbol with an index or an argument, as `x_i`, `u(x_i)` and `u_i(y)`.
pub(super) fn is_symbol(text: &str) -> bool {
    let compact: String = text.split_whitespace().collect();
    let compact = compact.replace('_', "");
    const SYMBOLS: [&str; 22] = [
        "Xi", "xi", "yi", "ui", "Ui", "ci", "ai", "si", "|ci|", "νi", "vi", "νeff", "veff", "uc",
        "u(xi)", "u(x)", "U(xi)", "U(x)", "ui(y)", "u(y)", "uc(y)", "Δxi",
    ];
    SYMBOLS.contains(&compact.as_str())
}

/// Whether a letter may be the symbol of what a column holds.
fn is_symbol_of(column: Column, text: &str) -> bool {
    match column {
        Column::Estimate => matches!(text, "x" | "X" | "y"),
        Column::Width => matches!(text, "a" | "u" | "U" | "s" | "±"),
        Column::Std | Column::Contribution => matches!(text, "u" | "s"),
        _ => false,
    }
}

/// A unit without the word before it: `in mV` is `mV`, and no product with an inch.
pub(crate) fn without_in(text: &str) -> &str {
    let behind = text.strip_prefix("in ").map(str::trim);
    let is_unit = |unit: &&str| Unit::parse(unit.trim_matches(['(', ')', '[', ']'])).is_ok();
    behind.filter(is_unit).unwrap_or(text)
}

/// Whether words behind a share say that it is one of the estimate.
pub(crate) fn is_of_estimate(words: &str) -> bool {
    const ESTIMATE: [&str; 18] = [
        "of reading",
        "of the reading",
        "of rdg",
        "of rdg.",
        "rdg",
        "rdg.",
        "of value",
        "of the value",
        "of estimate",
        "of the estimate",
        "of measured value",
        "of nominal",
        "v.m.",
        "v. m.",
        "vom messwert",
        "vom wert",
        "de la lecture",
        "de la valeur",
    ];
    ESTIMATE.contains(&words.trim().to_lowercase().as_str())
}

/// The place of the first column that holds what is wanted.
pub(super) fn place_of(columns: &[(usize, Column)], wanted: Column) -> Option<usize> {
    columns.iter().find(|(_, column)| *column == wanted).map(|(place, _)| *place)
}

/// The header of a budget.
#[derive(Clone, Debug)]
pub(super) struct Header {
    /// Its last line, from 0.
    pub(super) line: usize,
    /// Its first line.
    pub(super) first: usize,
    /// The words of its cells.
    headings: Vec<String>,
    /// Places of cells with what they hold.
    pub(super) columns: Vec<(usize, Column)>,
    /// Places of cells with other words.
    pub(super) unknown: Vec<usize>,
    /// The units that columns of numbers state.
    units: Vec<(Column, String)>,
    /// Whether a column that is headed like one of estimates holds what is divided by the divisors.
    pub(super) has_widths_as_values: bool,
    /// The unit that a line beside the table states for all values, with that line.
    pub(super) unit_of_all: Option<(String, String)>,
    /// What cannot be read in one way.
    pub(super) doubtful: Vec<String>,
}

impl Header {
    /// The line that names the most columns, if a quantity and an uncertainty are among them.
    pub(super) fn find(cells: &Cells) -> Option<Self> {
        let mut best: Option<Self> = None;
        let of_both = LastOfBoth::of(cells);
        let one = (0..cells.lines()).map(|line| (line, line, cells.row(line).to_vec()));
        let two = (1..cells.lines())
            .filter_map(|line| Some((line - 1, line, of_two_lines(cells, line)?)));
        for (first, line, headings) in one.chain(two) {
            let mut columns: Vec<(usize, Column)> = Vec::new();
            let mut unknown = Vec::new();
            for (place, cell) in headings.iter().enumerate() {
                // `X_i` and `x_i` side by side: the quantity and its estimate
                // and beside the names of quantities where it has numbers
                let is_estimate = matches!(cell.trim(), "x_i" | "xi")
                    && (columns.iter().any(|(_, known)| *known == Column::Symbol)
                        || place_of(&columns, Column::Quantity).is_some()
                            && has_numbers_alone(cells, line, place));
                // `u` beside what is divided is the quotient
                let mut found = match (is_estimate, cells.column(cell)) {
                    (true, _) => Some(Column::Estimate),
                    // `s` of readings, which is no uncertainty of a comparison's results
                    (false, None) if is_deviation_symbol(cell) => Some(Column::Std),
                    // `X` and `x` side by side, and the names of the contributions
                    (false, None) if matches!(cell.trim(), "X" | "x") => {
                        has_names(cells, line, place).then_some(Column::Symbol)
                    }
                    (false, Some(Column::Contribution))
                        if has_names(cells, line, place)
                            && place_of(&columns, Column::Quantity).is_none() =>
                    {
                        Some(Column::Quantity)
                    }
                    (false, found) => found,
                };
                let width = columns.iter_mut().find(|(_, known)| *known == Column::Width);
                if let Some((known, of)) = width
                    && found == Some(Column::Width)
                {
                    if is_standard_symbol(cell) {
                        found = Some(Column::Std);
                    } else if is_standard_symbol(&headings[*known]) {
                        *of = Column::Std;
                    }
                }
                // a nominal value is no estimate beside one
                if found == Some(Column::Estimate)
                    && !is_nominal(cell)
                    && let Some((known, _)) =
                        columns.iter_mut().find(|(_, known)| *known == Column::Estimate)
                    && is_nominal(&headings[*known])
                {
                    unknown.push(std::mem::replace(known, place));
                    continue;
                }
                match found {
                    Some(found) if !columns.iter().any(|(_, known)| *known == found) => {
                        columns.push((place, found));
                    }
                    // beside a standard uncertainty, a standard deviation is that of single readings
                    Some(Column::Std) if !is_deviation(cell) => {
                        for (known, column) in &mut columns {
                            if *column == Column::Std && is_deviation(&headings[*known]) {
                                unknown.push(std::mem::replace(known, place));
                            }
                        }
                        if !columns.contains(&(place, Column::Std)) {
                            unknown.push(place);
                        }
                    }
                    _ if cell.trim().is_empty() => {}
                    _ => unknown.push(place),
                }
            }
            // the names of the contributions may head the list of them
            let list = [Column::Symbol, Column::Contribution];
            if place_of(&columns, Column::Quantity).is_none()
                && let Some(first) = list.into_iter().find_map(|of| {
                    place_of(&columns, of).filter(|place| of == Column::Symbol || *place == 0)
                })
                && let Some((_, column)) = columns.iter_mut().find(|(place, _)| *place == first)
            {
                *column = Column::Quantity;
            }
            // `u_i` behind the coefficients is what they make of the uncertainties
            let of = |wanted| place_of(&columns, wanted);
            if let (Some(c), Some(u)) = (of(Column::Sensitivity), of(Column::Std))
                && u > c
                && of(Column::Width).is_some()
                && of(Column::Contribution).is_none()
                && (symbol::is_bare(&headings[u]) || is_standard_symbol(&headings[u]))
                && let Some((_, column)) = columns.iter_mut().find(|(place, _)| *place == u)
            {
                *column = Column::Contribution;
            }
            // `u` is a standard uncertainty, unless it is still to be divided; `U` is an expanded one
            let known = [Column::Std, Column::Divisor, Column::Width];
            if let [None, None, Some(place)] = known.map(|of| place_of(&columns, of))
                && is_standard_symbol(&headings[place])
                && HeaderCoverage::of(&headings[place]) == HeaderCoverage::None
                && let Some((_, column)) = columns.iter_mut().find(|(at, _)| *at == place)
            {
                *column = Column::Std;
            }
            // one limit alone is none
            let is_limit = |column: Column| matches!(column, Column::Lower | Column::Upper);
            if columns.iter().filter(|(_, column)| is_limit(*column)).count() == 1 {
                let alone = columns.extract_if(.., |(_, column)| is_limit(*column));
                unknown.extend(alone.map(|(place, _)| place));
            }
            Self::cells_of_both(&of_both, line, &mut columns);
            let has_widths_as_values = widths_by_contributions(cells, line, &mut columns);
            let has = |wanted: Column| columns.iter().any(|(_, column)| *column == wanted);
            let enough = has(Column::Quantity) && Column::UNCERTAIN.into_iter().any(has);
            if enough && best.as_ref().is_none_or(|best| columns.len() > best.columns.len()) {
                best = Some(Self {
                    line,
                    first,
                    headings,
                    columns,
                    unknown,
                    units: Vec::new(),
                    has_widths_as_values,
                    unit_of_all: None,
                    doubtful: Vec::new(),
                });
            }
        }
        let mut best = best?;
        best.limits_beside_standard();
        best.measured_values(cells);
        best.corrections(cells);
        best.bare_coefficients();
        best.named_distributions(cells);
        best.types_of_evaluations(cells);
        best.widths_as_values(cells);
        best.deviations_as_widths(cells);
        best.contributions_of_quotients(cells);
        best.doubts(cells);
        for (place, column) in best.columns.iter().filter(|(_, column)| column.is_of_numbers()) {
            let heading = best.headings.get(*place).map_or("", String::as_str);
            match unit_of_header(heading, column.is_of_place()) {
                Ok(Some(unit)) => best.units.push((*column, unit)),
                Ok(None) => {}
                Err(reason) if best.doubtful.contains(&reason) => {}
                Err(reason) => best.doubtful.push(reason),
            }
        }
        best.coverages(cells);
        best.units_below(cells);
        best.unit_of_all(cells);
        Some(best)
    }

    /// A standard uncertainty has no coverage factor, and a column of probabilities tells none here.
    fn coverages(&mut self, cells: &Cells) {
        // which may be headings of other columns too, where no cell is a probability
        const SYMBOLS: [&str; 6] = ["p", "cl", "coverage", "level", "conf", "conf. level"];
        const PROBABILITIES: [&str; 9] = [
            "coverage probability",
            "confidence",
            "level of confidence",
            "probability",
            "überdeckungswahrscheinlichkeit",
            "vertrauensniveau",
            "konfidenzniveau",
            "niveau de confiance",
            "probabilité",
        ];
        let heading = self.heading_of(Column::Std).trim().to_owned();
        let factor = HeaderCoverage::of(&heading).factor(None);
        if let Some(k) = factor.filter(|k| (k - 1.0).abs() > ROUNDED) {
            self.doubtful.push(format!(
                "`{heading}` can be a standard uncertainty, or an expanded one of k = {}: call it `U`, or \
                 leave the factor out",
                significant(k, 3)
            ));
        }
        let width = self.heading_of(Column::Width).trim().to_owned();
        if Statement::of(&width).is_ok_and(|of| of.dof.is_some()) {
            self.doubtful.push(format!(
                "`{width}`: degrees of freedom are read in a column `dof`: write them into the rows"
            ));
        }
        let is_of_per_cent = |place: usize| {
            let cells = (self.line + 1..cells.lines()).map(|line| cells.text(line, place).trim());
            let mut shares = cells.filter_map(|cell| cell.strip_suffix('%'));
            shares.any(|cell| cell.trim().replace(',', ".").parse::<f64>().is_ok_and(|p| p > 50.0))
        };
        let is_probability = |place: &&usize| {
            let words = plain(self.heading(**place));
            PROBABILITIES.iter().any(|of| words.starts_with(of))
                || SYMBOLS.contains(&words.as_str()) && is_of_per_cent(**place)
        };
        if !self.has(Column::Divisor)
            && self.coverage(Column::Width).factor(None).is_none()
            && self.has(Column::Width)
            && let Some(place) = self.unknown.iter().find(is_probability)
        {
            self.doubtful.push(format!(
                "the column `{}` is not read, and tells the coverage factors: write them into a column `k`, \
                 or one probability into the heading of the uncertainties, `U (95 %)`",
                self.heading(*place).trim()
            ));
        }
    }

    /// `Coefficient` beside a divisor is one of sensitivity where no other column is.
    fn bare_coefficients(&mut self) {
        const WORDS: [&str; 6] =
            ["coefficient", "coefficients", "coeff", "coef", "koeffizient", "koeffizienten"];
        if !self.has(Column::Divisor) || self.has(Column::Sensitivity) {
            return;
        }
        let is_one = |header: &Self, place| WORDS.contains(&plain(header.heading(place)).as_str());
        self.take_the_one(Column::Sensitivity, is_one);
    }

    /// Places of columns that are not taken though their words are those of a kind of column that is,
    /// with that kind; a nominal value is no estimate beside one, nor `u` behind the coefficients an
    /// uncertainty of the quantity.
    pub(super) fn others_of_known_kinds(&self) -> Vec<(usize, Column)> {
        const KINDS: [Column; 6] = [
            Column::Estimate,
            Column::Width,
            Column::Std,
            Column::Divisor,
            Column::Sensitivity,
            Column::Dof,
        ];
        let of = |place: &usize| {
            let heading = self.heading(*place);
            let kind = column(heading).filter(|kind| KINDS.contains(kind))?;
            let kind = if is_standard_symbol(heading) && self.has(Column::Std) {
                Column::Std
            } else {
                kind
            };
            let own = place_of(&self.columns, kind)?;
            let is_product = matches!(kind, Column::Std | Column::Width)
                && place_of(&self.columns, Column::Sensitivity).is_some_and(|c| *place > c);
            let is_value = kind.is_of_place();
            let units =
                [heading, self.heading(own)].map(|of| unit_of_header(of, is_value).ok().flatten());
            let are_of_other_units = matches!(&units, [Some(unit), Some(known)] if unit != known);
            // `Facteur X` may be anything
            let is_known = kind != Column::Divisor
                || WORDS
                    .iter()
                    .any(|(of, all)| *of == kind && all.contains(&plain(heading).as_str()));
            let is_other = !is_known
                || is_deviation(heading)
                || kind == Column::Estimate && is_nominal(heading)
                || is_product
                || are_of_other_units;
            (!is_other).then_some((*place, kind))
        };
        self.unknown.iter().filter_map(of).collect()
    }

    /// A measured value is the estimate where no other column is one but that of nominal values, which
    /// is none beside it.
    fn measured_values(&mut self, cells: &Cells) {
        let own = place_of(&self.columns, Column::Estimate);
        if own.is_some_and(|own| !is_nominal(self.heading(own))) {
            return;
        }
        let comma = cells.decimal_comma();
        let is_measured = |header: &Self, place: usize| {
            MEASURED.contains(&plain(symbol::before_unit(header.heading(place))).as_str())
                && (header.line + 1..cells.lines())
                    .any(|line| number_with_unit(cells.text(line, place), comma).is_some())
        };
        let found: Vec<usize> =
            self.unknown.iter().copied().filter(|place| is_measured(self, *place)).collect();
        match found[..] {
            [] => {}
            [place] => {
                self.unknown.retain(|of| *of != place);
                self.columns.retain(|(_, column)| *column != Column::Estimate);
                self.unknown.extend(own);
                self.columns.push((place, Column::Estimate));
                smallest_first(&mut self.columns, |(place, _)| *place as f64);
            }
            [first, second, ..] => self.doubtful.push(format!(
                "the columns `{}` and `{}` may both be the estimate: head one of them `Estimate`",
                self.heading(first),
                self.heading(second)
            )),
        }
    }

    /// How many cells its lines have.
    pub(super) fn width(&self, cells: &Cells) -> usize {
        (self.first..=self.line).map(|line| cells.row(line).len()).max().unwrap_or(0)
    }

    /// Whether a column of this kind is known.
    pub(super) fn has(&self, wanted: Column) -> bool {
        place_of(&self.columns, wanted).is_some()
    }

    /// Takes an unknown column for one of this kind, if it is the only one that may be.
    fn take_the_one(&mut self, kind: Column, may_be: impl Fn(&Self, usize) -> bool) {
        let found: Vec<usize> =
            self.unknown.iter().copied().filter(|place| may_be(self, *place)).collect();
        if let [place] = found[..] {
            self.unknown.retain(|of| *of != place);
            self.columns.push((place, kind));
        }
    }

    /// A column under other words whose cells name distributions is one of distributions.
    fn named_distributions(&mut self, cells: &Cells) {
        if self.has(Column::Distribution) {
            return;
        }
        self.take_the_one(Column::Distribution, |header, place| {
            let lines = header.line + 1..cells.lines();
            let texts = lines.map(|line| cells.text(line, place).trim());
            let mut named = texts.filter_map(|text| Some((text, NamedShape::of(text)?))).peekable();
            // one letter may be anything
            named.peek().is_some()
                && named.all(|(text, of)| of != NamedShape::Unknown && text.chars().count() > 2)
        });
    }

    /// A column under other words whose cells are `A` and `B` alone has the types of the evaluations.
    fn types_of_evaluations(&mut self, cells: &Cells) {
        self.take_the_one(Column::Evaluation, |header, place| {
            let lines = header.line + 1..cells.lines();
            let texts = lines.map(|line| cells.text(line, place).trim());
            let mut held = texts.filter(|text| !super::rows::is_empty(text)).peekable();
            held.peek().is_some() && held.all(|text| evaluation(text).is_some())
        });
    }

    /// A column of numbers that nothing names and whose words may be those of sensitivity coefficients;
    /// 1 in every row is none that changes anything.
    pub(super) fn possible_coefficients(&self, cells: &Cells) -> Option<usize> {
        const WORDS: [&str; 9] =
            ["coeff", "coef", "koeff", "c_i", "facteur", "faktor", "factor", "empfindlich", "sens"];
        if self.has(Column::Sensitivity) {
            return None;
        }
        let comma = cells.decimal_comma();
        let may_be = |place: &&usize| {
            let words = plain(self.heading(**place));
            WORDS.iter().any(|word| words.contains(word)) && !is_of_correlation(&words) && {
                let lines = self.line + 1..cells.lines();
                let texts = lines.map(|line| cells.text(line, **place).trim());
                let mut values = texts.filter_map(|text| number_with_unit(text, comma));
                values.any(|(value, _)| value != 1.0)
            }
        };
        self.unknown.iter().find(may_be).copied()
    }

    /// The line that most likely is a header which lacks a column of uncertainties, what is known of it,
    /// and the headings that are not.
    pub(super) fn nearly(cells: &Cells) -> Option<(usize, Vec<String>, Vec<String>)> {
        let of_line = |line: usize| {
            let headings = cells.row(line).iter().map(|cell| cell.trim());
            let headings = headings.filter(|cell| !cell.is_empty());
            let (known, unknown): (Vec<&str>, Vec<&str>) =
                headings.partition(|cell| column(cell).is_some());
            let names = [Column::Quantity, Column::Symbol];
            let is_named =
                known.iter().any(|cell| column(cell).is_some_and(|of| names.contains(&of)));
            let owned = |of: Vec<&str>| of.into_iter().map(str::to_owned).collect::<Vec<_>>();
            (is_named && known.len() >= 3).then(|| (line, owned(known), owned(unknown)))
        };
        (0..cells.lines()).filter_map(of_line).max_by_key(|(_, known, _)| known.len())
    }

    /// The first other line that names the columns of this header, or most of them.
    pub(super) fn repeated(&self, cells: &Cells) -> Option<usize> {
        let comma = cells.decimal_comma();
        let is_header = |line: &usize| {
            if (self.first..=self.line).contains(line) {
                return false;
            }
            let row = cells.row(*line);
            let has_number = || row.iter().any(|cell| number_with_unit(cell, comma).is_some());
            let is_named =
                |(place, _): &&(usize, Column)| cells.column(cells.text(*line, *place)).is_some();
            let same = |(place, of): &&(usize, Column)| {
                let cell = cells.text(*line, *place);
                column(cell) == Some(*of) || plain(cell) == plain(self.heading(*place))
            };
            let same = self.columns.iter().filter(is_named).filter(same).count();
            same >= 3 && 3 * same >= 2 * self.columns.len() && !has_number()
        };
        (0..cells.lines()).find(is_header)
    }

    /// The column of the numbers of readings that divisors `√n` are of; `None` where no divisor is.
    pub(super) fn number_of_readings(&self, cells: &Cells) -> Option<usize> {
        let is_count = |place: &&usize| is_number_of_readings(self.heading(**place));
        let place = self.unknown.iter().find(is_count)?;
        let is_used = |line: usize| is_root_of_n(self.cell(cells, line, Column::Divisor));
        (self.line + 1..cells.lines()).any(is_used).then_some(*place)
    }

    /// A standard deviation that divisors `√n` divide is no standard uncertainty yet.
    fn deviations_as_widths(&mut self, cells: &Cells) {
        if self.number_of_readings(cells).is_none()
            || self.has(Column::Width)
            || !is_deviation(self.heading_of(Column::Std))
        {
            return;
        }
        for (_, column) in &mut self.columns {
            if *column == Column::Std {
                *column = Column::Width;
            }
        }
    }

    /// `Value` heads the half-widths and expanded uncertainties where its numbers over the divisors are
    /// the standard uncertainties in every row that has all three, and in two rows at least.
    fn widths_as_values(&mut self, cells: &Cells) {
        let place_of = |wanted: Column| place_of(&self.columns, wanted);
        // `u` beside a divisor may be what is left after it
        let of_quotients = match place_of(Column::Width) {
            None => Column::Std,
            Some(place) if is_standard_symbol(self.heading(place)) => Column::Width,
            Some(_) => return,
        };
        if place_of(Column::Divisor).is_none()
            || of_quotients == Column::Width && place_of(Column::Std).is_some()
        {
            return;
        }
        let is_behind = place_of(Column::Std) > place_of(Column::Sensitivity);
        let coefficients = place_of(Column::Sensitivity).filter(|_| {
            of_quotients == Column::Std && is_behind && !self.has(Column::Contribution)
        });
        let comma = cells.decimal_comma();
        let of = |line: usize, column: Column| value(self.cell(cells, line, column).trim(), comma);
        let rows: Vec<[f64; 4]> = (self.line + 1..cells.lines())
            .filter_map(|line| {
                let all = [Column::Estimate, Column::Divisor, of_quotients];
                let [value, divisor, std] = all.map(|column| of(line, column));
                let c = coefficients.map_or(Some(1.0), |_| of(line, Column::Sensitivity));
                Some([value?, divisor?, std?, c?])
            })
            .collect();
        // factors below 1 multiply
        let multiplies = is_of_factors(self.heading_of(Column::Divisor));
        let is_width = |[value, divisor, std, _]: &[f64; 4]| {
            let is_factor = multiplies && *divisor < 1.0;
            let found = if is_factor { value.abs() * divisor } else { value.abs() / divisor };
            (found - std).abs() <= ROUNDED * std.abs() && *std > 0.0
        };
        // `ui` behind the coefficients may be their products with the quotients
        let is_contribution =
            |[value, divisor, std, c]: &[f64; 4]| is_width(&[c * value, *divisor, std.abs(), 1.0]);
        let are_widths = rows.len() >= 2 && rows.iter().all(is_width);
        let are_contributions = rows.len() >= 2 && !are_widths && rows.iter().all(is_contribution);
        if are_widths || are_contributions {
            for (_, column) in &mut self.columns {
                if *column == of_quotients {
                    *column = if are_widths { Column::Std } else { Column::Contribution };
                } else if *column == Column::Estimate {
                    *column = Column::Width;
                }
            }
            self.has_widths_as_values = true;
        }
    }

    /// `u` beside a divisor is what is left after it where the contributions are its products with the
    /// coefficients, and not those of its quotients.
    fn contributions_of_quotients(&mut self, cells: &Cells) {
        let places = [Column::Width, Column::Divisor, Column::Contribution];
        let [Some(u), Some(divisor), Some(contribution)] =
            places.map(|of| place_of(&self.columns, of))
        else {
            return;
        };
        if !is_standard_symbol(self.heading(u)) || self.has(Column::Std) {
            return;
        }
        let comma = cells.decimal_comma();
        let number = |line: usize, place: usize| value(cells.text(line, place).trim(), comma);
        let c = place_of(&self.columns, Column::Sensitivity);
        let rows: Vec<[f64; 3]> = (self.line + 1..cells.lines())
            .filter_map(|line| {
                let c = c.map_or(Some(1.0), |place| number(line, place))?;
                let product = (c * number(line, u)?).abs();
                Some([product, number(line, divisor)?, number(line, contribution)?.abs()])
            })
            .filter(|[product, divisor, _]| *product > 0.0 && *divisor > 1.1)
            .collect();
        let near = |a: f64, b: f64| (a - b).abs() <= ROUNDED * b;
        let are_left = rows.iter().all(|[product, _, stated]| near(*product, *stated));
        if are_left && !rows.is_empty() {
            for (_, column) in self.columns.iter_mut().filter(|(_, of)| *of == Column::Width) {
                *column = Column::Std;
            }
        }
    }

    /// What could be meant in two ways: standard deviations of a stated number of readings, and a second
    /// column of units right behind uncertainties.
    fn doubts(&mut self, cells: &Cells) {
        let std = self.columns.iter().find(|(_, column)| *column == Column::Std);
        if let Some((place, _)) = std {
            let heading = self.heading(*place);
            let compact: String = heading.to_lowercase().split_whitespace().collect();
            let mut unknown = self.unknown.iter().map(|place| self.heading(*place));
            let number = unknown.find(|heading| is_number_of_readings(heading));
            if is_deviation(heading) && (compact.contains("n=") || number.is_some()) {
                self.doubtful.push(format!(
                    "`{heading}` can be the standard deviation of single readings, to be divided by the \
                     root of their number, or that of their mean: divide it and head the column \
                     `Standard uncertainty`, with a column of degrees of freedom"
                ));
            }
        }
        let coefficients = self.heading_of(Column::Sensitivity).trim();
        if coefficients.to_lowercase().contains("rel") {
            self.doubtful.push(format!(
                "`{coefficients}`: relative coefficients are the exponents of a product: write the equation (`y \
                 = a*b^2`), and estimates and uncertainties as they are"
            ));
        }
        let beside = self.unknown.iter().find(|place| is_deviation(self.heading(**place)));
        if let Some(&place) = beside {
            let comma = cells.decimal_comma();
            let is_lost = |line: &usize| {
                number_with_unit(cells.text(*line, place).trim(), comma).is_some()
                    && Column::UNCERTAIN
                        .iter()
                        .all(|column| self.cell(cells, *line, *column).trim().is_empty())
            };
            if let Some(line) = (self.line + 1..cells.lines()).find(is_lost) {
                self.doubtful.push(format!(
                    "line {} has a number below `{}` and no uncertainty: state its standard \
                     uncertainty, the standard deviation over the root of the number of readings",
                    line + 1,
                    self.heading(place)
                ));
            }
        }
        let of_uncertainty = self.unknown.iter().find(|&&place| {
            let before = place.checked_sub(1);
            column(self.heading(place)) == Some(Column::Unit)
                && self.columns.iter().any(|(of, column)| {
                    Some(*of) == before && matches!(column, Column::Width | Column::Std)
                })
        });
        if let Some(&place) = of_uncertainty {
            let (before, units) = (self.heading(place - 1), self.heading(place));
            let units_of_rows = self.columns.iter().find(|(_, column)| *column == Column::Unit);
            let differ = |line: usize| {
                let own = cells.text(line, place).trim();
                let of_row = units_of_rows.map_or("", |(place, _)| cells.text(line, *place).trim());
                !own.is_empty() && own != of_row
            };
            if (self.line + 1..cells.lines()).any(differ) {
                self.doubtful.push(format!(
                    "a second column `{units}` stands behind `{before}`: write its units behind the \
                     numbers (`30 nm`)"
                ));
            }
        }
    }

    /// A line of units right below the header, `;mm;µm;;;µm` or `X_i;x_i;in mV`, is part of it, and so
    /// is one of symbols.
    fn units_below(&mut self, cells: &Cells) {
        let line = self.line + 1;
        let numbers = self.columns.iter().filter(|(_, column)| column.is_of_numbers());
        let texts: Vec<(Column, &str)> = numbers
            .map(|(place, column)| (*column, cells.text(line, *place).trim()))
            .filter(|(_, text)| !super::rows::is_empty(text))
            .collect();
        let comma = cells.decimal_comma();
        let has_number = texts.iter().any(|(_, text)| {
            number_with_unit(text, comma).is_some() || !text.contains(char::is_alphabetic)
        });
        if texts.len() < 2 || has_number {
            return;
        }
        let name = place_of(&self.columns, Column::Quantity)
            .map_or("", |place| cells.text(line, place).trim());
        let is_of_symbols = !name.is_empty() || texts.iter().any(|(_, text)| is_symbol(text));
        let below: Vec<(Column, &str, Below)> = texts
            .into_iter()
            .map(|(column, text)| (column, text, Below::of(column, text, is_of_symbols)))
            .collect();
        let has_units = below.iter().any(|(_, _, below)| matches!(below, Below::Unit(_)));
        // `a` may be a name, and `X_i` or `Einheit` none
        let heads = column(name).is_some() && name.chars().count() > 2;
        let is_named = !name.is_empty() && !heads && !is_symbol(name);
        // a quantity whose numbers cannot be read is told as one
        let has = |wanted: Below| below.iter().any(|(_, _, below)| *below == wanted);
        if has(Below::Row) || is_named && !has_units && has(Below::Word) {
            return;
        }
        self.line = line;
        if has_units && is_named {
            self.doubtful.push(format!(
                "line {}: `{name}` has units in place of numbers: a line of units below the header has no \
                 name",
                line + 1
            ));
        }
        for (column, text, below) in below {
            match below {
                Below::Unit(unit) => match self.unit(column) {
                    Some(known) if known != unit => self.doubtful.push(format!(
                        "line {}: `{text}` stands below a heading that says `{known}`",
                        line + 1
                    )),
                    Some(_) => {}
                    None => self.units.push((column, unit)),
                },
                Below::Doubtful => self.doubtful.push(format!(
                    "line {}: `{text}` below the header is neither a unit nor a symbol that is known: write \
                     the unit of the column alone (`mV`), and a factor or a probability into the heading, `U \
                     (k=2)`",
                    line + 1
                )),
                Below::Symbol | Below::Word | Below::Row => {}
            }
        }
    }

    /// What the heading of a column says of the coverage of its numbers.
    pub(super) fn coverage(&self, column: Column) -> HeaderCoverage {
        HeaderCoverage::of(self.heading_of(column))
    }

    /// The words at the head of what is such a column; empty where there is none.
    pub(super) fn heading_of(&self, column: Column) -> &str {
        place_of(&self.columns, column).map_or("", |place| self.heading(place))
    }

    /// The words at the head of a column.
    pub(super) fn heading(&self, place: usize) -> &str {
        self.headings.get(place).map_or("", String::as_str)
    }

    /// The units that columns state for their numbers.
    pub(super) fn units_of_columns(&self) -> impl Iterator<Item = &str> {
        self.units.iter().map(|(_, unit)| unit.as_str())
    }

    /// Leaves a column of accuracies or tolerances beside one of standard uncertainties alone, which has them
    /// in it.
    fn limits_beside_standard(&mut self) {
        let Some(place) = place_of(&self.columns, Column::Width) else { return };
        let words = plain(symbol::before_unit(self.heading(place)));
        let is_limit =
            ["accuracy", "max error", "max. error", "maximum error", "genauigkeit", "tolerance"]
                .contains(&words.as_str());
        if is_limit && place_of(&self.columns, Column::Std).is_some() {
            self.columns.retain(|(of, _)| *of != place);
            self.unknown.push(place);
        }
    }

    /// Takes a unit for the columns of numbers that state none; whether there is such a one.
    pub(super) fn take_unit_of_all(&mut self, unit: &str) -> bool {
        let columns: Vec<Column> = self.columns.iter().map(|(_, column)| *column).collect();
        let count = self.units.len();
        for column in columns {
            if column.is_of_numbers() && column != Column::Relative && self.unit(column).is_none() {
                self.units.push((column, unit.to_owned()));
            }
        }
        self.units.len() > count
    }

    /// The unit that a column states for its numbers.
    pub(super) fn unit(&self, column: Column) -> Option<&str> {
        self.units.iter().find(|(of, _)| *of == column).map(|(_, unit)| unit.as_str())
    }
}

/// Takes values for widths where no column has uncertainties, and the values over the divisors, times the
/// coefficients, are the contributions in two rows at least.
fn widths_by_contributions(cells: &Cells, line: usize, columns: &mut [(usize, Column)]) -> bool {
    if Column::UNCERTAIN.into_iter().any(|of| place_of(columns, of).is_some()) {
        return false;
    }
    let [Some(estimate), Some(divisor), Some(contribution)] =
        [Column::Estimate, Column::Divisor, Column::Contribution].map(|of| place_of(columns, of))
    else {
        return false;
    };
    let comma = cells.decimal_comma();
    let number = |line: usize, place: usize| value(cells.text(line, place).trim(), comma);
    let c = place_of(columns, Column::Sensitivity);
    let rows: Vec<[f64; 2]> = (line + 1..cells.lines())
        .filter_map(|line| {
            let c = c.map_or(Some(1.0), |place| number(line, place))?;
            let product = c * number(line, estimate)? / number(line, divisor)?;
            Some([product.abs(), number(line, contribution)?.abs()])
        })
        .collect();
    let is_it = |[product, stated]: &[f64; 2]| {
        *stated > 0.0 && (product - stated).abs() <= ROUNDED * stated
    };
    let are_widths = rows.len() >= 2 && rows.iter().all(is_it);
    if let Some((_, column)) =
        columns.iter_mut().find(|(place, _)| are_widths && *place == estimate)
    {
        *column = Column::Width;
    }
    are_widths
}

/// Whether a column has names below a line, and no numbers.
fn has_names(cells: &Cells, line: usize, place: usize) -> bool {
    let texts = (line + 1..cells.lines()).map(|line| cells.text(line, place).trim());
    let mut held = texts.filter(|text| !super::rows::is_empty(text)).peekable();
    let comma = cells.decimal_comma();
    held.peek().is_some() && held.all(|text| number_with_unit(text, comma).is_none())
}

/// Whether a column has numbers below a line, and nothing else.
fn has_numbers_alone(cells: &Cells, line: usize, place: usize) -> bool {
    let texts = (line + 1..cells.lines()).map(|line| cells.text(line, place).trim());
    let mut held = texts.filter(|text| !super::rows::is_empty(text)).peekable();
    let comma = cells.decimal_comma();
    held.peek().is_some() && held.all(|text| number_with_unit(text, comma).is_some())
}

/// The headings of a line and the one before, which heads several of its columns together (`Uncertainty`
/// above `Half-width`, `Distribution` and `Divisor`); `None` where the one before does not.
fn of_two_lines(cells: &Cells, line: usize) -> Option<Vec<String>> {
    let (above, below) = (cells.row(line - 1), cells.row(line));
    let comma = cells.decimal_comma();
    if below.iter().any(|cell| number_with_unit(cell, comma).is_some()) {
        return None;
    }
    let is_blank = |place: usize| cells.text(line - 1, place).trim().is_empty();
    let names_column = |place: usize| cells.column(cells.text(line, place)).is_some();
    // an empty cell behind a heading belongs to it
    let is_together =
        |place: usize| is_blank(place) || is_blank(place + 1) && names_column(place + 1);
    let count = above.len().max(below.len());
    let headings = (0..count).map(|place| {
        let is_own = place > 0 && is_together(place) && names_column(place);
        cells.text(if is_own { line } else { line - 1 }, place).to_owned()
    });
    let heads = (0..count).any(|place| !is_blank(place) && is_blank(place + 1));
    heads.then(|| headings.collect())
}

/// Whether a heading is that of numbers of readings.
fn is_number_of_readings(heading: &str) -> bool {
    const WORDS: [&str; 23] = [
        "n",
        "n_i",
        "ni",
        "count",
        "sample size",
        "readings",
        "measurements",
        "observations",
        "repeats",
        "replicates",
        "number of readings",
        "number of measurements",
        "number of observations",
        "no. of readings",
        "no. of measurements",
        "no of readings",
        "no of measurements",
        "anzahl",
        "anzahl messungen",
        "anzahl der messungen",
        "messungen",
        "nombre de mesures",
        "nombre d'observations",
    ];
    WORDS.contains(&plain(heading).as_str())
}

/// Whether a divisor is the root of the number of readings: `√n`, `sqrt(n)`.
pub(super) fn is_root_of_n(text: &str) -> bool {
    let compact: String = text.to_lowercase().split_whitespace().collect();
    let compact = compact.replace("sqrt", "√").replace("wurzel", "√").replace("racine", "√");
    matches!(compact.replace(['(', ')'], "").as_str(), "√n" | "n^0.5" | "n^0,5")
}

/// Whether a heading is of factors, of which a sheet may multiply by them.
pub(super) fn is_of_factors(heading: &str) -> bool {
    matches!(plain(heading).as_str(), "factor" | "faktor" | "facteur" | "multiplier")
}

/// A header without what stands in brackets.
pub(super) fn plain_case(text: &str) -> &str {
    text.split(['(', '[']).next().unwrap_or_default().trim()
}

/// Whether a row's words are those of a coverage factor.
pub(crate) fn is_factor(words: &str) -> bool {
    const FACTORS: [&str; 8] = [
        "factor de cobertura",
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

/// Whether a row's words are those of the effective degrees of freedom of a result.
pub(super) fn is_effective_dof(words: &str) -> bool {
    let words = plain(words);
    const WORDS: [&str; 9] = [
        "effective degrees of freedom",
        "effective dof",
        "eff. dof",
        "eff. degrees of freedom",
        "effektive freiheitsgrade",
        "eff. freiheitsgrade",
        "degrés de liberté effectifs",
        "ddl effectifs",
        "grados efectivos de libertad",
    ];
    WORDS.iter().any(|of| words.starts_with(of))
}

/// The letter of a type of evaluation, `A`, `Type B`.
pub(super) fn evaluation(text: &str) -> Option<char> {
    let text = text.trim();
    let letter =
        ["Type ", "type ", "Typ ", "TYPE "].iter().find_map(|word| text.strip_prefix(word));
    match letter.unwrap_or(text) {
        "A" => Some('A'),
        "B" => Some('B'),
        _ => None,
    }
}

/// Whether a heading is of half-widths or limits of errors, which are no standard uncertainties.
pub(super) fn is_of_limits(heading: &str) -> bool {
    const WORDS: [&str; 30] = [
        "halbe breite",
        "halbe weite",
        "accuracy",
        "max error",
        "max. error",
        "genauigkeit",
        "error limit",
        "límite",
        "semiamplitud",
        "semiancho",
        "semirango",
        "tolerancia",
        "half-width",
        "half width",
        "halfwidth",
        "semi-range",
        "tolerance",
        "maximum permissible",
        "max. permissible",
        "max permissible",
        "mpe",
        "limit",
        "halbbreite",
        "halbweite",
        "grenze",
        "fehlergrenze",
        "toleranz",
        "demi-",
        "tolérance",
        "erreur maximale",
    ];
    let words = plain(symbol::before_unit(heading));
    words == "a" || WORDS.iter().any(|of| words.starts_with(of))
}

/// Whether a heading says that shares below it are of the estimates.
pub(super) fn is_share_of_estimate(heading: &str) -> bool {
    let signs = ["%", "‰", "ppm", "ppb"];
    let behind = signs.iter().find_map(|sign| Some(heading.split_once(sign)?.1));
    behind.is_some_and(|words| is_of_estimate(words.trim_end_matches([')', ']'])))
}

/// Whether a row's words are those of an expanded uncertainty.
pub(super) fn is_expanded(words: &str) -> bool {
    let words = plain(words);
    ["expanded", "erweiterte", "élargie", "expandida"].iter().any(|of| words.contains(of))
        && !words.contains("factor")
}

/// Whether a row that is one of results holds an uncertainty and not the result's estimate.
pub(super) fn is_of_uncertainty(words: &str) -> bool {
    if is_expanded_symbol(words) {
        return true;
    }
    let words = plain(words);
    ["uncertainty", "unsicherheit", "incertitude", "incertidumbre", "freedom", "freiheitsgrad"]
        .iter()
        .any(|of| words.contains(of))
        || words == "combined"
        || words.split_whitespace().any(|word| matches!(word, "expanded" | "erweitert" | "élargie"))
        || is_factor(&words)
}

/// Whether a row's words are those of a result.
pub(super) fn is_result(words: &str) -> bool {
    let words = plain(words);
    RESULTS.iter().any(|of| words == *of)
        || [
            "combined ",
            "expanded ",
            "kombinierte ",
            "erweiterte ",
            "comb. ",
            "incertitude composée",
            "incertitude-type composée",
            "incertitude type composée",
            "incertitude élargie",
            "incertidumbre combinada",
            "incertidumbre típica combinada",
            "incertidumbre estándar combinada",
            "incertidumbre expandida",
        ]
        .iter()
        .any(|begin| words.starts_with(begin))
}

/// Whether a text speaks of correlation.
pub(super) fn is_of_correlation(text: &str) -> bool {
    let words = text.to_lowercase();
    let compact: String = words.split_whitespace().collect();
    let denies = ["uncorrel", "unkorrel", "nocorrel", "keinekorrel", "noncorrél", "notcorrel"];
    if denies.iter().any(|word| compact.contains(word)) {
        return false;
    }
    ["correl", "korrel", "corrél"].iter().any(|word| words.contains(word))
        || compact.starts_with("r(") && compact.contains('=')
        || ["r(", "ρ("].iter().any(|begin| compact.starts_with(begin))
            && compact.ends_with(')')
            && compact.contains([',', ';'])
        || compact.contains(":r=")
}

/// Whether a symbol is that of a combined standard uncertainty, `u_c(y)`.
pub(super) fn is_combined_symbol(words: &str) -> bool {
    let compact: String = words.split('(').next().unwrap_or_default().split_whitespace().collect();
    matches!(compact.as_str(), "uc" | "u_c")
}

/// Whether a row at the end of a budget is of a summary by its symbol: `U`, `k`, `u_c`, `veff`.
pub(super) fn is_summary_symbol(words: &str) -> bool {
    const SYMBOLS: [&str; 12] =
        ["U", "u", "k", "p", "uc", "u_c", "veff", "v_eff", "νeff", "ν_eff", "nu_eff", "dof"];
    let compact: String =
        words.split(['(', '=']).next().unwrap_or_default().split_whitespace().collect();
    SYMBOLS.contains(&compact.as_str()) || probability_of_symbol(&compact).is_some()
}

/// The probability that the symbol of an expanded uncertainty states: `U95`, `U_0.95`, `U95%`.
pub(super) fn probability_of_symbol(words: &str) -> Option<f64> {
    let index = words.trim().strip_prefix('U')?.trim_start_matches('_').trim_end_matches('%');
    let p = index.replace(',', ".").parse::<f64>().ok()?;
    let p = if p >= 50.0 { p / 100.0 } else { p };
    (0.5..1.0).contains(&p).then_some(p)
}

/// Degrees of freedom without the type of the evaluation, which is often said with them: `9 (A)`.
pub(super) fn without_type(text: &str) -> &str {
    let of_type = |text: &str| {
        let (plain, inside) = text.strip_suffix(')')?.rsplit_once('(')?;
        let inside = inside.to_lowercase();
        let letter = inside.strip_prefix("type").or_else(|| inside.strip_prefix("typ"));
        matches!(letter.unwrap_or(&inside).trim(), "a" | "b").then_some(plain.len())
    };
    let text = text.trim();
    of_type(text).map_or(text, |length| text[..length].trim_end())
}

/// A name and the unit that stands in brackets behind it, `dT [K]`, `A (mV)`; `None` where there is none. A
/// letter in parentheses is a symbol, `Length (L)`, or the type of an evaluation.
pub(super) fn with_unit_in_brackets(words: &str) -> Option<(&str, String)> {
    let brackets = |open: char, close: char| words.trim().strip_suffix(close)?.rsplit_once(open);
    let is_unit = |unit: &str| unit.trim().chars().count() > 1;
    let (name, unit) =
        brackets('[', ']').or_else(|| brackets('(', ')').filter(|(_, unit)| is_unit(unit)))?;
    // `u(V)` and `r(m)` are names, and so is `Value (2)`
    let is_argument = words.trim().ends_with(')') && !name.ends_with(char::is_whitespace);
    let (name, unit) = (name.trim(), without_in(unit.trim()));
    let is_value = unit.starts_with(|c: char| c.is_ascii_digit()) && !unit.starts_with("1/");
    if name.is_empty() || unit.is_empty() || is_argument || is_value {
        return None;
    }
    let unit = Unit::parse(unit).map(|_| unit.to_owned()).ok().or_else(|| unit_as_meant(unit))?;
    Some((name, unit))
}

/// A unit as tables have it that formulas could not: `/K` for `1/K`, `K-1` and `m/s2` for `K^-1` and
/// `m/s^2`, `mOhm` for `mohm`.
pub(super) fn unit_as_meant(text: &str) -> Option<String> {
    let written = text;
    let text = &text.replace("Ohm", "ohm");
    let mut meant = String::new();
    if text.starts_with('/') {
        meant.push('1');
    }
    let mut before = ' ';
    let mut signs = text.chars().peekable();
    while let Some(sign) = signs.next() {
        let next_is_digit = signs.peek().is_some_and(char::is_ascii_digit);
        let begins_power = sign.is_ascii_digit() || (matches!(sign, '-' | '−') && next_is_digit);
        if begins_power && before.is_alphabetic() {
            meant.push('^');
        }
        meant.push(if sign == '−' { '-' } else { sign });
        before = sign;
    }
    (meant != written && Unit::parse(&meant).is_ok()).then_some(meant)
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
