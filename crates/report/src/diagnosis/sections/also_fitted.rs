use askama::Template;
use diagnosis::FittedParameter;
use pages::{ReportError, significant};

use crate::diagnosis::places::JointUnits;
use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;
use crate::diagnosis::tables::place_of;

/// What the extended robot has beside the findings, and what it does for the prediction.
#[derive(Template)]
#[template(path = "diagnosis/sections/also_fitted.html")]
pub(crate) struct AlsoFittedParameters {
    joints: Vec<ErrorRow>,
    parameters: Vec<ParameterRow>,
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
        let row = |parameter: &FittedParameter| ParameterRow {
            place: place_of(&parameter.at),
            effect: parameter.at.effect.label(),
            name: parameter.name,
            before: significant(parameter.before, 3),
            value: significant(parameter.value, 3),
            unit: parameter.unit,
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
struct ParameterRow {
    place: String,
    effect: String,
    name: &'static str,
    before: String,
    value: String,
    unit: &'static str,
}
