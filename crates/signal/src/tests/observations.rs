//! Whether what is stated of whole observations is right: errors over standard uncertainties in
//! situations that are easily got wrong.

use std::f64::consts::PI;

use super::simulated::Bench;
use super::study::figures;
use crate::study::Errors;
use crate::{ChannelStep, Method};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};

/// A bench, what it is about, and the figures that count.
pub(super) struct Situation {
    about: &'static str,
    bench: Bench,
    counts: &'static [&'static str],
}

const ALL: &[&str] = &["amplitude 1", "phase 1", "offset", "amplitude 2", "phase 2"];
const MAIN: &[&str] = &["amplitude 1", "phase 1", "offset"];
const RATIOS: &[&str] = &["amplitude 1", "phase 1", "offset", "SNR", "SINAD"];

/// 23 periods at 1 kHz, as a record of the bench for accelerometers has them.
fn plain() -> Bench {
    Bench { hertz: 7.3, samples: 3150, ..Bench::default() }
}

/// Two channels that wander off over 3.5 periods, with so much of their noise in common.
fn walks(common: f64) -> Bench {
    Bench {
        hertz: 5.0,
        samples: 700,
        channels: vec![vec![(2.0, 0.3), (0.02, 1.0)], vec![(1.5, 0.3), (0.01, 0.4)]],
        memory: 1.0,
        common,
        ..Bench::default()
    }
}

