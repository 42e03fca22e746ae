use askama::Template;
use diagnosis::FittedParameter;
use pages::{ReportError, significant, unit};

use crate::diagnosis::places::JointUnits;
use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;
use crate::diagnosis::tables::place_of;

/// What the extended robot has beside the findings, and what it does for the prediction.
#[derive(Template)]
#[template(path = "diagnosis/sections/also_fitted.html")]
pub(crate) struct AlsoFittedParameters {
    joints: Vec<ErrorRow>,
    parameters: Vec<FittedRow>,
}

impl<'a> Section<'a> for AlsoFittedParameters {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        let diagnosis = report.diagnosis;
        let Some(also) = &diagnosis.also_fitted else { return Ok(None) };
        let errors = also.rms_named_nm.iter().zip(&diagnosis.gain.inverse.rms_after_nm);
        let row = |(joint, (named, all)): (&diagnosis::JointReport, (&f64, &f64))| ErrorRow {
            joint: joint.name.clone(),
            named: significant(*named, 3),
            all: significant(*all, 3),
            unit: JointUnits::of(report.robot, &joint.name).effort.to_owned(),
        };
        let joints = diagnosis.joints.iter().zip(errors).map(row).collect();
        let row = |parameter: &FittedParameter| FittedRow {
            place: place_of(&parameter.at),
            effect: parameter.at.effect.label(),
            name: parameter.name.replace('_', " "),
            before: significant(parameter.before, 3),
            value: significant(parameter.value, 3),
            unit: unit(parameter.unit),
        };
        let parameters = also.parameters.iter().map(row).collect();
        Ok(Some(Self { joints, parameters }))
    }
}

/// Held-out error of a joint with the findings alone and with everything, as text.
struct ErrorRow {
    joint: String,
    named: String,
    all: String,
    unit: String,
}

/// A parameter in the robot with the findings alone and in the extended robot, as text.
struct FittedRow {
    place: String,
    effect: String,
    name: String,
    before: String,
    value: String,
    unit: String,
}
