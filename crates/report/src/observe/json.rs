//! The whole answer for programs.

use super::Observed;
use crate::tree::Tree;
use gumption_signal::{BudgetedValue, ChannelObservation, Measured, ToneComponent};

/// The observations as JSON.
pub fn json(observed: &Observed<'_>) -> String {
    let settings = observed.settings;
    let root = settings.reference.and_then(|place| settings.channels.get(place));
    let columns = observed.figures().into_iter().map(|figure| {
        let (values, uncertainties): (Vec<f64>, Vec<f64>) = figure.values.into_iter().unzip();
        let column = Tree::object([
            ("unit", Tree::from(figure.unit.as_str())),
            ("values", Tree::list(values)),
            ("standard_uncertainties", Tree::list(uncertainties)),
        ]);
        (figure.name, column)
    });
    let warnings = observed.warnings.iter().map(|warning| {
        Tree::object([
            ("code", Tree::from(warning.code)),
            ("where", warning.place.as_str().into()),
            ("text", warning.text.as_str().into()),
        ])
    });
    let files = observed.provenance.files.iter();
    let provenance = Tree::object([
        ("recipe_sha256", Tree::from(observed.provenance.model_sha256.as_str())),
        ("seed", settings.seed.into()),
        ("trials", settings.trials.into()),
        ("files", Tree::object(files.map(|(name, sha)| (name.as_str(), Tree::from(sha.as_str()))))),
    ]);
    Tree::object([
        ("gumption", Tree::from(env!("CARGO_PKG_VERSION"))),
        ("title", observed.title.map_or(Tree::Null, Tree::from)),
        ("reference", root.map_or(Tree::Null, |channel| channel.name.as_str().into())),
        ("amplitude", settings.amplitude.name().into()),
        ("phase_unit", settings.phase.name().into()),
        ("method", settings.method.name().into()),
        (
            "rows",
            Tree::list(observed.lines().map(|(values, channels)| row(observed, values, channels))),
        ),
        ("columns", Tree::object(columns)),
        ("warnings", Tree::list(warnings)),
        ("provenance", provenance),
    ])
    .json()
}

fn row(observed: &Observed<'_>, values: &[f64], channels: &[ChannelObservation]) -> Tree {
    let conditions = observed.conditions.iter().zip(values);
    let conditions = conditions.map(|(of, value)| (of.name.as_str(), Tree::from(*value)));
    let (hertz, u) = observed.hertz(channels);
    let frequency = (observed.frequency, Tree::from(hertz));
    let channels = channels.iter().filter_map(|of| {
        let settings = observed.settings.channels.get(of.channel)?;
        Some((settings.name.as_str(), channel(observed, of)))
    });
    Tree::object([
        ("conditions", Tree::object(conditions.chain([frequency]))),
        (
            "frequency",
            Tree::object([
                ("unit", Tree::from("Hz")),
                ("value", hertz.into()),
                ("standard_uncertainty", u.into()),
            ]),
        ),
        ("channels", Tree::object(channels)),
    ])
}

fn channel(observed: &Observed<'_>, of: &ChannelObservation) -> Tree {
    let unit = observed.settings.channels.get(of.channel).map_or("1", |c| c.unit.text());
    let phase = observed.settings.phase.name();
    let spurious = of.spurious.iter().map(|spurious| {
        Tree::object([
            ("frequency", Tree::from(spurious.cycles * of.rate.value)),
            ("amplitude", spurious.amplitude.into()),
        ])
    });
    let findings = of
        .findings
        .iter()
        .map(|finding| (finding.name.as_str(), plain(finding.value, &finding.unit)));
    Tree::object([
        ("unit", Tree::from(unit)),
        ("components", Tree::list(of.components.iter().map(|c| component(c, unit, phase)))),
        ("offset", value(&of.offset, unit)),
        ("thd", of.distortion.as_ref().map_or(Tree::Null, |of| value(of, "1"))),
        ("snr", value(&of.signal_to_noise, "dB")),
        ("sinad", value(&of.sinad, "dB")),
        ("periods", plain(of.periods, "1")),
        ("sampling_rate", plain(of.rate, "Hz")),
        ("samples", of.samples.into()),
        (
            "residuals",
            Tree::object([
                ("standard_deviation", Tree::from(of.noise)),
                ("autocorrelation", of.autocorrelation.0.into()),
                ("correlated", of.autocorrelation.1.into()),
                ("spurious", Tree::list(spurious)),
            ]),
        ),
        ("findings", Tree::object(findings)),
    ])
}

fn component(of: &ToneComponent, unit: &str, phase: &str) -> Tree {
    Tree::object([
        ("multiple", Tree::from(u64::from(of.multiple))),
        ("frequency", plain(of.frequency, "Hz")),
        ("amplitude", value(&of.amplitude, unit)),
        ("phase", value(&of.phase, phase)),
        ("delay", of.delay.as_ref().map_or(Tree::Null, |delay| value(delay, "s"))),
    ])
}

fn plain(of: Measured, unit: &str) -> Tree {
    Tree::object([
        ("unit", Tree::from(unit)),
        ("value", of.value.into()),
        ("standard_uncertainty", of.standard_uncertainty.into()),
        ("dof", of.degrees_of_freedom.into()),
    ])
}

fn value(of: &BudgetedValue, unit: &str) -> Tree {
    let total: f64 = of.contributions.iter().map(|(_, u)| u * u).sum();
    let budget = of.contributions.iter().map(|(source, u)| {
        Tree::object([
            ("source", Tree::from(source.name())),
            ("contribution", (*u).into()),
            ("share", (u * u / total).into()),
        ])
    });
    let trials = of.trials.map_or(Tree::Null, |u| {
        Tree::object([("standard_uncertainty", Tree::from(u)), ("used", of.from_trials.into())])
    });
    Tree::object([
        ("unit", Tree::from(unit)),
        ("value", of.measured.value.into()),
        ("standard_uncertainty", of.measured.standard_uncertainty.into()),
        ("dof", of.measured.degrees_of_freedom.into()),
        ("budget", Tree::list(budget)),
        ("monte_carlo", trials),
    ])
}
