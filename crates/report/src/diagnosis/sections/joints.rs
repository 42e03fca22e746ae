use askama::Template;
use diagnosis::Verdict;
use pages::{Chart, ReportError};

use crate::diagnosis::joint_charts::figures_of;
use crate::diagnosis::places::{joint_anchor, joint_of};
use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;
use crate::diagnosis::tables::{class_of, name_beside_joint};

/// The signals and the errors of every joint, drawn.
#[derive(Template)]
#[template(path = "diagnosis/sections/joints.html")]
pub(crate) struct Joints {
    /// The joints with adequate data first.
    joints: Vec<JointFigures>,
}

impl<'a> Section<'a> for Joints {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        let joints = report.diagnosis.joints.iter().enumerate();
        let (adequate, inadequate): (Vec<_>, Vec<_>) =
            joints.partition(|(_, joint)| joint.verdict != Verdict::DataInadequate);
        let joints = adequate.into_iter().chain(inadequate).map(|(i, joint)| {
            let figures = figures_of(report, i);
            let at_it =
                report.diagnosis.findings.iter().filter(|f| joint_of(report, &f.at) == Some(i));
            let findings: Vec<String> = at_it.map(|f| name_beside_joint(&f.at)).collect();
            Ok(JointFigures {
                name: joint.name.clone(),
                anchor: joint_anchor(i),
                verdict: joint.verdict.words(),
                class: class_of(joint.verdict),
                is_open: !findings.is_empty(),
                findings,
                time: figures.time.into_iter().map(Figure::over_time).collect::<Result<_, _>>()?,
                residual: figures
                    .residual
                    .into_iter()
                    .map(Figure::new)
                    .collect::<Result<_, _>>()?,
            })
        });
        Ok(Some(Self { joints: joints.collect::<Result<_, ReportError>>()? }))
    }
}

/// The figures of one joint.
struct JointFigures {
    name: String,
    anchor: String,
    verdict: &'static str,
    class: &'static str,
    /// The effects that were found at it, for which its figures are shown without a click.
    findings: Vec<String>,
    is_open: bool,
    time: Vec<Figure>,
    residual: Vec<Figure>,
}

/// A figure that is already drawn.
struct Figure {
    title: String,
    svg: String,
}

impl Figure {
    fn new(chart: Chart) -> Result<Self, ReportError> {
        Ok(Self { svg: chart.in_page()?, title: chart.title })
    }

    /// Torque over time and what is left of it below, on one axis of time.
    fn over_time([torque, left]: [Chart; 2]) -> Result<Self, ReportError> {
        let title = torque.title.clone();
        Ok(Self { svg: torque.in_page()? + &left.in_page()?, title })
    }
}
