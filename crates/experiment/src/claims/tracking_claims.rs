use learner::ModelKind;

use crate::claims::claim::{Claim, ClaimCase, Scope};
use crate::claims::paper_models::{PROCESSES, SEMIPARAMETRIC};
use crate::tracking::tracked_error::TrackedError;

/// Joints of the elbow and the wrist of a WAM, where the paper sees the largest gain.
const ELBOW_AND_WRIST: [usize; 3] = [3, 4, 5];

/// The claims of Nguyen-Tuong & Peters 2010 about figures 3 and 4, and the claims about the named effects, judged by
/// the errors of the runs. Empty unless all models of the paper were fed forward.
pub fn tracking_claims(errors: &[TrackedError], joints: &[String]) -> Vec<Claim> {
    let find = |kind: ModelKind| errors.iter().find(|error| error.model == kind.name());
    let paper = [ModelKind::Rbd].into_iter().chain(PROCESSES);
    if paper.into_iter().any(|kind| find(kind).is_none()) {
        return Vec::new();
    }
    let cases = |kinds: &[ModelKind], other: ModelKind, which: &[usize], factor: f64| {
        let of = |kind: ModelKind, j: usize| find(kind)?.rms.as_ref()?.get(j).copied();
        let cases = kinds.iter().flat_map(|&kind| {
            which.iter().filter_map(move |&j| {
                let subject = (kind.name(), of(kind, j));
                let other = (other.name(), of(other, j));
                Some(ClaimCase::beside(subject, other, joints.get(j)?, (factor, 0.0)))
            })
        });
        cases.collect::<Vec<ClaimCase>>()
    };
    let all: Vec<usize> = (0..joints.len()).collect();
    let mut claims = vec![
        Claim::new(
            "with the semiparametric models the arm follows more closely than with rigid bodies",
            Scope::Every,
            cases(&SEMIPARAMETRIC, ModelKind::Rbd, &all, 1.0),
        ),
        Claim::new(
            "in most cases more closely than with the Gaussian process, too",
            Scope::Most,
            cases(&SEMIPARAMETRIC, ModelKind::Gp, &all, 1.0),
        ),
        Claim::new(
            "at the elbow and the wrist with at most half the error of rigid bodies",
            Scope::Every,
            cases(&SEMIPARAMETRIC, ModelKind::Rbd, &ELBOW_AND_WRIST, 0.5),
        ),
    ];
    if find(ModelKind::Named).is_some() {
        let named = [ModelKind::Named];
        let beside = PROCESSES.iter().flat_map(|&process| cases(&named, process, &all, 1.0));
        claims.push(Claim::new(
            "with the named effects more closely than with every Gaussian process",
            Scope::Every,
            beside.collect(),
        ));
    }
    claims
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::claim::ClaimVerdict;

    fn tracked_error(model: &str, rms: [f64; 6]) -> TrackedError {
        TrackedError {
            model: model.into(),
            rms: Some(rms.to_vec()),
            tip_rms_m: Some(0.01),
            feedback_share: vec![0.1; 6],
        }
    }

    fn joints() -> Vec<String> {
        (1..=6).map(|j| format!("j{j}")).collect()
    }

    fn errors() -> Vec<TrackedError> {
        vec![
            tracked_error("rbd", [50.0; 6]),
            tracked_error("gp", [20.0; 6]),
            tracked_error("gp-rbd", [4.0; 6]),
            tracked_error("gp-rbd-prior", [4.0; 6]),
            tracked_error("rbd-kernel", [8.0; 6]),
            tracked_error("named", [1.0; 6]),
        ]
    }

    #[test]
    fn every_claim_is_held_or_not_by_the_run_that_it_is_about() {
        let outcomes = |errors: &[TrackedError]| -> Vec<bool> {
            let claims = tracking_claims(errors, &joints());
            claims.iter().map(|claim| claim.verdict == ClaimVerdict::Holds).collect()
        };
        assert_eq!(outcomes(&errors()), [true; 4]);
        let with = |model: usize, rms: [f64; 6]| {
            let mut errors = errors();
            errors[model].rms = Some(rms.to_vec());
            outcomes(&errors)
        };
        // Joint 1 is neither elbow nor wrist.
        assert_eq!(with(2, [51.0, 4.0, 4.0, 4.0, 4.0, 4.0]), [false, true, true, true]);
        assert_eq!(with(1, [3.0, 3.0, 3.0, 20.0, 20.0, 20.0]), [true, false, true, true]);
        assert_eq!(with(3, [4.0, 4.0, 4.0, 4.0, 4.0, 26.0]), [true, true, false, true]);
        assert_eq!(with(5, [4.1, 1.0, 1.0, 1.0, 1.0, 1.0]), [true, true, true, false]);
        let mut stopped = errors();
        stopped[2].rms = None;
        assert_eq!(outcomes(&stopped), [false, true, false, false], "a run without an end");
    }

    #[test]
    fn without_all_of_the_papers_models_nothing_is_claimed() {
        let mut errors = errors();
        errors.pop();
        assert_eq!(tracking_claims(&errors, &joints()).len(), 3);
        errors.remove(1);
        assert!(tracking_claims(&errors, &joints()).is_empty());
    }
}
