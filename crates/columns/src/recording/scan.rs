//! The first pass over a recording: is it complete, evenly spaced and not saturated?

use std::cell::RefCell;
use std::io::{self, BufReader, Read};
use std::rc::Rc;

use sha2::{Digest, Sha256};

use super::{
    BLOCK, Digesting, InMemorySamples, MOST_IN_MEMORY, Measured, Reading, Recording, place,
};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::number::Shortest;
use gumption_engine::task::Warning;

/// Minimum number of equal consecutive values, at the highest or lowest value, that makes a channel
/// suspect.
const LEAST_RUN: u64 = 5;

/// Relative difference between the stated sampling rate and that of the file from which a warning
/// is given; a WAV file states whole hertz.
const RATES_APART: f64 = 1e-3;
const WHOLE_HERTZ: f64 = 0.5;

/// Within this many combined standard uncertainties, both rates still agree.
const UNCERTAINTIES_APART: f64 = 5.0;

/// Scatter of the instants, relative to the interval, from which a warning is given.
const SCATTER: f64 = 0.02;

pub(super) fn scan(reading: Reading) -> Result<Recording, String> {
    let digest = Rc::new(RefCell::new(Sha256::new()));
    let bytes = reading.bytes.clone();
    let file = Digesting { inner: bytes.opened()?, digest: digest.clone() };
    let mut reader = BufReader::with_capacity(1 << 20, file);
    let channels = reading.channels.len();
    let (stated, whole, passed_by, mut scanned) = {
        let mut frames = reading.frames(&mut reader)?;
        let stated = frames.rate();
        let rate = reading.rate.map(|rate| rate.value).or(stated);
        if rate.is_none() && reading.time.is_none() {
            return Err("its sampling rate is not known; state `sampling_rate`, or name the \
                        column of instants in `time`"
                .to_owned());
        }
        let mut scanned = Scanned::new(&reading, rate, frames.whole());
        let mut columns = vec![Vec::with_capacity(BLOCK); reading.wanted().len()];
        loop {
            columns.iter_mut().for_each(Vec::clear);
            frames.read(&mut columns)?;
            if columns.first().is_none_or(Vec::is_empty) {
                break;
            }
            scanned.block(&columns)?;
        }
        (stated, frames.whole(), frames.passed_by(&reading.name), scanned)
    };
    // bytes after the last frame belong to the file too
    io::copy(&mut reader.by_ref(), &mut io::sink()).map_err(|error| error.to_string())?;
    if scanned.all == 0 {
        return Err("it has no samples".to_owned());
    }
    if scanned.kept < 2 {
        return Err(format!(
            "of its {} samples {} lie between `from` and `to`; two at least are needed",
            scanned.all, scanned.kept
        ));
    }
    let rate = scanned.rate(stated);
    let of_preamble = passed_by.map(|fact| Warning::new(&reading.name, fact));
    let mut warnings: Vec<Warning> = of_preamble.into_iter().collect();
    warnings.extend(scanned.suspects(rate.value, channels));
    if let Some(scatter) = scanned.clock.as_ref().map(Clock::scatter)
        && scatter * rate.value > SCATTER
    {
        let (name, percent) = (&reading.name, format!("{:.2}", scatter * rate.value * 100.0));
        let fact = fact!("uneven-instants", name, percent = Argument::Number(percent));
        warnings.push(Warning::new(name, fact));
    }
    warnings.extend(scanned.contradicted(stated));
    let start = match &scanned.clock {
        Some(clock) => clock.start(rate.value),
        None => scanned.first as f64 / rate.value,
    };
    let of_middle = scanned.clock.as_ref().map(Clock::of_middle);
    let held = scanned.held.take().map(|channels| InMemorySamples { channels });
    let (first, frames) = (scanned.first, scanned.kept);
    let digest = digest.borrow().clone().finalize();
    let digest = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(Recording { first, frames, held, rate, start, of_middle, digest, whole, warnings, reading })
}

