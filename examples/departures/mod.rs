//! Benches with effects that no list of theirs has: what composed effects are measured on.
//!
//! Eight benches with four withheld effects each. The effects were written before the composer was
//! tried on them; a good part has no form of the composer's list (a Lorentzian, a logistic step, a
//! power of 0.7, a threshold, an even function of an angle), and then the nearest one counts.

// each program uses a part of it
#![allow(dead_code)]

use std::f64::consts::TAU;

use super::generator::SplitMix64;
use crate::ComposedEffect;

/// An effect that is withheld: what it does to the outputs, and what names it rightly.
pub(crate) struct Withheld {
    pub(crate) name: &'static str,
    /// From inputs, conditions and a size to the outputs.
    pub(crate) sim: fn(&[f64], &[f64], f64) -> Vec<f64>,
    /// The quantities that name it, and what it is a function of; "" for a constant.
    pub(crate) quantities: &'static [&'static str],
    pub(crate) over: &'static [&'static str],
    /// The forms that name it.
    pub(crate) forms: &'static [&'static str],
    /// Whether its size may be chosen, since the departure is proportional to it.
    pub(crate) scales: bool,
}

impl Withheld {
    /// Whether a composed effect has the right quantity and argument, and the form as well.
    pub(crate) fn is_named_by(&self, of: &ComposedEffect) -> (bool, bool) {
        let [quantity, over, form] = said(of);
        let place = of.terms.len() == 1
            && self.quantities.contains(&quantity.as_str())
            && self.over.contains(&over.as_str());
        (place, place && self.forms.contains(&form.as_str()))
    }
}

/// What a composed effect says: its quantities, what it is a function of ("" for a constant), its form.
pub(crate) fn said(of: &ComposedEffect) -> [String; 3] {
    let first = &of.terms[0];
    let over = first.over.name().unwrap_or_default();
    [first.quantities.join("+"), over.to_owned(), first.form.name().to_owned()]
}

/// A sim with its inputs (unit, mean, standard uncertainty), conditions and outputs.
pub(crate) struct Bench {
    pub(crate) name: &'static str,
    pub(crate) inputs: &'static [(&'static str, &'static str, f64, f64)],
    pub(crate) conditions: &'static [(&'static str, &'static str)],
    pub(crate) rows: fn() -> Vec<Vec<f64>>,
    pub(crate) equations: &'static [(&'static str, &'static str)],
    pub(crate) outputs: &'static [(&'static str, &'static str, f64)],
    /// Effects of the list: name, parameter's unit and standard deviation, what is overridden, and how.
    pub(crate) listed: &'static [(&'static str, &'static str, f64, &'static str, &'static str)],
    pub(crate) withheld: [Withheld; 4],
}

/// All combinations of two conditions' values.
fn product(a: &[f64], b: &[f64]) -> Vec<Vec<f64>> {
    a.iter().flat_map(|&a| b.iter().map(move |&b| vec![a, b])).collect()
}

fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}