fn situations() -> Vec<Situation> {
    let of = |about, counts, bench| Situation { about, bench, counts };
    let plain = plain();
    let near = vec![vec![(1.0, 0.3), (0.02, 1.0)], vec![(0.9, 0.1), (0.01, 0.4)]];
    // 1.5 over 0.05: 30 steps; the second channel has 15
    let coarse = |step: f64, noise: f64, hertz: f64, samples: usize| Bench {
        channels: vec![vec![(1.5, 0.3), (0.02, 1.0)], vec![(1.5, -1.2), (0.02, 0.4)]],
        resolution: step,
        noise: noise * step,
        hertz,
        samples,
        ..plain.clone()
    };
    let jitter =
        |jitter: f64| Bench { jitter, noise: 1e-4, samples: 3210, trials: 2000, ..plain.clone() };
    vec![
        of("white", RATIOS, Bench { trials: 2000, ..plain.clone() }),
        of("jitter 0.2 ms", MAIN, jitter(0.2e-3)),
        of("jitter 1 ms", MAIN, jitter(1e-3)),
        of("jitter 8 ms", MAIN, jitter(8e-3)),
        of("AR(1) 0.9", MAIN, Bench { memory: 0.9, ..plain.clone() }),
        of("AR(1) 0.97", MAIN, Bench { memory: 0.97, ..plain.clone() }),
        of("AR(1) 0.99", MAIN, Bench { memory: 0.99, ..plain.clone() }),
        of("AR(1) -0.9", MAIN, Bench { memory: -0.9, ..plain.clone() }),
        of("random walk", MAIN, Bench { memory: 1.0, noise: 0.001, ..plain.clone() }),
        of("walks, 3.5 periods", MAIN, walks(0.0)),
        // the phase's u has leakage of the peaks of a walk's spectrum as well, which the two have in
        // common too: its score is 0.81
        of("common walks, 3.5 periods", &["amplitude 1", "offset"], walks(0.8)),
        of("AR(1) 0.95, 5 periods", MAIN, Bench { memory: 0.95, samples: 685, ..plain.clone() }),
        of("AR(1) 0.95, 3 periods", MAIN, Bench { memory: 0.95, samples: 411, ..plain.clone() }),
        of("steps of 1/30, noise 0.1 LSB", ALL, coarse(0.05, 0.1, 7.3, 3150)),
        of("steps of 1/30, noise 0.01 LSB", ALL, coarse(0.05, 0.01, 7.3, 3150)),
        of("steps of 1/7.5, noise 0.01 LSB", MAIN, coarse(0.2, 0.01, 7.3, 3150)),
        of("coherent, noise 0.002 LSB", ALL, coarse(0.05, 0.002, 8.0, 1000)),
        of("coherent, noise 0.1 LSB", ALL, coarse(0.05, 0.1, 8.0, 1000)),
        of("coherent, noise 0.3 LSB", ALL, coarse(0.05, 0.3, 8.0, 1000)),
        of("steps of 1/30, trials", ALL, Bench { trials: 2000, ..coarse(0.05, 0.01, 7.3, 3150) }),
        of("steps of 1/7.5, trials", MAIN, Bench { trials: 2000, ..coarse(0.2, 0.01, 7.3, 3150) }),
        of("resolution not stated", ALL, Bench { hidden: true, ..coarse(0.05, 0.1, 8.0, 1000) }),
        of("common noise", MAIN, Bench { common: 0.6, channels: near.clone(), ..plain.clone() }),
        of("opposite noise", MAIN, Bench { common: -0.8, channels: near.clone(), ..plain.clone() }),
        of(
            "common noise with a memory",
            MAIN,
            Bench { common: 0.6, memory: 0.9, channels: near, ..plain.clone() },
        ),
        of(
            "frequency off",
            RATIOS,
            Bench { frequency_uncertainty: 0.01, noise: 1e-3, ..plain.clone() },
        ),
        of("tone 1.3 Hz beside", ALL, Bench { beside: Some((1.3, 0.2)), ..plain.clone() }),
        of("tone 0.5 Hz beside", MAIN, Bench { beside: Some((0.5, 0.2)), ..plain.clone() }),
        of("tone 0.4 Hz below", MAIN, Bench { beside: Some((-0.4, 0.05)), ..plain.clone() }),
        of(
            "tone 1.3 Hz beside, estimated",
            MAIN,
            Bench { beside: Some((1.3, 0.2)), estimate: true, ..plain.clone() },
        ),
        of(
            "tone 1.3 Hz beside, frequency off",
            MAIN,
            Bench {
                beside: Some((1.3, 0.2)),
                frequency_uncertainty: 0.01,
                noise: 1e-3,
                ..plain.clone()
            },
        ),
        of(
            "tone 1.3 Hz beside, AR(1) 0.9",
            MAIN,
            Bench { beside: Some((1.3, 0.2)), memory: 0.9, ..plain.clone() },
        ),
        of(
            "tone 1.3 Hz beside, trials",
            MAIN,
            Bench { beside: Some((1.3, 0.2)), trials: 2000, ..plain.clone() },
        ),
        of(
            "hum beside",
            &["offset"],
            Bench { hertz: 5.0, samples: 1730, beside: Some((45.03, 0.3)), ..Bench::default() },
        ),
        of(
            "hum next to a folded multiple",
            MAIN,
            Bench {
                rate: 2000.0,
                hertz: 20.1,
                samples: 4000,
                beside: Some((29.9, 0.3)),
                ..Bench::default()
            },
        ),
        of("bins", RATIOS, Bench { method: Method::Fft, noise: 1e-3, ..plain.clone() }),
        of(
            "trend removed",
            &["amplitude 1", "phase 1", "SNR", "SINAD"],
            Bench {
                steps: vec![ChannelStep::RemoveTrend],
                noise: 1e-3,
                samples: 3210,
                ..plain.clone()
            },
        ),
    ]
}

/// Runs `count` recordings and gives each figure's errors.
fn errors(situation: &Situation, count: u64) -> Vec<(String, Errors)> {
    let mut all: Vec<(String, Errors)> = Vec::new();
    for seed in 0..count {
        // levels, sizes and phases that change, as those of real recordings do
        let mut bench = situation.bench.clone();
        let turn = |times: f64| (seed as f64 * 0.618_033_988_749_895 * times).fract();
        bench.offset += 3.7 * bench.resolution * turn(1.0);
        for (number, channel) in bench.channels.iter_mut().enumerate() {
            channel[0].0 *= 1.0 + 0.05 * turn(7.3 + number as f64);
            // channels that move together where they have their noise in common
            let own = if bench.common == 0.0 { number as f64 } else { 0.0 };
            channel[0].1 += 2.0 * PI * turn(3.1 - own);
        }
        let observation = bench.observe(bench.values(seed));
        let [root, of] = observation.frequencies[0].as_slice() else { panic!() };
        let figures = figures(&bench, of, root).into_iter();
        let figures = figures.filter(|(name, ..)| situation.counts.contains(&name.as_str()));
        for (number, (name, found, truth)) in figures.enumerate() {
            if all.len() <= number {
                all.push((name, Errors::default()));
            }
            all[number].1.add(found, truth);
        }
    }
    all
}

