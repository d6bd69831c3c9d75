//! `gumption models --effects`: the ready-made effects of the gap diagnosis.

use std::fmt::Write;

use super::{one_line, plain_table, render, wrapped, wrapped_to};
use crate::Failure;
use gumption_files as file;
use gumption_files::EffectListing;
use gumption_units::nearest;

/// The effects with this name, or all.
pub(super) fn named(name: Option<&str>) -> Result<EffectListing, Failure> {
    let EffectListing { names, mut effects } = file::catalogue();
    let Some(name) = name else { return Ok(EffectListing { names, effects }) };
    let hint = match nearest(name, effects.iter().map(|effect| effect.name.as_str())) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "`gumption models --effects` lists them".to_owned(),
    };
    effects.retain(|effect| effect.name == name);
    if effects.is_empty() {
        return Err(Failure::Argument(format!("the catalogue has no effect `{name}`; {hint}")));
    }
    Ok(EffectListing { names, effects })
}

pub(super) fn page(listing: &EffectListing) -> String {
    let mut text = String::new();
    for effect in &listing.effects {
        let _ = writeln!(text, "{} ({})\n", effect.name, bench(&effect.bench));
        let _ = writeln!(text, "{}\n", wrapped(&effect.about));
        let mut parameters = plain_table();
        parameters.set_header(["parameter", "unit", "prior", "description"]);
        for parameter in &effect.parameters {
            parameters.add_row([
                &parameter.name,
                &parameter.unit,
                &parameter.prior,
                &one_line(&parameter.about),
            ]);
        }
        let _ = writeln!(text, "{}", render(&parameters));
        for (name, formula) in &effect.overrides {
            let lines = wrapped_to(&format!("{name} becomes {formula}"), 92);
            let _ = writeln!(text, "    {}", lines.replace('\n', "\n        "));
        }
        let _ = writeln!(text, "\n{}\n", wrapped(&format!("Source: {}", effect.source)));
    }
    text.push_str(&wrapped(
        "A case lists effects of the catalogue by name: \"catalogue\": [\"lateral-mode\"]. If \
         several entries have one name, the entry that acts on most quantities of the sim is \
         used, entries for a bench before entries for any bench. {amplitude} and {phase} stand \
         for each observed output of that kind, {unit} for its unit. {condition} stands for each \
         condition whose history is known from the order of the rows. The formula reads the \
         {direction} of its last change, its {previous} value, its {share} of its range, the time \
         {since} it changed, and {passed}, the time since the first row; the last four are \
         numbers up to 1.",
    ));
    text.push_str("\n\n");
    let names = listing.names.iter().map(|(name, alternatives)| {
        let others: Vec<&str> = alternatives.iter().skip(1).map(String::as_str).collect();
        format!("{name} {}", gumption_units::listed(&others, " or "))
    });
    let names = names.collect::<Vec<_>>().join(", ");
    text.push_str(&wrapped(&format!("A sim may call {names}.")));
    text.push('\n');
    text
}

fn bench(bench: &str) -> String {
    if bench == "any" { "any bench".to_owned() } else { bench.to_owned() }
}
