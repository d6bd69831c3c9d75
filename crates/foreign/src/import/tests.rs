//! Budgets as laboratories keep them.

use super::*;

mod numbers;
mod relative;
mod words;

fn import(name: &str, content: &[u8]) -> Result<ImportedBudget, Diagnostics> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    import_budget(&path)
}

fn task(budget: &ImportedBudget) -> gumption_engine::task::Task {
    read_text("m", &budget.text, Path::new(""), &[])
        .unwrap_or_else(|faults| panic!("{}\n{faults}", budget.text))
        .task
}

/// EA-4/02, S2: calibration of a weight of 10 kg. Published: 10 000.025 g, u = 29.3 mg, of parts
/// that are rounded to a tenth of a milligram.
#[test]
fn a_budget_with_sensitivities() {
    let text = "Calibration of a weight\n\nQuantity,Estimate,Unit,Standard uncertainty,\
        Distribution,Sensitivity coefficient c_i\n\
        m_S,10000.005,g,0.0225,normal,1\n\
        Delta m_D,0,g,0.00866,rectangular,1\n\
        dm,0.020,g,0.0144,normal,1\n\
        dm_C,0,g,0.00577,rectangular,1\n\
        dB,0,g,0.00577,rectangular,1\n\n\
        m_X,10000.025,g,,,\n";
    let budget = import("S2.csv", text.as_bytes()).unwrap();
    let task = task(&budget);
    let of = &task.rows[0].distributions;
    let variance: f64 = of.iter().map(|d| d.standard_uncertainty().powi(2)).sum();
    assert!((variance.sqrt() - 0.0293).abs() < 1e-4);
    assert!(budget.guessed.iter().any(|said| said.contains("Delta_m_D")));
}

