//! Measurement uncertainty: the law of propagation (JCGM 100) and the Monte Carlo method
//! (JCGM 101) side by side.
//!
//! # Evaluating a measurement
//!
//! A measurement that is built in takes what is known about its inputs and is evaluated in one
//! call:
//!
//! ```
//! use gumption::distribution::Input;
//! use gumption::measurements::InclinedPlane;
//! use gumption::propagate::{Control, evaluate};
//! use gumption::task::{Settings, Task};
//!
//! let plane = InclinedPlane {
//!     a_ref: Input::normal(10.0, 0.01, "m/s^2")?,
//!     tilt: Input::rectangular(35.0, 0.1, "deg")?,
//!     rotation: Input::rectangular(30.0, 0.1, "deg")?,
//! };
//! let evaluation = evaluate(&Task::of(plane, Settings::default())?, &Control::default())?;
//! let a_x = &evaluation.rows[0].outputs[0];
//! let (gum, trials) = (a_x.gum.as_ref().unwrap(), a_x.monte_carlo.as_deref().unwrap());
//! // 10 sin(35 deg) cos(30 deg) m/s^2; u from the three contributions
//! assert!((gum.estimate - 4.967_318).abs() < 1e-6);
//! assert!((gum.standard_uncertainty - 0.009_172).abs() < 1e-6);
//! assert!(trials.symmetric_interval[0] > gum.interval().unwrap()[0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A sweep over conditions
//!
//! The same plane at three tilts: the estimate of an input follows a condition, and every row is
//! evaluated.
//!
//! ```
//! # use gumption::distribution::Input;
//! # use gumption::measurements::InclinedPlane;
//! # use gumption::propagate::{Control, evaluate};
//! # use gumption::task::Task;
//! # let plane = InclinedPlane {
//! #     a_ref: Input::normal(10.0, 0.01, "m/s^2")?,
//! #     tilt: Input::rectangular(35.0, 0.1, "deg")?,
//! #     rotation: Input::rectangular(0.0, 0.1, "deg")?,
//! # };
//! let task = Task::measurement(plane)
//!     .conditions(&[("nominal", "deg")], [[15.0], [35.0], [60.0]])
//!     .estimate("tilt", "nominal")
//!     .output("a_z", "m/s^2")
//!     .trials(0)
//!     .build()?;
//! let evaluation = evaluate(&task, &Control::default())?;
//! let last = evaluation.rows[2].outputs[0].gum.as_ref().unwrap();
//! // 10 cos(60 deg); u^2 = (0.01 / 2)^2 + (10 sin(60 deg) 0.1 deg / sqrt(3))^2; a few roundings
//! assert!((last.estimate - 5.0).abs() < 1e-14);
//! assert!((last.standard_uncertainty - 0.010057552135).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Correlated inputs
//!
//! Models of one's own may be written as equations. Here two resistors were calibrated with the same
//! standard:
//!
//! ```
//! use gumption::distribution::Input;
//! use gumption::propagate::{Control, evaluate};
//! use gumption::task::Task;
//!
//! let task = Task::builder("resistors in series")
//!     .input("R_1", Input::normal(1000.0, 0.1, "ohm")?)
//!     .input("R_2", Input::normal(1000.0, 0.1, "ohm")?)
//!     .equation("R", "R_1 + R_2")
//!     .output("R", "kohm")
//!     .correlate("R_1", "R_2", 0.5)
//!     .trials(100_000)
//!     .build()?;
//! let evaluation = evaluate(&task, &Control::default())?;
//! let series = &evaluation.rows[0].outputs[0];
//! let (gum, trials) = (series.gum.as_ref().unwrap(), series.monte_carlo.as_deref().unwrap());
//! // u = 0.1 ohm sqrt(1 + 1 + 2 * 0.5); that of 1e5 trials scatters by 0.22 %
//! let u = 0.03_f64.sqrt() * 1e-3;
//! assert!((gum.standard_uncertainty / u - 1.0).abs() < 1e-14);
//! assert!((trials.standard_uncertainty.unwrap() / u - 1.0).abs() < 5.0 * 0.0022);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A report
//!
//! The same tables and pages as those of the command line:
//!
//! ```
//! # use gumption::distribution::Input;
//! # use gumption::propagate::{Control, evaluate, warnings};
//! # use gumption::task::Task;
//! use gumption::report::{EvaluationReport, Provenance, Shown, html, table};
//!
//! let task = Task::builder("power of a heater")
//!     .input("U", Input::normal(10.0, 0.05, "V")?)
//!     .input("R", Input::rectangular(50.0, 0.5, "ohm")?)
//!     .equation("P", "U^2 / R")
//!     .output("P", "W")
//!     .trials(10_000)
//!     .build()?;
//! let evaluation = evaluate(&task, &Control::default())?;
//! let report = EvaluationReport {
//!     task: &task,
//!     evaluation: &evaluation,
//!     warnings: &warnings(&task, &evaluation),
//!     provenance: &Provenance::default(),
//! };
//! // P = 2 W, u = 2 W sqrt((2 * 0.005)^2 + (0.01 / sqrt(3))^2) = 0.0231 W
//! assert!(table(&report, &Shown::default()).contains("0.023"));
//! assert!(html(&report, &Shown::default()).contains("power of a heater"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A gap diagnosis
//!
//! Measured data beside a model, with candidate effects (JSON and CSV; [`file::read_case`]): which
//! of them is missing?
//!
//! ```
//! use std::path::Path;
//! use gumption::{file, gap};
//!
//! let case = file::read_case(Path::new("models/gap/sampling_rate/case.json"))?.case;
//! let diagnosis = gap::diagnose(&case, None, gap::DiagnosisOptions::new(1), &|_| ())?;
//! // the data were made with a sampling rate that is 0.05 % off
//! assert!(diagnosis.gap.present);
//! assert_eq!(diagnosis.most_probable.effects, ["sampling-rate"]);
//! // without another seed the error of the integrals leaves the second decimal alone
//! assert!((diagnosis.most_probable.probability - 0.759).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # An observation
//!
//! A recording becomes amplitudes and phases with their uncertainties, here a sine in memory:
//!
//! ```
//! use gumption::observe::{
//!     Amplitude, Channel, ChannelRecording, Frequency, InMemorySamples, Measured, Method, PhaseUnit,
//!     RecipeSettings, TimeBase, observe,
//! };
//! use gumption::unit::Unit;
//!
//! // 2.5 m/s^2 at 5 Hz for 2 s, sampled at 1000 Hz with a resolution of 0.01 m/s^2
//! let sine = |i: u32| 2.5 * (std::f64::consts::TAU * 5.0 * f64::from(i) / 1000.0).cos();
//! let values = (0..2000).map(|i| (sine(i) / 0.01).round() * 0.01).collect();
//! let exact = |value| Measured {
//!     value,
//!     standard_uncertainty: 0.0,
//!     degrees_of_freedom: f64::INFINITY,
//! };
//! let settings = RecipeSettings {
//!     channels: vec![Channel {
//!         name: "a".to_owned(),
//!         unit: Unit::parse("m/s^2")?,
//!         scale_uncertainty: 0.0,
//!         resolution: 0.01,
//!         steps: Vec::new(),
//!     }],
//!     reference: None,
//!     components: vec![1],
//!     harmonics: 2,
//!     method: Method::SineFit,
//!     amplitude: Amplitude::Peak,
//!     phase: PhaseUnit::Degree,
//!     trials: 0,
//!     seed: 1,
//! };
//! let frequency = Frequency { hertz: Some(5.0), standard_uncertainty: 0.0, estimate: false };
//! let base = TimeBase { rate: exact(1000.0), start: 0.0, jitter: 0.0, beside_frequency: None, of_middle: None };
//! let passes = InMemorySamples { channels: vec![values] };
//! let mut tracks = [ChannelRecording { passes, base, channels: vec![0], search: None }];
//! let found = observe(&settings, &[frequency], &mut tracks)?;
//! let amplitude = &found.frequencies[0][0].components[0].amplitude.measured;
//! // half a step at most, and its uncertainty is smaller than a step
//! assert!((amplitude.value - 2.5).abs() < 0.005);
//! assert!(amplitude.standard_uncertainty > 0.0 && amplitude.standard_uncertainty < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A comparison
//!
//! The normalized error E_n of two results (ISO/IEC 17043):
//!
//! ```
//! use gumption::compare::{ResultPair, StatedResult};
//!
//! let result = |value, expanded| StatedResult::new(value, expanded, 2.0);
//! let pair = ResultPair {
//!     label: "S_x".to_owned(),
//!     results: [result(10.3, 0.4), result(10.0, 0.3)],
//!     correlation: 0.0,
//! };
//! let compared = pair.compare().ok_or("no uncertainty")?;
//! // |d| / sqrt(0.4^2 + 0.3^2) = 0.3 / 0.5, up to rounding
//! assert!((compared.normalized_error - 0.6).abs() < 1e-14 && compared.is_compatible());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A certificate
//!
//! What is stated of results that a certificate file names ([`file::read_certificate`]), rounded
//! once for all formats:
//!
//! ```
//! use std::path::Path;
//! use gumption::certificate::issue;
//! use gumption::file::read_certificate;
//! use gumption::propagate::Control;
//!
//! let path = Path::new("models/certificates/three_axis_accelerometer.json");
//! let mut asked = read_certificate(path)?.certificate;
//! for evaluation in &mut asked.evaluations {
//!     evaluation.task.settings.trials = 0.into();
//! }
//! let issued = issue(&asked, &[], &Control::default())?;
//! // (422 +- 13) D/(m/s^2), as Chiominto et al. (2024) print it in table 1
//! let sensitivity = &issued.statements[27];
//! assert_eq!(sensitivity.rounded_value().ok_or("no uncertainty")?.value(), 422.0);
//! assert_eq!(sensitivity.rounded.ok_or("no uncertainty")?.value(), 13.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A measurement of your own
//!
//! Declare its quantities with [`measurement!`] and write its equations once, generic over the
//! [`Number`](number::Number):
//!
//! ```
#![doc = include_str!("../examples/own_measurement.rs")]
//! ```
//!
//! With one line it is as good as a built-in one on the command line and in files: `Application`.
//! Distributions of `rand_distr` and `statrs` stand on inputs as
//! [`External`](distribution::External).
//!
//! # Modules
//!
//! Data flows one way: [`mod@file`] -> [`task`] -> [`propagate`] -> [`report`]; [`number`],
//! [`mod@unit`], [`distribution`] and [`model`] are what tasks are made of. The library prints
//! nothing and starts nothing by itself; progress, stopping, threads and memory are the caller's
//! ([`propagate::Control`]).
//!
//! # Crate features
//!
//! - `cli` (default): the command line (`Application`), with what it needs to read arguments and show
//!   progress.
//! - `statrs`: means, standard deviations and quantiles of `statrs` for
//!   [`External`](distribution::External) distributions.

