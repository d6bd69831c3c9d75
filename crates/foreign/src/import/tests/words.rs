//! Words of headings, titles, names and cells as laboratories write them.

use super::{guesses, import, refusal, task, uncertainties};

/// The unit of all values was dropped: 10.7 mV was 10.7.
#[test]
fn titles_state_the_unit_of_all_values() {
    for (title, words) in [
        ("Budget (all values in mV)", "Quantity;Estimate;Standard uncertainty;c"),
        ("alle Werte in mV", "Größe;Schätzwert;Standardunsicherheit;Sensitivitätskoeffizient"),
        ("Toutes les valeurs sont exprimées en mV", "Grandeur;Estimation;Incertitude-type;c"),
        ("Unit;mV", "Quantity;Estimate;Standard uncertainty;c"),
    ] {
        let text = format!("{title}\n\n{words}\nA;10,5;0,1;1\nB;0,2;0,05;1\n");
        let (found, budget) = uncertainties(&text);
        assert!(found == [0.1, 0.05], "{title}: {found:?}");
        assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "mV", "{title}");
    }
    let head = "Quantity;Estimate;Unit;Standard uncertainty\nA;10,5;V;0,1\n";
    for (title, head, part) in [
        ("All values in mV", head, "`All values in mV` says `mV`, and the table `V`"),
        (
            "All values in mV",
            "Quantity;Estimate (V);Standard uncertainty\nA;10,5;0,1\n",
            "says `mV`, and the table `V`",
        ),
        (
            "All values in mVrms",
            "Quantity;Estimate;Standard uncertainty\nA;10,5;0,1\n",
            "`mVrms` is no unit that is known",
        ),
    ] {
        let error = refusal(&format!("{title}\n{head}"));
        assert!(error.contains(part), "{title}: {error}");
    }
}

/// Headings for which no budget was found.
#[test]
fn headings_of_lists_of_contributions() {
    // numbered contributions, whose values are what is divided
    let text = "No.,Contribution,Type,Value,Unit,Dist.,Div.,ci,ui,vi\n1,Calibration,B,0.10,mV,normal,2,1,0.05,inf\n\
                2,Resolution,B,0.05,mV,rectangular,1.732,1,0.0289,inf\n3,Repeatability,A,0.03,mV,normal,1,1,0.03,9\n";
    let (found, budget) = uncertainties(text);
    let wanted = [0.05, 0.05 / 3f64.sqrt(), 0.03];
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
    }
    assert_eq!(task(&budget).rows[0].distributions[2].dof(), 9.0);
    let text = "Influence;Wert;Einheit;a (±);Verteilung\nNormal;100;mm;0,002;Rechteck\n";
    assert!((uncertainties(text).0[0] - 2e-3 / 3f64.sqrt()).abs() < 1e-15);
    let text = "X,x,u(x),c,u(y)\nA,10.5,0.1,2,0.2\nB,3.2,0.05,1,0.05\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found, [0.1, 0.05]);
    assert_eq!(task(&budget).rows[0].distributions[0].mean(), 10.5);
    assert!(budget.text.contains("(2)*A + B"), "{}", budget.text);
}

/// Headings of uncertainties that were not known.
#[test]
fn headings_of_uncertainties() {
    let of = |heading: &str, shape: &str| {
        uncertainties(&format!(
            "Quantity,Estimate,Unit,{heading},Distribution\nA,10,V,0.1,{shape}\n"
        ))
    };
    assert_eq!(of("Expanded U", "normal").0, [0.05]);
    assert!(guesses(&of("Expanded U", "normal").1, "k = 2 is taken"));
    assert_eq!(of("Expanded U (k=3)", "normal").0, [0.1 / 3.0]);
    assert!((of("Error limits", "rectangular").0[0] - 0.1 / 3f64.sqrt()).abs() < 1e-16);
    for heading in ["SD", "s", "s / V", "Standard deviation"] {
        let (found, budget) = of(heading, "normal");
        assert_eq!(found, [0.1], "{heading}");
        assert!(guesses(&budget, "where it is of single readings, divide it"), "{heading}");
    }
    let error = refusal("Quantity,Estimate,Unit,Error limits\nA,10,V,0.1\n");
    assert!(error.contains("name the distribution of `A`"), "{error}");
    let error = refusal("Quantity,Estimate,Unit,SD,n\nA,10,V,0.1,10\n");
    assert!(error.contains("can be the standard deviation of single readings"), "{error}");
}