/// Scores of `count` recordings of situations, printed; those outside of limits.
fn outside(situations: &[Situation], count: u64, limits: [f64; 2]) -> Vec<String> {
    let mut wrong = Vec::new();
    for situation in situations {
        for (name, errors) in errors(situation, count) {
            let score = errors.score();
            let inside = limits[0] <= score && score <= limits[1];
            let mark = if inside { "" } else { "  <<<" };
            println!("{:32} {name:14} {score:7.3}{mark}", situation.about);
            if !inside {
                wrong.push(format!("{} {name} {score:.3}", situation.about));
            }
        }
    }
    wrong
}

/// The root mean square of error over standard uncertainty of each figure. Of normal errors it has a
/// standard deviation of 4 %, so that limits of 15 % are passed by one right figure in 5000.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn standard_scores_of_300_recordings() {
    let wrong = outside(&situations(), 300, [0.85, 1.15]);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The quick form: 30 recordings of the situations whose figures were once furthest off, but for two tones
/// beside a frequency that is estimated or off, which take as long as all others. The standard
/// deviation of a score is 13 %; fixed seeds, so that a test that passes once passes always.
#[test]
fn standard_scores_of_30_recordings() {
    let quick = [
        "jitter 1 ms",
        "AR(1) 0.99",
        "AR(1) -0.9",
        "random walk",
        "walks, 3.5 periods",
        "common walks, 3.5 periods",
        "AR(1) 0.95, 5 periods",
        "coherent, noise 0.1 LSB",
        "resolution not stated",
        "common noise",
        "frequency off",
        "tone 1.3 Hz beside",
        "tone 0.5 Hz beside",
        "hum beside",
        "hum next to a folded multiple",
        "bins",
        "trend removed",
    ];
    let quick: Vec<Situation> =
        situations().into_iter().filter(|of| quick.contains(&of.about)).collect();
    let wrong = outside(&quick, 30, [0.6, 1.5]);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The first note of one recording with this code.
fn noted(bench: &Bench, code: &str) -> Option<Fact> {
    let observation = bench.observe(bench.values(1));
    observation.notes.into_iter().map(|note| note.fact).find(|fact| fact.code() == code)
}

/// What stands at a place of a fact.
fn argument<'f>(fact: &'f Fact, name: &str) -> &'f Argument {
    let found = fact.arguments.iter().find(|(known, _)| *known == name);
    &found.unwrap_or_else(|| panic!("{name}: {fact:?}")).1
}

#[test]
fn what_is_seen_in_a_recording_is_said() {
    let plain = plain();
    for code in ["looks-quantized", "coherent-sampling", "common-noise", "wandering-level"] {
        assert_eq!(noted(&plain, code), None);
    }
    let coherent = Bench {
        hertz: 8.0,
        samples: 1000,
        noise: 0.002,
        resolution: 0.05,
        hidden: true,
        ..plain.clone()
    };
    let (step, name) = (Argument::number("0.05"), "a");
    let quantized = noted(&coherent, "looks-quantized");
    assert_eq!(quantized, Some(fact!("looks-quantized", name, step)));
    let phases = noted(&coherent, "coherent-sampling").unwrap();
    assert_eq!(argument(&phases, "samples"), &Argument::number("1000"));
    assert_eq!(argument(&phases, "phases"), &Argument::number("125"));
    let stated = Bench { hidden: false, ..coherent };
    assert_eq!(noted(&stated, "looks-quantized"), None);
    let wandering = noted(&Bench { memory: 1.0, ..plain.clone() }, "wandering-level");
    assert_eq!(wandering, Some(fact!("wandering-level", name)));
    // phases that are near each other: the errors of phases a quarter of a turn apart have nothing
    // in common
    let near = vec![vec![(1.0, 0.3), (0.02, 1.0)], vec![(0.9, 0.1), (0.01, 0.4)]];
    let common = Bench { common: 0.6, channels: near, ..plain.clone() };
    assert_eq!(noted(&common, "common-noise").unwrap().key, "common-noise");
    // within its uncertainty a frequency that is off is no news; far outside it is
    let off = Bench { frequency_uncertainty: 0.01, ..plain.clone() };
    assert_eq!(noted(&off, "frequency-differs"), None);
}

