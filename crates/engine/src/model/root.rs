//! The root of an equation inside a model: what `solve(...)` of a formula computes.

use super::program::Program;
use super::schedule::{Schedule, ScheduledOutput};
use crate::number::{COLUMN, CodePath, Column, Routine, Shortest};

/// The range is looked at in so many cells for changes of sign.
const CELLS: usize = 16;

/// Steps at most. Halving alone needs some 60 from a cell to the last bit of a root of its size, and
/// 2100 from the largest numbers to the smallest.
const STEPS: usize = 2200;

/// The value of an unknown at which a function of it and of other quantities is 0.
///
/// Operands are both ends of the range, then the other quantities. There has to be one root among the
/// changes of sign in the range, seen at 17 places evenly spread; it is found by Chandrupatla's method
/// (inverse quadratic interpolation where that is safe, halving elsewhere) to the last bits, and the
/// other changes, of jumps and poles, by the same.
/// Its derivatives are those of the implicit function theorem: by a quantity p,
/// -(df/dp)/(df/dx).
#[derive(Clone, Debug)]
pub(crate) struct Root {
    unknown: String,
    /// The function; its first variable is the unknown.
    body: Program,
    schedule: Schedule,
}

impl Root {
    /// The root of a program of one output, whose first variable is the unknown of that name.
    pub(crate) fn new(unknown: impl Into<String>, body: Program) -> Self {
        let schedule = Schedule::keeping_variables(&body, &vec![None; body.variables]);
        Self { unknown: unknown.into(), body, schedule }
    }

    /// The function at a value of the unknown.
    fn at(&self, x: f64, rest: &[f64]) -> f64 {
        let variables: Vec<f64> = std::iter::once(x).chain(rest.iter().copied()).collect();
        self.body.evaluate(&variables).first().copied().unwrap_or(f64::NAN)
    }
}

/// The place of this number in a range.
fn place([from, to]: [f64; 2], number: usize) -> f64 {
    if number == CELLS { to } else { from + (to - from) * (number as f64 / CELLS as f64) }
}

/// What looking at the range found.
#[derive(Clone, Debug, Default)]
struct Look {
    /// The last place and the function there.
    last: Option<[f64; 2]>,
    /// Cells and places at which the sign changes, up to two.
    changes: Vec<[[f64; 2]; 2]>,
    /// Where the function has no value.
    hole: Option<f64>,
}

impl Look {
    fn see(&mut self, x: f64, y: f64) {
        if y.is_nan() || x.is_nan() {
            self.hole = self.hole.or(Some(x));
            return;
        }
        let here = [x, y];
        let change = match self.last {
            _ if y == 0.0 => Some([here, here]),
            Some(last) if last[1] * y.signum() < 0.0 => Some([last, here]),
            _ => None,
        };
        if let Some(change) = change {
            self.changes.push(change);
        }
        self.last = Some(here);
    }

    /// The one change of sign; none if there is none, or more than one.
    fn cell(&self) -> Option<[[f64; 2]; 2]> {
        match self.changes.as_slice() {
            [cell] if self.hole.is_none() => Some(*cell),
            _ => None,
        }
    }

    /// Whether there are several changes of sign, of which all but one may be jumps or poles.
    fn has_several(&self) -> bool {
        self.hole.is_none() && self.changes.len() > 1
    }
}

/// The search in one trial.
#[derive(Clone, Copy, Debug)]
struct RootSearch {
    /// The last place, the other end of the bracket, and the place before.
    points: [[f64; 2]; 3],
    /// Share of the way from the first point to the second at which to look next.
    share: f64,
    /// The largest finite value at the ends of the cell.
    largest: f64,
    /// The root, or a NaN if there is none.
    found: Option<f64>,
}

impl RootSearch {
    fn nothing() -> Self {
        let points = [[0.0; 2]; 3];
        Self { points, share: 0.5, largest: 0.0, found: Some(f64::NAN) }
    }

