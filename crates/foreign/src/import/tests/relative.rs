//! Budgets in shares: per cent and ppm of a result with a dimension, relative budgets, and numbers that convert
//! what is converted already.

use super::{guesses, import, refusal, task, uncertainties};
use crate::import::ImportedBudget;
use gumption_engine::propagate::gum;

/// The estimate of a budget's result, its standard uncertainty and its unit.
fn result(text: &str) -> (f64, f64, String, ImportedBudget) {
    let (_, budget) = uncertainties(text);
    let task = task(&budget);
    let found = gum::evaluate(&task, &task.rows[0]);
    let of = found.outputs[0].clone().unwrap();
    let unit = task.model.outputs[0].quantity.unit.text().to_owned();
    (of.estimate, of.standard_uncertainty, unit, budget)
}

/// 10 V with 25 µV, and 1.73 and 1.15 ppm of it: 32.5 µV, which was 2.08 V.
#[test]
fn shares_of_the_result_by_its_contributions() {
    let head = "Quantity;Value;Unit;U;Distribution;Divisor;c;u(y)";
    let rows = |unit: &str| {
        format!(
            "Reference;10,00000;V;50 µV;normal;2;1;2,5{unit}\n\
             Linearity;0;ppm;3;rectangular;1,732;1;1,73{unit}\n\
             Temperature;0;ppm;2;rectangular;1,732;1;1,15{unit}\n"
        )
    };
    for text in [
        format!("{head} [ppm]\n{}Combined;;;;;;;3,25\n", rows("")),
        format!("{head} [ppm]\n{}", rows("")),
        format!("{head}\n{}Combined;;;;;;;3,25 ppm\n", rows(" ppm")),
    ] {
        let (estimate, u, unit, budget) = result(&text);
        assert_eq!((estimate, unit.as_str()), (10.0, "V"), "{text}");
        // 25^2 + (30/1.732)^2 + (20/1.732)^2 = 32.53^2
        assert!((u - 32.53e-6).abs() < 0.01e-6, "{u}: {text}");
        let part =
            "`Linearity` is taken as 1 ppm of the result per ppm, as its contribution has it";
        assert!(guesses(&budget, part), "{:?}", budget.guessed);
        assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
    }
    // another combined uncertainty
    let text = format!("{head} [ppm]\n{}Combined;;;;;;;5,25\n", rows(""));
    let error = refusal(&text);
    assert!(
        error.contains("uncertainty of the result is 5,25 ppm, this model 3.25 ppm"),
        "{error}"
    );
    // per cent of 1 mW: 0.25 and 0.21 %, 0.33 % together; was 0.21 mW
    let text = "Quantity;Value;U;Distribution;Divisor;c;u(y) [%]\n\
                Power sensor;1,000 mW;0,5 %;normal;2;1;0,25\n\
                Mismatch;0 %;0,3 %;U-shaped;1,414;1;0,21\nCombined;;;;;;0,33\n";
    let (_, u, unit, _) = result(text);
    assert_eq!(unit, "mW");
    assert!((u - 3.279e-3).abs() < 1e-6, "{u}");
    // a contribution in V says that the coefficient is in V
    let text = "Quantity;Value;Unit;Standard uncertainty;c;Contribution (µV)\n\
                Reference;10;V;25 µV;1;25\nLinearity;0;ppm;1,73;10;17,3\n";
    let (_, u, _, _) = result(text);
    assert!((u - 30.40e-6).abs() < 0.01e-6, "{u}");
}

