//! Half-widths and full widths: what a heading or the cell of a distribution says of the numbers beside
//! it. Shapes are stated by their half-width (JCGM 100, 4.3.7).

use gumption_engine::decimal::to_15_digits;
use gumption_engine::number::Shortest;

use super::Budget;
use super::columns::{Column, Header};
use super::coverage::HeaderCoverage;
use super::number::number;
use super::rows::{Row, divisor_of, near};
use super::stated::half_digit;
use gumption_text::value_text::with_plus_minus;

/// How much of a shape a number spans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// From the middle to a limit.
    Half,
    /// From limit to limit.
    Full,
}

impl Extent {
    /// What a text says; `None` where it says nothing.
    pub(super) fn of(text: &str) -> Option<Self> {
        const HALF: [&str; 13] = [
            "halfwidth",
            "halfrange",
            "semirange",
            "semiwidth",
            "halfinterval",
            "semispan",
            "halbbreite",
            "halbweite",
            "halbespannweite",
            "demilargeur",
            "demiétendue",
            "demietendue",
            "±",
        ];
        const FULL: [&str; 20] = [
            "peaktopeak",
            "pktopk",
            "pkpk",
            "spitzespitze",
            "crêteàcrête",
            "fullwidth",
            "fullrange",
            "fullspan",
            "totalwidth",
            "totalrange",
            "wholewidth",
            "wholerange",
            "maxmin",
            "vollbreite",
            "vollebreite",
            "gesamtbreite",
            "spannweite",
            "étendue",
            "etendue",
            "largeurtotale",
        ];
        let signed = with_plus_minus(&text.to_lowercase());
        let compact: String = signed.chars().filter(|c| c.is_alphabetic() || *c == '±').collect();
        let has = |words: &[&str]| words.iter().any(|word| compact.contains(word));
        if has(&HALF) { Some(Self::Half) } else { has(&FULL).then_some(Self::Full) }
    }

    /// What a name says in brackets or behind a comma, `Resolution (full width)`, and those words; `Full range
    /// of the instrument` says nothing, nor do words with a number, `full width 0.1 mV`, which is theirs.
    fn of_name(name: &str) -> Option<(Self, &str)> {
        let mut pieces = name.split(['(', ')', '[', ']', ',', ';']).skip(1).map(str::trim);
        pieces.find_map(|piece| {
            let is_of_instrument = piece.to_lowercase().contains("full range");
            let is_plain = !piece.contains(|c: char| c.is_ascii_digit()) && !is_of_instrument;
            Some((Self::of(piece).filter(|_| is_plain)?, piece))
        })
    }
}

/// Whether words that speak of a full width can be those of a quantity, too.
fn is_peak_to_peak(words: &str) -> bool {
    let words = words.to_lowercase();
    ["peak", "pk", "spitze", "crête"].iter().any(|word| words.contains(word))
}

/// The first word of a distribution's cell that could change what the number beside it means and is not
/// understood.
fn unknown_word(text: &str) -> Option<&str> {
    const WHOLE: [&str; 12] = [
        "width", "range", "span", "peak", "pk", "pp", "k", "sigma", "σ", "largeur", "full", "total",
    ];
    const PARTS: [&str; 2] = ["breite", "weite"];
    if Extent::of(text).is_some() || HeaderCoverage::of(text).factor(None).is_some() {
        return None;
    }
    let changes = |word: &&str| {
        let small = word.to_lowercase();
        WHOLE.contains(&small.as_str()) || PARTS.iter().any(|part| small.contains(part))
    };
    // all of a shape lies within its limits
    let share = text.find('%').filter(|at| !text[..*at].trim_end().ends_with("100"));
    let pp = text.to_lowercase().find("p-p");
    let sign = share.map(|at| &text[at..=at]).or(pp.and_then(|at| text.get(at..at + 3)));
    // `2s`, of standard deviations
    let deviations = || {
        text.split(|c: char| !c.is_alphanumeric()).find(|word| {
            let word = word.to_lowercase();
            let digits = word.strip_suffix("sd").or(word.strip_suffix('s')).unwrap_or_default();
            !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
        })
    };
    let words = text.split(|c: char| !c.is_alphabetic()).skip(1);
    words.into_iter().find(changes).or(sign).or_else(deviations)
}

/// A root as people write it, `√3`.
fn root_of(root: f64) -> String {
    format!("√{}", Shortest((root * root).round()))
}

/// A number of standard deviations as two words, `2 SD` or `2 s`: the number, and the second word.
fn standard_deviations(text: &str) -> Option<(f64, &str)> {
    const WORDS: [&str; 7] = ["s", "sd", "sds", "std", "stdev", "stddev", "standard"];
    let mut words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let mut before = words.next()?;
    words.find_map(|word| {
        let number = std::mem::replace(&mut before, word);
        let is_number = number.bytes().all(|byte| byte.is_ascii_digit());
        let is_it = is_number && WORDS.contains(&word.to_lowercase().as_str());
        Some((number.parse().ok().filter(|_| is_it)?, word))
    })
}

