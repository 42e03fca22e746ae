use diagnosis::{Diagnosis, Finding, JointReport, Verdict};

use crate::diagnosis::report::Report;
use crate::diagnosis::tables::has_no_size;
use pages::{count_noun, join_names, percent, significant};

/// The verdict over all joints in one sentence.
pub fn verdict_sentence(diagnosis: &Diagnosis) -> String {
    let Diagnosis { robot, joints, findings, verdict, data, .. } = diagnosis;
    let effects = count_findings(findings);
    let is_open = |v| matches!(v, Verdict::PartlyExplained | Verdict::Unexplained);
    let left = at_joints(joints, is_open);
    let is_lost = |v| v == Verdict::DataInadequate;
    let shown = if joints.iter().any(|j| is_lost(j.verdict)) {
        format!(" at {}", at_joints(joints, |v| !is_lost(v)))
    } else {
        String::new()
    };
    match verdict {
        Verdict::Consistent => {
            format!("Consistent: the log gives no reason to change the model of {robot}{shown}")
        }
        Verdict::Explained => format!(
            "Explained: {effects} {} nearly all that the model of {robot} gets wrong{shown}",
            verb(findings.len())
        ),
        // Every joint that the logs show is closed: how they are to be read is open, or what others hide.
        Verdict::PartlyExplained if !joints.iter().any(|j| is_open(j.verdict)) => {
            let closed = if findings.is_empty() {
                format!("the log gives no reason to change the model of {robot}{shown}")
            } else {
                let verb = verb(findings.len());
                format!("{effects} {verb} nearly all that the model of {robot} gets wrong{shown}")
            };
            let read = ", provided that the logs are read as the warnings say";
            format!("Partly explained: {closed}{}", if data.put_right { read } else { "" })
        }
        Verdict::PartlyExplained => {
            format!(
                "Partly explained: {effects} found in the model of {robot}, {}",
                what_is_open(joints, is_open)
            )
        }
        Verdict::Unexplained => format!(
            "Unexplained: the model of {robot} misses structure at {left}, and no effect of the catalogue reproduces it"
        ),
        Verdict::DataInadequate if joints.iter().any(|j| !is_lost(j.verdict)) => {
            let lost = at_joints(joints, is_lost);
            format!(
                "Data inadequate: the log gives no reason to change the model of {robot}{shown}, and shows too little of {lost}"
            )
        }
        Verdict::DataInadequate => {
            format!("Data inadequate: this log cannot show what the model of {robot} gets wrong")
        }
    }
}

/// Where structure is left, and where the noise is as large as a cause.
fn what_is_open(joints: &[JointReport], is_open: impl Fn(Verdict) -> bool) -> String {
    let at = |is_lost: bool| -> Option<String> {
        let counts =
            |joint: &&JointReport| is_open(joint.verdict) && joint.is_lost_in_noise == is_lost;
        joints.iter().any(|joint| counts(&joint)).then(|| names_of(joints, counts))
    };
    let structure = at(false).map(|left| format!("structure is left at {left}"));
    let noise = at(true).map(|lost| format!("noise as large as a cause is left at {lost}"));
    structure.into_iter().chain(noise).collect::<Vec<_>>().join(", ")
}

/// How many effects have a name, and how many of them no size: `2 named effects (1 of unknown size)`.
fn count_findings(findings: &[Finding]) -> String {
    let open = findings.iter().filter(|f| has_no_size(f)).count();
    let named = count_noun(findings.len(), "named effect");
    match (findings.len(), open) {
        (_, 0) => named,
        (all, open) if all == open => format!("{named} of unknown size"),
        _ => format!("{named} ({open} of unknown size)"),
    }
}

fn verb(count: usize) -> &'static str {
    if count == 1 { "accounts for" } else { "account for" }
}

fn at_joints(joints: &[JointReport], wanted: impl Fn(Verdict) -> bool) -> String {
    names_of(joints, |joint| wanted(joint.verdict))
}

fn names_of(joints: &[JointReport], wanted: impl Fn(&&JointReport) -> bool) -> String {
    let names: Vec<String> = joints.iter().filter(wanted).map(|j| j.name.clone()).collect();
    match names.len() {
        0 => "no joint".to_owned(),
        n if n == joints.len() && n > 1 => "every joint".to_owned(),
        1..=4 => {
            format!("{} {}", if names.len() == 1 { "joint" } else { "joints" }, join_names(&names))
        }
        n => format!("{n} of {} joints", joints.len()),
    }
}

/// The robot and its verdict, as a title.
pub(crate) fn title(diagnosis: &Diagnosis) -> String {
    let Diagnosis { robot, findings, verdict, .. } = diagnosis;
    let effects = count_findings(findings);
    match verdict {
        Verdict::Explained | Verdict::PartlyExplained => {
            format!("{robot}: {} by {effects}", verdict.words())
        }
        _ => format!("{robot}: {}", verdict.words()),
    }
}

