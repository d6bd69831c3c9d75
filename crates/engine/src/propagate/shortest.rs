//! The search for the shortest interval of a probability p: the least Q(s + p) - Q(s) over the
//! probability s below it (JCGM 101, 5.3.4 and 7.7.4). Its slope over s is 1/f(high) - 1/f(low), so that the
//! density f is the same at both ends of the shortest interval, or it begins or ends where the values do.

#[cfg(test)]
mod tests;

/// An interval of the wanted probability.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interval {
    /// The probabilities below and above it.
    pub(super) tails: [f64; 2],
    pub(super) ends: [f64; 2],
    /// How far its length may be off.
    pub(super) off: f64,
    /// The density at the lower end less that at the upper one, and how far that may be off.
    pub(super) excess: [f64; 2],
}

impl Interval {
    pub(super) fn length(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// The sign of the slope of the length, 0 where it is not known.
    fn sign(&self) -> f64 {
        let [excess, off] = self.excess;
        if excess.abs() > off { excess.signum() } else { 0.0 }
    }
}

/// What intervals are looked at for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// To see where about the shortest one is.
    Survey,
    /// To find it.
    Find,
}

/// The shortest interval.
#[derive(Clone, Copy, Debug)]
pub(super) struct Least {
    pub(super) interval: Interval,
    /// Between which probabilities below it the density at both ends is not told apart.
    pub(super) range: [f64; 2],
    /// Whether no interval outside that range is as short.
    pub(super) alone: bool,
}

impl Least {
    /// Whether an interval with this probability below it cannot be told from the shortest one.
    pub(super) fn includes(&self, below: f64) -> bool {
        self.range[0] <= below && below <= self.range[1]
    }
}

/// Intervals that are looked at first.
const PARTS: u16 = 32;

/// The share of the probability outside that the first interval has below it at least, where the shortest
/// one begins where the values do.
const LEAST_SHARE: f64 = 1e-13;

/// Intervals that are longer than the shortest of the first ones by more than this share are not looked at
/// again.
const NEARLY: f64 = 0.02;

/// The distance of intervals from which the steepness of the excess follows, in shares of the smaller of the
/// probabilities outside.
const STEP: f64 = 0.02;

/// Steps towards equal densities at most.
const STEPS: u32 = 80;

/// A search among the intervals that `at` knows by the probabilities below and above them.
pub(super) struct ShortestSearch<F> {
    /// The probability outside.
    pub(super) tail: f64,
    pub(super) at: F,
}

impl<F: FnMut([f64; 2], Purpose) -> Option<Interval>> ShortestSearch<F> {
    /// The interval with a probability below it, counted from 0 or, below 0, from that of all outside.
    fn find(&mut self, place: f64) -> Option<Interval> {
        let tails =
            if place < 0.0 { [self.tail + place, -place] } else { [place, self.tail - place] };
        if tails[0] <= 0.0 || tails[1] <= 0.0 { None } else { (self.at)(tails, Purpose::Find) }
    }

    /// The shortest one.
    pub(super) fn least(&mut self) -> Option<Least> {
        let looked = self.looked();
        let length = |i: usize| looked.get(i).map_or(f64::INFINITY, Interval::length);
        let is_least = |&i: &usize| {
            length(i) <= length(i + 1)
                && i.checked_sub(1).is_none_or(|i_1| length(i) <= length(i_1))
        };
        let mut places: Vec<usize> = (0..looked.len()).filter(is_least).collect();
        places.sort_by(|&a, &b| length(a).total_cmp(&length(b)));
        let near = (1.0 + NEARLY) * places.first().map(|&i| length(i))?;
        let mut found: Vec<Least> = Vec::new();
        for place in places.into_iter().filter(|&i| length(i) <= near) {
            if !found.iter().any(|least| least.includes(looked[place].tails[0])) {
                found.extend(self.beside(&looked, place));
            }
        }
        let of = |least: &Least| least.interval.length();
        let mut least = found.iter().copied().min_by(|a, b| of(a).total_cmp(&of(b)))?;
        least.alone = found.iter().all(|other| {
            let same = least.includes(other.interval.tails[0]);
            same || of(other) > of(&least) + least.interval.off + other.interval.off
        });
        Some(least)
    }

