//! Effective degrees of freedom of several outputs together.

use std::collections::BTreeMap;

use super::{BudgetLine, Dof, GumRow, effective_dof};
use crate::distribution::RootName;
use crate::linalg::packed;

impl GumRow {
    /// Effective degrees of freedom of the covariance matrix U of these outputs, whose Cholesky root is
    /// given as a packed triangle: U is the sum of the U_i of independent sources with nu_i degrees of
    /// freedom, and nu = (m + m^2)/sum((tr(W_i^2) + tr(W_i)^2)/nu_i) with W_i = U^-1 U_i and m outputs.
    /// Source: Krishnamoorthy and Yu, Stat. Probab. Lett. 66 (2004) 161, equation 6; of one output it is
    /// the Welch-Satterthwaite formula, of one source its own degrees of freedom.
    pub(crate) fn joint_dof(&self, outputs: &[usize], root: &[f64]) -> Dof {
        let distributions = &self.distributions;
        let order = outputs.len();
        // in coordinates in which the covariance matrix is the identity
        let contribution = |q: usize| -> Vec<f64> {
            let slope =
                |output: &usize| self.gradients.get(*output).and_then(|slopes| slopes.get(q));
            let u = self.uncertainties.get(q).copied().unwrap_or(0.0);
            let mut own: Vec<f64> =
                outputs.iter().map(|output| slope(output).map_or(0.0, |c| c * u)).collect();
            packed::solve(root, &mut own);
            own
        };
        let contributions: Vec<Vec<f64>> = (0..distributions.len()).map(contribution).collect();
        let square = |contributions: &[f64]| contributions.iter().map(|x| x * x).sum::<f64>();
        // whether the degrees of freedom are known is as of an output that all contribute to
        let lines = distributions.iter().zip(&contributions).enumerate();
        let lines: Vec<BudgetLine> = lines
            .map(|(q, (contributions, own))| BudgetLine {
                contribution: square(own).sqrt(),
                ..BudgetLine::new(q, contributions, 1.0)
            })
            .collect();
        let of_all = effective_dof(&lines, distributions, &self.linked, 1.0);
        if !matches!(of_all, Dof::Finite(_)) {
            return of_all;
        }
        let ensemble = |q: usize| self.linked.ensemble_of.get(&q);
        let saved = |q: usize| distributions[q].saved();
        let by_roots = |q: usize| saved(q).filter(|saved| saved.origin().has_independent_roots());
        // of a source of one contribution tr(W^2) and tr(W)^2 are one
        let single: f64 = lines
            .iter()
            .enumerate()
            .filter(|(q, line)| {
                line.dof.is_finite() && by_roots(*q).is_none() && ensemble(*q).is_none()
            })
            .map(|(q, line)| 2.0 * square(&contributions[q]).powi(2) / line.dof)
            .sum();
        let joint: f64 = self
            .linked
            .ensembles
            .iter()
            .enumerate()
            .map(|(number, members)| {
                let dof = members.first().map_or(f64::INFINITY, |q| lines[*q].dof);
                let mut w = vec![0.0; order * order];
                let mut add = |a: &[f64], b: &[f64], factor: f64| {
                    for (i, a) in a.iter().enumerate() {
                        for (j, b) in b.iter().enumerate() {
                            w[i * order + j] += factor * a * b;
                        }
                    }
                };
                members.iter().for_each(|q| add(&contributions[*q], &contributions[*q], 1.0));
                for c in self.linked.correlations.iter().filter(|c| {
                    ensemble(c.first) == Some(&number) && ensemble(c.second) == Some(&number)
                }) {
                    let [a, b] = [c.first, c.second].map(|q| &contributions[q]);
                    add(a, b, c.coefficient);
                    add(b, a, c.coefficient);
                }
                let trace: f64 = w.iter().step_by(order + 1).sum();
                (square(&w) + trace * trace) / dof
            })
            .sum();
        let mut roots: BTreeMap<&RootName, (Vec<f64>, f64)> = BTreeMap::new();
        for (q, own) in contributions.iter().enumerate() {
            for (name, weight, dof) in by_roots(q)
                .iter()
                .flat_map(|saved| &saved.origin().roots)
                .map(|(root, weight)| (&root.name, weight, root.dof))
            {
                let (total, fewest) =
                    roots.entry(name).or_insert_with(|| (vec![0.0; order], f64::INFINITY));
                total.iter_mut().zip(own).for_each(|(total, own)| *total += weight * own);
                *fewest = fewest.min(dof);
            }
        }
        let common: f64 = roots.values().map(|(part, dof)| 2.0 * square(part).powi(2) / dof).sum();
        let order = order as f64;
        let dof = (order + order * order) / (single + joint + common);
        if dof.is_finite() { Dof::Finite(dof) } else { Dof::Infinite }
    }
}