/// The state so far.
struct Scanned<'r> {
    reading: &'r Reading,
    /// The sampling rate, if it does not come from the instants.
    known: Option<f64>,
    /// Whether the file holds integers of a converter.
    whole: bool,
    all: u64,
    first: u64,
    kept: u64,
    held: Option<Vec<Vec<f64>>>,
    extremes: Vec<[Extreme; 2]>,
    /// For each channel, the smallest step between neighbours, and the previous value.
    steps: Vec<(f64, f64)>,
    /// For each channel, the number of values at or beyond the range: consecutive, and in total.
    beyond: Vec<[u64; 2]>,
    clock: Option<Clock>,
}

/// A computed value, with six digits.
fn significant(value: f64) -> Shortest {
    Shortest(format!("{value:.5e}").parse().unwrap_or(value))
}

/// The highest or lowest value, its longest run and where that begins, how often it occurs, and the
/// nearest other value.
#[derive(Clone, Copy)]
struct Extreme {
    sign: f64,
    value: f64,
    run: u64,
    longest: u64,
    at: u64,
    count: u64,
    next: f64,
    next_count: u64,
}

/// Values that differ relatively by less than this are equal: the difference is rounding.
const SAME: f64 = 1e-9;

/// Minimum number of occurrences of the highest value, scattered among others, from which a channel
/// may be saturated; it must also be this many times the number of occurrences of the next value.
/// For a sine, the values that round to its highest step are at most 2.4 times as many as those
/// that round to the next one.
const LEAST_AT_END: u64 = 10;
const TIMES_NEXT: u64 = 6;

/// Number of values in total at or beyond the range from which a channel is saturated; two
/// consecutive values suffice too.
const BEYOND_IN_ALL: u64 = 3;

/// Values beyond the range by this factor have another unit than the range.
const FAR_BEYOND: f64 = 2.0;

impl Extreme {
    fn see(&mut self, value: f64, sample: u64) {
        let value = self.sign * value;
        // minus infinity until a value is seen
        let is_at = |other: f64| other.is_finite() && (value - other).abs() <= SAME * other.abs();
        if is_at(self.value) {
            self.count += 1;
        } else if value > self.value {
            (self.next, self.next_count) = (self.value, self.count);
            self.count = 1;
        } else if is_at(self.next) {
            self.next_count += 1;
        } else if value > self.next {
            (self.next, self.next_count) = (value, 1);
        }
        if value > self.value {
            *self = Self { value, run: 1, longest: 1, at: sample, ..*self };
        } else if value == self.value {
            self.run += 1;
            if self.run > self.longest {
                (self.longest, self.at) = (self.run, sample + 1 - self.run);
            }
        } else {
            self.run = 0;
        }
    }

    /// Whether it has more values than a signal that rises to it and falls again.
    fn is_heaped(&self) -> bool {
        self.value != 0.0 && self.count >= LEAST_AT_END && self.count > TIMES_NEXT * self.next_count
    }

    fn fact(&self) -> Fact {
        if self.sign > 0.0 { fact!("highest") } else { fact!("lowest") }
    }
}

impl<'r> Scanned<'r> {
    fn new(reading: &'r Reading, known: Option<f64>, whole: bool) -> Self {
        let channels = reading.channels.len();
        let extreme = |sign| Extreme {
            sign,
            value: f64::NEG_INFINITY,
            run: 0,
            longest: 0,
            at: 0,
            count: 0,
            next: f64::NEG_INFINITY,
            next_count: 0,
        };
        Self {
            reading,
            known,
            whole,
            all: 0,
            first: 0,
            kept: 0,
            held: Some(vec![Vec::new(); channels]),
            extremes: vec![[extreme(1.0), extreme(-1.0)]; channels],
            steps: vec![(f64::INFINITY, f64::NAN); channels],
            beyond: vec![[0; 2]; channels],
            clock: None,
        }
    }