/// The combined uncertainty decides where no contribution does; without either both readings are told.
#[test]
fn shares_of_the_result_by_its_uncertainty() {
    let text = "Quantity;Value;Unit;Standard uncertainty;c\nReference;10,00000;V;25 µV;1\n\
                Linearity;0;ppm;1,732;1\nTemperature;0;ppm;1,155;1\n";
    for end in [
        "Combined standard uncertainty;;V;32,5 µV;\n",
        "Combined standard uncertainty;;;3,25 ppm;\n",
        "Combined standard uncertainty;;ppm;3,25;\n",
        "Expanded uncertainty (k=2);;ppm;6,5;\n",
    ] {
        let (_, u, _, budget) = result(&format!("{text}{end}"));
        assert!((u - 32.5e-6).abs() < 0.1e-6, "{u}: {end}");
        let part = "as 1 ppm of the result per ppm, as the uncertainty of the result has it";
        assert!(guesses(&budget, part), "{:?}", budget.guessed);
    }
    let (_, u, _, budget) = result(&format!("{text}Combined standard uncertainty;;V;2,08;\n"));
    assert!((u - 2.08).abs() < 0.01);
    assert!(guesses(&budget, "is taken as 1 V/ppm, as the uncertainty"), "{:?}", budget.guessed);
    let error = refusal(text);
    let part = "the coefficient 1 of `Linearity` in ppm can be 1 V/ppm or 1 ppm of the result per ppm, which is \
                1e-5 V/ppm";
    assert!(error.contains(part) && error.contains("b.csv:3:1"), "{error}");
    assert!(error.contains("`Temperature`"), "{error}");
    // the derivative by the share
    let error = refusal(
        "Quantity;Value;Unit;Standard uncertainty;c\nReference;10;V;25 µV;1\nLinearity;0;ppm;1,7;10\n",
    );
    assert!(error.contains("can be 10 V/ppm or 1 ppm of the result per ppm"), "{error}");
}

/// 1 beside a temperature and a length, and beside per cent and decibels, was 1 mm/°C and 1 dB/%.
#[test]
fn ones_between_other_dimensions_are_refused() {
    let head = "Quantity,Value,Unit,Standard uncertainty,Sensitivity\n";
    let text = format!("{head}Length,100.000,mm,0.001,1\nTemperature effect,0,°C,0.1,1\n");
    let error = refusal(&text);
    assert!(
        error.contains("`Temperature_effect` in °C can be 1 mm/°C, or lack its unit"),
        "{error}"
    );
    let error = refusal(&format!("{head}Gain,20.0,dB,0.1,1\nMismatch,0,%,2,1\n"));
    assert!(error.contains("can be 1 dB/% or 1 % of a power or an amplitude per %"), "{error}");
    // what the contribution says
    let text = "Quantity,Value,Unit,Standard uncertainty,Sensitivity,Contribution (mm)\n\
                Length,100.000,mm,0.001,1,0.001\nTemperature effect,0,°C,0.1,1,0.1\n";
    let (_, u, _, _) = result(text);
    assert!((u - 0.100_005).abs() < 1e-6, "{u}");
    // other coefficients are in the unit of the result per that of the quantity
    let (_, u, _, _) =
        result(&format!("{head}Length,100,mm,0.001,1\nTemperature,0,°C,0.1,0.0115\n"));
    assert!((u - 1.524e-3).abs() < 1e-6, "{u}");
}

/// Per cent of contributions that add up to 100 are of the variance; others are of the result.
#[test]
fn contributions_in_per_cent_are_compared() {
    let budget = |of_p1: &str, of_p2: &str, combined: &str| {
        format!(
            "Quantity,Value,Unit,Standard uncertainty,Sensitivity,Contribution (%)\n\
             P1,100,W,0.1,1,{of_p1}\nP2,20,W,0.05,1,{of_p2}\n\
             Combined standard uncertainty,,,0.112,,{combined}\n"
        )
    };
    // of the variance, of the sum of the contributions, of 120 W
    for [first, second, combined] in
        [["80", "20", "100"], ["67", "33", "100"], ["0.083", "0.042", "0.093"]]
    {
        let (_, u, _, found) = result(&budget(first, second, combined));
        assert!((u - 0.1118).abs() < 1e-4);
        assert!(!guesses(&found, "the sheet says"), "{first}: {:?}", found.guessed);
    }
    let (_, _, _, found) = result(&budget("55", "45", "100"));
    let part = "`P1` has 55 of 100 % of the variance, this model 80.0 %";
    assert!(guesses(&found, part), "{:?}", found.guessed);
    let (_, _, _, found) = result(&budget("0.083", "0.142", "0.093"));
    let part = "`P2` contributes 0.142, this model 0.05 W, which is 0.0417 % of the result";
    assert!(guesses(&found, part), "{:?}", found.guessed);
    let error = refusal(&budget("0.083", "0.042", "0.93"));
    assert!(error.contains("of the result is 0.93 %, this model 0.0932 %"), "{error}");
    let error = refusal(&budget("8.3", "0.042", "0.093"));
    assert!(error.contains("the contribution of `P1` is 100 times that of this model"), "{error}");
}

