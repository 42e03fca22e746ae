use catalogue::EffectKind;
use diagnosis::{EffectAt, Estimate, Finding, JointReport, NoiseFloorSource, Verdict};

use crate::diagnosis::estimate::interval;
use crate::diagnosis::places::{JointUnits, joint_anchor, joint_of};
use crate::diagnosis::report::Report;
use pages::{percent, significant, unit};

/// One row of the table before and after, as text.
pub(crate) struct JointRow {
    pub name: String,
    pub verdict: &'static str,
    /// Class of the verdict in the style sheet.
    pub class: &'static str,
    pub because: String,
    pub unit: &'static str,
    pub torque: String,
    pub before: String,
    pub after: String,
    pub floor: String,
    /// What is taken for noise, in a word and in a sentence.
    pub floor_from: [&'static str; 2],
    /// Whether the logs say anything of the joint.
    pub adequate: bool,
    pub nmse_before: String,
    pub nmse_after: String,
    pub effective_samples: String,
    /// Error over torque, before, after and at the floor, as lengths of bars (per cent).
    pub bars: [f64; 3],
}

/// The rows of the table before and after, in the order of the joints.
pub(crate) fn joint_rows(report: &Report) -> Vec<JointRow> {
    let gain = &report.diagnosis.gain.inverse;
    let at = |values: &[f64], index: usize| values.get(index).copied().unwrap_or(f64::NAN);
    let rows = report.diagnosis.joints.iter().enumerate().map(|(i, joint)| {
        let (before, after) = (at(&gain.rms_before_nm, i), at(&gain.rms_after_nm, i));
        let bar = |rms: f64| length_of_bar(rms / joint.torque_rms_nm);
        let units = JointUnits::of(report.robot, &joint.name);
        JointRow {
            name: joint.name.clone(),
            verdict: joint.verdict.words(),
            class: class_of(joint.verdict),
            because: units.with_unit(&joint.because),
            unit: units.effort,
            torque: significant(joint.torque_rms_nm, 3),
            before: significant(before, 3),
            after: significant(after, 3),
            floor: match joint.noise_floor_from {
                NoiseFloorSource::Unknown => "-".to_owned(),
                _ => significant(joint.noise_floor_rms_nm, 3),
            },
            floor_from: words_for_floor(joint.noise_floor_from),
            adequate: joint.verdict != Verdict::DataInadequate,
            nmse_before: significant(at(&gain.nmse_before, i), 2),
            nmse_after: significant(at(&gain.nmse_after, i), 2),
            effective_samples: significant(joint.effective_samples, 3),
            bars: [bar(before), bar(after), bar(joint.noise_floor_rms_nm)],
        }
    });
    rows.collect()
}

fn length_of_bar(share: f64) -> f64 {
    if share.is_finite() { (1000.0 * share.clamp(0.0, 1.0)).round() / 10.0 } else { 0.0 }
}

/// RMS of the noise at a joint (N m or N), where the logs tell it.
pub(crate) fn known_floor(joint: &JointReport) -> Option<f64> {
    let floor = joint.noise_floor_rms_nm;
    (joint.noise_floor_from != NoiseFloorSource::Unknown && floor > 0.0 && floor.is_finite())
        .then_some(floor)
}

/// Class of a verdict in the style sheet.
pub(crate) fn class_of(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Consistent | Verdict::Explained => "good",
        Verdict::PartlyExplained => "part",
        Verdict::Unexplained => "bad",
        Verdict::DataInadequate => "none",
    }
}

/// What is taken for noise at a joint, in a word and in a sentence.
pub(crate) fn words_for_floor(source: NoiseFloorSource) -> [&'static str; 2] {
    match source {
        NoiseFloorSource::Repeats => ["repeats", "what differs between runs of one motion"],
        NoiseFloorSource::Effort => {
            ["effort", "the effort's own noise, above the motion or of its step"]
        }
        NoiseFloorSource::Encoders => {
            ["encoders", "noise of the encoders, carried by the arm's inertia"]
        }
        NoiseFloorSource::Unknown => ["unknown", "of which the logs tell nothing"],
    }
}

