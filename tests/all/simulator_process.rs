//! Simulators that are programs: started for each run or kept, with every way in which one can fail.
#![cfg(unix)]

use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::Stdio;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use gumption_command::simulator::{KeptRuns, Program, design, made};
use gumption_emulator::{
    RunKey, RunResult, Simulator, SimulatorCase, SimulatorCondition, SimulatorQuantity,
};
use serde_json::Value;
use tempfile::TempDir;

use crate::process::{Command, until};
use crate::support::{command, root};

fn case() -> SimulatorCase {
    let quantity =
        |name: &str, unit: &str| SimulatorQuantity { name: name.into(), unit: unit.into() };
    let times = SimulatorCondition { quantity: quantity("t", "s"), values: vec![0.0, 0.5, 1.0] };
    SimulatorCase {
        parameters: vec![quantity("length", "m"), quantity("drag", "1/s")],
        conditions: vec![times],
        outputs: vec![quantity("angle", "mrad"), quantity("gain", "1")],
        rows: 3,
    }
}

/// What the good programs return: angle = length*t, gain = drag at all rows.
fn expected(length: f64, drag: f64) -> RunResult {
    Ok(vec![0.0, length * 0.5, length, drag, drag, drag])
}

/// The outputs come in another order than that of the case.
const ANSWER: &str = "import json, os, sys, time
def answer(text):
    request = json.loads(text)
    parameters, times = request['parameters'], request['conditions']['t']
    angle = [parameters['length']*t for t in times]
    return json.dumps({'gain': [parameters['drag']]*len(times), 'angle': angle})
def log(text):
    with open(os.path.join(os.path.dirname(__file__), 'log'), 'a') as file:
        file.write(text + '\\n')
";

/// A program in a folder, with the command that starts it.
fn written(folder: &TempDir, name: &str, text: &str) -> String {
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    let language = if name.ends_with(".py") { "python3" } else { "sh" };
    format!("{language} '{}'", path.display())
}

fn python(folder: &TempDir, text: &str) -> Program {
    Program::new(&written(folder, "sim.py", &format!("{ANSWER}{text}"))).unwrap()
}

fn log(folder: &TempDir) -> Vec<String> {
    let log = fs::read_to_string(folder.path().join("log")).unwrap_or_default();
    log.lines().map(str::to_owned).collect()
}

fn results(simulator: &dyn Simulator, batch: &[[f64; 2]]) -> Vec<Option<RunResult>> {
    let batch: Vec<RunKey> = batch.iter().map(|of| of.to_vec().into()).collect();
    KeptRuns::in_memory(case()).results(simulator, &batch).unwrap()
}

/// The reason why a run of a shell script failed.
fn failure(script: &str, limit: Option<Duration>) -> String {
    let folder = tempfile::tempdir().unwrap();
    let mut program = Program::new(&written(&folder, "sim.sh", script)).unwrap();
    if let Some(limit) = limit {
        program = program.with_timeout(limit);
    }
    results(&program, &[[0.5, 0.1]]).remove(0).unwrap().unwrap_err()
}

fn is_running(id: &str) -> bool {
    let id = id.trim();
    if !cfg!(target_os = "linux") {
        let kill = Command::new("kill").args(["-0", id]).output();
        return kill.unwrap().status.success();
    }
    // one that ended and that nobody waited for is still listed
    let status = fs::read_to_string(format!("/proc/{id}/stat")).unwrap_or_default();
    status.rsplit_once(") ").is_some_and(|(_, fields)| !fields.starts_with('Z'))
}

#[test]
fn a_program_gets_all_parameters_and_conditions_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    let program = python(&folder, "print(answer(sys.stdin.read()))").with_runs_at_once(2);
    let batch = [[0.1 + 0.2, 5e-324], [0.7, -0.0], [1e300, 1.0 / 3.0]];
    let found = results(&program, &batch);
    let expected: Vec<_> = batch.iter().map(|[a, b]| Some(expected(*a, *b))).collect();
    assert_eq!(found, expected);
    assert_eq!(found[1].as_ref().unwrap().as_ref().unwrap()[3].to_bits(), (-0.0f64).to_bits());
}