/// Relative budgets: m/V was m - V, 0.5 kg, and a product of powers a sum.
#[test]
fn relative_budgets_need_their_equation() {
    let rows = "m,2.0,kg,0.1,1\nV,1.5,L,0.2,-1\n";
    let head = "Quantity,Value,Unit,Relative standard uncertainty (%),Sensitivity\n";
    let ends = "Combined standard uncertainty,,,0.2236,\nExpanded uncertainty (k=2),,,0.4472,\n";
    let error = refusal(&format!("{head}{rows}{ends}"));
    assert!(
        error.contains("the coefficient -1 of `V` in L can be -1 kg/L, or an exponent"),
        "{error}"
    );
    assert!(error.contains("(`y = m*V^(-1)`)"), "{error}");
    let error = refusal(
        "Größe;Schätzwert;Einheit;Relative Standardunsicherheit (%);Sensitivitätskoeffizient\n\
         m;2,0;kg;0,1;1\nr;1,5;mm;0,2;-3\nKombinierte Standardunsicherheit;;;0,6083;\n",
    );
    assert!(error.contains("(`y = m*r^(-3)`)"), "{error}");
    // the contributions, and the combined uncertainty alone
    for text in [
        "Quantity,Value,Unit,Relative standard uncertainty (%),Sensitivity,Contribution (%)\n\
         P1,100,W,0.1,1,0.1\nP2,20,W,0.5,1,0.5\nCombined standard uncertainty,,,,,0.51\n",
        "Größe,Schätzwert,Einheit,Relative Standardunsicherheit (%),Sensitivitätskoeffizient,Beitrag (%)\n\
         P1,100,W,0.1,1,0.1\nP2,20,W,0.5,1,0.5\n",
    ] {
        let error = refusal(text);
        let part = "the contribution of `P2`, 0.500 %, is its relative uncertainty, as in a product, and 0.0833 % \
                    in the sum";
        assert!(error.contains(part) && error.contains("`y = P1*P2`"), "{error}");
    }
    let text =
        format!("{head}P1,100,W,0.1,1\nP2,20,W,0.5,-1\nCombined standard uncertainty,,,0.51,\n");
    let error = refusal(&text);
    assert!(error.contains("of the result is 0.51 %, this model 0.177 %"), "{error}");
    // with the equation: 0.2236 % of 1333 kg/m^3
    let equation = "rho = m/V\n\nQuantity,Value,Unit,Relative standard uncertainty (%)\n\
                    m,2.0,kg,0.1\nV,1.5,L,0.2\nCombined standard uncertainty,,,0.2236\n";
    let (estimate, u, _, budget) = result(equation);
    assert!((u / estimate - 2.236e-3).abs() < 1e-6);
    assert!(!guesses(&budget, "the sheet says"), "{:?}", budget.guessed);
    let error = refusal(&equation.replace("0.2236", "0.5"));
    assert!(error.contains("of the result is 0.5 %, this model 0.224 %"), "{error}");
}

