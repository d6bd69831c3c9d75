//! English.

use super::Sentences;

/// The sentences of all rooms.
pub(super) const ROOMS: [Sentences; 7] =
    [EVALUATION, FORMULAS, FILES, SIGNALS, GAP, COMMANDS, PARTS];

/// Facts of the engine about an evaluation.
#[rustfmt::skip]
const EVALUATION: Sentences = &[
    ("few-trials", "{trials} trials are few for a coverage probability of {probability}: JCGM 101, 7.2.2 \
        advises at least {needed}"),
    ("correlations-rounded", "the declared correlation coefficients are possible only within their rounding; \
        the nearest possible ones are used in the trials"),
    ("correlations-rounded.output", "`{name}`: the declared correlation coefficients give no positive \
        variance by the law of propagation, but the nearest possible coefficients do; use the Monte Carlo \
        results, or state the coefficients with more digits"),
    ("undefined-trials", "{count} of {trials} trials have no finite result and were left out"),
    ("gaussian-copula", "{names} are drawn with a Gaussian copula, fitted to their distributions and the \
        declared correlation coefficients. Their joint distribution beyond the coefficients is an \
        assumption"),
    ("copula-adjusted", "a Gaussian copula gives the declared correlation coefficients only within their \
        rounding; in the trials they differ by up to {difference}"),
    ("copula-adjusted.results", "a Gaussian copula gives the correlation coefficients of these saved \
        results only approximately; in the trials they differ by up to {difference}. Where outputs of one \
        result nearly cancel, evaluate everything in one model"),
    ("trials-off", "`{name}`: results of the trials differ from the results without trials by more than \
        {errors} numerical standard errors: {far}"),
    ("raised-to-cmc", "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) of \
        {cmc} and raised to it: state {expanded}"),
    ("raised-to-cmc.rows", "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) \
        in {count} of {of} rows, and raised to it there"),
    ("below-cmc", "the expanded uncertainty of `{name}` is {expanded}, below the laboratory's capability \
        (CMC) of {cmc}, and must not be stated (ILAC-P14)"),
    ("below-cmc.rows", "the expanded uncertainty of `{name}` is below the laboratory's capability (CMC) in \
        {count} of {of} rows, and must not be stated there (ILAC-P14)"),
    ("gum-undefined", "`{name}`{at}: the estimate or a sensitivity coefficient is not finite at the inputs' \
        estimates, so there is no GUM evaluation"),
    ("gum-dof-undefined", "`{name}`{at}: correlated inputs have finite degrees of freedom, for which the \
        Welch-Satterthwaite formula does not hold; use the Monte Carlo interval, or state a \
        `coverage_factor`"),
    ("gum-dof-undefined.stated", "`{name}`{at}: correlated inputs have finite degrees of freedom, for \
        which the Welch-Satterthwaite formula does not hold; the stated factor k = {k} is used unchanged"),
    ("not-converged", "`{name}`{at}: after {trials} trials the results are not yet stable within the \
        tolerance {tolerance}; see their numerical standard errors"),
    ("no-variance", "`{name}`{at}: an input is drawn from a t distribution with {dof} degrees of freedom, \
        which has no variance, so the trials have no standard uncertainty; the coverage intervals are \
        unaffected, and the value is the estimate by the law of propagation"),
    ("no-variance.of-model", "`{name}`{at}: an input is drawn from a t distribution with {dof} degrees of \
        freedom, which has no variance, and with this model no expectation, so the trials have no \
        estimate and no standard uncertainty; the coverage intervals are unaffected, and the value is the \
        estimate by the law of propagation"),
    ("no-variance.one", "`{name}`{at}: an input is drawn from a t distribution with {dof} degree of \
        freedom, which has no expectation and no variance, so the trials have no estimate and no standard \
        uncertainty; the coverage intervals are unaffected, and the value is the estimate by the law of \
        propagation"),
    ("no-variance.no-expectation", "`{name}`{at}: an input is drawn from a t distribution with {dof} \
        degrees of freedom, which has no expectation and no variance, so the trials have no estimate and \
        no standard uncertainty; the coverage intervals are unaffected, and the value is the estimate by \
        the law of propagation"),
    ("stated-by.gum", "`{name}`{at}: U is stated by the law of propagation, as `statement` requires"),
    ("stated-by.monte-carlo", "`{name}`{at}: U is stated by the interval of the trials, as `statement` \
        requires"),
    ("stated-by.few-dof", "`{name}`{at}: U is stated by the law of propagation, with k from the effective \
        degrees of freedom (EA-4/02 M:2022): with infinite degrees of freedom its endpoints differ from \
        the endpoints of the trials by {difference} % of U. `--statement monte-carlo` states the interval \
        of the trials"),
    ("stated-by.near", "`{name}`{at}: U is stated by the law of propagation: its endpoints differ from \
        the endpoints of the trials by {difference} % of U, which is within {allowed} %. `--statement \
        monte-carlo` states the interval of the trials"),
    ("stated-by.shape", "`{name}`{at}: U is stated by the interval of the trials: the endpoints of the law of \
        propagation differ from it by {difference} % of U, more than {allowed} %, because of the shape of a \
        distribution or a model that is not linear. `--statement gum` states the law of propagation"),
    ("stated-by.shape-few-dof", "`{name}`{at}: U is stated by the interval of the trials: also with infinite \
        degrees of freedom the endpoints of the law of propagation differ from the trials by {difference} % of \
        U, more than {allowed} %, because of the shape of a distribution or a model that is not linear. \
        `--statement gum` states the law of propagation"),
    ("few-dof", "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because some inputs have few \
        degrees of freedom{dof}: their t distributions have a larger standard deviation, which accounts for \
        {alone}. {conclusion}"),
    ("non-linear", "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because the model is \
        not linear over the uncertainties of its inputs{few_dof}{second}. Use the Monte Carlo results"),
    ("non-linear.second-order", "`{name}`{at}: {second}"),
    ("non-linear.results", "`{name}`{at}: the Monte Carlo standard uncertainty {difference} because the \
        trials of saved results have another standard deviation than their standard uncertainty \
        ({results}): their models are not linear. Use the Monte Carlo results"),
    ("correlations-by-propagation", "`{name}`: the standard deviation of its trials is not meaningful, so \
        its correlation coefficients are from the law of propagation"),
    ("correlations-by-propagation.none", "`{name}`: the standard deviation of its trials is not \
        meaningful, and there is no GUM evaluation, so it has no correlation coefficients"),
    ("conformity-by-propagation", "`{name}`: without trials the decision on its tolerance uses the law of \
        propagation with a normal or t distribution (JCGM 106, 7.2); trials show whether this is adequate"),
    ("heavy-tails", "`{name}`{at}: its moments depend on rare extreme trials, so that the trials give \
        {missing} (JCGM 101, 3.6, note 1); median and coverage intervals are unaffected, and {value}"),
    ("interval-of-extremes", "`{name}`{at}: with only {trials} trials the endpoints of the Monte Carlo \
        interval for this coverage probability are the extreme trials, without a numerical standard \
        error; clause 8 is undecided"),
    ("result-cancellation", "`{name}`{at}: outputs of a saved result nearly cancel, and the {trials} \
        trials of the result give their difference only to about {left}, with a standard uncertainty of \
        {spread} in the trials here; evaluate everything in one model"),
    ("copula-effect", "`{name}`{at}: with the correlation coefficients of the Gaussian copula instead of \
        the stated ones, its standard uncertainty in the trials is about {drawn}, not {linear}"),
    ("phase-jumps", "`{name}`: {percent} of the trials are one turn away from the others, beyond the cut \
        of a phase, so that mean, standard deviation and interval of the trials are meaningless; write \
        `\"periodic\": {turn}` at the output, to keep its values within half a turn of the estimate"),
    ("phase-jumps.apart", "`{name}`: {percent} of the trials are about {size} away from the others, \
        beyond a cut of `atan2`, a phase or `mod`, so that mean, standard deviation and interval of the \
        trials are meaningless; if values at this distance are equivalent, write the distance as \
        `\"periodic\"` at the output, to keep its values within half this distance of the estimate"),
    ("result-few-trials", "`{name}`{at}: saved results of few trials ({results}) leave results uncertain, \
        however many trials are made here: {errors} (one numerical standard error each); save those \
        results with more trials"),
    ("double-precision", "`{name}`: numbers of double precision, with 16 digits, leave {undetermined} of \
        `{input}` undetermined, {share} % of its standard uncertainty: it is {estimate} with a standard \
        uncertainty of {uncertainty}; use the difference from a reference value as input"),
    ("underflow", "`{name}`: a product, a quotient or a power in its equations is below the smallest \
        number of double precision, 2.2e-308, and is too small in the result; choose units of the size of \
        the quantities"),
];