#[test]
fn a_failed_run_says_what_was_found_and_where() {
    for (script, found) in [
        (
            "echo reading >&2; printf 'no \\033[1mmesh' >&2; exit 3",
            "it ended with exit code 3; its standard error ends with: reading | no \\u{1b}[1mmesh",
        ),
        ("kill -9 $$", "it was ended by signal 9 (SIGKILL)"),
        ("exit 0", "its standard output is empty"),
        ("echo done", "its standard output is not JSON: expected value at line 1 column 1"),
        ("echo '{\"angle\": [1, 2, 3]}'", "its standard output has no `gain`"),
        (
            "echo '{\"angle\": [1, 2], \"gain\": [1, 2, 3]}'; echo converged >&2",
            "`angle` has 2 values, but the data have 3 rows; its standard error ends \
             with: converged",
        ),
        (
            "echo '{\"angle\": [1, 2, 3], \"gain\": [1, NaN, 3]}'",
            "value 2 of `gain` is NaN, but must be a finite number",
        ),
        (
            "echo '{\"angle\": [1, 2, 3], \"gain\": [1, 2, 3], \"rate\": [1, 2, 3]}'",
            "its standard output has `rate`, but the case has only `angle` and `gain`",
        ),
        // 64 KiB and 64 bytes for each of six values
        ("exec yes", "it wrote more than 65920 bytes to its standard output"),
    ] {
        assert_eq!(failure(script, None), found, "{script}");
    }
    let program = Program::new("no-such-program --fast").unwrap();
    let found = results(&program, &[[0.5, 0.1]]).remove(0).unwrap().unwrap_err();
    let message = "`no-such-program` cannot be started: there is no such program";
    assert_eq!(found, message);
}

#[test]
fn of_a_long_standard_error_the_last_lines_are_shown() {
    let found =
        failure("i=0; while [ $i -lt 30000 ]; do echo step $i >&2; i=$((i+1)); done; exit 1", None);
    let last: Vec<String> = (29_990..30_000).map(|step| format!("step {step}")).collect();
    let last = last.join(" | ");
    assert_eq!(found, format!("it ended with exit code 1; its standard error ends with: {last}"));
}

#[test]
fn a_program_that_hangs_is_ended_with_what_it_started() {
    let folder = tempfile::tempdir().unwrap();
    let id = folder.path().join("id");
    let script = format!("sleep 600 & echo $! > '{}'; echo waiting >&2; wait", id.display());
    let found = failure(&script, Some(Duration::from_secs(4)));
    assert!(
        found.ends_with("it did not end within 4 s; its standard error ends with: waiting"),
        "{found}"
    );
    let id = fs::read_to_string(id).unwrap();
    until("the end of what it started", || !is_running(&id));
}

#[test]
fn a_program_that_ignores_the_request_to_end_is_ended() {
    let found = failure("trap '' TERM; sleep 600", Some(Duration::from_millis(200)));
    assert!(found.ends_with("it did not end within 0.2 s"), "{found}");
}

#[test]
fn what_a_program_leaves_behind_does_not_hold_up_its_run() {
    let folder = tempfile::tempdir().unwrap();
    let answer = "{\"angle\": [1, 2, 3], \"gain\": [4, 5, 6]}";
    let script = format!("sleep 600 & echo '{answer}'");
    let program = Program::new(&written(&folder, "sim.sh", &script)).unwrap();
    let found = results(&program, &[[0.5, 0.1]]);
    assert_eq!(found, [Some(Ok(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]))]);
}

#[test]
fn a_program_may_leave_its_input_unread() {
    let folder = tempfile::tempdir().unwrap();
    let rows = 100_000;
    let mut case = case();
    case.rows = rows;
    case.conditions[0].values = vec![0.123_456_789; rows];
    case.outputs.truncate(1);
    let text = format!("print('{{\"angle\": [' + ', '.join(['7']*{rows}) + ']}}')");
    let program = Program::new(&written(&folder, "sim.py", &text)).unwrap();
    let mut found = Vec::new();
    program.run(&[vec![0.5, 0.1]], &case, &mut |index, result| {
        found.push((index, result));
        ControlFlow::Continue(())
    });
    assert_eq!(found, [(0, Ok(vec![7.0; rows]))]);
}