/// What the extended model buys on held-out data, in one sentence with numbers.
///
/// Over the joints that the logs show something of: root of the sum of squared errors where every joint turns, mean nMSE
/// where units differ. Where several joints count, also at how many of them the error falls, and by how much.
pub fn bottom_line(report: &Report) -> String {
    let total = Total::new(report);
    let Total { what, unit, over, .. } = total;
    let held_out = &report.diagnosis.gain.inverse.held_out;
    let Some(fall) = total.fall() else {
        return "The logs show no joint well enough for a gain to be measured on held-out data"
            .to_owned();
    };
    let (before, after) = total.as_shown();
    if before == after {
        return format!("On held-out data ({held_out}) the {what} over {over} is {before}{unit}");
    }
    let way = if fall > 0.0 { "falls" } else { "rises" };
    format!(
        "On held-out data ({held_out}) the {what} over {over} {way} from {before} to {after}{unit} ({}{})",
        less_or_more(fall),
        total.words_by_joint()
    )
}

/// The bottom line as a subtitle.
pub(crate) fn short_bottom_line(report: &Report) -> String {
    let total = Total::new(report);
    let Total { what, unit, over, .. } = total;
    let Some(fall) = total.fall() else { return bottom_line(report) };
    let (before, after) = total.as_shown();
    let change = if before == after { String::new() } else { format!(" ({})", less_or_more(fall)) };
    format!("Held-out {what} over {over}: {before} → {after}{unit}{change}")
}

/// The error over the joints that the logs show something of.
struct Total {
    over: &'static str,
    what: &'static str,
    unit: &'static str,
    before: f64,
    after: f64,
    /// Relative fall of the error of each of those joints.
    falls: Vec<f64>,
}

impl Total {
    fn new(report: &Report) -> Self {
        let Diagnosis { joints, gain, .. } = report.diagnosis;
        let shown = |values: &[f64]| -> Vec<f64> {
            let pairs = joints.iter().zip(values);
            pairs.filter(|(j, _)| j.verdict != Verdict::DataInadequate).map(|(_, v)| *v).collect()
        };
        let all = joints.iter().all(|j| j.verdict != Verdict::DataInadequate);
        let over = if all { "all joints" } else { "the joints that the logs show" };
        let gain = &gain.inverse;
        let [before, after] = [&gain.rms_before_nm, &gain.rms_after_nm].map(|rms| shown(rms));
        let fall = |(before, after): (&f64, &f64)| {
            if *before > 0.0 { 1.0 - after / before } else { 0.0 }
        };
        let falls = before.iter().zip(&after).map(fall).collect();
        if report.robot.links().iter().all(|l| l.joint.kind.is_rotation()) {
            let (before, after) = (root_of_squares(&before), root_of_squares(&after));
            Self { over, what: "torque error", unit: " N·m RMS", before, after, falls }
        } else {
            let (before, after) = (mean(&shown(&gain.nmse_before)), mean(&shown(&gain.nmse_after)));
            Self { over, what: "mean nMSE of torque and force", unit: "", before, after, falls }
        }
    }

    /// At how many of several joints the error falls by a tenth or more, and by half or more.
    fn words_by_joint(&self) -> String {
        let joints = self.falls.len();
        let by = |least: f64| self.falls.iter().filter(|fall| **fall >= least).count();
        match (by(0.1), by(0.5)) {
            _ if joints < 2 => String::new(),
            (0, _) => "; by less than 10 % at every joint".to_owned(),
            (_, half) if half == joints => "; by 50 % or more at every joint".to_owned(),
            (some, 0) => format!("; by 10 % or more at {some} of {joints} joints"),
            (some, half) => {
                format!("; by 10 % or more at {some} of {joints} joints, by 50 % or more at {half}")
            }
        }
    }

    /// Both with the digits that a sentence shows; a smaller change is not mentioned.
    fn as_shown(&self) -> (String, String) {
        (significant(self.before, 3), significant(self.after, 3))
    }

    /// Relative fall; none when there is nothing to compare.
    fn fall(&self) -> Option<f64> {
        let is_measured = self.before.is_finite() && self.after.is_finite() && self.before > 0.0;
        is_measured.then(|| 1.0 - self.after / self.before)
    }
}

