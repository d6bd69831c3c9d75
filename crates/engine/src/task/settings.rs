//! How an evaluation is to be done.

use super::Coverage;

/// How many Monte Carlo trials to make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trials {
    /// This many; 0 for an evaluation by the law of propagation alone.
    Fixed(u64),
    /// As many as the figures need to be stable to [`Settings::digits`], by [`Settings::rule`].
    Adaptive,
}

/// So many.
impl From<u64> for Trials {
    fn from(trials: u64) -> Self {
        Self::Fixed(trials)
    }
}

/// When an adaptive run has made enough trials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StoppingRule {
    /// When the figures of its blocks agree to the tolerance (JCGM 101, 7.9).
    #[default]
    Clause79,
    /// When it has made as many as the scatter of its first blocks asks for (Stein's two-stage
    /// rule; Wuebbeler, Harris, Cox, Elster, Metrologia 47 (2010) 317).
    Stein,
}

impl StoppingRule {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Clause79, Self::Stein];

    /// The name that files and the command line use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Clause79 => "7.9",
            Self::Stein => "stein",
        }
    }

    /// The rule of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }
}

/// Which figures without the noise of trials are wanted beside those of the Monte Carlo method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MethodChoice {
    /// Exact ones where the model allows them.
    #[default]
    Auto,
    /// None.
    MonteCarlo,
    /// Exact ones.
    Exact,
    /// Those of quasi-random points, one input being integrated exactly.
    Quasi,
}

impl MethodChoice {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Auto, Self::MonteCarlo, Self::Exact, Self::Quasi];

    /// The name that files and the command line use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::MonteCarlo => "monte-carlo",
            Self::Exact => "exact",
            Self::Quasi => "quasi",
        }
    }

    /// The choice of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.name() == name)
    }
}

/// Which of the two methods gives the stated value and expanded uncertainty.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StatementMethod {
    /// The law of propagation with its coverage factor from the effective degrees of freedom
    /// (EA-4/02 M:2022, ILAC-P14:09/2020), where its endpoints agree with those of the trials when
    /// the same quantities are drawn with infinite degrees of freedom; elsewhere the trials.
    #[default]
    Auto,
    /// The law of propagation (JCGM 100).
    Gum,
    /// The coverage interval of the trials (JCGM 101).
    MonteCarlo,
}

impl StatementMethod {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Gum, Self::MonteCarlo];

    /// The name that files and the command line use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Gum => "gum",
            Self::MonteCarlo => "monte-carlo",
        }
    }

    /// The method of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }
}

/// The settings of an evaluation. They start from the defaults:
///
/// ```
/// use gumption_engine::task::{Settings, Trials};
///
/// let settings = Settings::default().with_trials(Trials::Adaptive).with_seed(7);
/// assert_eq!((settings.seed, settings.digits), (7, 2));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// Coverage probability or factor.
    pub coverage: Coverage,
    /// Monte Carlo trials.
    pub trials: Trials,
    /// When an adaptive run stops.
    pub rule: StoppingRule,
    /// Up to so many trials of a plain model, of all rows together, a run of the usual number of trials
    /// ([`Settings::USUAL_TRIALS`]) goes on, fourfold each time, where clause 8 is undecided; 0 for no
    /// more than asked for. A trial of many outputs, of a long formula or of a fit counts as several.
    pub decide_up_to: u64,
    /// The largest number of trials of an adaptive run.
    pub max_trials: u64,
    /// Whether an adaptive run goes to a fifth of the tolerance, as the validation of the GUM
    /// interval asks (JCGM 101, 8.2).
    pub for_validation: bool,
    /// Seed of the random streams.
    pub seed: u64,
    /// Significant digits of the standard uncertainty that are held meaningful (JCGM 101, 7.9.2).
    pub digits: u32,
    /// Whether these digits were asked for: a certificate takes its own otherwise.
    pub own_digits: bool,
    /// Significant digits of uncertainties on pages, if they are others than [`Settings::digits`].
    pub shown_digits: Option<u32>,
    /// Whether the coverage factor is taken at the real number of effective degrees of freedom
    /// instead of its integer part (JCGM 100, G.4.1).
    pub real_dof: bool,
    /// Share of trials that may be undefined (not finite).
    pub allowed_undefined: f64,
    /// Which figures without noise are wanted beside those of the trials; none where nobody said.
    pub method: Option<MethodChoice>,
    /// Whether [`MethodChoice::Auto`] takes quasi-random points where there are no exact figures.
    pub quasi_otherwise: bool,
    /// Which method gives the stated value and expanded uncertainty.
    pub statement: StatementMethod,
    /// The largest difference of an endpoint, relative to U, with which [`StatementMethod::Auto`]
    /// states the law of propagation; above 0. The usual 0.05 is the share of U that rounding may
    /// take away (EA-4/02 M:2022, 6.3).
    pub statement_tolerance: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            coverage: Coverage::default(),
            trials: Trials::Fixed(Self::USUAL_TRIALS),
            rule: StoppingRule::default(),
            decide_up_to: 0,
            max_trials: 1_000_000_000,
            for_validation: false,
            seed: 1,
            digits: 2,
            shown_digits: None,
            own_digits: false,
            real_dof: false,
            allowed_undefined: 0.0,
            method: None,
            quasi_otherwise: false,
            statement: StatementMethod::default(),
            statement_tolerance: 0.05,
        }
    }
}

