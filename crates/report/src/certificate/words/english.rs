//! English.

use super::Words;

pub(super) const WORDS: Words = Words {
    title: "Calibration certificate",
    number: "Certificate number",
    device: "Device",
    manufacturer: "Manufacturer",
    model: "Type",
    condition: "Condition as received",
    serial_number: "Serial number",
    customer_number: "Customer's number",
    customer: "Customer",
    laboratory: "Laboratory",
    accreditation: "Accreditation",
    code: "Laboratory code",
    responsible: "Responsible",
    calibrated: "Date of calibration",
    period: "{first} to {last}",
    received: "Date of receipt",
    issued: "Date of issue",
    place: "Place of calibration",
    places: [
        "laboratory",
        "at the customer's",
        "branch of the laboratory",
        "branch of the customer",
        "elsewhere",
    ],
    environment: "Environment",
    method: "Method",
    traceability: "Traceability",
    remarks: "Remarks",

    results: "Results",
    row: "row",
    quantity: "quantity",
    conditions: "conditions",
    nominal: "nominal",
    value: "value",
    expanded: "U",
    unit: "unit",
    in_unit: "in {unit}",
    limits_heading: "limits",
    probability: "p in %",
    low: "from",
    high: "to",

    uncertainty: "Uncertainty of measurement",
    rows: ["Row {rows}: ", "Rows {rows}: "],
    and: " and ",
    normal: "The expanded uncertainty U is the standard uncertainty multiplied by the coverage factor \
        k = {k}, which for a normal distribution corresponds to a coverage probability of {p}.",
    student: "The expanded uncertainty U is the standard uncertainty multiplied by the coverage \
        factor k stated with it, which for a t distribution with the effective degrees of freedom \
        ν_eff corresponds to a coverage probability of {p}.",
    fixed: "The expanded uncertainty U is the standard uncertainty multiplied by the agreed coverage \
        factor k = {k}. No distribution is assumed, so no coverage probability is stated.",
    agreed: "The expanded uncertainty U is the standard uncertainty multiplied by the agreed coverage \
        factor k = {k}. The stated coverage probability follows from the t distribution with the \
        effective degrees of freedom ν_eff.",
    shortest: "The stated coverage interval is the shortest one with a coverage probability of {p}, found \
        by the Monte Carlo method (JCGM 101:2008). U is the larger distance from the value to an endpoint \
        of the interval; k = U/u.",
    without_trials: "The stated coverage interval has a coverage probability of {p}. It was found by the \
        propagation of distributions (JCGM 101:2008, clause 5) without random trials. It is the shortest \
        interval, or the symmetric interval if that is longer by less than 1 %. U is the larger distance \
        from the value to an endpoint of the interval; k = U/u.",
    propagation: "The standard uncertainty was evaluated by the law of propagation of uncertainty (JCGM \
        100:2008), as required by EA-4/02 M:2022.",
    time: "The stated uncertainties do not include the long-term stability of the device.",
    confirmed: "The Monte Carlo method (JCGM 101:2008, clause 8) confirms these intervals.",
    rounding: "U is given to {digits} ({rule}); the value is rounded to the same decimal place.",
    rules: [
        "rounded to the nearest",
        "rounded to the nearest; rounded up if U would be reduced by more than 5 %, EA-4/02 M:2022",
        "rounded up",
    ],
    kept: "U is rounded up, because it would otherwise be below the laboratory's calibration and \
        measurement capability (CMC).",
    digits: ["one significant digit", "{digits} significant digits"],
    raised: [
        "The evaluated expanded uncertainty is smaller than the laboratory's calibration and \
            measurement capability (CMC), which is stated as U instead (ILAC-P14:09/2020), {factor}; the interval from value - U to value \
            + U has a coverage probability of at least {p}.",
        "The evaluated expanded uncertainty is smaller than the laboratory's calibration and \
            measurement capability (CMC), which is stated as U instead (ILAC-P14:09/2020), {factor}.",
    ],
    of_capability: [
        "with the coverage factor k = {k} of the capability",
        "converted from the coverage factor 2 of the capability to k = {k}",
    ],
    dof_list: "Effective degrees of freedom ν_eff: {list}.",
    approximately: "approximately {p}",

    function: "Calibration function {name}",
    in_range: "{equation} for {low} ≤ x ≤ {high}, with x and {name} as numbers in the stated units.",
    band: "U is the expanded uncertainty of the function at x, with the coverage factor k = {k}; it does \
        not include the uncertainty of a further reading. Between the stated values of x it follows from \
        u(x)² = g(x)' V g(x). g are the derivatives with respect to the parameters; V is their covariance \
        matrix, from their standard uncertainties and correlation coefficients r.",
    parameter: "parameter",
    standard: "u",
    region: "Coverage region",
    ellipsoid: "ellipsoid (y - x)' U⁻¹ (y - x) ≤ k²",
    cuboid: "box of half-lengths k u",
    smallest: "smallest region of the trials: volume {volume}",
    measurement: "Measurement model",
    equation: "equation",
    symbol: "symbol",
    meaning: "meaning",
    correlation: "Correlation of the rows",
    correlated: "Rows that share inputs are correlated. The standard uncertainty of the difference of \
        rows i and j follows from u² = u_i² + u_j² - 2 r u_i u_j, with the standard uncertainties u_i and \
        u_j and the coefficient r stated here. They are from the law of propagation; U_i / k_i may differ \
        from them.",
    correlated_raised: "If U is the laboratory's capability, u_i includes it; its addition to the \
        evaluated uncertainty is assumed to be uncorrelated with the other rows.",
    shared: "The rows share: {inputs}.",
    many: "Some of the {rows} rows share inputs; correlation coefficients and the corresponding standard \
        uncertainties are in the JSON answer and in the workbook.",
    conformity: "Conformity",
    decided: ["conforms", "does not conform", "not shown"],
    decisions: [
        "The result conforms to the tolerance {limits}.",
        "The result does not conform to the tolerance {limits}.",
    ],
    not_shown: [
        "It is not shown that the result conforms to the tolerance {limits}: it is within the tolerance, \
            but outside the acceptance limits. The decision rule rejects it.",
        "It is not shown that the result conforms to the tolerance {limits}: it is within the tolerance, \
            but the decision rule accepts no value. The result is rejected.",
    ],
    levels: ["pass", "conditional pass", "conditional fail", "fail"],
    level_decisions: [
        "Pass: the result conforms to the tolerance {limits} and is within the acceptance limits.",
        "Conditional pass: the result is within the tolerance {limits}, but in the guard band.",
        "Conditional fail: the result is outside the tolerance {limits}, by at most the guard band.",
        "Fail: the result is outside the tolerance {limits} by more than the guard band.",
    ],
    limits: ["from {low} to {high}{unit}", "from {low}{unit} on", "up to {high}{unit}"],
    conforming: "The value conforms with a probability of {p}.",
    all_the_same: "Specific risk that the rejected value conforms: {p}.",
    unrounded: "The decision was made with the value before rounding, {value}.",
    with_prior: "This probability includes prior knowledge of such items (JCGM 106:2012, 6.3 and 7.1): \
        {prior}. From the measured value and its uncertainty alone it is {p}.",
    prior: "distribution `{shape}` with mean {mean} and standard deviation {std}",
    global_risks: "Global risks with this prior knowledge and these acceptance limits: false \
        acceptance {a} %, false rejection {b} %.",
    percent: ["{p} %", "more than {p} %", "less than {p} %"],
    simple: "Decision rule: simple acceptance (JCGM 106:2012, 8.2).",
    multiple: "Decision rule: guarded acceptance with a guard band of {band} \
        ({clause}), with U before rounding; guard band {guard}, accepted {limits}.",
    too_wide: "Decision rule: guarded acceptance with a guard band of {band} \
        ({clause}), with U before rounding; guard band {guard}, more than half of the tolerance: no value is accepted.",
    no_band: "Decision rule: guarded acceptance with a guard band of {band} ({clause}), with U before \
        rounding; U is more than half of the tolerance: no value is accepted.",
    of_rule: [
        "{rule}; T: half of the tolerance",
        "{rule}; T: half of the tolerance; U with k = {k}, the rule is for U of approximately 95 %",
    ],
    of_ilac_g8: [
        "ILAC-G8:09/2019, 4.2.2",
        "U with k = {k}; ILAC-G8:09/2019, 4.2.2, defines the guard band for U of approximately 95 %",
    ],
    rule_agreed: "The decision rule was agreed with the customer.",
    specification: "Specification: {name}.",
    guarded: "Decision rule: guarded acceptance (JCGM 106:2012, 8.3) for {kind} of at most {risk} %; \
        guard band {guard}, accepted {limits}.",
    never: "Decision rule: guarded acceptance (JCGM 106:2012, 8.3) for {kind} of at most {risk} %; no \
        value has a risk this small.",
    kinds: ["a specific risk of false acceptance", "a global risk of false acceptance"],

    page: "Page {page} of {pages}",
    end: "End of the calibration certificate",
    signed: ["Place, date", "Signature"],
    relates: "The results relate only to the item that was calibrated.",
    copies: "This certificate shall not be reproduced except in full without approval of the laboratory.",
    provenance: "Provenance",
    program: "program",
    certificate_file: "certificate file, SHA-256",
    certificate_name: "certificate file",
    model_file: "model file",
    table: "table",
    seed: "seed",
    trials: "Monte Carlo trials",
    adaptive: "adaptive",

    nominal_value: "Nominal value",
    measured_value: "Measured value",
    coverage_interval: "Coverage interval",
    files: "Files of the evaluation",
    answer: "Result",
};
