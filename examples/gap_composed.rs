//! How often composed effects name what is missing: writes `reports/gap-composed.md`.
//!
//! ```text
//! cargo run --release --example gap_composed -- [FREE [SEED]]
//! ```
//!
//! Eight benches with four effects each that stand in no list are simulated and diagnosed, then FREE
//! data sets without an effect (400 unless told).
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::print_stdout)] // rows as they come

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use gumption::file::FileReader;
use gumption::gap::{Case, ComposedEffect, Diagnosis, DiagnosisOptions, diagnose};
use gumption::task::Row;
use serde_json::{Map, Value, json};

mod departures;
mod generator;

use departures::{BENCHES, Bench, Simulated, Withheld, said, simulated};

/// Composed effects that are named with more than this probability on data without a gap are false
/// names.
const NAMED: f64 = 0.5;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let free: usize = arguments.next().map_or(Ok(400), |n| n.parse())?;
    let seed: u64 = arguments.next().map_or(Ok(1), |n| n.parse())?;
    let folder = tempfile::tempdir()?;
    let mut table = String::new();
    let mut tally = Tally::default();
    let started = Instant::now();
    for bench in &BENCHES {
        for (number, withheld) in bench.withheld.iter().enumerate() {
            let simulated = simulated(bench, Some(number), seed);
            let found = diagnosed(bench, &simulated, folder.path())?;
            let line = tally.add(bench, withheld, &simulated, &found);
            print!("{line}");
            table += &line;
        }
    }
    let took = started.elapsed().as_secs_f64() / 32.0;
    let (mut told, mut named) = (0, 0);
    for number in 0..free {
        let bench = &BENCHES[number % BENCHES.len()];
        let found = diagnosed(bench, &simulated(bench, None, 1000 + number as u64), folder.path())?;
        told += usize::from(!found.composed.is_empty());
        let most = found.composed.first().map_or(0.0, |of| of.probability);
        named += usize::from(most > NAMED);
        if !found.composed.is_empty() {
            println!("{} {number}: {} {most:.3}", bench.name, found.composed[0].name);
        }
    }
    let page = tally.page(&table, [free, told, named], took);
    print!("{page}");
    if seed == 1 {
        std::fs::write("reports/gap-composed.md", page)?;
    }
    Ok(())
}

fn diagnosed(
    bench: &Bench,
    simulated: &Simulated,
    folder: &Path,
) -> Result<Diagnosis, Box<dyn Error>> {
    let names: Vec<&str> = bench.conditions.iter().map(|(name, _)| *name).collect();
    let mut ahead = names.join(",") + "\n";
    for (conditions, _) in simulated.within.iter().chain(&simulated.outside) {
        let cells: Vec<String> = conditions.iter().map(f64::to_string).collect();
        ahead += &(cells.join(",") + "\n");
    }
    let (case, at) = (folder.join("case.json"), folder.join("at.csv"));
    std::fs::write(folder.join("data.csv"), table_of(bench, simulated))?;
    std::fs::write(&case, case_of(bench).to_string())?;
    std::fs::write(&at, ahead)?;
    let reader = FileReader::default();
    let read: Case = reader.case(&case)?.case;
    let rows: Vec<Row> = reader.case_at(&case, &at)?;
    Ok(diagnose(&read, Some(&rows), DiagnosisOptions::new(1), &|_| {})?)
}

#[derive(Default)]
struct Tally {
    cases: usize,
    place: usize,
    first: usize,
    third: usize,
    within: [usize; 2],
    outside: [usize; 2],
}

impl Tally {
    fn add(
        &mut self,
        bench: &Bench,
        withheld: &Withheld,
        simulated: &Simulated,
        found: &Diagnosis,
    ) -> String {
        let rights: Vec<(bool, bool)> =
            found.composed.iter().take(3).map(|of| withheld.is_named_by(of)).collect();
        let place = rights.first().is_some_and(|of| of.0);
        let first = rights.first().is_some_and(|of| of.1);
        let third = rights.iter().any(|of| of.1);
        self.cases += 1;
        self.place += usize::from(place);
        self.first += usize::from(first);
        self.third += usize::from(third);
        let predicted = found.prediction.as_deref().unwrap_or_default();
        let split = simulated.within.len();
        let all = simulated.within.iter().chain(&simulated.outside);
        let mut z: Vec<f64> = Vec::new();
        for (number, ((_, truth), predicted)) in all.zip(predicted).enumerate() {
            let tally = if number < split { &mut self.within } else { &mut self.outside };
            for (truth, (value, u)) in truth.iter().zip(&predicted.outputs) {
                tally[0] += usize::from((value - truth).abs() < 2.0 * u);
                tally[1] += 1;
                if number >= split {
                    z.push((value - truth) / u);
                }
            }
        }
        let worst = z.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
        let unexplained = found.hypotheses.iter().find(|h| h.effects.is_none());
        let p = unexplained.map_or(0.0, |h| h.probability);
        let names: Vec<String> = found
            .composed
            .iter()
            .take(3)
            .map(|of| {
                let [quantity, over, form] = said(of);
                let over = if over.is_empty() { over } else { format!(" over {over}") };
                format!("{quantity} {form}{over} {:.2}", of.probability)
            })
            .collect();
        let mark = |right: bool| if right { "yes" } else { "no" };
        format!(
            "| {}: {} | {p:.3} | {} | {} | {} | {} | {worst:.1} |\n",
            bench.name,
            withheld.name,
            names.join("; "),
            mark(place),
            mark(first),
            mark(third)
        )
    }

