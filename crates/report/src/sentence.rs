use diagnosis::{Diagnosis, JointReport, Verdict};

use crate::Report;
use crate::numbers::{percent, significant};
use crate::places::{counted, listed};

/// The verdict over all joints in one sentence.
pub fn verdict_sentence(diagnosis: &Diagnosis) -> String {
    let Diagnosis { robot, joints, findings, verdict, .. } = diagnosis;
    let effects = counted(findings.len(), "named effect");
    let left = at_joints(joints, |v| matches!(v, Verdict::PartlyExplained | Verdict::Unexplained));
    match verdict {
        Verdict::Consistent => {
            format!("Consistent: the model of {robot} explains the log down to its noise floor")
        }
        Verdict::Explained => format!(
            "Explained: {effects} {} what the model of {robot} gets wrong",
            verb(findings.len())
        ),
        Verdict::PartlyExplained => {
            format!(
                "Partly explained: {effects} found in the model of {robot}, structure is left at {left}"
            )
        }
        Verdict::Unexplained => format!(
            "Unexplained: the model of {robot} misses structure at {left}, and no effect of the catalogue reproduces it"
        ),
        Verdict::DataInadequate => {
            format!("Data inadequate: this log cannot show what the model of {robot} gets wrong")
        }
    }
}

fn verb(count: usize) -> &'static str {
    if count == 1 { "accounts for" } else { "account for" }
}

fn at_joints(joints: &[JointReport], wanted: impl Fn(Verdict) -> bool) -> String {
    let names: Vec<String> =
        joints.iter().filter(|j| wanted(j.verdict)).map(|j| j.name.clone()).collect();
    match names.len() {
        0 => "no joint".to_owned(),
        n if n == joints.len() && n > 1 => "every joint".to_owned(),
        1..=4 => {
            format!("{} {}", if names.len() == 1 { "joint" } else { "joints" }, listed(&names))
        }
        n => format!("{n} of {} joints", joints.len()),
    }
}

/// What the extended model buys on held-out data, in one sentence with numbers.
///
/// Over all joints: root of the sum of squared errors where every joint turns, mean nMSE
/// where units differ.
pub fn bottom_line(report: &Report) -> String {
    let gain = &report.diagnosis.gain.inverse;
    let turns = report.robot.links().iter().all(|l| l.joint.kind.is_rotation());
    let (before, after) = if turns {
        (root_of_squares(&gain.rms_before_nm), root_of_squares(&gain.rms_after_nm))
    } else {
        (mean(&gain.nmse_before), mean(&gain.nmse_after))
    };
    let what = if turns { "the torque error" } else { "the mean nMSE of the torque" };
    let unit = if turns { " N·m RMS" } else { "" };
    let held_out = &gain.held_out;
    if !(before.is_finite() && after.is_finite() && before > 0.0) {
        return "No joint has held-out data on which a gain could be measured".to_owned();
    }
    let fall = 1.0 - after / before;
    let (before, after) = (significant(before, 3), significant(after, 3));
    if fall.abs() < 0.0005 {
        return format!("On held-out data ({held_out}) {what} over all joints is {before}{unit}");
    }
    let way = if fall > 0.0 { "falls" } else { "rises" };
    format!(
        "On held-out data ({held_out}) {what} over all joints {way} from {before} to {after}{unit} ({} {})",
        percent(fall.abs()),
        if fall > 0.0 { "less" } else { "more" }
    )
}

fn root_of_squares(values: &[f64]) -> f64 {
    let finite = values.iter().filter(|v| v.is_finite());
    finite.map(|v| v * v).sum::<f64>().sqrt()
}

fn mean(values: &[f64]) -> f64 {
    let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    finite.iter().sum::<f64>() / finite.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn the_sentence_names_the_joints_where_structure_is_left() {
        let sample = sample::arm();
        assert_eq!(
            verdict_sentence(&sample.diagnosis),
            "Partly explained: 2 named effects found in the model of arm, structure is left at joint elbow"
        );
    }

    #[test]
    fn the_bottom_line_adds_squares_over_the_joints() {
        let mut sample = sample::arm();
        let gain = &mut sample.diagnosis.gain.inverse;
        (gain.rms_before_nm, gain.rms_after_nm) = (vec![3.0, 4.0], vec![0.6, 0.8]);
        assert_eq!(
            bottom_line(&sample.report()),
            "On held-out data (each run in turn) the torque error over all joints falls from 5.00 to 1.00 N·m RMS (80 % less)"
        );
    }
}
