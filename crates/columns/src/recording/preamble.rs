//! The part of a text above the samples: lines of an instrument or a program, the header, and a
//! line of units below it.

use super::ColumnName;
use super::Wanted;
use super::stamps::is_stamp;
use crate::heading;
use crate::separator::{DecimalMarks, Separator, is_skipped};
use gumption_units::Unit;

/// Lines that are looked at.
pub(super) const MOST_LINES: usize = 512;

/// Number of numeric lines that mark the beginning of the samples.
const LEAST_NUMBERS: usize = 3;

/// Marks in a line of units for a column that counts samples, or that has no unit.
const OF_NO_UNIT: [&str; 4] = ["sequence", "samples", "-", "–"];

/// Where a text begins.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Beginning {
    /// The index of the header among the lines, or of the first sample.
    pub(super) first: usize,
    /// The cells of the line of units below the header.
    pub(super) units: Option<Vec<String>>,
    /// The unit of all values, where a line above the header states one.
    of_values: Option<String>,
    /// The index of the first line above the header that is not a comment.
    pub(super) above: Option<usize>,
    pub(super) separator: Separator,
    /// Whether the first line is certainly a header.
    pub(super) is_header: bool,
}

/// A line that holds something.
struct PreambleLine {
    place: usize,
    separator: Separator,
    cells: Vec<String>,
}

impl PreambleLine {
    fn is_number(&self, place: usize) -> bool {
        self.cells.get(place).is_some_and(|cell| is_number(cell, self.separator))
    }

    /// Whether the line holds only numbers and time stamps, including these columns.
    fn is_of_numbers(&self, wanted: &[usize]) -> bool {
        let held = || (0..self.cells.len()).filter(|place| !self.cells[*place].is_empty());
        held().all(|place| self.is_number(place))
            && held().next().is_some()
            && wanted.iter().all(|place| self.is_number(*place))
    }

    /// Whether the line states units below a header, including units of these columns.
    fn is_of_units(&self, wanted: &[usize]) -> bool {
        let cell = |place: &usize| self.cells.get(*place).map_or("", String::as_str);
        let is_unit = |place: &usize| unit(cell(place)).is_some();
        let is_none = |place: &usize| OF_NO_UNIT.contains(&cell(place).to_lowercase().as_str());
        wanted.iter().all(|place| is_unit(place) || is_none(place)) && wanted.iter().any(is_unit)
    }

    /// The unit of all values in a line above the header: `Vertical Units,V,V`.
    fn unit_of_values(&self) -> Option<String> {
        const KEYS: [&str; 4] = ["vertical units", "vertical unit", "y_unit_label", "y units"];
        let (key, cells) = self.cells.split_first()?;
        let mut units = cells.iter().filter(|cell| !cell.is_empty()).map(|cell| unit(cell));
        let first = units.next().filter(|_| KEYS.contains(&key.to_lowercase().as_str()))??;
        units.all(|unit| unit.as_ref() == Some(&first)).then_some(first)
    }
}

/// Whether a cell is a number as the reader of samples accepts it, or a time stamp.
fn is_number(cell: &str, separator: Separator) -> bool {
    let point =
        DecimalMarks::of(separator).with_point(cell).is_ok_and(|of| of.parse::<f64>().is_ok());
    point || is_stamp(cell)
}

/// The unit that a cell states, as text: `V`, `(ms)`, `[mV]`, `Volt`.
fn unit(cell: &str) -> Option<String> {
    const WORDS: [(&str, &str); 12] = [
        ("second", "s"),
        ("seconds", "s"),
        ("sec", "s"),
        ("sekunden", "s"),
        ("volt", "V"),
        ("volts", "V"),
        ("ampere", "A"),
        ("amperes", "A"),
        ("amp", "A"),
        ("amps", "A"),
        ("watt", "W"),
        ("hertz", "Hz"),
    ];
    let bare = cell.trim();
    let inside = [('(', ')'), ('[', ']')]
        .into_iter()
        .find_map(|(open, close)| bare.strip_prefix(open)?.strip_suffix(close));
    let text = inside.unwrap_or(bare).trim();
    let word = WORDS.iter().find(|(word, _)| *word == text.to_lowercase());
    if let Some((_, unit)) = word {
        return Some((*unit).to_owned());
    }
    let is_word = !text.is_empty() && !text.starts_with(|c: char| c.is_ascii_digit());
    let is_unit = is_word && Unit::parse(text).is_ok();
    is_unit.then(|| text.to_owned())
}

/// A heading with the unit from the line below it.
pub(super) fn with_unit(name: &str, unit: Option<&str>) -> String {
    match unit {
        Some(unit) if heading::named(name).is_none_or(|(_, own)| own != unit) => {
            format!("{name} [{unit}]")
        }
        _ => name.to_owned(),
    }
}