    fn block(&mut self, columns: &[Vec<f64>]) -> Result<(), String> {
        let length = columns.first().map_or(0, Vec::len);
        let mut used = 0..0;
        for i in 0..length {
            let sample = self.all + i as u64;
            let instant = match (&self.reading.time, columns.last().and_then(|c| c.get(i))) {
                (Some((_, unit)), Some(time)) => Some(time * unit.factor()),
                _ => None,
            };
            let at = instant.or(self.known.map(|rate| sample as f64 / rate)).unwrap_or(0.0);
            if self.reading.from.is_some_and(|from| at < from)
                || self.reading.to.is_some_and(|to| at > to)
            {
                continue;
            }
            if let Some(instant) = instant {
                match &mut self.clock {
                    Some(clock) => clock.see(instant, sample)?,
                    None => self.clock = Some(Clock::new(instant)),
                }
            }
            if self.kept == 0 && used.is_empty() {
                self.first = sample;
            }
            if used.is_empty() {
                used = i..i;
            }
            used.end = i + 1;
        }
        for (channel, raw) in columns.iter().take(self.reading.channels.len()).enumerate() {
            let values = raw.get(used.clone()).unwrap_or(&[]);
            self.channel(channel, values, self.all + used.start as u64)?;
        }
        self.all += length as u64;
        self.kept += used.len() as u64;
        if self.kept * self.reading.channels.len() as u64 > MOST_IN_MEMORY {
            self.held = None;
        }
        Ok(())
    }

    fn channel(&mut self, channel: usize, values: &[f64], first: u64) -> Result<(), String> {
        let (wanted, conversion) = &self.reading.channels[channel];
        let (least, before) = &mut self.steps[channel];
        let [in_a_row, in_all] = &mut self.beyond[channel];
        let [high, low] = &mut self.extremes[channel];
        for (sample, value) in (first..).zip(values) {
            if let Some([lower, upper]) = conversion.range {
                let is_beyond = *value <= lower || *value >= upper;
                *in_a_row = if is_beyond { *in_a_row + 1 } else { 0 };
                *in_all += u64::from(is_beyond);
                if *in_a_row == 2 || *in_all == BEYOND_IN_ALL {
                    let far = value.abs() > FAR_BEYOND * lower.abs().max(upper.abs());
                    let of_raw = if self.whole && far {
                        "; the range is that of the raw values, here of whole numbers"
                    } else {
                        ""
                    };
                    return Err(format!(
                        "{}: the channel is saturated: {} at or beyond its range, {} to {}{of_raw}",
                        place(sample + 1, &wanted.channel),
                        if *in_a_row == 2 { "two values in a row" } else { "three values" },
                        Shortest(lower),
                        Shortest(upper)
                    ));
                }
            }
            high.see(*value, sample);
            low.see(*value, sample);
            let step = (value - *before).abs();
            if step > 0.0 && step < *least {
                *least = step;
            }
            *before = *value;
        }
        if let Some(held) = &mut self.held {
            held[channel].extend(values.iter().map(|value| conversion.of(*value)));
        }
        Ok(())
    }

    /// The sampling rate: from the recipe, else from the instants, else from the file.
    fn rate(&self, stated: Option<f64>) -> Measured {
        let exact = |value: f64| Measured {
            value,
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        };
        match (self.reading.rate, &self.clock) {
            (Some(rate), _) => rate,
            (None, Some(clock)) => clock.rate(),
            (None, None) => exact(stated.unwrap_or(f64::NAN)),
        }
    }

    /// A warning if the sampling rate of the recipe differs from the file's instants or from
    /// `header`, the rate in its header.
    fn contradicted(&self, header: Option<f64>) -> Option<Warning> {
        let stated = self.reading.rate.filter(|_| !self.reading.searched)?;
        let (found, u, whose) = match (&self.clock, header) {
            (Some(clock), _) if clock.count > 2 => {
                let rate = clock.rate();
                (rate.value, rate.standard_uncertainty, fact!("of-time-column"))
            }
            (None, Some(rate)) => (rate, WHOLE_HERTZ / UNCERTAINTIES_APART, fact!("of-header")),
            _ => return None,
        };
        let apart = found - stated.value;
        let within = UNCERTAINTIES_APART * (u * u + stated.standard_uncertainty.powi(2)).sqrt();
        (apart.abs() > within.max(RATES_APART * stated.value)).then(|| {
            let name = &self.reading.name;
            let fact = fact!(
                "sampling-rates-differ",
                name,
                stated = stated.value,
                whose,
                found = Argument::number(significant(found)),
                times = Argument::number(significant(stated.value / found)),
            );
            Warning::new(name, fact)
        })
    }

