//! `gumption new`: writes a new model file from options or from answers to questions.

mod input;

use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Map, Value, json};

use super::exit::{say, say_line};
use super::output::AnswerPlace;
use super::{CommandLine, Exit, Failure, output};
use gumption_engine::model::formula::Formula;
use gumption_report::plain;
use gumption_text::DiagnosticKind;
use gumption_units::nearest;
use input::{blank, described, is_distribution, unit_of, value};

/// Write a new model file, from options or from answers to questions.
///
/// Without --equation the command asks questions.
#[derive(Debug, Args)]
pub(super) struct New {
    /// Title of the measurement
    #[arg(long)]
    title: Option<String>,
    /// An equation, NAME=FORMULA (repeatable, in order); the last one is reported unless --unit
    /// names others
    #[arg(long, value_name = "NAME=FORMULA")]
    equation: Vec<String>,
    /// An input, NAME=VALUE as in a file, `V=5.0112(23) V` or `V=5.01 V ± 0.02 V (k=2)`; or
    /// NAME=UNIT,DISTRIBUTION,KEY=VALUE,...: `R=ohm,normal,mean=100,std=0.2`, readings as
    /// values=9.8 9.9 10.1
    #[arg(long, value_name = "NAME=...")]
    input: Vec<String>,
    /// An output and its unit, NAME=UNIT
    #[arg(long, value_name = "NAME=UNIT")]
    unit: Vec<String>,
    /// Write the file here instead of to standard output
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The contents of a new file.
#[derive(Debug, Default)]
struct Draft {
    title: Option<String>,
    equations: Vec<(String, String)>,
    inputs: Vec<(String, Value)>,
    outputs: Vec<(String, String)>,
}

impl New {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let [file] = output::open([("--output", output::to_file(self.output.as_deref()))], &[])?;
        let draft =
            if self.equation.is_empty() { self.asked(program)? } else { self.told(program)? };
        let missing = draft.missing();
        let text = draft.text();
        // given content must be valid; missing content is reported
        if missing.is_empty()
            && let Err(found) = program.files().check_text("the new file", &text, Path::new(""))
        {
            let units: Option<Vec<String>> =
                found.0.iter().map(|found| self.unit_needed(&found.kind)).collect();
            let unit = units.and_then(|units| units.into_iter().next());
            return Err(unit.map_or(Failure::Diagnostics(found), Failure::Argument));
        }
        let name = output::to_file(self.output.as_deref());
        let name = name.map_or_else(String::new, |path| path.display().to_string());
        file.map_or(AnswerPlace::StandardOutput, AnswerPlace::File).write(&text)?;
        if !name.is_empty() {
            let name = plain(&name);
            let next = if missing.is_empty() {
                format!("`gumption run {name}` evaluates it")
            } else {
                format!("fill in {}, then `gumption check {name}`", missing.join(", "))
            };
            say(&format!("note: {next}\n"));
        }
        Ok(Exit::Done)
    }

    /// The message that an output needs a unit, for an output without one: there is no line yet to
    /// point to.
    fn unit_needed(&self, kind: &DiagnosticKind) -> Option<String> {
        let DiagnosticKind::WrongDimension { name, expected, expected_as, .. } = kind else {
            return None;
        };
        let is_output = self
            .equation
            .iter()
            .any(|equation| equation.split_once('=').is_some_and(|(left, _)| left.trim() == name));
        (is_output && self.unit.is_empty()).then(|| {
            format!("`{name}` is {expected_as}; state its unit: `--unit {name}={expected}`")
        })
    }