pub(crate) const BENCHES: [Bench; 8] = [
    Bench {
        name: "photometer",
        inputs: &[("I", "cd", 100.0, 0.05), ("d0", "m", 0.0, 0.0002)],
        conditions: &[("d", "m"), ("T", "degC")],
        rows: || {
            product(&[0.5, 0.6, 0.8, 1.0, 1.3, 1.6, 2.0, 2.5, 3.0], &[18.0, 20.5, 23.0, 25.5, 28.0])
        },
        equations: &[("r", "d + d0"), ("E", "I/r^2")],
        outputs: &[("E", "cd/m^2", 0.05)],
        listed: &[("lamp-ageing", "%", 0.5, "I", "I*(1 + p)")],
        withheld: [
            Withheld {
                name: "stray light",
                sim: |x, c, k| vec![x[0] / (c[0] + x[1]).powi(2) + k],
                quantities: &["E"],
                over: &[""],
                forms: &["constant"],
                scales: true,
            },
            Withheld {
                name: "receiving plane behind the mark",
                sim: |x, c, k| vec![x[0] / (c[0] + x[1] + k).powi(2)],
                quantities: &["r"],
                over: &[""],
                forms: &["constant"],
                scales: true,
            },
            Withheld {
                name: "detector not linear",
                sim: |x, c, k| {
                    let e = x[0] / (c[0] + x[1]).powi(2);
                    vec![e * (1.0 + k * (e / 400.0).powf(0.7))]
                },
                quantities: &["E"],
                // in this design the value is a function of the distance
                over: &["value", "d"],
                forms: &["power", "root", "reciprocal"],
                scales: true,
            },
            Withheld {
                name: "temperature coefficient",
                sim: |x, c, k| vec![x[0] / (c[0] + x[1]).powi(2) * (1.0 + k * (c[1] - 23.0))],
                quantities: &["E"],
                over: &["T"],
                forms: &["slope"],
                scales: true,
            },
        ],
    },
    Bench {
        name: "torque transducer",
        inputs: &[("c", "mV/(N m)", 0.02, 2e-6), ("cz", "mV/(N m)", 0.003, 2e-6)],
        conditions: &[("M", "N m"), ("T", "degC")],
        rows: || {
            let torques: Vec<f64> = (-5..=5).map(|n| 20.0 * f64::from(n)).collect();
            product(&torques, &[10.0, 17.0, 25.0, 33.0, 40.0])
        },
        equations: &[("s", "c*M"), ("z", "cz*M")],
        outputs: &[("s", "mV", 0.0005), ("z", "mV", 0.0003)],
        listed: &[
            ("zero-of-s", "mV", 0.01, "s", "s + p"),
            ("gain-of-s", "%", 0.2, "s", "s*(1 + p)"),
        ],
        withheld: [
            Withheld {
                name: "backlash",
                sim: |x, c, k| vec![x[0] * c[0], x[1] * c[0] + if c[0] > 0.0 { k } else { 0.0 }],
                quantities: &["z"],
                over: &["M", "value"],
                forms: &["step"],
                scales: true,
            },
            Withheld {
                name: "cubic",
                sim: |x, c, k| vec![x[0] * c[0] + k * (c[0] / 100.0).powi(3), x[1] * c[0]],
                quantities: &["s"],
                over: &["M", "value"],
                forms: &["power"],
                scales: true,
            },
            Withheld {
                name: "gain over temperature",
                sim: |x, c, k| vec![x[0] * c[0], x[1] * c[0] * (1.0 + k * (c[1] - 25.0))],
                quantities: &["z"],
                over: &["T"],
                forms: &["slope"],
                scales: true,
            },
            Withheld {
                name: "hot amplifier",
                sim: |x, c, k| vec![x[0] * c[0] + k * ((c[1] - 40.0) / 6.0).exp(), x[1] * c[0]],
                quantities: &["s"],
                over: &["T"],
                forms: &["exponential"],
                scales: true,
            },
        ],
    },
    Bench {
        name: "vacuum gauge",
        inputs: &[("A", "1", 1.0, 2e-5)],
        conditions: &[("p", "kPa")],
        rows: || {
            let pressures = [5.0, 8.0, 12.0, 18.0, 25.0, 33.0, 42.0, 52.0, 62.0, 73.0, 85.0, 100.0];
            pressures.iter().flat_map(|&p| [vec![p], vec![p], vec![p]]).collect()
        },
        equations: &[("reading", "A*p")],
        outputs: &[("reading", "kPa", 0.01)],
        listed: &[("zero", "kPa", 0.1, "reading", "reading + p0")],
        withheld: [
            Withheld {
                name: "logarithmic",
                sim: |x, c, k| vec![x[0] * c[0] + k * (c[0] / 20.0).ln()],
                quantities: &["reading"],
                over: &["p", "value"],
                forms: &["logarithm"],
                scales: true,
            },
            Withheld {
                name: "square root",
                sim: |x, c, k| vec![x[0] * c[0] + k * c[0].sqrt()],
                quantities: &["reading"],
                over: &["p", "value"],
                forms: &["root"],
                scales: true,
            },
            Withheld {
                name: "Lorentzian line",
                sim: |x, c, k| vec![x[0] * c[0] + k / (1.0 + ((c[0] - 62.0) / 9.0).powi(2))],
                quantities: &["reading"],
                over: &["p", "value"],
                forms: &["bump", "second-order"],
                scales: true,
            },
            Withheld {
                name: "adsorption",
                sim: |x, c, k| vec![x[0] * c[0] + k * c[0] / (c[0] + 15.0)],
                quantities: &["reading"],
                over: &["p", "value"],
                forms: &["saturation", "first-order"],
                scales: true,
            },
        ],
    },
    Bench {
        name: "humidity sensor",
        inputs: &[("a", "1", 0.3, 2e-5), ("C0", "pF", 180.0, 0.01)],
        conditions: &[("rh", "%"), ("T", "degC")],
        rows: || {
            let humidities: Vec<f64> = (1..=9).map(|n| 10.0 * f64::from(n)).collect();
            let temperatures: Vec<f64> = (0..8).map(|n| 10.0 + 6.0 * f64::from(n)).collect();
            product(&humidities, &temperatures)
        },
        equations: &[("x", "a*rh"), ("C", "C0*(1 + x)")],
        outputs: &[("C", "pF", 0.02)],
        listed: &[("stray-capacitance", "pF", 0.5, "C", "C + p")],
        withheld: [
            Withheld {
                name: "quadratic",
                sim: |x, c, k| {
                    vec![x[1] * (1.0 + x[0] * c[0] / 100.0) + k * (c[0] / 100.0).powi(2)]
                },
                quantities: &["C", "x"],
                over: &["rh", "value"],
                // a share of x that is a slope is the same function
                forms: &["power", "slope"],
                scales: true,
            },
            Withheld {
                name: "transition",
                sim: |x, c, k| {
                    vec![
                        x[1] * (1.0 + x[0] * c[0] / 100.0)
                            * (1.0 + k * logistic((c[1] - 35.0) / 1.5)),
                    ]
                },
                quantities: &["C"],
                over: &["T"],
                forms: &["step"],
                scales: true,
            },
            Withheld {
                name: "thermostat ripple",
                sim: |x, c, k| {
                    vec![x[1] * (1.0 + x[0] * c[0] / 100.0) + k * (TAU * c[1] / 25.0 + 0.7).sin()]
                },
                quantities: &["C", "x"],
                over: &["T"],
                forms: &["wave"],
                scales: true,
            },
            Withheld {
                name: "condensation",
                sim: |x, c, k| {
                    let wet = (c[0] - 65.0).max(0.0) / 25.0;
                    vec![x[1] * (1.0 + x[0] * c[0] / 100.0) + k * wet]
                },
                quantities: &["C", "x"],
                over: &["rh", "value"],
                forms: &["saturation"],
                scales: true,
            },
        ],
    },
    Bench {
        name: "anemometer",
        inputs: &[("K", "Hz/(m/s)", 10.0, 0.002)],
        conditions: &[("v", "m/s"), ("th", "deg")],
        rows: || {
            product(
                &[1.0, 1.5, 2.2, 3.2, 4.5, 6.5, 9.0, 12.0, 16.0, 20.0],
                &[-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0],
            )
        },
        equations: &[("ve", "v*cos(th)"), ("f", "K*ve")],
        outputs: &[("f", "Hz", 0.05)],
        listed: &[
            ("calibration", "%", 0.3, "K", "K*(1 + p)"),
            ("yaw", "deg", 0.5, "ve", "v*cos(th + p)"),
        ],
        withheld: [
            Withheld {
                name: "bearing friction",
                sim: |x, c, k| vec![x[0] * c[0] * c[1].to_radians().cos() - k / c[0]],
                quantities: &["f", "ve"],
                over: &["v"],
                forms: &["reciprocal"],
                scales: true,
            },
            Withheld {
                name: "wake of the mast",
                sim: |x, c, k| {
                    let th = c[1].to_radians();
                    vec![x[0] * c[0] * th.cos() * (1.0 + k * (1.0 - (3.0 * th).cos()))]
                },
                quantities: &["f", "ve"],
                over: &["th"],
                forms: &["power", "wave"],
                scales: true,
            },
            Withheld {
                name: "vortex resonance",
                sim: |x, c, k| {
                    let r = c[0] / 9.0;
                    let h = 1.0 / (1.0 - r * r).hypot(r / 6.0);
                    vec![x[0] * c[0] * c[1].to_radians().cos() * (1.0 + k * (h - 1.0))]
                },
                quantities: &["f", "ve"],
                over: &["v"],
                forms: &["second-order"],
                scales: true,
            },
            Withheld {
                name: "overspeeding",
                sim: |x, c, k| {
                    vec![
                        x[0] * c[0] * c[1].to_radians().cos() * (1.0 + k * (c[0] / 20.0).powf(0.7)),
                    ]
                },
                quantities: &["f", "ve"],
                over: &["v"],
                forms: &["power", "root"],
                scales: true,
            },
        ],
    },
    Bench {
        name: "accelerometer",
        inputs: &[("S", "mV/(m/s^2)", 1.0, 5e-5), ("phi0", "deg", 0.0, 0.02)],
        conditions: &[("f", "Hz"), ("a", "m/s^2")],
        rows: || {
            let frequencies: Vec<f64> =
                (0..15).map(|n| 10.0 * 200f64.powf(f64::from(n) / 14.0)).collect();
            product(&frequencies, &[10.0, 20.0, 50.0, 80.0, 100.0])
        },
        equations: &[("V", "S*a"), ("phi", "phi0")],
        outputs: &[("V", "mV", 0.02), ("phi", "deg", 0.05)],
        listed: &[("cable", "%", 0.2, "V", "V*(1 + p)")],
        withheld: [
            Withheld {
                name: "low-pass",
                sim: |x, c, k| vec![x[0] * c[1] / (1.0 + k * (c[0] / 9000.0).powi(2)).sqrt(), x[1]],
                quantities: &["V"],
                over: &["f"],
                forms: &["first-order", "second-order", "power"],
                scales: false,
            },
            Withheld {
                name: "phase of an amplifier",
                sim: |x, c, k| vec![x[0] * c[1], x[1] - k * (c[0] / 500.0).atan().to_degrees()],
                quantities: &["phi"],
                over: &["f"],
                forms: &["first-order"],
                scales: true,
            },
            Withheld {
                name: "not linear in amplitude",
                sim: |x, c, k| vec![x[0] * c[1] * (1.0 + k * c[1] / 100.0), x[1]],
                quantities: &["V"],
                over: &["a", "value"],
                forms: &["slope", "power"],
                scales: true,
            },
            Withheld {
                name: "delay",
                sim: |x, c, k| vec![x[0] * c[1], x[1] + k * c[0] / 1000.0],
                quantities: &["phi"],
                over: &["f"],
                forms: &["slope"],
                scales: true,
            },
        ],
    },
    Bench {
        name: "encoder",
        inputs: &[("s", "1", 1.0, 1e-6), ("y0", "deg", 0.0, 0.0005)],
        conditions: &[("th", "deg")],
        rows: || (0..36).map(|n| vec![10.0 * f64::from(n)]).collect(),
        equations: &[("y", "s*th + y0")],
        outputs: &[("y", "deg", 0.001)],
        listed: &[("zero", "deg", 0.05, "y", "y + p")],
        withheld: [
            Withheld {
                name: "eccentricity",
                sim: |x, c, k| vec![x[0] * c[0] + x[1] + k * (c[0].to_radians() + 0.4).sin()],
                quantities: &["y"],
                over: &["th", "value"],
                forms: &["wave"],
                scales: true,
            },
            Withheld {
                name: "oval disc",
                sim: |x, c, k| vec![x[0] * c[0] + x[1] + k * (2.0 * c[0].to_radians() + 1.0).sin()],
                quantities: &["y"],
                over: &["th", "value"],
                forms: &["wave"],
                scales: true,
            },
            Withheld {
                name: "seam",
                sim: |x, c, k| vec![x[0] * c[0] + x[1] + if c[0] > 214.0 { k } else { 0.0 }],
                quantities: &["y"],
                over: &["th", "value"],
                forms: &["step"],
                scales: true,
            },
            Withheld {
                name: "thermal bow",
                sim: |x, c, k| vec![x[0] * c[0] + x[1] + k * ((c[0] - 140.0) / 180.0).powi(2)],
                quantities: &["y"],
                over: &["th", "value"],
                forms: &["power"],
                scales: true,
            },
        ],
    },
    Bench {
        name: "balance",
        inputs: &[("g", "1", 1.0, 2e-6)],
        conditions: &[("m", "g"), ("rh", "%"), ("t", "min")],
        rows: || {
            let loads = [1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 35.0, 50.0];
            // in an order that mixes loads, humidities and times
            (0..48)
                .map(|n| {
                    let humidity = 20.0 + 12.0 * ((n * 5) % 6) as f64;
                    vec![loads[(n * 3 + n / 8) % 8], humidity, 2.5 * n as f64]
                })
                .collect()
        },
        equations: &[("w", "g*m")],
        outputs: &[("w", "g", 0.0002)],
        listed: &[("tare", "g", 0.01, "w", "w + p"), ("sensitivity", "%", 0.01, "w", "w*(1 + p)")],
        withheld: [
            Withheld {
                name: "warm-up",
                sim: |x, c, k| vec![x[0] * c[0] + k * (1.0 - (-c[2] / 30.0).exp())],
                quantities: &["w"],
                over: &["t"],
                forms: &["first-order", "exponential"],
                scales: true,
            },
            Withheld {
                name: "moisture",
                sim: |x, c, k| vec![x[0] * c[0] + k * (c[1] / 80.0).powi(3)],
                quantities: &["w"],
                over: &["rh"],
                forms: &["power", "exponential"],
                scales: true,
            },
            Withheld {
                name: "static charge",
                sim: |x, c, k| vec![x[0] * c[0] + k / c[0].powi(2)],
                quantities: &["w"],
                over: &["m", "value"],
                forms: &["reciprocal"],
                scales: true,
            },
            Withheld {
                name: "evaporation",
                sim: |x, c, k| vec![x[0] * c[0] - k * (-c[2] / 12.0).exp()],
                quantities: &["w"],
                over: &["t"],
                forms: &["exponential", "first-order"],
                scales: true,
            },
        ],
    },
];

