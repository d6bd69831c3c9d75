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
        factor k = {k}. No distribution is supposed, so that no coverage probability is stated.",
    agreed: "The expanded uncertainty U is the standard uncertainty multiplied by the agreed \
        coverage factor k = {k}. The coverage probability that is stated with it follows from \
        the t distribution with the effective degrees of freedom ν_eff.",
    shortest: "The stated coverage interval is the shortest one \
        with a coverage probability of {p}, found by the Monte Carlo method (JCGM 101:2008). U is the \
        distance of the value from its farther endpoint. k is U divided by the standard uncertainty, to the \
        digits that the trials justify.",
    without_trials: "The stated coverage interval has a \
        coverage probability of {p}; it was found by the propagation of distributions (JCGM 101:2008, \
        clause 5) without random trials, and is the shortest one, or the symmetric one where that is \
        longer by less than 1 %. U is the distance of the value from its farther end, and k is U over \
        the standard uncertainty.",
    propagation: "The standard uncertainty was evaluated by the law of propagation of uncertainty \
        (JCGM 100:2008), as EA-4/02 M:2022 asks.",
    time: "The uncertainties do not include how the device will behave over time.",
    confirmed: "The Monte Carlo method (JCGM 101:2008, clause 8) confirms these intervals.",
    rounding: "U has {digits} ({rule}); the value is rounded to the same place.",
    rules: [
        "rounded to the nearest",
        "rounded to the nearest, but up where that would take away more than 5 %, EA-4/02 M:2022",
        "rounded up",
    ],
    kept: "U is rounded up, as it would be below the laboratory's calibration and measurement \
        capability (CMC) otherwise.",
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
        "brought from the coverage factor 2 of the capability to k = {k}",
    ],
    dof_list: "Effective degrees of freedom ν_eff: {list}.",
    approximately: "approximately {p}",

    function: "Calibration function {name}",
    in_range: "{equation} for {low} ≤ x ≤ {high}, x and {name} being numbers in the stated units.",
    band: "U is the expanded uncertainty of the function at x, with the coverage factor k = {k}; it does \
        not contain that of a further reading. Between the stated values of x it follows from \
        u(x)² = g(x)' V g(x) with the derivatives g by the parameters and their covariance matrix V, \
        which the standard uncertainties and correlation coefficients r of the parameters make up.",
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
    correlated: "Rows that share inputs are correlated. The standard uncertainty of the \
        difference of rows i and j follows from u² = u_i² + u_j² - 2 r u_i u_j, with the \
        standard uncertainties u_i and u_j and the coefficient r stated here. They are those of \
        the law of propagation, from which U_i / k_i may differ.",
    correlated_raised: "Where U is the laboratory's capability, u_i contains it, and what it \
        adds to the evaluated uncertainty is taken to be uncorrelated with the other rows.",
    shared: "The rows share: {inputs}.",
    many: "Some of the {rows} rows share inputs; correlation coefficients, and the standard \
        uncertainties that they go with, are in the JSON answer and in the workbook.",
    conformity: "Conformity",
    decided: ["conforms", "does not conform", "not shown"],
    decisions: [
        "The result conforms to the tolerance {limits}.",
        "The result does not conform to the tolerance {limits}.",
    ],
    not_shown: [
        "It is not shown that the result conforms to the tolerance {limits}: it lies within the \
            tolerance, but outside the acceptance limits, and is rejected by the decision rule.",
        "It is not shown that the result conforms to the tolerance {limits}: it lies within the \
            tolerance, but the decision rule accepts no value, and it is rejected.",
    ],
    limits: ["from {low} to {high}{unit}", "from {low}{unit} on", "up to {high}{unit}"],
    conforming: "The value conforms with a probability of {p}.",
    all_the_same: "Specific risk that the value conforms all the same: {p}.",
    unrounded: "It was decided with the value before rounding, {value}.",
    with_prior: "This probability takes into account what was known of such items before the \
        measurement (JCGM 106:2012, 6.3 and 7.1): {prior}. From the measured value and its \
        uncertainty alone it is {p}.",
    prior: "distribution `{shape}` with mean {mean} and standard deviation {std}",
    global_risks: "Global risks with this prior knowledge and these acceptance limits: false \
        acceptance {a} %, false rejection {b} %.",
    percent: ["{p} %", "more than {p} %", "less than {p} %"],
    simple: "Decision rule: simple acceptance (JCGM 106:2012, 8.2).",
    multiple: "Decision rule: guarded acceptance with a guard band of {factor} U \
        ({clause}), with U before rounding; guard band {guard}, accepted {limits}.",
    too_wide: "Decision rule: guarded acceptance with a guard band of {factor} U \
        ({clause}), with U before rounding; guard band {guard}, more than half of the tolerance: no value is accepted.",
    of_ilac_g8: [
        "ILAC-G8:09/2019, 4.2.2",
        "U having k = {k}; ILAC-G8:09/2019, 4.2.2, has it for U of approximately 95 %",
    ],
    rule_agreed: "The decision rule was agreed with the customer.",
    specification: "Specification: {name}.",
    guarded: "Decision rule: guarded acceptance (JCGM 106:2012, 8.3) for {kind} of at most {risk} %; \
        guard band {guard}, accepted {limits}.",
    never: "Decision rule: guarded acceptance (JCGM 106:2012, 8.3) for {kind} of at most {risk} %, \
        which no value has.",
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
