//! What the advice on the next measurement is worth: writes `reports/gap-next.md`.
//!
//! ```text
//! cargo run --release --example gap_next -- [SETS]
//! ```
//!
//! Four benches that no test has are simulated over a part of what their conditions can reach, with
//! effects drawn from their lists. Where the diagnosis leaves the effect open, rows are added, once as
//! the first proposal of the diagnosis says and once spread evenly over the whole reachable range (a
//! Halton sequence), with the same truth and the same noise, and the entropy of the answers is
//! compared, and the logarithm of the probability of what is true. SETS is the number of undecided data sets of each bench (3 unless told).
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::print_stdout)] // rows as they come
#![allow(clippy::needless_range_loop)] // several sums go side by side

use std::error::Error;
use std::fmt::Write as _;

use gumption::file::FileReader;
use gumption::gap::check::{CheckedNoise, Truth, truth};
use gumption::gap::{Case, Diagnosis, DiagnosisOptions, diagnose};
use gumption::task::Row;
use serde_json::{Value, json};

/// A bench: its case without the data, the rows of its design, the standard uncertainty of a row.
struct Bench {
    name: &'static str,
    case: fn() -> Value,
    conditions: &'static [&'static str],
    design: fn() -> Vec<Vec<f64>>,
    reachable: &'static [[f64; 2]],
    u: f64,
}

/// An input or parameter.
fn normal(mean: f64, std: f64) -> Value {
    json!({"unit": "1", "distribution": "normal", "mean": mean, "std": std})
}

fn log_uniform(lower: f64, upper: f64) -> Value {
    json!({"unit": "1", "distribution": "log-uniform", "lower": lower, "upper": upper})
}

fn effect(parameters: Value, formula: &str) -> Value {
    json!({"parameters": parameters, "overrides": {"y": formula}})
}

const BENCHES: [Bench; 4] = [
    Bench {
        name: "balance",
        case: || {
            json!({
                "inputs": {"k": normal(2.0, 0.004)},
                "conditions": {"F": {"unit": "1", "range": [0, 300]}},
                "equations": {"y": "k*F"},
                "effects": {
                    "zero": effect(json!({"z": normal(0.0, 0.3)}), "y + z"),
                    "gain": effect(json!({"g": normal(0.0, 0.01)}), "y*(1 + g)"),
                    "bending": effect(json!({"b": normal(0.0, 1e-4)}), "y + b*F^2"),
                    "friction": effect(json!({"r": normal(0.0, 0.05)}), "y + r*sqrt(F)"),
                    "saturation": effect(json!({"s": log_uniform(1e-5, 1e-2)}), "y/(1 + s*F/10)"),
                },
            })
        },
        conditions: &["F"],
        design: || (0..10).map(|n| vec![20.0 + 10.0 * f64::from(n % 5)]).collect(),
        reachable: &[[0.0, 300.0]],
        u: 0.15,
    },
    Bench {
        name: "amplifier",
        case: || {
            json!({
                "inputs": {"A": normal(1.0, 0.002)},
                "conditions": {"f": {"unit": "1", "range": [1, 5000]}},
                "equations": {"y": "A + 0*f"},
                "effects": {
                    "low-pass": effect(json!({"fc": log_uniform(300.0, 2e4)}), "y/sqrt(1 + (f/fc)^2)"),
                    "coupling": effect(json!({"fh": log_uniform(0.1, 20.0)}), "y/sqrt(1 + (fh/f)^2)"),
                    "scale": effect(json!({"g": normal(0.0, 0.01)}), "y*(1 + g)"),
                    "log-slope": effect(json!({"s": normal(0.0, 0.005)}), "y*(1 + s*ln(f/100))"),
                    "leakage": effect(json!({"l": normal(0.0, 0.005)}), "y*(1 - l*sqrt(f/100))"),
                },
            })
        },
        conditions: &["f"],
        design: || (0..12).map(|n| vec![30.0 * 10f64.powf(f64::from(n % 6) / 5.0)]).collect(),
        reachable: &[[1.0, 5000.0]],
        u: 0.004,
    },
    Bench {
        name: "thermometer",
        case: || {
            json!({
                "inputs": {"S": normal(4.0, 0.004)},
                "conditions": {
                    "t": {"unit": "1", "range": [0, 400]},
                    "d": {"unit": "1", "range": [0, 40]},
                },
                "equations": {"y": "S*t + 0*d"},
                "effects": {
                    "reference": effect(json!({"z": normal(0.0, 2.0)}), "y + z"),
                    "gain": effect(json!({"g": normal(0.0, 0.01)}), "y*(1 + g)"),
                    "drift": effect(json!({"k": normal(0.0, 0.4)}), "y + k*d"),
                    "gain-drift": effect(json!({"m": normal(0.0, 0.001)}), "y*(1 + m*d)"),
                    "curvature": effect(json!({"c": normal(0.0, 2e-4)}), "y + c*t^2"),
                },
            })
        },
        conditions: &["t", "d"],
        design: || {
            let row = |n: i32| vec![100.0 + 20.0 * f64::from(n % 4), f64::from(1 + n / 4)];
            (0..12).map(row).collect()
        },
        reachable: &[[0.0, 400.0], [0.0, 40.0]],
        u: 1.0,
    },
    Bench {
        name: "flow meter",
        case: || {
            json!({
                "inputs": {"K": normal(5.0, 0.003)},
                "conditions": {"q": {"unit": "1", "range": [0.2, 60]}},
                "equations": {"y": "K + 0*q"},
                "effects": {
                    "k-factor": effect(json!({"g": normal(0.0, 0.01)}), "y*(1 + g)"),
                    "bearing": effect(json!({"b": normal(0.0, 0.03)}), "y - b/q"),
                    "viscosity": effect(json!({"v": normal(0.0, 0.01)}), "y*(1 + v*ln(q/5))"),
                    "bump": effect(
                        json!({"h": normal(0.0, 0.1), "c": log_uniform(1.0, 30.0)}),
                        "y + h*exp(-(2*ln(q/c))^2)",
                    ),
                    "cavitation": effect(json!({"a": normal(0.0, 1e-4)}), "y - a*q^2"),
                },
            })
        },
        conditions: &["q"],
        design: || (0..12).map(|n| vec![4.0 + 2.0 * f64::from(n % 6)]).collect(),
        reachable: &[[0.2, 60.0]],
        u: 0.02,
    },
];