/// Records that wander off each by itself are correlated by chance, and noise in common is found all
/// the same. Of 33 coefficients of correlation of independent innovations one is beyond four standard
/// deviations in 500 records; more than 3 of 100 records have a probability of 6e-5. With a
/// correlation of 0.8 of 700 innovations each record tells.
#[test]
fn independent_walks_have_nothing_in_common() {
    let said = |bench: &Bench, seed: u64| {
        let notes = bench.observe(bench.values(seed)).notes;
        notes.into_iter().any(|note| note.code() == "common-noise")
    };
    // noise with a memory of a tenth of the record, and means of every second value of a long one
    let memory = Bench { memory: 0.98, ..walks(0.0) };
    let long = Bench { hertz: 0.5, samples: 7000, ..walks(0.0) };
    for (bench, records) in [(walks(0.0), 100), (memory, 100), (long, 20)] {
        let flagged = (0..records).filter(|seed| said(&bench, *seed)).count();
        println!("{flagged} of {records}");
        assert!(flagged <= 3, "{bench:?}: {flagged} of {records}");
        let common = Bench { common: 0.8, ..bench };
        assert!((0..20).all(|seed| said(&common, seed)), "{common:?}");
    }
}

/// A tone beside the signal is found, fitted and named; one within 1/T cannot be told apart, and the
/// answer says so. Before, the tone's leakage made u five times too large.
#[test]
fn a_tone_beside_is_fitted_or_said_to_be_too_near() {
    let plain = plain();
    let of = |hertz: f64| Bench { beside: Some((hertz, 0.2)), ..plain.clone() };
    for code in ["found-tone", "tones-too-near"] {
        assert_eq!(noted(&plain, code), None);
    }
    // the frequency of the only tone
    let found = |bench: &Bench| {
        let fact = noted(bench, "found-tone")?;
        let Argument::List(tones) = argument(&fact, "tones") else { panic!("{fact:?}") };
        let [Argument::Fact(tone)] = &tones[..] else { panic!("{tones:?}") };
        let Argument::Number(frequency) = argument(tone, "frequency") else { panic!("{tone:?}") };
        Some(frequency.clone())
    };
    let frequency = found(&of(1.3)).unwrap();
    assert!(frequency.starts_with("8.599"), "{frequency}");
    let near = noted(&of(0.1), "tones-too-near").unwrap();
    assert_eq!(argument(&near, "within"), &Argument::number("0.32"));
    assert_eq!(found(&of(0.1)), None);
    // of the channel where it is alone
    let mut held = plain.values(1);
    held.channels[1] = of(0.1).values(1).channels.remove(1);
    let notes = plain.observe(held).notes;
    let channels: Vec<_> =
        notes.iter().filter(|of| of.code() == "tones-too-near").map(|of| of.channel).collect();
    assert_eq!(channels, [1]);
    // the 97th multiple of 20.1 Hz is folded to 50.3 Hz
    let hum = Bench {
        rate: 2000.0,
        hertz: 20.1,
        samples: 4000,
        beside: Some((29.9, 0.3)),
        ..Bench::default()
    };
    let frequency = found(&hum).unwrap();
    let is_it = frequency == "50" || ["49.99", "50.00"].iter().any(|of| frequency.starts_with(of));
    assert!(is_it, "{frequency}");
    let bench = of(1.3);
    let observation = bench.observe(bench.values(1));
    let first = &observation.frequencies[0][0];
    assert!(first.spurious[0].fitted && (first.spurious[0].amplitude - 0.2).abs() < 0.002);
    // sqrt(2/3150) of noise of 0.01
    let u = first.components[0].amplitude.measured.standard_uncertainty;
    assert!((u / 2.52e-4 - 1.0).abs() < 0.1, "{u}");
}