/// Facts about formulas.
#[rustfmt::skip]
const FORMULAS: Sentences = &[
    ("share-converted-twice", "`{formula}` converts from {unit} once more: formulas have a share in {unit} \
        as a plain number already, so that its name is enough"),
    ("share-converted-twice.logarithm", "`{formula}` converts from {unit} once more, by {number}, the \
        logarithm of {of}: formulas have a share in {unit} as a plain number already; leave it out"),
    ("rate-converted-twice", "`{formula}` converts to radians per second once more: formulas have what is \
        given in {unit} in radians per second already, so that its name is enough"),
    ("angle-converted-twice", "`{formula}` converts to radians once more: formulas have an angle in {unit} \
        in radians already, so that its name is enough"),
    ("angle-converted-twice.degrees", "`{function}` takes radians, and `{argument}` is a number of degrees, \
        by its factor of 180/pi; leave that factor out, because formulas have angles in radians"),
    ("angle-of-turns", "`{function}` takes `{name}` in radians, because it has no unit of angle, and {angle} \
        rad are more than a turn; for an angle in degrees state `\"unit\": \"deg\"`"),
    ("angle-of-turns.constant", "`{function}` takes radians, and {angle} rad are more than a turn; an angle \
        in degrees is written `{angle} [deg]`"),
    ("angle-of-turns.phase", "`{name}` is {angle} rad, which are more than a turn, because a phase without a \
        unit is in radians; for one in degrees state `\"unit\": \"deg\"`"),
    ("rounded-as-number", "`{formula}` is computed to whole plain numbers, as formulas compute, and not to \
        whole {unit}; those are `{meant}`"),
    ("rounded-as-number.radians", "`{formula}` is computed to whole radians, as formulas compute, and not to \
        whole {unit}; those are `{meant}`"),
    ("bare-number", "in `{formula}`, {number} is the number {number}, that is {converted} {unit}, because \
        `{quantity}` is {given}; {number} {unit} are written `{meant}`"),
    ("bare-number.radians", "in `{formula}`, {number} is {number} rad, because `{quantity}` is {given}; \
        {number} {unit} are written `{meant}`"),
    ("bare-number.angle", "in `{formula}`, {number} is {number} rad, because `{quantity}` is an angle in \
        radians; {number} {unit} are written `{meant}`"),
    ("radians-as-periods", "`{formula}` is an angular frequency, in radians per second, by what it is made \
        of, and is reported as a frequency; that is `({formula})/(2*pi)`, and an angular frequency is \
        reported in `rad/s`"),
    ("periods-as-radians", "`{function}` takes radians, and `{argument}` counts periods, 2*pi radians each; \
        the angle is `2*pi*{argument}`"),
    ("periods-as-radians.torque", "`{formula}` multiplies a torque by periods, because its rate counts no \
        angle, and the work of a torque is by radians; the power is `2*pi*{formula}`, or give the rate in \
        `rpm`"),
    ("level-of-other-kind", "`{formula}` is 10 times the logarithm of a ratio of root-power quantities, \
        whose level is 20 times it; powers have 10, and voltages, currents, sound pressures and the like, \
        whose squares are powers, have 20"),
    ("level-of-other-kind.powers", "`{formula}` is 20 times the logarithm of a ratio of powers, whose level \
        is 10 times it; powers have 10, and voltages, currents, sound pressures and the like, whose squares \
        are powers, have 20"),
    ("radians-of-turns", "`{name}` counts angle and is reported in `{unit}` in radians, 2*pi for a \
        revolution; if revolutions are meant, write `.../[rev]`, or report it in rpm or rev"),
    ("radians-of-turns.inverse", "`{name}` is divided by what counts revolutions and is reported in `{unit}` \
        per radian; if it is meant per revolution, write `...*[rev]`"),
    ("radians-of-turns.product", "`{formula}` multiplies by radians, 2*pi for a revolution, because \
        formulas convert revolutions to radians; with revolutions it is `{formula}/[rev]`"),
    ("rate-of-turns", "`{name}` is read as an angular frequency with 2*pi radians for a revolution, \
        because nothing states that it counts revolutions; if it does, write `...*[rev]`, or give it in \
        `1/min`"),
    ("result-converted-twice", "`{formula}` converts to {unit}, and so does {what} in {unit}, once more: \
        formulas compute {computed}; leave the factor out{or_plain}"),
    ("result-converted-twice.product", "`{formula}` has{with} the factor of {factor} that converts from the \
        units of its quantities to {to}; leave the factor out, or let it be an input of its own if it is no \
        conversion{or_turns}"),
    ("quantity-converted-twice", "`{formula}` has the factor of {factor} that converts from the units of its \
        quantities to {to}, which formulas have done already; leave the factor out"),
    ("quantity-converted-twice.product", "`{formula}` has{with} the factor of {factor} that converts from \
        the units of its quantities to coherent SI units, in which formulas have them already; leave the \
        factor out, or let it be an input of its own if it is no conversion{or_turns}"),
    ("unit-left-out", "`{formula}` has no unit, so that formulas use its numbers as plain numbers (1 is \
        {one} {unit}), beside `{beside}` in {unit}; state its unit, `{unit}` or `{plain}`"),
    ("unit-left-out.output", "`{formula}` has no unit, so that formulas use its numbers as plain numbers \
        (1 is {one} {unit}), and the output is reported in {unit}; state its unit, `{unit}` or `{plain}`"),
    ("level-as-number", "`{name}` is a level, and is reported as its number of decibels, as formulas compute \
        it; report it in `dB` or in `Np`"),
    ("sum-of-levels", "`{name}` in {unit} adds levels above a reference, or multiplies one, so that it is \
        above no reference itself; the level of a sum of powers is `10*log10(10^(L1/10) + 10^(L2/10))`, and \
        gains are in dB"),
    ("celsius-as-kelvin", "`{name}` is a number of degrees Celsius by the unit of a coefficient, and is \
        reported in {unit} as a difference; write kelvin(...) for a thermodynamic temperature, or report it \
        in degC"),
    ("difference-in-degrees", "`{name}` is a difference of temperatures, and is reported in {unit}, so \
        that everything that uses it reads it as a temperature; report it in K, or, where a correction is \
        subtracted from a temperature, give the correction in K"),
    ("picohenry", "the unit `pH` of `{name}` is the picohenry; a pH value is a number, with the unit `1`"),
    ("imaginary-unit", "`i` is the quantity of that name in the formulas of this file, and not the imaginary \
        unit; if you mean that, give the quantity another name"),
    ("unused-input", "no equation uses the input `{name}`: it contributes nothing to any uncertainty"),
];