    fn new(cell: Option<[[f64; 2]; 2]>) -> Self {
        let Some([first, second]) = cell else { return Self::nothing() };
        let found = (first[0] == second[0]).then_some(first[0]);
        // beside a pole at an end every value is small
        let finite = |y: f64| if y.is_finite() { y.abs() } else { 0.0 };
        let largest = finite(first[1]).max(finite(second[1]));
        Self { points: [second, first, first], share: 0.5, largest, found }
    }

    /// Where to look next.
    fn next(&self) -> f64 {
        let [[a, _], [b, _], _] = self.points;
        self.found.unwrap_or(a + self.share * (b - a))
    }

    /// Takes in the function at [`RootSearch::next`].
    fn take(&mut self, y: f64) {
        if self.found.is_some() {
            return;
        }
        if y.is_nan() {
            self.found = Some(f64::NAN);
            return;
        }
        let here = [self.next(), y];
        let [first, second, _] = self.points;
        self.points = if (y > 0.0) == (first[1] > 0.0) {
            [here, second, first]
        } else {
            [here, first, second]
        };
        let [[a, p], [b, q], [c, r]] = self.points;
        let best = if q.abs() < p.abs() { [b, q] } else { [a, p] };
        let tolerance = 2.0 * f64::EPSILON * best[0].abs() + f64::MIN_POSITIVE;
        let least = tolerance / (b - a).abs();
        if best[1] == 0.0 || least > 0.5 || a == b {
            // a jump or a pole changes sign without being 0
            let jumps = best[1].abs() > 0.5 * self.largest;
            self.found = Some(if jumps { f64::NAN } else { best[0] });
            return;
        }
        let (xi, phi) = ((a - b) / (c - b), (p - q) / (r - q));
        let safe = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
        let share = if safe {
            p / (q - p) * r / (q - r) + (c - a) / (b - a) * p / (r - p) * q / (r - q)
        } else {
            0.5
        };
        self.share = if share.is_finite() { share.clamp(least, 1.0 - least) } else { 0.5 };
    }
}

fn ends(operands: &[f64]) -> ([f64; 2], &[f64]) {
    match operands {
        [from, to, rest @ ..] => ([*from, *to], rest),
        _ => ([f64::NAN; 2], &[]),
    }
}

impl Root {
    fn look(&self, operands: &[f64]) -> Look {
        let (range, rest) = ends(operands);
        let mut look = Look::default();
        for number in 0..=CELLS {
            let x = place(range, number);
            look.see(x, self.at(x, rest));
        }
        look
    }

    /// What a search from a change of sign leads to: the root, or a NaN at a jump or a pole.
    fn searched(&self, mut search: RootSearch, rest: &[f64]) -> f64 {
        for _ in 0..STEPS {
            if search.found.is_some() {
                break;
            }
            search.take(self.at(search.next(), rest));
        }
        search.found.unwrap_or(f64::NAN)
    }

    /// The changes of sign that are roots.
    fn roots(&self, look: &Look, rest: &[f64]) -> Vec<f64> {
        let cells = look.changes.iter().copied();
        let all = cells.map(|cell| self.searched(RootSearch::new(Some(cell)), rest));
        all.filter(|root| !root.is_nan()).collect()
    }

    /// The one root among several changes of sign; a NaN if none is, or more.
    fn among_several(&self, look: &Look, rest: &[f64]) -> f64 {
        match self.roots(look, rest).as_slice() {
            [root] => *root,
            _ => f64::NAN,
        }
    }
}

