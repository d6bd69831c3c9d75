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
    ("near-noise", "`{name}`: noise alone makes an amplitude as large as the one at {frequency} Hz in \
        {percent} % of all records; the phase there is hardly known, and the amplitude is too large on \
        average"),
    ("strong-tone", "`{name}`: the multiple {multiple} of a frequency, which `components` does not name, has \
        an amplitude of {size} at {at} Hz, more than the {asked} at {hertz} Hz; look at the frequency and the \
        sampling rate{other_unit}"),
    ("strong-tone.beside", "`{name}`: a tone that the recipe does not name has an amplitude of {size} at {at} \
        Hz, more than the {asked} at {hertz} Hz; look at the frequency and the sampling rate{other_unit}"),
    ("strong-tone.left", "`{name}`: a tone of {size} at about {at} Hz is in the residuals, more than the \
        {asked} at {hertz} Hz; look at the frequency and the sampling rate{other_unit}"),
    ("frequency-in-other-unit", " ({number} {unit} is {hertz} Hz)"),
    ("peak-amplitude", "{amplitude} (peak)"),
    ("tone-in-residuals", "`{name}`: most of the residuals is a tone of {size} at about {at} Hz, which is not \
        fitted and counts as noise{multiple}"),
    ("higher-multiple", ": the multiple {multiple} of the frequency, and `harmonics` is {harmonics}"),
    ("far-samples", "`{name}`: {samples}{more} are far beyond the rest, up to {far} robust standard deviations \
        of the residuals from the fit; if that is a spike or a number for a missing value, correct the \
        recording or leave that part out with `from` and `to`, because it counts like every other sample"),
    ("far-samples.one", "`{name}`: {samples} is far beyond the rest, up to {far} robust standard deviations of \
        the residuals from the fit; if that is a spike or a number for a missing value, correct the recording \
        or leave that part out with `from` and `to`, because it counts like every other sample"),
    ("far-sample", "{value} at {at} s"),
    ("and-more", " and {count} more"),
    ("filter-not-corrected", "`{name}`: gain of the {step} at {at} Hz, {value}, is not corrected"),
    ("filter-not-corrected.phase", "`{name}`: phase of the {step} at {at} Hz, {value}, is not corrected"),
    ("correlated-residuals", "`{name}`: the residuals are correlated (coefficient {coefficient} at lag 1); \
        {way}"),
    ("correlated-residuals.before-steps", "`{name}`: before the steps the residuals are correlated \
        (coefficient {coefficient} at lag 1); {way}"),
    ("short-record", "`{name}`: the record is too short to tell white noise from noise with a memory; the \
        standard uncertainties assume white noise and may be too small"),
    ("short-record.white-before-steps", "`{name}`: before the steps the record is too short to tell white \
        noise from noise with a memory; the standard uncertainties assume white noise that goes through the \
        steps and may be too small"),
    ("short-record.suspected", "`{name}`: the residuals may be correlated, which the record is too short to \
        tell (coefficient {coefficient} at lag 1); {way}"),
    ("short-record.before-steps", "`{name}`: before the steps the residuals may be correlated, which the \
        record is too short to tell (coefficient {coefficient} at lag 1); {way}"),
    ("noise-of-parts", "the noise near each frequency is taken from {parts} parts of the record"),
    ("noise-of-process", "the noise near each frequency is taken from a process of first order that describes \
        the residuals"),
    ("noise-of-process.before-steps", "the noise near each frequency after the steps is taken from a process \
        of first order that describes these residuals"),
    ("noise-even", "the record is too short to tell the noise near each frequency, which is taken as even over \
        what the steps let pass, so standard uncertainties may be too small"),
    ("noise-unknown", "the record is too short to tell the noise near each frequency, so standard \
        uncertainties may be too small"),
    ("found-tone", "`{name}`: something oscillates that the recipe does not name, at {tones}; it is fitted \
        together with the named frequencies and counts as noise in the signal-to-noise ratio"),
    ("other-tone", "{frequency} Hz (amplitude {amplitude})"),
    ("found-drift", "`{name}`: the level drifts by {range} over the record; a polynomial of degree {degree} is \
        fitted together with the named frequencies, the offset is the mean over the record with the drift's \
        standard deviation in its uncertainty, and the drift counts as noise in the signal-to-noise ratio"),
    ("tones-too-near", "`{name}`: something oscillates within {within} Hz (one over the record's length) of a \
        named frequency, or the oscillation at that frequency grows, fades or wanders; this record cannot tell \
        them apart, amplitude and phase belong to both together, and only a longer record tells more"),
    ("wandering-level", "`{name}`: the level wanders and does not come back within the record; the uncertainty \
        of the offset refers to the record's first value. A steady drift, which is not noise, leaks into \
        amplitudes and phases more than their uncertainties say: the step `remove-trend` removes a straight \
        line"),
    ("wandering-level.flicker", "`{name}`: the noise grows towards the lowest frequencies of the record, as \
        1/f noise does, which has no level of its own; the uncertainty of the offset refers to the mean of a \
        record ten times as long"),
    ("looks-quantized", "`{name}`: no resolution is stated, but the values are multiples of {step}, which is \
        taken for it"),
    ("looks-quantized.finer", "`{name}`: a finer resolution is stated, but the values are multiples of {step}, \
        which is taken for it"),
    ("coherent-sampling", "`{name}`: the {samples} samples fall on {phases} different phases of the \
        oscillation, and there is too little noise to blur the rounding, so that it averages out over these \
        only"),
    ("common-noise", "`{name}`: its noise and the noise of the reference have something in common (the errors \
        of the two phases are correlated, {coefficient}); the phase's uncertainty allows for it"),
    ("frequency-differs", "`{name}`: the recording fits a frequency that differs by {by} Hz from {frequency} \
        Hz, more than their uncertainties allow; look at the sampling rate, or let the frequency be estimated"),
];