const LINE_BY_LINE: &str = "log('start')
for line in sys.stdin:
    drag = json.loads(line)['parameters']['drag']
    if drag == 1: sys.exit(4)
    if drag == 2: sys.exit(0)
    if drag == 3: print('{}', flush=True); continue
    if drag == 4: sys.stdout.write(answer(line) + '\\n{}')
    print(answer(line), flush=True)
log('end')
";

#[test]
fn a_kept_program_is_started_once() {
    let folder = tempfile::tempdir().unwrap();
    let program = python(&folder, LINE_BY_LINE).line_by_line();
    let found = results(&program, &[[0.5, 0.1], [0.5, 0.2]]);
    assert_eq!(found, [Some(expected(0.5, 0.1)), Some(expected(0.5, 0.2))]);
    // another batch
    assert_eq!(results(&program, &[[0.6, 0.1]]), [Some(expected(0.6, 0.1))]);
    drop(program);
    assert_eq!(log(&folder), ["start", "end"]);
}

#[test]
fn a_kept_program_is_started_anew_after_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let program = python(&folder, LINE_BY_LINE).line_by_line();
    for (drag, message) in [
        (1.0, "it ended with exit code 4 without an answer"),
        (2.0, "it ended without an answer"),
        (3.0, "its line has no `angle`"),
        (4.0, "it wrote more than one line for a request"),
    ] {
        let found = results(&program, &[[0.5, drag], [0.5, 0.1]]);
        assert_eq!(found[0], Some(Err(message.to_owned())));
        assert_eq!(found[1], Some(expected(0.5, 0.1)));
    }
    let starts = log(&folder).iter().filter(|line| *line == "start").count();
    assert_eq!(starts, 5);
}

#[test]
fn a_kept_program_that_hangs_is_ended() {
    let folder = tempfile::tempdir().unwrap();
    let program = Program::new(&written(&folder, "sim.sh", "read line; sleep 600")).unwrap();
    let program = program.line_by_line().with_timeout(Duration::from_millis(200));
    let found = results(&program, &[[0.5, 0.1]]).remove(0).unwrap().unwrap_err();
    assert!(found.ends_with("it did not end within 0.2 s"), "{found}");
}

const LOGGED: &str = "text = sys.stdin.read()
log('run')
if json.loads(text)['parameters']['drag'] == 9: sys.exit('stalled')
if json.loads(text)['parameters']['drag'] == 8: time.sleep(600)
print(answer(text))
";

fn kept(folder: &Path) -> (KeptRuns, Vec<String>) {
    KeptRuns::open(folder, case(), "python3 sim.py").unwrap()
}

fn kept_failure(folder: &Path, case: SimulatorCase) -> String {
    KeptRuns::open(folder, case, "python3 sim.py").unwrap_err().to_string()
}