impl Settings {
    /// How many trials are made where nobody says how many.
    pub const USUAL_TRIALS: u64 = 1_000_000;

    /// With this coverage probability or factor.
    #[must_use]
    pub fn with_coverage(self, coverage: Coverage) -> Self {
        Self { coverage, ..self }
    }

    /// With these trials.
    #[must_use]
    pub fn with_trials(self, trials: Trials) -> Self {
        Self { trials, ..self }
    }

    /// With this seed.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// With so many meaningful digits.
    #[must_use]
    pub fn with_digits(self, digits: u32) -> Self {
        Self { digits, own_digits: true, ..self }
    }

    /// Significant digits of uncertainties on pages, which decide nothing: those of
    /// [`Settings::digits`] unless others are asked for.
    pub fn digits_on_pages(&self) -> u32 {
        self.shown_digits.unwrap_or(self.digits)
    }
}

/// What somebody asks for in place of the settings of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SettingsChanges {
    /// Coverage probability or factor.
    pub coverage: Option<Coverage>,
    /// Monte Carlo trials; a run of so many does not go on by itself.
    pub trials: Option<Trials>,
    /// Whether the run makes as many trials as the validation of the GUM interval asks.
    pub validate: bool,
    /// When an adaptive run stops.
    pub rule: Option<StoppingRule>,
    /// Which figures without noise are wanted beside those of the trials.
    pub method: Option<MethodChoice>,
    /// The largest number of trials of an adaptive run.
    pub max_trials: Option<u64>,
    /// Seed of the random streams.
    pub seed: Option<u64>,
    /// Which method gives the stated value and expanded uncertainty.
    pub statement: Option<StatementMethod>,
    /// Significant digits of the standard uncertainty that are held meaningful.
    pub digits: Option<u32>,
    /// Significant digits of uncertainties on pages.
    pub shown_digits: Option<u32>,
    /// Whether the coverage factor is taken at the real number of effective degrees of freedom.
    pub real_dof: bool,
}

impl SettingsChanges {
    /// The settings with what is asked for.
    #[must_use]
    pub fn applied(&self, mut settings: Settings) -> Settings {
        settings.coverage = self.coverage.unwrap_or(settings.coverage);
        if let Some(trials) = self.trials {
            settings.trials = trials;
            settings.decide_up_to = 0;
        }
        if self.validate {
            settings.trials = Trials::Adaptive;
            settings.for_validation = true;
        }
        settings.rule = self.rule.unwrap_or(settings.rule);
        settings.method = self.method.or(settings.method);
        settings.max_trials = self.max_trials.unwrap_or(settings.max_trials);
        settings.seed = self.seed.unwrap_or(settings.seed);
        settings.statement = self.statement.unwrap_or(settings.statement);
        if let Some(digits) = self.digits {
            settings = settings.with_digits(digits);
        }
        settings.shown_digits = self.shown_digits.or(settings.shown_digits);
        settings.real_dof |= self.real_dof;
        settings
    }
}