/// Facts about models, tables, certificates and other files.
#[rustfmt::skip]
const FILES: Sentences = &[
    ("placeholder-about", "the `about` of `{name}` is still \"{about}\" from a new file, and certificates \
        print it: write the source of the quantity, or remove the key"),
    ("units-not-checked", "units are not checked: formulas compute with the numbers in the declared units \
        ({quantities}{more})"),
    ("units-not-checked.plain", "units are not checked: every quantity is a plain number"),
    ("units-not-checked-changed", "CHECK THIS RESULT: {numbers}. Earlier versions converted them to SI \
        units first, such as `{name}` from {unit}, and gave other results for this file. If its formulas \
        are written for the declared units, this result is correct: state \"format\": 2. If they are \
        written for SI units, declare the quantities in SI units"),
    ("width-zero", "the width of `{of}` follows its estimate and becomes 0{rows}; it is a constant there"),
    ("share-of-zero", "the share of reading in the width of `{name}` is 0{rows}, like its estimate; of \
        another quantity's value it would be `20 ppm of 10 V`"),
    ("limits-moved", "the `limits` of `{name}` move along with its new estimate; if they must stay, like \
        the limits of a concentration that cannot be negative, write `{name}.mean=...` for the value \
        before truncation"),
    ("readings-replaced", "the readings of {names} are from `{file}`"),
    ("readings-kept", "`{file}` has no column for {names}: the readings of the model are kept"),
    ("readings-apart", "the readings of `{part}` have the mean {mean}, more than three of its standard \
        uncertainties from {estimate}, the stated estimate of `{name}`: only their scatter counts; leave the \
        estimate out to take their mean"),
    ("component-estimate", "the estimate {own} of the component `{part}` is added to {total}, the estimate \
        of `{name}`: together {sum}; components are deviations, about 0"),
    ("component-result", "the component `{part}` is a saved result of {estimate}, of which only the \
        deviation from it counts; a correction must be an input of its own that an equation adds"),
    ("resolution-taken", "`{name}`: the scatter of the readings is below the uncertainty of the \
        resolution, which is used instead as a rectangular distribution (JCGM 100, F.2.2.1)"),
    ("no-scatter", "`{name}`: all readings are equal and show no scatter; it is a constant beside the \
        other components, one of which must be the resolution"),
    ("nested-readings", "`{name}` is the mean of {groups} groups of readings; its standard uncertainty comes \
        from the means of the groups, with {dof} degrees of freedom (JCGM 100, H.5){within}"),
    ("dependent-readings", "`{name}`: the {count} readings are not independent: each is near the one \
        before it (von Neumann's ratio {ratio}, 2 for independent readings; independent readings give a \
        ratio this small in at most 1 case of 100). s/sqrt(n) is then too small (JCGM 100, 4.2.7): take \
        readings further apart, or means of groups"),
    ("dependent-readings.drift", "`{name}`: the {count} readings drift: a straight line through them \
        changes by {change} from the first to the last; independent readings give a line this steep in at \
        most 1 case of 100. s/sqrt(n) is only for independent readings (JCGM 100, 4.2.7): correct the \
        drift, and state the remaining uncertainty"),
    ("interpolated", "`{quantity}` takes values from a cubic spline through the {points} points of \
        `{file}` ({low} to {high}); straight lines differ by at most {difference} half way between them; \
        no uncertainty includes this unless an input states it"),
    ("interpolated.linear", "`{quantity}` takes values from straight lines through the {points} points of \
        `{file}` ({low} to {high}); a cubic spline differs by at most {difference} half way between them; \
        no uncertainty includes this unless an input states it"),
    ("date-origin", "dates are numbers of days since {origin}"),
    ("fit-not-valid", "the points do not agree with `{name}`: chi-squared is {chi2} with {dof} degrees of \
        freedom, above its 95 % quantile {limit}; the form or the stated uncertainties are not correct"),
    ("fit-units-not-checked", "units are not checked in the formula of `{name}`: it computes with x in {x} \
        and y in {y}, and its parameters are plain numbers; give the parameters of `start` with units"),
    ("extrapolation.fit", "`{name}` is used at x = {x}, outside its points from {low} to {high}: the \
        stated uncertainty assumes that the form is correct there"),
    ("interval-uncertainty", "`{name}`: where `{file}` states a standard uncertainty with a coverage \
        interval, it is used instead of U/k, whose digits are rounded"),
    ("certificate-distribution", "`{name}`: `{file}` names its distribution `{called}`, which is unknown; \
        a normal distribution with its standard uncertainty is used"),
    ("certificate-difference", "`{name}`: `{file}` gives a difference of temperatures, such as an error \
        or a correction, which is read in K; if it is a temperature, write `\"difference\": false`"),
    ("certificate-exact", "`{name}`: `{file}` states no uncertainty for this value, which is used as \
        exact; if a text or another quantity gives an uncertainty, state it in the model file"),
    ("certificate-before-adjustment", "`{name}`: by its status in `{file}` the value was found before an \
        adjustment or a repair; use the value after it, if the certificate has one (`gumption dcc`)"),
    ("certificate-asymmetric", "`{name}`: `{file}` states a coverage interval that is not symmetric about \
        the value; the value and its standard uncertainty are used, without the asymmetry"),
    ("certificate-correlation", "correlation coefficients between results of one certificate are kept: \
        {pairs}"),
    ("certificate-correlation-moved", "correlation coefficients of a certificate that are impossible for \
        the distributions of its results are replaced by the nearest possible ones: {pairs}"),
    ("codata-correlation", "correlation coefficients between measured constants are those of CODATA 2022: \
        {pairs}"),
    ("correlation-with-constant", "the correlation of `{first}` and `{second}` has no effect, because \
        `{constant}` has no uncertainty"),
    ("result-correlation", "the correlation of saved results is kept: {pairs}"),
    ("result-dependence-unknown", "`{first}` and `{second}` may depend on each other, because their \
        results go back to the same model file, but one of them has no finite sensitivity coefficients, \
        so the dependence is unknown; they are used as independent"),
    ("result-inputs-differ", "results of one model file with different quantities for one input are \
        independent in this input: {pairs}; if it is one quantity, evaluate the results in one model, or \
        state their correlation"),
    ("result-without-ranks", "of {pairs} only the correlation coefficients are known, not how they vary \
        together, because their result was saved by an older version; save it again"),
    ("result-without-digest", "`{file}` has no digest, like files of older versions: it is unknown \
        whether it was changed since it was saved"),
    ("result-changed", "`{file}` was changed since it was saved{parts}, and is used as it is now"),
    ("counted-twice", "`{name}` has the name and the values of an input of the result `{result}`, and \
        counts as independent of it; if they are one quantity, evaluate both in one model, or state their \
        correlation"),
    ("counted-twice.certificate", "`{name}` is a value of a certificate that the result `{result}` also \
        uses, and counts as independent of it; evaluate both in one model, or state their correlation"),
    ("grams", "`{name}`: its unit `{unit}` is the unit of a mass, of grams; an acceleration in units of \
        standard gravity is in `{meant}`"),
    ("effect-dimension", "effect `{name}`, override of `{quantity}`: {misfit}"),
    ("effect-dimension.other", "the formula gives {found}, but `{quantity}` is {own}"),
    ("effect-misfit", "the effect `{name}` is left out: it {reason}"),
    ("sheet-chosen", "sheet `{sheet}` is read, not {others}"),
    ("relative-uncertainties", "uncertainties in {units} are shares of the values"),
    ("angle-branch", "angles are compared within half a turn of each other: {angles}"),
    ("angle-branch.moved", "{angle} of `{name}` as {compared}"),
    ("columns-not-read", "the columns {names} are not read"),
    ("columns-not-read.one", "the column `{name}` is not read"),
    ("assigned-value-chosen", "the assigned value is the robust average of algorithm A, because no other one is stated \
        (`--assigned`)"),
    ("sigma-chosen", "the standard deviation for proficiency assessment is the robust standard deviation of algorithm \
        A, because no other one is stated (`--sigma`)"),
    ("few-participants", "{count} participants are fewer than {least}: robust estimates of so few results are not \
        reliable (ISO 13528:2022, D.1); state the assigned value and the standard deviation if they are \
        known"),
    ("algorithm-a-first-scale", "more than half of the results are equal: algorithm A started with the sample standard deviation \
        instead of the median absolute deviation, which is 0 (ISO 13528:2022, C.3.1); check the results \
        for outliers"),
    ("sigma-zero", "the results do not scatter by this estimate, so that there are no scores; state the standard \
        deviation for proficiency assessment, `--sigma VALUE`"),
    ("sigma-zero.share", "the assigned value is 0, and so is a share of it, so that there are no scores; state the \
        standard deviation for proficiency assessment in the unit of the results, `--sigma VALUE`"),
    ("assigned-value-without-uncertainty", "the assigned value has no stated uncertainty (`--assigned-u`), so that there are no z', zeta \
        and En scores"),
    ("assigned-uncertainty-large", "the standard uncertainty of the assigned value is {ratio} of the standard deviation for \
        proficiency assessment, above {limit}: z' scores decide (ISO 13528:2022, 9.2 and 9.5)"),
];