/// Words and bounds in the place of uncertainties.
#[test]
fn negligible_contributions_and_bounds() {
    let of = |cell: &str| {
        format!(
            "Quantity;Estimate;Unit;Half-width;Distribution\nA;10,5;mV;0,1;rectangular\n\
             Stability;0;mV;{cell};rectangular\n"
        )
    };
    for cell in ["negligible", "vernachlässigbar", "négligeable", "(negl.)"] {
        let (found, budget) = uncertainties(&of(cell));
        assert_eq!(found[1], 0.0, "{cell}");
        let part = format!("the sheet calls the uncertainty of `Stability` `{cell}`: 0 is taken");
        assert!(guesses(&budget, &part), "{:?}", budget.guessed);
    }
    for cell in ["<0.01", "≤0,01", "< 0,01 mV"] {
        let error = refusal(&of(cell));
        assert!(error.contains("but a bound: write 0") && error.contains("b.csv:3:1"), "{error}");
    }
    let error = refusal(&of("ca. 0,01"));
    assert!(error.contains("write 0,01 where that is what counts"), "{error}");
}

/// A unit behind a name is that of its numbers, or contradicts their column; letters of types are none.
#[test]
fn units_behind_names() {
    let error = refusal("Quantity,Estimate,Unit,Standard uncertainty\nA (mV),10.5,V,0.1\n");
    assert!(error.contains("`A (mV)` says `mV`, but the column of the unit `V`"), "{error}");
    let error = refusal("Quantity,Estimate (V),Standard uncertainty\nA (mV),10.5,0.1\n");
    assert!(error.contains("`A (mV)` says `mV`, but a heading `V`"), "{error}");
    let text = "Quantity,Estimate,Standard uncertainty\nA (mV),10.5,0.1\nRipple [mV],0,0.1\n";
    let budget = import("b.csv", text.as_bytes());
    let budget = budget.unwrap_or_else(|error| panic!("{error}"));
    assert!(budget.text.contains(r#""A": {"unit":"mV""#), "{}", budget.text);
    for name in
        ["Range (10 mm)", "Repeatability (A)", "Temperature (°C)", "Length (mm)", "Type (B)"]
    {
        let text = format!("Quantity,Estimate,Unit,Standard uncertainty\n{name},10.5,mm,0.1\n");
        assert!(uncertainties(&text).0[0] == 0.1, "{name}");
    }
}

/// A Spanish budget, and a French one whose contributions are in µm: 0.29 µm/K were 0.29 mm/K.
#[test]
fn spanish_and_french_budgets() {
    let text = "Incertidumbre de un termómetro (todos los valores en °C)\n\
                Fuente;Tipo;Valor ±;Distribución;Divisor;Incertidumbre estándar\n\
                Patrón;B;0,02;Normal;2;0,01\nResolución;B;0,05;Rectangular;1,732;0,029\n\
                Repetibilidad;A;0,015;Normal;1;0,015\nIncertidumbre combinada;;;;;0,034\n\
                Incertidumbre expandida (k=2);;;;;0,068\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found.len(), 3);
    assert_eq!(found[0], 0.01);
    assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
    let text = "Origine;Valeur;Unité;Demi-étendue;Loi;u(xi);ci;u(y) en µm\n\
                Étalon;25,0003;mm;0,10 µm;normale (k=2);0,05 µm;1;0,05\n\
                Température;20;°C;0,5;arcsinus;0,35;0,29;0,10\n";
    let (_, budget) = uncertainties(text);
    assert!(budget.text.contains("(0.00029)*Température"), "{}", budget.text);
}

/// Words of totals in tables that have no estimates were quantities: 0.49 mV for 0.35 mV.
#[test]
fn totals_of_tables_without_estimates() {
    for text in [
        "Beitrag;Unsicherheit (mV);Verteilung;Teiler;Standardunsicherheit (mV)\nPuffer;0,3;Rechteck;1,73;0,17\n\
         Temperatur;0,5;Rechteck;1,73;0,29\nuc;;;;0,34\nU;;;;0,68\n",
        "Component,u (mV)\nA,0.1\nB,0.2\nuc,0.22\nU,0.45\n",
        "Type,Component,Value,Distribution,Divisor,Std unc (µV)\nA,Repeatability,1.2,normal,1,1.2\n\
         B,Reference,3,normal,2,1.5\nCombined,,,,,1.92\nExpanded (k=2),,,,,3.84\n",
        "No,Source,Uncertainty (±),Unit,Prob. Dist.,Divisor,Ci,Std Uncertainty,DOF\n\
         1,Repeatability,0.02,mm,Normal,1,1,0.02,4\n2,Resolution,0.01,mm,Rectangular,1.732,1,0.0058,\n\
         ,Combined Uncertainty,,,,,,0.021,\n,Effective DOF,,,,,,5,\n,Coverage Factor,,,,,,2.57,\n",
    ] {
        let (found, budget) = uncertainties(text);
        assert_eq!(found.len(), 2, "{text}");
        assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
    }
}

/// Words that cells break, a unit behind the coverage, and the symbol of the measurand in a heading.
#[test]
fn broken_words_and_units_behind_symbols() {
    let text = "Größe;Schätzwert;Standardmess-unsicherheit;Sensitivitäts-koeffizient;Unsicherheits-beitrag\n\
                X_i;x_i;u(x_i);c_i;u_i(y)\nl_S;50,000 020 mm;15 nm;1,0;15,0 nm\nδl_D;0 mm;17,3 nm;1,0;17,3 nm\n";
    let (found, budget) = uncertainties(text);
    assert!((found[0] / 15e-6 - 1.0).abs() < 1e-12, "{found:?}");
    assert!(budget.text.contains("l_S + δl_D"), "{}", budget.text);
    let text = "Quantity;Estimate (mm);U (k=2) µm\nl;10;0,05\n";
    assert!((uncertainties(text).0[0] / 25e-6 - 1.0).abs() < 1e-12);
    let text = "Symbol,Source of uncertainty,Value ±,Distribution,Divisor,ci,ui (W) mg\n\
                Ws,Standard,30 mg,Normal,2,1,15.0\nDs,Drift,30 mg,Rectangular,√3,1,17.3\n\
                uc(W),Combined uncertainty,,,,,22.9\n";
    let (_, budget) = uncertainties(text);
    assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "mg");
}

/// A unit behind a number goes before one in a name, and the class of an instrument is no uncertainty.
#[test]
fn units_of_numbers_and_classes() {
    for (text, u) in [
        ("Quantity;Estimate;u\nVoltage (V);5 mV;0,1 mV\n", 0.1),
        ("Quantity;Estimate;Unit;u\nGain (dB);2;1;0,1\n", 0.1),
        ("Quantity;Estimate;Unit;Accuracy class;u\nA;2;V;0,5;0,1\n", 0.1),
    ] {
        assert_eq!(uncertainties(text).0, [u], "{text}");
    }
}

/// What a line says of the model is asked, and labels are no part of a name.
#[test]
fn equations_behind_labels_and_without_a_name() {
    let head = "Quantity;Estimate;Unit;u\nA;10;V;0,02\nB;3;V;0,01\n";
    let error = refusal(&format!("{head}A-B\n"));
    assert!(error.contains("`A-B` may be the equation of the result"), "{error}");
    let (_, budget) = uncertainties(&format!("Model function: y = A - B\n{head}y;7;V;\n"));
    assert!(budget.text.contains(r#""y":"A - B""#), "{}", budget.text);
    let error =
        refusal("Quantity,Estimate,Relative u (ppm),c_i (relative)\nR,10000 ohm,2,1\nr,1,0.5,1\n");
    assert!(error.contains("relative coefficients are the exponents of a product"), "{error}");
    let error = refusal("Quantity,Estimate,Relative u (ppm),c_i\nR,10000 ohm,2,1\nr,1,0.5,1\n");
    assert!(error.contains("or an exponent"), "{error}");
}

/// `ui` behind the coefficients of values that are divided is their product: 0.038 mV were 0.031 mV.
#[test]
fn contributions_of_values_that_are_divided() {
    let text = "Nr.;Beitrag;Typ;Wert;Einheit;Vert.;Div.;ci;ui;vi\n\
                1;Kalibrierung;B;0,10;mV;Normal;2;0,5;0,025;∞\n2;Auflösung;B;0,05;mV;Rechteck;1,732;1;0,0289;∞\n";
    let (found, budget) = uncertainties(text);
    assert_eq!(found[0], 0.05);
    assert!(budget.text.contains("(0.5)*Kalibrierung + Auflösung"), "{}", budget.text);
    let text = "Item,Uncertainty Source,Value,Unit,Probability Distribution,Divisor,ci,ui(y),Veff\n\
                1,Repeatability,0.0005,V,Normal,sqrt(5),1,0.00022,4\n\
                2,Accuracy,0.001,V,Rectangular,sqrt(3),0.5,0.00029,Infinite\n,Combined std uncertainty,,,,,,0.00036,\n";
    let (found, _) = uncertainties(text);
    assert!((found[1] / (1e-3 / 3f64.sqrt()) - 1.0).abs() < 1e-12, "{found:?}");
    let (found, budget) = uncertainties("Source;u (dB)\nMismatch;0,05\nCalibration (k=2);0,10\n");
    assert_eq!(found[1], 0.1);
    assert!(guesses(&budget, "say k = 2, and 0.1 below `u (dB)`"), "{:?}", budget.guessed);
    let text = "Quantity,Estimate,Unit,±,Distribution,Sens.\nA,5,V,0.1,rectangular,2\nB,1,V,0.1,rectangular,1\n";
    assert!(uncertainties(text).1.text.contains("(2)*A + B"));
}

/// A unit of all values yields to that of a row.
#[test]
fn rows_with_a_unit_of_their_own_beside_that_of_all_values() {
    let text = "Caliper (values in µm unless stated)\n\
                Source,Limits (±),Distribution,Divisor,Std Uncertainty,Sensitivity,Contribution\n\
                Resolution (10 µm full width),5,Rectangular,1.73,2.89,1,2.89\n\
                Temperature,0.7 °C,Rectangular,1.73,0.40,1.15 µm/°C,0.46\nCombined,,,,,,2.93\n";
    let (found, budget) = uncertainties(text);
    assert!((found[1] / (0.7 / 3f64.sqrt()) - 1.0).abs() < 1e-12, "{found:?}");
    assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
}

/// A total without a word was a quantity: 0.32 mV for 0.22 mV.
#[test]
fn rows_without_a_name() {
    let error = refusal("Component,u (mV),Remark\nA,0.1,\nB,0.2,\n,0.22,root sum of squares\n");
    assert!(error.contains("a row without a name has an uncertainty alone"), "{error}");
    assert!(error.contains("b.csv:4:1"), "{error}");
}

/// Two columns of uncertainties of which each row has one, and totals under other words.
#[test]
fn uncertainties_in_two_columns_and_totals_under_other_words() {
    for heading in ["Expanded U (k=2)", "Expanded unc. (k=2)"] {
        let text = format!(
            "Term;Value;Unit;{heading};Error limits;Distribution\nA;1;V;0,02;;normal\nB;0;V;;0,01;rectangular\n"
        );
        let error = refusal(&text);
        assert!(error.contains("may both be the stated uncertainty"), "{heading}: {error}");
    }
    let head =
        "Source,Type,Uncertainty ± (V),k,u (V)\nRef,B,0.002,2,0.001\nRep,A,0.0005,1,0.0005\n";
    for words in ["Sum in quadrature", "All together"] {
        assert_eq!(uncertainties(&format!("{head}{words},,,,0.00112\n")).0.len(), 2, "{words}");
    }
    // by chance
    let text = "Uncertainty component,Type,Value,Divisor,Standard uncertainty (µm)\nu1,B,0.10 µm,2,0.05\n\
                u2,B,0.5 µm,√3,0.289\nu3,A,0.3 µm,1,0.3\n";
    assert_eq!(uncertainties(text).0.len(), 3);
    let error = refusal("Component,u (V)\nRef,0.001\nRep,0.0005\nAll together,0.00112\n");
    assert!(error.contains("can be the result or a further quantity"), "{error}");
    let text = "Symbol;Nominal value;Measured deviation;Unit;u\nL;100;0,003;mm;0,001\n";
    let (_, budget) = uncertainties(text);
    assert_eq!(task(&budget).rows[0].distributions[0].mean(), 100.003);
}

/// What looks like the words above and is something else: a voltage from peak to peak, symbols in
/// parentheses, an instrument in a title, an accuracy beside the standard uncertainty that has it in it.
#[test]
fn words_that_say_something_else() {
    let text = "Quantity;Value;Unit;Uncertainty;Distribution;Divisor\nVoltage (peak-to-peak);10;V;0,02;normal;2\n";
    assert_eq!(uncertainties(text).0, [0.01]);
    for text in [
        "Quantity;Value;u\nLength (L);10;0,02\n",
        "Quantity;Value;u;c\nMass (m);10;0,02;1\nGain (g);1;0,02;1\n",
        "Quantity;Value;u\nStandard (S);10;0,02\nTest (T);10;0,02\n",
        "Unit: DMM 1\n\nQuantity;Value;u\nA;10;0,02\n",
        "All values in SI units\n\nQuantity;Value;u\nA;10;0,02\n",
        "Quantity;Value;u\nA;10;0,02\n\nValues in A1 to A5 measured\n",
        "Quantity;Value;u;Accuracy\nA;10;0,02;0,5\n",
    ] {
        let (found, budget) = uncertainties(text);
        assert!(found.iter().all(|u| *u == 0.02), "{text}: {found:?}");
        assert_eq!(task(&budget).model.outputs[0].quantity.unit.text(), "1", "{text}");
    }
    let error =
        refusal("all values in mV\n\nQuantity;Value;u\nA;10;0,02\nTemperature (°C);23;0,1\n");
    assert!(error.contains("`Temperature (°C)` says `°C`"), "{error}");
    let error = refusal("Quantity;Measured value;Correction;u\nA;10,1;0,1;0,02\n");
    assert!(error.contains("the estimate can be `Measured value` or its sum"), "{error}");
}

/// A constant beside a bare coefficient is as bare as that, and no temperature of the Celsius scale.
#[test]
fn constants_that_no_quantity_tells_the_unit_of() {
    let of =
        |equation: &str| format!("{equation}\n\nQuantity;Value;Unit;u\nT;300;K;0,1\nx;5;V;0,1\n");
    for (equation, without) in
        [("R = 100 + 0.39*T + 0*x", "100 [K]"), ("y = 4 + 16*(x-1) + 0*T", "4 [V]")]
    {
        let text = import("b.csv", of(equation).as_bytes()).unwrap().text;
        assert!(!text.contains(without), "{text}");
    }
    let text =
        import("b.csv", b"y = a*(T - 4)\n\nQuantity;Value;Unit;u\nT;300;K;0,1\na;2;W/K;0,1\n")
            .unwrap()
            .text;
    assert!(text.contains("T - 4 [K]"), "{text}");
}
