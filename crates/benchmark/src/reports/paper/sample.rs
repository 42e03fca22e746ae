//! Small results made by hand, for the tests of this module.

use experiment::{Claim, ClaimCase, Scope};
use pages::Provenance;

use crate::paper::learning_errors::{LearningErrors, ModelErrors};
use crate::reports::paper::learning_figure::LearningFigureReport;
use crate::reports::sample::provenance;

/// What a [`LearningFigureReport`] borrows.
pub struct LearningFigureSample {
    pub errors: LearningErrors,
    pub claims: Vec<Claim>,
    pub provenance: Provenance,
}

impl LearningFigureSample {
    pub fn report(&self) -> LearningFigureReport<'_> {
        LearningFigureReport {
            errors: &self.errors,
            claims: &self.claims,
            outside: "a far motion",
            provenance: &self.provenance,
        }
    }
}

/// Four models of two joints; nothing is known of the second.
pub fn errors() -> LearningErrors {
    let of = |numbers: [f64; 4]| {
        let models = ["rbd", "gp", "gp-rbd", "named"].into_iter().zip(numbers);
        let errors = models.map(|(model, nmse)| ModelErrors {
            model: model.into(),
            nmse: vec![Some(nmse), None],
            rmse_nm: vec![1.0, 0.0],
        });
        errors.collect::<Vec<_>>()
    };
    LearningErrors {
        robot: "arm".into(),
        joints: vec!["shoulder".into(), "elbow".into()],
        points: 300,
        test_points: 200,
        simulated: of([0.001, 0.1, 0.001, 0.001]),
        real: of([0.5, 0.05, 0.01, 0.02]),
        outside: of([0.9, 0.3, 0.2, 0.01]),
    }
}

pub fn learning() -> LearningFigureSample {
    let case = |value: f64| ClaimCase::within("rbd", "shoulder", Some(value), 0.1);
    LearningFigureSample {
        errors: errors(),
        claims: vec![
            Claim::new("rbd is small here", Scope::Every, vec![case(0.001)]),
            Claim::new("rbd is small", Scope::Every, vec![case(0.5)]),
        ],
        provenance: provenance(),
    }
}
