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
//! compared. SETS is the number of undecided data sets of each bench (3 unless told).
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::print_stdout)] // rows as they come
#![allow(clippy::needless_range_loop)] // several sums go side by side

use std::error::Error;
use std::fmt::Write as _;

use gumption::file::FileReader;
use gumption::gap::check::{CheckedNoise, TruthKind, truth};
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
) -> Result<(TruthKind, Case), Box<dyn Error>> {
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
    Ok((truth.kind, case))
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

/// Entropies after so many added rows.
type Entropies = [f64; ADDED.len()];

fn main() -> Result<(), Box<dyn Error>> {
    let sets: usize = std::env::args().nth(1).map_or(Ok(3), |text| text.parse())?;
    let mut report = String::from(
        "# What the next measurement is worth\n\n\
         Entropy of the probabilities of all hypotheses in nats (mean over the undecided data sets of \
         a bench) once rows have been added, where the first proposal of the diagnosis says (asked \
         again after each of these numbers of rows) and spread evenly over the same range (a Halton \
         sequence). Written by `cargo run --release --example gap_next`.\n\n",
    );
    let _ = writeln!(
        report,
        "| bench | sets | rows | before |{} rows that halve it |",
        ADDED.map(|n| format!(" {n} more |")).concat()
    );
    let _ = writeln!(report, "|---|---|---|---|{}---|", "---|".repeat(ADDED.len()));
    let mut totals = (0, 0.0, [0.0; ADDED.len()], [0.0; ADDED.len()]);
    for bench in &BENCHES {
        let case = case(bench)?;
        let (mut count, mut before) = (0, 0.0);
        let mut sums: [Entropies; 2] = [[0.0; ADDED.len()]; 2];
        for number in 0.. {
            if count == sets || number > 100 * sets as u64 {
                break;
            }
            let (kind, plain) = measured(bench, &case, &[], number)?;
            if kind == TruthKind::Withheld {
                continue;
            }
            let first = diagnosed(&plain)?;
            if first.next.entropy < UNDECIDED {
                continue;
            }
            count += 1;
            before += first.next.entropy;
            let mut rows: Vec<Vec<f64>> = Vec::new();
            let mut at = first.clone();
            let mut line = format!("{} {number}: {:.2};", bench.name, first.next.entropy);
            for (place, added) in ADDED.into_iter().enumerate() {
                let conditions = proposed(&at).unwrap_or_else(|| even(bench, rows.len()));
                rows.resize(added, conditions);
                at = diagnosed(&measured(bench, &case, &rows, number)?.1)?;
                sums[0][place] += at.next.entropy;
                let spread: Vec<Vec<f64>> = (0..added).map(|n| even(bench, n)).collect();
                let spread = diagnosed(&measured(bench, &case, &spread, number)?.1)?;
                sums[1][place] += spread.next.entropy;
                let _ = write!(line, " {:.2}/{:.2}", at.next.entropy, spread.next.entropy);
            }
            println!("{line} {:?}", rows.first());
        }
        write_rows(&mut report, bench.name, count, before, sums);
        totals.0 += count;
        totals.1 += before;
        for place in 0..ADDED.len() {
            totals.2[place] += sums[0][place];
            totals.3[place] += sums[1][place];
        }
    }
    write_rows(&mut report, "all", totals.0, totals.1, [totals.2, totals.3]);
    println!("{report}");
    std::fs::write("reports/gap-next.md", report)?;
    Ok(())
}

/// Two lines of the table, from sums over data sets.
fn write_rows(report: &mut String, name: &str, count: usize, before: f64, sums: [Entropies; 2]) {
    let n = count.max(1) as f64;
    for (words, sums) in ["proposed", "spread evenly"].into_iter().zip(sums) {
        let means = sums.map(|sum| sum / n);
        let halved = ADDED.iter().zip(means).find(|(_, mean)| *mean <= 0.5 * before / n);
        let halved =
            halved.map_or_else(|| format!("more than {}", ADDED[6]), |(n, _)| n.to_string());
        let _ = writeln!(
            report,
            "| {name} | {count} | {words} | {:.2} |{} {halved} |",
            before / n,
            means.map(|mean| format!(" {mean:.2} |")).concat()
        );
    }
}
