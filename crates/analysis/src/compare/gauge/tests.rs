use super::*;

/// The example of AIAG, Measurement Systems Analysis, 4th ed., chapter III (table III-B 1): parts 1 to 10
/// of the appraisers A, B and C, three trials each.
const AIAG: [[f64; 10]; 9] = [
    [0.29, -0.56, 1.34, 0.47, -0.80, 0.02, 0.59, -0.31, 2.26, -1.36],
    [0.41, -0.68, 1.17, 0.50, -0.92, -0.11, 0.75, -0.20, 1.99, -1.25],
    [0.64, -0.58, 1.27, 0.64, -0.84, -0.21, 0.66, -0.17, 2.01, -1.31],
    [0.08, -0.47, 1.19, 0.01, -0.56, -0.20, 0.47, -0.63, 1.80, -1.68],
    [0.25, -1.22, 0.94, 1.03, -1.20, 0.22, 0.55, 0.08, 2.12, -1.62],
    [0.07, -0.68, 1.34, 0.20, -1.28, 0.06, 0.83, -0.34, 2.19, -1.50],
    [0.04, -1.38, 0.88, 0.14, -1.46, -0.29, 0.02, -0.46, 1.77, -1.49],
    [-0.11, -1.13, 1.09, 0.20, -1.07, -0.67, 0.01, -0.56, 1.45, -1.77],
    [-0.15, -0.96, 0.67, 0.11, -1.45, -0.49, 0.21, -0.49, 1.87, -2.16],
];

fn reading(part: usize, operator: usize, value: f64) -> StudyReading {
    StudyReading { part: part.to_string(), operator: format!("O{operator}"), value }
}

fn aiag() -> Vec<StudyReading> {
    let rows = AIAG.iter().enumerate();
    rows.flat_map(|(row, values)| {
        values.iter().enumerate().map(move |(part, value)| reading(part, row / 3, *value))
    })
    .collect()
}

fn near(found: f64, expected: f64, half: f64) {
    assert!((found - expected).abs() <= half, "{found} instead of {expected}");
}

/// The published table and components (AIAG, 4th ed., table III-B 8 and 9, with the interaction pooled),
/// to half a unit of their last digit; the sums of squares to four digits as Minitab prints them.
#[test]
fn the_example_of_aiag() {
    let found = study(&aiag(), Interaction::Tested, [Some(-4.0), Some(4.0)]).unwrap();
    assert_eq!((found.counts, found.has_interaction), ([10, 3, 3], false));
    let lines = [(88.3619, 9.0), (3.1673, 2.0), (0.3590, 18.0), (2.7589, 60.0)];
    for (line, (sum, dof)) in found.table.iter().zip(lines) {
        near(line.sum, sum, 5.1e-5);
        assert_eq!(line.dof, dof);
    }
    near(found.table[2].f.unwrap(), 0.434, 5e-4);
    near(found.table[2].p.unwrap(), 0.974, 5e-4);
    let of = |name| found.component(name).unwrap();
    let components = [
        ("repeatability", 0.199_933, 18.4),
        ("operators", 0.226_838, 20.9),
        ("gauge", 0.302_373, 27.9),
        ("parts", 1.042_327, 96.0),
        ("total", 1.085_3, 100.0),
    ];
    for (name, deviation, percent) in components {
        // GRR is printed from rounded EV and AV
        near(of(name).deviation(), deviation, 2e-6 + 5e-5 * f64::from(u8::from(name == "total")));
        near(100.0 * found.shares(of(name)).0, percent, 0.051);
    }
    assert_eq!(found.categories(), Some(4.0));
    assert_eq!(of("repeatability").dof, 78.0);
    // six standard deviations of the tolerance, and of VDA 5 four
    near(found.deciding_share(), 6.0 * 0.302_372 / 8.0, 1e-6);
    near(found.capability_ratio().unwrap(), 4.0 * 0.302_372 / 8.0, 1e-6);
    let (of_parts, of_total) = (found.of_parts().unwrap(), found.of_total().unwrap());
    near(of_parts.potential.unwrap(), 8.0 / (6.0 * 1.042_327), 1e-5);
    near(of_total.potential.unwrap(), 8.0 / (6.0 * 1.085_300), 1e-5);
    // the mean of all readings is 0.0014
    near(of_parts.centred, (4.0 - 0.001_444) / (3.0 * 1.042_327), 1e-5);
    near(of_total.centred, (4.0 - 0.001_444) / (3.0 * 1.085_300), 1e-5);
}

/// A small study with a significant interaction. Sums of squares by regression on indicators
/// (NumPy's least squares, sequential residuals), components and degrees of freedom from them by hand.
/// The operators' estimate is negative, and so 0.
#[test]
fn a_significant_interaction_is_kept() {
    let cells = [[[1.0, 1.2], [2.0, 2.1]], [[3.0, 3.1], [2.5, 2.4]], [[5.0, 5.2], [6.1, 6.0]]];
    let readings: Vec<StudyReading> =
        (0..12).map(|i| reading(i / 4, i / 2 % 2, cells[i / 4][i / 2 % 2][i % 2])).collect();
    let found = study(&readings, Interaction::Tested, [None, Some(7.0)]).unwrap();
    assert!(found.has_interaction);
    for (line, sum) in found.table.iter().zip([33.815, 0.563_333, 1.601_667, 0.06]) {
        near(line.sum, sum, 1e-6);
    }
    near(found.table[2].p.unwrap(), 4.707_844e-5, 1e-10);
    let of = |name| found.component(name).unwrap();
    near(of("repeatability").variance, 0.01, 1e-12);
    near(of("interaction").variance, 0.395_416_7, 1e-7);
    near(of("interaction").dof, 1.950_262_5, 1e-6);
    assert_eq!((of("operators").variance, of("operators").dof), (0.0, 0.0));
    near(of("reproducibility").variance, 0.395_416_7, 1e-7);
    near(of("parts").variance, 4.026_666_7, 1e-7);
    near(of("parts").dof, 1.810_961_8, 1e-6);
    near(of("gauge").variance, 0.405_416_7, 1e-7);
    near(of("total").variance, 4.432_083_3, 1e-7);
    // one limit: no tolerance, but a Cpk
    assert_eq!((found.tolerance(), found.capability_ratio()), (None, None));
    let parts = found.of_parts().unwrap();
    assert_eq!(parts.potential, None);
    near(parts.centred, (7.0 - found.mean) / (3.0 * 4.026_666_7_f64.sqrt()), 1e-7);
    let pooled = study(&readings, Interaction::Pooled, [None; 2]).unwrap();
    near(pooled.component("repeatability").unwrap().variance, 1.661_667 / 8.0, 1e-6);
    assert_eq!(pooled.of_parts(), None);
}

#[test]
fn tables_that_are_no_study() {
    let kept = Interaction::Kept;
    let mut readings = aiag();
    readings.pop();
    let error = study(&readings, kept, [None; 2]).unwrap_err();
    assert!(error.to_string().contains("the part `9` has 2 readings of `O2`"), "{error}");
    let one: Vec<StudyReading> = aiag().into_iter().filter(|r| r.operator == "O1").collect();
    assert_eq!(study(&one, kept, [None; 2]), Err(NoStudy::Few("operators", 1)));
    let mut equal = aiag();
    equal.iter_mut().for_each(|reading| reading.value = 1.0);
    assert_eq!(study(&equal, kept, [None; 2]), Err(NoStudy::NoVariation));
}