/// Facts about recordings.
#[rustfmt::skip]
const SIGNALS: Sentences = &[
    ("preamble", "`{name}`: line {first} is above the header in line {header} and is not read"),
    ("preamble.lines", "`{name}`: lines {first} to {last} are above the header in line {header} and are \
        not read"),
    ("uneven-instants", "`{name}`: the instants of the time column scatter by {percent} % of the sampling \
        interval (rms) about even spacing; if the samples really were taken then, state it as `jitter`"),
    ("sampling-rates-differ", "`{name}`: the recipe states a sampling rate of {stated} Hz, but {whose} \
        {found} Hz; the recipe's rate is used, so that frequencies are {times} times the frequencies of \
        the file; if the file is correct, leave out `sampling_rate`"),
    ("flat-channel", "`{name}`, channel `{channel}`: all values are {value}"),
    ("saturated", "`{name}`, {at}: {count} of {of} values are {value}, the {end} of the recording, and {next} \
        the next one to it; the channel may be saturated"),
    ("saturated.in-a-row", "`{name}`, {at}: {count} values in a row are {value}, the {end} of the recording; \
        the channel may be saturated"),
    ("near-noise", "`{name}`: noise alone makes an amplitude as large as the one at {frequency} Hz in \
        {percent} % of all records; the phase there is hardly known, and the amplitude is too large on \
        average"),
    ("strong-tone", "`{name}`: the multiple {multiple} of a frequency, which `components` does not name, \
        has an amplitude of {size} at {at} Hz, more than the {asked} at {hertz} Hz; check the frequency \
        and the sampling rate{other_unit}"),
    ("strong-tone.beside", "`{name}`: a tone that the recipe does not name has an amplitude of {size} at \
        {at} Hz, more than the {asked} at {hertz} Hz; check the frequency and the sampling \
        rate{other_unit}"),
    ("strong-tone.left", "`{name}`: a tone of {size} at about {at} Hz is in the residuals, more than the \
        {asked} at {hertz} Hz; check the frequency and the sampling rate{other_unit}"),
    ("tone-in-residuals", "`{name}`: most of the residuals is a tone of {size} at about {at} Hz, which is not \
        fitted and counts as noise{multiple}"),
    ("far-samples", "`{name}`: {samples}{more} are far beyond the rest, up to {far} robust standard deviations \
        of the residuals from the fit; if that is a spike or a number for a missing value, correct the \
        recording or leave that part out with `from` and `to`, because it counts like every other sample"),
    ("far-samples.one", "`{name}`: {samples} is far beyond the rest, up to {far} robust standard deviations of \
        the residuals from the fit; if that is a spike or a number for a missing value, correct the recording \
        or leave that part out with `from` and `to`, because it counts like every other sample"),
    ("filter-not-corrected", "`{name}`: gain of the {step} at {at} Hz, {value}, is not corrected"),
    ("filter-not-corrected.phase", "`{name}`: phase of the {step} at {at} Hz, {value}, is not corrected"),
    ("correlated-residuals", "`{name}`: the residuals are correlated (coefficient {coefficient} at lag 1); \
        {way}"),
    ("correlated-residuals.before-steps", "`{name}`: before the steps the residuals are correlated \
        (coefficient {coefficient} at lag 1); {way}"),
    ("short-record", "`{name}`: the record is too short to distinguish white noise from noise with a \
        memory; the standard uncertainties assume white noise and may be too small"),
    ("short-record.white-before-steps", "`{name}`: before the steps the record is too short to \
        distinguish white noise from noise with a memory; the standard uncertainties assume white noise \
        that goes through the steps and may be too small"),
    ("short-record.suspected", "`{name}`: the residuals may be correlated; the record is too short to \
        decide (coefficient {coefficient} at lag 1); {way}"),
    ("short-record.before-steps", "`{name}`: before the steps the residuals may be correlated; the record \
        is too short to decide (coefficient {coefficient} at lag 1); {way}"),
    ("waveform-ends-differ", "`{name}`: first and last sample of the record differ by {times} times their noise; the \
        correction takes the record as one period, so that values near the ends are wrong: record until the signal is \
        back where it began"),
    ("waveform-methods-differ", "`{name}`: the standard deviation of the trials' values is {drawn} in the mean, that \
        by the law of propagation {stated}: the correction is not linear within its uncertainties, and the trials' are \
        the ones to state"),
    ("waveform-quantity-missing", "`{name}`: {missing} of {trials} trials have no {figure}"),
    ("waveform-quantity-methods-differ", "`{name}`: the standard deviation of {figure} in the trials is {drawn}, that by \
        the law of propagation {stated}: it is not linear within its uncertainty (a greatest value picks the noise that \
        lifts it); a low-pass with a lower cut-off helps"),
    ("found-tone", "`{name}`: something oscillates that the recipe does not name, at {tones}; it is fitted \
        together with the named frequencies and counts as noise in the signal-to-noise ratio"),
    ("found-drift", "`{name}`: the level drifts by {range} over the record; a polynomial of degree {degree} is \
        fitted together with the named frequencies, the offset is the mean over the record with the drift's \
        standard deviation in its uncertainty, and the drift counts as noise in the signal-to-noise ratio"),
    ("tones-too-near", "`{name}`: something oscillates within {within} Hz (one over the record's length) \
        of a named frequency, or the oscillation at that frequency grows, fades or wanders; this record \
        cannot separate them, and amplitude and phase belong to both together; a longer record can"),
    ("wandering-level", "`{name}`: the level wanders and does not return within the record; the \
        uncertainty of the offset refers to the record's first value. A steady drift, which is not noise, \
        changes amplitudes and phases by more than their uncertainties: the step `remove-trend` removes a \
        straight line"),
    ("wandering-level.flicker", "`{name}`: the noise grows towards the lowest frequencies of the record, \
        as 1/f noise does, without a level of its own; the uncertainty of the offset refers to the mean \
        of a record ten times as long"),
    ("looks-quantized", "`{name}`: no resolution is stated, but the values are multiples of {step}, which \
        is used as resolution"),
    ("looks-quantized.finer", "`{name}`: a finer resolution is stated, but the values are multiples of \
        {step}, which is used as resolution"),
    ("coherent-sampling", "`{name}`: the {samples} samples fall on {phases} different phases of the \
        oscillation, and there is too little noise to blur the rounding, so that it averages out only \
        over these phases"),
    ("common-noise", "`{name}`: its noise is correlated with the noise of the reference (coefficient of \
        the two phases: {coefficient}); the uncertainty of the phase includes this"),
    ("frequency-differs", "`{name}`: the recording fits a frequency that differs by {by} Hz from \
        {frequency} Hz, more than their uncertainties allow; check the sampling rate, or let the \
        frequency be estimated"),
];

