//! The bits of gumption's random numbers, without end, for a test battery (benches/generator.sh).
//!
//! ```text
//! cargo run --release --example random_bits -- blocks | dieharder -g 200 -a
//! ```
//!
//! The numbers are the draws of rectangular quantities on (0, 1), which are odd multiples of 2^-53:
//! all 52 random bits of each are written, the highest first. Their order is one of
//!
//! - `trials`: one quantity, trial after trial;
//! - `blocks`: one quantity, of 1024 blocks the first trials, then the second ones, and so on:
//!   neighbours are from generators that start from neighbouring blocks;
//! - `inputs`: 64 quantities in turn;
//! - `seeds`: one quantity under 64 seeds in turn.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::print_stderr)]

use std::error::Error;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;

use gumption::file::read_text;
use gumption::propagate::{Control, evaluate, for_each_block};
use gumption::task::{Task, Trials};
use serde_json::{Map, json};

type Failure = Box<dyn Error + Send + Sync>;

/// Streams that are interleaved.
const STREAMS: u64 = 64;

/// Blocks that are interleaved.
const BLOCKS: usize = 1024;

/// Blocks that a stream is ahead of its reader, at most.
const AHEAD: usize = 4;

/// More trials than anybody reads.
const WITHOUT_END: u64 = 1 << 50;

const USAGE: &str = "random_bits trials|blocks|inputs|seeds";

/// As many rectangular quantities on (0, 1), each its own output.
fn task(quantities: u64, seed: u64) -> Result<Task, Failure> {
    let names = || (1..=quantities).map(|i| (format!("x_{i}"), format!("y_{i}")));
    let shape = json!({"distribution": "rectangular", "lower": 0, "upper": 1});
    let inputs: Map<_, _> = names().map(|(x, _)| (x, shape.clone())).collect();
    let equations: Map<_, _> = names().map(|(x, y)| (y, json!(x))).collect();
    let outputs: Map<_, _> = names().map(|(_, y)| (y, json!({}))).collect();
    let model = json!({"format": 1, "inputs": inputs, "equations": equations, "outputs": outputs});
    let file = read_text("random bits", &model.to_string(), "".as_ref(), &[]);
    let mut task = file.map_err(|problems| problems.to_string())?.task;
    task.settings.seed = seed;
    task.settings.trials = Trials::Fixed(1);
    Ok(task)
}

/// Hands over the blocks of a task's outputs without end.
fn blocks(
    task: &Task,
    mut take: impl FnMut(&[Vec<f64>]) -> Result<(), Failure> + Send,
) -> Result<(), Failure> {
    let control = Control::default().with_threads(1);
    let mut evaluation = evaluate(task, &control)?;
    let figures = evaluation.rows.iter_mut().flat_map(|row| &mut row.outputs);
    for figures in figures.filter_map(|output| output.monte_carlo.as_mut()) {
        figures.trials = WITHOUT_END;
    }
    for_each_block(task, &evaluation, 0, &control, |values| take(values))?;
    Ok(())
}

/// The blocks of one quantity under a seed, made on a thread of their own.
fn stream(seed: u64) -> Result<Receiver<Vec<f64>>, Failure> {
    let (sender, receiver) = sync_channel(AHEAD);
    let task = task(1, seed)?;
    thread::spawn(move || {
        // ends when nobody reads any more
        blocks(&task, |values| Ok(sender.send(values.concat())?))
    });
    Ok(receiver)
}

/// Writes the bits of numbers one after another.
struct Bits<W> {
    to: W,
    waiting: u128,
    count: u32,
    bytes: Vec<u8>,
}

impl<W: Write> Bits<W> {
    fn new(to: W) -> Self {
        Self { to, waiting: 0, count: 0, bytes: Vec::new() }
    }

    fn put(&mut self, value: f64) -> Result<(), Failure> {
        let scaled = value * 2f64.powi(53);
        let odd = scaled as u64;
        if odd as f64 != scaled || odd.is_multiple_of(2) {
            return Err(format!("{value} is no odd multiple of 2^-53 on (0, 1)").into());
        }
        self.waiting = (self.waiting << 52) | u128::from(odd >> 1);
        self.count += 52;
        while self.count >= 32 {
            self.count -= 32;
            self.bytes.extend(((self.waiting >> self.count) as u32).to_ne_bytes());
        }
        if self.bytes.len() >= 1 << 16 {
            self.to.write_all(&self.bytes)?;
            self.bytes.clear();
        }
        Ok(())
    }

    /// The numbers of all streams in turn.
    fn in_turn(&mut self, streams: &[Vec<f64>]) -> Result<(), Failure> {
        let length = streams.iter().map(Vec::len).min().unwrap_or(0);
        for place in 0..length {
            for values in streams {
                self.put(values[place])?;
            }
        }
        Ok(())
    }
}

fn write(order: &str) -> Result<(), Failure> {
    let mut bits = Bits::new(std::io::stdout());
    match order {
        "trials" => blocks(&task(1, 1)?, |values| bits.in_turn(values)),
        "blocks" => {
            let mut held = Vec::new();
            blocks(&task(1, 1)?, |values| {
                held.push(values.concat());
                if held.len() == BLOCKS {
                    bits.in_turn(&held)?;
                    held.clear();
                }
                Ok(())
            })
        }
        "inputs" => blocks(&task(STREAMS, 1)?, |values| bits.in_turn(values)),
        "seeds" => {
            let streams: Vec<_> = (1..=STREAMS).map(stream).collect::<Result<_, _>>()?;
            loop {
                let values: Vec<_> =
                    streams.iter().map(Receiver::recv).collect::<Result<_, _>>()?;
                bits.in_turn(&values)?;
            }
        }
        _ => Err(format!("`{order}` is no order; usage: {USAGE}").into()),
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [order] = arguments.as_slice() else {
        eprintln!("usage: {USAGE}");
        return ExitCode::from(2);
    };
    match write(order) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => match error.downcast_ref::<std::io::Error>() {
            // the battery has read enough
            Some(error) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
            _ => {
                eprintln!("error: {error}");
                ExitCode::from(2)
            }
        },
    }
}
