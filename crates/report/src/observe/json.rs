//! The whole answer for programs.

use super::ObservationReport;
use crate::answer::{list, object, pretty};
use crate::words::{Language, note};
use gumption_signal::{ChannelObservation, Measured, ToneComponent};
use serde_json::Value;

/// The observations as JSON.
pub fn json(observed: &ObservationReport<'_>) -> String {
    let settings = observed.settings;
    let root = settings.reference.and_then(|place| settings.channels.get(place));
    let columns = observed.figures().into_iter().map(|figure| {
        let (values, uncertainties): (Vec<f64>, Vec<Option<f64>>) =
            figure.values.into_iter().unzip();
        let column = object([
            ("unit", Value::from(figure.unit.as_str())),
            ("values", list(values)),
            ("standard_uncertainties", list(uncertainties)),
        ]);
        (figure.name, column)
    });
    let warnings = observed.warnings.iter().map(|warning| {
        object([
            ("code", Value::from(warning.code())),
            ("where", warning.place.as_str().into()),
            ("text", note(warning, Language::English).into()),
        ])
    });
    let files = observed.provenance.files.iter();
    let provenance = object([
        ("recipe_sha256", Value::from(observed.provenance.model_sha256.as_str())),
        ("seed", settings.seed.into()),
        ("trials", settings.trials.into()),
        ("files", object(files.map(|(name, sha)| (name.as_str(), Value::from(sha.as_str()))))),
    ]);
    pretty(&object([
        ("gumption", Value::from(env!("CARGO_PKG_VERSION"))),
        ("title", observed.title.map_or(Value::Null, Value::from)),
        ("reference", root.map_or(Value::Null, |channel| channel.name.as_str().into())),
        ("amplitude", settings.amplitude.name().into()),
        ("phase_unit", settings.phase.name().into()),
        ("method", settings.method.name().into()),
        ("rows", list(observed.lines().map(|(values, channels)| row(observed, values, channels)))),
        ("columns", object(columns)),
        ("warnings", list(warnings)),
        ("provenance", provenance),
    ]))
}

fn row(observed: &ObservationReport<'_>, values: &[f64], channels: &[ChannelObservation]) -> Value {
    let conditions = observed.conditions.iter().zip(values);
    let conditions = conditions.map(|(of, value)| (of.name.as_str(), Value::from(*value)));
    let (hertz, u) = observed.hertz(channels);
    let frequency = (observed.frequency, Value::from(hertz));
    let channels = channels.iter().filter_map(|of| {
        let settings = observed.settings.channels.get(of.channel)?;
        Some((settings.name.as_str(), channel(observed, of)))
    });
    object([
        ("conditions", object(conditions.chain([frequency]))),
        (
            "frequency",
            object([
                ("unit", Value::from("Hz")),
                ("value", hertz.into()),
                ("standard_uncertainty", u.into()),
            ]),
        ),
        ("channels", object(channels)),
    ])
}

fn channel(observed: &ObservationReport<'_>, of: &ChannelObservation) -> Value {
    let unit = observed.settings.channels.get(of.channel).map_or("1", |c| c.unit.text());
    let phase = observed.settings.phase.name();
    let spurious = of.spurious.iter().map(|spurious| {
        object([
            ("frequency", Value::from(spurious.cycles * of.rate.value)),
            ("amplitude", spurious.amplitude.into()),
            ("fitted", spurious.fitted.into()),
        ])
    });
    let findings = of
        .findings
        .iter()
        .map(|of| (of.name.as_str(), estimate(of.value, of.uncertainty, &of.unit)));
    object([
        ("unit", Value::from(unit)),
        ("components", list(of.components.iter().map(|c| component(c, unit, phase)))),
        ("offset", value(&of.offset, unit)),
        ("thd", of.distortion.as_ref().map_or(Value::Null, |of| value(of, "1"))),
        ("snr", value(&of.signal_to_noise, "dB")),
        ("sinad", value(&of.sinad, "dB")),
        ("periods", plain(of.periods, "1")),
        ("sampling_rate", plain(of.rate, "Hz")),
        ("samples", of.samples.into()),
        (
            "residuals",
            object([
                ("standard_deviation", Value::from(of.noise)),
                ("autocorrelation", of.autocorrelation.0.into()),
                ("correlated", of.autocorrelation.1.into()),
                ("spurious", list(spurious)),
            ]),
        ),
        ("findings", object(findings)),
    ])
}

fn component(of: &ToneComponent, unit: &str, phase: &str) -> Value {
    object([
        ("multiple", Value::from(u64::from(of.multiple))),
        ("frequency", plain(of.frequency, "Hz")),
        ("amplitude", value(&of.amplitude, unit)),
        ("phase", value(&of.phase, phase)),
        ("delay", of.delay.as_ref().map_or(Value::Null, |delay| value(delay, "s"))),
    ])
}

fn plain(of: Measured, unit: &str) -> Value {
    estimate(of.value, Some((of.standard_uncertainty, of.degrees_of_freedom)), unit)
}

/// A value with its standard uncertainty and the degrees of freedom of that, `null` where none is
/// known.
fn estimate(value: f64, uncertainty: Option<(f64, f64)>, unit: &str) -> Value {
    let (u, freedom) = uncertainty.unzip();
    object([
        ("unit", Value::from(unit)),
        ("value", value.into()),
        ("standard_uncertainty", u.into()),
        ("dof", freedom.into()),
    ])
}

fn value(of: &gumption_signal::BudgetedValue, unit: &str) -> Value {
    let total: f64 = of.contributions.iter().map(|(_, u)| u * u).sum();
    let budget = of.contributions.iter().map(|(source, u)| {
        object([
            ("source", Value::from(source.name())),
            ("contribution", (*u).into()),
            ("share", (u * u / total).into()),
        ])
    });
    let trials = of.trials.map_or(Value::Null, |u| {
        object([("standard_uncertainty", Value::from(u)), ("used", of.from_trials.into())])
    });
    let measured = of.measured;
    // a ratio to no noise at all is infinite, and its standard uncertainty not zero
    let u = measured.value.is_finite().then_some(measured.standard_uncertainty);
    object([
        ("unit", Value::from(unit)),
        ("value", measured.value.into()),
        ("standard_uncertainty", u.into()),
        ("dof", measured.degrees_of_freedom.into()),
        ("budget", list(budget)),
        ("monte_carlo", trials),
    ])
}
