use std::path::Path;

use diagnosis::{Outcome, Verdict};
use experiment::{Residual, learn_residual};
use learner::Model;
use report::{LengthScale, ResidualJoint, ResidualModel};
use robot::Robot;

use crate::error::CliError;
use crate::progress::Line;
use crate::watch::Watch;

/// A residual model: what is said of it, and its file.
pub struct Learned {
    pub said: ResidualModel,
    pub bytes: Vec<u8>,
}

/// Name of the file of the model in the output folder.
pub const FILE: &str = "models/named-gp.parquet";

/// Learns the process of what the findings of a diagnosis leave.
pub fn learn(robot: &Robot, outcome: &Outcome, line: Option<Line>) -> Result<Learned, CliError> {
    let watch = Watch::new(line)?;
    let learned = learn_residual(robot, outcome, &watch);
    watch.finish();
    let learned = learned?;
    Ok(Learned { said: said(outcome, &learned), bytes: bytes(&learned.model)? })
}

fn said(outcome: &Outcome, learned: &Residual) -> ResidualModel {
    let joints = outcome.diagnosis.joints.iter().zip(&learned.joints);
    let mut remarks = effects::left_out(&outcome.extended);
    if learned.is_cut_short {
        remarks.push("Ctrl-C ended searches of it before they converged".to_owned());
    }
    ResidualModel {
        model: learned.model.kind.name(),
        words: learned.model.kind.words(),
        file: FILE.to_owned(),
        points: learned.model.process.as_ref().map_or(0, |process| process.sum.len()),
        parts: learned.parts,
        joints: joints.map(|(joint, learned)| said_of(joint, learned)).collect(),
        remarks,
    }
}

fn said_of(joint: &diagnosis::JointReport, learned: &experiment::ResidualJoint) -> ResidualJoint {
    // Where everything has a name, nothing is to be said of what it bends with.
    let is_left = matches!(joint.verdict, Verdict::PartlyExplained | Verdict::Unexplained);
    let scales = learned.relevance.iter().filter(|_| is_left);
    let scale = |r: &experiment::Relevance| LengthScale {
        signal: r.signal.clone(),
        share_of_range: r.share_of_range,
    };
    ResidualJoint {
        name: joint.name.clone(),
        extended_rms_nm: learned.extended_rms,
        with_residual_rms_nm: learned.with_process_rms,
        share: learned.share(),
        better_in: learned.better_in,
        is_used: learned.is_used,
        length_scales: scales.map(scale).collect(),
    }
}

/// The file of a model.
fn bytes(model: &Model) -> Result<Vec<u8>, CliError> {
    Ok(model.bytes(Path::new(FILE))?)
}