/// Facts about a diagnosis.
#[rustfmt::skip]
const GAP: Sentences = &[
    ("interrupted", "The diagnosis was interrupted; this is the state at the interruption. Hypotheses may \
        be missing, and their probabilities are rough. Unfinished parts (other noises, regions, \
        cross-validation, next measurements) are left out"),
    ("estimated-noise", "The noise of outputs without stated uncertainties is estimated from repeated rows and \
        residuals together"),
    ("estimated-noise.from-residuals", "There are neither stated uncertainties nor repeated rows, so the \
        noise is estimated from the residuals themselves: a departure that looks like noise cannot be \
        distinguished from it, and the chi-square test gives no information"),
    ("resolution", "The values of {name} are rounded to {resolution}, more coarsely than their noise: the \
        rounding counts as a standard uncertainty of {deviation}, the same for equal values at the same \
        conditions"),
    ("many-settings", "The residuals of {name} are similar in the rows of each setting, as if these \
        shared an error of about {ratio} times the noise of one row. Errors of settings are tried for at \
        most {most} settings times outputs; here there are {errors}. Give an input that has a value for \
        each setting (`per`), or the means of the settings with their uncertainties"),
    ("unit-slip", "The values of {name} are about {ratio} times the values of the sim {rows}: {cause} \
        would explain this factor; check the units of the data and of the sim before you accept an effect"),
    ("far-input", "The input `{input}` alone would explain the data if it were {distance} standard \
        uncertainties above its estimate{others}. This is not a hypothesis, because the stated inputs are \
        not in question: check the source of the value and its uncertainty"),
    ("far-input.below", "The input `{input}` alone would explain the data if it were {distance} standard \
        uncertainties below its estimate{others}. This is not a hypothesis, because the stated inputs are \
        not in question: check the source of the value and its uncertainty"),
    ("whole-turns", "{far} of {count} values of {name} are more than half a turn from the sim: state \
        `\"periodic\": {turn}` for a periodic output"),
    ("whole-turns.jumps", "The residuals of {name} jump by nearly a turn between neighbouring conditions, \
        and all values are within one turn: state `\"periodic\": {turn}` for a periodic output"),
    ("poor-integral", "Two independent integrals of the same hypothesis differ by {apart} in the \
        logarithm of the evidence; the probabilities are averages over this error and therefore less \
        certain"),
    ("poor-integral.few-draws", "The evidence of the verdict is from only {draws} effective draws \
        (standard error of its logarithm {error}); the probabilities are averages over this error and \
        therefore less certain"),
    ("look-alikes", "These data cannot distinguish the hypotheses of the verdict's group: their \
        predictions agree within the uncertainties. Only their prior probabilities and the prior widths \
        of their sizes decide between them"),
    ("small-gap", "The gap is below 3 standard uncertainties of the data, so the removed fraction is a \
        ratio of noise to noise and is not stated"),
    ("poor-fit", "The verdict is the best of the hypotheses but has a chi-square of {chi_square} per \
        value at left-out conditions: something is still missing"),
    ("curved-sim", "At the estimates of the inputs the residuals are {times} times as large as the law of \
        propagation allows, but other values of the inputs within their uncertainties explain them: the \
        sim is not linear in its inputs there"),
    ("row-drift", "The residuals of `{name}` after the verdict drift along the rows, from the first to \
        the last by {change} times the standard deviation of the noise (by chance in one of 10 000 \
        tables). If this is the order of measurement, something changes with time: give the time as a \
        condition, or an effect that drifts; otherwise the sizes are means over the rows"),
    ("row-drift.best-hypothesis", "The residuals of `{name}` after the best hypothesis drift along the \
        rows, from the first to the last by {change} times the standard deviation of the noise (by chance \
        in one of 10 000 tables). If this is the order of measurement, something changes with time: give \
        the time as a condition, or an effect that drifts; otherwise the sizes are means over the rows"),
    ("row-drift.memory", "The residuals of `{name}` change slowly along the rows: neighbouring rows have \
        a correlation coefficient of {coefficient} (by chance in one of 10 000 tables). If this is the \
        order of measurement, something changes with time, and the stated uncertainties may be correct: \
        give the time as a condition, or an effect that changes with it"),
    ("copied-rows", "Rows {rows}{more} repeat the conditions and, to all digits, the values of {firsts}. \
        {said}"),
    ("copied-rows.one", "Row {copy} repeats the conditions and, to all digits, the values of row {first}. \
        {said}"),
    ("several-rows", "rows {rows}{more}"),
    ("few-conditions", "There are only {count} different conditions; effects that differ elsewhere can be \
        equal here"),
    ("few-conditions.one", "There is only one condition; effects that differ elsewhere can be equal here"),
    ("periodic-residuals", "The residuals of `{name}` follow a sine along `{condition}` with period \
        {period} and amplitude {amplitude}, {percent} % of their variance (by chance in one of a million \
        tables): a periodic disturbance, not more noise. Give it as an effect, such as `{name} + \
        k*sin(2*pi*{condition}/({divisor}) + phi)`"),
    ("periodic-residuals.rows", "The residuals of `{name}` follow a sine along the rows, in their order, \
        with a period of {period} rows and amplitude {amplitude}, {percent} % of their variance (by \
        chance in one of a million tables): a periodic disturbance, not more noise. Give it as an effect, \
        such as `{name} + k*sin(2*pi*row/... + phi)` with a condition for the time or place of the rows"),
    ("prior-conflict", "{who} would explain the data with a {parameter} that is {distance} {counted_in} \
        (probability {probability}, with priors {widened} times as wide)"),
    ("wide-priors", "The priors of the effects' parameters are so wide that a departure of any form is \
        more probable than {effect}; with priors {times} times narrower {effect} is more probable. Use \
        priors that are only as wide as your knowledge requires"),
    ("wide-priors.several", "The priors of the effects' parameters are so wide that a departure of any \
        form is more probable than {effects}; with priors {times} times narrower {effects} are more \
        probable. Use priors that are only as wide as your knowledge requires"),
    ("undefined-prediction", "In {count} of {rows} rows of the prediction some hypotheses have no value \
        (a root or logarithm of a negative number, a division by zero). They are left out there; if they \
        are more probable than the others, nothing is predicted"),
    ("emulator", "With {name} the prediction error of the simulator's outputs is about {error} standard \
        uncertainties of the data (norm over all rows); less than {goal} is negligible. About {runs} more \
        runs are needed"),
    ("emulator.plain", "Without an effect the prediction error of the simulator's outputs is about \
        {error} standard uncertainties of the data (norm over all rows); less than {goal} is negligible. \
        About {runs} more runs are needed"),
    ("emulator.not-run", "With {name} the simulator was never run near the parameters that fit the data, \
        so its probability is from runs elsewhere. About {runs} more runs are needed"),
    ("emulator.plain-not-run", "Without an effect the simulator was never run near the inputs that fit \
        the data, so its probability is from runs elsewhere. About {runs} more runs are needed"),
    ("simulator", "The simulator was run {runs} times. At the reported parameters the prediction error of \
        its outputs is about {error} standard uncertainties of the data (norm over all rows)"),
    ("simulator.runs", "The simulator was run {runs} times"),
    ("simulator.scatter", "From run to run with the same parameters {name} of the simulator scatters by \
        {deviation} standard uncertainties of the data, as {repeats} runs at the start show. The scatter \
        is treated as independent from row to row and the same for all parameters. The data are compared \
        with the mean of the simulator, whose uncertainty from the scatter of the runs is included"),
    ("simulator.scatter-correlated", "From run to run with the same parameters {name} of the simulator \
        scatters by {deviation} standard uncertainties of the data, as {repeats} runs at the start show. \
        The scatter is treated as correlated over rows, with a coefficient of {correlation} between \
        neighbours that falls as its powers, and the same for all parameters. The data are compared with \
        the mean of the simulator, whose uncertainty from the scatter of the runs is included"),
    ("simulator.untold", "These data give no information about {names}: the uncertainty of each is the \
        same as in its prior"),
    ("simulator.together", "These data determine {first} and {second} together, but neither alone: their \
        correlation coefficient is {coefficient}"),
    ("simulator.failed", "{failed} of {runs} runs of the simulator failed, the first at {at}: {why}"),
    ("extrapolation", "{outside} of {rows} rows of the prediction are outside the conditions of the data. \
        No effect of the list describes the departure there: smooth and composed departures are averaged \
        with less weight on their probabilities, and the standard uncertainty increases with the distance"),
    ("extrapolation.effects", "{outside} of {rows} rows of the prediction are outside the conditions of \
        the data. The formulas of the effects are used there, but the data do not test them: hypotheses \
        that agree on the data may differ there, and are averaged with their probabilities"),
];

