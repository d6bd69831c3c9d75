//! How an effect of the list is found where something that the list does not have acts beside it.
//!
//! Six benches with two true effects each, of which one is in the list, at two levels of the noise; the
//! truths are the physics and not the formulas of the candidates, about half of which look like them.
//! And the same benches without a gap.
//!
//! `cargo run --release --example gap_beside [data sets of each bench [seed]]` from the project's folder;
//! with seed 1 it writes `reports/gap-beside.md`.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::print_stdout)] // rows as they come

use std::error::Error;
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use gumption::file::FileReader;
use gumption::gap::{Case, Diagnosis, DiagnosisOptions, HypothesisKind, diagnose};
use gumption::task::Row;
use serde_json::{Map, Value, json};

mod generator;

use generator::SplitMix64;

/// A candidate: its name, the standard deviation of its size, what it overrides, and how.
type Listed = (&'static str, f64, &'static str, &'static str);

/// What a bench measures: from inputs, conditions and the two true effects, each acting or not.
type Truth = fn(&[f64], &[f64], [bool; 2]) -> f64;

struct BesideBench {
    name: &'static str,
    /// Name, estimate, standard uncertainty.
    inputs: &'static [(&'static str, f64, f64)],
    conditions: [&'static str; 2],
    values: [&'static [f64]; 2],
    equations: &'static [(&'static str, &'static str)],
    output: &'static str,
    /// Standard uncertainty of a value, absolute and relative.
    u: [f64; 2],
    truth: Truth,
    /// The candidates of the two true effects, of which one is taken out, and all others.
    effects: [Listed; 2],
    others: &'static [Listed],
}

const BENCHES: [BesideBench; 6] = [
    BesideBench {
        name: "two-wire Pt100",
        inputs: &[("R0", 100.0, 0.004), ("A", 3.9083e-3, 4e-7), ("B", -5.775e-7, 5e-10)],
        conditions: ["t", "I"],
        values: [&[0.0, 25.0, 50.0, 75.0, 100.0, 130.0, 160.0, 200.0], &[0.5, 1.0, 2.0, 4.0]],
        equations: &[("h", "t"), ("R", "R0*(1 + A*h + B*h^2)")],
        output: "R",
        u: [0.003, 0.0],
        // self-heating with the power at the temperature that it makes; insulation that conducts when hot
        truth: |x, c, acts| {
            let platinum = |t: f64| x[0] * (1.0 + x[1] * t + x[2] * t * t);
            let mut t = c[0];
            for _ in 0..30 {
                let power = 1e-6 * c[1] * c[1] * platinum(t);
                t = c[0] + if acts[0] { 180.0 * power } else { 0.0 };
            }
            let r = platinum(t);
            let shunt = 3e7 * (-c[0] / 45.0).exp();
            if acts[1] { r * shunt / (r + shunt) } else { r }
        },
        effects: [
            ("self-heating", 0.05, "h", "h + p*I^2"),
            ("insulation", 0.2, "R", "R - p*exp(t/50)"),
        ],
        others: &[
            ("leads", 0.2, "R", "R + p"),
            ("thermometer-offset", 0.2, "h", "h + p"),
            ("thermometer-scale", 0.002, "h", "h*(1 + p)"),
            ("thermal-voltage", 0.05, "R", "R + p/I"),
        ],
    },
    BesideBench {
        name: "pendulum",
        inputs: &[("g", 9.81, 0.0005), ("e", 0.0, 0.00005)],
        conditions: ["l", "th"],
        values: [&[0.2, 0.3, 0.45, 0.65, 0.9, 1.2], &[0.05, 0.2, 0.4, 0.6, 0.8]],
        equations: &[("m", "l + e"), ("T", "2*3.141592653589793*sqrt(m/g)")],
        output: "T",
        u: [0.0008, 0.0],
        // the complete elliptic integral by the arithmetic-geometric mean; a bob that is a sphere
        truth: |x, c, acts| {
            let (mut a, mut b) = (1.0, (0.5 * c[1]).cos());
            for _ in 0..20 {
                (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
            }
            let swing = if acts[0] { 1.0 / a } else { 1.0 };
            let l = c[0] + x[1];
            let sphere = if acts[1] { 0.4 * 0.05 * 0.05 / l } else { 0.0 };
            2.0 * PI * f64::sqrt((l + sphere) / x[0]) * swing
        },
        effects: [
            ("finite-amplitude", 0.1, "T", "T*(1 + p*th^2)"),
            ("bob-size", 0.002, "m", "m + p/l"),
        ],
        others: &[
            ("length-offset", 0.003, "m", "m + p"),
            ("clock-rate", 0.002, "T", "T*(1 + p)"),
            ("trigger-delay", 0.003, "T", "T + p"),
            ("elastic-thread", 0.005, "m", "m*(1 + p*cos(th))"),
        ],
    },
    BesideBench {
        name: "Hall sensor",
        inputs: &[("s", 1.0, 0.0005), ("z", 0.0, 0.0003)],
        conditions: ["B", "t"],
        values: [
            &[-1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0],
            &[10.0, 20.0, 30.0, 40.0, 50.0],
        ],
        equations: &[("V", "s*B + z")],
        output: "V",
        u: [0.002, 0.0],
        // a sensitivity that falls like a mobility; a saturation of the core
        truth: |x, c, acts| {
            let field = if acts[1] { 3.2 * (c[0] / 3.2).tanh() } else { c[0] };
            let kelvin: f64 = (c[1] + 273.15) / 298.15;
            let mobility = if acts[0] { kelvin.powf(-1.3) } else { 1.0 };
            x[0] * mobility * field + x[1]
        },
        effects: [
            ("sensitivity-tempco", 0.005, "V", "V*(1 + p*(t - 25))"),
            ("saturation", 0.05, "V", "V*(1 - p*B^2)"),
        ],
        others: &[
            ("offset", 0.01, "V", "V + p"),
            ("offset-tempco", 0.001, "V", "V + p*(t - 25)"),
            ("gain", 0.02, "V", "V*(1 + p)"),
            ("planar", 0.02, "V", "V + p*B^2"),
        ],
    },
    BesideBench {
        name: "falling balls",
        inputs: &[("g", 9.81, 0.0005), ("e", 0.0, 0.0002)],
        conditions: ["h", "w"],
        values: [&[0.2, 0.35, 0.5, 0.75, 1.0, 1.4, 1.9, 2.5], &[0.003, 0.01, 0.03, 0.1]],
        equations: &[("d", "h + e"), ("t", "sqrt(2*d/g)")],
        output: "t",
        u: [0.0004, 0.0],
        // quadratic drag solved for the time; a magnet that lets heavy balls go sooner
        truth: |x, c, acts| {
            let d = c[0] + x[1];
            let k = if acts[0] { 2.4e-4 / c[1] } else { 1e-9 };
            let fall = (k * d).exp().acosh() / f64::sqrt(x[0] * k);
            fall + if acts[1] { 0.004 / (1.0 + c[1] / 0.02) } else { 0.0 }
        },
        effects: [
            ("air-drag", 0.001, "t", "t*(1 + p*h/w)"),
            ("release-delay", 0.005, "t", "t + p*exp(-w/0.03)"),
        ],
        others: &[
            ("height-offset", 0.005, "d", "d + p"),
            ("clock-rate", 0.005, "t", "t*(1 + p)"),
            ("gate-size", 0.002, "t", "t - p/sqrt(h)"),
            ("bounce", 0.001, "t", "t + p*h^2"),
        ],
    },
    BesideBench {
        name: "low-pass with a probe",
        inputs: &[("C", 1.0, 0.0008), ("G", 1.0, 0.0003)],
        conditions: ["f", "r"],
        values: [&[0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.5, 3.0, 6.0], &[0.2, 0.5, 1.0, 2.0]],
        equations: &[("c", "C"), ("a", "G/sqrt(1 + (f*r*c)^2)")],
        output: "a",
        u: [0.0002, 0.002],
        // a probe of a resistance and a capacitance, by complex numbers; a follower of second order
        truth: |x, c, acts| {
            let load = if acts[0] { [1.0 / 80.0, 0.06] } else { [0.0, 0.0] };
            // 1 + r (1/R + i f (C + Cp))
            let (real, imaginary) = (1.0 + c[1] * load[0], c[1] * c[0] * (x[0] + load[1]));
            let q = c[0] / 9.0;
            let follower = if acts[1] {
                1.0 / ((1.0 - q * q).powi(2) + (1.2 * q).powi(2)).sqrt()
            } else {
                1.0
            };
            x[1] / real.hypot(imaginary) * follower
        },
        effects: [
            ("probe-capacitance", 0.1, "c", "c + p"),
            ("follower", 0.01, "a", "a*(1 + p*f^2)"),
        ],
        others: &[
            ("gain", 0.02, "a", "a*(1 + p)"),
            ("offset", 0.002, "a", "a + p"),
            ("crosstalk", 0.01, "a", "a + p*f"),
            ("resistor-tolerance", 0.02, "a", "a*(1 + p*r)"),
        ],
    },
    BesideBench {
        name: "robot joint",
        inputs: &[("k", 1.0, 0.0002), ("z", 0.0, 0.005)],
        conditions: ["y", "d"],
        values: [&[0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0], &[-1.0, 1.0]],
        equations: &[("x", "k*y + z")],
        output: "x",
        u: [0.004, 0.0],
        // an encoder disc off its axis; friction that winds the gear up, more where an arm is held out
        truth: |x, c, acts| {
            let off = if acts[0] { (0.12 * (c[0] + 0.4).sin()).atan() } else { 0.0 };
            let wound = if acts[1] { 0.035 * c[1] * (1.0 + 0.3 * c[0].cos()) } else { 0.0 };
            x[0] * c[0] + x[1] + off + wound
        },
        effects: [
            ("eccentricity", 0.2, "x", "x + p*sin(y + 0.4)"),
            ("backlash", 0.05, "x", "x + p*d"),
        ],
        others: &[
            ("gain", 0.01, "x", "x*(1 + p)"),
            ("second-harmonic", 0.1, "x", "x + p*sin(2*y)"),
            ("gravity", 0.1, "x", "x + p*cos(y)"),
            ("viscous", 0.02, "x", "x + p*d*y"),
        ],
    },
];

/// Data of a bench with conditions outside of them and what is true there, without noise.
struct Simulated {
    case: Value,
    table: String,
    outside: Vec<(Vec<f64>, f64)>,
}

impl BesideBench {
    /// A data set with effects acting, where `listed` are in the list beside those that never act.
    fn simulated(&self, acts: [bool; 2], listed: &[Listed], noise: f64, seed: u64) -> Simulated {
        let of_name = self.name.bytes().fold(seed, |h, b| h.wrapping_mul(31) + u64::from(b));
        let mut random = SplitMix64(of_name);
        random.next();
        let inputs: Vec<f64> =
            self.inputs.iter().map(|(_, mean, u)| mean + random.normal(*u)).collect();
        let truth = |c: &[f64]| (self.truth)(&inputs, c, acts);
        let [one, other] = self.conditions;
        let mut table = format!("{one},{other},value,u\n");
        for first in self.values[0] {
            for second in self.values[1] {
                let value = truth(&[*first, *second]);
                let u = noise * self.u[0].hypot(self.u[1] * value);
                let measured = value + random.normal(u);
                table += &format!("{first},{second},{measured},{u}\n");
            }
        }
        let ends = |n: usize| {
            let of = |a: f64, b: f64| (a.min(b), a.max(b));
            of(self.values[n][0], self.values[n][self.values[n].len() - 1])
        };
        // 5 to 40 % of the range above the greatest value of one of the conditions that can be set so
        let outside = (0..8).map(|number| {
            let between = |n: usize, share: f64| ends(n).0 + (ends(n).1 - ends(n).0) * share;
            let mut at = vec![between(0, random.uniform()), between(1, random.uniform())];
            let n = if self.values[1].len() > 2 { number % 2 } else { 0 };
            if self.values[1].len() == 2 {
                at[1] = self.values[1][number % 2];
            }
            at[n] = between(n, 1.05 + 0.35 * random.uniform());
            let value = truth(&at);
            (at, value)
        });
        let outside = outside.collect();
        let normal =
            |mean: f64, std: f64| json!({"distribution": "normal", "mean": mean, "std": std});
        let named = |pairs: Vec<(&str, Value)>| -> Value {
            let pairs = pairs.into_iter().map(|(name, of)| (name.to_owned(), of));
            pairs.collect::<Map<String, Value>>().into()
        };
        let inputs = self.inputs.iter().map(|(name, mean, u)| (*name, normal(*mean, *u)));
        let equations = self.equations.iter().map(|(name, text)| (*name, json!(text)));
        let effect = |&(name, std, of, how): &Listed| {
            let parameters = json!({"p": normal(0.0, std)});
            (name, json!({"parameters": parameters, "overrides": named(vec![(of, json!(how))])}))
        };
        let case = json!({
            "inputs": named(inputs.collect()),
            "conditions": named(self.conditions.iter().map(|name| (*name, json!({}))).collect()),
            "equations": named(equations.collect()),
            "outputs": named(vec![(self.output, json!({}))]),
            "observations": {"file": "data.csv", "columns": named(vec![(
                self.output,
                json!({"value": "value", "standard_uncertainty": "u"}),
            )])},
            "effects": named(listed.iter().chain(self.others).map(effect).collect()),
        });
        Simulated { case, table, outside }
    }

    fn diagnosed(&self, of: &Simulated, folder: &Path) -> Result<Diagnosis, Box<dyn Error>> {
        let mut ahead = self.conditions.join(",") + "\n";
        for (conditions, _) in &of.outside {
            let cells: Vec<String> = conditions.iter().map(f64::to_string).collect();
            ahead += &(cells.join(",") + "\n");
        }
        let (case, at) = (folder.join("case.json"), folder.join("at.csv"));
        std::fs::write(folder.join("data.csv"), &of.table)?;
        std::fs::write(&case, of.case.to_string())?;
        std::fs::write(&at, ahead)?;
        let reader = FileReader::default();
        let read: Case = reader.case(&case)?.case;
        let rows: Vec<Row> = reader.case_at(&case, &at)?;
        Ok(diagnose(&read, Some(&rows), DiagnosisOptions::new(1), &|_| {})?)
    }
}

/// The probability that an effect is there.
fn present(found: &Diagnosis, effect: &str) -> f64 {
    let own = found.present.iter().find(|of| of.effect == effect);
    own.map_or(0.0, |own| own.probability)
}

/// Whether one effect is the same function as another, or as a hypothesis that holds it.
fn is_equivalent(found: &Diagnosis, one: &str, other: &str) -> bool {
    let has = |group: &[Vec<String>], name: &str| group.iter().flatten().any(|of| of == name);
    found.next.equivalent.iter().any(|group| has(group, one) && has(group, other))
}

#[derive(Default)]
struct Tally {
    cases: usize,
    there: usize,
    lost: usize,
    false_names: usize,
    others: usize,
    kinds: [usize; 3],
    outside: [usize; 2],
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let sets: u64 = arguments.next().map_or(Ok(5), |n| n.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |n| n.parse())?;
    let folder = tempfile::tempdir()?;
    let mut table = String::new();
    let mut tallies = [Tally::default(), Tally::default()];
    let started = Instant::now();
    for bench in &BENCHES {
        for set in 0..sets {
            let own = (set % 2) as usize;
            let listed = bench.effects[own];
            for (level, noise) in [1.0, 0.3].into_iter().enumerate() {
                let data = bench.simulated([true; 2], &[listed], noise, 100 * seed + set);
                let found = bench.diagnosed(&data, folder.path())?;
                let line = tallies[level].add(bench, own, noise, &data, &found)?;
                print!("{line}");
                table += &line;
            }
        }
    }
    let took = started.elapsed().as_secs_f64() / (12 * sets) as f64;
    let mut alarms = 0;
    for bench in &BENCHES {
        for set in 0..sets {
            let data = bench.simulated([false; 2], &bench.effects, 1.0, 10_000 * seed + set);
            let found = bench.diagnosed(&data, folder.path())?;
            alarms += usize::from(found.most_probable.kind != HypothesisKind::None);
        }
    }
    let page = page(&tallies, [alarms, BENCHES.len() * sets as usize], &table, took)?;
    print!("{page}");
    if seed == 1 {
        std::fs::write("reports/gap-beside.md", page)?;
    }
    Ok(())
}

impl Tally {
    fn add(
        &mut self,
        bench: &BesideBench,
        own: usize,
        noise: f64,
        data: &Simulated,
        found: &Diagnosis,
    ) -> Result<String, Box<dyn Error>> {
        let listed = bench.effects[own].0;
        let p = present(found, listed);
        self.cases += 1;
        self.there += usize::from(p > 0.9);
        self.lost += usize::from(p < 0.01);
        let mut wrong = Vec::new();
        for (name, ..) in bench.others {
            self.others += 1;
            if present(found, name) > 0.9 && !is_equivalent(found, name, listed) {
                self.false_names += 1;
                wrong.push(*name);
            }
        }
        let verdict = &found.most_probable;
        self.kinds[match verdict.kind {
            HypothesisKind::Unexplained => 2,
            _ => usize::from(verdict.beside.is_none()),
        }] += 1;
        let mut worst = 0.0_f64;
        for ((_, truth), row) in data.outside.iter().zip(found.prediction.iter().flatten()) {
            let (value, u) = row.outputs[0];
            let z = ((value - truth) / u).abs();
            self.outside[0] += usize::from(z < 2.0);
            self.outside[1] += 1;
            worst = worst.max(z);
        }
        let left = verdict.beside.as_ref().map_or_else(String::new, |left| {
            let over = left.form.over.name().unwrap_or("nothing").to_owned();
            format!("{} over {over}, {:.0} %", left.form.shape.name(), 100.0 * left.share_of_gap)
        });
        let said = match verdict.kind {
            HypothesisKind::Unexplained => "unexplained".to_owned(),
            _ => verdict.effects.join(" + "),
        };
        let mut line = String::new();
        writeln!(
            line,
            "| {}: {} | {noise} | {} | {p:.4} | {said} | {left} | {} | {worst:.1} |",
            bench.name,
            bench.effects[1 - own].0,
            listed,
            wrong.join(", ")
        )?;
        Ok(line)
    }
}

fn page(
    tallies: &[Tally; 2],
    [alarms, free]: [usize; 2],
    table: &str,
    took: f64,
) -> Result<String, Box<dyn Error>> {
    let mut page = String::from(
        "# An effect of the list beside something that the list does not have\n\n\
         Written by `cargo run --release --example gap_beside`. Six benches, two true effects each, one of \
         which is taken out of the list; the truths are the physics and not the formulas of the \
         candidates, and four candidates of each list never act. A false name is one of those four with \
         a probability above 0.9 that is not the same function as the effect that acts. Outside: eight \
         places of each data set 5 to 40 % of the range beyond the conditions of the data.\n\n\
         | noise | data sets | listed effect above 0.9 | below 0.01 | false names | verdict named, and \
         something beside | named alone | unexplained | outside, within two u |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (tally, noise) in tallies.iter().zip(["1", "0.3"]) {
        let share = |count: usize, of: usize| count as f64 / of.max(1) as f64;
        writeln!(
            page,
            "| {noise} | {} | {} ({:.2}) | {} ({:.2}) | {} of {} ({:.2}) | {} | {} | {} | {} of {} ({:.2}) |",
            tally.cases,
            tally.there,
            share(tally.there, tally.cases),
            tally.lost,
            share(tally.lost, tally.cases),
            tally.false_names,
            tally.others,
            share(tally.false_names, tally.others),
            tally.kinds[0],
            tally.kinds[1],
            tally.kinds[2],
            tally.outside[0],
            tally.outside[1],
            share(tally.outside[0], tally.outside[1]),
        )?;
    }
    writeln!(
        page,
        "\nWithout a gap an alarm in {alarms} of {free} data sets. A diagnosis took {took:.1} s.\n\n\
         | bench: what was taken out | noise | listed | present | verdict | beside it | false names | \
         worst z outside |\n|---|---|---|---|---|---|---|---|"
    )?;
    page.push_str(table);
    Ok(page)
}
