use effects::Hypothesis;
use logs::LogError;
use rayon::prelude::*;

use crate::outcome::effect_at::effect_at;
use crate::outcome::gain::HeldOutGain;
use crate::outcome::torque_noise::TorqueNoise;
use crate::regression::blocks::Fold;
use crate::regression::body_errors::is_described_body;
use crate::regression::fitted_model::FittedModel;
use crate::regression::problem::Problem;
use crate::result::{AlsoFitted, FittedParameter, InverseGain};
use crate::search::causes::Causes;
use crate::search::dataset::Dataset;
use crate::search::inputs::Inputs;
use crate::thresholds::search::SearchThresholds;

/// What is fitted beside the findings: everyday effects at some joints, and changes of the described bodies or none.
///
/// No single one of these is shown by the logs. Where every number of a description is off by a little, they predict
/// better together than the findings alone, as plain least squares does.
#[derive(Debug, Clone, PartialEq)]
struct Beside {
    everyday_at: Vec<bool>,
    bodies: bool,
}

impl Beside {
    /// Everyday effects at every joint, with the bodies and without.
    fn starts(joints: usize) -> [Self; 2] {
        [true, false].map(|bodies| Self { everyday_at: vec![true; joints], bodies })
    }

    fn includes(&self, hypothesis: Hypothesis) -> bool {
        match hypothesis.joint().filter(|_| hypothesis.is_everyday()) {
            Some(j) => self.everyday_at[j],
            None => self.bodies,
        }
    }

    /// Less, for joints that are predicted worse with it: no everyday effects there, or else no bodies. `None` where
    /// nothing is left.
    fn without(&self, worse: &[usize]) -> Option<Self> {
        let mut less = self.clone();
        worse.iter().for_each(|&j| less.everyday_at[j] = false);
        if less == *self {
            less.bodies = false;
        }
        let is_empty = !less.bodies && less.everyday_at.iter().all(|is| !is);
        (less != *self && !is_empty).then_some(less)
    }
}

/// The robot with the findings and what is fitted beside them.
#[derive(Debug)]
pub(crate) struct Supplement {
    pub fitted: FittedModel,
    /// The gain of both.
    pub gain: HeldOutGain,
}

impl Inputs<'_> {
    /// What is fitted beside the findings, if the robot with it predicts held-out efforts better by more than
    /// `supplement_gain` at some joint where the findings leave more than noise, and at none worse by more than
    /// `supplement_harm`. Of several, the one with the smallest product of the errors of all joints.
    ///
    /// The findings keep their sizes: what is told of them is what is written. What is fitted has not seen the held-out
    /// efforts, but which of a few sets is taken depends on them.
    pub fn find_supplement(
        &self,
        dataset: &Dataset,
        by_run: &Problem,
        causes: &Causes,
        named: &HeldOutGain,
    ) -> Result<Option<Supplement>, LogError> {
        let problem = &causes.problem;
        let are_open = self.are_above_noise(&named.inverse);
        if !are_open.contains(&true) {
            return Ok(None);
        }
        let add = |found: &FittedModel| {
            found.beside(&self.log, problem, &self.hypotheses_beside(problem, found))
        };
        let t = &self.thresholds().search;
        let mut fitted = add(&causes.fitted)?;
        let body_errors = fitted.choose_body_errors(problem, &t.body_errors);
        let mut folds: Vec<FittedModel> =
            named.folds.par_iter().map(add).collect::<Result<_, LogError>>()?;
        folds.iter_mut().for_each(|fitted| fitted.set_body_errors(body_errors));
        let fit = |folds: &mut Vec<FittedModel>, beside: &Beside| {
            let of_fold = |(fitted, fold): (&mut FittedModel, &Fold)| {
                fitted.fit_beside(problem, &fold.train, |h| beside.includes(h));
            };
            folds.par_iter_mut().zip(&by_run.folds).for_each(of_fold);
            HeldOutGain::new(dataset, by_run, std::mem::take(folds))
        };
        let mut best: Option<(f64, Beside)> = None;
        for start in Beside::starts(self.design.joints()) {
            let mut next = Some(start);
            while let Some(beside) = next {
                let gain = fit(&mut folds, &beside);
                folds = gain.folds;
                let ratios = Ratios::new(&named.inverse, &gain.inverse);
                let worse = ratios.worse(t);
                next = beside.without(&worse).filter(|_| !worse.is_empty());
                let fall = ratios.fall(&are_open, t);
                let is_best = |fall: &f64| best.as_ref().is_none_or(|(most, _)| fall > most);
                if let Some(fall) = fall.filter(is_best) {
                    best = Some((fall, beside));
                }
            }
        }
        let Some((_, beside)) = best else { return Ok(None) };
        let gain = fit(&mut folds, &beside);
        let all: Vec<usize> = (0..dataset.blocks.len()).collect();
        fitted.set_body_errors(body_errors);
        fitted.fit_beside(problem, &all, |h| beside.includes(h));
        Ok(Some(Supplement { fitted, gain }))
    }

    /// The joints at which the findings leave more than the noise whose source is known, and described dry friction near
    /// rest.
    fn are_above_noise(&self, named: &InverseGain) -> Vec<bool> {
        let t = self.thresholds();
        let noise = TorqueNoise::new(self.nominal, self.design, self.log.prepared, &t.signals);
        let is_above = |(j, rms): (usize, &f64)| {
            let source = self.nominal.links()[j].actuator.torque_source;
            let factor = t.verdict.noise_factor_of(source);
            *rms > factor * noise.rms(j).0.hypot(self.friction_error(j).all)
        };
        named.rms_after_nm.iter().enumerate().map(is_above).collect()
    }

    /// What a supplement changes, for the user.
    pub fn also_fitted(
        &self,
        causes: &Causes,
        named: &HeldOutGain,
        supplement: &Supplement,
    ) -> AlsoFitted {
        let refit = supplement.fitted.refit.iter();
        let hypotheses =
            refit.flat_map(|refit| refit.model.iter().map(|&g| refit.design.groups[g].hypothesis));
        let parameters = hypotheses.flat_map(|hypothesis| {
            let at = effect_at(self.nominal, hypothesis);
            let quantities = hypothesis.quantities(&causes.fitted.robot, &supplement.fitted.robot);
            // A size held at its bound, such as a rotor without inertia, is no change.
            let changed = quantities.into_iter().filter(|q| (q.value - q.nominal).abs() > 0.0);
            changed.map(move |quantity| FittedParameter {
                at: at.clone(),
                name: quantity.name,
                value: quantity.value,
                before: quantity.nominal,
                unit: quantity.unit,
            })
        });
        AlsoFitted {
            parameters: parameters.collect(),
            rms_named_nm: named.inverse.rms_after_nm.clone(),
        }
    }

    /// Everyday effects and changes of described bodies that are no other name for a finding.
    fn hypotheses_beside(&self, problem: &Problem, found: &FittedModel) -> Vec<Hypothesis> {
        let groups = &problem.design.groups;
        let is_other_name = |h: Hypothesis| {
            let mut named = found.model.iter().map(|&m| groups[m].hypothesis);
            named.any(|named| named == h || named.excludes(h) || h.excludes(named))
        };
        let all = groups.iter().map(|group| group.hypothesis);
        let is_of_kind =
            |h: &Hypothesis| h.is_everyday() || is_described_body(*h, self.nominal, &self.log);
        all.filter(is_of_kind).filter(|h| !is_other_name(*h)).collect()
    }
}