/// Numbers of added rows after which the answers are compared.
const ADDED: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];

/// A data set is undecided with at least this entropy, in nats.
const UNDECIDED: f64 = 0.4;

/// The case with placeholders in place of measured values.
fn case(bench: &Bench) -> Result<Case, Box<dyn Error>> {
    let folder = std::env::temp_dir().join(format!("gumption-gap-next-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let mut table = bench.conditions.join(",") + ",y,u_y\n";
    for row in (bench.design)() {
        let cells: Vec<String> = row.iter().chain(&[1.0, bench.u]).map(f64::to_string).collect();
        let _ = writeln!(table, "{}", cells.join(","));
    }
    std::fs::write(folder.join("data.csv"), table)?;
    let mut case = (bench.case)();
    case["outputs"] = json!({"y": {"unit": "1"}});
    let columns = json!({"y": {"value": "y", "standard_uncertainty": "u_y"}});
    case["observations"] = json!({"file": "data.csv", "columns": columns});
    std::fs::write(folder.join("case.json"), case.to_string())?;
    let read = FileReader::default().case(&folder.join("case.json"))?.case;
    std::fs::remove_dir_all(&folder)?;
    Ok(read)
}

/// The case with rows at more conditions, measured with the truth of this number.
fn measured(
    bench: &Bench,
    case: &Case,
    more: &[Vec<f64>],
    number: u64,
) -> Result<(Truth, Case), Box<dyn Error>> {
    let mut case = case.clone();
    let template = case.task.rows[0].clone();
    case.task
        .rows
        .extend(more.iter().map(|row| Row { conditions: row.clone(), ..template.clone() }));
    let rows = case.task.rows.len();
    let of = case.observed[0].as_mut().ok_or("an observed output")?;
    of.values.resize(rows, 1.0);
    of.standard_uncertainties = Some(vec![bench.u; rows]);
    let (truth, values) = truth(&case, &[vec![bench.u; rows]], CheckedNoise::AsStated, 1, number)?;
    let of = case.observed[0].as_mut().ok_or("an observed output")?;
    of.values.clone_from(&values[0]);
    Ok((truth, case))
}

fn diagnosed(case: &Case) -> Result<Diagnosis, Box<dyn Error>> {
    Ok(diagnose(case, None, DiagnosisOptions::new(1), &|_| {})?)
}

/// The conditions of this number that are spread evenly over the reachable range.
fn even(bench: &Bench, number: usize) -> Vec<f64> {
    let halton = |base: usize| {
        let (mut left, mut share, mut part) = (number + 1, 0.0, 1.0 / base as f64);
        while left > 0 {
            share += (left % base) as f64 * part;
            left /= base;
            part /= base as f64;
        }
        share
    };
    let of = |(&[low, high], base): (&[f64; 2], usize)| {
        let by_ratios = low > 0.0 && high / low > 20.0;
        let share = halton(base);
        if by_ratios { low * (high / low).powf(share) } else { low + (high - low) * share }
    };
    bench.reachable.iter().zip([2, 3]).map(of).collect()
}

/// Conditions of the first proposal that is of rows.
fn proposed(diagnosis: &Diagnosis) -> Option<Vec<f64>> {
    diagnosis.next.proposals.iter().find_map(|p| p.kind.conditions().map(<[f64]>::to_vec))
}

/// The probability that a diagnosis gives exactly the effects that are true, no less than one in a million,
/// as a logarithm.
fn ln_of_truth(found: &Diagnosis, truth: &Truth) -> f64 {
    let is_it = |names: &[String]| {
        names.len() == truth.effects.len() && names.iter().all(|of| truth.effects.contains(of))
    };
    let own = found.hypotheses.iter().filter(|of| of.effects.as_deref().is_some_and(is_it));
    own.map(|of| of.probability).sum::<f64>().max(1e-6).ln()
}

/// Means after so many added rows.
type AfterRows = [f64; ADDED.len()];

/// Sums over data sets: before, and after rows as proposed and spread evenly.
#[derive(Clone, Copy, Default)]
struct Sums {
    before: f64,
    after: [AfterRows; 2],
}

impl Sums {
    fn add(&mut self, other: &Self) {
        self.before += other.before;
        for (own, others) in self.after.iter_mut().flatten().zip(other.after.iter().flatten()) {
            *own += others;
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let sets: usize = std::env::args().nth(1).map_or(Ok(3), |text| text.parse())?;
    let heads = format!(
        "| bench | sets | rows | before |{}",
        ADDED.map(|n| format!(" {n} more |")).concat()
    );
    let rule = "---|".repeat(ADDED.len());
    let mut entropies = format!("{heads} rows that halve it |\n|---|---|---|---|{rule}---|\n");
    let mut truths = format!("{heads}\n|---|---|---|---|{rule}\n");
    let (mut all_sets, mut of_all) = (0, [Sums::default(); 2]);
    for bench in &BENCHES {
        let case = case(bench)?;
        let mut count = 0;
        let mut of_bench = [Sums::default(); 2];
        for number in 0.. {
            if count == sets || number > 100 * sets as u64 {
                break;
            }
            let (truth, plain) = measured(bench, &case, &[], number)?;
            if truth.withheld().is_some() {
                continue;
            }
            let first = diagnosed(&plain)?;
            if first.next.entropy < UNDECIDED {
                continue;
            }
            count += 1;
            let [entropy, of_truth] = &mut of_bench;
            entropy.before += first.next.entropy;
            of_truth.before += ln_of_truth(&first, &truth);
            let mut rows: Vec<Vec<f64>> = Vec::new();
            let mut at = first.clone();
            let mut line = format!("{} {number}: {:.2};", bench.name, first.next.entropy);
            for (place, added) in ADDED.into_iter().enumerate() {
                let conditions = proposed(&at).unwrap_or_else(|| even(bench, rows.len()));
                rows.resize(added, conditions);
                at = diagnosed(&measured(bench, &case, &rows, number)?.1)?;
                let spread: Vec<Vec<f64>> = (0..added).map(|n| even(bench, n)).collect();
                let spread = diagnosed(&measured(bench, &case, &spread, number)?.1)?;
                for (way, found) in [&at, &spread].into_iter().enumerate() {
                    entropy.after[way][place] += found.next.entropy;
                    of_truth.after[way][place] += ln_of_truth(found, &truth);
                }
                let _ = write!(line, " {:.2}/{:.2}", at.next.entropy, spread.next.entropy);
            }
            println!("{line} {:?}", rows.first());
        }
        write_rows(&mut entropies, bench.name, count, &of_bench[0], true);
        write_rows(&mut truths, bench.name, count, &of_bench[1], false);
        all_sets += count;
        of_all.iter_mut().zip(&of_bench).for_each(|(all, own)| all.add(own));
    }
    write_rows(&mut entropies, "all", all_sets, &of_all[0], true);
    write_rows(&mut truths, "all", all_sets, &of_all[1], false);
    let report = format!(
        "# What the next measurement is worth\n\n\
         Rows are added where the first proposal of the diagnosis says (asked again after each of these \
         numbers of rows), and spread evenly over the same range (a Halton sequence). Written by \
         `cargo run --release --example gap_next`.\n\n\
         Entropy of the probabilities of all hypotheses in nats, mean over the undecided data sets of a \
         bench:\n\n{entropies}\n\
         Logarithm of the probability of exactly the effects that are true, no less than that of 1e-6, mean \
         over the same data sets:\n\n{truths}"
    );
    println!("{report}");
    std::fs::write("reports/gap-next.md", report)?;
    Ok(())
}

/// Two lines of a table, from sums over data sets; those of entropies with the number of rows that halve
/// them.
fn write_rows(report: &mut String, name: &str, count: usize, sums: &Sums, halves: bool) {
    let n = count.max(1) as f64;
    let before = sums.before / n;
    for (words, sums) in ["proposed", "spread evenly"].into_iter().zip(sums.after) {
        let means = sums.map(|sum| sum / n);
        let cells = means.map(|mean| format!(" {mean:.2} |")).concat();
        let _ = write!(report, "| {name} | {count} | {words} | {before:.2} |{cells}");
        if halves {
            let halved = ADDED.iter().zip(means).find(|(_, mean)| *mean <= 0.5 * before);
            let halved =
                halved.map_or_else(|| format!("more than {}", ADDED[6]), |(n, _)| n.to_string());
            let _ = write!(report, " {halved} |");
        }
        report.push('\n');
    }
}
