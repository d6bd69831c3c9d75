//! Cells that a spreadsheet displays as a date or a time, whatever was typed: `10.1` becomes 10
//! January in some locales. The number in such a cell counts days, which nobody means.

use calamine::{Data, ExcelDateTime};

/// The date or time that a cell displays; `None` for other cells. It begins with a word, so that it
/// cannot be taken for a number or a sum.
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

/// Why such a cell holds no number; the sentence continues after the cell's name.
pub(crate) fn no_number(shown: &str) -> String {
    let (what, when) = shown.split_once(' ').unwrap_or(("date", shown));
    format!(
        "is a {what} ({when}), not a number: set a number format for the cell and type the number \
         again"
    )
}