impl Budget<'_> {
    /// Takes a divisor with few digits, 1.7, for the root that its row's shape has and that it is rounded
    /// from. A whole number is a factor.
    fn rounded_divisor(&mut self, header: &Header, row: &mut Row) {
        let text = header.cell(self.cells, row.line, Column::Divisor).trim();
        let is_fraction = text.contains(['.', ',']);
        let stated = number(text, self.cells.decimal_comma()).filter(|_| is_fraction);
        let Some((stated, usual)) = stated.zip(row.distribution.and_then(divisor_of)) else {
            return;
        };
        let is_it = |of: &f64| (stated - of).abs() <= half_digit(text) && !near(stated, *of);
        if let Some(root) = [usual, 2.0 * usual].into_iter().find(is_it) {
            row.divisor = Some(root);
            self.understood.push(format!(
                "line {}: the divisor {text} is taken for {}, rounded",
                row.line + 1,
                root_of(root)
            ));
        }
    }

    /// Halves the width of a row whose divisor is that of a full width: the root of 12 in place of that of 3.
    /// It is said as a guess where words speak of a half-width (`is_half`).
    fn full_by_divisor(&mut self, header: &Header, row: &mut Row, is_half: bool) {
        let usual = row.distribution.and_then(divisor_of);
        let Some((width, usual)) = row.width.zip(usual) else { return };
        if !row.divisor.is_some_and(|divisor| near(divisor, 2.0 * usual)) {
            return;
        }
        let half = to_15_digits(0.5 * width);
        row.width = Some(half);
        row.divisor = Some(usual);
        let text = header.cell(self.cells, row.line, Column::Divisor).trim();
        let said = format!(
            "line {}: the divisor `{text}` is that of a full width: half of {} is taken, {}",
            row.line + 1,
            Shortest(width),
            Shortest(half)
        );
        if is_half { self.guessed.push(said) } else { self.understood.push(said) }
    }

    /// Halves what the row's distribution or the heading of its uncertainty calls a full width; `between`
    /// says that the width is that of two limits.
    pub(super) fn extent(&mut self, header: &Header, row: &mut Row, between: bool) {
        self.rounded_divisor(header, row);
        let text = header.cell(self.cells, row.line, Column::Distribution).trim().to_owned();
        let name = header.cell(self.cells, row.line, Column::Quantity).to_owned();
        // a voltage from peak to peak has a value, and an expanded uncertainty no limits
        let is_of_limits = row.estimate.is_none_or(|of| of == 0.0)
            && row.distribution.is_none_or(|of| divisor_of(of).is_some());
        let of_name =
            Extent::of_name(&name).filter(|(_, words)| is_of_limits || !is_peak_to_peak(words));
        let is_uncertain = row.std.is_some_and(|std| std > 0.0);
        if let Some((Extent::Full, words)) = of_name.filter(|_| row.width.is_none() && is_uncertain)
        {
            let reason = format!(
                "`{words}` in the name, but `{}` is the heading of standard uncertainties: which is it? Head the column `Half-width` and write half of the width",
                header.heading_of(Column::Std).trim()
            );
            return self.fail(row.line, reason);
        }
        let Some(width) = row.width.filter(|width| *width > 0.0 && !between) else { return };
        if let Some(word) = unknown_word(&text) {
            let reason = format!(
                "`{text}`: what `{word}` says of the uncertainty is not understood; a half-width, a full \
                 width, a factor (`k=2`, `2σ`) and a coverage probability (`95 %`) are"
            );
            self.fail(row.line, reason);
            return;
        }
        let heading = header.heading_of(Column::Width).to_owned();
        // a divisor of that number says the same
        let says = |text| {
            standard_deviations(text).filter(|(k, _)| row.divisor.is_none_or(|of| !near(of, *k)))
        };
        let of_row = says(&text).map(|(_, word)| (&text, word));
        let of_heading =
            || says(&heading).filter(|_| row.divisor.is_none()).map(|(_, word)| (&heading, word));
        if let Some((text, word)) = of_row.or_else(of_heading) {
            let reason = format!(
                "`{text}`: what `{word}` says of the uncertainty is not understood; a factor (`k=2`, `2σ`) is"
            );
            self.fail(row.line, reason);
            return;
        }
        let (of_cell, of_heading) = (Extent::of(&text), Extent::of(&heading));
        // `±` in a heading is a sign of all its rows, which a name may say more of
        let is_of_words =
            of_heading.is_some_and(|_| Extent::of(&heading.replace('±', "")).is_some());
        let others = [of_cell, of_heading.filter(|_| is_of_words)];
        if let Some((extent, words)) = of_name
            && let Some(other) = others.into_iter().flatten().find(|other| *other != extent)
        {
            let other = if other == Extent::Half { "a half-width" } else { "a full width" };
            let reason = format!(
                "`{words}` in the name, but the {} says {other}: which is it?",
                if of_cell.is_some_and(|of| of != extent) { "distribution" } else { "heading" }
            );
            return self.fail(row.line, reason);
        }
        let of_name = of_name.filter(|_| of_cell.is_none());
        let whole = match (of_cell, of_heading) {
            _ if of_name.is_some_and(|(extent, _)| extent == Extent::Full) => {
                name.trim().to_owned()
            }
            (Some(cell), Some(head)) if cell != head => {
                let reason = format!(
                    "the heading `{heading}` and `{text}` contradict each other: write half-widths"
                );
                self.fail(row.line, reason);
                return;
            }
            (Some(Extent::Full), _) => text,
            (_, Some(Extent::Full)) => heading,
            (of_cell, of_heading) => {
                return self.full_by_divisor(header, row, of_cell.or(of_heading).is_some());
            }
        };
        let half = to_15_digits(0.5 * width);
        let usual = row.distribution.and_then(divisor_of);
        let is_divided = match (usual, row.divisor) {
            (None, _) if row.distribution.is_none() => None,
            // a normal one has no limits: half of its interval is an expanded uncertainty
            (None, divisor) => {
                let cell = header.cell(self.cells, row.line, Column::Distribution);
                let is_stated = divisor.is_some()
                    || HeaderCoverage::of(cell).factor(None).is_some()
                    || header.coverage(Column::Width).factor(None).is_some();
                is_stated.then_some(false)
            }
            (Some(_), None) => Some(false),
            // the root of 12 in place of that of 3
            (Some(usual), Some(divisor)) if near(divisor, 2.0 * usual) => Some(true),
            (Some(usual), Some(divisor)) => {
                let std = row.std.filter(|std| near(divisor, usual) && near(half / divisor, *std));
                std.map(|_| false)
            }
        };
        match is_divided {
            Some(is_divided) => {
                row.width = Some(half);
                row.divisor = row.divisor.map(|of| if is_divided { 0.5 * of } else { of });
                self.understood.push(format!(
                    "line {}: `{whole}`: half of {} is taken, {}",
                    row.line + 1,
                    Shortest(width),
                    Shortest(half)
                ));
            }
            None => {
                let divisor = row.divisor.map_or_else(String::new, |divisor| {
                    let text = header.cell(self.cells, row.line, Column::Divisor).trim();
                    match text {
                        "" => format!(" and the divisor {}", Shortest(divisor)),
                        text => format!(" and the divisor {text}"),
                    }
                });
                self.fail(
                    row.line,
                    format!(
                        "`{whole}`{divisor} can be {} or {} that is divided: write the half-width and what \
                         it is divided by",
                        Shortest(width),
                        Shortest(half)
                    ),
                );
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_widths() {
        for (text, extent) in [
            ("rectangular (full width)", Some(Extent::Full)),
            ("Rechteck (Vollbreite)", Some(Extent::Full)),
            ("rectangular, range (max-min)", Some(Extent::Full)),
            ("rectangulaire (étendue totale)", Some(Extent::Full)),
            ("rectangulaire (demi-étendue)", Some(Extent::Half)),
            ("rectangular (semi-range)", Some(Extent::Half)),
            ("rectangular (Type B)", None),
        ] {
            assert_eq!(Extent::of(text), extent, "{text}");
        }
        for (text, word) in [
            ("rectangular (peak)", Some("peak")),
            ("rectangular (p-p)", Some("p-p")),
            ("normal (k)", Some("k")),
            ("normal (2s)", Some("2s")),
            ("normal, 2SD", Some("2SD")),
            ("rectangular (manufacturer's)", None),
            ("rectangular (range)", Some("range")),
            ("rectangular (5 %)", Some("%")),
            ("rectangular (100 %)", None),
            ("normal (95 %)", None),
            ("normal, 2σ", None),
            ("rectangular (Type B)", None),
            ("normal (certificate)", None),
            ("U-shaped", None),
            ("rectangular (full width)", None),
        ] {
            assert_eq!(unknown_word(text), word, "{text}");
        }
    }

    #[test]
    fn widths_in_names() {
        for (name, extent) in [
            ("Resolution (full width)", Some(Extent::Full)),
            ("Auflösung (volle Breite)", Some(Extent::Full)),
            ("Résolution, étendue", Some(Extent::Full)),
            ("Resolution (half-width)", Some(Extent::Half)),
            ("Noise (peak-to-peak)", Some(Extent::Full)),
            ("Linearity (full range)", None),
            ("Étendue de mesure", None),
            ("Resolution (full width 0.1 mV)", None),
        ] {
            assert_eq!(Extent::of_name(name).map(|(of, _)| of), extent, "{name}");
        }
    }

    #[test]
    fn numbers_of_standard_deviations() {
        for (text, found) in [
            ("normal (2 SD)", Some((2.0, "SD"))),
            ("normal (2 s)", Some((2.0, "s"))),
            ("U (3 standard deviations)", Some((3.0, "standard"))),
            ("normal (certificate no. 2, standards)", None),
            ("s", None),
        ] {
            assert_eq!(standard_deviations(text), found, "{text}");
        }
    }
}