/// A level that moves steadily is fitted with the oscillations: their errors are those of the noise,
/// where they were three standard uncertainties and more; noise that walks is no drift.
#[test]
fn a_drift_is_fitted() {
    let bench = Bench { samples: 1000, noise: 0.02, ..Bench::default() };
    let shapes: [fn(f64) -> f64; 3] =
        [|x| 0.3 * x, |x| 0.3 * (-x / 0.3).exp(), |x| 0.2 * (2.6 * PI * x).sin()];
    let mut squares = [0.0; 3];
    let mut count = 0.0;
    for seed in 0..40 {
        let mut held = bench.values(seed);
        for values in &mut held.channels {
            let shape = shapes[(seed % 3) as usize];
            (0_u32..).zip(values).for_each(|(i, value)| *value += shape(f64::from(i) / 1000.0));
        }
        let observation = bench.observe(held);
        for channel in [0, 1] {
            let is_told = observation
                .notes
                .iter()
                .any(|of| (of.code(), of.channel) == ("found-drift", channel));
            assert!(is_told);
        }
        let second = &observation.frequencies[0][1].components[0];
        let first = &observation.frequencies[0][0].components[0];
        // the level before the drift is within two of the drift's standard deviations from its mean
        let level = observation.frequencies[0][0].offset.measured;
        assert!((level.value - 0.7).abs() < 2.0 * level.standard_uncertainty, "{level:?}");
        // sqrt(2/1000) of the noise, and for the phase of both channels over their sizes; a tenth more
        // for what the drift costs and u is known to
        let found = [
            (&first.amplitude, 1.0, 8.9e-4),
            (&second.amplitude, 0.5, 8.9e-4),
            (&second.phase, -1.5, 2.0e-3),
        ];
        for (square, (found, truth, u)) in squares.iter_mut().zip(found) {
            let found = found.measured;
            *square += ((found.value - truth) / found.standard_uncertainty).powi(2);
            assert!(found.standard_uncertainty < 1.1 * u, "{}", found.standard_uncertainty);
        }
        count += 1.0;
    }
    for square in squares {
        // the mean square of 40 standard normal numbers: below 2 but for one set in 10 000
        assert!(square / count < 2.0, "{}", square / count);
    }
    let walk = Bench { memory: 1.0, noise: 0.002, ..bench };
    let drifts = |seed: &u64| {
        walk.observe(walk.values(*seed)).notes.iter().any(|of| of.code() == "found-drift")
    };
    assert_eq!((0..40).filter(drifts).count(), 0);
}

/// A stated frequency with an uncertainty gives way to what the recording tells only within it.
#[test]
fn a_wrong_frequency_stays_wrong() {
    let bench = Bench { noise: 1e-3, ..plain() };
    // the recording has 7.3 Hz, the recipe says 7.4(1) mHz beside it
    let held = bench.values(1);
    let wrong = Bench { hertz: 7.4, frequency_uncertainty: 0.001, ..bench.clone() };
    let observation = wrong.observe(held.clone());
    assert!(observation.notes.iter().any(|note| note.code() == "frequency-differs"));
    let near = Bench { hertz: 7.303, frequency_uncertainty: 0.002, ..bench };
    let amplitude = |bench: &Bench| {
        let observation = bench.observe(held.clone());
        observation.frequencies[0][0].components[0].amplitude.measured
    };
    // 3 mHz over 3 s leave 1e-4 of the amplitude by the stated frequency; here its own is left
    let found = amplitude(&near);
    assert!((found.value - 1.0).abs() < 3.0 * found.standard_uncertainty);
    assert!(found.standard_uncertainty < 4e-5, "{}", found.standard_uncertainty);
}

/// Scores of the second channel of 100 recordings of 17 periods whose sizes, phases and levels are
/// spread over a step and more, and how many of the 200 channels are said to look quantized.
fn of_coarse_steps(bench: &Bench) -> (Vec<(String, f64)>, usize) {
    let mut all: Vec<(String, Errors)> = Vec::new();
    let mut noticed = 0;
    for seed in 0..100 {
        let even = |by: f64| (seed as f64 * by).fract();
        let channel = |least: f64, of_size: f64, of_phase: f64| {
            vec![(least + even(of_size), 2.0 * PI * even(of_phase)), (0.0, 0.0)]
        };
        let channels = vec![channel(1.5, 0.7549, 0.6180), channel(1.0, 0.5698, 0.4142)];
        let bench = Bench {
            hertz: 17.3123,
            samples: 1000,
            noise: 0.02,
            hidden: true,
            offset: 2.0 * even(0.8192) - 1.0,
            channels,
            ..bench.clone()
        };
        let observation = bench.observe(bench.values(seed));
        noticed += observation.notes.iter().filter(|of| of.code() == "looks-quantized").count();
        let [root, of] = observation.frequencies[0].as_slice() else { panic!() };
        let figures = figures(&bench, of, root).into_iter();
        let figures = figures.filter(|(name, ..)| MAIN.contains(&name.as_str()));
        for (number, (name, found, truth)) in figures.enumerate() {
            if all.len() <= number {
                all.push((name, Errors::default()));
            }
            all[number].1.add(found, truth);
        }
    }
    let scores = all.into_iter().map(|(name, errors)| (name, errors.score())).collect();
    (scores, noticed)
}

