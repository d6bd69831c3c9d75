//! English.

use super::Words;

pub(super) const WORDS: Words = Words {
    title: "Calibration certificate",
    number: "Certificate number",
    device: "Device",
    manufacturer: "Manufacturer",
    model: "Type",
    serial_number: "Serial number",
    customer_number: "Customer's number",
    customer: "Customer",
    laboratory: "Laboratory",
    code: "Laboratory code",
    responsible: "Responsible",
    calibrated: "Date of calibration",
    period: "{first} to {last}",
    issued: "Date of issue",
    place: "PerformanceLocation of calibration",
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
    probability: "p in %",
    low: "from",
    high: "to",

    uncertainty: "Uncertainty of measurement",
    rows: ["Row {rows}: ", "Rows {rows}: "],
    and: " and ",
    normal: "The expanded uncertainty U is the standard uncertainty multiplied by the coverage factor \
        k = {k}; the result is normally distributed, so that the interval from value - U to value + U \
        has a coverage probability of {p}.",
    student: "The expanded uncertainty U is the standard uncertainty multiplied by the coverage \
        factor k in the table. The result follows a t distribution with the effective degrees of \
        freedom ν_eff in the table, and k is chosen so that the coverage probability is {p}.",
    fixed: "The expanded uncertainty U is the standard uncertainty multiplied by the agreed coverage \
        factor k = {k}. No distribution is supposed, so that no coverage probability is stated.",
    shortest: "The result is not normally distributed. The interval from - to in the table is the shortest one \
        with a coverage probability of {p}, found by propagation of distributions (JCGM 101:2008). U is \
        the distance of the value from its farther end, and k is U over the standard uncertainty.",
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
    digits: ["one significant digit", "{digits} significant digits"],
    raised: "The evaluated uncertainty is smaller than the laboratory's calibration and measurement \
        capability (CMC), which is stated instead (ILAC-P14:09/2020).",
    approximately: "approximately {p}",

    correlation: "Correlation of the rows",
    correlated: "Rows that share inputs are correlated. The standard uncertainty of the difference \
        of rows i and j follows from u² = u_i² + u_j² - 2 r u_i u_j, with u_i = U_i / k_i and the \
        coefficient r from the table (from the law of propagation).",
    many: "The {rows} rows share inputs; their correlation coefficients are in the JSON answer and in \
        the workbook.",
    conformity: "Conformity",
    provenance: "Provenance",
    program: "program",
    certificate_file: "certificate file, SHA-256",
    seed: "seed",
    trials: "Monte Carlo trials",
    adaptive: "adaptive",
};