impl Beginning {
    /// Where a text begins, given its first lines; `None` if all lines are empty.
    pub(super) fn of(lines: &[String], wanted: &[Wanted]) -> Option<Self> {
        let of_line = |(place, text): (usize, &String)| {
            let separator = Separator::of_line(text);
            let cells = separator.cells(text).unwrap_or_default();
            let is_held = !is_skipped(text) && cells.iter().any(|cell| !cell.is_empty());
            is_held.then_some(PreambleLine { place, separator, cells })
        };
        let lines: Vec<PreambleLine> = lines.iter().enumerate().filter_map(of_line).collect();
        let first = lines.first()?;
        let plain = Self {
            first: first.place,
            units: None,
            of_values: None,
            above: None,
            separator: first.separator,
            is_header: false,
        };
        let (at, units) = Self::named(&lines, wanted)
            .or_else(|| Self::above_numbers(&lines, wanted))
            .unwrap_or((0, None));
        let Some(header) = lines.get(at).filter(|_| at > 0 || units.is_some()) else {
            return Some(plain);
        };
        let above = (at > 0).then_some(first.place);
        let is_header = units.is_some();
        let (first, separator) = (header.place, header.separator);
        let of_values = lines.iter().take(at).find_map(PreambleLine::unit_of_values);
        Some(Self { first, units, of_values, above, separator, is_header })
    }

    /// The first line with the names of the columns and numbers below it, possibly with a line of
    /// units between them.
    fn named(lines: &[PreambleLine], wanted: &[Wanted]) -> Option<(usize, Option<Vec<String>>)> {
        if !wanted.iter().any(|wanted| matches!(wanted.column, ColumnName::Name(_))) {
            return None;
        }
        let places = |line: &PreambleLine| -> Option<Vec<usize>> {
            let place = |wanted: &Wanted| match &wanted.column {
                ColumnName::Name(name) => heading::place_of(&line.cells, name),
                ColumnName::Number(number) => Some(number - 1),
            };
            wanted.iter().map(place).collect()
        };
        let has_numbers = |line: &PreambleLine, places: &[usize]| {
            places.iter().all(|place| line.is_number(*place))
        };
        let header = lines.iter().enumerate().find_map(|(at, line)| {
            let places = places(line)?;
            let next = lines.get(at + 1);
            let units = next.filter(|next| next.is_of_units(&places));
            let behind = lines.get(at + 2).filter(|behind| has_numbers(behind, &places));
            match units.filter(|_| behind.is_some()) {
                Some(units) => Some((at, Some(units.cells.clone()))),
                // below a header in the first line the samples may contain errors
                None => (at == 0 || next.is_some_and(|next| has_numbers(next, &places)))
                    .then_some((at, None)),
            }
        });
        // the first samples may contain errors, which are reported then
        header.or_else(|| {
            let is_above = |(at, line): &(usize, &PreambleLine)| {
                let mut below = lines.iter().skip(at + 1);
                places(line).is_some_and(|places| below.any(|line| has_numbers(line, &places)))
            };
            lines.iter().enumerate().find(is_above).map(|(at, _)| (at, None))
        })
    }

    /// The line above the first purely numeric lines, or above a line of units on top of these.
    fn above_numbers(
        lines: &[PreambleLine],
        wanted: &[Wanted],
    ) -> Option<(usize, Option<Vec<String>>)> {
        let place = |wanted: &Wanted| match wanted.column {
            ColumnName::Number(number) => Some(number - 1),
            ColumnName::Name(_) => None,
        };
        let wanted: Vec<usize> = wanted.iter().filter_map(place).collect();
        let begins = |at: &usize, wanted: &[usize]| {
            let next = lines.iter().skip(*at).take(LEAST_NUMBERS);
            next.into_iter().all(|line| line.is_of_numbers(wanted))
        };
        let first = |wanted: &[usize]| (0..lines.len()).find(|at| begins(at, wanted));
        // a column without numbers is reported as such
        let mut body = first(&wanted).or_else(|| first(&[]))?;
        // words may occur beside the first samples
        let is_sample = |line: &PreambleLine| wanted.iter().all(|place| line.is_number(*place));
        while !wanted.is_empty() && body > 0 && lines.get(body - 1).is_some_and(is_sample) {
            body -= 1;
        }
        let above = lines.get(body.checked_sub(1)?)?;
        // a heading above each unit
        let names = body.checked_sub(2).and_then(|at| lines.get(at)).filter(|names| {
            let name = |place: &usize| names.cells.get(*place).map_or("", String::as_str);
            above.is_of_units(&wanted) && wanted.iter().all(|place| !name(place).is_empty())
        });
        Some(match names {
            Some(_) => (body - 2, Some(above.cells.clone())),
            None => (body - 1, None),
        })
    }

    /// The unit of a column, of values or of instants, stated elsewhere than in its heading.
    pub(super) fn unit(&self, place: usize, is_time: bool) -> Option<String> {
        let below = || self.units.as_ref()?.get(place).and_then(|cell| unit(cell));
        below().or_else(|| self.of_values.clone().filter(|_| !is_time))
    }

