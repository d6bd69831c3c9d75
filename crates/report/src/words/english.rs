//! English.

use super::Sentences;

/// The sentences of all rooms.
pub(super) const ROOMS: [Sentences; 6] = [EVALUATION, FORMULAS, FILES, SIGNALS, GAP, COMMANDS];

/// Facts of the engine about an evaluation.
#[rustfmt::skip]
const EVALUATION: Sentences = &[
    ("few-trials", "{trials} trials are few for a coverage probability of {probability}: JCGM 101, 7.2.2 \
        advises at least {needed}"),
    ("correlations-rounded", "the declared correlation coefficients are possible only within their rounding; \
        the nearest possible ones are used in the trials"),
    ("correlations-rounded.output", "`{name}`: the declared correlation coefficients leave no variance by the \
        law of propagation, or one below zero, and the nearest possible ones do; take the Monte Carlo figures, \
        or state the coefficients with more digits"),
    ("undefined-trials", "{count} of {trials} trials are not finite and were left out"),
    ("gaussian-copula", "{names} are drawn by a Gaussian copula, fitted so that they have their distributions \
        and the declared correlation coefficients; the coefficients do not say more about their joint \
        distribution, so this is an assumption"),
    ("copula-adjusted", "a Gaussian copula gives the declared correlation coefficients only within their \
        rounding; in the trials they differ by up to {difference}"),
    ("copula-adjusted.results", "a Gaussian copula gives the correlation coefficients of these saved results \
        only nearly; in the trials they differ by up to {difference}. Where outputs of one result nearly \
        cancel, evaluate the whole in one model"),
    ("trials-off", "`{name}`: figures of the trials are farther from those without their noise than {errors} \
        numerical standard errors: {far}"),
    ("moved", "{figure} by {by}"),
    ("figure.estimate", "its estimate"),
    ("figure.standard-uncertainty", "its standard uncertainty"),
    ("figure.median", "its median"),
    ("figure.inside", "its probability within the tolerance"),
    ("figure.symmetric-lower", "its lower end of the symmetric interval"),
    ("figure.symmetric-upper", "its upper end of the symmetric interval"),
    ("figure.shortest-lower", "its lower end of the shortest interval"),
    ("figure.shortest-upper", "its upper end of the shortest interval"),
    ("raised-to-cmc", "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) of \
        {cmc} and raised to it: {expanded} is to be stated"),
    ("raised-to-cmc.rows", "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) \
        in {count} of {of} rows, and raised to it there"),
    ("below-cmc", "the expanded uncertainty of `{name}` is {expanded}, below the laboratory's capability \
        (CMC) of {cmc}, and must not be stated (ILAC-P14)"),
    ("below-cmc.rows", "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) in \
        {count} of {of} rows, and must not be stated there (ILAC-P14)"),
    ("at", " at {conditions}"),
    ("condition", "{name} = {value}"),
    ("gum-undefined", "`{name}`{at}: the estimate or a sensitivity coefficient is not finite at the inputs' \
        estimates, so there is no GUM evaluation"),
    ("gum-dof-undefined", "`{name}`{at}: correlated inputs have finite degrees of freedom, for which the \
        Welch-Satterthwaite formula does not hold; the Monte Carlo interval is the way, or a stated \
        `coverage_factor`"),
    ("gum-dof-undefined.stated", "`{name}`{at}: correlated inputs have finite degrees of freedom, for which \
        the Welch-Satterthwaite formula does not hold; the stated factor k = {k} is used as it stands"),
    ("not-converged", "`{name}`{at}: after {trials} trials the figures are not yet stable to the tolerance \
        {tolerance}; the numerical standard errors say how far they are"),
    ("no-variance", "`{name}`{at}: an input is drawn from a t distribution with {dof} degrees of freedom, \
        which has no variance, so the trials have no standard uncertainty; the coverage intervals stand, and \
        the value is the estimate by the law of propagation"),
    ("no-variance.of-model", "`{name}`{at}: an input is drawn from a t distribution with {dof} degrees of \
        freedom, which has no variance, and through this model no expectation, so the trials have no estimate \
        and no standard uncertainty; the coverage intervals stand, and the value is the estimate by the law \
        of propagation"),
    ("no-variance.one", "`{name}`{at}: an input is drawn from a t distribution with {dof} degree of freedom, \
        which has no expectation and no variance, so the trials have no estimate and no standard uncertainty; \
        the coverage intervals stand, and the value is the estimate by the law of propagation"),
    ("no-variance.no-expectation", "`{name}`{at}: an input is drawn from a t distribution with {dof} degrees \
        of freedom, which has no expectation and no variance, so the trials have no estimate and no standard \
        uncertainty; the coverage intervals stand, and the value is the estimate by the law of propagation"),
    ("difference.above", "is {percent} above that of the GUM"),
    ("difference.below", "is {percent} below that of the GUM"),
    ("difference.from-zero", "is not zero as that of the GUM is"),
    ("beyond-bounds", "beyond all bounds"),
    ("in-brackets", " ({dof})"),
    ("few-dof", "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because some inputs have few \
        degrees of freedom{dof}: their t distributions have a larger standard deviation, which accounts for \
        {alone}. {conclusion}"),
    ("few-dof-not-allowed-for", "Neither is wrong; no coverage factor of the GUM allows for it here"),
    ("few-dof-allowed-for", "Neither is wrong; the GUM allows for it in the coverage factor"),
    ("few-dof-long-tails", "The GUM allows for it in its coverage factor, that of a t distribution, whose \
        long tails these inputs do not have"),
    ("non-linear", "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because the model is not \
        linear over the uncertainties of its inputs{few_dof}{second}. Take the Monte Carlo figures"),
    ("non-linear-few-dof", "; few degrees of freedom{dof} alone would bring it {alone} above"),
    ("non-linear-terms", "; {said}"),
    ("non-linear.second-order", "`{name}`{at}: {second}"),
    ("non-linear.results", "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because of saved \
        results whose trials have another standard deviation than their standard uncertainty ({results}), as \
        their models are not linear. Take the Monte Carlo figures"),
    ("second-order", "with its terms of second order (JCGM 100, 5.1.2, note) the law of propagation gives \
        {with_terms} instead of {linear}{products}"),
    ("second-order-products", "; {products}"),
    ("squared", "`{name}` squared"),
    ("times", "`{first}` times `{second}`"),
    ("contributes", "{product} contributes {contribution}"),
    ("contributes.hidden", "{product} contributes {contribution}, though their sensitivity coefficients \
        vanish here"),
    ("correlations-by-propagation", "`{name}`: its trials have no standard deviation that means something, so \
        its correlation coefficients are those of the law of propagation"),
    ("correlations-by-propagation.none", "`{name}`: its trials have no standard deviation that means \
        something, and there is no GUM evaluation, so it has no correlation coefficients"),
    ("conformity-by-propagation", "`{name}`: without trials it is decided about its tolerance by the law of \
        propagation, as of a normal or t distribution (JCGM 106, 7.2); trials show whether that holds"),
    ("heavy-tails", "`{name}`{at}: trials far out, of which a run has few or none, carry its moments, so that \
        trials tell {missing} (JCGM 101, 3.6, note 1); median and coverage intervals stand, and {value}"),
    ("no-deviation", "no standard deviation"),
    ("no-moments", "no expectation and no standard deviation"),
    ("value-by-propagation", "the value is the estimate by the law of propagation"),
    ("value-is-median", "the value is the median"),
    ("interval-of-extremes", "`{name}`{at}: {trials} trials are so few for this coverage probability that \
        the Monte Carlo interval is that of the extreme ones, which has no numerical standard error; clause 8 \
        is left undecided"),
    ("result-cancellation", "`{name}`{at}: outputs of a saved result nearly cancel, and the {trials} trials \
        that the result holds tell how they vary together to about {left} only, of a standard uncertainty of \
        {spread} in the trials here; evaluate the whole in one model"),
    ("copula-effect", "`{name}`{at}: with the correlation coefficients that the Gaussian copula gives in place \
        of those of the inputs, its standard uncertainty in the trials is about {drawn}, not {linear}"),
    ("phase-jumps", "`{name}`: {percent} of the trials lie a turn away from the others, beyond the cut of a \
        phase, so that mean, standard deviation and interval of the trials mean nothing; write \
        `\"periodic\": {turn}` at the output, which takes its values within half a turn of the estimate"),
    ("phase-jumps.apart", "`{name}`: {percent} of the trials lie about {size} away from the others, beyond a \
        cut of `atan2`, a phase or `mod`, so that mean, standard deviation and interval of the trials mean \
        nothing; where values that far apart are the same, write that distance as `\"periodic\"` at the \
        output, which takes its values within half of it of the estimate"),
    ("result-few-trials", "`{name}`{at}: saved results of few trials ({results}) leave figures uncertain, \
        however many trials are made here: {errors} (one numerical standard error each); save those results \
        with more trials"),
    ("double-precision", "`{name}`: numbers of double precision, with 16 digits, leave {undetermined} of \
        `{input}` undetermined, {share} % of its standard uncertainty: it is {estimate} with a standard \
        uncertainty of {uncertainty}; make it the difference from a reference value"),
    ("underflow", "`{name}`: a product, a quotient or a power in its equations is below the smallest number \
        of double precision, 2.2e-308, and counts as less than it is; choose units of the size of the \
        quantities"),
];