/// Held-out error of each joint with a supplement over that of the findings alone; one where either is zero.
struct Ratios(Vec<f64>);

impl Ratios {
    fn new(named: &InverseGain, with: &InverseGain) -> Self {
        let ratio = |(named, with): (&f64, &f64)| {
            if named.min(*with) > 0.0 { with / named } else { 1.0 }
        };
        Self(named.rms_after_nm.iter().zip(&with.rms_after_nm).map(ratio).collect())
    }

    /// Joints that are predicted worse.
    fn worse(&self, t: &SearchThresholds) -> Vec<usize> {
        let is_worse = |(_, ratio): &(usize, &f64)| **ratio > 1.0 + t.supplement_harm;
        self.0.iter().enumerate().filter(is_worse).map(|(j, _)| j).collect()
    }

    /// Fall of the logarithm of the errors, summed over joints; `None` where no open joint is predicted better by enough,
    /// or one is predicted worse.
    fn fall(&self, are_open: &[bool], t: &SearchThresholds) -> Option<f64> {
        let mut open = self.0.iter().zip(are_open).filter(|(_, is_open)| **is_open);
        let is_better = open.any(|(ratio, _)| *ratio < 1.0 - t.supplement_gain);
        let fall = || -self.0.iter().map(|ratio| ratio.ln()).sum::<f64>();
        (is_better && self.worse(t).is_empty()).then(fall)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gain(after: &[f64]) -> InverseGain {
        InverseGain {
            nmse_before: Vec::new(),
            nmse_after: Vec::new(),
            rms_before_nm: Vec::new(),
            rms_after_nm: after.to_vec(),
            held_out: String::new(),
            folds: Vec::new(),
        }
    }

    /// A joint with half the error counts, one that nothing moves does not, and a joint with three per cent more
    /// forbids it.
    #[test]
    fn a_supplement_is_better_somewhere_and_worse_nowhere() {
        let t = SearchThresholds::default();
        let open = [true, false, true];
        let of = |with: &[f64]| Ratios::new(&gain(&[1.0, 2.0, 0.0]), &gain(with)).fall(&open, &t);
        assert!((of(&[0.5, 2.0, 0.0]).unwrap() - 2.0_f64.ln()).abs() < 1e-12);
        assert_eq!(of(&[0.99, 2.0, 0.0]), None);
        assert_eq!(of(&[1.0, 1.0, 0.0]), None, "the second joint is at its noise");
        assert_eq!(of(&[0.5, 2.06, 0.0]), None);
    }

    /// The everyday effects of a joint that is predicted worse leave before the bodies do.
    #[test]
    fn what_makes_a_joint_worse_leaves() {
        let [all, _] = Beside::starts(2);
        let less = all.without(&[1]).unwrap();
        assert_eq!(less, Beside { everyday_at: vec![true, false], bodies: true });
        let none = less.without(&[1]).unwrap();
        assert_eq!(none, Beside { everyday_at: vec![true, false], bodies: false });
        assert_eq!(none.without(&[0]), None);
    }
}