#![deny(unsafe_code)]

#[cfg(feature = "cli")]
mod application;
#[cfg(feature = "cli")]
mod published;
mod templates;

#[cfg(feature = "cli")]
pub use application::Application;
/// The command line as a function ([`Application::call`]): what it takes and gives.
#[cfg(feature = "cli")]
pub mod command {
    pub use gumption_command::simulator::{KeptRuns, Program, SimulatedCase, prediction_folder};
    pub use gumption_command::{
        Answered, Exit, Failure, GivenFile, MergedRun, Mistake, PartedMerging, PartedRun,
        PartsFolder, PassOfRun,
    };
}
pub use templates::catalogue;

pub use gumption_analysis::{certificate, compare, diff, plan};
pub use gumption_assumptions as assumptions;
pub use gumption_engine::{decimal, measurement};
pub use gumption_files::schema;
pub use gumption_gap as gap;
pub use gumption_measurements as measurements;
pub use gumption_report as report;
pub use gumption_signal as observe;
pub use gumption_units as unit;

/// User files: read, validated, turned into tasks. Every mistake is a [`Diagnostic`](file::Diagnostic)
/// with its place.
pub mod file {
    pub use gumption_files::{
        CarriedModel, CaseFile, CertificateFile, CertificateListing, CertifiedModel, CostFile,
        EffectListing, FileReader, ListedEffect, ListedParameter, ListedPart, ListedQuantity,
        ModelFile, ModelOrResult, NotCopied, OpenedRow, Override, Overrides, ReadingsFile,
        RecipeCondition, RecipeFile, RecipeRow, Recording, ResultFile, SavedOutput,
        SharedFileError, SharedFileHeader, SharedFileKind, SharedModelError, SharedRun, TextKind,
        carried_models, catalogue, certificate_listing, certificate_listing_text, check,
        check_text, difference, named_in, read, read_case, read_certificate, read_costs,
        read_costs_text, read_drift, read_recipe, read_recipe_text, read_result, read_target,
        read_text, schema, shared_file, shared_file_bytes,
    };
    pub use gumption_foreign::{
        Coefficients, ComparisonOptions, ComparisonTable, ImportOptions, ImportedBudget, Question,
        ReadComparison, RefusedBudget, import_budget, import_budget_bytes, read_comparison,
        read_comparison_text,
    };
    pub use gumption_text::{
        Diagnostic, DiagnosticKind, Diagnostics, FileSource, SourceText, bytes, is_obeyed,
        printable,
    };
}