#[test]
fn an_interrupted_diagnosis_goes_on_where_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let runs = folder.path().join("kept").join("runs");
    let program = python(&folder, LOGGED);
    let (mut first, notes) = kept(&runs);
    assert!(notes.is_empty());
    let batch = [vec![0.5, 0.1], vec![0.5, 9.0], vec![0.5, 0.1]].map(RunKey::from);
    let before = first.results(&program, &batch).unwrap();
    assert_eq!((&before[0], &before[2]), (&Some(expected(0.5, 0.1)), &before[0]));
    assert_eq!(log(&folder).len(), 2);
    let in_use = kept_failure(&runs, case());
    assert!(in_use.ends_with("runs.jsonl` is in use by another program\n"), "{in_use}");
    drop(first);

    // as if the machine had stopped while a line was written
    let file = runs.join("runs.jsonl");
    let whole = fs::read_to_string(&file).unwrap();
    assert_eq!(whole.lines().count(), 3);
    fs::write(&file, format!("{whole}{{\"hash\":\"3c6f")).unwrap();
    let (mut second, notes) = kept(&runs);
    let note = format!("the last line of `{}` is damaged and is dropped", file.display());
    assert_eq!(notes, [note]);
    let batch = [vec![0.5, 9.0], vec![0.6, 0.2], vec![0.5, 0.1]].map(RunKey::from);
    let after = second.results(&program, &batch).unwrap();
    let stalled = "it ended with exit code 1; its standard error ends with: stalled";
    let stalled = Some(Err(stalled.to_owned()));
    assert_eq!(after, [stalled, Some(expected(0.6, 0.2)), before[0].clone()]);
    assert_eq!(log(&folder).len(), 3);
    drop(second);
    let text = fs::read_to_string(&file).unwrap();
    assert!(text.starts_with(&whole) && text.ends_with('\n') && text.lines().count() == 4);

    // a last line without its end is whole
    fs::write(&file, text.trim_end()).unwrap();
    let (third, notes) = kept(&runs);
    assert!(notes.is_empty() && third.runs().made().len() == 3);
    drop(third);
    assert_eq!(fs::read_to_string(&file).unwrap(), text);

    let (_, notes) = KeptRuns::open(&runs, case(), "sim2").unwrap();
    let note = "were made by `python3 sim.py`, further runs are made by `sim2`";
    assert!(notes.len() == 1 && notes[0].ends_with(note), "{notes:?}");
}

#[test]
fn runs_of_another_case_and_damaged_runs_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("runs.jsonl");
    let simulator = |of: &[f64], _: &SimulatorCase| expected(of[0], of[1]);
    let (mut runs, _) = kept(folder.path());
    runs.results(&simulator, &[vec![0.5, 0.1], vec![0.5, 0.2]].map(RunKey::from)).unwrap();
    drop(runs);
    let failure = |case| kept_failure(folder.path(), case);
    let start = format!("gumption: `{}`: its runs are of another case: ", file.display());

    let mut other = case();
    other.parameters[1].name = "friction".to_owned();
    let message = "their parameters are `length` and `drag`, but the case has `length` and \
                   `friction`\n";
    assert_eq!(failure(other), format!("{start}{message}"));
    let mut other = case();
    other.outputs.truncate(1);
    let message = "their outputs are `angle` and `gain`, but the case has `angle`\n";
    assert_eq!(failure(other), format!("{start}{message}"));
    let mut other = case();
    other.conditions[0].values[2] = 1.5;
    assert_eq!(failure(other), format!("{start}conditions or units differ\n"));

    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replacen("[0.5,0.1]", "[0.5,0.3]", 1)).unwrap();
    let message = "line 2 is damaged: its `hash` is not that of its parameters";
    assert_eq!(failure(case()), format!("gumption: `{}`: {message}\n", file.display()));
    let damaged = fs::read_to_string(&file).unwrap();
    assert!(damaged.contains("[0.5,0.3]"), "an error changes nothing");
    fs::write(&file, "length,drag\n1,2\n").unwrap();
    let message = "its first line is not the heading of runs";
    assert_eq!(failure(case()), format!("gumption: `{}`: {message}\n", file.display()));
    // a heading that was written in part
    fs::write(&file, "{\"param").unwrap();
    let (runs, notes) = kept(folder.path());
    assert!(runs.runs().made().is_empty() && notes.len() == 1);
    drop(runs);
    assert_eq!(kept(folder.path()).1, Vec::<String>::new());
}