    /// The first intervals, the lowest one first.
    fn looked(&mut self) -> Vec<Interval> {
        let tail = self.tail;
        let part = |k: u16| tail * f64::from(k) / f64::from(PARTS);
        let mut looked: Vec<Interval> = (1..PARTS)
            .filter_map(|k| (self.at)([part(k), part(PARTS - k)], Purpose::Survey))
            .collect();
        // towards the ends, as far as intervals become shorter there
        let mut share = 0.1 / f64::from(PARTS);
        while share > LEAST_SHARE && looked.first().is_some_and(|first| first.sign() > 0.0) {
            let tails = [share * tail, tail - share * tail];
            let lower = (self.at)(tails, Purpose::Survey);
            let Some(lower) = lower.filter(|interval| interval.sign() != 0.0) else { break };
            looked.insert(0, lower);
            share *= 0.1;
        }
        let mut share = 0.1 / f64::from(PARTS);
        while share > LEAST_SHARE && looked.last().is_some_and(|last| last.sign() < 0.0) {
            let tails = [tail - share * tail, share * tail];
            let upper = (self.at)(tails, Purpose::Survey);
            let Some(upper) = upper.filter(|interval| interval.sign() != 0.0) else { break };
            looked.push(upper);
            share *= 0.1;
        }
        looked
    }

    /// The shortest one about one of those that were looked at.
    fn beside(&mut self, looked: &[Interval], place: usize) -> Option<Least> {
        let mut found = |i: usize| (self.at)(looked[i].tails, Purpose::Find);
        let here = found(place)?;
        let low = (0..place).rev().filter_map(&mut found).find(|interval| interval.sign() < 0.0);
        let high =
            (place + 1..looked.len()).filter_map(&mut found).find(|interval| interval.sign() > 0.0);
        // it begins or ends where the values do
        let edge = |interval: Interval, range| Some(Least { interval, range, alone: true });
        let near = match (low, high, here.sign()) {
            (Some(low), _, sign) if sign > 0.0 => self.balanced([low, here])?,
            (_, Some(high), sign) if sign < 0.0 => self.balanced([here, high])?,
            (None, _, sign) if sign > 0.0 => {
                let first = found(0)?;
                return edge(first, [0.0, first.tails[0]]);
            }
            (_, None, sign) if sign < 0.0 => {
                let last = found(looked.len() - 1)?;
                return edge(last, [last.tails[0], self.tail]);
            }
            _ => here,
        };
        Some(self.about(near))
    }

    /// The interval with the same density at both ends between one with more of it at its upper end and
    /// one with more of it at its lower one: regula falsi of Illinois, halvings where it stalls.
    fn balanced(&mut self, between: [Interval; 2]) -> Option<Interval> {
        // counted from the nearer end
        let from_above = between[1].tails[1] < between[0].tails[0];
        let place =
            |interval: &Interval| if from_above { -interval.tails[1] } else { interval.tails[0] };
        let [mut low, mut high] = between.map(|interval| [place(&interval), interval.excess[0]]);
        let mut last = between[0];
        let mut before = 0.0;
        for step in 1..=STEPS {
            let mut at = low[0] - low[1] * (high[0] - low[0]) / (high[1] - low[1]);
            let middle = 0.5 * (low[0] + high[0]);
            if !(at > low[0] && at < high[0]) || step % 8 == 0 {
                at = middle;
            }
            if !(at > low[0] && at < high[0]) {
                break;
            }
            last = self.find(at)?;
            let sign = last.sign();
            let (own, other) =
                if sign < 0.0 { (&mut low, &mut high) } else { (&mut high, &mut low) };
            *own = [at, last.excess[0]];
            if sign == before {
                other[1] *= 0.5;
            }
            if sign == 0.0 {
                break;
            }
            before = sign;
        }
        Some(last)
    }

    /// An interval with the same density at both ends, and the others that cannot be told from it.
    pub(super) fn about(&mut self, interval: Interval) -> Least {
        let [below, above] = interval.tails;
        let place = if above < below { -above } else { below };
        let step = STEP * below.min(above);
        let beside = [self.find(place - step), self.find(place + step)];
        let steepness = match beside {
            [Some(lower), Some(upper)] => (upper.excess[0] - lower.excess[0]) / (2.0 * step),
            _ => 0.0,
        };
        let least = f64::EPSILON * below.min(above);
        let first = (2.0 * interval.excess[1] / steepness).max(least).min(self.tail);
        let mut reach = |direction: f64, room: f64| {
            let mut width = if steepness > 0.0 { first } else { step };
            while width < room {
                let other = self.find(place + direction * width);
                if other.is_none_or(|other| other.sign() == direction) {
                    return width;
                }
                width *= 4.0;
            }
            room
        };
        let range = [below - reach(-1.0, below), below + reach(1.0, above)];
        Least { interval, range, alone: true }
    }
}
