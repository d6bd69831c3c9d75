//! Ordinary budgets, each with the options that it needs and its result, computed by hand.

use super::*;

/// A sheet with its options, the estimate, the standard uncertainty and the unit of its result.
struct Ordinary<'a> {
    sheet: &'a str,
    options: &'a [&'a str],
    result: (f64, f64, &'a str),
}

#[test]
fn ordinary_budgets_need_two_options_at_most() {
    let root = f64::sqrt;
    let hypot = f64::hypot;
    let sheets = [
        // EA-4/02, S2: published 10 000.025 g and 29.3 mg; of parts that are rounded to 0.1 mg
        Ordinary {
            sheet: "Calibration of a weight\n\nQuantity,Estimate,Unit,Standard uncertainty,Distribution,Sensitivity coefficient\n\
                m_S,10000.005,g,0.0225,normal,1\nDelta m_D,0,g,0.00866,rectangular,1\ndm,0.020,g,0.0144,normal,1\n\
                dm_C,0,g,0.00577,rectangular,1\ndB,0,g,0.00577,rectangular,1\n\nm_X,10000.025,g,0.0293,,\n",
            options: &["row result=10"],
            result: (
                10000.025,
                root(
                    0.0225f64.powi(2)
                        + 0.00866f64.powi(2)
                        + 0.0144f64.powi(2)
                        + 2.0 * 0.00577f64.powi(2),
                ),
                "g",
            ),
        },
        // German, with an equation, a factor and a root
        Ordinary {
            sheet: "R = U/I;;;;;;\n\nGröße;Schätzwert;Einheit;Halbbreite;Verteilung;Teiler;Freiheitsgrade\n\
                U;5,0112;V;0,0046;Normal;2;50\nI;0,01;A;0,00001;Rechteck;√3;∞\n",
            options: &[],
            result: (501.12, 501.12 * hypot(0.0023 / 5.0112, 1e-3 / root(3.0)), "ohm"),
        },
        // half-widths with a summary: u = 0.1 sqrt(1/4 + 1/3)
        Ordinary {
            sheet: "Source,Value ±,Unit,Probability distribution,Divisor\nCertificate,0.1,mV,normal,2\n\
                Resolution,0.1,mV,rectangular,√3\nCombined standard uncertainty,0.0764,mV,,\nExpanded uncertainty (k=2),0.153,mV,,\n",
            options: &[],
            result: (0.0, 0.1 * root(0.25 + 1.0 / 3.0), "mV"),
        },
        // expanded uncertainties by the heading, in the unit of the heading
        Ordinary {
            sheet: "Quantity,Estimate (V),U (k=2) (mV)\na,1,0.3\nb,2,0.4\nResult,3,0.5\n",
            options: &[],
            result: (3.0, 0.25e-3, "V"),
        },
        // French, per cent of the estimate, and a stated result
        Ordinary {
            sheet: "P = U*I;;;;;\nGrandeur;Estimation;Unité;Incertitude-type (%);Loi;Remarque\nU;10,05;V;0,02;normale;certificat\n\
                I;2;A;0,05;normale;\nP;20,1;W;;;\n",
            options: &[],
            result: (20.1, 20.1 * hypot(2e-4, 5e-4), "W"),
        },
        // limits
        Ordinary {
            sheet: "Quantity,Lower limit,Upper limit,Unit,Distribution\nt1,19.7,20.3,K,rectangular\nt2,-0.1,0.1,K,triangular\n",
            options: &["coefficients one"],
            result: (20.0, root(0.09 / 3.0 + 0.01 / 6.0), "K"),
        },
        // half-widths without a distribution
        Ordinary {
            sheet: "Quantity,Estimate,Unit,Tolerance\na,0,mm,0.3\nb,0,mm,0.6\n",
            options: &["distribution rectangular"],
            result: (0.0, hypot(0.3, 0.6) / root(3.0), "mm"),
        },
        // expanded uncertainties without a factor
        Ordinary {
            sheet: "Quantity,Estimate,Unit,Expanded uncertainty\na,0,mm,0.3\nb,0,mm,0.4\n",
            options: &["k 2"],
            result: (0.0, 0.25, "mm"),
        },
        // EA-4/02, S4: units behind the numbers and coefficients; published 36.4 nm
        Ordinary {
            sheet: "Quantity;Estimate;Standard uncertainty;Probability distribution;Sensitivity coefficient\n\
                lS;50,000020 mm;15 nm;normal;1,0\ndlD;0 mm;17,3 nm;rectangular;1,0\ndl;-0,000094 mm;5,37 nm;normal;1,0\n\
                dlC;0 mm;18,5 nm;rectangular;1,0\ndt;0 °C;0,0289 °C;rectangular;-575 nm/°C\nda;0 1/°C;0,236·10⁻⁶ 1/°C;special;-50 mm °C\n\
                dlV;0 mm;3,87 nm;rectangular;–1,0\nlX;49,999926 mm;36,4 nm;;\n",
            options: &["row result=9"],
            result: (
                49.999926,
                1e-6 * root(
                    15.0f64.powi(2)
                        + 17.3f64.powi(2)
                        + 5.37f64.powi(2)
                        + 18.5f64.powi(2)
                        + (0.0289 * 575.0f64).powi(2)
                        + 11.8f64.powi(2)
                        + 3.87f64.powi(2),
                ),
                "mm",
            ),
        },
        // UKAS M3003: `Value (±)`, contributions behind the coefficients; published 0.41 ppm
        Ordinary {
            sheet: "Symbol,Source of uncertainty,Value (±),Probability distribution,Divisor,ci,ui(y) (ppm),vi or veff\n\
                RS,Calibration,0.5 ppm,Normal,2,1,0.25,∞\ndRD,Drift,0.5 ppm,Rectangular,√3,1,0.289,∞\nV,Repeatability,0.15 ppm,Normal,1,1,0.15,4\n\
                uc(Rx),Combined standard uncertainty,,Normal,,,0.41,>200\nU,Expanded uncertainty,,Normal (k=2),,,0.82,>200\n",
            options: &[],
            result: (0.0, root(0.0625 + 0.25 / 3.0 + 0.0225), "ppm"),
        },
        // a column under other words, and one of divisors
        Ordinary {
            sheet: "Quelle,Abweichung,Einheit,Verteilung,Teiler\na,0.3,V,Normal,2\nb,0.6,V,Rechteck,1.732\n",
            options: &["column uncertainty=B"],
            result: (0.0, root(0.15f64.powi(2) + 0.12), "V"),
        },
        // a coverage probability beside the divisor that belongs to it
        Ordinary {
            sheet: "Quantity,Estimate,Unit,Uncertainty,Distribution,Divisor\na,0,V,0.4,Normal (95 %),2\nb,0,V,0.3,Normal,1\n",
            options: &[],
            result: (0.0, hypot(0.2, 0.3), "V"),
        },
        // estimates and uncertainties in one cell, and in the last digits
        Ordinary {
            sheet: "E = A - B\n\nQuantity;Value\nA;10.000 V ± 0.002 V (k=2)\nB;9.5000(30) V\n",
            options: &[],
            result: (0.5, hypot(0.001, 0.003), "V"),
        },
        // of the house's findings: the estimate beside the words of an uncertainty
        Ordinary {
            sheet: "Quantity,Estimate,Unit,Standard uncertainty\na,1,V,0.3\nb,2,V,0.4\nCombined,3,V,0.5\n",
            options: &[],
            result: (3.0, 0.5, "V"),
        },
        // coefficients with their units in a column, relative uncertainties, degrees of freedom
        Ordinary {
            sheet: "Quantity,Estimate,Unit,Relative standard uncertainty [%],c_i,Unit of c_i,dof\nm,100,mg,0.05,0.02,mg/L/mg,9\n\
                V,50,mL,0.1,-0.04,mg/L/mL,inf\nc,2,mg/L,,,,\n",
            options: &["row result=4"],
            result: (2.0, hypot(0.02 * 0.05, 0.04 * 0.05), "mg/L"),
        },
    ];
    for Ordinary { sheet, options, result: (estimate, u, unit) } in sheets {
        assert!(options.len() <= 2);
        let budget = import(sheet, options).unwrap_or_else(|error| panic!("{sheet}\n{error}"));
        let found = result(&budget);
        let is_right = is_same(found.0, estimate) && is_same(found.1, u) && found.2 == unit;
        assert!(is_right, "{sheet}\n{found:?}, not {estimate} {u} {unit}\n{}", budget.text);
    }
}

