//! The examples at the end of the help on a command. Tests run them with the files of the
//! repository.

use super::heading::heading;

/// An example.
pub(super) struct Example {
    /// What it does, as a heading.
    purpose: &'static str,
    /// Its commands, one a line.
    pub(super) lines: &'static [&'static str],
}

const fn example(purpose: &'static str, lines: &'static [&'static str]) -> Example {
    Example { purpose, lines }
}

/// The examples of each command.
pub(super) const EXAMPLES: [(&str, [Example; 2]); 22] = [
    (
        "run",
        [
            example(
                "Print the result and its budget",
                &["gumption run models/examples/power.json"],
            ),
            example(
                "Replace an estimate, and write a page with figures",
                &["gumption run models/examples/power.json --set voltage=5.1 --format html \
                       --output power.html"],
            ),
        ],
    ),
    (
        "merge",
        [
            example(
                "Make a run in two parts, on one machine or two, and merge them",
                &[
                    "mkdir parts",
                    "gumption run models/inclined_plane.json --blocks 1/2 --partial parts/1.bin",
                    "gumption run models/inclined_plane.json --blocks 2/2 --partial parts/2.bin",
                    "gumption merge parts",
                ],
            ),
            example(
                "Write the merged answer for programs",
                &["gumption merge parts --format json --output answer.json"],
            ),
        ],
    ),
    (
        "assumptions",
        [
            example(
                "Show which shapes and widths matter",
                &["gumption assumptions models/examples/power.json"],
            ),
            example(
                "Allow U to change by 10 %",
                &["gumption assumptions models/examples/power.json --allow 0.1"],
            ),
        ],
    ),
    (
        "certificate",
        [
            example(
                "Print the table of results and the statements below it",
                &["gumption certificate models/certificates/pressure_gauge.json"],
            ),
            example(
                "Write the certificate with its letterhead, for A4",
                &["gumption certificate models/certificates/weights.json --format html \
                       --output weights.html"],
            ),
        ],
    ),
    (
        "check",
        [
            example("Check a model file", &["gumption check models/examples/power.json"]),
            example(
                "Check a certificate file, with the answer for programs",
                &["gumption check models/certificates/weights.json --format json"],
            ),
        ],
    ),
    (
        "compare",
        [
            example(
                "Print normalized errors, and how far rounding can change them",
                &["gumption compare models/examples/results.csv --rounding"],
            ),
            example(
                "Score a proficiency test",
                &["gumption compare models/examples/proficiency.csv --scheme iso13528"],
            ),
        ],
    ),
    (
        "dcc",
        [
            example(
                "List the quantities of a certificate",
                &["gumption dcc reports/certificate.dcc.xml"],
            ),
            example(
                "Write the list for programs",
                &[
                    "gumption dcc reports/certificate.dcc.xml --format json --output quantities.json",
                ],
            ),
        ],
    ),
    (
        "import",
        [
            example(
                "Write an empty workbook to fill in",
                &["gumption import --template budget.xlsx"],
            ),
            example(
                "Write a workbook, change inputs in it, and convert it into a model file",
                &[
                    "gumption run models/examples/power.json --format xlsx --output power.xlsx",
                    "gumption import power.xlsx --output changed.json",
                ],
            ),
        ],
    ),
    (
        "readings",
        [
            example(
                "Print the heading of the readings of a model file",
                &["gumption readings --template models/laboratory/weight.json"],
            ),
            example(
                "Write it to a file, with three empty lines",
                &["gumption readings --template models/laboratory/weight.json --lines 3 \
                       --output today.csv"],
            ),
        ],
    ),
    (
        "new",
        [
            example(
                "Write a model file to fill in",
                &["gumption new --equation \"power = voltage^2/resistance\" --unit power=mW \
                       --output blank.json"],
            ),
            example(
                "State the inputs too",
                &["gumption new --equation P=U*I --unit P=W --input \"U=5.0112(23) V\" \
                       --input \"I=2.00(1) A\""],
            ),
        ],
    ),
    (
        "models",
        [
            example("List the built-in models", &["gumption models"]),
            example(
                "Write a model file of one",
                &["gumption models inclined-plane --template --output plane.json"],
            ),
        ],
    ),
    (
        "verify",
        [
            example(
                "Write a page with published and recomputed values",
                &["gumption verify --format markdown --output verified.md"],
            ),
            example(
                "Compare the code paths of this machine",
                &["gumption verify --paths --trials 100000"],
            ),
        ],
    ),
    (
        "diff",
        [
            example(
                "Compare two model files",
                &["gumption diff models/examples/last_year.json models/examples/this_year.json"],
            ),
            example(
                "Compare a saved result with the model file of today",
                &[
                    "gumption run models/examples/last_year.json --save last_year.result",
                    "gumption diff last_year.result models/examples/this_year.json",
                ],
            ),
        ],
    ),
    (
        "plan",
        [
            example(
                "Find the cheapest way to an expanded uncertainty of 8 uV",
                &["gumption plan models/plan/source.json --target \"U(source) <= 8 uV\""],
            ),
            example(
                "Take the costs of improvements from a file",
                &["gumption plan models/plan/source.json --target \"U(source) <= 8 uV\" \
                       --cost models/plan/costs.json"],
            ),
        ],
    ),
    (
        "gap",
        [
            example("Diagnose a case", &["gumption gap models/gap/radius/case.json"]),
            example(
                "Write a page with figures",
                &["gumption gap models/gap/radius/case.json --format html --output gap.html"],
            ),
        ],
    ),
    (
        "gap-check",
        [
            example(
                "Diagnose simulated data of 10 random truths",
                &["gumption gap-check models/gap/radius/case.json --draws 10"],
            ),
            example(
                "Do half of them, for another machine to do the rest",
                &["gumption gap-check models/gap/radius/case.json --draws 10 --share 1/2 \
                       --partial draws.bin"],
            ),
        ],
    ),
    (
        "observe",
        [
            example(
                "Print amplitudes, phases and delays",
                &["gumption observe models/recordings/rotating_table/recipe.json"],
            ),
            example(
                "Write them as a table, for a case of `gumption gap`",
                &["gumption observe models/recordings/iepe_chain/recipe.json --format csv \
                       --output data.csv"],
            ),
        ],
    ),
    (
        "open",
        [
            example(
                "Edit a model file in the browser",
                &["gumption open models/examples/power.json"],
            ),
            example(
                "Start the server on a given port, without a browser",
                &["gumption open models/examples --port 8017 --no-browser"],
            ),
        ],
    ),
    (
        "schema",
        [
            example("Print the schema", &["gumption schema"]),
            example(
                "Write it to a file, which `\"$schema\"` of a model file names",
                &["gumption schema --output gumption.schema.json"],
            ),
        ],
    ),
    (
        "help",
        [
            example("List the keys of a model file", &["gumption help model"]),
            example("Describe a command", &["gumption help run"]),
        ],
    ),
    (
        "completions",
        [
            example(
                "Write the script for bash, which `source gumption.bash` loads",
                &["gumption completions bash > gumption.bash"],
            ),
            example("Print the script for fish", &["gumption completions fish"]),
        ],
    ),
    (
        "man",
        [
            example("Write the man pages to a new folder", &["mkdir man1", "gumption man man1"]),
            example(
                "Show the page of a command",
                &["gumption man man1", "man -l man1/gumption-run.1"],
            ),
        ],
    ),
];

/// The command with its examples at the end of its help.
pub(super) fn added_to(command: clap::Command) -> clap::Command {
    let Some((_, examples)) = EXAMPLES.iter().find(|(name, _)| *name == command.get_name()) else {
        return command;
    };
    let mut text = heading("Examples (with files of the source repository)");
    for Example { purpose, lines } in examples {
        text += &format!("  {purpose}:\n");
        lines.iter().for_each(|line| text += &format!("    {line}\n"));
    }
    command.after_help(text.trim_end().to_owned())
}
