//! Pages for a browser as the commands give them: figures, and the script where it is asked for.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::{gumption, output};

const MODEL: &str = "models/inclined_plane.json";
const RECIPE: &str = "models/recordings/rotating_table/recipe.json";
const CERTIFICATE: &str = "models/certificates/three_axis_accelerometer.json";

/// The captions of a page, each once, in order.
fn captions(page: &str) -> Vec<&str> {
    let parts = page.split("<figcaption").skip(1);
    parts.filter_map(|part| part.split_once("</figcaption>").map(|(caption, _)| caption)).collect()
}

/// One row of conditions with trials shows how its figures settle, and nothing else does.
#[test]
fn a_page_shows_how_the_figures_settle() {
    let html = |arguments: &[&str]| {
        output(&[&["run"], arguments, &["--format", "html", "--quiet"]].concat())
    };
    let settles =
        |page: &str| captions(page).iter().filter(|said| said.contains("Convergence")).count();
    let page = html(&[MODEL, "--trials", "20000"]);
    assert_eq!(settles(&page), 3, "one for each output");
    assert!(page.contains("after 1 000 to 10 000 trials (dots) and the result of all 20 000"));
    // the whole run's own point has the figures of the answer
    let answer: Value = serde_json::from_str(&output(&[
        "run", MODEL, "--trials", "20000", "--format", "json", "--quiet",
    ]))
    .expect("JSON");
    let u = answer["outputs"]["a_x"]["monte_carlo"]["standard_uncertainty"].as_f64().expect("u");
    let said =
        page.split("20\u{202f}000 trials: standard uncertainty of a_x (").nth(1).expect("a point");
    let (shown, error) = said.split_once(')').and_then(|(of, _)| of.split_once(" ± ")).expect("u");
    let [shown, error] = [shown, error].map(|text| text.parse::<f64>().expect("a number"));
    // rounded to the leading digit of its numerical error
    assert!((shown - u).abs() <= error, "{shown} {error} {u}");
    assert_eq!(settles(&html(&[MODEL, "--trials", "0"])), 0);
    assert_eq!(settles(&html(&[MODEL, "--trials", "1000"])), 0, "nothing to compare with");
    assert_eq!(settles(&html(&["models/measuring_chain_frequencies.json", "--trials", "3000"])), 0);
}

/// Every command that makes a page gives it a script, and changes nothing else; others refuse.
#[test]
fn a_script_is_all_that_interactive_pages_have_more() {
    let commands: [&[&str]; 7] = [
        &["run", MODEL, "--trials", "2000"],
        &["observe", RECIPE],
        &["compare", "models/examples/results.csv"],
        &["compare", "models/examples/proficiency.csv", "--scheme", "iso13528"],
        &["diff", MODEL, MODEL],
        &["certificate", CERTIFICATE, "--trials", "2000"],
        &["assumptions", "models/spurious_component.json", "--trials", "20000"],
    ];
    for arguments in commands {
        let html =
            |more: &[&str]| output(&[arguments, &["--format", "html", "--quiet"], more].concat());
        let (plain, with) = (html(&[]), html(&["--interactive"]));
        assert!(!plain.contains("<script"), "{arguments:?}");
        let (before, rest) = with.split_once("<script>").expect("a script");
        let (_, after) = rest.split_once("</script>").expect("its end");
        let without = format!("{before}{after}");
        let (head, policy) = without.split_once("; script-src 'sha256-").expect("its digest");
        let (_, body) = policy.split_once('\'').expect("the digest's end");
        assert!(format!("{head}{body}") == plain, "{arguments:?}");
        let refused = gumption().args(arguments).arg("--interactive").assert().code(2);
        let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(said.contains("`--interactive` goes with `--format html`"), "{said}");
        assert!(refused.get_output().stdout.is_empty());
    }
}

/// Each channel of each row has a figure; the answer for programs has none of what they show.
#[test]
fn observations_have_a_figure_for_each_record() {
    let page = output(&["observe", RECIPE, "--format", "html", "--quiet"]);
    let all = captions(&page);
    // 3 rows of 5 channels
    assert_eq!(all.iter().filter(|said| said.contains("what the fit leaves")).count(), 15);
    assert!(all[0].contains("theta at f_set = 5 Hz") && all[0].contains("10 000 samples"));
    assert!(page.contains("<title>fundamental, 5 Hz: 17.03°</title>"), "the fitted amplitude");
    assert!(page.len() < 2_000_000, "{}", page.len());
    for format in ["json", "markdown", "csv", "table"] {
        let answer = output(&["observe", RECIPE, "--format", format, "--quiet"]);
        assert!(
            !answer.contains("what the fit leaves") && !answer.contains("Waveform"),
            "{format}"
        );
    }
}

/// The stylesheet lies beside the certificate, which names it; neither is there alone.
#[test]
fn a_digital_certificate_has_its_stylesheet_beside_it() {
    let folder: TempDir = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("a path").to_owned();
    let make = |arguments: &[&str]| {
        let common = ["certificate", CERTIFICATE, "--trials", "2000", "--quiet"];
        gumption().args(common).args(arguments).assert()
    };
    let to = path("a & b.xml");
    make(&["--format", "dcc", "--stylesheet", "--output", &to]).success();
    let text = fs::read_to_string(&to).expect("the certificate");
    let second = text.lines().nth(1).expect("a line");
    assert_eq!(second, "<?xml-stylesheet type=\"text/xsl\" href=\"a%20%26%20b.xsl\"?>");
    roxmltree::Document::parse(&text).expect("XML");
    let view = fs::read_to_string(path("a & b.xsl")).expect("the stylesheet");
    roxmltree::Document::parse(&view).expect("XML");
    // without it the certificate is the same
    make(&["--format", "dcc", "--output", &to]).success();
    let plain = fs::read_to_string(&to).expect("the certificate");
    assert_eq!(text.replacen(&format!("{second}\n"), "", 1), plain);
    let nothing: [&[&str]; 3] = [
        &["--format", "dcc", "--stylesheet"],
        &["--format", "html", "--stylesheet", "--output", &path("c.html")],
        &["--format", "dcc", "--stylesheet", "--output", &path("c.xsl")],
    ];
    for arguments in nothing {
        let refused = make(arguments).code(2);
        assert!(refused.get_output().stdout.is_empty());
        assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("`--stylesheet`"));
    }
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 2);
}