/// Facts about formulas.
#[rustfmt::skip]
const FORMULAS: Sentences = &[
];

/// Facts about models, tables, certificates and other files.
#[rustfmt::skip]
const FILES: Sentences = &[
];

/// Facts about recordings.
#[rustfmt::skip]
const SIGNALS: Sentences = &[
    ("preamble", "`{name}`: line {first} stands above the header in line {header} and is not read"),
    ("preamble.lines", "`{name}`: lines {first} to {last} stand above the header in line {header} and are not \
        read"),
    ("uneven-instants", "`{name}`: the instants of the time column scatter by {percent} % of the sampling \
        interval (rms) about even spacing; if the samples really were taken then, state it as `jitter`"),
    ("sampling-rates-differ", "`{name}`: the recipe states a sampling rate of {stated} Hz, but {whose} {found} \
        Hz; the recipe's is used, so that frequencies come out {times} times what the file says; where the \
        file is right, leave out `sampling_rate`"),
    ("of-time-column", "its time column has"),
    ("of-header", "its header says"),
    ("flat-channel", "`{name}`, channel `{channel}`: all values are {value}"),
    ("saturated", "`{name}`, {at}: {count} of {of} values are {value}, the {end} of the recording, and {next} \
        the next one to it; the channel may be saturated"),
    ("saturated.in-a-row", "`{name}`, {at}: {count} values in a row are {value}, the {end} of the recording; \
        the channel may be saturated"),
    ("highest", "highest"),
    ("lowest", "lowest"),
    ("sample-of-time", "sample {sample}, the time"),
    ("sample-of-channel", "sample {sample}, channel `{channel}`"),
];