    /// Channels that stay at their highest or lowest value longer than a sine of the recipe's
    /// lowest frequency with their resolution would, or that reach it more often.
    fn suspects(&self, rate: f64, channels: usize) -> Vec<Warning> {
        let mut warnings = Vec::new();
        for channel in 0..channels {
            let (wanted, _) = &self.reading.channels[channel];
            let ends = &self.extremes[channel];
            let amplitude = (ends[0].value + ends[1].value) / 2.0;
            if amplitude <= 0.0 {
                let (name, channel) = (&self.reading.name, &wanted.channel);
                let fact = fact!("flat-channel", name, channel, value = ends[0].value);
                warnings.push(Warning::new(channel, fact));
                continue;
            }
            if let Some(end) = ends.iter().filter(|end| end.is_heaped()).max_by_key(|end| end.count)
            {
                let fact = fact!(
                    "saturated",
                    name = &self.reading.name,
                    at = at(end.at + 1, &wanted.channel),
                    count = end.count,
                    of = self.kept,
                    value = end.sign * end.value,
                    end = end.fact(),
                    next = end.next_count,
                );
                warnings.push(Warning::new(&wanted.channel, fact));
                continue;
            }
            let Some(hertz) = self.reading.slowest else { continue };
            let natural = (2.0 * self.steps[channel].0 / amplitude).sqrt()
                / (std::f64::consts::PI * hertz)
                * rate;
            let suspect = ends
                .iter()
                .filter(|end| end.longest >= LEAST_RUN && end.longest as f64 > 3.0 * natural + 2.0)
                .max_by_key(|end| end.longest);
            if let Some(end) = suspect {
                let fact = fact!(
                    "saturated.in-a-row",
                    name = &self.reading.name,
                    at = at(end.at + 1, &wanted.channel),
                    count = end.longest,
                    value = end.sign * end.value,
                    end = end.fact(),
                );
                warnings.push(Warning::new(&wanted.channel, fact));
            }
        }
        warnings
    }
}

/// Instants of samples: in order, without jumps; and their least-squares straight line.
struct Clock {
    first: f64,
    last: f64,
    count: u64,
    interval: f64,
    /// Sums over samples of the deviation d from the line of the first interval; sums of i and i^2
    /// are known.
    sum: f64,
    moment: f64,
    squares: f64,
}

impl Clock {
    fn new(first: f64) -> Self {
        Self { first, last: first, count: 1, interval: 0.0, sum: 0.0, moment: 0.0, squares: 0.0 }
    }

    /// Adds the next instant; `sample` counts from 0.
    fn see(&mut self, instant: f64, sample: u64) -> Result<(), String> {
        let step = instant - self.last;
        if self.count == 1 {
            self.interval = step;
        }
        let mean =
            if self.count > 1 { (self.last - self.first) / (self.count - 1) as f64 } else { step };
        if step == 0.0 {
            return Err(format!(
                "sample {}: the time repeats, {} s stands twice; time stamps too coarse for the \
                 samples between them do not tell the sampling rate: leave out `time` and state \
                 `sampling_rate` (or a sample is in the file twice)",
                sample + 1,
                Shortest(instant)
            ));
        }
        let what = if step < 0.0 {
            "runs backwards"
        } else if step > 1.5 * mean || step < 0.5 * mean {
            "jumps"
        } else {
            let deviation = instant - self.first - self.interval * self.count as f64;
            self.sum += deviation;
            self.moment += deviation * self.count as f64;
            self.squares += deviation * deviation;
            self.last = instant;
            self.count += 1;
            return Ok(());
        };
        let rounded = match what {
            "jumps" => {
                "; where no samples are missing and the stamps are rounded, leave out `time` and state \
                 `sampling_rate`"
            }
            _ => "",
        };
        Err(format!(
            "sample {}: the time {what}, from {} s to {} s, where steps of {:.6e} s are usual{rounded}",
            sample + 1,
            Shortest(self.last),
            Shortest(instant),
            mean.abs()
        ))
    }

    /// Slope of the deviations, and their scatter about the line, in seconds.
    fn line(&self) -> (f64, f64) {
        let n = self.count as f64;
        let middle = (n - 1.0) / 2.0;
        let spread = n * (n * n - 1.0) / 12.0;
        let slope = (self.moment - middle * self.sum) / spread;
        let left = self.squares - self.sum * self.sum / n - slope * slope * spread;
        let scatter = if n > 2.0 { (left.max(0.0) / (n - 2.0)).sqrt() } else { 0.0 };
        (slope, scatter)
    }