    /// The draft given by the options.
    fn told(&self, program: &CommandLine) -> Result<Draft, Failure> {
        let mut draft = Draft { title: self.title.clone(), ..Draft::default() };
        for equation in &self.equation {
            draft.equation(equation).map_err(Failure::Argument)?;
        }
        for unit in &self.unit {
            let (name, unit) = halves(unit, "--unit", "NAME=UNIT")?;
            if !draft.equations.iter().any(|(of, _)| of == name) {
                let names: Vec<&str> = draft.equations.iter().map(|(of, _)| of.as_str()).collect();
                let near = nearest(name, names.iter().copied());
                let hint =
                    near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
                return Err(Failure::Argument(format!("no equation defines `{name}`{hint}")));
            }
            unit_of(unit).map_err(Failure::Argument)?;
            draft.outputs.push((name.to_owned(), unit.to_owned()));
        }
        if draft.outputs.is_empty()
            && let Some((last, _)) = draft.equations.last()
        {
            draft.outputs.push((last.clone(), "1".to_owned()));
        }
        let needed = draft.quantities();
        for input in &self.input {
            let (name, said) =
                halves(input, "--input", "NAME=VALUE or NAME=UNIT,DISTRIBUTION,KEY=VALUE")?;
            if !needed.iter().any(|of| of == name) {
                let near = nearest(name, needed.iter().map(String::as_str));
                let hint =
                    near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
                return Err(Failure::Argument(format!("no equation uses `{name}`{hint}")));
            }
            let input = input::told(program.files(), name, said)
                .map_err(|why| Failure::Argument(format!("--input {name}: {why}")))?;
            if draft.inputs.iter().any(|(of, _)| of == name) {
                return Err(Failure::Argument(format!("--input {name} is given twice")));
            }
            draft.inputs.push((name.to_owned(), input));
        }
        draft.complete(&needed);
        Ok(draft)
    }

    /// The draft given on standard input, question by question.
    fn asked(&self, program: &CommandLine) -> Result<Draft, Failure> {
        if !(self.input.is_empty() && self.unit.is_empty()) {
            let message =
                "--input and --unit require --equation; without it the command asks for everything";
            return Err(Failure::Argument(message.to_owned()));
        }
        let mut ask = Questions { answers: io::stdin().lock() };
        let title = match &self.title {
            Some(title) => title.clone(),
            None => ask.line("Title:")?,
        };
        let mut draft = Draft { title: Some(title), ..Draft::default() };
        say("Equations, NAME = FORMULA, one per line; finish with an empty line.\n");
        loop {
            let question = "equation:";
            let line = ask.line(question)?;
            if line.is_empty() {
                if draft.equations.is_empty() {
                    return Err(unanswered(question));
                }
                break;
            }
            if let Err(why) = draft.equation(&line) {
                say_line(&why);
            }
        }
        if let Some((last, _)) = draft.equations.last().cloned() {
            let unit = ask.until(&format!("Unit of {last} (1 if dimensionless):"), |text| {
                unit_of(text).map(|()| text.to_owned())
            })?;
            draft.outputs.push((last, unit));
        }
        let names = draft.quantities();
        if !names.is_empty() {
            say(
                "Inputs: a value with its uncertainty, such as `5.0112(23) V` or `5.01 V ± 0.02 V \
                 (k=2)`; or a distribution, such as `rectangular, mean=5, half_width=0.1` or \
                 `readings, values=4.9 5.1 5.0`.\n",
            );
        }
        for name in names {
            let input = ask.until(&format!("{name}:"), |text| {
                if is_distribution(text) {
                    // the unit comes after it
                    described(&format!("1,{text}"))
                } else {
                    value(program.files(), &name, text)
                }
            })?;
            let input = match input {
                Value::Object(mut keys) => {
                    let unit = ask
                        .until(&format!("unit of {name} (1 if dimensionless):"), |text| {
                            unit_of(text).map(|()| text.to_owned())
                        })?;
                    keys.insert("unit".to_owned(), json!(unit));
                    Value::Object(keys)
                }
                value => value,
            };
            draft.inputs.push((name, input));
        }
        Ok(draft)
    }
}

/// The message about a question without an answer.
fn unanswered(question: &str) -> Failure {
    Failure::Argument(format!(
        "\"{question}\" has no answer, so that no file is written; `gumption new --equation ...` \
         takes the answers as options, and leaves unknown values blank"
    ))
}

/// Questions on standard error, answers on standard input.
struct Questions<R> {
    answers: R,
}

impl<R: BufRead> Questions<R> {
    fn line(&mut self, question: &str) -> Result<String, Failure> {
        say(&format!("{question} "));
        let _ = io::stderr().flush();
        let mut line = String::new();
        let read = self.answers.read_line(&mut line);
        match read {
            Ok(0) => Err(unanswered(question)),
            Ok(_) => Ok(line.trim().to_owned()),
            Err(error) => Err(Failure::System(format!("cannot read the answers: {error}"))),
        }
    }