#[test]
fn a_stop_ends_the_running_programs_and_keeps_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let stop = Arc::new(AtomicBool::new(false));
    let program = python(&folder, LOGGED).with_stop(Arc::clone(&stop)).with_runs_at_once(2);
    let (mut runs, _) = kept(folder.path());
    let file = folder.path().join("runs.jsonl");
    let watch = std::thread::spawn({
        let (file, log_file) = (file.clone(), folder.path().join("log"));
        move || {
            let lines = |file: &Path| fs::read_to_string(file).unwrap_or_default().lines().count();
            until("a run and one that hangs", || lines(&file) == 2 && lines(&log_file) == 2);
            stop.store(true, Ordering::Relaxed);
        }
    });
    let batch = [vec![0.5, 8.0], vec![0.5, 0.1]].map(RunKey::from);
    let found = runs.results(&program, &batch).unwrap();
    watch.join().unwrap();
    assert_eq!(found, [None, Some(expected(0.5, 0.1))]);
    drop(runs);
    let (runs, notes) = kept(folder.path());
    assert!(notes.is_empty() && runs.runs().made().len() == 1);
}

#[test]
fn runs_are_made_elsewhere_from_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let read = || made(folder.path(), &case()).map_err(|failure| failure.to_string());
    let path = folder.path().display();
    let none = format!("gumption: `{path}` has neither runs.jsonl nor parameters.csv\n");
    assert_eq!(read().unwrap_err(), none);

    let batch = [[0.1 + 0.2, 5e-324], [0.5, 1e22], [0.5, 0.3], [0.5, 0.4], [0.5, 0.5]];
    let batch = batch.map(|parameters| parameters.to_vec());
    let table = design(&case(), &batch, 3);
    let begin = "run,length [m],drag [1/s]\n3,0.30000000000000004,5e-324\n4,0.5,1e+22\n";
    assert!(table.starts_with(begin), "{table}");
    write("parameters.csv", &table);
    write("3.json", "{\"angle\": [1, 2, 3], \"gain\": [4, 5, 6]}");
    write("4.csv", "t,gain,angle [mrad]\n0,4,1\n0.5,5,2\n1,6,3\n");
    write("5.json", "{\"angle\": [1, 2, 3]");
    write("6.csv", "angle,gain\n1,2\n");
    let found = read().unwrap();
    assert_eq!(found.notes, ["1 runs of parameters.csv have no file: 7"]);
    let runs = found.runs.made();
    assert_eq!(runs.len(), 4);
    for (run, parameters) in runs.iter().zip(&batch) {
        assert_eq!(&run.parameters, parameters);
    }
    let outputs = Ok(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!((&runs[0].result, &runs[1].result), (&outputs, &outputs));
    let message = "`5.json` is not JSON: EOF \
                   while parsing an object at line 1 column 19";
    assert_eq!(runs[2].result, Err(message.to_owned()));
    let message = "`angle` has 1 values, but \
                   the data have 3 rows";
    assert_eq!(runs[3].result, Err(message.to_owned()));

    write("parameters.csv", &table.replace("[1/s]", "[1/min]"));
    let message = "has the column `drag [1/min]`, but must have `drag` in 1/s";
    assert_eq!(read().unwrap_err(), format!("gumption: `{path}/parameters.csv` {message}\n"));
    write("parameters.csv", "run,length,drag\n1.5,1,2\n");
    let message = "a run has the number 1.5, but must have a whole number from 1 on";
    assert_eq!(read().unwrap_err(), format!("gumption: `{path}/parameters.csv`: {message}\n"));
    write("parameters.csv", "run,length\n1,1\n");
    let message = "has no column `drag`; its columns are run, length";
    assert_eq!(read().unwrap_err(), format!("gumption: `{path}/parameters.csv` {message}\n"));
}

#[test]
fn kept_runs_are_read_as_runs_that_were_made() {
    let folder = tempfile::tempdir().unwrap();
    let simulator = |of: &[f64], _: &SimulatorCase| expected(of[0], of[1]);
    let (mut runs, _) = kept(folder.path());
    runs.results(&simulator, &[vec![0.5, 0.1].into()]).unwrap();
    let found = made(folder.path(), &case()).unwrap();
    assert_eq!((&found.runs, found.notes.len()), (runs.runs(), 0));
}

