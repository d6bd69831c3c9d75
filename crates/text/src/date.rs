//! Days of the calendar, written as `2026-03-02`.

/// A day of the Gregorian calendar, which is extended to all years.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Day {
    /// The number of days since 1 March of the year 0.
    number: i64,
}

/// Days of four centuries, after which the calendar repeats itself.
const DAYS_OF_400_YEARS: i64 = 146_097;

impl Day {
    /// Parses `YYYY-MM-DD`; `None` for any other text and for days that do not exist.
    pub fn parse(text: &str) -> Option<Self> {
        let shape = text.len() == 10
            && text.bytes().enumerate().all(|(place, letter)| match place {
                4 | 7 => letter == b'-',
                _ => letter.is_ascii_digit(),
            });
        let number = |range: std::ops::Range<usize>| text.get(range)?.parse::<i64>().ok();
        let (year, month, day) = (number(0..4)?, number(5..7)?, number(8..10)?);
        let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
        let days = match month {
            2 => 28 + i64::from(is_leap),
            4 | 6 | 9 | 11 => 30,
            1..=12 => 31,
            _ => 0,
        };
        if !shape || year == 0 || !(1..=days).contains(&day) {
            return None;
        }
        // years that begin in March end with the leap day
        let (year, month) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
        let (cycle, year) = (year / 400, year % 400);
        let number = cycle * DAYS_OF_400_YEARS + 365 * year + year / 4 - year / 100
            + (153 * month + 2) / 5
            + day;
        Some(Self { number })
    }

    /// The number of days from another day to this one.
    pub fn since(self, origin: Self) -> f64 {
        (self.number - origin.number) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Julian day numbers of the Astronomical Almanac: 2000-01-01 is 2 451 545 at noon, 1970-01-01
    /// 2 440 588; 400 Gregorian years have 146 097 days.
    #[test]
    fn days_between_dates() {
        let day = |text: &str| Day::parse(text).unwrap();
        for (from, to, days) in [
            ("1970-01-01", "2000-01-01", 2_451_545.0 - 2_440_588.0),
            ("2024-02-28", "2024-03-01", 2.0),
            ("2023-02-28", "2023-03-01", 1.0),
            ("1900-02-28", "1900-03-01", 1.0),
            ("2026-03-02", "2024-03-02", -730.0),
            ("1726-07-05", "2126-07-05", 146_097.0),
        ] {
            assert_eq!(day(to).since(day(from)), days, "{from} {to}");
        }
        let of_month = ["2026-00-10", "2026-04-31", "2026-01-00", "0000-01-01"];
        let wrong = ["2026-3-2", "2026-02-29", "1900-02-29", "2026-13-01", "02.03.2026", "", "5 V"];
        for wrong in wrong.into_iter().chain(of_month).chain(["２026-1-1"]) {
            assert_eq!(Day::parse(wrong), None, "{wrong}");
        }
    }
}