    fn page(&self, table: &str, [free, told, named]: [usize; 3], took: f64) -> String {
        let mut page = String::from(
            "# Composed effects: what is missing when nothing of the list explains the data\n\n\
             Written by `cargo run --release --example gap_composed`. Eight benches are simulated \
             with four effects each that stand in no list; what is composed for them is compared \
             with what was simulated. A part of the effects has no form of the composer's list: \
             there the nearest one counts, as `examples/departures` says, and so does the sim's own \
             value where the design makes it a function of the condition.\n\n",
        );
        let _ = writeln!(
            page,
            "- quantity and argument first: {} of {}\n- form first: {}; within the first three: {}\n\
             - prediction within 2 standard uncertainties of the truth: inside the data's box {} of \
             {}, 10 % to 40 % outside of it {} of {}\n- of {free} data sets without an effect, {named} \
             had a composed effect named with a probability above {NAMED}, {told} any\n- {took:.2} s \
             a case\n",
            self.place,
            self.cases,
            self.first,
            self.third,
            self.within[0],
            self.within[1],
            self.outside[0],
            self.outside[1],
        );
        page += "| bench: effect | unexplained | composed | place | form | in three | worst z outside |\n\
                 |---|---|---|---|---|---|---|\n";
        page + table
    }
}

/// The data of a bench as a table.
fn table_of(bench: &Bench, simulated: &Simulated) -> String {
    let names = bench.conditions.iter().map(|(name, _)| (*name).to_owned());
    let outputs = bench.outputs.iter();
    let columns = outputs.flat_map(|(name, ..)| [format!("{name}_m"), format!("u_{name}")]);
    let mut table = names.chain(columns).collect::<Vec<_>>().join(",") + "\n";
    for (conditions, values) in simulated.rows.iter().zip(&simulated.values) {
        let mut cells: Vec<String> = conditions.iter().map(f64::to_string).collect();
        for (value, (_, _, u)) in values.iter().zip(bench.outputs) {
            cells.extend([value.to_string(), u.to_string()]);
        }
        table += &(cells.join(",") + "\n");
    }
    table
}

/// The case file of a bench, with the effects of its list and none of the withheld ones.
fn case_of(bench: &Bench) -> Value {
    let inputs: Map<String, Value> = bench
        .inputs
        .iter()
        .map(|(name, unit, mean, std)| {
            let of = json!({"unit": unit, "distribution": "normal", "mean": mean, "std": std});
            ((*name).to_owned(), of)
        })
        .collect();
    let with_unit = |(name, unit): &(&str, &str)| ((*name).to_owned(), json!({"unit": unit}));
    let conditions: Map<String, Value> = bench.conditions.iter().map(with_unit).collect();
    let equations: Map<String, Value> =
        bench.equations.iter().map(|(name, text)| ((*name).to_owned(), json!(text))).collect();
    let outputs: Map<String, Value> = bench
        .outputs
        .iter()
        .map(|(name, unit, _)| ((*name).to_owned(), json!({"unit": unit})))
        .collect();
    let columns: Map<String, Value> = bench
        .outputs
        .iter()
        .map(|(name, ..)| {
            let of = json!({
                "value": format!("{name}_m"),
                "standard_uncertainty": format!("u_{name}"),
            });
            ((*name).to_owned(), of)
        })
        .collect();
    let effects: Map<String, Value> = bench
        .listed
        .iter()
        .map(|(name, unit, std, quantity, text)| {
            let parameter = if text.contains("p0") { "p0" } else { "p" };
            let prior = json!({"unit": unit, "distribution": "normal", "mean": 0, "std": std});
            let of = json!({"parameters": {parameter: prior}, "overrides": {*quantity: text}});
            ((*name).to_owned(), of)
        })
        .collect();
    json!({
        "title": bench.name,
        "inputs": inputs,
        "conditions": conditions,
        "equations": equations,
        "outputs": outputs,
        "observations": {"file": "data.csv", "columns": columns},
        "effects": effects,
    })
}
