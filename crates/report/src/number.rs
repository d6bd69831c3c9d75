//! Numbers for people: an estimate with the digits of its uncertainty, and decimal points that stand
//! under each other (JCGM 100, 7.2.6). The rounding itself is [`gumption_engine::decimal`]'s.

use gumption_engine::propagate::monte_carlo::MonteCarlo;

pub(crate) use gumption_engine::decimal::{MISSING, exact, position, rounded, significant};

use gumption_engine::decimal::{Decimal, to_position};

/// The position that two demands allow: the coarser one, or the only one there is.
pub fn coarser(a: Option<i32>, b: Option<i32>) -> Option<i32> {
    a.max(b)
}

/// A value to a position (the power of ten of the last digit) if there is one, otherwise exactly.
pub fn to(value: f64, position: Option<i32>) -> String {
    position.map_or_else(|| exact(value), |position| rounded(value, position))
}

/// `1 degree of freedom`, `12 degrees of freedom`.
pub(crate) fn degrees_of_freedom(number: &str) -> String {
    let degrees = if number == "1" { "degree" } else { "degrees" };
    format!("{number} {degrees} of freedom")
}

/// A figure from trials to a position, without the digits that its numerical standard error
/// does not justify: those behind the position of the error's leading digit.
///
/// ```
/// use gumption_report::number::justified;
///
/// assert_eq!(justified(8.191_524, Some(-5), 0.0003), "8.1915");
/// assert_eq!(justified(8.191_524, Some(-2), 0.0003), "8.19");
/// ```
pub fn justified(value: f64, position: Option<i32>, error: f64) -> String {
    to(value, coarser(position, self::position(error, 1)))
}

/// A probability in percent as pages print it: with two decimals at most, and without the digits that
/// its numerical standard error does not justify. What rounds to 0 % or to 100 % is neither, and is
/// said to lie beyond the nearest number that is printed otherwise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Percent {
    /// A number.
    At(String),
    /// More than a number: what rounds to 100 %.
    MoreThan(String),
    /// Less than a number: what rounds to 0 %.
    LessThan(String),
}

impl Percent {
    /// Decimal place of probabilities in percent.
    const PLACE: i32 = -2;

    /// A probability with its numerical standard error; `trials` is how many of them it is the share
    /// of, if it is one. Where all of them agree, the probability of the contrary is at most 3 over
    /// their number (with 95 %: 0.95 = 1 - (1 - 3/n)^n), which the number that is printed allows for.
    pub(crate) fn of(share: f64, error: f64, trials: Option<u64>) -> Self {
        let percent = 100.0 * share;
        let place = match trials.filter(|_| share <= 0.0 || share >= 1.0) {
            Some(trials) => {
                let most = 300.0 / trials as f64;
                (Self::PLACE..2).find(|place| Decimal::new(1, *place).value() >= most).unwrap_or(2)
            }
            None => coarser(Some(Self::PLACE), position(100.0 * error, 1)).unwrap_or(Self::PLACE),
        };
        let (unit, near) = (Decimal::new(1, place).value(), to_position(percent, place));
        // so few trials tell nothing
        if place >= 2 {
            return Self::At(rounded(percent, 0));
        }
        if near >= 100.0 {
            Self::MoreThan(rounded(100.0 - unit, place))
        } else if near <= 0.0 {
            Self::LessThan(rounded(unit, place))
        } else {
            Self::At(rounded(percent, place))
        }
    }

    /// In English, without the sign.
    pub(crate) fn text(&self) -> String {
        match self {
            Self::At(number) => number.clone(),
            Self::MoreThan(number) => format!("more than {number}"),
            Self::LessThan(number) => format!("less than {number}"),
        }
    }
}

/// The position of the last digit of the median and of the ends of coverage intervals: that of the
/// standard uncertainty, unless it is larger than half of the interval. So it is where few trials of
/// a long tail make it, or where there is none: then half the interval says how finely its ends are
/// told apart.
pub fn place_of_ends(figures: &MonteCarlo, uncertainty: Option<f64>, digits: u32) -> Option<i32> {
    let [low, high] = figures.symmetric_interval;
    let half = 0.5 * high - 0.5 * low;
    let width = uncertainty.map_or(half, |u| if half > 0.0 { u.min(half) } else { u });
    position(width, digits)
}

/// An estimate and its standard uncertainty as a report prints them: the uncertainty to `digits`
/// significant digits, the estimate to the same position (JCGM 100, 7.2.6).
///
/// ```
/// use gumption_report::number::with_uncertainty;
///
/// let (y, u) = with_uncertainty(10.057_62, 0.0996, 2);
/// assert_eq!((y.as_str(), u.as_str()), ("10.06", "0.10"));
/// ```
pub fn with_uncertainty(estimate: f64, uncertainty: f64, digits: u32) -> (String, String) {
    let position = position(uncertainty, digits);
    (to(estimate, position), to(uncertainty, position))
}

/// A correlation coefficient: as it is where somebody has stated it, to six decimals at most; else, one
/// that was computed, to three decimals (JCGM 100, 7.2.6), near 1 to two digits of what it lacks.
///
/// ```
/// use gumption_report::number::coefficient;
///
/// assert_eq!(coefficient(-0.355_311), "-0.355311");
/// assert_eq!(coefficient(-0.904_534_033_733), "-0.905");
/// assert_eq!(coefficient(0.999_912_345_678), "0.999912");
/// ```
pub fn coefficient(r: f64) -> String {
    if to_position(r, -6) == r {
        return exact(r);
    }
    let lacking = position(1.0 - r.abs(), 2).unwrap_or(-3);
    rounded(r, lacking.clamp(-9, -3))
}