/// Facts about a diagnosis.
#[rustfmt::skip]
const GAP: Sentences = &[
];

/// Facts that only a command knows.
#[rustfmt::skip]
const COMMANDS: Sentences = &[
    ("of-model", "{model}: "),
    ("few-trials.audit", "{trials} trials are too few to tell how assumptions move the result; {made} are made"),
    ("more-than-two-digits", "U is stated to {digits} significant digits; an accredited certificate may have \
        at most two (ILAC-P14:09/2020, 5.3)"),
    ("rounded-away", "row {row}: U is stated as {stated}, {percent} % less than {expanded}; EA-4/02 M:2022, \
        6.3, allows a rounding that takes away at most 5 %: `\"rounding\": \"ea\"` rounds up there"),
    ("digits-of-trials", "row {row}: its figures are those of the trials, whose last digit depends on the \
        seed: {why}"),
    ("raised-to-cmc.certificate", "row {row}: U is raised to the laboratory's capability (CMC) of {cmc}"),
    ("below-cmc.certificate", "row {row}: U = {expanded} is below the laboratory's capability (CMC) of \
        {cmc}, which an accredited certificate may not state (ILAC-P14); `\"cmc_floor\": true` raises it"),
    ("not-stated", "the certificate does not say what ISO/IEC 17025:2017, 7.8.2.1 and 7.8.4.1 ask for: \
        {missing}"),
    ("evidence-unused", "the evidence of `{name}` is not used: it is for a distribution that is assumed \
        (type B), and this one is evaluated from readings (type A)"),
    ("evidence-unused.constant", "the evidence of `{name}` is not used: it is for a distribution that is \
        assumed (type B), and this one is a constant"),
    ("evidence-first-row", "`{name}` is not the same in all rows; its evidence is compared with the first row"),
    ("variant-undefined", "with another shape or width of `{name}` some trials have no finite result; those \
        variants have no figures"),
    ("drawn-together", "{names} are drawn together; they have one Sobol index as a set"),
    ("drawn-together.ranks", "{names} are drawn together; they have one Sobol index as a set. With another \
        shape the dependence of their ranks is kept, so that the correlation coefficient moves a little"),
];
