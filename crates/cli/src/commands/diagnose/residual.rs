use std::path::Path;

use diagnosis::{DiagnosisRun, Verdict};
use experiment::{Residual, learn_residual};
use learner::Model;
use report::{LengthScale, ResidualJointRow, ResidualModel};
use robot::Robot;

use crate::error::CliError;
use crate::progress::Line;
use crate::watch::Watch;

/// A residual model: what is said of it, and its file.
pub struct ResidualFile {
    pub model: ResidualModel,
    pub bytes: Vec<u8>,
}

/// Name of the file of the model in the output folder.
pub const FILE: &str = "models/named-gp.parquet";

/// Learns the process of what the findings of a diagnosis leave.
pub fn learn(
    robot: &Robot,
    outcome: &DiagnosisRun,
    line: Option<Line>,
) -> Result<ResidualFile, CliError> {
    let watch = Watch::new(line)?;
    let residual = learn_residual(robot, outcome, &watch);
    watch.finish();
    let residual = residual?;
    Ok(ResidualFile { model: model(outcome, &residual), bytes: bytes(&residual.model)? })
}

fn model(outcome: &DiagnosisRun, residual: &Residual) -> ResidualModel {
    let joints = outcome.diagnosis.joints.iter().zip(&residual.joints);
    let mut remarks = effects::omissions(&outcome.extended);
    if residual.is_cut_short {
        remarks.push("Ctrl-C ended searches of it before they converged".to_owned());
    }
    ResidualModel {
        model: residual.model.kind.name(),
        words: residual.model.kind.words(),
        file: FILE.to_owned(),
        points: residual.model.process.as_ref().map_or(0, |process| process.sum.len()),
        parts: residual.parts,
        joints: joints.map(|(joint, residual)| joint_of(joint, residual)).collect(),
        remarks,
    }
}

fn joint_of(
    joint: &diagnosis::JointReport,
    residual: &experiment::ResidualJoint,
) -> ResidualJointRow {
    // Where everything has a name, nothing is to be said of what it bends with.
    let is_left = matches!(joint.verdict, Verdict::PartlyExplained | Verdict::Unexplained);
    let scales = residual.relevance.iter().filter(|_| is_left);
    let scale = |r: &experiment::Relevance| LengthScale {
        signal: r.signal.clone(),
        share_of_range: r.share_of_range,
    };
    ResidualJointRow {
        name: joint.name.clone(),
        extended_rms_nm: residual.extended_rms,
        with_residual_rms_nm: residual.with_process_rms,
        share: residual.share(),
        better_in: residual.better_in,
        is_used: residual.is_used,
        length_scales: scales.map(scale).collect(),
    }
}

/// The file of a model.
fn bytes(model: &Model) -> Result<Vec<u8>, CliError> {
    Ok(model.bytes(Path::new(FILE))?)
}
