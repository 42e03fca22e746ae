use experiment::{Claim, ClaimCase, PROCESSES, SEMIPARAMETRIC, Scope};
use learner::ModelKind;

use crate::paper::learning_errors::{LearningErrors, ModelErrors};

/// Largest error that counts as near zero, and largest excess of an error that counts as close to another: the bars
/// of figure 2 do not show smaller values.
const NEAR_ZERO: f64 = 0.01;

/// Share by which a model may be worse than another and count as competitive.
const COMPETITIVE: f64 = 0.1;

/// The claims of Nguyen-Tuong & Peters 2010 about figure 2, and the claims about the named effects, judged by the
/// errors.
pub fn learning_claims(errors: &LearningErrors) -> Vec<Claim> {
    let judge = Judge { joints: &errors.joints };
    let (rbd, gp, named) = (ModelKind::Rbd.name(), ModelKind::Gp.name(), ModelKind::Named.name());
    let semi = SEMIPARAMETRIC.map(ModelKind::name);
    vec![
        Claim::new(
            format!(
                "where rigid bodies describe the data, their error is near zero: an nMSE of at most {NEAR_ZERO}"
            ),
            Scope::Every,
            judge.within(&errors.simulated, rbd, NEAR_ZERO),
        ),
        Claim::new(
            format!(
                "there the semiparametric models stay close to them: at most {NEAR_ZERO} above"
            ),
            Scope::Every,
            judge.beside(&errors.simulated, &semi, rbd, (1.0, NEAR_ZERO)),
        ),
        Claim::new(
            "on the real data the semiparametric models are below the rigid bodies",
            Scope::Every,
            judge.beside(&errors.real, &semi, rbd, (1.0, 0.0)),
        ),
        Claim::new(
            "there they are below the Gaussian process or competitive with it: at most a tenth above",
            Scope::Every,
            judge.beside(&errors.real, &semi, gp, (1.0 + COMPETITIVE, 0.0)),
        ),
        Claim::new(
            "outside what was learned from, the named effects are below every Gaussian process",
            Scope::Every,
            PROCESSES
                .iter()
                .flat_map(|process| {
                    judge.beside(&errors.outside, &[named], process.name(), (1.0, 0.0))
                })
                .collect(),
        ),
    ]
}

/// Makes cases joint by joint.
struct Judge<'a> {
    joints: &'a [String],
}

impl Judge<'_> {
    /// Cases for the errors of a model, each at most `limit`.
    fn within(&self, errors: &[ModelErrors], model: &str, limit: f64) -> Vec<ClaimCase> {
        let joints = self.joints.iter().enumerate();
        joints
            .filter(|_| find(errors, model).is_some())
            .map(|(j, joint)| ClaimCase::within(model, joint, nmse(errors, model, j), limit))
            .collect()
    }

    /// Cases for the errors of some models, each limited by the error of `other`.
    fn beside(
        &self,
        errors: &[ModelErrors],
        models: &[&str],
        other: &str,
        allowed: (f64, f64),
    ) -> Vec<ClaimCase> {
        let known = models.iter().filter(|model| find(errors, model).is_some());
        let known = known.filter(|_| find(errors, other).is_some());
        let cases = known.flat_map(|model| {
            self.joints.iter().enumerate().map(move |(j, joint)| {
                let of = |name: &str| nmse(errors, name, j);
                ClaimCase::beside((model, of(model)), (other, of(other)), joint, allowed)
            })
        });
        cases.collect()
    }
}

fn find<'a>(errors: &'a [ModelErrors], model: &str) -> Option<&'a ModelErrors> {
    errors.iter().find(|errors| errors.model == model)
}

fn nmse(errors: &[ModelErrors], model: &str, joint: usize) -> Option<f64> {
    find(errors, model)?.nmse.get(joint).copied().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use experiment::ClaimVerdict;

    /// Two joints; every claim holds.
    fn errors() -> LearningErrors {
        let of = |numbers: [(&str, [f64; 2]); 6]| -> Vec<ModelErrors> {
            numbers
                .into_iter()
                .map(|(model, nmse)| ModelErrors {
                    model: model.into(),
                    nmse: nmse.map(Some).to_vec(),
                    rmse_nm: vec![1.0; 2],
                })
                .collect()
        };
        LearningErrors {
            robot: "arm".into(),
            joints: vec!["shoulder".into(), "elbow".into()],
            points: 300,
            test_points: 300,
            simulated: of([
                ("rbd", [0.001, 0.002]),
                ("gp", [0.1, 0.2]),
                ("gp-rbd", [0.001, 0.003]),
                ("gp-rbd-prior", [0.001, 0.011]),
                ("rbd-kernel", [0.01, 0.01]),
                ("named", [0.001, 0.001]),
            ]),
            real: of([
                ("rbd", [0.5, 0.9]),
                ("gp", [0.05, 0.1]),
                ("gp-rbd", [0.01, 0.109]),
                ("gp-rbd-prior", [0.01, 0.02]),
                ("rbd-kernel", [0.02, 0.02]),
                ("named", [0.02, 0.03]),
            ]),
            outside: of([
                ("rbd", [0.5, 0.9]),
                ("gp", [0.8, 0.9]),
                ("gp-rbd", [0.2, 0.3]),
                ("gp-rbd-prior", [0.2, 0.3]),
                ("rbd-kernel", [0.3, 0.4]),
                ("named", [0.01, 0.02]),
            ]),
        }
    }

    fn set(errors: &mut [ModelErrors], model: &str, value: f64) {
        let model = errors.iter_mut().find(|errors| errors.model == model).unwrap();
        model.nmse[1] = Some(value);
    }

    #[test]
    fn every_claim_is_held_or_not_by_the_number_that_it_is_about() {
        let outcomes = |errors: &LearningErrors| -> Vec<bool> {
            learning_claims(errors)
                .iter()
                .map(|claim| claim.verdict == ClaimVerdict::Holds)
                .collect()
        };
        assert_eq!(outcomes(&errors()), [true; 5]);
        type Change = fn(&mut LearningErrors);
        let changes: [(Change, usize); 5] = [
            (|e| set(&mut e.simulated, "rbd", 0.0101), 0),
            (|e| set(&mut e.simulated, "rbd-kernel", 0.0121), 1),
            (|e| set(&mut e.real, "rbd", 0.1), 2),
            (|e| set(&mut e.real, "gp-rbd", 0.111), 3),
            (|e| set(&mut e.outside, "named", 0.31), 4),
        ];
        for (change, fails) in changes {
            let mut errors = errors();
            change(&mut errors);
            let expected: Vec<bool> = (0..5).map(|claim| claim != fails).collect();
            assert_eq!(outcomes(&errors), expected, "claim {fails}");
        }
    }

    #[test]
    fn every_joint_of_every_model_is_a_case_and_models_that_are_not_there_are_none() {
        let mut errors = errors();
        let counts = |errors: &LearningErrors| -> Vec<usize> {
            learning_claims(errors).iter().map(|claim| claim.cases.len()).collect()
        };
        assert_eq!(counts(&errors), [2, 6, 6, 6, 8]);
        errors.outside.clear();
        errors.real.retain(|model| model.model != "gp");
        assert_eq!(counts(&errors), [2, 6, 6, 0, 0]);
        assert_eq!(learning_claims(&errors)[4].verdict, ClaimVerdict::NotJudged);
        assert_eq!(errors.outside_gain(0), None);
    }

    #[test]
    fn the_named_effects_are_held_against_the_best_process() {
        let gain = errors().outside_gain(1).unwrap();
        assert!((gain - 0.3 / 0.02).abs() < 1e-12, "{gain}");
    }
}