/// Pads texts with spaces, so that their decimal points stand under each other and all have the
/// same width.
///
/// ```
/// use gumption_report::number::align;
///
/// assert_eq!(align(&["10.5", "-3", "1e-7"]), ["10.5 ", "-3   ", " 1e-7"]);
/// ```
pub fn align<S: AsRef<str>>(texts: &[S]) -> Vec<String> {
    let split = |text: &S| {
        let text = text.as_ref();
        let whole = text.find(['.', ',', 'e']).or_else(|| text.find("\u{202f}×"));
        let whole = whole.unwrap_or(text.len());
        (text[..whole].chars().count(), text[whole..].chars().count())
    };
    let sizes: Vec<(usize, usize)> = texts.iter().map(split).collect();
    let left = sizes.iter().map(|size| size.0).max().unwrap_or(0);
    let right = sizes.iter().map(|size| size.1).max().unwrap_or(0);
    let pad = |(text, (whole, rest)): (&S, &(usize, usize))| {
        format!("{0:1$}{2}{0:3$}", "", left - whole, text.as_ref(), right - rest)
    };
    texts.iter().zip(&sizes).map(pad).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uncertainties_and_estimates_to_match() {
        let pairs = [
            ((10.0, 9.96), ("10", "10")),
            ((1234.5, 99.6), ("1230", "100")),
            ((123_456.0, 999.9), ("123500", "1000")),
            ((0.123_45, 0.0996), ("0.12", "0.10")),
            ((56_789.0, 1234.0), ("56800", "1200")),
            ((-56_789.0, 1234.0), ("-56800", "1200")),
            ((-8.191_52, 0.0123), ("-8.192", "0.012")),
            ((0.0, 0.0123), ("0.000", "0.012")),
            ((1.234_56e-12, 1.2e-14), ("1.235e-12", "1.2e-14")),
            ((1e300, 1.5e298), ("1.000e300", "1.5e298")),
            ((12.0, 0.0), ("12", "0")),
            ((0.1 + 0.2, 0.0), ("0.3", "0")),
            ((9_999_999.6, 0.15), ("9999999.60", "0.15")),
            ((9.996, 0.012), ("9.996", "0.012")),
            ((9.9996, 0.012), ("10.000", "0.012")),
            ((0.3, 4.0), ("0.3", "4.0")),
            ((-0.04, 40.0), ("0", "40")),
            ((60.0, 4000.0), ("100", "4000")),
            ((50.0, 4000.0), ("100", "4000")),
            ((f64::NAN, 0.5), ("-", "0.50")),
            ((1.5, f64::INFINITY), ("1.5", "-")),
        ];
        for ((estimate, uncertainty), (y, u)) in pairs {
            let got = with_uncertainty(estimate, uncertainty, 2);
            assert_eq!(got, (y.to_owned(), u.to_owned()), "{estimate} {uncertainty}");
        }
    }

    #[test]
    fn unjustified_digits_are_dropped() {
        // an error of 0.0996 has its leading digit at 0.1
        assert_eq!(justified(2.345_6, Some(-4), 0.0996), "2.3");
        assert_eq!(justified(2.345_6, Some(-1), 0.0001), "2.3");
        assert_eq!(justified(2.345_6, Some(-2), f64::NAN), "2.35");
        assert_eq!(justified(2.345_6, None, 0.01), "2.35");
        assert_eq!(justified(0.02, Some(-3), 0.6), "0.0");
        assert_eq!(justified(1234.0, Some(0), 30.0), "1230");
    }

    /// 3 of 10 000 trials are 0.03 %, of a million 0.0003 %, of 100 are 3 %.
    #[test]
    fn a_probability_is_not_rounded_to_certainty() {
        let text = |share: f64, error: f64, trials| Percent::of(share, error, trials).text();
        assert_eq!(text(0.618_34, 0.0005, Some(1_000_000)), "61.83");
        assert_eq!(text(0.618_34, 0.005, Some(10_000)), "61.8");
        assert_eq!(text(1.0, 0.0, Some(1_000_000)), "more than 99.99");
        assert_eq!(text(0.0, 0.0, Some(1_000_000)), "less than 0.01");
        assert_eq!(text(1.0, 0.0, Some(10_000)), "more than 99.9");
        assert_eq!(text(0.0, 0.0, Some(100)), "less than 10");
        assert_eq!(text(1.0, 0.0, Some(10)), "100");
        assert_eq!(text(0.999_96, 1e-5, Some(1_000_000)), "more than 99.99");
        assert_eq!(text(0.999_94, 1e-5, Some(1_000_000)), "99.99");
        assert_eq!(text(1e-9, 0.0, None), "less than 0.01");
        assert_eq!(text(1.0, 0.0, None), "more than 99.99");
    }

    #[test]
    fn points_stand_under_each_other() {
        let texts = ["10.000", "-0.5", "1200", "1.2e-7", "-", "", "∞"];
        let aligned = align(&texts);
        assert!(aligned.iter().all(|text| text.chars().count() == 9), "{aligned:?}");
        insta::assert_snapshot!(aligned.iter().map(|text| format!("|{text}|\n")).collect::<String>(), @r"
            |  10.000 |
            |  -0.5   |
            |1200     |
            |   1.2e-7|
            |   -     |
            |         |
            |   ∞     |
            ");
    }
}
