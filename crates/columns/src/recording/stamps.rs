//! Time stamps: `12:00:00.001`, `2026-03-02T12:00:00.001Z`, `02.03.2026 12:00:00,001`.

/// Picoseconds in a second and in a day.
const SECOND: i128 = 1_000_000_000_000;
const DAY: i128 = 86_400 * SECOND;

/// The number of decimals of a second that are used.
const DIGITS: usize = 12;

/// A time stamp: its date, and the time of day in picoseconds.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Stamp {
    date: Date,
    time: i128,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Date {
    None,
    /// Days of the calendar.
    Day(i128),
    /// As written, where the month and the day cannot be told apart: `2/3/2026`.
    Written(String),
}

impl Stamp {
    fn of(text: &str) -> Option<Self> {
        let text = text.trim().trim_matches('"');
        if !text.contains(':') {
            return None;
        }
        let (text, half_day) = of_half_day(text);
        let at = text.find(':')?;
        let begin = text.get(..at)?.rfind(|c: char| !c.is_ascii_digit()).map_or(0, |at| at + 1);
        let date = match text.get(..begin)? {
            "" => Date::None,
            before => date(before.strip_suffix(['T', ' '])?.trim())?,
        };
        let (clock, zone) = with_zone(text.get(begin..)?)?;
        let mut parts = clock.split(':');
        let (hours, minutes, seconds) = (parts.next()?, parts.next()?, parts.next()?);
        if parts.next().is_some() {
            return None;
        }
        let hours = match (two_digits(hours, 24)?, half_day) {
            (hours, None) => hours,
            (hours @ 1..=12, Some(later)) => hours % 12 + later,
            _ => return None,
        };
        let (whole, fraction) = seconds.split_once(['.', ',']).unwrap_or((seconds, "0"));
        if fraction.is_empty() || !fraction.bytes().all(|of| of.is_ascii_digit()) {
            return None;
        }
        let fraction: String = format!("{fraction:0<DIGITS$}").chars().take(DIGITS).collect();
        let seconds = hours * 3600 + two_digits(minutes, 60)? * 60 + two_digits(whole, 61)?;
        let time = (seconds - zone) * SECOND + fraction.parse::<i128>().ok()?;
        Some(Self { date, time })
    }
}

/// A number of one or two digits below a limit.
fn two_digits(text: &str, below: i128) -> Option<i128> {
    let is_number = (1..=2).contains(&text.len()) && text.bytes().all(|of| of.is_ascii_digit());
    text.parse().ok().filter(|number| is_number && *number < below)
}

/// A text without `AM` or `PM`, and the hours that the suffix adds.
fn of_half_day(text: &str) -> (&str, Option<i128>) {
    let ends = [(" AM", 0), (" am", 0), (" PM", 12), (" pm", 12)];
    let found = ends.iter().find_map(|(end, hours)| Some((text.strip_suffix(end)?, Some(*hours))));
    found.unwrap_or((text, None))
}

/// A time of day without its time zone, and the zone in seconds.
fn with_zone(text: &str) -> Option<(&str, i128)> {
    if let Some(clock) = text.strip_suffix('Z') {
        return Some((clock, 0));
    }
    let Some(at) = text.find(['+', '-']) else { return Some((text, 0)) };
    let (clock, zone) = text.split_at(at);
    let (hours, minutes) = match zone.get(1..)?.split_once(':') {
        Some(of) => of,
        None => (zone.get(1..3)?, zone.get(3..).filter(|of| !of.is_empty()).unwrap_or("0")),
    };
    let seconds = two_digits(hours, 24)? * 3600 + two_digits(minutes, 60)? * 60;
    Some((clock, if zone.starts_with('-') { -seconds } else { seconds }))
}

fn date(text: &str) -> Option<Date> {
    let is_number =
        |of: &&str| !of.is_empty() && of.len() <= 4 && of.bytes().all(|b| b.is_ascii_digit());
    let parts: Vec<&str> = text.split(['-', '/', '.']).collect();
    let numbers: Vec<i128> =
        parts.iter().filter(|of| is_number(of)).filter_map(|of| of.parse().ok()).collect();
    match (numbers.as_slice(), parts.first().map(|of| of.len())) {
        ([year, month, day], Some(4)) => Some(days(*year, *month, *day)),
        ([day, month, year], _)
            if text.contains('.') && parts.last().map(|of| of.len()) == Some(4) =>
        {
            Some(days(*year, *month, *day))
        }
        // `02-Mar-2026`, `3/2/2026`
        _ if parts.len() == 3 => Some(Some(Date::Written(text.to_owned()))),
        _ => None,
    }?
}