/// Facts that only a command knows.
#[rustfmt::skip]
const COMMANDS: Sentences = &[
    ("few-trials.audit", "{trials} trials are too few to detect the effect of assumptions; {made} are made"),
    ("more-than-two-digits", "U is stated to {digits} significant digits; an accredited certificate may have \
        at most two (ILAC-P14:09/2020, 5.3)"),
    ("rounded-away", "row {row}: U is stated as {stated}, {percent} % less than {expanded}; EA-4/02 \
        M:2022, 6.3, allows rounding to reduce U by at most 5 %: `\"rounding\": \"ea\"` rounds up there"),
    ("digits-of-trials", "row {row}: its values are from the trials, so their last digit depends on the \
        seed: {why}"),
    ("raised-to-cmc.certificate", "row {row}: U is raised to the laboratory's capability (CMC) of {cmc}"),
    ("below-cmc.certificate", "row {row}: U = {expanded} is below the laboratory's capability (CMC) of \
        {cmc}, which an accredited certificate may not state (ILAC-P14); `\"cmc_floor\": true` raises it"),
    ("not-stated", "the certificate lacks items required by ISO/IEC 17025:2017, 7.8.2.1 and 7.8.4.1: \
        {missing}"),
    ("evidence-unused", "the evidence of `{name}` is not used: it is for a distribution that is assumed \
        (type B), and this one is evaluated from readings (type A)"),
    ("evidence-unused.constant", "the evidence of `{name}` is not used: it is for a distribution that is \
        assumed (type B), and this one is a constant"),
    ("evidence-first-row", "`{name}` is not the same in all rows; its evidence is compared with the first row"),
    ("variant-undefined", "with another shape or width of `{name}` some trials have no finite result; \
        those variants have no results"),
    ("drawn-together", "{names} are drawn together; they have one Sobol index as a set"),
    ("drawn-together.ranks", "{names} are drawn together; they have one Sobol index as a set. With another \
        shape the dependence of their ranks is kept, so that the correlation coefficient moves a little"),
];