/// A pendulum that loses energy as `exp(-drag*t)`, which the plain sim does not.
const PENDULUM: &str = "import json, math, os, sys, time
def answer(text):
    request = json.loads(text)
    parameters, times = request['parameters'], request['conditions']['t']
    rate = math.sqrt(9.81/parameters['length'])
    angle = [200*math.exp(-parameters['drag']*t)*math.cos(rate*t) for t in times]
    return json.dumps({'angle': angle})
def log(text):
    with open(os.path.join(os.path.dirname(__file__), 'log'), 'a') as file:
        file.write(text + '\\n')
";

const CASE: &str = r#"{
    "inputs": {"length": {"unit": "m", "distribution": "normal", "mean": 0.5, "std": 0.001}},
    "conditions": {"t": {"unit": "s"}},
    "simulator": {"outputs": {"angle": "mrad"}},
    "outputs": {"angle": {"unit": "mrad"}},
    "observations": {
        "file": "data.csv",
        "columns": {"angle": {"value": "angle", "standard_uncertainty": 0.5}}
    },
    "effects": {
        "air-drag": {"simulator": true, "parameters": {
            "drag": {"unit": "1/s", "distribution": "rectangular", "lower": 0, "upper": 0.2}}},
        "scale": {"overrides": {"angle": "angle*(1 + k)"}, "parameters": {
            "k": {"unit": "1", "distribution": "normal", "mean": 0, "std": 0.01}}}
    }
}"#;

/// The case with the data of a pendulum of 0.5005 m with a drag of 0.05 1/s, and the program.
fn pendulum(program: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut data = "t,angle\n".to_owned();
    for row in 0..60 {
        let t = 0.05 * f64::from(row);
        let angle = 200.0 * (-0.05 * t).exp() * ((9.81f64 / 0.5005).sqrt() * t).cos();
        // a pattern for noise: its root mean square is 0.5
        let noise = [0.7, -0.2, 0.1, -0.8, 0.3, 0.5, -0.6][row as usize % 7];
        data += &format!("{t},{}\n", angle + noise);
    }
    fs::write(folder.path().join("data.csv"), data).unwrap();
    fs::write(folder.path().join("case.json"), CASE).unwrap();
    fs::write(folder.path().join("sim.py"), format!("{PENDULUM}{program}")).unwrap();
    folder
}

fn gap(folder: &TempDir, arguments: &[&str]) -> Command {
    let mut program = command();
    program.current_dir(folder.path()).args(["gap", "case.json", "--runs", "40"]).args(arguments);
    program
}

/// The answer in JSON, and standard error.
fn diagnosed(folder: &TempDir, arguments: &[&str]) -> (Value, String) {
    let done = gap(folder, &[arguments, &["--format", "json"]].concat()).output().unwrap();
    let said = String::from_utf8(done.stderr).unwrap();
    assert!(done.status.success(), "{said}");
    (serde_json::from_slice(&done.stdout).unwrap(), said)
}

fn assert_drag(answer: &Value) {
    assert_eq!(
        answer["verdict"]["effects"],
        serde_json::json!(["air-drag"]),
        "{}",
        answer["verdict"]
    );
    let drag = &answer["present"]["air-drag"]["parameters"]["air-drag/drag"];
    let (found, u) =
        (drag["estimate"].as_f64().unwrap(), drag["standard_uncertainty"].as_f64().unwrap());
    // an envelope of 200 mrad, 60 rows of 0.5 mrad within 3 s: u is 0.5/(200 sqrt(sum of t^2 cos^2)) or more
    assert!((found - 0.05).abs() < 3.0 * u && u > 2e-4 && u < 5e-4, "{drag}");
}

#[test]
fn the_gap_of_a_program_is_diagnosed_and_its_runs_are_kept() {
    let folder = pendulum("log('start')\nfor line in sys.stdin: print(answer(line), flush=True)");
    let kept = ["--keep", "runs", "--threads", "1"];
    let arguments = [&["--simulator", "python3 sim.py", "--simulator-lines"][..], &kept].concat();
    let (first, _) = diagnosed(&folder, &arguments);
    assert_drag(&first);
    assert_eq!(log(&folder), ["start"]);
    // from the kept runs alone
    let (again, said) = diagnosed(&folder, &["--simulator", "no-such-program", "--keep", "runs"]);
    assert_eq!(again, first);
    let note = "were made by `python3 sim.py`, further runs are made by `no-such-program`";
    assert!(said.contains(note), "{said}");
}