/// A German sheet with semicolons, decimal commas, a formula and divisors as roots.
#[test]
fn a_german_budget_with_an_equation() {
    let text = "R = U/I;;;;;;\n\nGröße;Schätzwert;Einheit;Halbbreite;Verteilung;Teiler;\
        Freiheitsgrade\nU;5,0112;V;0,0046;Normal;2;50\nI;0,01;A;0,00001;Rechteck;√3;∞\n";
    let budget = import("r.csv", text.as_bytes()).unwrap();
    let task = task(&budget);
    assert_eq!(task.model.outputs[0].quantity.name, "R");
    let of = &task.rows[0].distributions;
    assert_eq!([of[0].mean(), of[0].standard_uncertainty(), of[0].dof()], [5.0112, 0.0023, 50.0]);
    assert_eq!(of[1].name(), "rectangular");
    assert!(budget.text.contains(r#""R":"U/I""#), "{}", budget.text);
}

/// The standard uncertainties of a budget's inputs, in units of their own.
fn uncertainties(text: &str) -> (Vec<f64>, ImportedBudget) {
    let budget = import("b.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    let found = task(&budget);
    (found.rows[0].distributions.iter().map(|d| d.standard_uncertainty()).collect(), budget)
}

fn guesses(budget: &ImportedBudget, part: &str) -> bool {
    budget.guessed.iter().any(|said| said.contains(part))
}

/// Units of headings wherever they stand in them, and shares of the estimate in words.
#[test]
fn headings_say_their_units_in_many_ways() {
    // (heading, uncertainty, wanted standard uncertainty in V): of 10 V
    for (heading, cell, u) in [
        ("Uncertainty (mV) k=2", "5", 2.5e-3),
        ("Uncertainty in mV (k=2)", "5", 2.5e-3),
        ("Uncertainty (± mV)", "5", 5e-3 / 3f64.sqrt()),
        ("Uncertainty (95 %), k=2", "0.005", 2.5e-3),
        ("Uncertainty in mV", "5", 5e-3 / 3f64.sqrt()),
        ("Standard uncertainty, mV", "5", 5e-3),
        ("Standard uncertainty [mV]", "5", 5e-3),
        ("Uncertainty (% of reading)", "0.02", 2e-3 / 3f64.sqrt()),
        ("Uncertainty [% of value]", "0.02", 2e-3 / 3f64.sqrt()),
        ("Uncertainty (ppm of reading)", "20", 2e-4 / 3f64.sqrt()),
        ("Unsicherheit (% v.M.)", "0.02", 2e-3 / 3f64.sqrt()),
        ("Incertitude (% de la lecture)", "0.02", 2e-3 / 3f64.sqrt()),
    ] {
        let shape = if heading.contains("k=2") { "normal" } else { "rectangular" };
        let text =
            format!("Quantity;Estimate;Unit;{heading};Distribution\nA;10;V;{cell};{shape}\n");
        let (found, _) = uncertainties(&text);
        // a few roundings of conversions and divisors
        assert!((found[0] / u - 1.0).abs() < 1e-12, "{heading}: {found:?}, not {u}");
    }
    for (heading, said) in [
        ("Uncertainty (% FS)", "`% FS` in the heading"),
        ("Uncertainty (x10^-6)", "`x10^-6` in the heading"),
        ("Standard deviation (n = 10)", "standard deviation of single readings"),
    ] {
        let text = format!("Quantity;Estimate;Unit;{heading};Distribution\nA;10;V;5;normal\n");
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(said), "{heading}: {error}");
    }
    let text = "Quantity,Estimate,Unit,Uncertainty,Unit,Distribution\nL,50,mm,30,nm,rectangular\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("a second column `Unit` stands behind `Uncertainty`"), "{error}");
}

/// An estimate and its uncertainty in one cell, below a heading of either, with factors and units; and
/// beside a column of uncertainties that is empty there.
#[test]
fn cells_hold_an_estimate_and_its_uncertainty() {
    let root = 3f64.sqrt();
    for text in [
        "Quantity;Estimate;Distribution\nA;10.000 V ± 0.002 V (k=2);normal\nB;0 V ± 0.5 mV;rectangular\n",
        "Quantity;Value ± U;Distribution\nA;10.000 V +/- 2 mV (k=2);normal\nB;0 ± 0.0005 V;rectangular\n",
        "Quantity;Value;Uncertainty;Distribution\nA;10.000 ± 0.002 V (k=2);;normal\nB;0 V;± 0.5 mV;rectangular\n",
        "Quantity;Value;Unit;Distribution;Divisor\nA;10.000 ± 0.002;V;normal;2\nB;0 ± 0.0005;V;rectangular;√3\n",
        "Quantity;Estimate;Distribution\nA;10.000 V ± 0.02 % (k=2);normal\nB;0 V ± 0.5 mV;rectangular\n",
    ] {
        let (found, budget) = uncertainties(text);
        let of = &task(&budget).rows[0].distributions;
        assert_eq!([of[0].mean(), of[1].mean()], [10.0, 0.0], "{text}");
        // roundings of a conversion and a divisor
        assert!((found[0] / 1e-3 - 1.0).abs() < 1e-12, "{text}: {found:?}");
        assert!((found[1] / (5e-4 / root) - 1.0).abs() < 1e-12, "{text}: {found:?}");
    }
    // two uncertainties of one estimate
    let text = "Quantity;Value;Uncertainty;Distribution\nA;10 ± 0.002 V;0.001 V;rectangular\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("`10 ± 0.002 V` in the column of the estimate is no number"), "{error}");
}

/// `u` that is the quotient already is not divided again, and a standard uncertainty beside a standard
/// deviation is the one that counts.
#[test]
fn quotients_are_not_divided_again() {
    let text = "Source,Value,Unit,Distribution,Divisor,Sensitivity,u\nStandard,2.0,V,normal,2,1,1.0\n\
        Ratio,0.5,V,rectangular,1.732,1,0.29\n";
    let (found, _) = uncertainties(text);
    assert_eq!(found[0], 1.0);
    assert!((found[1] - 0.5 / 3f64.sqrt()).abs() < 1e-4, "{found:?}");
    let text =
        "Quantity,Estimate,Unit,Standard deviation,n,Standard uncertainty\nA,1,V,0.3,9,0.1\n";
    assert_eq!(uncertainties(text).0, [0.1]);
    let lost = text.replace("0.3,9,0.1", "0.3,9,");
    let error = import("b.csv", lost.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("line 2 has a number below `Standard deviation`"), "{error}");
}

/// The row of an equation without numbers says the unit of its result.
#[test]
fn an_equation_in_a_row_has_the_unit_of_its_result() {
    let text = "Quantity;Estimate;Unit;Standard uncertainty\nP1;-20;dBm;0.1\nA;30;dB;0.05\n\
        P = P1 + A;;dBm;\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "dBm");
}

/// A plain coefficient beside one with a unit: its contribution says what it is in.
#[test]
fn a_contribution_tells_the_unit_of_a_plain_coefficient() {
    let head = "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity,Unit of c_i,Contribution\n";
    let rows = "l,10,mm,0.01,1,mm/mm,0.01\nangle,0,,0.002,20,,0.04\nresult,10,mm,,,,\n";
    let budget = import("b.csv", format!("{head}{rows}").as_bytes()).unwrap();
    assert!(budget.text.contains("l + (20.0)*angle") || budget.text.contains("l + (20)*angle"));
    assert!(guesses(&budget, "the coefficient 20 of `angle` is taken in `mm` per unit one"));
    let error = import("b.csv", format!("{head}{rows}").replace("0.04", "0.4").as_bytes());
    let error = error.unwrap_err().to_string();
    assert!(error.contains("a coefficient without a unit times a quantity without one"), "{error}");
}

/// Contributions in another unit than the result say what the coefficients are in.
#[test]
fn coefficients_in_the_unit_of_the_contributions() {
    let text = "Quantity;Estimate;Unit;Standard uncertainty;Sensitivity;Contribution (µm)\n\
        block;50;mm;0,000015;1;0,015\ntemperature;0;°C;0,289;-0,575;0,166\nresult;50;mm;;;\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert!(guesses(&budget, "the coefficient -0.575 of `temperature` is taken in `µm` per °C"));
    assert!(budget.text.contains("(-0.000575"), "{}", budget.text);
}

/// A heading's factor that no divisor has is asked; where one has it, others may differ.
#[test]
fn a_heading_s_factor_and_the_divisors() {
    let head = "Quantity,Value,Unit,U (k=2),Distribution,Divisor\n";
    let rest = "Resolution,0,V,0.05,rectangular,1.732\nScatter,0,V,0.01,normal,1\n";
    let text = format!("{head}Certificate,50,V,0.04,normal,1\n{rest}");
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("the heading says 2, the divisor 1: which factor"), "{error}");
    let text = format!("{head}Certificate,50,V,0.04,normal,2\n{rest}");
    let (found, _) = uncertainties(&text);
    assert_eq!([found[0], found[2]], [0.02, 0.01]);
}

/// `Value` over the divisor is the standard uncertainty in every row: it is no estimate.
#[test]
fn values_that_are_divided_are_widths() {
    let head = "Source,Value (mg),Distribution,Divisor,ui (mg),Sensitivity\n";
    let rows = "standard,0.30,normal,2,0.15,1\nbuoyancy,0.10,rectangular,√3,0.058,1\n";
    let (found, budget) = uncertainties(&format!("{head}{rows}"));
    assert_eq!(found[0], 0.15);
    assert!((found[1] - 0.1 / 3f64.sqrt()).abs() < 1e-15, "{found:?}");
    assert_eq!(task(&budget).rows[0].distributions[0].mean(), 0.0);
    assert!(guesses(&budget, "`Value (mg)` is taken for half-widths"), "{:?}", budget.guessed);
    // 0.0289 of a resolution of 0.1
    for divisor in ["2√3", "2·√3", "2*sqrt(3)", "√12"] {
        let rows =
            format!("display,0.1,rectangular,{divisor},0.0289,1\nstandard,0.3,normal,2,0.15,1\n");
        let (found, budget) = uncertainties(&format!("{head}{rows}"));
        assert!((found[0] - 0.1 / 12f64.sqrt()).abs() < 1e-15, "{divisor}: {found:?}");
        assert_eq!(task(&budget).rows[0].distributions[0].mean(), 0.0);
    }
    // an estimate in one of the rows is one in all of them
    let rows = "standard,10.30,normal,2,0.15,1\nbuoyancy,0.10,rectangular,√3,0.058,1\n";
    let (found, budget) = uncertainties(&format!("{head}{rows}"));
    // the half-width is the root of three times the standard uncertainty: two roundings
    assert!(found[0] == 0.15 && (found[1] - 0.058).abs() < 1e-15, "{found:?}");
    assert_eq!(task(&budget).rows[0].distributions[0].mean(), 10.3);
}

/// A header that names the factor of its uncertainties; before, they were taken for standard ones.
#[test]
fn expanded_uncertainties_have_the_factor_of_their_header() {
    // u = U/k; the quantile of 0.975 is 1.959964
    for (header, u) in [
        ("Expanded uncertainty (k=2)", 2e-4),
        ("U (k = 2.5)", 1.6e-4),
        ("U (p=95 %)", 4e-4 / 1.959_963_984_540_054),
        ("Erweiterte Messunsicherheit (k=2)", 2e-4),
        ("Erw. Unsicherheit (k=2)", 2e-4),
    ] {
        let text = format!("Quantity,Estimate,Unit,{header},Distribution\nm,1,kg,0.0004,normal\n");
        let (found, budget) = uncertainties(&text);
        assert!((found[0] / u - 1.0).abs() < 1e-12, "{header}: {found:?}");
        assert!(!guesses(&budget, "expanded"), "{:?}", budget.guessed);
    }
    for header in ["U", "Expanded uncertainty", "Erweiterte Unsicherheit"] {
        let text = format!("Quantity,Estimate,Unit,{header}\nm,1,kg,0.0004\n");
        let (found, budget) = uncertainties(&text);
        assert_eq!(found, [2e-4], "{header}");
        assert!(guesses(&budget, "k = 2 is taken"), "{:?}", budget.guessed);
    }
}

/// Per cent of the estimate, but of a quantity in per cent per cent.
#[test]
fn per_cent_are_of_the_estimate() {
    let text = "Quantity,Estimate,Unit,+-,Divisor,Distribution,c_i\n\
                x,5,V,0.4 %,2,normal,1\nh,50,%,2 %,2,normal,0.02\n";
    let (found, budget) = uncertainties(text);
    assert!((found[0] - 0.01).abs() < 1e-15 && (found[1] - 1.0).abs() < 1e-15, "{found:?}");
    assert!(guesses(&budget, "of the estimate 5"), "{:?}", budget.guessed);
    let error = import("x.csv", b"quantity,estimate,unit,+-\nx,5,V,-0.1\n").unwrap_err();
    assert!(error.to_string().contains("below zero"), "{error}");
}

/// The factor of a summary is no input, and what is printed beside it not the result's estimate.
#[test]
fn summaries_are_no_inputs() {
    let text = "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity coefficient\n\
                U,5.01,V,0.01,1\nI,2,A,0.02,3\nCombined standard uncertainty,0.061,,,\n\
                k,2,,,\nExpanded uncertainty,0.12,,,\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    let found = task(&budget);
    assert_eq!(found.variables.len(), 2);
    assert!(budget.text.contains(r#""y":"U + (3)*I""#), "{}", budget.text);
}

/// A row that is named as the equation's left side is the result, with its unit.
#[test]
fn the_row_of_the_measurand_is_the_result() {
    let text = "R = U/I,,,\n\nQuantity,Estimate,Unit,Standard uncertainty\n\
                U,5.01,V,0.01\nI,1.25,mA,0.001\nR,4.01,kohm,\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    let found = task(&budget);
    let output = &found.model.outputs[0].quantity;
    assert_eq!((output.name.as_str(), output.unit.text()), ("R", "kohm"));
    assert_eq!(found.variables.len(), 2);
    assert!(!guesses(&budget, "not checked"), "{:?}", budget.guessed);
}

/// What a shape does not say of its uncertainty is told.
#[test]
fn other_divisors_and_missing_uncertainties_are_told() {
    let text = "Quantity,Estimate,Unit,+-,Divisor,Distribution\nb,1,V,,,normal\n\
                a,1,V,0.1,2,rectangular\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found, [0.0, 0.05]);
    assert!(guesses(&budget, "`a` is rectangular, but"), "{:?}", budget.guessed);
    assert!(guesses(&budget, "`b` is normal without"), "{:?}", budget.guessed);
}

/// Quantities in units of one dimension are added in one of them; before, as bare numbers.
#[test]
fn sums_are_in_one_unit() {
    let text = "Quantity,Estimate,Unit,Standard uncertainty\n\
                a,5,V,0.002\nb,2,mV,1\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found, [0.002, 1.0]);
    assert!(budget.text.contains(r#""y":"a + (0.001)*b""#), "{}", budget.text);
    assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "V");
    assert!(guesses(&budget, "`b` in mV is converted to V"), "{:?}", budget.guessed);
    for (row, part) in [
        ("b,2,A,1", "`b` is in `A`, the result in `V`"),
        ("b,2,,1", "`b` is without a unit, the result in `V`"),
    ] {
        let text = format!("Quantity,Estimate,Unit,Standard uncertainty\na,5,V,0.002\n{row}\n");
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

/// A coefficient of a quantity in mV, of a result in V: with its unit, without it, and the same
/// number in both readings.
#[test]
fn coefficients_have_units() {
    let table = |rows: &str| {
        let head = "Quantity,Estimate,Unit,Standard uncertainty,c_i,Unit of c_i";
        format!("{head}\n{rows}\nResult,5.002,V,,,\n")
    };
    for rows in [
        "a,5,V,0.002,1,V/V\nb,2,mV,1,1,V/V",
        "a,5,V,0.002,1,1\nb,2,mV,1,0.001,V/mV",
        "a,5,V,0.002,1,1\nb,2,mK,1,1,V/K",
        "a,5,V,0.002,1,\nb,2,mV,1,0.001,",
    ] {
        let budget = import("b.csv", table(rows).as_bytes()).unwrap();
        assert!(budget.text.contains(r#""y":"a + (0.001)*b""#), "{}", budget.text);
    }
    // the contribution tells which
    let text = "Quantity,Estimate,Unit,Standard uncertainty,c_i,Contribution\n\
                a,5,V,0.002,1,2 mV\nb,2,mV,1,1,1 mV\nResult,5.002,V,,,\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert!(budget.text.contains(r#""y":"a + (0.001)*b""#), "{}", budget.text);
    assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
    for (rows, part) in [
        ("a,5,V,0.002,1,\nb,2,mV,1,1,", "can be 1 V/mV or 1 V/V"),
        ("a,5,V,0.002,1,1\nb,2,mV,1,1,V/A", "a coefficient in `V/A` times `mV`"),
        ("a,5,V,0.002,1,1\nb,2,mV,1,1,V/foo", "`V/foo` of the coefficient is not known"),
    ] {
        let error = import("b.csv", table(rows).as_bytes()).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

/// The zeros of two scales do not matter to a coefficient, and the sizes of their degrees do.
#[test]
fn coefficients_between_scales_of_temperatures() {
    let of = |unit: &str| {
        let text = format!(
            "Quantity,Estimate,Unit,Standard uncertainty,c_i\na,293,K,0.9,1\nd,0,{unit},0.9,1\n"
        );
        import("b.csv", text.as_bytes()).map(|budget| budget.text)
    };
    let error = of("degF").unwrap_err().to_string();
    assert!(error.contains("can be 1 K/degF or 1 K/K"), "{error}");
    assert!(of("degC").unwrap().contains(r#""y":"a + d""#));
}

/// EA-4/02, S2 as it is printed: units behind the numbers, in g and mg, and digits in groups.
/// Published: 10 000,025 g with u = 29,3 mg.
#[test]
fn numbers_with_units_in_their_cells() {
    let text = "Größe;Schätzwert;Standardunsicherheit;Verteilung;Sensitivitätskoeffizient;Beitrag\n\
        m_S;10 000,005 g;22,5 mg;Normal;1,0;22,5 mg\n\
        dm_D;0,000 g;8,66 mg;Rechteck;1,0;8,66 mg\n\
        dm;0,020 g;14,4 mg;Normal;1,0;14,4 mg\n\
        dm_C;0,000 g;5,77 mg;Rechteck;1,0;5,77 mg\n\
        dB;0,000 g;5,77 mg;Rechteck;1,0;5,77 mg\n\
        m_X;10 000,025 g;;;;29,3 mg\n";
    let (found, budget) = uncertainties(text);
    let combined = found.iter().map(|u| u * u).sum::<f64>().sqrt();
    // of published parts that are rounded to a tenth of a milligram
    assert!((combined - 0.0293).abs() < 1e-4, "{found:?}");
    assert!(budget.text.contains(r#""m_X":"m_S + dm_D + dm + dm_C + dB""#), "{}", budget.text);
    assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "g");
    assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
    let text = "Quantity,Estimate,Standard uncertainty,Sensitivity coefficient\n\
                l,50.0002 mm,100 nm,1\ndt,0.1 K,50 mK,575 nm/K\n";
    let (found, budget) = uncertainties(text);
    assert!((found[0] - 1e-4).abs() < 1e-18 && (found[1] - 0.05).abs() < 1e-15, "{found:?}");
    assert!(budget.text.contains(r#""y":"l + (0.000575)*dt""#), "{}", budget.text);
    for (row, part) in [
        ("l,50 mm,1 V,1", "the standard uncertainty is in `V`, but the row in `mm`"),
        ("l,50 12 mm,1 mm,1", "`50 12 mm` in the column of the estimate is no number"),
        ("t,20 degC,0.1 degF,1", ""),
    ] {
        let text =
            format!("Quantity,Estimate,Standard uncertainty,Sensitivity coefficient\n{row}\n");
        match import("b.csv", text.as_bytes()) {
            Ok(_) => assert_eq!(part, "", "{row}"),
            Err(error) => assert!(error.to_string().contains(part), "{error}"),
        }
    }
}

/// A budget of half widths in cells with units, with the factor of its expanded uncertainty.
#[test]
fn half_widths_with_units_and_a_summary() {
    let text = "Source of uncertainty,Value ±,Probability distribution,Divisor,ci,ui(y)\n\
        Calibration,0.5 um,normal,2,1,0.25 um\n\
        Resolution,0.5 um,rectangular,√3,1,0.29 um\n\
        Temperature,1 degC,rectangular,sqrt(3),0.2 um/degC,0.12 um\n\
        Combined standard uncertainty,,normal,,,0.40 um\n\
        Expanded uncertainty,,,k = 2,,0.8 um\n";
    let (found, budget) = uncertainties(text);
    let right = [0.25, 0.5 / 3f64.sqrt(), 1.0 / 3f64.sqrt()];
    assert!(found.iter().zip(right).all(|(u, right)| (u - right).abs() < 1e-15), "{found:?}");
    let formula = r#""y":"Calibration + Resolution + (0.2)*Temperature""#;
    assert!(budget.text.contains(formula), "{}", budget.text);
    assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "um");
    assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
    let text = "Quantity,Estimate,Unit,Standard uncertainty,c_i\nV,5,V,15 uV,1\n\
                T,23,degC,0.5,10 uV/K\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert!(budget.text.contains(r#""std":0.000015}"#), "{}", budget.text);
    assert!(budget.text.contains("(1e-5)*T"), "{}", budget.text);
}

/// A result below its quantities that has an uncertainty, but neither a coefficient nor a shape.
#[test]
fn the_last_row_may_be_the_result() {
    for text in [
        "Quantity,Estimate,Unit,Standard uncertainty,Distribution,c_i\n\
         a,5,V,0.003,normal,1\nb,2,V,0.004,normal,1\nU_x,7,V,0.005,,\n",
        "Quantity,Estimate,Unit,Standard uncertainty\na,5,V,0.003\nb,2,V,0.004\nU_x,7,V,0.005\n",
        "Quantity,Estimate,Unit,U (k=2)\na,5,V,0.006\nb,2,V,0.008\nU_x,7,V,0.01\n",
    ] {
        let (found, budget) = uncertainties(text);
        assert_eq!(found, [0.003, 0.004], "{}", budget.text);
        assert!(guesses(&budget, "taken for the result"), "{:?}", budget.guessed);
        assert_eq!(task(&budget).model.outputs[0].quantity.name, "U_x");
    }
}

/// The result is told from quantities by what it lacks, in whatever unit, and figures of it are none of
/// them: of EA-4/02, S9 and S10, and of sheets of GUM Workbench.
#[test]
fn results_among_constants_and_figures() {
    let coefficients = "Quantity,Value,Standard uncertainty,Sensitivity coefficient,Contribution\n";
    let shapes = "Quantity,Value,Unit,±,Distribution,Sensitivity coefficient,Contribution\n\
                  A,10,V,0.003,normal,1,0.003\nB,5,V,0.004,normal,1,0.004\nY,15,V,,,,0.005\n";
    for (text, name, estimate, u) in [
        (
            format!(
                "{coefficients}V_iX,100.1 V,,1,\nV_S,100.0 V,0.003 V,-1,0.003 V\n\
                 d,0 V,0.004 V,1,0.004 V\nE_X,0.1 V,,,0.005 V\n"
            ),
            "E_X",
            0.1,
            0.005,
        ),
        (
            format!(
                "{coefficients}V_iX,100.1 V,,,\nV_S,100.0 V,3 mV,-1,3 mV\n\
                 d,0 V,4 mV,1,4 mV\nE_X,100.0 mV,5.0 mV,,\n"
            ),
            "E_X",
            100.0,
            5.0,
        ),
        (
            "Quantity,Value,Standard uncertainty,Distribution,Sensitivity coefficient\n\
             A,10 V,0.003 V,normal,1\nC,2 V,0.004 V,normal,1\nB,5 V,,constant,1\n"
                .to_owned(),
            "y",
            17.0,
            0.005,
        ),
        (
            "Quantity,Value,Standard uncertainty\nA,10 V,3 mV\nB,5 V,4 mV\nY,15000 mV,5 mV\n"
                .to_owned(),
            "Y",
            15000.0,
            5.0,
        ),
        (
            "Quantity,Value,Standard uncertainty\nA,10 V,3 mV\nB,5 V,4 mV\nY,5000 mV,5 mV\n"
                .to_owned(),
            "Y",
            5000.0,
            5.0,
        ),
        (format!("{shapes}U,,V,0.010,k=2,,\n"), "Y", 15.0, 0.005),
        (format!("{shapes}RSS,,,,,,0.005\nU,,,,k=2,,0.010\n"), "Y", 15.0, 0.005),
        (format!("{shapes}U95,,V,,,,0.010\n"), "Y", 15.0, 0.005),
        (
            "Quantity,Value,±,Divisor,Sensitivity coefficient,Contribution\n\
             A,10 V,0.006 V,2,1,0.003 V\nB,5 V,0.004 V,1,1,0.004 V\nY,15 V,,,,0.005 V\n\
             U (k=2),,0.010 V,,,\n"
                .to_owned(),
            "Y",
            15.0,
            0.005,
        ),
    ] {
        let budget =
            import("b.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{text}{error}"));
        let task = task(&budget);
        let evaluated = gumption_engine::propagate::gum::evaluate(&task, &task.rows[0]);
        let gum = evaluated.outputs[0].as_ref().unwrap();
        assert_eq!(task.model.outputs[0].quantity.name, name, "{text}");
        assert!(
            (gum.estimate - estimate).abs() < 1e-9 * estimate.max(1.0),
            "{text}{}",
            gum.estimate
        );
        assert!((gum.standard_uncertainty - u).abs() < 1e-9 * u.max(1.0), "{text}");
    }
    for u in ["0.005 V", ""] {
        let twice = format!(
            "Quantity,Value,Standard uncertainty,Sensitivity coefficient\n\
             A,10 V,0.003 V,1\nB,5 V,0.004 V,1\nY,15 V,{u},1\n"
        );
        let said = import("b.csv", twice.as_bytes()).unwrap_err().to_string();
        assert!(said.contains("can be the result, or a further quantity"), "{said}");
    }
}

/// What the last row of a sheet is where its numbers alone could make it the result.
#[test]
fn last_rows_that_could_be_either() {
    let head = "Quantity,Estimate,Unit,u,Distribution\n";
    for (rows, name, u) in [
        // a shape is no combined result's, and a sum of zeros proves nothing
        ("r,0,mm,0.02,normal\nres,0,mm,0.3,rectangular\ndrift,0,mm,0.3,rectangular\n", "y", 0.4247),
        ("a,10,mm,0.03,normal\nb,0,mm,0.04,normal\nu_ges,,mm,0.05,\n", "u_ges", 0.05),
        ("a,10,mm,0.03,normal\nb,0,mm,0.04,normal\nQuadratic sum,,mm,0.05,\n", "y", 0.05),
        ("y,10,mm,0.05,\na,7,mm,0.03,normal\nb,3,mm,0.04,normal\n", "y", 0.05),
    ] {
        let budget = import("b.csv", format!("{head}{rows}").as_bytes()).unwrap();
        let task = task(&budget);
        let evaluated = gumption_engine::propagate::gum::evaluate(&task, &task.rows[0]);
        let found = evaluated.outputs[0].as_ref().unwrap().standard_uncertainty;
        assert_eq!(task.model.outputs[0].quantity.name, name, "{rows}");
        assert!((found - u).abs() < 1e-4, "{rows}: {found}");
    }
    for (text, said) in [
        ("Quantity,Estimate,Unit,u\nA,0,mm,0.3\nB,0,mm,0.4\nC,0,mm,0.5\n", "is 0 like the others"),
        (
            "Quantity,Estimate,Unit,u,Distribution\na,7,mm,0.03,normal\nb,3,mm,0.04,normal\n\
             m_x,10,mm,0.06,\n",
            "with another uncertainty",
        ),
        (
            "Quantity,Estimate,Unit,u,Distribution\nP,10,dBm,0.1,normal\nL,-20,dBW,0.1,normal\n",
            "levels above a reference",
        ),
        (
            "Quantity,Estimate,Unit,u,Distribution,c\nV,10,V,0.01,normal,1\n\
             corr,0.2,V,0.02,rectangular,1\noffset,1.5,V,,,\n",
            "whose coefficient is missing",
        ),
    ] {
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(said), "{text}{error}");
    }
}

/// 0.05 % of 100 mg is 0.05 mg; beside another number it has to be the same.
#[test]
fn relative_standard_uncertainties() {
    for (head, m, v) in [
        ("u,Relative u", ",0.05 %", ",0.1 %"),
        ("Relative standard uncertainty [%]", "0.05", "0.1"),
        ("u(x),u(x)/x", "0.05,0.0005", "0.05,0.001"),
    ] {
        let text = format!("c = m/V\n\nQuantity,Value,Unit,{head}\nm,100,mg,{m}\nV,50,mL,{v}\n");
        let (found, _) = uncertainties(&text);
        assert!(found.iter().all(|u| (u - 0.05).abs() < 1e-15), "{head}: {found:?}");
    }
    let text = "c = m/V\n\nQuantity,Value,Unit,u(x),u(x)/x\nm,100,mg,0.05,0.0005\n\
                V,50,mL,0.05,0.002\n";
    let said = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(said.contains("which is right"), "{said}");
}

/// What the equation does not name, and contributions of the sheet that are others, are told.
#[test]
fn what_contributes_nothing_or_something_else_is_told() {
    let text = "R = U/I,,,\n\nQuantity,Estimate,Unit,Standard uncertainty\n\
                U,5.01,V,0.01\nI,1.25,mA,0.001\ndT,0,K,0.1\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "ohm");
    assert!(guesses(&budget, "`ohm` is taken"), "{:?}", budget.guessed);
    assert!(guesses(&budget, "`dT` is not in the equation of R"), "{:?}", budget.guessed);
    let text = "Quantity,Estimate,Unit,Standard uncertainty,c_i,Contribution\n\
                a,5,V,0.002,1,0.002\nb,2,K,0.5,3,0.5\n";
    let (_, budget) = uncertainties(text);
    assert!(guesses(&budget, "`b` contributes 0.5, this model 1.5 V"), "{:?}", budget.guessed);
    assert!(!guesses(&budget, "`a` contributes"), "{:?}", budget.guessed);
}

#[test]
fn what_is_no_budget() {
    for (content, part) in [
        ("a,b\n1,2\n", "no budget is found"),
        ("label,x,U\nA,1,0.1\n", "gumption compare"),
        ("", "no budget is found"),
        ("quantity,estimate,+-\n", "no row below"),
        ("quantity,estimate,+-\nx,one,2\n", "no number"),
        ("quantity;estimate;+-\nx;1.234;0,5\n", "with the same decimal mark"),
        ("quantity,estimate,+-,divisor\nx,1,2,zero\n", "divisor"),
    ] {
        let error = import("x.csv", content.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(part), "{content}: {error}");
    }
    let error = import("x.xlsx", b"no workbook").unwrap_err().to_string();
    assert!(error.contains("no workbook"), "{error}");
}

/// Factors that stand with the distribution or the uncertainty; before, k = 1 was taken without a word.
#[test]
fn factors_stand_with_distributions_and_uncertainties() {
    for (distribution, width, u) in [
        ("normal (k=2)", "0.0004", 2e-4),
        ("Normal, k = 2", "0.0004", 2e-4),
        ("normal (95 %)", "0.0004", 4e-4 / 1.959_963_984_540_054),
        ("normal 2σ", "0.0004", 2e-4),
        ("normal 95 %", "0.0004", 4e-4 / 1.959_963_984_540_054),
        ("normal", "0.0004 V (k=2)", 2e-4),
        ("rectangular", "±0.0003", 3e-4 / 3_f64.sqrt()),
        ("Tri", "0.0006", 6e-4 / 6_f64.sqrt()),
        ("U-shaped", "0.0002", 2e-4 / 2_f64.sqrt()),
    ] {
        let text = format!(
            "Quantity;Estimate;Unit;Uncertainty;Distribution\nm;1;V;{width};{distribution}\n"
        );
        let (found, budget) = uncertainties(&text);
        assert!((found[0] / u - 1.0).abs() < 1e-12, "{distribution} {width}: {found:?}");
        assert!(!guesses(&budget, "k = 1"), "{:?}", budget.guessed);
    }
    let text = "Quantity,Estimate,Unit,Half-width,Distribution\nm,1,V,0.0004,normal\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found, [4e-4]);
    assert!(guesses(&budget, "k = 1 is taken"), "{:?}", budget.guessed);
    for (row, part) in [
        ("m,1,V,0.1,normal (k=2),3", "the divisor says 3, the distribution 2"),
        ("m,1,V,0.1,trapezoid,", "`trapezoid` is not known, and there is no divisor"),
        ("m,1,V,0.1,t,", "`t` needs a divisor or degrees of freedom"),
        ("m,1,V,0.1,rectangular,0.577", "is below 1: does it multiply, as 1/1.733"),
    ] {
        let text = format!("Quantity,Estimate,Unit,±,Distribution,Divisor\n{row}\n");
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(part), "{row}: {error}");
    }
}

/// Units of headings, and of a line below them; before, mm and um were added as they stood.
#[test]
fn headings_state_units() {
    let head = [
        "Quantity;Estimate (mm);Standard uncertainty (µm);Distribution;Sensitivity coefficient",
        "Quantity;Estimate [mm];u(xi) [µm];Distribution;c_i",
        "Quantity;Estimate;Standard uncertainty;Distribution;c_i\n;mm;µm;;",
    ];
    for head in head {
        let text = format!("{head}\nL;50,002;0,5;normal;1\nd;0,0010;0,2;normal;1\n");
        let (found, budget) = uncertainties(&text);
        assert_eq!(found, [0.0005, 0.0002], "{head}");
        assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "mm");
    }
    // a share of the estimate; nothing else says of what it is
    let text =
        "R = U/I\nQuantity;Estimate;Unit;Standard uncertainty (%)\nU;10,05;V;0,02\nI;2;A;0,05\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found, [0.00201, 0.001]);
    assert!(guesses(&budget, "`0.02 %` is taken of the estimate 10.05"), "{:?}", budget.guessed);
    let (found, budget) = uncertainties("Source,Uncertainty (%),Divisor\na,0.35,1\nb,0.2,2\n");
    assert_eq!(found, [0.35, 0.1]);
    assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "%");
    let (found, _) = uncertainties("Quantity,Estimate,Unit,±,Divisor\nR,100,ohm,500 ppm,2\n");
    assert_eq!(found, [0.025]);
    let (found, _) = uncertainties("Quantity;Estimate;Unit;±;Divisor\nU;10;V;0,02 % + 2 mV;2\n");
    assert_eq!(found, [0.002]);
    // symbols of what a column holds are no units, and half-widths in brackets no years
    let (found, _) =
        uncertainties("Quantity,Estimate,Unit,Half-width (a),Divisor\nR,100,ohm,2,2\n");
    assert_eq!(found, [1.0]);
    for (row, part) in
        [("L;50;22 nm", "whose heading says `µm`"), ("L;50;2 %", "whose heading says `µm`")]
    {
        let text = format!("Quantity;Estimate (mm);u (µm)\n{row}\n");
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(part), "{row}: {error}");
    }
    for (row, part) in [
        ("d;0;V;0,1 %", "`0.1 %` of the estimate 0 is nothing"),
        ("h;0,5;;2 %", "can be 2 % of the estimate 0.5, or 0.02 itself"),
    ] {
        let text = format!("Quantity;Estimate;Unit;±\n{row}\n");
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(part), "{row}: {error}");
    }
}

/// UKAS M3003's headings, with `Value (±)` and `νi or νeff`, the contributions `ui` behind the
/// coefficients and a summary. Published for such a standard resistor: 0.41 ppm.
#[test]
fn a_budget_in_the_layout_of_ukas() {
    let text = "Symbol,Source of uncertainty,Value (±),Probability distribution,Divisor,ci,ui (ppm),\
        vi or veff\nRS,Calibration,0.5 ppm,Normal,2,1,0.25,∞\n\
        dRD,Drift,0.5 ppm,Rectangular,√3,1,0.289,∞\nV,Repeatability,0.15 ppm,Normal,1,1,0.15,4\n\
        uc(Rx),Combined standard uncertainty,,Normal,,,0.41,>200\n\
        U,Expanded uncertainty,,Normal (k=2),,,0.82,>200\n";
    let (found, budget) = uncertainties(text);
    assert!((found.iter().map(|u| u * u).sum::<f64>().sqrt() - 0.41).abs() < 0.005, "{found:?}");
    assert_eq!(known_dof(&budget), [f64::INFINITY, f64::INFINITY, 4.0]);
    assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
}

fn known_dof(budget: &ImportedBudget) -> Vec<f64> {
    task(budget).rows[0].distributions.iter().map(|d| d.dof()).collect()
}

/// What the sheet says of its result is compared with the model: EA-4/02, S4, where the combined
/// uncertainty is 36.4 nm, once with a wrong one.
#[test]
fn the_sheet_s_result_is_compared() {
    let table = |u: &str, estimate: &str| {
        format!(
            "Quantity;Estimate;Standard uncertainty;Probability distribution;Sensitivity coefficient\n\
             lS;50,000020 mm;15 nm;normal;1,0\ndlD;0 mm;17,3 nm;rectangular;1,0\n\
             dl;-0,000094 mm;5,37 nm;normal;1,0\ndlC;0 mm;18,5 nm;rectangular;1,0\n\
             dt;0 °C;0,0289 °C;rectangular;-575 nm/°C\nda;0;0,236·10⁻⁶;special;-50 mm\n\
             dlV;0 mm;3,87 nm;rectangular;–1,0\nlX;{estimate} mm;{u};;\n"
        )
    };
    let told = |u: &str, estimate: &str| {
        let budget = import("S4.csv", table(u, estimate).as_bytes()).unwrap();
        guesses(&budget, "the sheet says that")
    };
    assert!(!told("36,4 nm", "49,999926"));
    assert!(told("34,3 nm", "49,999926"));
    for (rows, part) in [
        ("E;1111,1;%;0,58;2", "the expanded uncertainty of the result is 0,58 %, this model 0.66"),
        ("E;1111,1;%;;\nExpanded uncertainty (k=3);1,1;%;;", "is 1,1 %, this model 0.99"),
    ] {
        let text = format!(
            "E = (m1-m2)/m2*100\nQuantity;Estimate;Unit;±;Divisor\n\
             m1;10;g;0,0004;2\nm2;9;g;0,0004;2\n{rows}\n"
        );
        let budget = import("b.csv", text.as_bytes()).unwrap();
        assert!(guesses(&budget, part), "{rows}: {:?}", budget.guessed);
    }
}

/// A factor or a probability in the name of a row or in a remark is taken, and said; beside a half-width it
/// contradicts. A share is none.
#[test]
fn coverage_is_said_in_words() {
    let head = "Source,Value,Unit,Uncertainty,Distribution,Remark\n";
    for (row, u) in [
        ("Standard (k=2),5,V,0.10,Normal,", 0.05),
        ("Standard,5,V,0.10,Normal,k=2", 0.05),
        ("Cert U95,5,V,0.196,Normal,", 0.1),
        ("Humidity at 60 %,5,V,0.10,Normal,", 0.10),
    ] {
        let (found, budget) = uncertainties(&format!("{head}{row}\n"));
        // 1.96 has four digits here
        assert!((found[0] / u - 1.0).abs() < 1e-4, "{row}: {found:?}");
        assert_eq!(guesses(&budget, "by its words"), !row.contains('%'), "{row}");
    }
    for (row, said) in [
        ("Standard (k=2),5,V,0.10,Rectangular,", "half-width or an expanded uncertainty"),
        ("Standard (k=2),5,V,0.10,Normal,k=3", ""),
    ] {
        let found = import("b.csv", format!("{head}{row}\n").as_bytes());
        assert!(said.is_empty() || found.unwrap_err().to_string().contains(said), "{row}");
    }
    for heading in ["p", "CL", "Conf. level", "Level", "Coverage"] {
        let text = format!("Source,Value,Unit,U,{heading}\na,5,V,0.1,95%\n");
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("tells the coverage factors"), "{heading}: {error}");
    }
    let (found, _) = uncertainties("Source,Value,Unit,U,CF\na,5,V,0.1,2\n");
    assert_eq!(found, [0.05]);
    // a half-width below the heading of expanded uncertainties is said
    let (_, budget) =
        uncertainties("Source,Value,Unit,U (k=2),Distribution\na,5,V,0.1,rectangular\n");
    assert!(guesses(&budget, "for its half-width"), "{:?}", budget.guessed);
}

/// The words of totals stand right before their numbers in many workbooks.
#[test]
fn totals_beside_their_numbers() {
    let text = "Source,Value,Unit,±,Distribution,Divisor,c_i,u_i(y)\n\
                Reference,100.000,mm,0.5,Normal,2,1,0.25\n\
                Indication,100.200,mm,0.3,Rect,1.732,-1,0.173\n\
                ,,,,,,uc,0.304\n,,,,,,U (k=2),0.61\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found.len(), 2);
    assert!(budget.text.contains("\"y\":\"Reference + (-1)*Indication\""), "{}", budget.text);
    // they are compared with the model
    let wrong = import("b.csv", text.replace("0.304", "0.404").as_bytes());
    let said = wrong.map_or_else(|error| error.to_string(), |budget| budget.guessed.join("; "));
    assert!(said.contains("0.404"), "{said}");
}

/// Half a digit is no half of 100 %.
#[test]
fn digits_need_a_coefficient() {
    let text = "Source,Value,Unit,±,Distribution,Divisor\nStandard,0,%,0.10,Normal,2\n\
                Resolution,0,digit,0.5,Rectangular,1.732\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("is in `digit`, the result in `%`"), "{error}");
}

/// Standard deviations of a number of readings are of one reading or of their mean.
#[test]
fn numbers_of_readings_are_asked() {
    for heading in
        ["n", "N", "No. of readings", "Readings", "Count", "Sample size", "Anzahl Messungen"]
    {
        let text = format!(
            "Source,Value,Unit,Standard deviation,Distribution,{heading}\nA,50,V,0.05,Normal,10\n"
        );
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("standard deviation of single readings"), "{heading}: {error}");
    }
}

/// What stands below a budget is no result of it: a tolerance, a temperature, a number of readings; a
/// coefficient of correlation is told.
#[test]
fn rows_beside_the_budget_are_no_results() {
    let head = "Source,Value,Unit,±,Distribution,Divisor,c_i,u_i(y)\n\
                Reference,100.000,mm,0.5,Normal,2,1,0.25\n\
                Indication,100.200,mm,0.3,Rect,1.732,-1,0.173\n";
    for row in [
        "Combined,,mm,,,,,0.304\nTolerance,0.5,mm,,,,,\n",
        "Ambient temperature,20.3,°C,,,,,\n",
        "Scale interval,0.1,mm,,,,,\n",
        "Drift per year,0.01,mm,,,,,\n",
        "n,10,,,,,,\n",
    ] {
        let error = import("b.csv", format!("{head}{row}").as_bytes()).unwrap_err().to_string();
        assert!(error.contains("stand beside the budget"), "{row}: {error}");
    }
    for (row, expected) in [
        ("Error,-0.2,mm,,,,,\n", "\"Error\":\"Reference + (-1)*Indication\""),
        ("\"r(Ref,Ind)\",0.9,,,,,,\n", "\"y\":\"Reference + (-1)*Indication\""),
    ] {
        let budget = import("b.csv", format!("{head}{row}").as_bytes()).unwrap();
        assert!(budget.text.contains(expected), "{row}: {}", budget.text);
        assert_eq!(guesses(&budget, "independent without it"), row.contains("r("), "{row}");
    }
}

/// A sheet whose coefficient has the wrong sign, or none, adds up to another estimate: that is said,
/// with the sign that would explain it.
#[test]
fn constants_are_told() {
    let head = "Quantity,Estimate,Unit,Standard uncertainty,Distribution,Sensitivity coefficient\n";
    let rows = "V_s,10.00012,V,0.00002,normal,1\ncorr,0.00005,V,0.00001,normal,1\n";
    let (_, budget) = uncertainties(&format!("{head}{rows}V_x,10.00007,V,,,\n"));
    assert!(guesses(&budget, "coefficient -1 of `corr` (line 3)"), "{:?}", budget.guessed);
    let (_, budget) = uncertainties(&format!("{head}{rows}V_x,10.00017,V,,,\n"));
    assert!(!guesses(&budget, "the constant"), "{:?}", budget.guessed);
}

/// `u` heads standard uncertainties, and is a half-width only where it is still to be divided.
#[test]
fn a_column_u_is_of_standard_uncertainties() {
    let rows = "ts,23.010,°C,0.010,normal,1\ndtD,0,°C,0.012,rectangular,1\ntx,23.010,°C,0.0156,,\n";
    let head = "Quantity,Estimate,Unit,u,Distribution,Sensitivity coefficient\n";
    let (found, budget) = uncertainties(&format!("{head}{rows}"));
    // a rectangle of the half-width 0.012 sqrt(3), which has that standard deviation to rounding
    assert!((found[0] - 0.010).abs() < 1e-15 && (found[1] - 0.012).abs() < 1e-12, "{found:?}");
    assert!(!guesses(&budget, "the sheet"), "{:?}", budget.guessed);
    let (found, _) = uncertainties("Quantity,Estimate,u,Divisor\na,5,0.3,3\n");
    assert!((found[0] - 0.1).abs() < 1e-15);
}

/// A slip in a unit is a mistake and no plain number; `Ohm` is how tables write the ohm.
#[test]
fn units_with_a_slip_are_mistakes() {
    let rows = |unit: &str| {
        format!(
            "Quantity;Estimate;Unit;Half-width;Distribution;Sensitivity\n\
             R;30,00;Ohm;0,05;rectangular;1\ndR;0;{unit};20;rectangular;\nRx;30,00;Ohm;;;\n"
        )
    };
    let (found, _) = uncertainties(&rows("mOhm"));
    assert!((found[0] - 0.05 / 3f64.sqrt()).abs() < 1e-12);
    let error = import("b.csv", rows("mOHm").as_bytes()).unwrap_err().to_string();
    assert!(error.contains("`mOHm` is not a known unit; did you mean"), "{error}");
}

/// A result is not added to its own parts, whatever follows it; before, it was.
#[test]
fn results_are_no_parts_of_themselves() {
    let text = "Quantity;Estimate;Unit;Standard uncertainty;Distribution;Sensitivity coefficient\n\
        Mass;997,5;mg;0,15;normal;1,0029 µL/mg\nZ;1,0029;µL/mg;0,0002;normal;997,5 mg\n\n\
        Volume;1000,39;µL;0,2496;;\nk;2;;;;\nU;0,50;µL;;;\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found, [0.15, 0.0002]);
    let output = task(&budget).model.outputs[0].quantity.clone();
    assert_eq!((output.name.as_str(), output.unit.text()), ("Volume", "µL"));
    assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
    let text = "Quantity,Estimate,Unit,Standard uncertainty,Distribution,Sensitivity coefficient\n\
        m_S,10000.005,g,0.0225,normal,1\ndm,0,g,0.00895,rectangular,1\nSum,,,,,\n\
        m_X,10000.005,g,0.0242,normal,\n";
    let (_, budget) = uncertainties(text);
    assert!(budget.text.contains(r#""m_X":"m_S + dm""#), "{}", budget.text);
}

/// Constants whose symbols are those of summaries are quantities where an equation needs them, or where
/// other quantities follow.
#[test]
fn symbols_of_summaries_may_name_quantities() {
    let text = "R = U/I\nQuantity,Estimate,Unit,Standard uncertainty\nI,2,A,0.1\nU,10,V,\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert_eq!(task(&budget).variables.len(), 2);
    let text = "Quantity,Estimate,Unit,Standard uncertainty,c_i\np,1013,hPa,,2\nx,2,hPa,0.1,1\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert_eq!(task(&budget).variables.len(), 2, "{}", budget.text);
}

/// Correlations and lines below the table are told; texts that look like an equation are read or
/// refused, and no sum is taken in their place.
#[test]
fn nothing_of_the_sheet_is_dropped_without_a_word() {
    let head = "Quantity;Estimate;Unit;Standard uncertainty";
    for line in ["Correlation between a and b: r = 0.7", "r(a, b) = 0,7;;;", "Korrelation;0,7;;"] {
        let budget = import("b.csv", format!("{head}\na;1;V;0,1\nb;2;V;0,1\n{line}\n").as_bytes());
        let budget = budget.unwrap_or_else(|error| panic!("{line}: {error}"));
        assert!(guesses(&budget, "independent without it"), "{line}: {:?}", budget.guessed);
        assert_eq!(task(&budget).variables.len(), 2, "{line}");
    }
    // quantities with such words stay
    for row in ["b;2;V;0,1;r(a;b)=0.7", "b;2;V;0,1;uncorrelated", "Correlation of air;2;V;0,1;"] {
        let text =
            format!("{head};Remark\na;1;V;0,1;\n{row}\n").replace("r(a;b)=0.7", "\"r(a;b)=0.7\"");
        let budget = import("b.csv", text.as_bytes()).unwrap();
        assert_eq!(task(&budget).variables.len(), 2, "{row}");
        let denied = row.contains("uncorrelated");
        assert_eq!(guesses(&budget, "independent without it"), !denied, "{row}");
    }
    let below = format!("{head}\na;1;V;0,1\nb;2;V;0,1\n\n\nc;3;V;0,1\n");
    let budget = import("b.csv", below.as_bytes()).unwrap();
    assert!(guesses(&budget, "`c` stands below the table"), "{:?}", budget.guessed);
    for (equation, formula) in [
        ("y = 1,5*a + b", "1.5*a + b"),
        ("y = a – b", "a - b"),
        ("y = a·(1 + b²/a²)", "a*(1 + b^2/a^2)"),
        ("Model: y = √2 × a + b", "sqrt(2) * a + b"),
    ] {
        let text = format!("{equation}\n{head}\na;1;V;0,1\nb;2;V;0,1\n");
        let budget = import("b.csv", text.as_bytes()).unwrap_or_else(|e| panic!("{equation}: {e}"));
        assert!(budget.text.contains(&format!(r#""y":"{formula}""#)), "{}", budget.text);
    }
    for (equation, part) in [
        ("y = 2a - b", "`y = 2a - b` cannot be read as an equation"),
        ("y = a + b\nz = a - b", "the result can be `y` of line 1 or `z` of line 2"),
        ("y = b*2^a", "which `mV` would not be converted"),
    ] {
        let text = format!("{equation}\n{head}\na;1;mV;0,1\nb;2;V;0,1\n");
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(part), "{equation}: {error}");
    }
    let text = format!("c = a/2\ny = c - b\n{head}\na;50;mm;0,1\nb;1;mm;0,1\ny;24;mm;\n");
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert!(budget.text.contains(r#"{"c":"a/2","y":"c - b"}"#), "{}", budget.text);
}

/// Standard uncertainties beside stated ones: they tell the factor, or contradict.
#[test]
fn standard_uncertainties_beside_stated_ones() {
    let text = "Source,Unit,a,Distribution,u(xi),c_i\nRef,V,0.002,normal,0.001,1\n\
        Res,V,0.001,rectangular,0.00058,1\n";
    let (found, budget) = uncertainties(text);
    assert!((found[0] - 0.001).abs() < 1e-18 && (found[1] - 5.77e-4).abs() < 1e-6, "{found:?}");
    assert!(!guesses(&budget, "k = 1"), "{:?}", budget.guessed);
    let text = "Source,Unit,±,Divisor,u(xi)\nRef,V,0.030,2,0.030\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("has the standard uncertainty 0.0150 by its stated"), "{error}");
    // a shape keeps its standard uncertainty
    let (found, budget) =
        uncertainties("Source,Unit,u(xi),Distribution\nRes,V,0.003,rectangular\n");
    assert!((found[0] / 0.003 - 1.0).abs() < 1e-14, "{found:?}");
    assert_eq!(task(&budget).rows[0].distributions[0].name(), "rectangular");
}

/// Decimal commas in quotes between commas, French headings, words with a semicolon, `>100`.
#[test]
fn sheets_of_other_habits() {
    let text = "Grandeur,Estimation,Unité,Incertitude-type,Loi,Coefficient de sensibilité,ddl\n\
        Étalon,\"50,000 2\",mm,\"0,000 03\",normale,1,>100\n\
        Résolution; lue,0,mm,\"0,000 1\",rectangulaire,1,∞\n";
    let (found, budget) = uncertainties(text);
    assert!((found[0] - 3e-5).abs() < 1e-18 && (found[1] - 1e-4).abs() < 1e-17, "{found:?}");
    assert_eq!(known_dof(&budget), [100.0, f64::INFINITY]);
    let error = import("b.csv", b"Quantity,Estimate,Unit,+-\na,\"1,500\",V,0.1\n").unwrap_err();
    assert!(error.to_string().contains("not grouped"), "{error}");
}

/// Limits: 20 °C ± 0.5 °C is what 19.5 °C to 20.5 °C says, and a tolerance of -0.1 V to 0.1 V beside 10 V
/// is one of deviations.
#[test]
fn limits_are_half_widths() {
    let (u, budget) = uncertainties(
        "Quantity;Estimate;Unit;Lower limit;Upper limit;Distribution\n\
         a;20;mm;19,5;20,5;rectangular\nb;;mm;-3;1;\nc;10;mm;-0,1;0,1;triangular\n",
    );
    let means: Vec<f64> = task(&budget).rows[0].distributions.iter().map(|d| d.mean()).collect();
    assert_eq!(means, [20.0, -1.0, 10.0]);
    for (found, wanted) in u.iter().zip([0.5 / 3f64.sqrt(), 2.0 / 3f64.sqrt(), 0.1 / 6f64.sqrt()]) {
        assert!((found / wanted - 1.0).abs() < 1e-12, "{u:?}");
    }
    assert!(guesses(&budget, "line 3: the estimate is the middle of the limits"));
    assert!(guesses(&budget, "line 4: the limits are taken as deviations of ±0.1"));
    let said = |row: &str| {
        let text = format!("Quantity;Estimate;Min;Max\n{row}\n");
        import("l.csv", text.as_bytes()).unwrap_err().to_string()
    };
    assert!(said("a;20;19;20,5").contains("do not lie alike about the estimate 20"));
    assert!(said("a;0,2;-1;1").contains("do not lie alike about the estimate 0.2"));
    assert!(said("a;20;21;19").contains("the upper limit 19 is below the lower one, 21"));
    assert!(said("a;20;19;").contains("one limit only"));
    // a limit of errors is a width, and one limit alone none
    let (u, budget) = uncertainties(
        "Quantity;Estimate;Unit;Maximum permissible error;Distribution;Max\n\
         a;20;mm;0,3;rectangular;21\n",
    );
    assert!((u[0] - 0.3 / 3f64.sqrt()).abs() < 1e-15);
    assert!(guesses(&budget, "the column `Max` is not taken"));
}

/// Headings of two lines, as merged cells leave them.
#[test]
fn a_heading_over_several_columns() {
    let (u, budget) = uncertainties(
        "Budget\n\nQuantity;Estimate;Unit;Uncertainty;;;Sensitivity coefficient\n\
         ;;;Half-width;Distribution;Divisor;\na;20;mm;0,5;normal;2;1\nb;1;mm;0,1;rectangular;√3;1\n",
    );
    assert_eq!(u[0], 0.25);
    assert!((u[1] - 0.1 / 3f64.sqrt()).abs() < 1e-15);
    assert!(budget.understood[0].contains("`Half-width` as stated uncertainty"), "{budget:?}");
    // a line of units is none
    let (u, _) = uncertainties(
        "Quantity;Estimate;Standard uncertainty;Distribution\n;V;V;\na;20;0,5;normal\n",
    );
    assert_eq!(u, [0.5]);
}

/// Units as tables have them: behind a name, as `/K`, with a plain exponent; the type of the evaluation
/// beside degrees of freedom.
#[test]
fn units_behind_names_and_without_signs_of_powers() {
    let text = "Quantity;Estimate;Unit;Standard uncertainty;Sensitivity coefficient;Degrees of freedom\n\
        alpha;11,5e-6;/K;0,5e-6;2;∞ (B)\n\
        beta [K^-1];1e-6;;1e-7;1;9 (A)\n\
        gamma;2e-6;K-1;1e-7;1;50 (Type B)\n";
    let budget = import("b.csv", text.as_bytes()).unwrap();
    let task = task(&budget);
    let names: Vec<&str> = task.variables.iter().map(|v| v.name.as_str()).collect();
    assert_eq!(names, ["alpha", "beta", "gamma"], "{}", budget.text);
    for unit in ["\"1/K\"", "\"K^-1\""] {
        assert!(budget.text.contains(unit), "{}", budget.text);
    }
    assert!(budget.text.contains("\"dof\":9.0") && budget.text.contains("\"dof\":50.0"));
    // two units for one row
    let text = text.replace("beta [K^-1];1e-6;;", "beta [K^-1];1e-6;m;");
    let error = import("b.csv", text.as_bytes()).unwrap_err();
    assert!(
        format!("{error:?}").contains("says `K^-1`, but the column of the unit `m`"),
        "{error:?}"
    );
}

/// A coverage probability with degrees of freedom has the factor of the t distribution: 2.776 445 of 95 %
/// and 4 (JCGM 100, table G.2, to more digits), with which 0.0002 V is 7.2035e-5 V. Before, it was 1.96.
#[test]
fn probabilities_with_degrees_of_freedom_have_the_factor_of_t() {
    let t = 2.776_445_105_198;
    for (heading, distribution) in [
        ("Uncertainty (95 %)", "t"),
        ("Uncertainty (95 %)", "normal"),
        ("Uncertainty", "normal (95 %)"),
        ("Uncertainty", "t (95 %)"),
    ] {
        let text = format!(
            "Quantity,Estimate,Unit,{heading},Distribution,dof,ci\nCal,0,V,0.0002,{distribution},4,1\n"
        );
        let (found, budget) = uncertainties(&text);
        assert!((found[0] * t / 2e-4 - 1.0).abs() < 1e-12, "{heading} {distribution} {found:?}");
        assert!(budget.text.contains(r#""expanded":0.0002,"p":0.95,"dof":4.0"#), "{}", budget.text);
        let said = "95 % and 4 degrees of freedom k = 2.776";
        assert!(budget.understood.iter().any(|of| of.contains(said)), "{:?}", budget.understood);
    }
    // a factor goes before a probability, and infinite degrees of freedom have that of a normal one
    for (heading, dof, divisor, k) in [
        ("Uncertainty (95 %), k=2", "4", "", 2.0),
        ("Uncertainty (95 %)", "∞", "", 1.959_963_984_540_054),
        ("Uncertainty (95 %)", "4", "2.78", 2.78),
        ("Uncertainty (95 %)", "4", "1.96", 1.96),
    ] {
        let text = format!(
            "Quantity;Estimate;Unit;{heading};Distribution;dof;Divisor\nCal;0;V;0.0002;t;{dof};{divisor}\n"
        );
        let (found, _) = uncertainties(&text);
        assert!((found[0] * k / 2e-4 - 1.0).abs() < 1e-12, "{heading} {dof} {divisor} {found:?}");
    }
    let text = "Quantity,Estimate,Unit,Uncertainty,Distribution\nCal,0,V,0.0002,t (95 %)\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("`t (95 %)` needs a divisor or degrees of freedom"), "{error}");
}

/// An expanded uncertainty of a probability is compared with the factor of the effective degrees of
/// freedom, 2.776 of 4, or that of a normal distribution: 2.776 V and 1.960 V of 1 V.
#[test]
fn expanded_results_of_a_probability_are_compared() {
    for (u, is_told) in [("2.776", false), ("1.960", false), ("2.3", true)] {
        let text = format!(
            "Quantity,Estimate,Unit,Standard uncertainty,dof\na,5,V,1,4\nb,2,V,0,\n\
             Expanded uncertainty (95 %),,V,{u},\n"
        );
        let (_, budget) = uncertainties(&text);
        assert_eq!(guesses(&budget, "the sheet says"), is_told, "{u}: {:?}", budget.guessed);
    }
}

/// What a distribution's cell calls a full width is halved: 0.002 V of a rectangle from limit to limit is
/// 0.001/sqrt(3) V. Before, it was taken for the half-width.
#[test]
fn full_widths_are_halved() {
    let text = |heading: &str, shape: &str, divisor: &str| {
        format!(
            "Quantity;Estimate;Unit;{heading};Distribution;Divisor\na;1;V;0.002;{shape};{divisor}\n"
        )
    };
    for (heading, shape, divisor, root) in [
        ("Uncertainty", "rectangular (full width)", "", 3.0_f64),
        ("Uncertainty", "rectangular (full range)", "", 3.0),
        ("Uncertainty", "triangular (total width)", "", 6.0),
        ("Uncertainty", "rectangular, range (max-min)", "", 3.0),
        ("Unsicherheit", "Rechteck (Vollbreite)", "", 3.0),
        ("Unsicherheit", "Rechteck (Gesamtbreite)", "", 3.0),
        ("Unsicherheit", "Rechteck (Spannweite)", "", 3.0),
        ("Incertitude", "rectangulaire (étendue totale)", "", 3.0),
        ("Uncertainty (full width)", "rectangular", "", 3.0),
        ("Uncertainty", "rectangular (full width)", "2√3", 3.0),
    ] {
        let (found, budget) = uncertainties(&text(heading, shape, divisor));
        assert!((found[0] * root.sqrt() / 1e-3 - 1.0).abs() < 1e-12, "{shape}: {found:?}");
        let is_said = budget.understood.iter().any(|said| said.contains("half of 0.002 is taken"));
        assert!(is_said, "{:?}", budget.understood);
    }
    for shape in ["rectangular (Type B)", "rectangular (half-width)", "rectangular (100 %)"] {
        let (found, _) = uncertainties(&text("Uncertainty", shape, ""));
        assert!((found[0] * 3f64.sqrt() / 2e-3 - 1.0).abs() < 1e-12, "{shape}: {found:?}");
    }
    for (heading, shape, divisor, part) in [
        (
            "Half-width",
            "rectangular (full width)",
            "",
            "heading `Half-width` and `rectangular (full width)` contradict",
        ),
        ("Uncertainty", "rectangular (peak)", "", "what `peak` says of the uncertainty is not"),
        ("Uncertainty", "normal (full width)", "", "can be 0.002 or 0.001 that is divided"),
        (
            "Uncertainty",
            "rectangular (full width)",
            "1.732",
            "and the divisor 1.732 can be 0.002 or",
        ),
    ] {
        let error = import("b.csv", text(heading, shape, divisor).as_bytes()).unwrap_err();
        assert!(error.to_string().contains(part), "{shape}: {error}");
    }
}

/// The one error of a text.
fn refusal(text: &str) -> String {
    import("b.csv", text.as_bytes()).unwrap_err().to_string()
}

/// Sums of some rows are no inputs, and rows of totals and expanded uncertainties are compared:
/// sqrt(0.3^2 + 0.4^2 + 1.2^2) = 1.3, twice of it 2.6.
#[test]
fn sums_and_totals_are_no_inputs() {
    let head = "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity coefficient\n";
    for subtotal in ["Subtotal", "Sub-total", "Zwischensumme", "Sous-total", "Subtotal (A)"] {
        let text = format!(
            "{head}a,5,V,0.3,1\nb,2,V,0.4,1\n{subtotal},7,V,0.5,1\nc,0,V,1.2,1\nTotal,7,V,1.3,\n"
        );
        let (found, budget) = uncertainties(&text);
        assert_eq!(found, [0.3, 0.4, 1.2], "{subtotal}");
        assert!(guesses(&budget, "is a sum of other rows; left out"), "{:?}", budget.guessed);
        assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
    }
    for (row, told) in [
        ("Total,7,V,1.5,", "the standard uncertainty of the result is 1.5 V, this model 1.30 V"),
        ("Summe,7,V,1.5,", "the standard uncertainty of the result is 1.5 V, this model 1.30 V"),
        (
            "Expanded (k=2),,V,3.0,",
            "the expanded uncertainty of the result is 3.0 V, this model 2.60 V",
        ),
        (
            "Expanded (k=2),3.0,V,,",
            "the expanded uncertainty of the result is 3.0 V, this model 2.60 V",
        ),
        ("U (k=2),,V,3.0,", "the expanded uncertainty of the result is 3.0 V, this model 2.60 V"),
        ("U (k=2),3.0,V,,", "the expanded uncertainty of the result is 3.0 V, this model 2.60 V"),
        ("Expanded (k=2),,V,2.6,", ""),
        ("U (k=2),,V,2.6,1", ""),
        ("Expanded,2.6,V,,", ""),
    ] {
        let (found, budget) =
            uncertainties(&format!("{head}a,5,V,0.3,1\nb,2,V,0.4,1\nc,0,V,1.2,1\n{row}\n"));
        assert_eq!(found, [0.3, 0.4, 1.2], "{row}");
        assert!(!budget.text.contains("2.6") && !budget.text.contains("3.0"), "{}", budget.text);
        let is_told = guesses(&budget, "the sheet says");
        assert_eq!(is_told, !told.is_empty(), "{row}: {:?}", budget.guessed);
        assert!(told.is_empty() || guesses(&budget, told), "{row}: {:?}", budget.guessed);
    }
}

/// A symbol behind the words says that an uncertainty is expanded, as the words alone do.
#[test]
fn a_symbol_behind_the_words_is_of_expanded_uncertainties() {
    for heading in [
        "Incertitude élargie U",
        "Incertitude élargie",
        "Erweiterte Messunsicherheit U",
        "Expanded uncertainty U",
        "Uncertainty U",
    ] {
        let text = format!("Grandeur;Estimation;Unité;{heading}\nm;1;kg;0,0004\n");
        let (found, budget) = uncertainties(&text);
        assert_eq!(found, [2e-4], "{heading}");
        assert!(guesses(&budget, "k = 2 is taken"), "{:?}", budget.guessed);
    }
}

/// Limits that are deviations and not alike: the middle of -0.0005 and 0.0003 is -0.0001, half of their
/// distance 0.0004.
#[test]
fn limits_that_are_deviations_move_the_estimate() {
    let text = |estimate: &str, limits: &str, shape: &str| {
        format!(
            "Quantity,Estimate,Unit,Lower limit,Upper limit,Distribution\n\
             Cal,{estimate},V,{limits},{shape}\n"
        )
    };
    let error = refusal(&text("10.000", "-0.0005,0.0003", "rectangular"));
    let part = "write the estimate 9.9999 V and the limits -0.0004 and 0.0004";
    assert!(error.contains(part), "{error}");
    let (found, budget) = uncertainties(&text("9.9999", "-0.0004,0.0004", "rectangular"));
    assert!((found[0] - 4e-4 / 3f64.sqrt()).abs() < 1e-15);
    assert_eq!(task(&budget).rows[0].distributions[0].mean(), 9.9999);
    let error = refusal(&text("20", "19,20.5", "triangular"));
    assert!(
        error.contains("write the middle 19.75 as the estimate if that is the most"),
        "{error}"
    );
    assert!(
        error.contains("`lower`, `upper` and `mode`") && !error.contains("as likely"),
        "{error}"
    );
}

/// Shortened headings of standard uncertainties, and `u` beside what is divided: both are compared.
#[test]
fn quotients_under_short_headings_are_compared() {
    for heading in ["Std unc", "Std. unc.", "Std uncertainty", "Stand. unc.", "u", "u(xi)", "u (V)"]
    {
        for (head, row) in [
            (format!("Uncertainty,Divisor,{heading}"), ["0.03,2,0.015", "0.03,2,0.03"]),
            (format!("{heading},Uncertainty,Divisor"), ["0.015,0.03,2", "0.03,0.03,2"]),
        ] {
            let text = format!("Source,Unit,{head}\nRef,V,{}\n", row[0]);
            let (found, budget) = uncertainties(&text);
            assert_eq!(found, [0.015], "{head}");
            assert!(!guesses(&budget, "not taken"), "{head}: {:?}", budget.guessed);
            let error = refusal(&format!("Source,Unit,{head}\nRef,V,{}\n", row[1]));
            assert!(error.contains("has the standard uncertainty 0.0150 by its stated"), "{error}");
        }
    }
    // 250 ppm of 100 ohm
    let text =
        "Quantity,Estimate,Unit,Uncertainty (ppm),Divisor,Std unc (ppm)\nR,100,ohm,500,2,250\n";
    assert_eq!(uncertainties(text).0, [0.025]);
    let text = "Quantity,Estimate,Unit,Std unc (ppm)\nR,100,ohm,250\n";
    assert_eq!(uncertainties(text).0, [0.025]);
}

#[test]
fn a_repeated_header_begins_another_budget() {
    let head = "Quantity,Estimate,Unit,Uncertainty,Distribution,Divisor";
    for between in ["", "\n", "\n\nBudget 2\n"] {
        let text = format!("{head}\na,1,V,0.1,normal,2\n{between}{head}\nb,1,V,0.1,normal,2\n");
        let error = refusal(&text);
        let line = 3 + between.matches('\n').count();
        assert!(error.contains(&format!("line {line} begins a second budget")), "{error}");
        assert_eq!(
            error.trim().lines().filter(|line| line.contains("b.csv")).count(),
            1,
            "{error}"
        );
    }
}

/// `10.000` is ten or ten thousand where German headings stand and no number shows the mark.
#[test]
fn points_that_may_group_thousands_are_asked() {
    let german = "Größe;Schätzwert;Einheit;Halbbreite;Verteilung";
    let english = "Quantity;Estimate;Unit;Half-width;Distribution";
    let error = refusal(&format!("{german}\nm;10.000;g;1;Rechteck\n"));
    assert!(error.contains("`10.000` can be `10,000` or `10000`"), "{error}");
    for (head, width, u) in [(german, "0.5", 0.5), (german, "0.005", 0.005), (english, "1", 1.0)] {
        let (found, budget) = uncertainties(&format!("{head}\nm;10.000;g;{width};Rechteck\n"));
        assert!((found[0] - u / 3f64.sqrt()).abs() < 1e-15, "{head} {width}");
        assert_eq!(task(&budget).rows[0].distributions[0].mean(), 10.0);
    }
    let error = refusal(&format!("{german}\nm;10.000;g;0,5;Rechteck\n"));
    assert!(error.contains("with the same decimal mark"), "{error}");
}

/// Divisors `√n`: 0.3 V of nine readings is 0.1 V.
#[test]
fn roots_of_numbers_of_readings_divide() {
    for (heading, root) in
        [("Uncertainty", "√n"), ("Uncertainty", "sqrt(n)"), ("Standard deviation", "√n")]
    {
        let head = format!("Quantity;Estimate;Unit;{heading};Distribution;Divisor;n");
        let rows = format!("R;10;V;0,3;normal;{root};9\nC;0;V;0,2;normal;2;\n");
        let (found, budget) = uncertainties(&format!("{head}\n{rows}"));
        assert!(found.iter().all(|u| (u - 0.1).abs() < 1e-15), "{heading} {found:?}");
        assert!(!guesses(&budget, "not taken"), "{:?}", budget.guessed);
        let error = refusal(&format!("{head}\n{}", rows.replace(";9", ";")));
        assert!(error.contains("needs a number of readings: there is none"), "{error}");
        let error = refusal(&format!("{head}\n{}", rows.replace(";9", ";9,5")));
        assert!(error.contains("`9,5` in the column `n` is no whole number"), "{error}");
    }
}

/// A column of factors may multiply: 0.577 of a rectangle is 1/sqrt(3), 0.408 of a triangle 1/sqrt(6).
#[test]
fn factors_that_multiply_are_understood_where_they_agree() {
    let head = "Quantity,Estimate,Unit,Uncertainty,Distribution,Factor\n";
    let text = format!(
        "{head}a,1,V,0.3,rectangular,0.577\nb,1,V,0.4,normal (k=2),0.5\nc,1,V,0.6,triangular,0.408\n\
         d,1,V,0.2,U-shaped,0.707\ne,1,V,0.8,normal,0.5\nf,1,V,0.1,normal,1\n"
    );
    let (found, budget) = uncertainties(&text);
    let right = [0.3 / 3f64.sqrt(), 0.2, 0.6 / 6f64.sqrt(), 0.2 / 2f64.sqrt(), 0.4, 0.1];
    assert!(found.iter().zip(right).all(|(u, right)| (u / right - 1.0).abs() < 1e-12), "{found:?}");
    let said = "line 2: the factor `0.577` multiplies, as 1/1.733 does";
    assert!(budget.understood.iter().any(|of| of == said), "{:?}", budget.understood);
    for row in ["a,1,V,0.3,rectangular,0.5", "a,1,V,0.3,normal,0.5", "a,1,V,0.3,normal (k=2),0.577"]
    {
        let error = refusal(&format!("{head}{row}\n"));
        assert!(error.contains("is below 1: does it multiply"), "{row}: {error}");
    }
}

/// `Value` times the factor is the standard uncertainty in every row: it is no estimate.
#[test]
fn values_that_are_multiplied_are_widths() {
    let text = "Component,Value,Unit,Distribution,Factor,ci,ui\nA,0.5,mV,normal (k=2),0.5,1,0.25\n\
        B,0.3,mV,rectangular,0.577,1,0.173\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found[0], 0.25);
    assert!((found[1] - 0.3 / 3f64.sqrt()).abs() < 1e-15, "{found:?}");
    let means: Vec<f64> = task(&budget).rows[0].distributions.iter().map(|d| d.mean()).collect();
    assert_eq!(means, [0.0, 0.0]);
}

/// A formula that no program has calculated has no value; before, the quantity became certain.
#[test]
fn formulas_without_values_are_mistakes() {
    let of = |cell: &str| {
        let text = |of: &str| format!(r#"<c t="inlineStr"><is><t>{of}</t></is></c>"#);
        let row = |cells: &[&str]| {
            let cells = cells
                .iter()
                .map(|of| if of.starts_with('<') { (*of).to_owned() } else { text(of) });
            format!("<row>{}</row>", cells.collect::<String>())
        };
        let head = [
            "Quantity",
            "Estimate",
            "Unit",
            "Uncertainty",
            "Distribution",
            "Divisor",
            "Contribution",
        ];
        let computed = "<c><f>D2/F2</f><v></v></c>";
        let rows = row(&head)
            + &row(&["Cal", "<c><v>10</v></c>", "V", cell, "normal", "<c><v>2</v></c>", computed]);
        let book = crate::tests::workbook(|out| out.write_all(rows.as_bytes()), |_| Ok(()));
        import("b.xlsx", &book)
    };
    let error = of("<c><f>0.004/2</f><v></v></c>").unwrap_err().to_string();
    let part =
        "cell D2 is a formula without a stored value; open and save the workbook in a spreadsheet";
    assert!(error.contains(part), "{error}");
    // nor has one that a writer stored as 0 because it never calculates
    let error = of("<c><f>0.004/2</f><v>0</v></c>").unwrap_err().to_string();
    assert!(error.contains("cell D2 is a formula whose stored value is 0"), "{error}");
    let error = of("<c><v>&e;</v></c>").unwrap_err().to_string();
    assert!(error.contains("cell D2 holds an entity"), "{error}");
    let budget = of("<c><f>0.004/2</f><v>0.002</v></c>").unwrap();
    assert_eq!(task(&budget).rows[0].distributions[0].standard_uncertainty(), 0.001);
}

/// A blank estimate may be a correction of 0; it was one without a word.
#[test]
fn blank_estimates_are_told() {
    let head = "Quantity,Estimate,Standard uncertainty,Distribution,Sensitivity,Unit";
    let text = format!("{head}\nR,,0.1,normal,1,ohm\nd,2,0.2,normal,1,ohm\n");
    let (_, budget) = uncertainties(&text);
    assert!(
        guesses(&budget, "line 2: `R` has no estimate, and 0 is taken"),
        "{:?}",
        budget.guessed
    );
    assert!(!guesses(&budget, "`d` has no estimate"));
    // a sheet of corrections alone says so by its column
    let (_, budget) = uncertainties(&text.replace(",2,", ",,"));
    assert!(!guesses(&budget, "has no estimate"), "{:?}", budget.guessed);
}

/// `Coefficient` beside a divisor; before, the model was a plain sum: u = 0.30 mg and not
/// sqrt((0.5/2)^2 + (2*0.3/sqrt(3))^2) = 0.427 mg.
#[test]
fn coefficients_are_taken_or_asked() {
    let text = "Grandeur;Estimation;Unité;Incertitude;Loi;Diviseur;Coefficient\n\
        m_s;1000,0002;g;0,0005;normale;2;1\nd;0;g;0,0003;rectangulaire;√3;-2\nm;1000,0002;g;;;;\n";
    let (_, budget) = uncertainties(text);
    assert!(budget.text.contains("(-2"), "{}", budget.text);
    for heading in ["Facteur X", "Wichtungsfaktor", "Empfindlichkeits-K."] {
        let error = refusal(&text.replace("Coefficient", heading));
        let part = format!("the column `{heading}` may hold sensitivity coefficients");
        assert!(error.contains(&part), "{error}");
        // 1 in every row changes nothing
        let (_, budget) = uncertainties(&text.replace("Coefficient", heading).replace(";-2", ";1"));
        assert!(guesses(&budget, "is not taken"), "{:?}", budget.guessed);
    }
    // an equation says all of it
    let (_, budget) =
        uncertainties(&format!("m = m_s - 2*d\n{}", text.replace("Coeff", "X-Coeff")));
    assert!(guesses(&budget, "`X-Coefficient` is not taken"), "{:?}", budget.guessed);
}

/// Distributions under words that are not known, by what the cells say: 0.3/sqrt(3) and not 0.3.
#[test]
fn cells_that_name_distributions_are_taken() {
    for heading in ["Verteilungsfunktion", "Form", "Annahme"] {
        let text = format!("Größe;Schätzwert;Einheit;Halbbreite;{heading}\nm;1;g;0,3;Rechteck\n");
        let (found, _) = uncertainties(&text);
        assert!((found[0] - 0.3 / 3f64.sqrt()).abs() < 1e-15, "{heading} {found:?}");
    }
}

/// Numbers with both marks have one reading.
#[test]
fn grouped_numbers_with_both_marks() {
    let german = "Größe;Schätzwert;Einheit;Halbbreite;Verteilung\nm;10.000,005;g;0,3;Rechteck\n";
    let english =
        "Quantity,Estimate,Unit,Half-width,Distribution\nm,\"10,000.005\",g,0.3,rectangular\n";
    for text in [german, english] {
        let (_, budget) = uncertainties(text);
        assert_eq!(task(&budget).rows[0].distributions[0].mean(), 10_000.005, "{text}");
    }
    let error = refusal(&german.replace("0,3", "0.3"));
    assert!(error.contains("the same decimal mark"), "{error}");
}

/// Headings of uncertainties that are known by a part of them, and ones that are not.
#[test]
fn headings_that_are_not_known_are_named() {
    let text = "Quantity,Value,Unit,Resolution / half-width,Distribution\nA,10,V,0.3,rectangular\n";
    assert!((uncertainties(text).0[0] - 0.3 / 3f64.sqrt()).abs() < 1e-15);
    let text = "Quantity,Value,Unit,Std. dev.,n,Distribution,Divisor,Sens. coeff.\nA,10,V,0.3,9,normal,,1\n";
    let error = refusal(text);
    assert!(error.contains("`Std. dev.` can be the standard deviation of single"), "{error}");
    let (found, _) = uncertainties(&text.replace("normal,,", "normal,√n,"));
    assert!((found[0] - 0.1).abs() < 1e-15, "{found:?}");
    let error = refusal("Quantity,Value,Unit,Wobble,Distribution\nA,10,V,0.3,rectangular\n");
    assert!(error.contains("an uncertainty, and `Wobble` is not known"), "{error}");
}

/// Decimal commas between commas tear numbers; before, both quantities were constants without a word.
#[test]
fn rows_with_more_cells_than_the_header_are_refused() {
    let head = "Quantity,Unit,Estimate,Standard uncertainty";
    let error = refusal(&format!("{head}\na,m,10,0,25\nb,m,2,0,5\nY = a + b\n"));
    let part =
        "the row has 5 cells, the header 4, so that `25` stands below no heading; numbers with";
    assert!(error.contains(part), "{error}");
    let error = refusal(&format!("{head},Distribution\na,m,10,0,25\nb,m,2,0,5\n"));
    assert!(error.contains("the number `25` stands in the column of the distribution"), "{error}");
    let error = refusal("Quantity;Unit;Estimate;u\na;m;3;0,1;extra;cells\n");
    assert!(error.contains("the row has 6 cells, the header 4, so that `extra`"), "{error}");
    // cells that a spreadsheet pads are no headings, and sentences no rows
    for text in [
        format!("{head},,\na,m,10,0.25,,\nb,m,2,0.5,,a remark\n"),
        format!("{head}\na,m,10,0.25,,\nb,m,2,0.5\n\n\nsee the report, of 2024, page 3, and 4,5\n"),
    ] {
        assert_eq!(uncertainties(&text).0, [0.25, 0.5], "{text}");
    }
    // a constant is one, and told
    let (found, budget) = uncertainties(&format!("{head}\na,m,10,0.25\nb,m,2\nc,m,1,0.5\n"));
    assert_eq!(found, [0.25, 0.0, 0.5]);
    let part =
        "line 3: `b` has no uncertainty below `Standard uncertainty` and is taken for a constant";
    assert!(guesses(&budget, part), "{:?}", budget.guessed);
}

/// A line of symbols and units below the header, as EA-4/02 has it: 0.4 mV at k = 2 are 0.2 mV, 0.05 mV
/// over the root of 3 are 0.0289 mV. Before, they were volts, inch-volts or plain numbers without a word.
#[test]
fn a_line_of_symbols_and_units_below_the_header() {
    let head = "Größe;Schätzwert;Unsicherheit;Verteilung;Divisor;c_i;u_i(y)";
    let rows = "Normal;10,000;0,4;normal;2;1;0,2\nAuflösung;0;0,05;rect.;√3;1;0,0289\n";
    for below in [
        "X_i;x_i / V;in mV;;;;in mV",
        ";in V;in mV;;;;in mV",
        "Xi;xi / V;a / mV;;;;ui / mV",
        "Xi;xi/V;a/mV;;;;ui(y)/mV",
        "X_i;x_i [V];a [mV];;;;u_i(y) [mV]",
        "Einheit;V;mV;;;;mV",
        ";V;[mV];;;;(mV)",
        ";[in V];in [mV];;;;mV",
    ] {
        let (found, budget) = uncertainties(&format!("{head}\n{below}\n{rows}"));
        assert!((found[0] - 2e-4).abs() < 1e-15, "{below}: {found:?}");
        assert!((found[1] - 5e-5 / 3f64.sqrt()).abs() < 1e-15, "{below}: {found:?}");
        assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "V", "{below}");
        assert!(!guesses(&budget, "contributes"), "{below}: {:?}", budget.guessed);
    }
    // symbols alone
    let below = "X_i;x_i;a;;;c_i;u_i(y)";
    let (found, _) = uncertainties(&format!("{head}\n{below}\n{rows}"));
    assert_eq!(found[0], 0.2);
    for (below, part) in [
        ("Xi;xi;in foo;;;;", "line 2: `in foo` below the header is neither a unit nor a symbol"),
        ("Xi;xi;s;;;;", "line 2: `s` below the header is neither a unit"),
        ("Cable;V;mV;;;;", "line 2: `Cable` has units in place of numbers"),
    ] {
        let error = refusal(&format!("{head}\n{below}\n{rows}"));
        assert!(error.contains(part), "{below}: {error}");
    }
    let text = "Quantity;Estimate (V);Half-width (mV);Distribution\n;V;V;\na;1;2;rectangular\n";
    assert!(refusal(text).contains("line 2: `V` stands below a heading that says `mV`"));
    let (found, _) = uncertainties("Quantity;Estimate;Unit;u\na;1;in mV;2\n");
    let (of_cells, _) = uncertainties("Quantity;Estimate;u\na;1 in mV;2 in mV\n");
    assert_eq!((found[0], of_cells[0]), (2.0, 2.0));
}

/// A column of the units of uncertainties: 20 ppm of 10 V are 200 µV, at k = 2 100 µV; 5 µV over the root
/// of 3. Before, they were 20 V and 5 V.
#[test]
fn a_column_of_the_units_of_uncertainties() {
    for heading in [
        "Uncertainty unit",
        "Unc. unit",
        "Unit of uncertainty",
        "Unit (u)",
        "Unsicherheit Einheit",
        "Einheit der Unsicherheit",
    ] {
        let text = format!(
            "Quantity,Estimate,Unit,Uncertainty,{heading},Distribution,Divisor\n\
             Ref,10.000,V,20,ppm,normal,2\nOffset,0.010,V,5,µV,rect.,1.73\n"
        );
        let (found, budget) = uncertainties(&text);
        assert!((found[0] / 1e-4 - 1.0).abs() < 1e-12, "{heading}: {found:?}");
        assert!((found[1] / (5e-6 / 3f64.sqrt()) - 1.0).abs() < 1e-12, "{heading}: {found:?}");
        assert!(!guesses(&budget, "not taken"), "{heading}: {:?}", budget.guessed);
        let error = refusal(&text.replace(",5,µV", ",5 nV,µV"));
        assert!(error.contains("`5 nV` stands beside `µV`"), "{error}");
        let error = refusal(&text.replace(",µV", ",foo"));
        assert!(error.contains("the unit `foo` of the uncertainty is not known"), "{error}");
    }
    let text = "Quantity,Value,Value unit,Uncertainty,Uncertainty unit\na,10,V,5,mV\n";
    assert_eq!(uncertainties(text).0, [0.005]);
}

/// What is stated twice and differs is taken from neither place; before, it was from one of them.
#[test]
fn what_is_stated_twice_and_differs_is_refused() {
    let head = "Quantity;Estimate;Unit;u\na;3;1;0.1\nb;2;1;0.1\n";
    let twice = "`Y` is `a + b` in line 4 and `a - b` in line 5: leave one equation";
    for (rows, part) in [
        ("Y = a + b\nY = a - b\n", twice),
        ("Y = 2a + b\nY = a - b\n", "another equation of `Y` stands in line 5"),
        ("Y = a - b\nY = 2a + b\n", "another equation of `Y` stands in line 4"),
    ] {
        let error = refusal(&format!("{head}{rows}"));
        assert!(error.contains(part), "{rows}: {error}");
    }
    // repeated, of other quantities, and the statement of the result
    for line in ["Y = a+b", "Y = k*u_c", "Y = (5,0 ± 0,3) mm (k = 2)", "Y = 5 mm + d"] {
        let budget = import("b.csv", format!("{head}Y = a + b\n{line}\n").as_bytes());
        let budget = budget.unwrap_or_else(|error| panic!("{line}: {error}"));
        assert!(budget.text.contains(r#"{"Y":"a + b"}"#), "{line}: {}", budget.text);
    }
    for (head, row, part) in [
        (
            "Quantity;Estimate;Unit;u;Standard uncertainty",
            "a;3;V;0.1;0.2",
            "`a` is 0.1 below `u` and 0.2 below `Standard uncertainty`",
        ),
        (
            "Quantity;Estimate;Unit;u;Standard uncertainty",
            "a;3;V;0.2;0.1",
            "`a` is 0.2 below `u` and 0.1 below `Standard uncertainty`",
        ),
        (
            "Quantity;Estimate;Unit;±;Standard uncertainty",
            "a;3;V;0.1;0.2",
            "`a` is 0.1 below `±` and 0.2 below `Standard uncertainty`",
        ),
        (
            "Quantity;Estimate;Unit;Std. unc.;Standard uncertainty",
            "a;3;V;0.1;0.2",
            "the columns `Std. unc.` and `Standard uncertainty` may both be the standard uncertainty",
        ),
        (
            "Quantity;Estimate;Unit;±;Coverage factor;Divisor",
            "a;3;V;0.1;2;3",
            "the columns `Coverage factor` and `Divisor` may both be the divisor, and have `2` and `3`",
        ),
        (
            "Quantity;Estimate;Unit;±;Coverage factor;Divisor",
            "a;3;V;0.1;;√3",
            "and have nothing and `√3` here",
        ),
        (
            "Quantity;Estimate;Unit;Half-width;Expanded uncertainty",
            "a;3;V;;0.2",
            "may both be the stated uncertainty (+-), and have nothing and `0.2`",
        ),
    ] {
        let error = refusal(&format!("{head}\n{row}\n"));
        assert!(error.contains(part), "{head}: {error}");
    }
    // the same in both columns, and an expanded uncertainty that is k times what is taken
    for (head, row) in [
        ("Quantity;Estimate;Unit;±;Coverage factor;Divisor", "a;3;V;0.2;2;2"),
        ("Quantity;Estimate;Unit;u;Standard uncertainty", "a;3;V;0.1;0.10"),
        ("Quantity;Estimate;Unit;Uncertainty;Divisor;Expanded uncertainty", "a;3;V;0.1;1;0.2"),
    ] {
        assert_eq!(uncertainties(&format!("{head}\n{row}\n")).0, [0.1], "{head}");
    }
    let rows = "a;3;V;0.1\na;4;V;0.1\n";
    let error = refusal(&format!("Y = a\nQuantity;Estimate;Unit;u\n{rows}"));
    assert!(error.contains("the lines 3 and 4 are both called `a`, which the equation"), "{error}");
    // of a sum both are parts
    let (found, budget) = uncertainties(&format!("Quantity;Estimate;Unit;u\n{rows}"));
    assert_eq!(found, [0.1, 0.1]);
    assert!(guesses(&budget, "`a` is called `a_2`"));
}

/// A nominal value beside a measured one is no estimate, whichever comes first; two columns that may be
/// the estimate are asked.
#[test]
fn nominal_values_are_no_estimates_beside_others() {
    for head in [
        "Quantity;Nominal;Value;Unit;U;k",
        "Quantity;Nominal value;Estimate;Unit;U;k",
        "Größe;Nennwert;Messwert;Einheit;U;k",
        "Quantity;Nominal;Indication;Unit;U;k",
        "Quantity;Nominal;Measured value (ohm);Unit;U;k",
    ] {
        let (_, budget) = uncertainties(&format!("{head}\na;100;100.0135;ohm;0.010;2\n"));
        let found = task(&budget).rows[0].distributions[0].mean();
        assert_eq!(found, 100.0135, "{head}: {}", budget.text);
        assert!(guesses(&budget, "is not taken"), "{head}: {:?}", budget.guessed);
    }
    let (_, budget) =
        uncertainties("Quantity;Value;Nominal;Unit;U;k\na;100.0135;100;ohm;0.010;2\n");
    assert_eq!(task(&budget).rows[0].distributions[0].mean(), 100.0135);
    let (_, budget) = uncertainties("Quantity;Nominal;Unit;U;k\na;100;ohm;0.010;2\n");
    assert_eq!(task(&budget).rows[0].distributions[0].mean(), 100.0);
    for (head, part) in [
        ("Quantity;Estimate;Value;Unit;U;k", "the columns `Estimate` and `Value` may both be the"),
        ("Quantity;Reading;Indication;Unit;U;k", "the columns `Reading` and `Indication` may both"),
    ] {
        let error = refusal(&format!("{head}\na;100;100.0135;ohm;0.010;2\n"));
        assert!(error.contains(part), "{head}: {error}");
    }
}

/// Texts of a workbook have the marks that somebody wrote, and are decided as those of a CSV file; before,
/// 1,234 beside 1,234.5 was 1.234.
#[test]
fn marks_in_texts_of_a_workbook() {
    let of = |words: &str, cells: &[&str]| {
        let text = |of: &str| format!(r#"<c t="inlineStr"><is><t>{of}</t></is></c>"#);
        let row = |cells: &[&str]| cells.iter().map(|of| text(of)).collect::<String>();
        let head: Vec<&str> = words.split(',').collect();
        let mut rows = format!("<row>{}</row>", row(&head));
        for (number, cell) in cells.iter().enumerate() {
            let name = format!("q{number}");
            let estimate = cell.strip_prefix('#');
            let estimate = estimate.map_or_else(|| text(cell), |v| format!("<c><v>{v}</v></c>"));
            let rest = format!("{}<c><v>1</v></c>{}", text("mm"), text("normal (k=2)"));
            rows += &format!("<row>{}{estimate}{rest}</row>", text(&name));
        }
        let book = crate::tests::workbook(|out| out.write_all(rows.as_bytes()), |_| Ok(()));
        import("b.xlsx", &book)
    };
    let english = "Quantity,Estimate,Unit,Uncertainty,Distribution";
    let german = "Größe,Schätzwert,Einheit,Unsicherheit,Verteilung";
    for (words, cells, part) in [
        (english, ["1,234.5", "1,234"], "with the same decimal mark"),
        (english, ["1.234", "2.500,5"], "with the same decimal mark"),
        (english, ["1,234", "2,500.5"], "with the same decimal mark"),
        (english, ["1,234", "2,500"], "`1,234` can be `1.234` or `1234`"),
        (english, ["1,234", "#2.5"], "`1,234` can be `1.234` or `1234`"),
        (german, ["1.234", "#2500.5"], "`1.234` can be `1,234` or `1234`"),
    ] {
        let error = of(words, &cells).unwrap_err().to_string();
        assert!(error.contains(part), "{cells:?}: {error}");
    }
    for (words, cells, right) in [
        (english, ["1,234.5", "2,000.5"], [1234.5, 2000.5]),
        (english, ["1.234", "#2500.5"], [1.234, 2500.5]),
        (german, ["1,234", "2,5"], [1.234, 2.5]),
        (german, ["1.234,5", "#2.5"], [1234.5, 2.5]),
    ] {
        let budget = of(words, &cells).unwrap_or_else(|error| panic!("{cells:?} {error}"));
        let task = task(&budget);
        let found = [0, 1].map(|at| task.rows[0].distributions[at].mean());
        assert_eq!(found, right, "{cells:?}");
    }
    let error = refusal("Quantity;Estimate;Unit;u\na;1,234;V;1\nb;2,500;V;2\n");
    assert!(error.contains("`1,234` can be `1.234` or `1234`"), "{error}");
}

/// Quantities of other dimension are not added; before, volts and amperes were, with a note.
#[test]
fn equations_of_unlike_quantities_are_refused() {
    let head = "Quantity;Estimate;Unit;Standard uncertainty\n";
    for (rows, part) in [
        ("a;3;V;0.1\nb;5;A;0.1\nY = a + b\n", "`a` is a voltage"),
        ("a;3;V;0.1\nb;5;;0.1\nY = a - b\n", "`a` is a voltage"),
        (
            "T;300;K;1 K\na;20;degC;0.1 K\nY = T + a\n",
            "without which `degC` would not be converted",
        ),
    ] {
        let error = refusal(&format!("{head}{rows}"));
        assert!(error.contains(part) && error.contains("b.csv:4:1"), "{error}");
    }
    // a bare number may be in the unit of what is beside it
    let (_, budget) = uncertainties(&format!("{head}a;3;V;0.1\nY = a + 5\n"));
    assert!(budget.text.contains(r#""Y":"a + 5 [V]""#), "{}", budget.text);
    assert!(guesses(&budget, "in the unit of the quantity beside it"), "{:?}", budget.guessed);
}

/// QUAM, example A1: c = 1000 m P/V with m in mg and V in mL, where 1000 stands for mL/L. Published:
/// 1002.7 mg/L with 0.9 mg/L; before, the model gave a thousand times that.
#[test]
fn numbers_in_place_of_units_are_told_by_the_result() {
    let head = "Quantity,Estimate,Unit,Std uncertainty,Distribution\n";
    let rows = "m,100.28,mg,0.05,normal\nP,0.9999,1,0.000058,normal\nV,100.0,mL,0.07,normal\n";
    let text = format!("{head}{rows}\"c = 1000*m*P/V\",1002.7,mg/L,0.9,\n");
    let (_, budget) = uncertainties(&text);
    assert!(budget.text.contains(r#""check_units": false"#), "{}", budget.text);
    let part = "line 5: the equation has numbers in place of units: it gives the estimate 1002.7";
    assert!(guesses(&budget, part), "{:?}", budget.guessed);
    assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
    // per cent
    let text = |result: &str| {
        format!(
            "E = (m1-m2)/m2*100\nQuantity;Estimate;Unit;±;Divisor\n\
             m1;10;g;0,0004;2\nm2;9;g;0,0004;2\n{result}\n"
        )
    };
    let (_, budget) = uncertainties(&text("E;11,1;%;;"));
    assert!(budget.text.contains(r#""check_units": false"#), "{}", budget.text);
    // a power of ten that nothing explains, another estimate, and uncertainties of other rows
    for (result, part) in [
        ("E;111,1;%;;", "the estimate of the result is 111,1 %, this model 1111"),
        ("E;1311,1;%;;", "the estimate of the result is 1311,1 %, this model 1111"),
        ("E;1111,1;%;5;2", "the expanded uncertainty of the result is 5 %, this model 0.66"),
    ] {
        let error = refusal(&text(result));
        assert!(error.contains(part), "{result}: {error}");
        assert!(error.contains("b.csv:5:1") && error.contains("take this figure away"), "{error}");
    }
    // a correlation that is not taken may be why
    let text = text("E;1111,1;%;5;2") + "r(m1, m2) = 0,9;;;;\n";
    assert!(guesses(&uncertainties(&text).1, "is 5 %, this model 0.66"));
}

/// A standard uncertainty beside a divisor: below `u` it is still to be divided, unless the contributions
/// say otherwise, below words it is divided already. Each is said.
#[test]
fn standard_uncertainties_beside_divisors_are_said() {
    let text = |heading: &str| {
        format!("Quantity;Estimate;Unit;{heading};Distribution;Divisor\nRef;10;V;0,004;normal;2\n")
    };
    let (found, budget) = uncertainties(&text("u"));
    assert_eq!(found, [0.002]);
    assert!(guesses(&budget, "line 2: 0.004 below `u` is taken as still to be divided by 2"));
    let (found, budget) = uncertainties(&text("Std. unc."));
    assert_eq!(found, [0.004]);
    assert!(guesses(&budget, "line 2: 0.004 below `Std. unc.` is taken as already divided by 2"));
    for (contribution, u) in [("0,008", 0.004), ("0,004", 0.002)] {
        let text = format!(
            "Quantity;Estimate;Unit;u;Distribution;Divisor;c_i;u_i(y)\n\
             Ref;10;V;0,004;normal;2;2;{contribution}\n"
        );
        let (found, budget) = uncertainties(&text);
        assert_eq!(found, [u], "{contribution}");
        assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
    }
}

/// A t distribution has degrees of freedom; without them its factor gave a normal one.
#[test]
fn a_t_distribution_without_degrees_of_freedom_is_asked() {
    let text = |head: &str, rest: &str| {
        format!("Quantity;Estimate;Unit;{head};Distribution\nRef;10;V;{rest};t\n")
    };
    for (head, rest) in [
        ("Expanded uncertainty;Coverage factor", "0,004;2,65"),
        ("Standard uncertainty", "0,004"),
        ("Expanded uncertainty;Coverage factor;dof", "0,004;2,65;-"),
    ] {
        let error = refusal(&text(head, rest));
        assert!(error.contains("`t` has degrees of freedom, and none are stated"), "{error}");
    }
    let (found, budget) = uncertainties(&text("Expanded uncertainty;k;dof", "0,0053;2,65;5"));
    assert!((found[0] - 0.002).abs() < 1e-15 && known_dof(&budget) == [5.0]);
    let error = refusal("Quantity;Estimate;Unit;U (2 SD)\nRef;10;V;0,004\n");
    assert!(error.contains("`2 SD` in the heading `U (2 SD)` is not understood"), "{error}");
    let text = |divisor: &str| {
        format!("Quantity;Estimate;Unit;±;Distribution;Divisor\nA;1;V;0,4;normal (2 s);{divisor}\n")
    };
    assert!(refusal(&text("")).contains("`normal (2 s)`: what `s` says"));
    assert!(refusal(&text("1")).contains("`normal (2 s)`: what `s` says"));
    assert_eq!(uncertainties(&text("2")).0, [0.2]);
}

/// A stated factor goes before a probability, and a comma before a space separates: `k=2, 95 %` was 0.0295,
/// and U = 0.02 V had u = 0.678 V in place of 0.010 V.
#[test]
fn factors_beside_probabilities_and_units() {
    for (heading, cell, shape, u) in [
        ("U (k=2, 95 %)", "0.02", "", 0.01),
        ("U (k=2, 95.45 %)", "0.02", "", 0.01),
        ("Uncertainty", "0.02", "normal (k=2, 95 %)", 0.01),
        ("Uncertainty", "0.02", "normal (k=2, 95.45 %)", 0.01),
        ("Uncertainty", "0.02 V (k=2, 95 %)", "", 0.01),
        ("Uncertainty", "0.06 (k=2, 95 %)", "", 0.03),
        ("Uncertainty", "0.0258", "normal (2.58σ)", 0.01),
        ("Uncertainty (1.96 sigma)", "0.0196", "", 0.01),
        ("Uncertainty ±2σ", "0.02", "", 0.01),
        ("Uncertainty", "0.02", "normal (coverage factor 2)", 0.01),
        ("U (k=2, %)", "0.2", "", 0.01),
        ("U (k=2, mV)", "20", "", 0.01),
        ("U (mV, k=2)", "20", "", 0.01),
        ("Standard uncertainty mV", "10", "", 0.01),
        ("Standard uncertainty %", "0.1", "", 0.01),
        ("Standard uncertainty (1 sigma)", "0.01", "", 0.01),
    ] {
        for separator in [',', ';'] {
            let text = format!(
                "Quantity,Estimate,Unit,\"{heading}\",Distribution\na,10,V,\"{cell}\",\"{shape}\"\n"
            );
            let text: String = text
                .split('"')
                .enumerate()
                .map(|(at, part)| match at % 2 {
                    1 => format!("\"{part}\""),
                    _ => part.replace(',', &separator.to_string()),
                })
                .collect();
            let (found, _) = uncertainties(&text);
            // a few roundings of conversions and divisors
            assert!((found[0] / u - 1.0).abs() < 1e-12, "{heading} {cell} {shape}: {found:?}");
        }
    }
    let (found, budget) = uncertainties(
        "Größe;Schätzwert;Einheit;Erweiterte Messunsicherheit (k=2, 95 %)\na;10,5;V;0,02\n",
    );
    assert_eq!(found, [0.01], "{:?}", budget.guessed);
    for (heading, cell, shape, part) in [
        ("U (k=2,95 %)", "0.02", "", "can say k = 2 and `95 %`, or k = 2.95"),
        ("Uncertainty", "0.02", "normal (k=2,95 %)", "can say k = 2 and `95 %`, or k = 2.95"),
        (
            "Std. unc. (k=2)",
            "0.02",
            "",
            "can be a standard uncertainty, or an expanded one of k = 2",
        ),
        (
            "Standard uncertainty",
            "0.02 V (k=2)",
            "",
            "can be a standard uncertainty, or an expanded",
        ),
        (
            "Uncertainty (rectangular)",
            "0.02",
            "",
            "the distribution `rectangular` is read in a column",
        ),
        ("Uncertainty (mV rms)", "20", "", "`mV rms` in the heading"),
        ("Uncertainty x 1000", "20", "", "`x 1000` in the heading"),
        ("Half-width", "0.02", "", "`Half-width` is no standard uncertainty"),
        ("Tolerance", "0.02", "", "`Tolerance` is no standard uncertainty"),
        ("Half-width a", "0.02", "", "`Half-width a` is no standard uncertainty"),
        ("U (k=2.13, dof=9)", "0.02", "", "degrees of freedom are read in a column `dof`"),
        ("Uncertainty", "0.02", "rectangular (50 % rh)", "what `%` says of the uncertainty"),
    ] {
        let error = refusal(&format!(
            "Quantity,Estimate,Unit,\"{heading}\",Distribution\na,10,V,{cell},\"{shape}\"\n"
        ));
        assert!(error.contains(part), "{heading} {shape}: {error}");
    }
    let (_, budget) = uncertainties(
        "Quantity,Estimate,Unit,Uncertainty,Distribution\na,10,V,0.0228,normal (k=2.28; dof=10)\n",
    );
    assert_eq!(known_dof(&budget), [10.0]);
    let error = refusal(
        "Quantity,Estimate,Unit,Uncertainty,Coverage probability,dof\na,10,V,0.02,95 %,9\n",
    );
    assert!(error.contains("the column `Coverage probability` is not read"), "{error}");
}

/// `20.00(6) V` is 20.00 V with u = 0.06 V; the unit was `(6) V`.
#[test]
fn uncertainties_in_the_last_digits_of_estimates() {
    let text = "Quantity,Estimate,Standard uncertainty\na,20.00(6) V,0.06 V\nb,0.50(3) V,\n";
    let (found, budget) = uncertainties(text);
    // two roundings
    assert!((found[0] - 0.06).abs() < 1e-15 && (found[1] - 0.03).abs() < 1e-15, "{found:?}");
    let means: Vec<f64> = task(&budget).rows[0].distributions.iter().map(|d| d.mean()).collect();
    assert_eq!(
        (means, task(&budget).model.outputs[0].quantity.unit.text()),
        (vec![20.0, 0.5], "V")
    );
    let error = refusal(&text.replace(",0.06 V", ",0.03 V"));
    assert!(
        error.contains("`20.00(6) V` says the standard uncertainty 0.06, the row 0.03"),
        "{error}"
    );
}

/// The first quantity of which nothing can be read was taken for a line of symbols, and was gone.
#[test]
fn the_first_row_is_no_line_of_symbols() {
    let text = |first: &str| format!("Quantity,Value,Uncertainty\n{first}\nb,2.0 V,0.1 V\n");
    for first in ["a,≈20 V,≈1 V", "a,see cert,see cert", "a,#REF!,#REF!", "a,TBD,TBD"] {
        let error = refusal(&text(first));
        assert!(error.contains("is no number") && error.contains("b.csv:2:1"), "{first}: {error}");
    }
    for cell in [
        "(20.00 ± 0.06) V",
        "(20.00 ± 0.06) V (k=2)",
        "≈20 V ± 0.06 V",
        "V ± 0.06 V",
        "[19.94, 20.06] V",
    ] {
        let text = format!("Quantity,Estimate,c_i\na,\"{cell}\",1\nb,0.50 V ± 0.03 V (k=2),1\n");
        let error = refusal(&text);
        assert!(error.contains("is no number") && error.contains("b.csv:2:1"), "{cell}: {error}");
    }
    // symbols are no row, whatever stands before them
    let (found, _) = uncertainties("Quantity,Estimate,Standard uncertainty\nX,x,u(x)\na,20,0.1\n");
    assert_eq!(found, [0.1]);
    for line in [",mm,\"µm, k=2\"", ",mm,(µm) k=2"] {
        let error = refusal(&format!("Quantity,Estimate,Uncertainty\n{line}\na,20,1\n"));
        assert!(error.contains("below the header is neither a unit nor"), "{line}: {error}");
    }
}

/// 0.1 and 0.1 make 0.1414, which is printed as 0.14.
#[test]
fn a_result_of_two_digits_is_no_input() {
    for (head, rows) in [
        ("", ["a,6.0,mm,0.10", "b,2.0,mm,0.10", "y,8.0,mm,0.14"]),
        (",c_i", ["a,6.0,mm,0.10,1", "b,2.0,mm,0.10,-1", "y,4.0,mm,0.14,"]),
        (
            ",Distribution,c_i",
            ["a,6.0,mm,0.10,normal,1", "b,2.0,mm,0.10,normal,-1", "y,4.0,mm,0.14,normal,"],
        ),
    ] {
        let text =
            format!("Quantity,Estimate,Unit,Standard uncertainty{head}\n{}\n", rows.join("\n"));
        let (found, budget) = uncertainties(&text);
        assert_eq!(found, [0.1, 0.1], "{}", budget.text);
        assert_eq!(task(&budget).model.outputs[0].quantity.name, "y");
    }
}

/// Between commas an equation with a decimal comma is several cells; it was cut off, or the sum was taken.
#[test]
fn equations_in_several_cells_are_refused() {
    let head = "Quantity,Estimate,Unit,Uncertainty,Distribution,Divisor\n\
        x,10,,0.1,normal,2\nz,4,,0.1,normal,2\n";
    for (equation, whole) in [
        ("y = x - 0,5*z", "y = x - 0.5*z"),
        ("y = 1,5*x", "y = 1.5*x"),
        ("y = 1,5*x + 2,5*z", "y = 1.5*x"),
        ("y = x - 0,5 z", "y = x - 0.5 z"),
        ("y = 2,5x", "y = 2.5x"),
        ("Model: y = x - 0,5*z", "y = x - 0.5*z"),
        ("Equation,y = x - 0,5*z", "y = x - 0.5*z"),
        ("y = max(x,z)", "y = max(x,z)"),
        ("y = x - 0,5*z,V,2020", "y = x - 0.5*z"),
    ] {
        for text in [format!("{equation}\n{head}"), format!("{head}\n{equation}\n")] {
            let error = refusal(&text);
            assert!(error.contains("quotation marks"), "{equation}: {error}");
            assert!(error.contains(&format!("`\"{whole}")), "{equation}: {error}");
        }
    }
    // with coefficients as well
    let with = "Quantity,Estimate,Uncertainty,Sensitivity coefficient\nx,10,0.1,1\nz,4,0.1,1\n";
    assert!(refusal(&format!("y = x - 0,5*z\n{with}")).contains("quotation marks"));
    // cells beside an equation
    for equation in [
        "\"y = x - 0.5*z\",5*z",
        "y = x - 0.5*z,V",
        "y = x - 0.5*z, 2020",
        "y = x - 0.5*z,see x",
        "Equation,y = x - 0.5*z,,12",
        "n = 10,5 V,y = x - 0.5*z",
        "y = x - 0.5*z,\"T = 20,5 °C\"",
    ] {
        let text = format!("{equation}\n{head}");
        let budget = import("b.csv", text.as_bytes()).unwrap_or_else(|e| panic!("{equation}: {e}"));
        assert!(budget.text.contains(r#""y":"x - 0.5*z""#), "{equation}: {}", budget.text);
    }
    // digits of a name, and a separator that is no decimal mark
    let named = head.replace("\nz,", "\nx1,");
    for text in [format!("y = x - x1,2020\n{named}"), format!("y = x - x1/2.5,12\n{named}")] {
        assert!(import("b.csv", text.as_bytes()).is_ok(), "{text}");
    }
    let text = format!("y = x - z/2;12\n{}", head.replace(',', ";"));
    let budget = import("b.csv", text.as_bytes()).unwrap();
    assert!(budget.text.contains(r#""y":"x - z/2""#), "{}", budget.text);
    // a statement of the result, which would be a row, and one beside the table
    for line in ["y = 14,05", "U = 2*0,05", "y = 14,0 V", "T = 20,5 °C"] {
        let error = refusal(&format!("{head}\n{line}\n"));
        assert!(error.contains("one number or two cells"), "{line}: {error}");
        let budget = import("b.csv", format!("{line}\n{head}").as_bytes());
        let budget = budget.unwrap_or_else(|e| panic!("{line}: {e}"));
        assert!(budget.text.contains(r#""y":"x + z""#), "{line}: {}", budget.text);
    }
}

/// The last digits of a number are those before its power of ten.
#[test]
fn uncertainties_in_parentheses_before_a_power_of_ten() {
    for cell in ["1.5(3)e-3 V", "1.5(3)×10^-3 V", "1.5(3) × 10⁻³ V", "1.5(3)·10⁻³ V"] {
        let (found, budget) = uncertainties(&format!(
            "Quantity,Estimate,Standard uncertainty\nx,{cell},\nz,1 V,0.1 V\n"
        ));
        assert_eq!(found, [0.0003, 0.1], "{cell} {}", budget.text);
        assert_eq!(task(&budget).rows[0].distributions[0].mean(), 0.0015, "{cell}");
    }
}

/// A formula that gives nothing a name; the sum was taken in its place.
#[test]
fn equations_without_a_name_are_refused() {
    let head = "Quantity;Estimate;Unit;Standard uncertainty\na;6.0;1;0.1\nb;2.0;1;0.1\n";
    for (equation, why) in [
        ("=a*b", "its left side is no name; write `y = a*b`"),
        ("= a/b", "its left side is no name; write `y = a/b`"),
        ("2*y = a*b", "its left side is no name"),
        ("2y = a*b", "its left side is no name"),
        ("Equation;a*b", "it has no `=`; write `y = a*b`"),
    ] {
        let error = refusal(&format!("{equation}\n{head}"));
        assert!(error.contains("cannot be read as an equation"), "{equation}: {error}");
        assert!(error.contains(why), "{equation}: {error}");
    }
    for line in ["=B2*C2", "=1", "Model;Fluke 8508A", "Model;c/d", "=", "Equation;12"] {
        let text = format!("{line}\n{head}");
        let budget = import("b.csv", text.as_bytes()).unwrap_or_else(|e| panic!("{line}: {e}"));
        assert!(budget.text.contains(r#""y":"a + b""#), "{line}: {}", budget.text);
    }
}

/// Equations in signs that are not known; the sum was taken in their place. Statements of uncertainties are
/// computed here.
#[test]
fn equations_that_cannot_be_read_are_refused() {
    let head = "Quantity;Estimate;Unit;Standard uncertainty\na;6.0;1;0.1\nb;2.0;1;0.1\n";
    for equation in ["y = a x b", "y = a : b", "y = \\frac{a}{b}", "y = Σ x_i", "y = a b"] {
        let error = refusal(&format!("{equation}\n{head}"));
        assert!(error.contains("cannot be read as an equation"), "{equation}: {error}");
    }
    for line in [
        "U = k*uc",
        "u(y) = sqrt(u(a)^2+u(b)^2)",
        "u_c = sqrt(u1^2 + u2^2)",
        "Date = 12 May 2026",
        "Lab = PTB Berlin",
    ] {
        let (_, budget) = uncertainties(&format!("{line}\n{head}"));
        assert!(budget.text.contains("a + b"), "{line}: {}", budget.text);
    }
    // a voltage
    let (_, budget) = uncertainties(&format!("U = a*b\n{head}"));
    assert!(budget.text.contains(r#""U":"a*b""#), "{}", budget.text);
    let chain: String = (1..3000).map(|n| format!("z{n} = z{} + a\n", n - 1)).collect();
    let known: Vec<String> = vec!["a".to_owned(), "b".to_owned()];
    let (cells, _) = grid::of_text(format!("z0 = a\n{chain}{head}").as_bytes()).unwrap();
    let found = Equations::of(&cells).of_result(&known).unwrap();
    assert_eq!(found.read.len(), 3000);
}

/// Contributions of which one is a thousand times the other's: 6 µm and 3 µm made 3.00 mm.
#[test]
fn contributions_that_contradict_each_other_are_refused() {
    let text = "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity coefficient,Contribution\n\
        a,20,mm,0.006,1,6\nb,0,µm,3,1,3\n";
    let error = refusal(text);
    assert!(error.contains("`a` is 1000 times that of this model in `mm`"), "{error}");
    let (_, budget) = uncertainties(&text.replace("Contribution", "Contribution (µm)"));
    assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
    // the row of the result without numbers has its unit
    let (_, budget) =
        uncertainties("Quantity,Estimate,Unit,Standard uncertainty\na,20,mm,0.006\ny,,nm,\n");
    assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "nm");
}

/// Figures of the result that are no uncertainties, types of evaluations, numbers of readings.
#[test]
fn what_stands_beside_the_uncertainties() {
    let (found, budget) = uncertainties(
        "Quantity,Estimate,Unit,Standard uncertainty,Type\na,6.0,mm,0.1,A\nb,2.0,mm,0.1,B\n\
         Combined standard uncertainty,,mm,0.141,\nCoverage factor k,,,2.05,\n\
         Effective degrees of freedom,,,50,\n",
    );
    assert_eq!(found, [0.1, 0.1]);
    assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
    let types: Vec<_> = task(&budget).variables.iter().map(|of| of.evaluation).collect();
    use gumption_engine::distribution::EvaluationType;
    assert_eq!(types, [EvaluationType::A, EvaluationType::B]);
    let (_, budget) = uncertainties(
        "Quantity;Estimate;Unit;Standard deviation;Divisor;n\nR;10;V;0,3;√n;9\nC;1;V;0,2;1;\n",
    );
    assert_eq!(known_dof(&budget), [8.0, f64::INFINITY]);
    for row in ["t,20,°C,2 %", "G,10,dB,2 %"] {
        let error = refusal(&format!("Quantity,Estimate,Unit,Standard uncertainty\n{row}\n"));
        assert!(error.contains("it is not clear what the share is of"), "{error}");
    }
    let error = refusal("Quantity,Estimate,Unit,Standard uncertainty\na,20,V,\"2\nb,1,V,3\n");
    assert!(error.contains("line 2: a cell that begins with a quote has no quote"), "{error}");
    let long = "x".repeat(10_000);
    let error = refusal(&format!("Quantity,Estimate,Unit,Standard uncertainty\na,{long},V,2\n"));
    assert!(error.len() < 2_000, "{}", error.len());
    let error = import("b.ods", b"PK").unwrap_err().to_string();
    assert!(error.contains("a workbook of the format .ods, which is not read here"), "{error}");
}

/// A merged cell of numbers counted for its first row alone, and raised digits were part of the number.
#[test]
fn merged_numbers_and_raised_digits_are_refused() {
    let of = |cell: &str, merged: &str| {
        let text = |of: &str| format!(r#"<c t="inlineStr"><is><t>{of}</t></is></c>"#);
        let row = |cells: &str| format!("<row>{cells}</row>");
        let head: String =
            ["Quantity", "Estimate", "Unit", "Standard uncertainty"].map(text).concat();
        let first = text("a") + "<c><v>10</v></c>" + &text("V") + cell;
        let second = text("b") + "<c><v>10</v></c>" + &text("V") + "<c/>";
        let rows = row(&head) + &row(&first) + &row(&second);
        let rows = format!("{rows}</sheetData>{merged}<sheetData>");
        let book = crate::tests::workbook(|out| out.write_all(rows.as_bytes()), |_| Ok(()));
        import("b.xlsx", &book).map_err(|error| error.to_string())
    };
    let merged = r#"<mergeCells><mergeCell ref="D2:D3"/></mergeCells>"#;
    let error = of("<c><v>0.02</v></c>", merged).unwrap_err();
    assert!(
        error.contains("the merged cell `0.02` below `Standard uncertainty` spans lines 2 to 3"),
        "{error}"
    );
    assert!(of("<c><v>0.02</v></c>", "").is_ok());
    let raised = r#"<c t="inlineStr"><is><r><t>10</t></r><r><rPr><vertAlign val="superscript"/></rPr><t>3</t></r></is></c>"#;
    let error = of(raised, "").unwrap_err();
    assert!(error.contains("cell D2 holds `10` with a raised `3`"), "{error}");
}

/// `10.1` that a spreadsheet has turned into 10 January 2026, day 46032; and per cent beside ppm.
#[test]
fn dates_and_shares_of_shares_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.xlsx");
    let header: &[&str] =
        &["Quantity", "Estimate", "Unit", "Standard uncertainty", "Sensitivity coefficient"];
    for (row, said) in [
        (["R1", "1:46032", "ohm", "0.1", "1"], "cell B2 is a date (2026-01-10), not a number"),
        (["R1", "10", "ohm", "1:46032", "1"], "cell D2 is a date (2026-01-10), not a number"),
        (["R1", "50", "ppm", "4 %", "1"], "can be a share of the value, or be counted"),
    ] {
        let rows: [&[&str]; 3] = [header, &row, &["R2", "5", "ohm", "0.1", "1"]];
        std::fs::write(&path, crate::tests::styled(&rows)).unwrap();
        let found = import_budget(&path).unwrap_err().to_string();
        assert!(found.contains(said), "{found}");
    }
}

/// Weak words head the estimates where no other column does; an equation that needs estimates is refused
/// without them.
#[test]
fn estimates_under_weak_words() {
    for heading in [
        "x",
        "X",
        "xi",
        "x_i",
        "x / V",
        "x_i / V",
        "Average",
        "Est.",
        "Result",
        "Amount",
        "Central value",
        "x (V)",
    ] {
        let text = format!(
            "P = V*V2/R\nQuantity,{heading},Unit,Standard uncertainty\nV,10.0,V,0.01\nV2,2.0,V,0.002\n\
             R,1,V,0\n"
        );
        let (_, budget) = uncertainties(&text);
        let found = task(&budget);
        let of: Vec<f64> = found.rows[0].distributions.iter().map(|d| d.mean()).collect();
        assert_eq!(of, [10.0, 2.0, 1.0], "{heading}");
    }
    let text = "P = V*I\nQuantity,Foo,Unit,Standard uncertainty\nV,10.0,V,0.01\nI,2.0,A,0.002\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("has the column `Foo` them?"), "{error}");
    // a sum of corrections has its uncertainty without estimates
    let text =
        "E = a - (b + c)/2\nQuantity,Unit,Standard uncertainty\na,V,0.01\nb,V,0.002\nc,V,0.003\n";
    assert_eq!(uncertainties(text).0, [0.01, 0.002, 0.003]);
}

/// Contributions are compared under every heading in use, with the name of the measurand in place of `y`
/// and with a unit wherever it stands; EA-4/02 and UKAS M3003 have such ones.
#[test]
fn contributions_under_their_symbols() {
    for heading in [
        "ui(y) mg",
        "ui(y) (mg)",
        "ui(Wx) mg",
        "ui(Wx) (mg)",
        "ui(Wx)",
        "u_i mg",
        "ui/mg",
        "ui / mg",
        "u_i(y) / mg",
        "u(y) in mg",
        "|ci|u(xi) (mg)",
    ] {
        let sheet = |combined: &str| {
            format!(
                "Symbol,Source of uncertainty,Value +/- mg,Probability distribution,Divisor,ci,{heading},vi or \
                 veff\nWS,Cal,27.0,Normal,2,1.0,13.50,inf\nDS,Drift,30.0,Rectangular,1.732,1.0,17.32,inf\n\
                 u(WX),Combined standard uncertainty,,Normal,,,{combined},>500\n"
            )
        };
        let (found, _) = uncertainties(&sheet("21.96"));
        assert_eq!(found[0], 13.5, "{heading}");
        let error = import("b.csv", sheet("34.5").as_bytes()).unwrap_err().to_string();
        assert!(error.contains("of the result is 34.5"), "{heading}: {error}");
    }
    for (heading, cell, u) in
        [("u / mm", "0.01", 0.01), ("U / mm", "0.02", 0.01), ("u/µm", "10", 0.01)]
    {
        let text = format!("Quantity,Estimate / mm,{heading}\nA,5,{cell}\n");
        let (found, _) = uncertainties(&text);
        // a rounding of a conversion
        assert!((found[0] / u - 1.0).abs() < 1e-12, "{heading}: {found:?}");
    }
    let text =
        "Quantity,Estimate,Unit,Distribution,Divisor,U,ci,ui(rel)\nA,5,mm,normal,2,0.02,1,0.01\n";
    assert!(import("b.csv", text.as_bytes()).is_err());
}

/// A last row that is the difference of the others with their combined uncertainty is the result, and what
/// could be a sum or a difference is refused with both.
#[test]
fn results_that_are_differences() {
    let sheet = |unit: &str, rows: &str| {
        format!("Quantity,Reading,Unit,U (k=2)\n{}", rows.replace('@', unit))
    };
    let volts = sheet(
        "V",
        "Indication,10.002,@,0.002\nReference,10.000,@,0.001\nError of indication,0.002,@,0.0022\n",
    );
    let (_, budget) = uncertainties(&volts);
    assert!(budget.text.contains("\"Indication + (-1)*Reference\""), "{}", budget.text);
    assert!(guesses(&budget, "with the sign of `Reference` turned"));
    // a difference of temperatures counts from no zero
    let degrees = "Indication,100.3,@,0.02\nReference,100.0,@,0.01\nError,0.3,@,0.022\n";
    let (_, budget) = uncertainties(&sheet("°C", degrees));
    assert!(budget.text.contains("\"Error\":{\"unit\":\"K\"}"), "{}", budget.text);
    for (text, said) in [
        (volts.replace("0.0022", "0.005"), "can be the result or a quantity that is added"),
        (
            sheet("°C", "Reference,100.0,@,0.01\nIndication,100.3,@,0.02\n"),
            "can be the sum of `Indication` and `Reference`, 200.3 °C, or their difference, 0.3 K",
        ),
        (sheet("°C", "inlet,20,@,0.01\noutlet,25,@,0.02\n"), "or their difference, -5 K"),
        (
            sheet("mV", "DUT reading,10.3,@,0.02\nRef.,10.3,@,0.01\nError,0.0,@,0.022\n"),
            "can be the sum of `DUT_reading` and `Ref`, 20.6 mV, or their difference, 0 mV",
        ),
    ] {
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
    }
    // what corrects a temperature is small, and coefficients say what is meant
    for text in [
        sheet("°C", "t,20.3,@,0.02\ncorrection,0.2,@,0.01\n"),
        "Quantity,Reading,Unit,U (k=2),c\nIndication,9,V,0.02,1\nReference,9,V,0.01,-1\n"
            .to_owned(),
    ] {
        assert_eq!(uncertainties(&text).0, [0.01, 0.005], "{text}");
    }
}

/// A coefficient that a power of ten brings to the sheet's own estimate is in another unit, and no constant
/// is added: both readings are told.
#[test]
fn coefficients_in_other_units_than_the_result() {
    let length = "Quantity,Estimate,Unit,u,c\nL_s,100.0002,mm,0.00005,1\ndT,0.5,°C,0.1,1.15\n\
                  L,100.000775,mm,,\n";
    for (text, said) in [
        (
            length.to_owned(),
            "the coefficient 1.15 of `dT` can be 1.15 mm/K, with which the constant -0.574425 is added to make \
             the sheet's estimate 100.000775, or 0.00115 mm/K, with which there is none",
        ),
        (
            "Quantity,Estimate,Unit,u,c\nm,100,g,0.02,9.81\nForce,0.981,N,,\n".to_owned(),
            "can be 9.81 N/g, with which the constant -980.019 is added to make the sheet's estimate 0.981, or \
             0.00981 N/g",
        ),
        // two coefficients in µm
        (
            length.replace("L,100.000775", "a,2,K,0.1,0.5\nL,100.001775"),
            "with which there is none, and of `a` as well",
        ),
    ] {
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(said), "{text}: {error}");
    }
    // the unit of the coefficients tells
    let stated = length
        .replace("u,c\n", "u,c,Unit of c\n")
        .replace(",1\n", ",1,1\n")
        .replace(",1.15\n", ",1.15,µm/K\n")
        .replace(",,\n", ",,,\n");
    let budget = import("b.csv", stated.as_bytes()).unwrap();
    assert!(budget.text.contains("L_s + (0.00115)*dT"), "{}", budget.text);
    // derivatives of a product and of a quotient leave a constant
    for text in [
        "Quantity,Estimate,Unit,u,c\nV,10,V,0.01,2\nI,2,A,0.002,10\nP,20,W,,\n",
        "Quantity,Estimate,Unit,u,c\nV,10,V,0.01,100\nI,0.01,A,0.00002,-100000\nR,1000,ohm,,\n",
    ] {
        assert!(import("b.csv", text.as_bytes()).is_ok(), "{text}");
    }
}

/// A number where a unit should stand is the next cell of a row that lacks one, and no unit.
#[test]
fn numbers_are_no_units() {
    let text = "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity\na,10,0.1,1\nb,5,0.2,2\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(
        error.contains(
            "the number `0.1` stands in the column of the unit: the row has 4 cells, the header 5"
        ),
        "{error}"
    );
    let text = "Quantity,Estimate,Unit,Standard uncertainty\na,10,1,0.1\nb,5,2,0.2\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(
        error.contains("the number `2` stands in the column of the unit: write the unit"),
        "{error}"
    );
    let text = "Quantity;Estimate;Unit;u;c;Unit of c\na;10;V;0,1;2,5\nb;5;V;0,1;1;3\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("column of the unit of the sensitivity coefficient"), "{error}");
    // empty cells at the end may be left out
    let text = "Quantity,Estimate,Unit,Standard uncertainty,Sensitivity\na,10,1,0.1\nb,5,%,0.2,2\n";
    let (_, budget) = uncertainties(&text.replace(",2\n", "\n"));
    assert!(guesses(&budget, "`a` without a unit is converted to %"), "{:?}", budget.guessed);
}

/// A divisor of a full width is no reason to take a normal distribution, nor is one with few digits.
#[test]
fn divisors_of_full_widths_and_with_few_digits() {
    for (shape, divisor, half, root) in [
        ("rectangular", "2√3", 0.05, 3.0),
        ("rectangular", "√12", 0.05, 3.0),
        ("rectangular", "3.46", 0.05, 3.0),
        ("rectangular", "3.464", 0.05, 3.0),
        ("rectangular", "3.5", 0.05, 3.0),
        ("rectangular", "1.7", 0.1, 3.0),
        ("rectangular", "1.73", 0.1, 3.0),
        ("rectangular", "1.732", 0.1, 3.0),
        ("triangular", "2.4", 0.1, 6.0),
        ("triangular", "2.45", 0.1, 6.0),
        ("triangular", "4.9", 0.05, 6.0),
        ("U-shaped", "1.4", 0.1, 2.0),
    ] {
        for heading in ["Uncertainty", "Half-width"] {
            let text = format!(
                "Quantity,Estimate,Unit,{heading},Distribution,Divisor\nres,10,V,0.1,{shape},{divisor}\n"
            );
            let (found, budget) = uncertainties(&text);
            // a rounding of a root
            assert!((found[0] / (half / f64::sqrt(root)) - 1.0).abs() < 1e-12, "{text}: {found:?}");
            assert!(!budget.text.contains("normal"), "{text}: {}", budget.text);
            assert_eq!(
                guesses(&budget, "is that of a full width"),
                half == 0.05 && heading != "Uncertainty"
            );
        }
    }
    let text =
        "Quantity,Estimate,Unit,Uncertainty,Distribution,Factor\nres,10,V,0.1,rectangular,0.289\n";
    assert!((uncertainties(text).0[0] / 0.0288675 - 1.0).abs() < 1e-5);
    // a whole number is another factor
    let text =
        "Quantity,Estimate,Unit,Uncertainty,Distribution,Divisor\nres,10,V,0.1,rectangular,2\n";
    assert_eq!(uncertainties(text).0, [0.05]);
}

/// A combined standard uncertainty below half-widths is compared as one below `u` is.
#[test]
fn combined_uncertainties_below_half_widths_are_compared() {
    let text = "Quantity,Estimate,Unit,Half-width,Distribution,Divisor\na,1,V,0.1,normal,1\n\
        b,2,V,0.1,rectangular,√3\nCombined standard uncertainty,,V,0.900,,\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("the standard uncertainty of the result is 0.900 V"), "{error}");
    // 0.1 sqrt(1 + 1/3)
    let (_, budget) = uncertainties(&text.replace("0.900", "0.115"));
    assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
}

/// Ratios beside plain numbers are shares or counted as they are, and a unit of the uncertainty alone is
/// told.
#[test]
fn units_of_uncertainties_beside_plain_numbers() {
    for text in [
        "Quantity,Estimate,Unit,Uncertainty,Divisor\nr,1.0000105,1,0.07 µΩ/Ω,1\n",
        "Quantity,Estimate,Unit,Standard uncertainty (µV/V)\na,1.00002,1,3\n",
        "Quantity,Estimate,Standard uncertainty\na,1.00002,3 µmol/mol\n",
    ] {
        let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("can be a share of the value"), "{error}");
    }
    let text = "Quantity,Estimate,Unit,Uncertainty,Divisor\nr,0.85,1,5 mm,1\n";
    let error = import("b.csv", text.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("`5 mm` is in `mm`, but the unit of this row is `1`"), "{error}");
    let (_, budget) = uncertainties("Quantity,Estimate,Standard uncertainty (um)\nd,25.0001,0.3\n");
    assert!(guesses(&budget, "the estimate 25.0001 has no unit"), "{:?}", budget.guessed);
}