fn less_or_more(fall: f64) -> String {
    format!("{} {}", percent(fall.abs()), if fall > 0.0 { "less" } else { "more" })
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
    fn the_sentence_says_where_noise_and_no_structure_keeps_a_joint_open() {
        let mut diagnosis = sample::arm().diagnosis;
        diagnosis.joints[1].is_lost_in_noise = true;
        let sentence = verdict_sentence(&diagnosis);
        let noise = "found in the model of arm, noise as large as a cause is left at joint elbow";
        assert!(sentence.ends_with(noise), "{sentence}");
        diagnosis.joints[0].verdict = Verdict::PartlyExplained;
        let sentence = verdict_sentence(&diagnosis);
        let both =
            "structure is left at joint shoulder, noise as large as a cause is left at joint elbow";
        assert!(sentence.ends_with(both), "{sentence}");
    }

    #[test]
    fn the_sentence_says_how_many_effects_have_no_size() {
        let mut diagnosis = sample::arm().diagnosis;
        let friction = diagnosis.findings.iter_mut().find(|f| f.at.link.is_none()).unwrap();
        friction.parameters.iter_mut().for_each(|p| p.determined = false);
        let sentence = verdict_sentence(&diagnosis);
        assert!(sentence.contains(": 2 named effects (1 of unknown size) found in"), "{sentence}");
        diagnosis.findings.retain(has_no_size);
        let sentence = verdict_sentence(&diagnosis);
        assert!(sentence.contains(": 1 named effect of unknown size found in"), "{sentence}");
    }

    #[test]
    fn the_sentence_leaves_out_joints_of_which_the_logs_show_nothing() {
        let mut diagnosis = sample::arm().diagnosis;
        let first = diagnosis.joints[0].name.clone();
        (diagnosis.joints[0].verdict, diagnosis.joints[1].verdict) =
            (Verdict::Explained, Verdict::DataInadequate);
        diagnosis.verdict = Verdict::Explained;
        let sentence = verdict_sentence(&diagnosis);
        assert!(sentence.ends_with(&format!("gets wrong at joint {first}")), "{sentence}");
    }

    #[test]
    fn the_sentence_says_what_keeps_an_answer_open_whose_joints_are_closed() {
        let mut diagnosis = sample::arm().diagnosis;
        let names: Vec<String> = diagnosis.joints.iter().map(|j| j.name.clone()).collect();
        diagnosis.joints.iter_mut().for_each(|j| j.verdict = Verdict::Explained);
        (diagnosis.verdict, diagnosis.data.put_right) = (Verdict::PartlyExplained, true);
        let sentence = verdict_sentence(&diagnosis);
        let read = "gets wrong, provided that the logs are read as the warnings say";
        assert!(sentence.ends_with(read), "{sentence}");
        diagnosis.data.put_right = false;
        diagnosis.joints[1].verdict = Verdict::DataInadequate;
        let sentence = verdict_sentence(&diagnosis);
        assert!(sentence.ends_with(&format!("gets wrong at joint {}", names[0])), "{sentence}");
        diagnosis.joints[0].verdict = Verdict::Consistent;
        diagnosis.verdict = Verdict::DataInadequate;
        let sentence = verdict_sentence(&diagnosis);
        assert!(
            sentence.ends_with(&format!("shows too little of joint {}", names[1])),
            "{sentence}"
        );
    }

    #[test]
    fn the_bottom_line_leaves_out_joints_of_which_the_logs_show_nothing() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[1].verdict = Verdict::DataInadequate;
        let gain = &mut sample.diagnosis.gain.inverse;
        (gain.rms_before_nm, gain.rms_after_nm) = (vec![3.0, 4.0], vec![0.6, 0.8]);
        assert_eq!(
            bottom_line(&sample.report()),
            "On held-out data (each run in turn) the torque error over the joints that the logs show falls from 3.00 to 0.600 N·m RMS (80 % less)"
        );
    }

    #[test]
    fn the_bottom_line_says_at_how_many_joints_the_error_falls() {
        let mut sample = sample::arm();
        sample.diagnosis.gain.inverse.rms_before_nm = vec![3.0, 4.0];
        let cases = [
            ([2.9, 3.9], "; by less than 10 % at every joint)"),
            ([2.4, 4.1], "; by 10 % or more at 1 of 2 joints)"),
            ([1.4, 3.2], "; by 10 % or more at 2 of 2 joints, by 50 % or more at 1)"),
        ];
        for (after, words) in cases {
            sample.diagnosis.gain.inverse.rms_after_nm = after.to_vec();
            let line = bottom_line(&sample.report());
            assert!(line.ends_with(words), "{line}");
        }
    }

    #[test]
    fn the_bottom_line_adds_squares_over_the_joints() {
        let mut sample = sample::arm();
        let gain = &mut sample.diagnosis.gain.inverse;
        (gain.rms_before_nm, gain.rms_after_nm) = (vec![3.0, 4.0], vec![0.6, 0.8]);
        assert_eq!(
            bottom_line(&sample.report()),
            "On held-out data (each run in turn) the torque error over all joints falls from 5.00 to 1.00 N·m RMS (80 % less; by 50 % or more at every joint)"
        );
    }
}