impl Routine for Root {
    fn name(&self) -> &'static str {
        "solve"
    }

    fn value(&self, operands: &[f64]) -> f64 {
        let (_, rest) = ends(operands);
        let look = self.look(operands);
        if look.has_several() {
            return self.among_several(&look, rest);
        }
        self.searched(RootSearch::new(look.cell()), rest)
    }

    fn slopes(&self, operands: &[f64], value: f64) -> Vec<f64> {
        let (_, rest) = ends(operands);
        let variables: Vec<f64> = std::iter::once(value).chain(rest.iter().copied()).collect();
        let (_, gradients) = self.body.gradients(&variables);
        let gradient = gradients.first().map_or(&[][..], Vec::as_slice);
        let (by_unknown, others) = gradient.split_first().unwrap_or((&f64::NAN, &[]));
        // which range is searched has no say in what is found
        let by_others = others.iter().map(|by| if *by == 0.0 { 0.0 } else { -by / by_unknown });
        [0.0, 0.0].into_iter().chain(by_others).collect()
    }

    fn undefined(&self, operands: &[f64]) -> String {
        let (range, rest) = ends(operands);
        let (unknown, [from, to]) = (&self.unknown, range.map(Shortest));
        let look = self.look(operands);
        if let Some(hole) = look.hole {
            let hole = Shortest(hole);
            return format!(
                "solve for `{unknown}` from {from} to {to}: the formula has no value at {hole}"
            );
        }
        let near = |[[a, _], [b, _]]: &[[f64; 2]; 2]| {
            let [a, b] = [a, b].map(|x| Shortest(*x));
            if a == b { format!("at {a}") } else { format!("between {a} and {b}") }
        };
        let near: Vec<String> = look.changes.iter().map(near).collect();
        let roots = self.roots(&look, rest);
        match near.as_slice() {
            [] => {
                let [first, last] = range.map(|x| Shortest(self.at(x, rest)));
                format!(
                    "solve for `{unknown}`: the formula is {first} at {from} and {last} at {to}, \
                     and changes its sign at none of {} places between",
                    CELLS - 1
                )
            }
            [one] => format!(
                "solve for `{unknown}`: the formula changes its sign {one} by a jump or a pole, \
                 and is not 0 there"
            ),
            several if roots.is_empty() => format!(
                "solve for `{unknown}`: the formula changes its sign by jumps or poles, and is not 0 \
                 there: {}",
                several.join(", ")
            ),
            _ => {
                let roots: Vec<String> =
                    roots.iter().map(|root| format!("at {}", Shortest(*root))).collect();
                format!(
                    "solve for `{unknown}` from {from} to {to}: the formula is 0 more than once: {}",
                    roots.join(", ")
                )
            }
        }
    }

    fn column(&self, operands: &[[f64; COLUMN]], out: &mut [f64; COLUMN]) {
        let [from, to, rest @ ..] = operands else {
            out.fill(f64::NAN);
            return;
        };
        let mut registers = vec![Column::ZERO; self.schedule.registers.max(1)];
        for (register, operand) in registers.iter_mut().skip(1).zip(rest) {
            register.0 = *operand;
        }
        let path = CodePath::best();
        let mut run = |x: &[f64; COLUMN]| {
            registers[0].0 = *x;
            self.schedule.run_on(path, &mut registers);
            match self.schedule.outputs.first() {
                Some(ScheduledOutput::Register(register)) => registers[*register].0,
                Some(ScheduledOutput::Constant(value)) => [*value; COLUMN],
                None => [f64::NAN; COLUMN],
            }
        };
        let mut looks = vec![Look::default(); COLUMN];
        for number in 0..=CELLS {
            let x = std::array::from_fn(|trial| place([from[trial], to[trial]], number));
            for ((look, x), y) in looks.iter_mut().zip(x).zip(run(&x)) {
                look.see(x, y);
            }
        }
        let mut searches: Vec<RootSearch> =
            looks.iter().map(|look| RootSearch::new(look.cell())).collect();
        for _ in 0..STEPS {
            if searches.iter().all(|search| search.found.is_some()) {
                break;
            }
            let x = std::array::from_fn(|trial| searches[trial].next());
            for (search, y) in searches.iter_mut().zip(run(&x)) {
                search.take(y);
            }
        }
        for (trial, search) in searches.into_iter().enumerate() {
            let look = &looks[trial];
            out[trial] = if look.has_several() {
                let rest: Vec<f64> = rest.iter().map(|operand| operand[trial]).collect();
                self.among_several(look, &rest)
            } else {
                search.found.unwrap_or(f64::NAN)
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Recorder, Traced};
    use crate::number::{Number, Unary};

    /// x^3 + p x - q = 0.
    fn cubic() -> Root {
        let recorder = Recorder::default();
        let [x, p, q] = [0, 1, 2].map(|v| recorder.variable(v));
        Root::new("x", recorder.program(3, &[x * x * x + p * x - q]))
    }

    /// The real root of x^3 + x - 1 is 0.682327803828019327...; its derivatives by p and q are
    /// -x/(3 x^2 + p) and 1/(3 x^2 + p). Two roundings of the last bit.
    #[test]
    fn roots_and_their_derivatives() {
        let root = cubic();
        let operands = [0.0, 2.0, 1.0, 1.0];
        let x = root.value(&operands);
        assert!((x - 0.682_327_803_828_019_3).abs() < 3e-16, "{x}");
        let slopes = root.slopes(&operands, x);
        let by_x = 3.0 * x * x + 1.0;
        assert_eq!(slopes[..2], [0.0, 0.0]);
        assert!((slopes[2] + x / by_x).abs() < 1e-15);
        assert!((slopes[3] - 1.0 / by_x).abs() < 1e-15);
    }

    /// However wide the range, a root has all its digits.
    #[test]
    fn roots_in_wide_ranges() {
        let recorder = Recorder::default();
        let [x, b] = [0, 1].map(|v| recorder.variable(v));
        let line = Root::new("x", recorder.program(2, &[x - b]));
        let recorder = Recorder::default();
        let [x, b] = [0, 1].map(|v| recorder.variable(v));
        let growth = Root::new("x", recorder.program(2, &[x.unary(Unary::Exp) - b]));
        for (from, to) in [(0.0, 1e6), (0.0, 1e20), (-3e17, 1e20), (0.0, 1e300), (1.0, 1e300)] {
            let x = line.value(&[from, to, 4.0]);
            assert!((x - 4.0).abs() < 2e-15, "{x} from {from} to {to}");
            let x = growth.value(&[from, to, 4.0]);
            assert!((x - 4.0_f64.ln()).abs() < 1e-15, "{x} from {from} to {to}");
        }
    }

    /// A pole at one of the places that are looked at is no root, and a root beside one is.
    #[test]
    fn poles_at_places_are_no_roots() {
        let recorder = Recorder::default();
        let [x, k, one] = [0, 1, 2].map(|v| recorder.variable(v));
        let pole = Root::new("x", recorder.program(3, &[one / x - k]));
        for (from, to) in [(-10.0, 10.0), (-1.0, 1.0), (-10.0, 9.0)] {
            assert!(pole.value(&[from, to, 0.01, 1.0]).is_nan(), "{from} to {to}");
        }
        let said = pole.undefined(&[-10.0, 10.0, 0.01, 1.0]);
        assert!(said.contains("by a jump or a pole"), "{said}");
        let x = pole.value(&[0.0, 10.0, 0.25, 1.0]);
        assert!((x - 4.0).abs() < 2e-15, "{x}");
        let recorder = Recorder::default();
        let [x, k] = [0, 1].map(|v| recorder.variable(v));
        let ln = Root::new("x", recorder.program(2, &[x.unary(Unary::Ln) - k]));
        let x = ln.value(&[0.0, 10.0, -3.0]);
        assert!((x - (-3.0_f64).exp()).abs() < 1e-16, "{x}");
    }

    #[test]
    fn columns_have_the_bits_of_single_trials() {
        let root = cubic();
        let number = |trial: usize, prime: usize| ((trial * prime) % 127) as f64 / 127.0;
        let mut operands = [[0.0; COLUMN]; 4];
        for trial in 0..COLUMN {
            let each = [-number(trial, 3), 2.0, number(trial, 5) - 0.3, 2.5 * number(trial, 11)];
            for (column, value) in operands.iter_mut().zip(each) {
                column[trial] = value;
            }
        }
        let mut out = [0.0; COLUMN];
        root.column(&operands, &mut out);
        for trial in 0..COLUMN {
            let alone = root.value(&operands.map(|column| column[trial]));
            assert_eq!(out[trial].to_bits(), alone.to_bits(), "{trial}");
        }
        assert!(out.iter().filter(|x| x.is_finite()).count() > 90);
    }

    #[test]
    fn where_there_is_no_single_root() {
        let root = cubic();
        assert!(root.value(&[1.0, 2.0, 1.0, 1.0]).is_nan());
        assert_eq!(
            root.undefined(&[1.0, 2.0, 1.0, 1.0]),
            "solve for `x`: the formula is 1 at 1 and 9 at 2, and changes its sign at none of 15 \
             places between"
        );
        // x^3 - 3 x
        let twice = [-4.0, 4.0, -3.0, 0.0];
        assert!(root.value(&twice).is_nan());
        assert_eq!(
            root.undefined(&twice),
            format!(
                "solve for `x` from -4 to 4: the formula is 0 more than once: at {}, at 0, at {}",
                -3.0_f64.sqrt(),
                3.0_f64.sqrt()
            )
        );
        let recorder = Recorder::default();
        let pole = Traced::constant(1.0) / recorder.variable(0);
        let pole = Root::new("x", recorder.program(1, &[pole]));
        assert!(pole.value(&[-1.0, 2.0]).is_nan());
        assert_eq!(
            pole.undefined(&[-1.0, 2.0]),
            "solve for `x`: the formula changes its sign between -0.0625 and 0.125 by a jump or a \
             pole, and is not 0 there"
        );
        // 1/x + p has a pole at 0 and a root at -1/p
        let recorder = Recorder::default();
        let [x, p] = [0, 1].map(|v| recorder.variable(v));
        let beside = Root::new("x", recorder.program(2, &[Traced::constant(1.0) / x + p]));
        assert_eq!(beside.value(&[-1.0, 1.9, -2.0]), 0.5);
        let mut column = [[0.0; COLUMN]; 3];
        for (column, value) in column.iter_mut().zip([-1.0, 1.9, -2.0]) {
            column.fill(value);
        }
        let mut out = [0.0; COLUMN];
        beside.column(&column, &mut out);
        assert_eq!(out, [0.5; COLUMN]);
        // the poles of 1/x + 1/(x - 1) and its root between them
        let recorder = Recorder::default();
        let x = recorder.variable(0);
        let [one, two] = [1.0, 1.0].map(Traced::constant);
        let poles = Root::new("x", recorder.program(1, &[one / x + two / (x - 1.0)]));
        assert!((poles.value(&[-1.0, 2.1]) - 0.5).abs() < 1e-16);
        let recorder = Recorder::default();
        let hole = Root::new("x", recorder.program(1, &[recorder.variable(0).sqrt()]));
        assert_eq!(
            hole.undefined(&[-1.0, 2.0]),
            "solve for `x` from -1 to 2: the formula has no value at -1"
        );
    }

    /// A root at 0, a root at an end, an infinite end, and a steep function.
    #[test]
    fn awkward_roots() {
        let recorder = Recorder::default();
        let x = recorder.variable(0);
        let odd = Root::new("x", recorder.program(1, &[x * x * x]));
        assert!(odd.value(&[-1.0, 3.0]).abs() < 1e-15);
        assert_eq!(odd.value(&[0.0, 1.0]), 0.0);
        let logarithm = Root::new("x", recorder.program(1, &[x.ln()]));
        assert_eq!(logarithm.value(&[0.0, 3.0]), 1.0);
        let steep = Root::new("x", recorder.program(1, &[(x * 200.0).exp() - 2.0]));
        // ln 2 / 200
        assert!((steep.value(&[-1.0, 1.0]) - 0.003_465_735_902_799_726_5).abs() < 1e-17);
    }
}
