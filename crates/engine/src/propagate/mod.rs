//! Propagation: from what is known about the inputs to what is known about the outputs, by the law
//! of propagation of uncertainty ([`gum`], JCGM 100) and by the Monte Carlo method
//! ([`monte_carlo`], JCGM 101) at the same time, and the comparison of the two ([`validate`],
//! JCGM 101, clause 8).

mod agreement;
mod branch;
mod budget;
mod conformity;
mod control;
mod density;
mod evaluation;
mod evaluation_error;
mod exact;
mod figures;
mod golden_section;
pub mod gum;
mod inherited;
mod inherited_note;
mod input_figures;
mod moment_order;
pub mod monte_carlo;
mod naming;
mod nonlinearity;
mod origins;
pub mod parts;
mod quasi;
mod region_figures;
mod regions;
mod replay;
mod rounding;
mod second_order;
mod shortest;
mod statement;
mod trial_work;
pub mod validate;
mod warnings;
mod whole_turns;

pub use agreement::{Agreement, DifferenceCause};
pub use conformity::{Conformity, ConformityLevel, GlobalRisks};
pub use control::Control;
pub use evaluation::joint;
pub use evaluation::{evaluate, trial_hash};
pub use evaluation::{in_pool, is_brief};
pub use evaluation_error::{EvaluationError, LinearResult};
pub use exact::{Accuracy, Noiseless, Scatter};
pub use figures::{CapabilityStatement, Evaluation, JointlyDrawn, OutputEvaluation, RowEvaluation};
pub use inherited::Inherited;
pub use input_figures::InputFigures;
pub use naming::naming;
pub use origins::{Origins, linear, origins, own_roots};
pub use quasi::NetCoordinate;
pub use region_figures::{
    JointRegion, Region, RegionEvaluation, RegionValidation, SampledRegion, SmallestRegion,
};
pub use replay::{
    convergence, first_draws, first_trials, for_each_block, histograms, joint_ranks, quantiles,
    quantiles_and_ranks,
};
pub use second_order::SecondOrder;
pub use statement::{Basis, Stated};
pub use warnings::{statement_notes, warnings};
pub use whole_turns::onto_branch;