/// The parameters of a finding that the logs determine, as text: name where it has several, value
/// with interval, and nominal value.
pub fn sizes(finding: &Finding) -> Vec<String> {
    let known = finding.parameters.iter().filter(|p| p.determined);
    known.map(|p| size(p, finding.parameters.len())).collect()
}

/// The logs show the effect, and none of its sizes. A link's moments are sizes that are no parameters of a finding.
pub(crate) fn has_no_size(finding: &Finding) -> bool {
    let is_whole_link = finding.at.effect == EffectKind::InertialParameters;
    !is_whole_link && finding.parameters.iter().all(|p| !p.determined)
}

/// The size of one of `count` parameters.
pub(crate) fn size(parameter: &Estimate, count: usize) -> String {
    let name = if count == 1 { String::new() } else { parameter.name.replace('_', " ") + " " };
    // What was rigid had no stiffness to tell.
    let was = if parameter.nominal.abs() > 0.0 && parameter.nominal.is_finite() {
        format!(", was {}", significant(parameter.nominal, 3))
    } else {
        String::new()
    };
    format!("{name}{}{was}", interval(parameter))
}

/// The effect and its code, with its link where it has one: a joint stands elsewhere.
pub(crate) fn name_beside_joint(at: &EffectAt) -> String {
    let link = at.link.as_ref().map(|l| format!(" of {l}")).unwrap_or_default();
    format!("{}{link}", at.effect.label())
}

/// A finding as text.
pub(crate) struct Cause {
    pub code: &'static str,
    pub effect: &'static str,
    pub place: String,
    /// Where the page has the figures of its joint.
    pub anchor: Option<String>,
    pub equation: &'static str,
    pub signature: &'static str,
    pub parameters: Vec<ParameterRow>,
    pub share: String,
    pub share_bar: f64,
    pub gain: String,
    pub log_evidence: String,
    pub rivals: Vec<String>,
    pub forms: Vec<String>,
    pub told_apart_by: Option<&'static str>,
    pub evidence: Vec<String>,
    pub undetermined: Vec<String>,
}

/// A parameter as text.
pub(crate) struct ParameterRow {
    pub name: String,
    pub meaning: &'static str,
    pub value: String,
    pub nominal: String,
    pub determined: bool,
}

/// A finding as text.
pub(crate) fn cause(report: &Report, finding: &Finding) -> Cause {
    let entry = finding.at.effect.entry();
    let joint = joint_of(report, &finding.at).and_then(|i| report.diagnosis.joints.get(i));
    let units = JointUnits::of(report.robot, joint.map_or("", |j| &j.name));
    let (rivals, forms) = finding.rivals();
    Cause {
        code: finding.at.effect.code(),
        effect: finding.at.effect.words(),
        place: place_of(&finding.at),
        anchor: joint_of(report, &finding.at).map(joint_anchor),
        equation: entry.equation,
        signature: entry.signature,
        parameters: finding
            .parameters
            .iter()
            .map(|p| parameter_row(p, finding.at.effect))
            .collect(),
        share: percent(finding.share_explained),
        share_bar: length_of_bar(finding.share_explained),
        gain: percent(finding.held_out_gain),
        log_evidence: significant(finding.log_evidence, 3),
        rivals,
        forms,
        told_apart_by: finding.told_apart_by,
        evidence: finding.evidence.iter().map(|line| units.with_unit(line)).collect(),
        undetermined: finding.undetermined.clone(),
    }
}

/// Where an effect acts, in words.
pub(crate) fn place_of(at: &EffectAt) -> String {
    match (&at.joint, &at.link) {
        (Some(joint), _) => format!("at joint {joint}"),
        (None, Some(link)) => format!("of link {link}"),
        (None, None) => "of the whole robot".to_owned(),
    }
}

fn parameter_row(estimate: &Estimate, kind: EffectKind) -> ParameterRow {
    let entry = kind.entry();
    let known = entry.parameters.iter().find(|p| p.name == estimate.name);
    let unit = unit(estimate.unit);
    let space = if unit.is_empty() { "" } else { " " };
    ParameterRow {
        name: estimate.name.replace('_', " "),
        meaning: known.map_or("", |p| p.meaning),
        value: interval(estimate),
        nominal: format!("{}{space}{unit}", significant(estimate.nominal, 3)),
        determined: estimate.determined,
    }
}