    /// Whether a line of units says that a column has none.
    pub(super) fn is_without_unit(&self, place: usize) -> bool {
        let cell = self.units.as_ref().and_then(|cells| cells.get(place));
        cell.is_some_and(|cell| OF_NO_UNIT.contains(&cell.to_lowercase().as_str()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn beginning(text: &str, columns: &[ColumnName]) -> Beginning {
        let wanted: Vec<Wanted> = columns
            .iter()
            .map(|column| Wanted {
                column: column.clone(),
                channel: "a".to_owned(),
                unit: Unit::one(),
                becomes: Unit::one(),
            })
            .collect();
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        Beginning::of(&lines, &wanted).expect("lines that hold something")
    }

    fn numbers(numbers: &[usize]) -> Vec<ColumnName> {
        numbers.iter().map(|number| ColumnName::Number(*number)).collect()
    }

    fn names(names: &[&str]) -> Vec<ColumnName> {
        names.iter().map(|name| ColumnName::Name((*name).to_owned())).collect()
    }

    #[test]
    fn the_header_below_a_preamble_is_found() {
        let tektronix = "Model,MSO44\nSample Interval,1e-3\nRecord Length,1000\nLabel,,\nTIME,CH1\n0,1\n1,2\n2,3\n";
        for columns in [numbers(&[2, 1]), names(&["CH1", "TIME"]), names(&["CH1"]), numbers(&[2])] {
            let found = beginning(tektronix, &columns);
            assert_eq!((found.first, found.above, found.units), (4, Some(0), None), "{columns:?}");
        }
        let lecroy = "LECROYWS,1,Waveform\nSegments,1,SegmentSize,3\n#1,01-Jan-2026 12:00:00,0\nTime,Ampl\n0,1\n1,2\n";
        assert_eq!(beginning(lecroy, &numbers(&[2])).first, 3);
        let german = "LabVIEW\nDate\t2026/01/01\n\t\nX_Value\tU\n0,0\t1,5\n0,1\t2,5\n";
        let found = beginning(german, &names(&["U", "X_Value"]));
        assert_eq!((found.first, found.separator), (3, Separator::Tab));
    }

    #[test]
    fn units_below_the_header_are_read() {
        let units = |text: &str, columns: &[ColumnName]| {
            let found = beginning(text, columns);
            assert_eq!((found.first, found.is_header), (0, true), "{text}");
            [found.unit(0, true), found.unit(1, false)].map(Option::unwrap_or_default)
        };
        let text = "Time,Channel A\n(ms),(mV)\n\n0,1\n1,2\n2,3\n";
        assert_eq!(units(text, &names(&["Channel A", "Time"])), ["ms", "mV"]);
        assert_eq!(units(text, &numbers(&[2, 1])), ["ms", "mV"]);
        let text = "x-axis,1\nsecond,Volt\n0,1\n1,2\n2,3\n";
        assert_eq!(units(text, &numbers(&[2, 1])), ["s", "V"]);
        // a count of samples has no unit, and numbers in the line are not units
        let text = "X,CH1,Start,Increment,\nSequence,VOLT,0,1e-3,\n0,1,,\n1,2,,\n";
        assert_eq!(units(text, &names(&["CH1"])), ["", "V"]);
        assert!(beginning(text, &names(&["CH1", "X"])).is_without_unit(0));
        // a line above the header, for all channels
        let text = "Y_Unit_Label	mV	mV
X_Value	U	I
0	1	2
1	2	3
";
        let found = beginning(text, &names(&["U", "X_Value"]));
        assert_eq!((found.unit(1, false).as_deref(), found.unit(0, true)), (Some("mV"), None));
    }

    /// A missing value is not a unit, and a first sample is not a header.
    #[test]
    fn samples_are_not_passed_by() {
        for text in
            ["value,unit\n,V\n1,V\n", "value,unit\n5,V\n6,V\n", "1\n2\n3\n", "value,b\n-,-\n1,2\n"]
        {
            let found = beginning(text, &names(&["value"]));
            assert_eq!((found.first, found.units), (0, None), "{text}");
        }
        assert_eq!(beginning("1,2\n3,4\n", &numbers(&[2])).first, 0);
        // words of an instrument beside its first samples
        let beside = "Record Length,4,,0,1\nSample Interval,1,,1,2\n,,,2,3\n,,,3,4\n,,,4,5\n";
        assert_eq!(beginning(beside, &numbers(&[5, 4])).first, 0);
        // a comment beside the first sample, and errors in it
        let noted = "Operator\tx\nX_Value\tU\tComment\n0\t1\tstart\n1\t2\t\n2\t3\t\n3\t4\t\n";
        assert_eq!(beginning(noted, &numbers(&[2, 1])).first, 1);
        let over = "P,1\nt,a\nOVLD,OVLD\n0,1\n1,2\n2,3\n";
        assert_eq!(beginning(over, &names(&["a", "t"])).first, 1);
        // text in another column, on every line
        assert_eq!(beginning("a,state\n1,OK\n2,OK\n", &numbers(&[1])).first, 0);
    }
}