/// Facts that stand within others, and the notes that import gives without a code.
#[rustfmt::skip]
const PARTS: Sentences = &[
    ("moved", "{figure} by {by}"),
    ("figure.estimate", "its estimate"),
    ("figure.standard-uncertainty", "its standard uncertainty"),
    ("figure.median", "its median"),
    ("figure.inside", "its probability within the tolerance"),
    ("figure.symmetric-lower", "its lower endpoint of the symmetric interval"),
    ("figure.symmetric-upper", "its upper endpoint of the symmetric interval"),
    ("figure.shortest-lower", "its lower endpoint of the shortest interval"),
    ("figure.shortest-upper", "its upper endpoint of the shortest interval"),
    ("at", " at {conditions}"),
    ("condition", "{name} = {value}"),
    ("difference.above", "is {percent} larger than the GUM value"),
    ("difference.below", "is {percent} smaller than the GUM value"),
    ("difference.from-zero", "is not zero, unlike the GUM value"),
    ("beyond-bounds", "beyond all bounds"),
    ("in-brackets", " ({dof})"),
    ("few-dof-not-allowed-for", "Both are correct; here no coverage factor of the GUM includes it"),
    ("few-dof-allowed-for", "Both are correct; the GUM includes it in the coverage factor"),
    ("few-dof-long-tails", "The GUM includes it in its coverage factor from a t distribution, whose long \
        tails these inputs do not have"),
    ("non-linear-few-dof", "; few degrees of freedom{dof} alone would make it {alone} larger"),
    ("non-linear-terms", "; {said}"),
    ("second-order", "with its terms of second order (JCGM 100, 5.1.2, note) the law of propagation gives \
        {with_terms} instead of {linear}{products}"),
    ("second-order-products", "; {products}"),
    ("squared", "`{name}` squared"),
    ("times", "`{first}` times `{second}`"),
    ("contributes", "{product} contributes {contribution}"),
    ("contributes.hidden", "{product} contributes {contribution}, though their sensitivity coefficients \
        vanish here"),
    ("no-deviation", "no standard deviation"),
    ("no-moments", "no expectation and no standard deviation"),
    ("value-by-propagation", "the value is the estimate by the law of propagation"),
    ("value-is-median", "the value is the median"),
    ("beside.given", "given in {unit}"),
    ("beside.computed", "computed from what is given in {unit}"),
    ("converted-to.coherent-unit", "{unit}, in which formulas have them already"),
    ("converted-to.unit", "{unit}, and {what} in {unit} is converted, too: formulas compute in coherent SI \
        units"),
    ("converted-to.beside", "the units beside it"),
    ("converted-to.number", "a plain number"),
    ("with-equations", ", with the equations that it takes up,"),
    ("or-turns", "; a rate of revolutions is multiplied by 2*pi in its place"),
    ("or-without-unit", ", or give {what} without a unit"),
    ("computed.rates", "in radians per second"),
    ("computed.angles", "angles in radians"),
    ("computed.shares", "shares as plain numbers"),
    ("computed.ratios", "ratios as plain numbers"),
    ("result.output", "the output"),
    ("result.quantity", "the quantity"),
    ("result.named-output", "the output `{name}`"),
    ("all-of", "{parts} and {last}"),
    ("one-of", "{parts} or {last}"),
    ("more", "{count} more"),
    ("quoted", "`{name}`"),
    ("quoted.hidden", "`{name}` (hidden)"),
    ("quantity-in-unit", "`{name}` in {unit}"),
    ("more-quantities", ", ..."),
    ("in-row", " in row {row}"),
    ("in-row.and-others", " in row {row} and others"),
    ("groups.within", "; standard deviation within groups {deviation}{between}"),
    ("groups.between", ", between groups {deviation}, F = {ratio} (probability of a larger one without an \
        effect of the groups {probability})"),
    ("groups.of-other-sizes", "; the groups are not equally large, and their means count alike"),
    ("pairs", "{pairs}{more}"),
    ("pairs.more", " and {count} more pairs"),
    ("pair", "`{first}` and `{second}`"),
    ("pair.correlated", "`{first}` and `{second}` ({coefficient})"),
    ("pair.certified", "`{first}` and `{second}` ({coefficient}, from `{file}`)"),
    ("pair.moved", "`{first}` and `{second}` ({from} to {to})"),
    ("pair.with-input", "`{input}` of `{first}` and `{second}` ({reason})"),
    ("other-input.unknown-row", "one was saved by an older version, which did not save its data and its \
        row"),
    ("other-input.row", "of different rows"),
    ("other-input.values-set", "with other values set"),
    ("other-input.figures", "with another estimate or standard uncertainty"),
    ("other-input.unknown-place", "one was saved by an older version, which did not save its place in its \
        certificate"),
    ("other-input.content", "with the same values, but from files of different content"),
    ("changed-parts", " ({parts})"),
    ("misfit", "does not fit this sim{why}{condition}{needs}"),
    ("misfit.missing", ", which has no {quantities}"),
    ("misfit.prior", ": its prior is {prior}, which the data do not give"),
    ("misfit.unchanged", ", which has none of the quantities that it changes: {quantities}"),
    ("misfit.condition", "; the condition `{name}` is set and known: make it a quantity that is computed \
        from the condition, or an input whose mean is the condition"),
    ("misfit.anywhere", "; it {needs}"),
    ("misfit.on-bench", "; on the bench `{bench}` it {needs}"),
    ("misfit.needs", "needs {quantities}"),
    ("misfit.changes", "changes {quantities}"),
    ("misfit.history", "does not fit these data: the order of their rows does not separate its history \
        from the conditions, for example because a condition only increases"),
    ("misfit.no-change", "changes no observed output"),
    ("misfit.refused", "cannot act on this sim: {error}"),
    ("observed.amplitudes", "each observed output that is not a phase"),
    ("observed.phases", "each observed output that is a phase"),
    ("import.columns", "row {row}: columns {columns}"),
    ("import.column", "`{heading}` as {name}{unit}"),
    ("import.in-unit", " in {unit}"),
    ("import.named-column", "column {letter} `{heading}`"),
    ("import.hidden-column", "{column} is hidden, and is read"),
    ("import.column-not-read", "{column} is not read"),
    ("import.column-remark", "{column} is kept as a remark"),
    ("import.merged-cell", "the merged cell `{text}` counts for rows {first} to {last}"),
    ("import.row-not-read", "row {row} `{text}` is not read"),
    ("import.row-without-numbers", "row {row} `{text}` has no numbers and is not read"),
    ("import.row-constant", "row {row} `{text}` has no uncertainty and is a constant of the equation"),
    ("import.row-named", "row {row}: `{words}` is called `{name}`"),
    ("import.distribution", "row {row}: the standard uncertainty of `{text}` is used, as for a normal \
        distribution"),
    ("import.dof", "line {line}: {dof} degrees of freedom are read from `{text}`"),
    ("import.equation", "the equation {name} = {formula}"),
    ("import.unit-of-result", "the result is in `{unit}`, the coherent unit of its equation"),
    ("import.constant", "the constant {constant} is added, which makes the estimate of the result: the model \
        is linear about the estimates"),
    ("import.sum", "{name} = {formula}: the sum of the quantities times their sensitivity coefficients, in \
        {unit}"),
    ("import.unchanged", "the model file of this workbook; no estimate, standard uncertainty, degrees of \
        freedom or correlation was changed, and other cells are ignored"),
    ("import.changed-estimate", "`{name}`: estimate {now} instead of {before}"),
    ("import.changed-uncertainty", "`{name}`: standard uncertainty {now} instead of {before}"),
    ("import.changed-dof", "`{name}`: degrees of freedom {now} instead of {before}"),
    ("import.changed-probability", "coverage probability {now} instead of {before}"),
    ("import.changed-correlation", "{name} = {coefficient}"),
    ("import.normal-now", "`{name}` is normal now: the former distribution ({distribution}) does not \
        agree with the changed cells"),
    ("of-time-column", "its time column has"),
    ("of-header", "its header says"),
    ("highest", "highest"),
    ("lowest", "lowest"),
    ("sample-of-time", "sample {sample}, the time"),
    ("sample-of-channel", "sample {sample}, channel `{channel}`"),
    ("frequency-in-other-unit", " ({number} {unit} is {hertz} Hz)"),
    ("peak-amplitude", "{amplitude} (peak)"),
    ("higher-multiple", ": the multiple {multiple} of the frequency, and `harmonics` is {harmonics}"),
    ("far-sample", "{value} at {at} s"),
    ("and-more", " and {count} more"),
    ("noise-of-parts", "the noise near each frequency is taken from {parts} parts of the record"),
    ("noise-of-process", "the noise near each frequency is taken from a process of first order that describes \
        the residuals"),
    ("noise-of-process.before-steps", "the noise near each frequency after the steps is taken from a process \
        of first order that describes these residuals"),
    ("noise-even", "the record is too short to estimate the noise near each frequency, which is assumed \
        to be even over the band of the steps, so standard uncertainties may be too small"),
    ("noise-unknown", "the record is too short to estimate the noise near each frequency, so standard \
        uncertainties may be too small"),
    ("other-tone", "{frequency} Hz (amplitude {amplitude})"),
    ("slip-in-all-rows", "in all rows"),
    ("slip-in-rows", "in the rows {first} to {last}, and agree with it in the others"),
    ("slip-in-rows.some", "in {count} of the rows {first} to {last}, and agree with it in the others"),
    ("slip-of.prefix", "a prefix, or per cent"),
    ("slip-of.sign", "a sign"),
    ("slip-of.turn", "a frequency in Hz for one in rad/s"),
    ("slip-of.minute", "a time in minutes for one in seconds, or minutes for degrees"),
    ("slip-of.hour", "a time in hours for one in seconds"),
    ("slip-of.degree", "an angle in degrees for one in rad"),
    ("slip-of.peak", "an RMS value for a peak value"),
    ("other-far-inputs", ". So would {inputs}, farther from their estimates"),
    ("scatter", "The residuals are {times} times as large as their uncertainties allow, but without a \
        pattern that an effect or a smooth discrepancy would make: the stated noise is probably too \
        small, or single values are wrong"),
    ("one-row", "row {row}"),
    ("range-of-rows", "{first} to {last}"),
    ("copies-count-once", "Independent readings with the stated uncertainties would repeat so often with \
        a probability below {below}: the repeated values were copied, or the rows share one uncertainty, \
        so they give no new information. These rows count once, {counted} of {all}"),
    ("copies-count-once.one", "Independent readings with the stated uncertainties would repeat one \
        another with a probability below {below}: the repeated value was copied, or the rows share one \
        uncertainty, so it gives no new information. These rows count once, {counted} of {all}"),
    ("copies-unknown", "Without stated uncertainties it is unknown whether they were measured, so they \
        count with noise of their own. If they were copied, the diagnosis is too certain, or finds a gap \
        that does not exist: leave these rows out unless they were measured"),
    ("copies-unknown.one", "Without stated uncertainties it is unknown whether it was measured, so it \
        counts with noise of its own. If it was copied, the diagnosis is too certain, or finds a gap that \
        does not exist: leave these rows out unless they were measured"),
    ("copies-by-chance", "This is rare by chance, but they may have been measured, so they count with \
        noise of their own. If they were copied, the diagnosis is too certain, or finds a gap that does \
        not exist: leave these rows out unless they were measured"),
    ("copies-by-chance.one", "This is rare by chance, but it may have been measured, so it counts with \
        noise of its own. If it was copied, the diagnosis is too certain, or finds a gap that does not \
        exist: leave these rows out unless they were measured"),
    ("effect-alone", "{effect} alone"),
    ("effects-together", "{others} and {last}"),
    ("widths-beyond-bound", "prior widths beyond the bound of the prior"),
    ("deviations-from-mean", "prior standard deviations from the mean of the prior"),
    ("effect-with", "{first} with {second}"),
    ("of-model", "{model}: "),
    ("of-row", "row {row}, "),
];
