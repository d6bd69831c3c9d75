//! Corrected records for programs.

use super::{FACTOR, WaveformReport, interval_of_trials};
use crate::answer::{list, object, pretty};
use crate::csv::{number, of_records};
use crate::observe::heading;
use gumption_signal::{QuantityFound, Waveform};
use serde_json::Value;

/// The records as JSON.
pub fn json(found: &WaveformReport<'_>) -> String {
    let files = found.provenance.files.iter();
    let provenance = object([
        ("recipe_sha256", Value::from(found.provenance.model_sha256.as_str())),
        ("seed", found.settings.seed.into()),
        ("trials", found.settings.trials.into()),
        ("files", object(files.map(|(name, sha)| (name.as_str(), Value::from(sha.as_str()))))),
    ]);
    pretty(&object([
        ("gumption", Value::from(env!("CARGO_PKG_VERSION"))),
        ("title", found.title.map_or(Value::Null, Value::from)),
        ("rows", list(found.rows.iter().map(|(values, waveforms)| row(found, values, waveforms)))),
        ("warnings", crate::words::listed(found.warnings)),
        ("provenance", provenance),
    ]))
}

fn row(found: &WaveformReport<'_>, values: &[f64], waveforms: &[Waveform]) -> Value {
    let conditions = found.conditions.iter().zip(values);
    let conditions = conditions.map(|(of, value)| (of.name.as_str(), Value::from(*value)));
    let waveforms = found.channels.iter().zip(waveforms);
    let waveforms = waveforms
        .map(|(channel, of)| (channel.name.as_str(), waveform(found, channel.channel, of)));
    object([("conditions", object(conditions)), ("waveforms", object(waveforms))])
}

fn waveform(found: &WaveformReport<'_>, channel: usize, of: &Waveform) -> Value {
    let sources = of.sources.iter().map(|(source, u)| {
        object([("source", Value::from(source.name())), ("root_mean_square", (*u).into())])
    });
    let u = &of.standard_uncertainties;
    let quantities = of.quantities.iter();
    let quantities = quantities.map(|quantity| {
        (quantity.name.as_str(), figure(quantity, &found.unit_of(channel, quantity)))
    });
    let trials = of.trials.as_ref().map_or(Value::Null, |trials| {
        object([
            ("trials", Value::from(trials.count)),
            ("standard_uncertainties", list(trials.standard_uncertainties.iter().copied())),
            ("simultaneous_factor", trials.simultaneous_factor.into()),
        ])
    });
    let edge = |sign: f64| {
        let edges = of.signal.values.iter().zip(u);
        list(edges.map(move |(x, u)| x + sign * FACTOR * u))
    };
    object([
        ("unit", Value::from(found.unit(channel))),
        ("sampling_rate", object([("unit", Value::from("Hz")), ("value", of.signal.rate.into())])),
        ("start", object([("unit", Value::from("s")), ("value", of.signal.start.into())])),
        ("samples", of.signal.values.len().into()),
        (
            "cutoff",
            of.cutoff.map_or(Value::Null, |hertz| {
                object([("unit", Value::from("Hz")), ("value", hertz.into())])
            }),
        ),
        ("sources", list(sources)),
        ("quantities", object(quantities)),
        ("values", list(of.signal.values.iter().copied())),
        ("standard_uncertainties", list(u.iter().copied())),
        (
            "coverage",
            object([
                ("probability", Value::from(0.95)),
                ("factor", FACTOR.into()),
                ("low", edge(-1.0)),
                ("high", edge(1.0)),
            ]),
        ),
        ("monte_carlo", trials),
    ])
}

fn figure(of: &QuantityFound, unit: &str) -> Value {
    let u = of.standard_uncertainty();
    let budget = of.contributions.iter().map(|(source, contribution)| {
        let share = if u > 0.0 { contribution * contribution / (u * u) } else { 0.0 };
        object([
            ("source", Value::from(source.name())),
            ("contribution", (*contribution).into()),
            ("share", share.into()),
        ])
    });
    let trials = of.of_trials().map_or(Value::Null, |[mean, u]| {
        let interval = interval_of_trials(of).map_or(Value::Null, |[low, high]| list([low, high]));
        object([
            ("trials", Value::from(of.trials.len())),
            ("estimate", mean.into()),
            ("standard_uncertainty", u.into()),
            ("interval", interval),
        ])
    });
    object([
        ("quantity", Value::from(of.quantity.name())),
        ("unit", unit.into()),
        ("value", of.value.into()),
        ("standard_uncertainty", u.into()),
        ("budget", list(budget)),
        ("monte_carlo", trials),
    ])
}

/// One line for each sample of each row: the conditions, the instant, and for each channel its value, its standard
/// uncertainty and the band of 95 %. A channel with other instants than the first one has its own column of these.
pub fn csv(found: &WaveformReport<'_>) -> String {
    let mut header: Vec<String> =
        found.conditions.iter().map(|of| heading(&of.name, of.unit.text())).collect();
    // in every row the same channels share their instants
    let owns_time: Vec<bool> = (0..found.channels.len())
        .map(|at| {
            let differs = |waveforms: &Vec<Waveform>| match (waveforms.first(), waveforms.get(at)) {
                (Some(first), Some(own)) => {
                    let [a, b] = [&first.signal, &own.signal];
                    a.rate != b.rate || a.start != b.start || a.values.len() != b.values.len()
                }
                _ => false,
            };
            at == 0 || found.rows.iter().any(|(_, waveforms)| differs(waveforms))
        })
        .collect();
    for (at, channel) in found.channels.iter().enumerate() {
        let (name, unit) = (&channel.name, found.unit(channel.channel));
        if owns_time[at] {
            header.push(if at == 0 { "t [s]".to_owned() } else { format!("t_{name} [s]") });
        }
        let names = ["", "u_", "low_", "high_"].map(|prefix| format!("{prefix}{name}"));
        header.extend(names.map(|name| heading(&name, unit)));
    }
    of_records(|writer| {
        writer.write_record(&header)?;
        for (conditions, waveforms) in found.rows {
            let longest = waveforms.iter().map(|of| of.signal.values.len()).max().unwrap_or(0);
            for sample in 0..longest {
                let mut record: Vec<String> =
                    conditions.iter().map(|value| number(Some(*value))).collect();
                for (of, owns_time) in waveforms.iter().zip(&owns_time) {
                    let value = of.signal.values.get(sample).copied();
                    let u = of.standard_uncertainties.get(sample).copied();
                    if *owns_time {
                        let instant = value.map(|_| of.signal.instant(sample as f64));
                        record.push(number(instant));
                    }
                    let edge = |sign: f64| Some(value? + sign * FACTOR * u?);
                    record.extend([value, u, edge(-1.0), edge(1.0)].map(number));
                }
                writer.write_record(&record)?;
            }
        }
        Ok(())
    })
}
