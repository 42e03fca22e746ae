use effects::Priors;
use nalgebra::{Cholesky, DMatrix};
use robot::Robot;

use crate::columns::design::{Design, Group};
use crate::regression::problem::HypothesisSet;
use crate::search::select::Selection;

/// Uncertainty of the sizes of the findings that comes from effects outside the model, about the robot that has the
/// findings: a gain scales the torque that this robot needs, not the damping that its description is wrong by.
///
/// Every arm has small errors, and the findings absorb the torque of the unnamed ones. `w_S` are the weights of a
/// model. `w_K = B^-1 u` are those of an effect outside it, which change the weights of the model by `-share w_K`
/// (see [`Fit::beyond`]). The model averaged over one such effect at a time has
///
/// ```text
/// covariance  C = sum over effects of p share (B^-1 + w_K w_K') share'
/// odds        p / (1 - p) = exp(gain - least)
/// gain        (z² - k - k ln(z² / k)) / 2,  z² = u' B^-1 u > k weights, else 0
/// ```
///
/// in addition to its own. `gain` is the log evidence of the effect at its most likely size, since the size of a
/// small error is unknown. `least` is the evidence that a finding needs (Hoeting et al. 1999).
///
/// The priors in `B` are those of the search, except for links, which have the priors of CAD errors
/// ([`effects::HasCadError::cad_error_sd`]). Logs often show only the sum of the masses of two neighbours, and the
/// priors of the search would allow either link to have all of it.
#[derive(Debug, Clone)]
pub(crate) struct Unnamed<'a> {
    design: &'a Design,
    /// The columns of the model.
    columns: Vec<usize>,
    covariance: DMatrix<f64>,
}

impl<'a> Unnamed<'a> {
    /// The covariance from effects outside of `model`, which `selection` has about the robot with its findings. `None`
    /// where the model cannot be fitted.
    pub fn new(selection: &Selection<'a>, model: &HypothesisSet) -> Option<Self> {
        let problem = selection.problem;
        let (design, info) = (problem.design, &problem.info);
        let fit = problem.fit(model)?;
        let prior = prior_of_small_errors(design, selection.robot, &problem.thresholds.priors);
        let mut covariance = DMatrix::zeros(fit.columns.len(), fit.columns.len());
        for h in 0..design.groups.len() {
            let columns = problem.new_columns(model, h);
            if columns.is_empty() || model.contains(&h) || selection.is_excluded(model, h) {
                continue;
            }
            let (complement, u) = fit.beyond(info, &columns, &prior);
            let Some(factor) = Cholesky::new(complement.b.clone()) else { continue };
            let w = factor.solve(&u);
            let (z2, k) = (u.dot(&w), columns.len() as f64);
            let gain = if z2 > k { 0.5 * (z2 - k - k * (z2 / k).ln()) } else { 0.0 };
            let p = (1.0 + (selection.least_evidence(h) - gain).exp()).recip();
            covariance += complement.propagate(&(factor.inverse() + &w * w.transpose())) * p;
        }
        Some(Self { design, columns: fit.columns, covariance })
    }

    /// The covariance of the columns of a fit about another robot; zero for columns that only this fit has.
    pub fn about(&self, design: &Design, columns: &[usize]) -> DMatrix<f64> {
        let place: Vec<Option<usize>> =
            columns.iter().map(|&column| self.place(design, column)).collect();
        DMatrix::from_fn(columns.len(), columns.len(), |i, k| {
            let entry = place[i].zip(place[k]);
            entry.map_or(0.0, |at| self.covariance[at])
        })
    }

    /// Index of the weight of a column of another design.
    fn place(&self, design: &Design, column: usize) -> Option<usize> {
        let same = |g: &Group| {
            let weight = g.columns.iter().position(|c| *c == column)?;
            let own = &self.design.groups[self.design.find(g.hypothesis)?];
            let known = *own.columns.get(weight)?;
            self.columns.iter().position(|c| *c == known)
        };
        design.groups.iter().find_map(same)
    }
}

/// Prior standard deviations of all weights; those of links are CAD errors.
fn prior_of_small_errors(design: &Design, robot: &Robot, priors: &Priors) -> Vec<f64> {
    let mut prior = design.prior.clone();
    for group in &design.groups {
        let Some(small) = group.hypothesis.cad_error_sd(robot, priors) else {
            continue;
        };
        group.columns.iter().zip(small).for_each(|(&column, sd)| prior[column] = sd);
    }
    prior
}