#[test]
fn ctrl_c_ends_the_programs_and_the_next_diagnosis_goes_on() {
    let folder = pendulum(
        "text = sys.stdin.read()
log(str(os.getpid()))
hangs = os.path.join(os.path.dirname(__file__), 'hangs')
if os.path.exists(hangs) and len(open(hangs + '/../log').readlines()) > 5: time.sleep(600)
print(answer(text))",
    );
    fs::create_dir(folder.path().join("hangs")).unwrap();
    let arguments = ["--simulator", "python3 sim.py", "--keep", "runs", "--threads", "1"];
    let mut program = gap(&folder, &arguments);
    let child = program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    until("a run that hangs", || log(&folder).len() == 6);
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let done = child.wait_with_output().unwrap();
    assert_eq!(done.status.code(), Some(130));
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!(
        said,
        "note: interrupted after 5 runs, which are kept; the same command continues\n"
    );
    let id = log(&folder).pop().unwrap();
    until("the end of the run that hangs", || !is_running(&id));
    let kept = fs::read_to_string(folder.path().join("runs/runs.jsonl")).unwrap();
    assert!(kept.lines().count() == 6 && kept.ends_with('\n'));

    fs::remove_dir(folder.path().join("hangs")).unwrap();
    let (answer, said) = diagnosed(&folder, &arguments);
    assert_drag(&answer);
    assert_eq!(said.matches("note").count(), answer["notes"].as_array().unwrap().len(), "{said}");
    let all = fs::read_to_string(folder.path().join("runs/runs.jsonl")).unwrap();
    assert!(all.starts_with(&kept));
    // the heading stands for the run that was ended
    assert_eq!(all.lines().count(), log(&folder).len());
}

/// A program that adds a pattern to its angles, which depends on how often it was started: some 0.25 u.
const NOISY: &str = "log('run')
calls = len(open(os.path.join(os.path.dirname(__file__), 'log')).readlines())
angles = json.loads(answer(sys.stdin.read()))['angle']
angles = [a + 0.2*math.sin(977.0*(calls*61 + row + 1)**2) for row, a in enumerate(angles)]
print(json.dumps({'angle': angles}))";

#[test]
fn a_noisy_program_is_repeated_and_its_repeats_are_kept() {
    let folder = pendulum(NOISY);
    let arguments = ["--simulator", "python3 sim.py", "--keep", "runs", "--threads", "1"];
    let done = gap(&folder, &arguments).output().unwrap();
    assert_eq!(done.status.code(), Some(1));
    let said = String::from_utf8(done.stderr).unwrap();
    assert!(said.contains("does not repeat") && said.contains("`\"noisy\": true`"), "{said}");
    assert_eq!(log(&folder).len(), 2);
    // said to be noisy it goes on with the runs that are there
    let case = CASE.replace("\"angle\": \"mrad\"}}", "\"angle\": \"mrad\"}, \"noisy\": true}");
    fs::write(folder.path().join("case.json"), case).unwrap();
    let (first, _) = diagnosed(&folder, &arguments);
    assert_drag(&first);
    let note =
        first["notes"].as_array().unwrap().iter().find(|note| {
            note["message"].as_str().is_some_and(|text| text.contains("scatters by 0.2"))
        });
    assert!(note.is_some(), "{}", first["notes"]);
    let file = folder.path().join("runs/runs.jsonl");
    let kept = fs::read_to_string(&file).unwrap();
    for repetition in 1..4 {
        assert!(kept.contains(&format!("\"repetition\":{repetition}}}")), "{kept}");
    }
    let runs = log(&folder).len();
    assert!(kept.lines().count() == runs + 1 && runs <= 40);
    // a diagnosis that was interrupted in the midst of the repeats makes none again
    let half: Vec<&str> = kept.lines().take(runs / 2).collect();
    let (again, _) = diagnosed(&folder, &arguments);
    assert_eq!((&again, log(&folder).len()), (&first, runs));
    fs::write(&file, half.join("\n") + "\n").unwrap();
    diagnosed(&folder, &arguments);
    assert_eq!(
        log(&folder).len(),
        runs + fs::read_to_string(&file).unwrap().lines().count() - half.len()
    );
}

