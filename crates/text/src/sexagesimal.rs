//! Angles in degrees, minutes and seconds: `12°30'15.2"`, `12 deg 30 arcmin 15.2 arcsec`.

/// Signs after the numbers of degrees, minutes and seconds.
const SIGNS: [&[&str]; 3] = [
    &["°", "º", "deg"],
    &["arcmin", "'", "′", "’"],
    // the longer ones first
    &["arcsec", "''", "′′", "’’", "\"", "″", "”"],
];

/// How many of the smaller unit make one of the larger unit.
const PARTS: f64 = 60.0;

/// The angle in degrees at the start of a text, and the rest. `None` unless whole degrees are
/// followed by minutes, or by minutes and seconds, each below 60. The last number may have
/// decimals.
pub(crate) fn degrees(text: &str) -> Option<(f64, &str)> {
    let text = text.trim_start();
    let behind_sign = text.strip_prefix(['-', '−']);
    let (mut total, mut size, mut count) = (0.0, 1.0, 0);
    let mut rest = behind_sign.unwrap_or(text);
    let mut is_whole = true;
    for signs in SIGNS {
        let length = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(0);
        let Some((number, behind)) = rest.split_at_checked(length) else { break };
        let Ok(value) = number.parse::<f64>() else { break };
        let behind = behind.trim_start();
        let Some(after) = signs.iter().find_map(|sign| behind.strip_prefix(sign)) else { break };
        // decimals before smaller parts, and too many minutes
        if !is_whole || (count > 0 && value >= PARTS) {
            return None;
        }
        is_whole = !number.contains('.');
        (total, size, count) = (total * PARTS + value, size * PARTS, count + 1);
        rest = after;
        let next = after.trim_start();
        if !next.starts_with(|c: char| c.is_ascii_digit()) {
            break;
        }
        rest = next;
    }
    let sign = if behind_sign.is_some() { -1.0 } else { 1.0 };
    // the sum of whole parts is exact, so the result is rounded like a number with decimals
    (count > 1).then_some((sign * total / (size / PARTS), rest))
}

/// Whether a number follows the degrees, such as minutes that are not written as minutes of an
/// angle.
pub(crate) fn has_minutes(unit: &str) -> bool {
    let degrees = SIGNS[0].iter().find_map(|sign| unit.trim_start().strip_prefix(sign));
    degrees.is_some_and(|rest| rest.trim_start().starts_with(|c: char| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_minutes_and_seconds() {
        for (text, wanted, rest) in [
            ("12°30'15\"", 12.0 + 1815.0 / 3600.0, ""),
            ("12° 30′ 15.2″", (12.0 * 3600.0 + 30.0 * 60.0 + 15.2) / 3600.0, ""),
            ("-0°30'", -0.5, ""),
            ("−1°0'36''", -1.01, ""),
            ("12 deg 30 arcmin 15 arcsec", 12.0 + 1815.0 / 3600.0, ""),
            ("90°07.5'", 90.125, ""),
            ("12°30'15\" ± 2'' (k=2)", 12.0 + 1815.0 / 3600.0, " ± 2'' (k=2)"),
            ("12°30' + 0.1 [deg]", 12.5, " + 0.1 [deg]"),
        ] {
            assert_eq!(degrees(text), Some((wanted, rest)), "{text}");
        }
    }

    #[test]
    fn other_texts_are_none() {
        for text in [
            "",
            "30°",
            "30 deg",
            "12°",
            "12.5°30'",
            "12°60'",
            "12°30'60\"",
            "30'15\"",
            "5' 3\"",
            "12°15\"",
            "12 deg 30 min",
            "12°30.5'15\"",
            "x°30'",
            "2*a",
            "12 30 15",
            "°30'",
        ] {
            assert_eq!(degrees(text), None, "{text}");
        }
    }
}