/// The number of days of a Gregorian date since a fixed day.
fn days(year: i128, month: i128, day: i128) -> Option<Date> {
    let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let length = match month {
        2 => 28 + i128::from(is_leap),
        4 | 6 | 9 | 11 => 30,
        1..=12 => 31,
        _ => return None,
    };
    if !(1..=length).contains(&day) {
        return None;
    }
    // in years that begin in March the leap day comes last
    let (year, month) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    let leaps = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    Some(Date::Day(year * 365 + leaps + (153 * month + 2) / 5 + day))
}

/// Whether a text is a time stamp.
pub(super) fn is_stamp(text: &str) -> bool {
    Stamp::of(text).is_some()
}

/// The time stamps of one column, in seconds since the first one.
#[derive(Debug, Default)]
pub(super) struct Stamps {
    first: Option<Stamp>,
    /// The last time stamp, in picoseconds since the first one.
    last: i128,
    /// The number of midnights passed, for stamps without a date.
    midnights: i128,
}

impl Stamps {
    /// The seconds from the first stamp to this one; `None` if the text is not a stamp.
    ///
    /// # Errors
    /// The dates are ambiguous.
    pub(super) fn seconds(&mut self, text: &str) -> Result<Option<f64>, String> {
        let Some(stamp) = Stamp::of(text) else { return Ok(None) };
        let first = self.first.get_or_insert_with(|| stamp.clone());
        let days = match (&first.date, &stamp.date) {
            (Date::None, Date::None) => self.midnights,
            (Date::Day(first), Date::Day(day)) => day - first,
            (Date::Written(first), Date::Written(date)) if first == date => 0,
            (Date::Written(first), Date::Written(date)) => {
                return Err(format!(
                    "the date changes from `{first}` to `{date}`, and the number of days between \
                     them is unknown: \
                     write dates as `2026-03-02`"
                ));
            }
            _ => return Err(format!("`{text}` is not written like the time stamps before it")),
        };
        let mut since = days * DAY + stamp.time - first.time;
        // the time of day starts again
        if stamp.date == Date::None && self.last - since > DAY / 2 {
            self.midnights += 1;
            since += DAY;
        }
        self.last = since;
        Ok(Some(since as f64 / SECOND as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seconds(stamps: &[&str]) -> Vec<Result<Option<f64>, String>> {
        let mut read = Stamps::default();
        stamps.iter().map(|stamp| read.seconds(stamp)).collect()
    }

    #[test]
    fn stamps_count_from_the_first_one() {
        for stamps in [
            ["12:00:00.001", "12:00:00.002", "12:01:00.0015"],
            ["2026-03-02T12:00:00.001Z", "2026-03-02T12:00:00.002Z", "2026-03-02T12:01:00.0015Z"],
            ["2026-02-28 23:59:59.001", "2026-02-28 23:59:59.002", "2026-03-01 00:00:59.0015"],
            ["28.02.2026 23:59:59,001", "28.02.2026 23:59:59,002", "01.03.2026 00:00:59,0015"],
            ["23:59:59.001", "23:59:59.002", "0:00:59.0015"],
            ["3/2/2026 11:59:59.001 AM", "3/2/2026 11:59:59.002 AM", "3/2/2026 12:00:59.0015 PM"],
            ["12:00:00.001+01:00", "12:00:00.002+01:00", "12:01:00.0015+01:00"],
        ] {
            assert_eq!(
                seconds(&stamps),
                [Ok(Some(0.0)), Ok(Some(0.001)), Ok(Some(60.0005))],
                "{stamps:?}"
            );
        }
        // a leap day
        let leap = ["2024-02-28T00:00:00", "2024-03-01T00:00:00"];
        assert_eq!(seconds(&leap)[1], Ok(Some(2.0 * 86400.0)));
        // the next day without a date, twice
        let days = ["23:00:00", "01:00:00", "13:00:00", "23:30:00", "00:30:00"];
        let hours: Vec<f64> =
            seconds(&days).into_iter().map(|of| of.unwrap().unwrap() / 3600.0).collect();
        assert_eq!(hours, [0.0, 2.0, 14.0, 24.5, 25.5]);
    }

    #[test]
    fn what_is_no_stamp() {
        for text in
            ["", "1.5", "12:00", "12:00:00:00", "25:00:00", "12:60:00", "a:b:c", "12:00:00 x"]
        {
            assert_eq!(Stamp::of(text), None, "{text}");
        }
        let changed = seconds(&["3/2/2026 23:59:59", "3/3/2026 00:00:00"]);
        assert!(changed[1].as_ref().is_err_and(|reason| reason.contains("the date changes")));
        let mixed = seconds(&["12:00:00", "2026-03-02 12:00:01"]);
        assert!(mixed[1].as_ref().is_err_and(|reason| reason.contains("not written like")));
    }
}