    /// Repeats a question until the answer is valid; an empty answer is an error.
    fn until<T>(
        &mut self,
        question: &str,
        read: impl Fn(&str) -> Result<T, String>,
    ) -> Result<T, Failure> {
        loop {
            let line = self.line(question)?;
            if line.is_empty() {
                return Err(unanswered(question));
            }
            match read(&line) {
                Ok(answer) => return Ok(answer),
                Err(why) => say_line(&why),
            }
        }
    }
}

impl Draft {
    /// Adds an equation.
    fn equation(&mut self, text: &str) -> Result<(), String> {
        let form = || {
            format!(
                "`{text}` is not an equation; write NAME = FORMULA, such as `power = \
                 voltage^2/resistance`"
            )
        };
        let (name, formula) = text.split_once('=').ok_or_else(form)?;
        let (name, formula) = (name.trim(), formula.trim());
        gumption_engine::model::formula::check_name(name)
            .map_err(|why| format!("`{name}`: {why}"))?;
        Formula::parse(formula).map_err(|why| format!("{name}: {why}"))?;
        if self.equations.iter().any(|(of, _)| of == name) {
            return Err(format!("there are two equations for `{name}`"));
        }
        self.equations.push((name.to_owned(), formula.to_owned()));
        Ok(())
    }

    /// The names that equations use but do not define, in the order in which they occur.
    fn quantities(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (place, (_, text)) in self.equations.iter().enumerate() {
            let Ok(formula) = Formula::parse(text) else { continue };
            for (name, _) in formula.names() {
                let given = self.equations.iter().take(place).any(|(of, _)| of == name);
                if !given && !names.iter().any(|of| of == name) {
                    names.push(name.to_owned());
                }
            }
        }
        names
    }

    /// Puts the inputs in the order of the equations, with blanks for missing ones.
    fn complete(&mut self, needed: &[String]) {
        let mut told = std::mem::take(&mut self.inputs);
        for name in needed {
            let at = told.iter().position(|(of, _)| of == name);
            let input = at.map_or_else(blank, |at| told.swap_remove(at).1);
            self.inputs.push((name.clone(), input));
        }
    }

    /// Missing values: `mean and std of voltage`.
    fn missing(&self) -> Vec<String> {
        let of = |(name, input): &(String, Value)| {
            let missing =
                input.as_object().into_iter().flatten().filter(|(_, value)| value.is_null());
            let missing: Vec<String> = missing.map(|(key, _)| format!("`{key}`")).collect();
            (!missing.is_empty())
                .then(|| format!("{} of `{name}`", gumption_units::listed(&missing, " and ")))
        };
        self.inputs.iter().filter_map(of).collect()
    }

    /// The file, with remarks under keys that programs ignore.
    fn text(&self) -> String {
        let mut file = Map::new();
        file.insert(
            "$comment".into(),
            json!(
                "Keys that begin with $ are remarks. `gumption help \
                     model` lists all keys, `gumption help distributions` the kinds of inputs. \
                     `about` of an input states its source; certificates print its first sentence \
                     as the meaning of the symbol."
            ),
        );
        file.insert("format".into(), json!(1));
        if let Some(title) = self.title.as_ref().filter(|title| !title.is_empty()) {
            file.insert("title".into(), json!(title));
        }
        let inputs = self.inputs.iter().cloned();
        file.insert("inputs".into(), Value::Object(inputs.collect()));
        let equations = self.equations.iter().map(|(name, text)| (name.clone(), json!(text)));
        file.insert("equations".into(), Value::Object(equations.collect()));
        let outputs = self.outputs.iter().map(|(name, unit)| (name.clone(), json!({"unit": unit})));
        file.insert("outputs".into(), Value::Object(outputs.collect()));
        format!("{:#}\n", Value::Object(file))
    }
}

/// A name and the text after its equals sign.
fn halves<'a>(text: &'a str, option: &str, form: &str) -> Result<(&'a str, &'a str), Failure> {
    let (name, said) = text
        .split_once('=')
        .ok_or_else(|| Failure::Argument(format!("{option} {text}: write it as {form}")))?;
    Ok((name.trim(), said.trim()))
}
