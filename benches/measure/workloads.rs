//! The workloads that tools are compared by, W1 to W5 (benches/README.md), and those that grow.

use std::path::Path;

use gumption::file::read_text;
use gumption::task::{Task, Trials};

use super::generated;

/// Where the model files lie, seen from the root of the repository.
const MODELS: &str = "benches/models";

/// Inclined plane with spurious motion, typed.
pub const PLANE: &str = include_str!("../models/plane_typed.json");
/// The same measurement as formulas.
pub const PLANE_FORMULA: &str = include_str!("../models/plane_formula.json");
/// Sum of four rectangular quantities (JCGM 101, 9.2.3).
pub const SUM: &str = include_str!("../models/sum_of_four.json");
/// 384 conditions of the inclined plane, three outputs.
pub const CAMPAIGN: &str = include_str!("../models/campaign.json");
/// Gauge block, non-linear (JCGM 101, 9.5).
pub const BLOCK: &str = include_str!("../models/gauge_block.json");

/// How far apart the reference accelerations of W5 are, in m/s^2.
const STEP: f64 = 1e-6;

/// What can be evaluated.
pub const NAMES: &str =
    "W1, W1-formula, W2, W3, W4, W5, W5-all, W5-rows, sum:N, correlated:N, formula:N, outputs:N";

/// A model file's task with this many trials.
///
/// # Errors
/// What is wrong with the file.
pub fn model(text: &str, trials: u64) -> Result<Task, String> {
    let file = read_text("model", text, Path::new(MODELS), &[]).map_err(|e| e.to_string())?;
    let mut task = file.task;
    task.settings.trials = Trials::Fixed(trials);
    // as the other tools have it
    task.settings.coverage = 0.95.into();
    Ok(task)
}

/// W5: budgets of the inclined plane for this many reference accelerations, phases from five
/// readings each; without trials.
fn budgets(count: u64) -> Result<Task, String> {
    let mut model: serde_json::Value = serde_json::from_str(PLANE).map_err(|e| e.to_string())?;
    let nominal: Vec<f64> = (0..count).map(|i| 10.0 + STEP * i as f64).collect();
    model["conditions"]["a_nominal"] = serde_json::json!({"unit": "m/s^2", "values": nominal});
    model["inputs"]["a_ref"]["mean"] = "a_nominal".into();
    for phase in ["phase_x_syst", "phase_y_syst", "phase_z_syst"] {
        model["inputs"][phase]["dof"] = 4.into();
    }
    self::model(&model.to_string(), 0)
}

/// A workload with this many trials; W5 with this many budgets.
///
/// # Errors
/// A name that is none of [`NAMES`].
pub fn workload(name: &str, trials: u64) -> Result<Task, String> {
    match name {
        "W1" => return model(PLANE, trials),
        "W1-formula" => return model(PLANE_FORMULA, trials),
        "W2" => return model(SUM, trials),
        "W3" => return model(CAMPAIGN, trials),
        "W4" => return model(BLOCK, trials),
        "W5" | "W5-all" | "W5-rows" => return budgets(trials),
        _ => {}
    }
    let unknown = || format!("`{name}` is no workload; there are {NAMES}");
    let (kind, size) = name.split_once(':').ok_or_else(unknown)?;
    let size = size.parse().map_err(|_| unknown())?;
    let made = match kind {
        "sum" => generated::sum(size, trials),
        "correlated" => generated::correlated(size, trials),
        "formula" => generated::formula(size, trials),
        "outputs" => generated::outputs(size, trials),
        _ => return Err(unknown()),
    };
    made.map_err(|problems| problems.to_string())
}