/// Facts about a diagnosis.
#[rustfmt::skip]
const GAP: Sentences = &[
    ("interrupted", "The diagnosis was interrupted; this is what was known then. Hypotheses may be missing, \
        their probabilities are rough, and what had not been begun (other noises, regions, cross-validation, \
        what to measure next) is left out"),
    ("estimated-noise", "The noise of outputs without stated uncertainties is estimated from repeated rows and \
        residuals together"),
    ("estimated-noise.from-residuals", "There are neither stated uncertainties nor repeated rows, so the noise \
        is estimated from the residuals themselves: a departure that looks like noise cannot be told from it, \
        and the chi-square test says nothing"),
    ("resolution", "The values of {name} are rounded to {resolution}, more coarsely than their noise: what \
        that may have changed counts as a standard uncertainty of {deviation}, the same for equal values at \
        the same conditions"),
    ("many-settings", "What is left of {name} is alike in the rows of each setting, as if they shared an error \
        of about {ratio} times the noise of one row. Such errors are weighed up to {most} settings times \
        outputs, and here are {errors}: give an input that has a value for each setting (`per`), or the means \
        of the settings with their uncertainties"),
    ("unit-slip", "The values of {name} are about {ratio} times what the sim says {rows}: {cause} makes such a \
        factor; look at the unit of the data and of the sim before you believe an effect"),
    ("slip-in-all-rows", "in all rows"),
    ("slip-in-rows", "in the rows {first} to {last}, and agree with it in the others"),
    ("slip-in-rows.some", "in {count} of the rows {first} to {last}, and agree with it in the others"),
    ("slip-of.prefix", "a prefix, or per cent"),
    ("slip-of.sign", "a sign"),
    ("slip-of.turn", "a frequency in Hz for one in rad/s"),
    ("slip-of.minute", "a time in minutes for one in seconds, or minutes for degrees"),
    ("slip-of.hour", "a time in hours for one in seconds"),
    ("slip-of.degree", "an angle in degrees for one in rad"),
    ("slip-of.peak", "an effective value for a peak value"),
    ("far-input", "The input `{input}` alone would explain the data if it were {distance} standard \
        uncertainties above its estimate{others}. That is no hypothesis, because inputs are what they are \
        stated to be: look at where the value comes from and how its uncertainty was found"),
    ("far-input.below", "The input `{input}` alone would explain the data if it were {distance} standard \
        uncertainties below its estimate{others}. That is no hypothesis, because inputs are what they are \
        stated to be: look at where the value comes from and how its uncertainty was found"),
    ("other-far-inputs", ". So would {inputs}, further from their estimates"),
    ("whole-turns", "{far} of {count} values of {name} are more than half a turn from the sim: an output that \
        comes round says `\"periodic\": {turn}`"),
    ("whole-turns.jumps", "What the sim leaves of {name} jumps by nearly a turn between neighbouring \
        conditions, and all values lie within one turn: an output that comes round says `\"periodic\": \
        {turn}`"),
    ("poor-integral", "Two independent integrals of the same hypothesis differ by {apart} in the logarithm of \
        the evidence; the probabilities are averages over that error and less certain because of it"),
    ("poor-integral.few-draws", "The evidence of the verdict rests on {draws} effective draws only (standard \
        error of its logarithm {error}); the probabilities are averages over that error and less certain \
        because of it"),
    ("look-alikes", "These data cannot tell the hypotheses of the verdict's group apart: their predictions \
        coincide within the uncertainties, and what decides between them is prior: their probabilities and how \
        wide their sizes may be"),
    ("small-gap", "The gap is below 3 standard uncertainties of the data, so the removed fraction is a ratio \
        of two noises and is not stated"),
    ("poor-fit", "The verdict is the best of the hypotheses but leaves a chi-square of {chi_square} per value \
        on conditions that were left out: something is still missing"),
    ("scatter", "The residuals are {times} times as large as their uncertainties allow, but without a pattern \
        that an effect or a smooth discrepancy would make: the stated noise is probably too small, or values \
        are wrong one by one"),
    ("curved-sim", "At the estimates of the inputs the residuals are {times} times as large as the law of \
        propagation allows, but values within what is known of the inputs explain them: the sim is not linear \
        in its inputs there"),
    ("row-drift", "What the verdict leaves of `{name}` drifts along the rows, from the first to the last by \
        {change} times the standard deviation that its noise is found to have (so steep by chance in one of 10 \
        000 tables). If that is the order in which they were taken, something changes with time: give the time \
        as a condition, or an effect that drifts; sizes that are found without it are means over the rows"),
    ("row-drift.best-hypothesis", "What the best hypothesis leaves of `{name}` drifts along the rows, from the \
        first to the last by {change} times the standard deviation that its noise is found to have (so steep \
        by chance in one of 10 000 tables). If that is the order in which they were taken, something changes \
        with time: give the time as a condition, or an effect that drifts; sizes that are found without it are \
        means over the rows"),
    ("row-drift.memory", "What is left of `{name}` changes slowly along the rows: neighbouring ones have a \
        coefficient of correlation of {coefficient} (as large by chance in one of 10 000 tables). If that is \
        the order in which they were taken, something changes with time, and the stated uncertainties may be \
        right: give the time as a condition, or an effect that changes with it"),
    ("copied-rows", "Rows {rows}{more} have the conditions and, to all digits, the values of {firsts}. {said}"),
    ("copied-rows.one", "Row {copy} has the conditions and, to all digits, the values of row {first}. {said}"),
    ("one-row", "row {row}"),
    ("several-rows", "rows {rows}{more}"),
    ("range-of-rows", "{first} to {last}"),
    ("copies-count-once", "Independent readings with the stated uncertainties would repeat so often with a \
        probability below {below}: what repeats was copied, or its uncertainty is one that the rows share, and \
        tells nothing new. Such rows count once, {counted} of {all}"),
    ("copies-count-once.one", "Independent readings with the stated uncertainties would repeat one another \
        with a probability below {below}: what repeats was copied, or its uncertainty is one that the rows \
        share, and tells nothing new. Such rows count once, {counted} of {all}"),
    ("copies-unknown", "Without stated uncertainties it cannot be told whether they were measured, so they \
        count with noise of their own. If they were copied, that makes the diagnosis too sure, or finds a gap \
        that is not there: leave such rows out unless they were measured"),
    ("copies-unknown.one", "Without stated uncertainties it cannot be told whether it was measured, so it \
        counts with noise of its own. If it was copied, that makes the diagnosis too sure, or finds a gap that \
        is not there: leave such rows out unless they were measured"),
    ("copies-by-chance", "Chance seldom does that, but it cannot be excluded that they were measured, so they \
        count with noise of their own. If they were copied, that makes the diagnosis too sure, or finds a gap \
        that is not there: leave such rows out unless they were measured"),
    ("copies-by-chance.one", "Chance seldom does that, but it cannot be excluded that it was measured, so it \
        counts with noise of its own. If it was copied, that makes the diagnosis too sure, or finds a gap that \
        is not there: leave such rows out unless they were measured"),
    ("few-conditions", "There are only {count} different conditions; effects that differ elsewhere look alike \
        here"),
    ("few-conditions.one", "There is only one condition; effects that differ elsewhere look alike here"),
    ("periodic-residuals", "What is left of `{name}` follows a sine along `{condition}` with a period of \
        {period} and of the amplitude {amplitude}, which is {percent} % of its variance (as much by chance in \
        one of a million tables): a disturbance that comes round, and no larger noise. Give it as an effect, \
        such as `{name} + k*sin(2*pi*{condition}/({divisor}) + phi)`"),
    ("periodic-residuals.rows", "What is left of `{name}` follows a sine along the rows, in their order, with \
        a period of {period} rows and of the amplitude {amplitude}, which is {percent} % of its variance (as \
        much by chance in one of a million tables): a disturbance that comes round, and no larger noise. Give \
        it as an effect, such as `{name} + k*sin(2*pi*row/... + phi)` of a condition that says when or where \
        they were taken"),
    ("prior-conflict", "{who} would explain the data with {parameter} of a size that is {distance} \
        {counted_in} (probability {probability}, with priors {widened} times as wide)"),
    ("effect-alone", "{effect} alone"),
    ("effects-together", "{others} and {last}"),
    ("widths-beyond-bound", "widths of your prior beyond its bound"),
    ("deviations-from-mean", "standard deviations of your prior from its mean"),
    ("wide-priors", "The priors of the effects' parameters are so wide that a departure of any form is more \
        probable than {effect}; with priors {times} times narrower {effect} is more probable. Make priors no \
        wider than you would bet"),
    ("wide-priors.several", "The priors of the effects' parameters are so wide that a departure of any form is \
        more probable than {effects}; with priors {times} times narrower {effects} are more probable. Make \
        priors no wider than you would bet"),
    ("effect-with", "{first} with {second}"),
    ("undefined-prediction", "In {count} of {rows} rows of the prediction hypotheses of some probability have \
        no value (a root or logarithm of a negative number, a division by zero). They are left out there; \
        where they are more probable than the others nothing is predicted"),
    ("extrapolation", "{outside} of {rows} rows of the prediction lie outside of the conditions of the data. \
        No effect of the list says how the departure goes on there: smooth and composed departures are \
        averaged with less regard to their probabilities, and the standard uncertainty is enlarged with the \
        distance"),
    ("extrapolation.effects", "{outside} of {rows} rows of the prediction lie outside of the conditions of the \
        data. The effects go on there as their formulas say, and the data do not show whether they do: \
        hypotheses that agree on the data may differ there, and are averaged with their probabilities"),
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
    ("in-row", "row {row}, "),
];