#[test]
fn runs_are_designed_and_made_elsewhere() {
    let folder = pendulum("print(answer(sys.stdin.read()))");
    let made = folder.path().join("made");
    fs::create_dir(&made).unwrap();
    let done = gap(&folder, &["--design", "made/parameters.csv"]).output().unwrap();
    assert!(done.status.success() && done.stdout.is_empty() && done.stderr.is_empty());
    let table = fs::read_to_string(made.join("parameters.csv")).unwrap();
    assert_eq!(
        (table.lines().count(), table.lines().next()),
        (41, Some("run,length [m],drag [1/s]"))
    );
    for line in table.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let angle = (0..60).map(|row| {
            let t = 0.05 * f64::from(row);
            200.0 * (-cells[2] * t).exp() * ((9.81 / cells[1]).sqrt() * t).cos()
        });
        let answer = serde_json::json!({ "angle": angle.collect::<Vec<f64>>() });
        fs::write(made.join(format!("{}.json", cells[0])), answer.to_string()).unwrap();
    }
    let (answer, _) = diagnosed(&folder, &["--made", "made", "--design", "more.csv"]);
    assert_drag(&answer);
    // what they leave open is to be run near the posteriors, with the numbers that follow
    let more = fs::read_to_string(folder.path().join("more.csv")).unwrap();
    let mut lines = more.lines();
    assert_eq!(lines.next(), table.lines().next());
    assert!(lines.next().is_none_or(|line| line.starts_with("41,")), "{more}");
}

#[test]
fn options_of_a_simulator_need_one_another() {
    let folder = pendulum("");
    let plain = root().join("models/gap/sampling_rate/case.json");
    let plain = plain.to_str().unwrap();
    let failure = |arguments: &[&str]| {
        let done =
            command().current_dir(folder.path()).arg("gap").args(arguments).output().unwrap();
        assert_eq!(done.status.code(), Some(2));
        String::from_utf8(done.stderr).unwrap().lines().next().unwrap().to_owned()
    };
    let none = "gumption: the outputs of this case come from a simulator: add --simulator COMMAND to \
                run it, --made FOLDER to use runs that were made, or --design FILE to write which runs \
                to make";
    assert_eq!(failure(&["case.json"]), none);
    let shell = "gumption: `a | b` has `|`, but is started without a shell; write sh -c '...'";
    assert_eq!(failure(&["case.json", "--simulator", "a | b"]), shell);
    for arguments in
        [&["--simulator", "a", "--made", "b"][..], &["--simulator", "a", "--design", "b"]]
    {
        let message = failure(&[&["case.json"], arguments].concat());
        assert!(message.contains("cannot be used with"), "{message}");
    }
    for arguments in [["--keep", "a"], ["--run-timeout", "1"]] {
        let message = failure(&[&["case.json"][..], &arguments].concat());
        assert_eq!(message, "error: the following required arguments were not provided:");
    }
    let message = failure(&["case.json", "--simulator", "a", "--run-timeout", "0"]);
    assert!(message.ends_with("a positive number of seconds is needed, such as 60 or 0.5"));
    let message = failure(&["case.json", "--design", "a", "--runs", "10"]);
    assert_eq!(message, "gumption: the simulator has to be run 14 times at least");
    for option in ["--simulator", "--made", "--design"] {
        let message = failure(&[plain, option, "a"]);
        let reason =
            "needs a case whose outputs come from a simulator; this case has no `simulator`";
        assert_eq!(message, format!("gumption: `{option}` {reason}"));
    }
}
