use std::collections::BTreeSet;

use super::examples::{EXAMPLES, Example};
use super::{command_groups, definition, option_groups};

#[test]
fn each_command_is_in_exactly_one_group() {
    let program = definition();
    let mut of_program: Vec<&str> =
        program.get_subcommands().map(clap::Command::get_name).collect();
    let mut of_groups: Vec<&str> =
        command_groups::GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
    // `open` is a feature of the program
    of_groups.retain(|name| *name != "open" || cfg!(feature = "open"));
    of_program.sort_unstable();
    of_groups.sort_unstable();
    assert_eq!(of_groups, of_program);
    assert!(!command_groups::text(&program).contains(command_groups::OTHERS));
}

#[test]
fn each_option_is_in_a_group_and_each_group_has_options() {
    let mut used = BTreeSet::new();
    for command in definition().get_subcommands() {
        for option in command.get_arguments() {
            let Some(long) = option.get_long() else { continue };
            let name = command.get_name();
            let place = option_groups::place_of(name, long);
            assert!(place.is_some(), "`--{long}` of `{name}` is in no group");
            used.extend(place);
        }
    }
    for (index, group) in option_groups::GROUPS.iter().enumerate() {
        if group.command == Some("open") && cfg!(not(feature = "open")) {
            continue;
        }
        for (at, option) in group.options.iter().enumerate() {
            let is_used = used.contains(&(index, at));
            assert!(is_used, "no command has `--{option}` under `{}`", group.heading);
        }
    }
}

#[test]
fn common_options_of_a_run_come_first() {
    let mut program = definition();
    program.build();
    let help = program.find_subcommand_mut("run").unwrap().render_help().to_string();
    let at = |text: &str| help.find(text).unwrap_or_else(|| panic!("{text}: {help}"));
    let order = [
        "Arguments:",
        "Input:",
        "--set ",
        "--readings ",
        "Output:",
        "--format ",
        "--output ",
        "Monte Carlo:",
        "--trials ",
        "Statement of the result:",
        "--k ",
        "--coverage ",
        "Work in parts:",
        "Files and trust:",
        "--allow-path ",
        "More:",
        "--quiet ",
        "--color ",
        "--help ",
        "Examples",
    ];
    assert!(order.map(at).is_sorted(), "{help}");
    assert!(!help.contains("Options:"), "{help}");
}

/// Columns of the help, without the margin.
const WIDTH: usize = 96;

#[test]
fn each_command_has_examples_of_itself_that_fit_a_line() {
    for command in definition().get_subcommands() {
        let name = command.get_name();
        let of_command = EXAMPLES.iter().find(|(of, _)| *of == name);
        let Some((_, examples)) = of_command else { panic!("`{name}` has no examples") };
        for Example { lines, .. } in examples {
            let is_own = |line: &&str| line.starts_with(&format!("gumption {name}"));
            assert!(lines.iter().any(is_own), "{name}: {lines:?}");
            assert!(lines.iter().all(|line| line.chars().count() <= WIDTH), "{lines:?}");
        }
    }
    let names: BTreeSet<&str> = EXAMPLES.iter().map(|(name, _)| *name).collect();
    assert_eq!(names.len(), EXAMPLES.len());
}
