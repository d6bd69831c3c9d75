//! What is to be borne in mind about a corrected record.

use super::corrected::Waveform;
use super::row::WaveformChannel;
use crate::note::short;
use gumption_engine::fact;
use gumption_engine::fact::Fact;

/// Standard uncertainties of its noise by which the ends of a record may differ.
const ENDS: f64 = 5.0;

/// How far the standard uncertainties of both methods may differ, relatively. Those of 100 trials scatter by 7 %.
const METHODS: f64 = 0.25;

/// The notes on a channel's waveform.
pub fn notes(channel: &WaveformChannel, of: &Waveform) -> Vec<Fact> {
    let name = &channel.name;
    let mut notes = Vec::new();
    if of.step_at_ends > ENDS && of.step_at_ends.is_finite() {
        notes.push(fact!("waveform-ends-differ", name, times = short(of.step_at_ends, 2)));
    }
    if let Some(trials) = &of.trials {
        let mean = |of: &[f64]| of.iter().map(|u| u * u).sum::<f64>() / of.len().max(1) as f64;
        let [drawn, stated] =
            [&trials.standard_uncertainties, &of.standard_uncertainties].map(|u| mean(u).sqrt());
        if stated > 0.0 && (drawn / stated - 1.0).abs() > METHODS {
            let (drawn, stated) = (short(drawn, 2), short(stated, 2));
            notes.push(fact!("waveform-methods-differ", name, drawn, stated));
        }
    }
    for quantity in &of.quantities {
        let figure = &quantity.name;
        let n = quantity.trials.len();
        let missing = quantity.trials.iter().filter(|value| !value.is_finite()).count();
        if missing > 0 {
            notes.push(fact!("waveform-quantity-missing", name, figure, missing, trials = n));
            continue;
        }
        let Some([_, drawn]) = quantity.of_trials().filter(|_| n >= 100) else { continue };
        let stated = quantity.standard_uncertainty();
        if (drawn - stated).abs() > METHODS * stated {
            let (drawn, stated) = (short(drawn, 2), short(stated, 2));
            notes.push(fact!("waveform-quantity-methods-differ", name, figure, drawn, stated));
        }
    }
    notes
}
