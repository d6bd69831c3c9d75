//! The sim-to-real gap: whether measured data depart from a sim by more than its uncertainties
//! explain, where, which effect is missing, and how far the gap shrinks once it is added.
#![allow(missing_docs, dead_code)]

mod correlated;
mod covariance;
mod data;
mod discrepancy;
mod evidence;
mod latent;
mod likelihood;
mod mixture;
mod posterior;
mod search;
mod setup;

pub fn probe(case: &crate::task::Case) {
    let start = std::time::Instant::now();
    let setup = setup::Setup::new(case);
    let discrepancy = discrepancy::Discrepancy::new(&setup);
    let t1 = start.elapsed();
    let posterior = posterior::posterior(&setup, &discrepancy, 1, posterior::Effort::FULL, &|_| {});
    let t2 = start.elapsed();
    let mut list: Vec<(String, f64, f64, f64, f64, usize)> = posterior
        .hypotheses
        .iter()
        .map(|h| {
            let names: Vec<&str> =
                h.effects.iter().map(|&e| case.candidates[e].effect.name.as_str()).collect();
            (
                names.join("+"),
                h.probability,
                h.evidence.ln_evidence,
                h.evidence.error,
                h.evidence.effective,
                h.evidence.draws(),
            )
        })
        .collect();
    list.push((
        "unexplained".into(),
        posterior.probability,
        posterior.unexplained.ln_evidence,
        0.0,
        0.0,
        discrepancy.forms.len(),
    ));
    list.sort_by(|a, b| b.1.total_cmp(&a.1));
    println!("setup {t1:?} all {t2:?} unknown inputs {}", setup.unknown_inputs.len());
    for (name, p, ln, error, ess, n) in list.iter().take(6) {
        println!("  {name:<44} p {p:.4} lnZ {ln:.3} +- {error:.3} ess {ess:.0} of {n}");
    }
    if let Some(k) = posterior.unexplained.kinds.first() {
        let f = &discrepancy.forms[k.form];
        println!(
            "  best form {:?} length {} amplitude {} weight {}",
            f.term, f.length, k.amplitude, k.weight
        );
    }
}