/// The unit that the coefficients imply: V/A is ohm. It was none.
#[test]
fn coefficients_imply_the_unit_of_the_result() {
    let text = "Größe;Schätzwert;Standardunsicherheit;Verteilung;Sensitivitätskoeffizient;Beitrag\n\
                V_1;10,5 V;5 mV;normal;0,5 1/A;2,5 mΩ\n\
                I_1;2,0 A;1 mA;Rechteck;-2,625 V/A²;-2,625 mΩ\n";
    let (_, u, unit, budget) = result(text);
    assert_eq!(unit, "ohm");
    // 2.5 and 2.625 mohm
    assert!((u - 3.625e-3).abs() < 1e-6, "{u}");
    assert!(
        guesses(&budget, "`ohm` is taken, as the coefficient of `V_1`"),
        "{:?}",
        budget.guessed
    );
    assert!(!guesses(&budget, "contributes"), "{:?}", budget.guessed);
    // of a plain number units are converted too: 0.5/mm times 5 µm is 0.0025
    let text = "Quantity;Value;Unit;Standard uncertainty;c;Unit of c_i\ngap;5;µm;1;0,5;1/mm\n\
                angle;0;rad;0,001;1;1/rad\n";
    let (estimate, _, unit, _) = result(text);
    assert!((estimate - 0.0025).abs() < 1e-12 && unit == "1", "{estimate} {unit}");
}

/// A number that converts mV into V beside units that are converted: 5 ohm was 0.005 ohm.
#[test]
fn numbers_that_convert_twice_are_refused() {
    let rows = "Quantity,Value,Unit,U,k\nV,10000,mV,20,2\nI,2,A,0.01,2\n";
    let error = refusal(&format!("{rows}\nR = V/(1000*I)\n"));
    let part = "the number 1000 in `V/(1000*I)` is a size of `mV`: with the units of the rows the result is \
                0.0050000 ohm, and 5.0000 by their numbers alone";
    assert!(error.contains(part) && error.contains("b.csv:5:1"), "{error}");
    for equation in ["V*1e-3/I", "10^-3*V/I"] {
        assert!(refusal(&format!("{rows}\nR = {equation}\n")).contains("is a size of `mV`"));
    }
    // the result says which it is
    for (row, estimate) in [("R,5,ohm,,", 5.0), ("R,0.005,ohm,,", 0.005)] {
        let (found, _, _, _) = result(&format!("{rows}{row}\n\nR = V/(1000*I)\n"));
        assert_eq!(found, estimate);
    }
    // no number, one that is no size, and one whose units cancel
    for equation in ["V/I", "V/(50*I)", "1000*(V - V)/V + 3"] {
        import("b.csv", format!("{rows}\nR = {equation}\n").as_bytes()).unwrap();
    }
    let error =
        refusal("Quantity,Value,Unit,U,k\nL0,10,mm,0.001,2\nd,4,µm,2,2\n\nL = L0 + d/1000\n");
    assert!(error.contains("the number 1000 in `L0 + d/1000`"), "{error}");
}

/// Per cent beside a plain number: the row is the one in per cent, and no unit is empty.
#[test]
fn per_cent_beside_a_plain_number() {
    let head = "Quantity,Value,Unit,Standard uncertainty,Sensitivity";
    let error = refusal(&format!("{head}\nRatio,0.5,1,0.01,1\ndrift,0,%,0.5,1\n"));
    let part = "the coefficient 1 of `drift` in % can be 1 per % or 1 %/%, which is 0.01 per %, or 1 % of the \
                result per %, which is 0.005 per %";
    assert!(error.contains(part) && error.contains("b.csv:3:1"), "{error}");
    for (contribution, u) in [("0.005", 0.011_180), ("0.0025", 0.010_308), ("0.5", 0.500_100)] {
        let text = format!(
            "{head},Contribution\nRatio,0.5,1,0.01,1,0.01\ndrift,0,%,0.5,1,{contribution}\n"
        );
        let (_, found, unit, _) = result(&text);
        assert!((found - u).abs() < 1e-6 && unit == "1", "{contribution}: {found}");
    }
}