    /// The instant of the first sample, and the sampling rate. It follows from the middle of the
    /// record, where the fitted line is known best.
    fn start(&self, rate: f64) -> f64 {
        let n = self.count as f64;
        let middle = (n - 1.0) / 2.0;
        let deviation = self.sum / n + middle * (self.interval - 1.0 / rate);
        // the rounding of sums
        if deviation.abs() <= 1e-9 * self.interval { self.first } else { self.first + deviation }
    }

    /// The standard uncertainty of the instant in the middle.
    fn of_middle(&self) -> f64 {
        self.scatter() / (self.count as f64).sqrt()
    }

    fn scatter(&self) -> f64 {
        self.line().1
    }

    fn rate(&self) -> Measured {
        let (slope, scatter) = self.line();
        let n = self.count as f64;
        let interval = self.interval + slope;
        let of_interval = scatter * (12.0 / (n * (n * n - 1.0))).sqrt();
        Measured {
            value: 1.0 / interval,
            standard_uncertainty: of_interval / (interval * interval),
            degrees_of_freedom: (n - 2.0).max(1.0),
        }
    }
}

/// A sample of a channel.
fn at(sample: u64, channel: &str) -> Fact {
    match channel == super::THE_TIME {
        true => fact!("sample-of-time", sample),
        false => fact!("sample-of-channel", sample, channel),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instants_give_the_rate_and_its_uncertainty() {
        let mut clock = Clock::new(10.0);
        // an interval of 1/1612 s, printed with 5 decimals: rounding of 10 us
        for i in 1..20_000u32 {
            let instant = 10.0 + f64::from(i) / 1612.0;
            clock.see((instant * 1e5).round() / 1e5, u64::from(i)).unwrap();
        }
        let rate = clock.rate();
        assert!((rate.value - 1612.0).abs() < 3.0 * rate.standard_uncertainty, "{rate:?}");
        // 10 us/sqrt(12); rounding errors of a line are spread evenly
        assert!((clock.scatter() / (1e-5 / 12f64.sqrt()) - 1.0).abs() < 0.02);
    }

    #[test]
    fn jumps_and_steps_back_are_named() {
        let after = |instant: f64| {
            let mut clock = Clock::new(0.0);
            for i in 1..5u32 {
                clock.see(f64::from(i) * 0.1, u64::from(i)).unwrap();
            }
            clock.see(instant, 5)
        };
        assert!(after(0.5).is_ok());
        let jump = after(0.6).unwrap_err();
        assert!(jump.contains("sample 6: the time jumps"), "{jump}");
        assert!(jump.contains("leave out `time` and state `sampling_rate`"), "{jump}");
        assert!(after(0.3).unwrap_err().contains("runs backwards"));
        let repeated = after(0.4).unwrap_err();
        assert!(repeated.contains("sample 6: the time repeats, 0.4 s stands twice"), "{repeated}");
        assert!(repeated.contains("leave out `time` and state `sampling_rate`"), "{repeated}");
        assert!(after(0.42).unwrap_err().contains("jumps"));
    }

    /// The line through all instants tells when the first sample was taken, not its own time stamp.
    /// The standard uncertainty in the middle is the scatter over the square root of the number of
    /// instants.
    #[test]
    fn one_late_stamp_moves_no_start() {
        let of = |late: f64| {
            let mut clock = Clock::new(5.0 + late);
            for i in 1..1000u32 {
                clock.see(5.0 + f64::from(i) / 1000.0, u64::from(i)).unwrap();
            }
            clock
        };
        let exact = of(0.0);
        assert_eq!(exact.start(exact.rate().value), 5.0);
        assert!(exact.of_middle() < 1e-12);
        let late = of(3e-4);
        // the least-squares intercept takes 4/n of it at the end of the line, and 1/n in the middle
        let moved = late.start(late.rate().value) - 5.0;
        assert!((moved - 3e-4 * 4.0 / 1000.0).abs() < 1e-8, "{moved}");
        // s = d/sqrt(n), so d/n
        assert!((late.of_middle() - 3e-7).abs() < 2e-9, "{}", late.of_middle());
        // with a stated rate only the middle counts
        assert!((late.start(1000.0) - 5.0 - 3e-7).abs() < 1e-9);
    }
}