/// Values on two to five levels, steps that nobody stated: before they were noticed the amplitude's
/// score was 16. The score of 100 recordings scatters by 1/sqrt(200), 7 %; the error of a rounded
/// sine has short tails, and its phase is that of the few samples beside a step, which is known to a
/// factor of two.
#[test]
fn a_few_levels_are_noticed() {
    let (scores, noticed) = of_coarse_steps(&Bench { resolution: 1.0, ..plain() });
    println!("{scores:?}");
    assert_eq!(noticed, 200);
    for (name, score) in scores {
        assert!((0.4..1.3).contains(&score), "{name}: {score}");
    }
}

/// Phases of five to nine levels: what rounding scatters was left out of the noise near the tone a
/// second time, and the score was 1.5. Four times its scatter of 7 % is allowed (one false failure in
/// 10^4).
#[test]
fn phases_of_coarse_steps() {
    let (scores, _) = of_coarse_steps(&Bench { resolution: 0.5, ..plain() });
    println!("{scores:?}");
    for (name, score) in scores {
        let least = if name.starts_with("phase") { 0.72 } else { 0.6 };
        assert!((least..1.28).contains(&score), "{name}: {score}");
    }
}

/// Records of 1.3 periods whose noise has a memory of first order: 60 records have a score to within
/// 1/sqrt(120), 9 %, if the noise were known, and its own uncertainty on top. Scores were 2 to 3.5 where
/// one record in two passed for white.
#[test]
fn short_records_of_noise_with_a_memory() {
    for memory in [0.5, 0.8] {
        let bench = Bench { hertz: 17.3, samples: 75, noise: 0.02, memory, ..Bench::default() };
        let counts = &["amplitude 1", "phase 1"];
        let situation = Situation { about: "short", bench, counts };
        for (name, errors) in errors(&situation, 60) {
            println!("{memory} {name}: {}", errors.score());
            assert!((0.3..1.45).contains(&errors.score()), "{memory} {name}: {}", errors.score());
        }
    }
}

/// A channel with neither of two components is told in 95 of 100 records for each of them, 90 for both;
/// one with six times the standard uncertainty in exp(-(6 - 2.45)^2/2)/2, two of a thousand. Of 60 records
/// 54 are told, with a standard deviation of 2.3, four of which are left; of the others, none in nine of
/// ten runs (the seeds are fixed). Nor is one where the second component is clear.
#[test]
fn amplitudes_that_noise_alone_makes_are_told() {
    let told = |first: f64, second: f64| {
        // standard uncertainty of an amplitude: noise sqrt(2/n)
        let u = 0.01 * (2.0f64 / 2000.0).sqrt();
        let channels =
            vec![vec![(1.0, 0.2), (0.1, 0.3)], vec![(first * u, 0.7), (second * u, 0.1)]];
        let bench = Bench { channels, ..Bench::default() };
        let notes = (1..=60).flat_map(|seed| bench.observe(bench.values(seed)).notes);
        let near = notes.filter(|of| of.code() == "near-noise" && of.channel == 1);
        let near: Vec<Fact> = near.map(|note| note.fact).collect();
        let is_first = |of: &Fact| *argument(of, "frequency") == Argument::number("10.3");
        assert!(near.iter().all(is_first), "{near:?}");
        near.len()
    };
    assert!((45..=60).contains(&told(0.0, 0.0)));
    assert_eq!(told(6.0, 0.0), 0);
    assert_eq!(told(0.0, 100.0), 0);
}
