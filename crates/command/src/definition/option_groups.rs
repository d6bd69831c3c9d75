//! The options of the commands in groups, for the help on a command.

/// Options of commands under a heading, in the order of the help.
pub(super) struct OptionGroup {
    pub(super) heading: &'static str,
    /// The only command of the group, or `None` for all commands.
    pub(super) command: Option<&'static str>,
    /// The long names.
    pub(super) options: &'static [&'static str],
}

/// The last heading, which the options of the whole program have too.
pub(crate) const REST: &str = "More";

const fn common(heading: &'static str, options: &'static [&'static str]) -> OptionGroup {
    OptionGroup { heading, command: None, options }
}

const fn own(
    command: &'static str,
    heading: &'static str,
    options: &'static [&'static str],
) -> OptionGroup {
    OptionGroup { heading, command: Some(command), options }
}

/// The groups in the order of the help. A group of a command precedes one of all commands if both
/// have the option.
#[rustfmt::skip]
pub(super) const GROUPS: [OptionGroup; 18] = [
    own("new", "Content of the file", &["title", "equation", "input", "unit"]),
    own("plan", "Target and costs", &["target", "cost", "drift", "drift-law"]),
    own("models", "What to print", &["template", "effects", "examples"]),
    own("open", "Page of this machine", &["port", "no-browser", "lang"]),
    own("open", "Page without a server", &["static", "wasm"]),
    own("verify", "Code paths", &["paths", "model", "trials"]),
    own("import", "Meaning of the sheet", &[
        "sheet", "column", "column-unit", "row", "unit", "estimate", "k", "distribution",
        "coefficients", "equation", "numbers", "keep-columns",
    ]),
    common("Input", &[
        "set", "readings", "each", "template", "lines", "sheet", "against", "correlations", "model",
        "predict",
    ]),
    common("Output", &[
        "format", "output", "output-folder", "brief", "full", "columns", "histogram",
        "shown-digits", "interactive", "save", "samples", "dcc-version", "stylesheet", "rounding",
    ]),
    own("assumptions", "Limit", &["allow"]),
    own("compare", "Laboratories and proficiency tests", &[
        "estimator", "scheme", "assigned", "assigned-u", "sigma", "interaction", "lower",
        "upper",
    ]),
    own("gap-check", "Simulated data", &["draws", "noise", "keep"]),
    common("Monte Carlo", &[
        "trials", "validate", "max-trials", "rule", "digits", "method", "seed", "threads", "memory",
    ]),
    common("Statement of the result", &["k", "coverage", "statement", "dof"]),
    own("gap", "Program as the model", &[
        "simulator", "simulator-lines", "runs", "run-timeout", "keep", "made", "design",
    ]),
    common("Work in parts", &["resume", "blocks", "partial", "pass", "share", "parts"]),
    common("Files and trust", &["allow-path", "accept-changed"]),
    common(REST, &["fail", "quiet"]),
];

/// The index of the group with the option of a command, and the index within the group.
pub(super) fn place_of(command: &str, option: &str) -> Option<(usize, usize)> {
    let place_in = |of: Option<&str>| {
        let mut groups = GROUPS.iter().enumerate().filter(|(_, group)| group.command == of);
        groups.find_map(|(index, group)| {
            let at = group.options.iter().position(|name| *name == option)?;
            Some((index, at))
        })
    };
    place_in(Some(command)).or_else(|| place_in(None))
}

/// The command with its options in groups. An option of no group stays under `Options`.
pub(super) fn arranged(command: clap::Command) -> clap::Command {
    let name = command.get_name().to_owned();
    let mut places: Vec<((usize, usize), String)> = command
        .get_arguments()
        .filter_map(|option| {
            Some((place_of(&name, option.get_long()?)?, option.get_id().to_string()))
        })
        .collect();
    places.sort();
    // clap prints headings in the order of the options, and a changed option becomes the last one
    places.into_iter().enumerate().fold(command, |command, (order, ((group, _), id))| {
        let heading = GROUPS.get(group).map(|group| group.heading);
        command.mut_arg(id, |option| option.help_heading(heading).display_order(order))
    })
}
