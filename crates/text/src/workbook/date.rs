//! Cells that a spreadsheet shows as a date or a time, whatever was typed: `10.1` becomes 10 January in some
//! locales. The number that such a cell holds is that of days, which nobody means.

use calamine::{Data, ExcelDateTime};

/// What a cell shows that is a date or a time; `None` of other ones. It begins with a word, so that
/// nobody takes it for a number or for a sum of them.
pub(super) fn shown(value: &Data) -> Option<String> {
    match value {
        Data::DateTime(of) => Some(of_days(of)),
        Data::DateTimeIso(text) => Some(format!("date {text}")),
        Data::DurationIso(text) => Some(format!("time {text}")),
        _ => None,
    }
}

fn of_days(of: &ExcelDateTime) -> String {
    let (year, month, day, hour, minute, second, _) = of.to_ymd_hms_milli();
    let days = of.as_f64();
    if of.is_duration() {
        return format!("time {days} d");
    }
    if (0.0..1.0).contains(&days) {
        return format!("time {hour:02}:{minute:02}:{second:02}");
    }
    let date = format!("date {year:04}-{month:02}-{day:02}");
    if days.fract() == 0.0 { date } else { format!("{date} {hour:02}:{minute:02}") }
}

/// Why such a cell holds no number, as a sentence that goes on behind the cell's name.
pub(crate) fn no_number(shown: &str) -> String {
    let (what, when) = shown.split_once(' ').unwrap_or(("date", shown));
    format!(
        "is a {what} ({when}), not a number: give it the format of a number and write the number again"
    )
}