/// A simulated data set.
pub(crate) struct Simulated {
    /// Conditions, and what was measured of each output.
    pub(crate) rows: Vec<Vec<f64>>,
    pub(crate) values: Vec<Vec<f64>>,
    /// Conditions within the box of the data and outside of it, with what is true of the outputs.
    pub(crate) within: Vec<(Vec<f64>, Vec<f64>)>,
    pub(crate) outside: Vec<(Vec<f64>, Vec<f64>)>,
}

/// A data set of a bench, with one of its withheld effects or without.
pub(crate) fn simulated(bench: &Bench, withheld: Option<usize>, seed: u64) -> Simulated {
    let mut random =
        SplitMix64(bench.name.bytes().fold(seed, |h, b| h.wrapping_mul(31) + u64::from(b)));
    random.next();
    let inputs: Vec<f64> =
        bench.inputs.iter().map(|(_, _, mean, std)| mean + random.normal(*std)).collect();
    let rows = (bench.rows)();
    let of = withheld.map(|n| &bench.withheld[n]);
    let any = &bench.withheld[0];
    // an effect of no size
    let plain = |c: &[f64]| (any.sim)(&inputs, c, 0.0);
    let mut size = 1.0;
    if let Some(of) = of.filter(|of| of.scales) {
        // of 6 to 25 standard uncertainties, root mean square over the values that it touches
        let wanted = 6.0 * 4f64.powf(random.uniform());
        let sign = if random.uniform() < 0.5 { -1.0 } else { 1.0 };
        let small = 1e-6;
        let (mut squares, mut touched) = (0.0, 0.0);
        for c in &rows {
            let moved = (of.sim)(&inputs, c, small);
            for ((moved, still), (_, _, u)) in moved.iter().zip(plain(c)).zip(bench.outputs) {
                if *moved != still {
                    squares += ((moved - still) / small / u).powi(2);
                    touched += 1.0;
                }
            }
        }
        size = sign * wanted / f64::sqrt(squares / touched);
    }
    let truth = |c: &[f64]| match of {
        Some(of) => (of.sim)(&inputs, c, size),
        None => plain(c),
    };
    let values: Vec<Vec<f64>> = rows
        .iter()
        .map(|c| {
            let values = truth(c).into_iter().zip(bench.outputs);
            values.map(|(value, (_, _, u))| value + random.normal(*u)).collect()
        })
        .collect();
    let count = bench.conditions.len();
    let ends = |n: usize| {
        rows.iter()
            .map(|c| c[n])
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
    };
    let mut within = Vec::new();
    let mut outside = Vec::new();
    for number in 0..8 {
        let inside: Vec<f64> = (0..count)
            .map(|n| {
                let (low, high) = ends(n);
                low + (high - low) * random.uniform()
            })
            .collect();
        // 10 to 40 % of the range above one of the conditions
        let mut beyond = inside.clone();
        let n = number % count;
        let (low, high) = ends(n);
        beyond[n] = high + (high - low) * (0.1 + 0.3 * random.uniform());
        let values = truth(&inside);
        within.push((inside, values));
        let values = truth(&beyond);
        outside.push((beyond, values));
    }
    Simulated { rows, values, within, outside }
}