/// Threads that belong to one process.
pub mod threads {
    pub use gumption_engine::threads::OfProcess;
}

/// What is known about a quantity: probability distributions.
pub mod distribution {
    pub use gumption_engine::distribution::{
        Arcsine, Beta, Constant, Correlation, CorrelationError, CurvilinearTrapezoid, Distribution,
        EvaluationType, Exponential, External, Fits, Gamma, Input, InputError, Invalid, LogUniform,
        Lognormal, Normal, PoissonCount, Quantiles, Readings, Rectangular, Samples, SplitNormal,
        StreamRng, StudentT, Trapezoidal, Triangular, Truncated,
    };
}

/// Measurement models: named quantities and the function between them.
pub mod model {
    pub use gumption_engine::model::{
        Capability, GuardRule, InputQuantity, Model, NumberForm, Output, Program, Quantity,
        Recorder, Tolerance, Traced, formula, typed,
    };
}

/// The numbers that a model's arithmetic is generic over, and the code paths of the machine.
pub mod number {
    pub use gumption_engine::number::{CodePath, ComplexNumber, Number, UnavailablePath};
}

/// Evaluation by the law of propagation and by the Monte Carlo method.
pub mod propagate {
    pub use gumption_engine::propagate::{
        Accuracy, CapabilityStatement, Conformity, ConformityLevel, Control, Evaluation,
        EvaluationError, GlobalRisks, Inherited, JointRegion, Noiseless, OutputEvaluation, Region,
        RegionEvaluation, RegionValidation, RowEvaluation, SampledRegion, Scatter, SecondOrder,
        SmallestRegion, convergence, evaluate, first_draws, first_trials, for_each_block,
        histograms, is_brief, quantiles, trial_hash, warnings,
    };

