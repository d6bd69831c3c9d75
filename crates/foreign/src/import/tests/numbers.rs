//! Numbers that are made of two: nominal values and corrections, full widths, and what an equation converts.

use super::{guesses, import, refusal, task, uncertainties};
use gumption_engine::propagate::gum;

/// The estimates of a budget's quantities, in units of their own.
fn estimates(text: &str) -> Vec<f64> {
    let (_, budget) = uncertainties(text);
    task(&budget).rows[0].distributions.iter().map(|of| of.mean()).collect()
}

/// The estimate and the standard uncertainty of the result in its unit.
fn result(text: &str) -> [f64; 2] {
    let budget = import("b.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    let task = task(&budget);
    let of = gum::evaluate(&task, &task.rows[0]).outputs[0].clone().unwrap();
    [of.estimate, of.standard_uncertainty]
}

/// A weight of 100 g with a correction of 1.2 mg was 100 g.
#[test]
fn corrections_are_added_to_nominal_values() {
    for text in [
        "Quantity;Nominal;Correction;Unit;u\nm;100;0,0012;g;0,0003\n",
        "Quantity;Nominal (g);Correction (mg);u (mg)\nm;100;1,2;0,3\n",
        "Größe;Nennwert;Korrektion;Einheit;Standardunsicherheit\nm;100;1,2 mg;g;0,0003\n",
        "Größe;Nennwert;Abweichung vom Nennwert in mg;Einheit;Standardunsicherheit\nm;100;1,2;g;0,0003\n",
        "Quantity;Indication;Correction;Unit;u\nm;100;0,0012;g;0,0003\n",
        "Quantity;Nominal;Correction;Unit;u\nm;100;12 ppm;g;0,0003\n",
    ] {
        assert_eq!(estimates(text), [100.0012], "{text}");
        let (_, budget) = uncertainties(text);
        let said = budget.understood.iter().any(|said| said.contains("the estimate is 100 and"));
        assert!(said, "{:?}", budget.understood);
    }
    // a correction below zero of a value below zero, and a result with its own
    assert_eq!(estimates("Quantity;Nominal;Correction;Unit;u\nV;-10;1 %;V;0,1\n"), [-10.1]);
    let text = "Quantity;Nominal;Correction;Unit;u;c\nm;100;0,0012;g;0,0003;1\nd;0;0;g;0,0001;1\n\
                Result;100;0,0012;g;;\n";
    assert!((result(text)[0] - 100.0012).abs() < 1e-12);
    // the estimate that has it already
    let text = "Quantity;Nominal;Correction;Value;Unit;u\nm;100;0,0012;100,0012;g;0,0003\n";
    assert_eq!(estimates(text), [100.0012]);
}

/// Where the estimate may be corrected or not, it is asked.
#[test]
fn corrections_beside_estimates_are_asked() {
    for (text, part) in [
        (
            "Quantity;Value;Correction;Unit;u\nm;100;0,0012;g;0,0003\n",
            "the estimate can be `Value` or its sum with `Correction`",
        ),
        (
            "Quantity;Indication;Deviation;Unit;u\nm;100;0,0012;g;0,0003\n",
            "the estimate can be `Indication` or its sum with `Deviation`",
        ),
        (
            "Quantity;Nominal;Correction;Deviation;Unit;u\nm;100;0,001;0,001;g;0,0003\n",
            "`Correction` and `Deviation` may both be corrections",
        ),
        ("Quantity;Correction;Unit;u\nm;0,0012;g;0,0003\n", "the column `Correction` has numbers"),
    ] {
        let error = refusal(text);
        assert!(error.contains(part), "{text}: {error}");
    }
    assert_eq!(estimates("Quantity;Value;Correction;Unit;u\nm;100;0;g;0,0003\n"), [100.0]);
}

/// A resolution of 0.1 mV of full width was one of ±0.1 mV.
#[test]
fn names_say_full_widths() {
    let root = 3f64.sqrt();
    for (name, heading, shape, divisor) in [
        ("Resolution (full width)", "Value ±", "rectangular", ""),
        ("Resolution (full width)", "Uncertainty", "rectangular", "2√3"),
        ("Auflösung (volle Breite)", "Uncertainty", "Rechteck", "3,46"),
        ("Résolution, étendue", "Uncertainty", "rectangulaire", ""),
    ] {
        let text = format!(
            "Quantity;Estimate;Unit;{heading};Distribution;Divisor\n{name};0;mV;0,1;{shape};{divisor}\n"
        );
        let (found, _) = uncertainties(&text);
        // a conversion and a divisor are rounded
        assert!((found[0] / (0.05 / root) - 1.0).abs() < 1e-12, "{text}: {found:?}");
    }
    for (heading, cell, part) in [
        (
            "Half-width",
            "rectangular",
            "`full width` in the name, but the heading says a half-width",
        ),
        ("Uncertainty", "rectangular (half-width)", "but the distribution says a half-width"),
        ("Standard uncertainty", "rectangular", "is the heading of standard uncertainties"),
    ] {
        let text = format!(
            "Quantity;Estimate;Unit;{heading};Distribution\nResolution (full width);0;mV;0,1;{cell}\n"
        );
        let error = refusal(&text);
        assert!(error.contains(part), "{text}: {error}");
    }
    let text = "Quantity;Estimate;Unit;Uncertainty;Distribution;Divisor\n\
                Resolution (full width);0;mV;0,1;rectangular;√3\n";
    let error = refusal(text);
    assert!(error.contains("and the divisor √3 can be 0.1 or 0.05"), "{error}");
}

/// 100 mm at 22 °C with 11.5e-6/K: 100.0023 mm. Its parts are 1 µm, 2e-6 K^-1 * 100 mm * 2 K = 0.2 µm, and
/// 11.5e-6/K * 100 mm * 0.2 K = 0.23 µm.
#[test]
fn temperatures_and_their_differences_in_equations() {
    let u = (1f64 + 0.2 * 0.2 + 0.23 * 0.23).sqrt() * 1e-3;
    for (equation, per, row) in [
        ("L = L0*(1+alpha*(T-20))", "1/K", "T,22,°C,0.2"),
        ("L = L0*(1+alpha*(T-20))", "1/°C", "T,22,degC,0.2"),
        ("L = L0*(1+alpha*dT)", "1/K", "dT,2,°C,0.2"),
        ("L = L0*(1+alpha*dT)", "1/°C", "dT,2,°C,0.2"),
        ("L = L0*(1+alpha*dT)", "1/K", "dT,2,K,0.2"),
    ] {
        let text = format!(
            "Model: {equation}\nQuantity,Estimate,Unit,Standard uncertainty\nL0,100,mm,0.001\n\
             alpha,11.5E-6,{per},1E-6\n{row}\nL,100.0023,mm,0.00104\n"
        );
        let [estimate, found] = result(&text);
        assert!((estimate - 100.0023).abs() < 1e-6, "{text}: {estimate}");
        assert!((found / u - 1.0).abs() < 1e-4, "{text}: {found}");
    }
    // the ideal gas: 101325 Pa / (287.05 J/(kg K) * 293.15 K) = 1.2041 kg/m^3
    let text = "rho = p/(R*(t+273.15))\nQuantity,Estimate,Unit,Standard uncertainty\np,1013.25,hPa,1\n\
                R,287.05,J/(kg K),0.01\nt,20,°C,0.1\nrho,1.2041,kg/m^3,\n";
    assert!((result(text)[0] - 101_325.0 / (287.05 * 293.15)).abs() < 1e-12);
    // an indication and its correction, both in °C
    let text = "t = ti - c\nSymbol,Quantity,Estimate,Unit,Standard uncertainty\nti,Indication,20.1,°C,0.01\n\
                c,Correction of the thermometer,0.1,°C,0.02\nt,Temperature,20.0,°C,\n";
    let budget = import("b.csv", text.as_bytes()).unwrap_or_else(|error| panic!("{error}"));
    assert!(guesses(&budget, "`c` in °C is a difference of temperatures"), "{:?}", budget.guessed);
    assert!((result(text)[0] - 20.0).abs() < 1e-9);
    // a temperature that is no difference by its name
    let text = "L = L0*(1+alpha*T)\nQuantity,Estimate,Unit,Standard uncertainty\nL0,100,mm,0.001\n\
                alpha,11.5E-6,1/K,1E-6\nT,2,°C,0.2\n";
    assert!(refusal(text).contains("`T` is a Celsius temperature"));
}

/// 3000 rpm and 10 N m are 3141.59 W; 60 converts what is converted already.
#[test]
fn numbers_that_convert_rates() {
    for unit in ["rpm", "1/min"] {
        let rows = format!(
            "P = 2*pi*n*M/60\nQuantity,Estimate,Unit,Standard uncertainty\nn,3000,{unit},3\nM,10,N m,0.01\n"
        );
        let [estimate, u] = result(&format!("{rows}P,3141.59,W,4.4\n"));
        assert!((estimate - 1000.0 * std::f64::consts::PI).abs() < 1e-6, "{unit}: {estimate}");
        assert!((u / estimate / (2f64.sqrt() * 1e-3) - 1.0).abs() < 1e-6, "{unit}: {u}");
        let error = refusal(&rows);
        assert!(
            error.contains(&format!("the number 60 in `2*pi*n*M/60` is a size of `{unit}`")),
            "{error}"
        );
        assert_eq!(error.contains("a factor 2*pi is too much"), unit == "rpm", "{error}");
        // a result that neither of them gives
        let error = refusal(&format!("{rows}P,100,W,\n"));
        assert!(error.contains("the estimate of the result is 100 W"), "{error}");
    }
}

/// 10 L in 60 s are 10 L/min; the minute of a unit is a number that converts as well.
#[test]
fn numbers_that_convert_a_part_of_a_unit() {
    let rows = "q = V/t*60\nSymbol;Estimate;Unit;u\nV;10,00;L;0,01\nt;60,0;s;0,1\n";
    assert_eq!(result(&format!("{rows}q;10,00;L/min;0,02\n"))[0], 10.0);
}

/// 300.15 K are 27 °C.
#[test]
fn zeros_of_temperatures_in_equations() {
    let text = "t = T - 273.15\nQuantity;Estimate;Unit;u\nT;300,15;K;0,01\nt;27,00;°C;0,01\n";
    assert!((result(text)[0] - 27.0).abs() < 1e-9);
}

/// A coefficient multiplies no Celsius temperature: 2 µV/°C at 23 °C made 10 V to 10.000046 V.
#[test]
fn celsius_temperatures_of_linear_budgets() {
    let text = "Quantity,Estimate,Unit,±,Distribution,c_i\nStandard,10,V,50 µV,normal (k=2),1\n\
                Temperature,23,°C,1,rectangular,2 µV/°C\n";
    let [estimate, u] = result(text);
    assert_eq!(estimate, 10.0);
    assert!((u / (625f64 + 4.0 / 3.0).sqrt() * 1e6 - 1.0).abs() < 1e-9, "{u}");
    let (_, budget) = uncertainties(text);
    let part = "`Temperature` counts in the result by what it differs from its estimate, 23 °C";
    assert!(guesses(&budget, part), "{:?}", budget.guessed);
}

/// The share of a specification is of something: 35 ppm of 0 V were nothing.
#[test]
fn shares_of_specifications() {
    let of = |estimate: &str, cell: &str| {
        format!(
            "Quantity,Estimate,Unit,Uncertainty,Distribution\nV,{estimate},V,{cell},rectangular\n"
        )
    };
    let error = refusal(&of("0", "35 ppm + 5 µV"));
    assert!(error.contains("of the estimate 0 lacks its share"), "{error}");
    let (found, _) = uncertainties(&of("10", "± (35 ppm + 5 µV)"));
    assert!((found[0] / (355e-6 / 3f64.sqrt()) - 1.0).abs() < 1e-12, "{found:?}");
}

/// 5 % of mass in volume, 100*2.5 g/50 mL, is a number of an equation whose units do not pass.
#[test]
fn numbers_that_no_units_give() {
    let rows = "c = 100*m/V\nSymbol;Estimate;Unit;u\nm;2,5;g;0,01\nV;50;mL;0,05\n";
    assert_eq!(result(&format!("{rows}c;5,0;%;0,02\n"))[0], 5.0);
    assert!(refusal(&format!("{rows}c;50;%;0,2\n")).contains("does not pass the check of units"));
}

/// 296.15 K less 20 was 276.15 K.
#[test]
fn degrees_are_not_taken_from_kelvins() {
    let head = "y = 2*(T-20)\nQuantity;Estimate;Unit;u\n";
    let error = refusal(&format!("{head}T;296,15;K;0,5\n"));
    assert!(error.contains("`T-20` takes degrees Celsius from a temperature in K"), "{error}");
    assert_eq!(result(&format!("{head}T;30;K;0,5\n"))[0], 20.0);
}

/// An error of a nominal value may be added to it or taken from it; a peak-to-peak value is a full width.
#[test]
fn errors_and_values_from_peak_to_peak() {
    let error = refusal("Quantity;Nominal;Error;Unit;u\nA;10;0,02;V;0,01\n");
    assert!(error.contains("can be `Nominal` or its sum or difference with `Error`"), "{error}");
    let of = |heading: &str| {
        format!(
            "Quantity;Estimate;Unit;{heading};Distribution\nNoise (peak-to-peak);0;mV;0,6;rectangular\n"
        )
    };
    let (found, _) = uncertainties(&of("Uncertainty"));
    assert!((found[0] / (0.3 / 3f64.sqrt()) - 1.0).abs() < 1e-12, "{found:?}");
    assert!(refusal(&of("Half-width")).contains("`peak-to-peak` in the name, but the heading"));
}

/// 9550 makes kW of N m and revolutions a minute: 100*1500/9550 kW = 15.707 kW.
#[test]
fn numbers_that_convert_several_units_at_once() {
    let rows = "P = M*n/9550\nSymbol;Value;Unit;u\nM;100;N m;0,5\nn;1500;1/min;1\n";
    assert!((result(&format!("{rows}P;15,707;kW;0,08\n"))[0] - 15.7068).abs() < 1e-4);
    assert!(
        refusal(&format!("{rows}P;17,5;kW;0,08\n"))
            .contains("the estimate of the result is 17,5 kW")
    );
    let text = "V20 = V*(1 - 3*alpha*(t - 20 °C))\nSymbol;Value;Unit;u\nV;100;mL;0,1\nalpha;1e-5;1/°C;1e-6\n\
                t;25;°C;0,2\nV20;99,985;mL;0,1\n";
    assert!((result(text)[0] - 99.985).abs() < 1e-9);
    assert_eq!(estimates("Quantity;Value (nominal);Correction;Unit;u\nA;10;0,1;V;0,02\n"), [10.1]);
}