/// Description, remark and title are in the model file.
#[test]
fn words_of_the_sheet_are_kept() {
    let sheet = "Calibration of the gauge G7\n\nSymbol,Description,Estimate,Unit,u,Remark\n\
        a,the reference,1,V,0.1,\"certificate 17, of May\"\nResult,,1,V,0.1,\n";
    let budget = import(sheet, &[]).unwrap();
    let model: serde_json::Value = serde_json::from_str(&budget.text).unwrap();
    assert_eq!(model["title"], "Calibration of the gauge G7");
    assert_eq!(model["inputs"]["a"]["about"], "a; the reference; certificate 17, of May");
}

/// A title behind its label, in a cell of its own or in the same one, whatever else stands above.
#[test]
fn titles_have_labels() {
    let table = "Symbol,Estimate,Unit,u\na,1,V,0.1\nResult,1,V,0.1\n";
    for above in ["Laboratory 7\nTitle:,Gauge G7\n", "Titel,Gauge G7\n\n", "Titre: Gauge G7\n"] {
        let budget = import(&format!("{above}{table}"), &[]).unwrap();
        let model: serde_json::Value = serde_json::from_str(&budget.text).unwrap();
        assert_eq!(model["title"], "Gauge G7", "{above}");
    }
}

/// Options that were kept are options again.
#[test]
fn options_are_kept_as_json() {
    let said = options(&["column U=C", "row result=4", "k 2", "coefficients units", "unit mV"]);
    assert_eq!(ImportOptions::from_json(&said.to_json()), Ok(said.clone()));
    assert!(ImportOptions::from_json("{\"colums\": []}").unwrap_err().contains("colums"));
    let own = options(&["column U=D"]).or(said);
    assert_eq!(own.columns, [("U".to_owned(), "D".to_owned())]);
    assert_eq!(own.k, Some(2.0));
}

/// The cells of a workbook's template are read without a question.
#[test]
fn the_template_is_read_without_a_question() {
    let book = gumption_report::budget_template().unwrap();
    let made = import_budget_bytes(Path::new("b.xlsx"), book, &ImportOptions::default());
    let made = made.unwrap_or_else(|error| panic!("{error}"));
    let (estimate, u, unit) = result(&made);
    let relative = f64::hypot(0.0023 / 5.0112, 1e-3 / f64::sqrt(3.0));
    assert!(is_same(estimate, 501.12) && is_same(u, 501.12 * relative) && unit == "ohm");
}