    /// The law of propagation of uncertainty (JCGM 100).
    pub mod gum {
        pub use gumption_engine::propagate::gum::{
            BudgetLine, CorrelationLine, Dof, Gum, coverage_factor,
        };

        /// Budgets of many measurements of one model at once, as columns of numbers.
        pub mod bulk {
            pub use gumption_engine::propagate::gum::bulk::{
                Budgets, BulkError, BulkInput, BulkOptions, BulkValue, budgets,
            };
        }
    }

    /// The Monte Carlo method (JCGM 101).
    pub mod monte_carlo {
        pub use gumption_engine::propagate::monte_carlo::{
            Adaptive, Histogram, MonteCarlo, NumericalError, Undefined,
        };
    }

    /// The comparison of both (JCGM 101, clause 8).
    pub mod validate {
        pub use gumption_engine::propagate::validate::{Validation, numerical_tolerance, validate};
    }

    /// A run on more than one machine: passes over ranges of blocks, made anywhere and put together.
    pub mod parts {
        pub use gumption_engine::propagate::parts::{
            Damaged, Merged, Merging, NotShared, PartError, SharedPass, blocks,
        };
    }
}

/// Calibration functions: curves fitted to points, with the uncertainties of both coordinates. The
/// formulas of a task may call them ([`Task::curves`](task::Task::curves)).
pub mod calibration {
    pub use gumption_engine::regression::{
        ComplexForm, ComplexResidual, ComplexSpread, Coordinate, Cross, Curve, CurveFunction,
        DegreeChoice, Points, PolarValue, Regression, RegressionError, Spread, choose_degree,
    };
}

/// What is to be evaluated: a model, what is known about its inputs in every row of conditions, and
/// the settings of the evaluation.
pub mod task {
    pub use gumption_engine::task::{
        ColumnFunction, Coverage, Evidence, MethodChoice, ModelStatement, Row, Settings,
        SettingsChanges, Sharing, StatementMethod, StoppingRule, Task, TaskBuilder, TaskError,
        Trials, Variable, Warning,
    };
}
