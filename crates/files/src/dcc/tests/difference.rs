//! Temperatures and differences of temperatures.

use super::*;

/// A quantity of 0.05 °C with U = 0.02 °C, k = 2.
fn of_5_hundredths(attributes: &str, name: &str, unit: &str) -> String {
    let value = real("0.05", unit, &expanded(["0.02", "2", "0.95", "normal"]));
    format!(
        "<dcc:quantity id=\"v\"{attributes}><dcc:name><dcc:content lang=\"en\">{name}</dcc:content>\
         </dcc:name>{value}</dcc:quantity>"
    )
}

fn read(quantity: &str, keys: &str, result: &str) -> Result<ModelFile, Diagnostics> {
    model_in(result, &certificate("3.2.1", quantity), &format!(r#""id": "v"{keys}"#), "")
}

/// The error of an indication is the same number in °C and in K; a temperature is 273.15 K more.
#[test]
fn errors_of_indication_are_differences() {
    let celsius = r"\degreecelsius";
    let in_k = r#", "unit": "K""#;
    let error = of_5_hundredths(" refType=\"basic_measurementError\"", "e", celsius);
    for keys in ["", in_k, r#", "unit": "K", "difference": true"#] {
        let file = read(&error, keys, "K").unwrap();
        near(known(&file, 0), [0.05, 0.01]);
        assert!(has_note(&file, "certificate-difference"));
    }
    let file = read(&error, r#", "unit": "K", "difference": false"#, "K").unwrap();
    near(known(&file, 0), [273.2, 0.01]);
    assert!(!has_note(&file, "certificate-difference"));
    for of in [error.clone(), error.replace(celsius, r"\kelvin")] {
        let errors = read(&of, r#", "unit": "degC""#, "degC").unwrap_err().to_string();
        assert!(errors.contains("a difference of temperatures"), "{errors}");
    }
    let measured = of_5_hundredths(" refType=\"basic_measuredValue\"", "t", celsius);
    near(known(&read(&measured, in_k, "K").unwrap(), 0), [273.2, 0.01]);
    near(known(&read(&measured, "", "degC").unwrap(), 0), [0.05, 0.01]);
}

/// A name alone may be that of a corrected temperature.
#[test]
fn a_name_that_may_be_a_difference_is_asked() {
    let named = of_5_hundredths("", "Correction", r"\degreecelsius");
    let errors = read(&named, r#", "unit": "K""#, "K").unwrap_err().to_string();
    assert!(errors.contains("can be a temperature") && errors.contains("\"difference\": true"));
    near(known(&read(&named, r#", "difference": true"#, "K").unwrap(), 0), [0.05, 0.01]);
    near(known(&read(&named, "", "degC").unwrap(), 0), [0.05, 0.01]);
}

/// A result that is called a correction has values that are called `Measured value`; and where nothing tells,
/// few temperatures are 0.05 K.
#[test]
fn results_and_small_values_are_asked() {
    let kind = " refType=\"basic_measuredValue\"";
    let measured = |unit: &str| of_5_hundredths(kind, "Measured value", unit);
    let within = |name: &str, quantity: &str| {
        format!(
            "<dcc:result><dcc:name><dcc:content lang=\"en\">{name}</dcc:content></dcc:name>\
             <dcc:data><dcc:list>{quantity}</dcc:list></dcc:data></dcc:result>"
        )
    };
    let (celsius, in_degrees) = (r"\degreecelsius", r#", "unit": "degC""#);
    for (quantity, keys, result) in [
        (within("Correction", &measured(r"\kelvin")), in_degrees, "degC"),
        (within("deviation", &measured(celsius)), r#", "unit": "K""#, "K"),
    ] {
        let errors = read(&quantity, keys, result).unwrap_err().to_string();
        assert!(errors.contains("can be a temperature"), "{errors}");
        let keys = format!("{keys}, \"difference\": false");
        assert!(read(&quantity, &keys, result).is_ok());
    }
    let cold = within("t", &measured(r"\kelvin"));
    let errors = read(&cold, in_degrees, "degC").unwrap_err().to_string();
    assert!(errors.contains("near absolute zero"), "{errors}");
    near(known(&read(&cold, r#", "unit": "K""#, "K").unwrap(), 0), [0.05, 0.01]);
    let keys = format!("{in_degrees}, \"difference\": false");
    near(known(&read(&cold, &keys, "degC").unwrap(), 0), [0.05 - 273.15, 0.01]);
    near(known(&read(&within("t", &measured(celsius)), "", "degC").unwrap(), 0), [0.05, 0.01]);
}

/// A hybrid of the same number in both units is a difference, whatever it is called.
#[test]
fn hybrids_tell() {
    let parts = |celsius: &str, kelvin: &str| {
        let parts = [real(celsius, r"\degreecelsius", ""), real(kelvin, r"\kelvin", "")];
        quantity(&format!("<si:hybrid>{}</si:hybrid>", parts.concat()))
    };
    let of = |hybrid: &str, keys: &str, result: &str| {
        read(hybrid, keys, result).map(|file| known(&file, 0)[0])
    };
    let in_k = r#", "unit": "K""#;
    assert_eq!(of(&parts("0.10", "0.10"), in_k, "K").unwrap(), 0.1);
    assert_eq!(of(&parts("20.00", "293.15"), in_k, "K").unwrap(), 293.15);
    let errors = of(&parts("0.10", "0.10"), r#", "difference": false"#, "degC").unwrap_err();
    assert!(errors.to_string().contains("leave out `difference`"), "{errors}");
}

/// Names of several quantities need not be the same; a difference among temperatures is asked.
#[test]
fn several_quantities() {
    let of = |kind: &str, name: &str| {
        of_5_hundredths(kind, name, r"\degreecelsius").replace(" id=\"v\"", " refType=\"x\"")
    };
    let read = |quantities: [String; 2]| {
        let certificate = certificate("3.2.1", &quantities.concat());
        model_in("degC", &certificate, r#""ref_type": "x", "index": 1"#, "")
    };
    let named = ["Correction at 10 °C", "Correction at 20 °C"].map(|name| of("", name));
    near(known(&read(named).unwrap(), 0), [0.05, 0.01]);
    let error = of("", "e").replace("\"x\"", "\"x basic_measurementError\"");
    let errors = read([of("", "t"), error]).unwrap_err().to_string();
    assert!(errors.contains("say by `difference`"), "{errors}");
}
