use anstyle::{AnsiColor, Style};
use diagnosis::{Finding, JointReport, NoiseFloorSource, Verdict};

use crate::diagnosis::forward::forward_sentence;
use crate::diagnosis::places::{JointUnits, acting_on, findings_of};
use crate::diagnosis::report::Report;
use crate::diagnosis::sentence::{bottom_line, verdict_sentence};
use crate::diagnosis::tables::{has_no_size, name_beside_joint, sizes, words_for_floor};
use pages::{
    BOLD, FAINT, TERMINAL_WIDTH, count_noun, join_names, pack, percent, push_entry, push_warnings,
    significant, wrap,
};

/// The verdict as text for a terminal of 100 columns, with colours as escape codes that
/// `anstream` removes where they are not wanted.
///
/// The first line is the verdict in a sentence, the second the gain of the extended model. The words
/// of the blocks are explained next. Then comes one block a joint: its findings, the largest share
/// first, their rivals, and the error that is left. Joints with inadequate data come last.
pub fn text(report: &Report) -> String {
    let diagnosis = report.diagnosis;
    let style = style_of(diagnosis.verdict).bold();
    let mut out = String::new();
    for line in wrap(&format!("{}.", verdict_sentence(diagnosis)), TERMINAL_WIDTH) {
        out.push_str(&format!("{style}{line}{style:#}\n"));
    }
    for line in wrap(&format!("{}.", bottom_line(report)), TERMINAL_WIDTH) {
        out.push_str(&format!("{line}\n"));
    }
    for line in
        forward_sentence(report).iter().flat_map(|said| wrap(&format!("{said}."), TERMINAL_WIDTH))
    {
        out.push_str(&format!("{line}\n"));
    }
    legend(&mut out, report);
    let shared = findings_of(report, None);
    if !shared.is_empty() {
        out.push_str(&format!("\n{BOLD}links and whole robot{BOLD:#}\n"));
        shared.iter().for_each(|f| finding(&mut out, f));
    }
    let joints = diagnosis.joints.iter().enumerate();
    let (adequate, inadequate): (Vec<_>, Vec<_>) = joints.partition(|(_, j)| is_adequate(j));
    for (index, joint) in adequate {
        out.push('\n');
        block(&mut out, report, index, joint);
    }
    out.push_str(if inadequate.is_empty() { "" } else { "\n" });
    inadequate_joints(&mut out, report, inadequate);
    also_fitted(&mut out, report);
    residual(&mut out, report);
    motions(&mut out, &diagnosis.findings);
    push_warnings(&mut out, &diagnosis.warnings);
    out
}

/// Joints with inadequate data, those together that have the same reason.
fn inadequate_joints(out: &mut String, report: &Report, mut left: Vec<(usize, &JointReport)>) {
    let because =
        |joint: &JointReport| JointUnits::of(report.robot, &joint.name).with_unit(&joint.because);
    while let Some(&(index, first)) = left.first() {
        let reason = because(first);
        let (same, others): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|(_, joint)| because(joint) == reason);
        left = others;
        if same.len() == 1 {
            block(out, report, index, first);
            continue;
        }
        let verdict = first.verdict;
        let style = style_of(verdict);
        let names: Vec<String> = same.iter().map(|(_, joint)| joint.name.clone()).collect();
        let all = same.len() == report.diagnosis.joints.len();
        let names = if all { "all joints".to_owned() } else { join_names(&names) };
        for line in wrap(&names, TERMINAL_WIDTH) {
            out.push_str(&format!("{BOLD}{line}{BOLD:#}\n"));
        }
        out.pop();
        out.push_str(&format!(" {style}{}{style:#}\n", verdict.words()));
        note(out, &reason);
        for (_, joint) in &same {
            findings_of(report, Some(&joint.name)).iter().for_each(|f| finding(out, f));
        }
    }
}

/// Whether nothing is left open at a joint.
fn is_closed(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Consistent | Verdict::Explained)
}

/// What is seen at a joint and does not matter.
fn negligible(out: &mut String, report: &Report, joint: &str) {
    for seen in report.diagnosis.negligible.iter().filter(|n| n.most_at == joint) {
        let said = format!(
            "seen and negligible: {}, {} of the {} N m RMS that would matter",
            name_beside_joint(&seen.at),
            significant(seen.rms_nm, 2),
            significant(seen.least_nm, 2)
        );
        note(out, &JointUnits::of(report.robot, joint).with_unit(&said));
    }
}

fn is_adequate(joint: &JointReport) -> bool {
    joint.verdict != Verdict::DataInadequate
}

/// What the words in the blocks mean, only those that occur.
fn legend(out: &mut String, report: &Report) {
    let adequate = report.diagnosis.joints.iter().filter(|j| is_adequate(j));
    let words = |joint: &JointReport| {
        let [source, meaning] = words_for_floor(joint.noise_floor_from);
        match joint.noise_floor_from {
            NoiseFloorSource::Unknown => ("noise -".to_owned(), meaning),
            _ => (format!("noise ({source})"), meaning),
        }
    };
    let mut floors: Vec<(String, &str)> = adequate.map(words).collect();
    if !floors.is_empty() {
        out.push('\n');
        push_entry(
            out,
            "error",
            "measured minus predicted torque, nominal -> extended model, of the torque itself",
        );
    }
    if !report.diagnosis.findings.is_empty() {
        push_entry(
            out,
            "gap",
            "mean square of the nominal error; shares of similar causes need not add up",
        );
        push_entry(
            out,
            "gain",
            "fall of the held-out mean square error when the cause is added last",
        );
    }
    floors.sort_unstable();
    floors.dedup();
    for (word, meaning) in floors {
        push_entry(out, &word, meaning);
    }
}

/// Columns of the names of joints: of short ones, and the most of long ones.
const SHORTEST_NAME: usize = 18;
const LONGEST_NAME: usize = 22;

fn block(out: &mut String, report: &Report, index: usize, joint: &JointReport) {
    let style = style_of(joint.verdict);
    let verdict = joint.verdict.words();
    let names = report.diagnosis.joints.iter().map(|joint| joint.name.chars().count());
    let width = names.max().unwrap_or(0).clamp(SHORTEST_NAME, LONGEST_NAME);
    out.push_str(&format!("{BOLD}{:<width$}{BOLD:#} {style}{verdict}{style:#}", joint.name));
    if is_adequate(joint) {
        let gap = " ".repeat(17_usize.saturating_sub(verdict.len()));
        out.push_str(&format!("{gap} {}", errors(report, index, joint)));
    }
    out.push('\n');
    let found = findings_of(report, Some(&joint.name));
    if found.is_empty() && is_adequate(joint) {
        elsewhere(out, report, index);
    }
    let because = JointUnits::of(report.robot, &joint.name).with_unit(&joint.because);
    if found.is_empty() || !is_adequate(joint) {
        note(out, &because);
    }
    found.iter().for_each(|f| finding(out, f));
    if !found.is_empty() && is_adequate(joint) && !is_closed(joint.verdict) {
        note(out, &because);
    }
    negligible(out, report, &joint.name);
    for left in report.diagnosis.unexplained.iter().filter(|u| u.joint == joint.name) {
        let signals: Vec<String> = left
            .depends_on
            .iter()
            .map(|d| format!("{} ({})", d.signal, percent(d.share)))
            .collect();
        let follows = if signals.is_empty() {
            "follows no signal of the log".to_owned()
        } else {
            format!("follows {}", join_names(&signals))
        };
        note(out, &format!("left: {} of the gap has no name, it {follows}", percent(left.share)));
        bends(out, report, &joint.name);
    }
}

/// What the residual model makes of a joint where something is left without a name.
fn bends(out: &mut String, report: &Report, joint: &str) {
    let Some(used) = report.residual.and_then(|r| r.used_at(joint)) else { return };
    if !used.length_scales.is_empty() {
        note(out, &format!("the Gaussian process bends most with {}", used.bends_with()));
    }
}

/// What is fitted beside the findings, and where it lowers the error by most.
fn also_fitted(out: &mut String, report: &Report) {
    let diagnosis = report.diagnosis;
    let Some(also) = &diagnosis.also_fitted else { return };
    let errors = also.rms_named_nm.iter().zip(&diagnosis.gain.inverse.rms_after_nm);
    let fall = |(joint, (named, all)): (&JointReport, (&f64, &f64))| {
        (joint.name.clone(), 1.0 - all / named.max(f64::MIN_POSITIVE))
    };
    let Some((joint, fall)) =
        diagnosis.joints.iter().zip(errors).map(fall).max_by(|a, b| a.1.total_cmp(&b.1))
    else {
        return;
    };
    let sentence = format!(
        "Fitted without a name: {}, which the logs do not show one by one. The error of the extended model is smaller with them, by {} at {joint}. --only-findings leaves them out.",
        count_noun(also.parameters.len(), "parameter"),
        percent(fall)
    );
    out.push('\n');
    wrap(&sentence, TERMINAL_WIDTH).iter().for_each(|line| out.push_str(&format!("{line}\n")));
}

/// What the residual model is worth, and what to know of it.
fn residual(out: &mut String, report: &Report) {
    let Some(model) = report.residual else { return };
    out.push('\n');
    for sentence in std::iter::once(&model.sentence()).chain(&model.remarks) {
        for line in wrap(&format!("{sentence}."), TERMINAL_WIDTH) {
            out.push_str(&format!("{line}\n"));
        }
    }
}

/// What changes the torque of a joint that has no finding of its own.
fn elsewhere(out: &mut String, report: &Report, index: usize) {
    let names: Vec<String> =
        acting_on(report, index).iter().map(|f| name_beside_joint(&f.at)).collect();
    if !names.is_empty() {
        note(out, &format!("no cause of its own; affected by {}", join_names(&names)));
    }
}

/// Error before and after, torque and noise floor of a joint.
fn errors(report: &Report, index: usize, joint: &JointReport) -> String {
    let gain = &report.diagnosis.gain.inverse;
    let number = |values: &[f64]| significant(values.get(index).copied().unwrap_or(f64::NAN), 3);
    let noise = match (joint.noise_floor_from, words_for_floor(joint.noise_floor_from)) {
        (NoiseFloorSource::Unknown, _) => "-".to_owned(),
        (_, [source, _]) => format!("{} ({source})", significant(joint.noise_floor_rms_nm, 3)),
    };
    format!(
        "error {} -> {} of {} {} RMS, noise {noise}",
        number(&gain.rms_before_nm),
        number(&gain.rms_after_nm),
        significant(joint.torque_rms_nm, 3),
        JointUnits::of(report.robot, &joint.name).effort,
    )
}

/// Effect and size on one line with share and gain, then rivals and open parameters.
fn finding(out: &mut String, finding: &Finding) {
    let name = name_beside_joint(&finding.at);
    let sizes = sizes(finding);
    let worth = format!(
        "{:>6} of the gap, gain {}",
        percent(finding.share_explained),
        percent(finding.held_out_gain)
    );
    match sizes.as_slice() {
        [size] if name.chars().count() <= 24 && size.chars().count() <= 42 => {
            out.push_str(&format!("  {name:<24} {size:<43}{worth}\n"));
        }
        // What does not fit between the columns takes lines of its own.
        _ => {
            out.push_str(&format!("  {name:<68}{worth}\n"));
            for line in pack(sizes.iter().map(String::as_str), "; ", TERMINAL_WIDTH - 4) {
                out.push_str(&format!("    {line}\n"));
            }
        }
    }
    let (rivals, forms) = finding.rivals();
    if !rivals.is_empty() {
        note(out, &format!("may as well be {}", rivals.join(" or ")));
    }
    if !forms.is_empty() {
        note(out, &format!("may be {}, unseen by this log", forms.join(" or ")));
    }
    let open = finding.parameters.iter().filter(|p| !p.determined);
    let open: Vec<String> = open.map(|p| p.name.replace('_', " ")).collect();
    if has_no_size(finding) {
        note(out, "seen, its size is not determined by this log");
    } else if !open.is_empty() {
        note(out, &format!("not determined by this log: {}", open.join(", ")));
    }
}

/// The motions that would tell the findings from their rivals.
fn motions(out: &mut String, findings: &[Finding]) {
    let mut motions: Vec<&str> = findings.iter().filter_map(|f| f.told_apart_by).collect();
    motions.sort_unstable();
    motions.dedup();
    if !motions.is_empty() {
        out.push_str("\nTo tell a cause from what it may as well be, record\n");
    }
    for motion in motions {
        for (i, line) in wrap(motion, TERMINAL_WIDTH - 4).iter().enumerate() {
            out.push_str(&format!("  {} {line}\n", if i == 0 { '-' } else { ' ' }));
        }
    }
}

/// A faint line under a finding, wrapped.
fn note(out: &mut String, text: &str) {
    for line in wrap(text, TERMINAL_WIDTH - 4) {
        out.push_str(&format!("    {FAINT}{line}{FAINT:#}\n"));
    }
}

fn style_of(verdict: Verdict) -> Style {
    match verdict {
        Verdict::Consistent | Verdict::Explained => AnsiColor::Green.on_default(),
        Verdict::PartlyExplained => AnsiColor::Yellow.on_default(),
        Verdict::Unexplained => AnsiColor::Red.on_default(),
        Verdict::DataInadequate => FAINT,
    }
}

#[cfg(test)]
mod tests {
    use pages::without_escapes;

    use super::*;
    use crate::sample;

    const EXPECTED: &str = "\
Partly explained: 2 named effects found in the model of arm, structure is left at joint elbow.
On held-out data (each run in turn) the torque error over all joints falls from 2.28 to 0.640 N·m
RMS (72 % less; by 10 % or more at 2 of 2 joints, by 50 % or more at 1).

error              measured minus predicted torque, nominal -> extended model, of the torque itself
gap                mean square of the nominal error; shares of similar causes need not add up
gain               fall of the held-out mean square error when the cause is added last
noise (effort)     the effort's own noise, above the motion or of its step

links and whole robot
  IN02 inertial parameters of elbow_link                                71 % of the gap, gain 62 %
    mass 2.50 kg (2.30 to 2.70)
    not determined by this log: com y

shoulder           explained         error 2.10 -> 0.400 of 5.00 N·m RMS, noise 0.350 (effort)
  FR02 Coulomb friction    2.00 N·m (1.80 to 2.20)                      71 % of the gap, gain 62 %
    may as well be FR01 viscous friction at shoulder

elbow              partly explained  error 0.900 -> 0.500 of 5.00 N·m RMS, noise 0.350 (effort)
    no cause of its own; affected by IN02 inertial parameters of elbow_link
    the reason in a sentence
    left: 29 % of the gap has no name, it follows position of elbow (31 %)

To tell a cause from what it may as well be, record
  - constant speeds, slow and fast, in both directions

warning: elbow: quantised in steps of 0.01 N m
";

    #[test]
    fn the_text_is_one_block_a_joint_within_the_width() {
        let sample = sample::arm();
        let coloured = text(&sample.report());
        assert!(coloured.contains("\u{1b}["));
        let plain = without_escapes(&coloured);
        assert_eq!(plain, EXPECTED);
        let mut sample = sample;
        sample.diagnosis.also_fitted = Some(sample::also_fitted());
        let said = without_escapes(&text(&sample.report())).replace('\n', " ");
        let worth = "smaller with them, by 20 % at shoulder. --only-findings leaves them out.";
        assert!(said.contains("without a name: 1 parameter,") && said.contains(worth), "{said}");
        assert!(plain.lines().all(|line| line.chars().count() <= TERMINAL_WIDTH));
    }

    #[test]
    fn noise_that_the_logs_do_not_tell_is_no_number() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[0].noise_floor_from = NoiseFloorSource::Unknown;
        sample.diagnosis.joints[0].noise_floor_rms_nm = 0.0;
        let plain = without_escapes(&text(&sample.report()));
        assert!(plain.contains("of 5.00 N·m RMS, noise -\n"), "{plain}");
        assert!(plain.contains("\nnoise -            of which the logs tell nothing\n"), "{plain}");
        assert!(plain.contains("\nnoise (effort)     "), "{plain}");
    }

    #[test]
    fn a_finding_without_a_size_is_told_as_seen() {
        let mut sample = sample::arm();
        let friction = &mut sample.diagnosis.findings[0];
        friction.parameters.iter_mut().for_each(|p| p.determined = false);
        let plain = without_escapes(&text(&sample.report()));
        assert!(plain.contains("(1 of unknown size)"), "{plain}");
        assert!(plain.contains("\n    seen, its size is not determined by this log\n"), "{plain}");
        assert!(!plain.contains("not determined by this log: level"), "{plain}");
    }

    #[test]
    fn verdicts_stand_below_one_another_beside_long_names() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[0].name = "shoulder_lift_joint".to_owned();
        let plain = without_escapes(&text(&sample.report()));
        let at = |name: &str| {
            let rest = plain.lines().find_map(|line| line.strip_prefix(name)).unwrap_or_default();
            name.len() + rest.len() - rest.trim_start().len()
        };
        assert_eq!(at("shoulder_lift_joint"), 20, "{plain}");
        assert_eq!(at("elbow"), at("shoulder_lift_joint"), "{plain}");
    }

    #[test]
    fn the_residual_model_has_a_sentence_and_a_note_where_it_is_used() {
        let sample = sample::arm();
        let residual = sample::residual();
        let plain =
            without_escapes(&text(&Report { residual: Some(&residual), ..sample.report() }));
        let note = "(31 %)\n    the Gaussian process bends most with position of elbow (21 % of";
        assert!(plain.contains(note), "{plain}");
        let sentence = "\nOf what is left a Gaussian process predicts 59 % at elbow on held-out \
                        data; at 1 joint it is not\nused.\none thing to know.\n";
        assert!(plain.contains(sentence), "{plain}");
        assert_eq!(plain.matches("bends").count(), 1);
    }

    #[test]
    fn the_widest_finding_is_within_the_width() {
        let mut sample = sample::arm();
        let widest = &mut sample.diagnosis.findings[0];
        widest.at.effect = catalogue::EffectKind::AsymmetricFriction;
        (widest.share_explained, widest.held_out_gain) = (0.997, 0.997);
        let level = &mut widest.parameters[0];
        (level.nominal, level.unit) = (0.205, "N m s/rad");
        let plain = without_escapes(&text(&sample.report()));
        let row = "FR03 asymmetric friction 2.00 N·m·s/rad (1.80 to 2.20), was 0.205   99.7 % of";
        assert!(plain.contains(row), "{plain}");
        assert!(plain.lines().all(|line| line.chars().count() <= TERMINAL_WIDTH), "{plain}");
    }

    #[test]
    fn a_joint_that_hardly_moves_comes_last_with_its_reason_and_without_numbers() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[0].verdict = Verdict::DataInadequate;
        let plain = without_escapes(&text(&sample.report()));
        let block =
            "shoulder           data inadequate\n    the reason in a sentence\n  FR02 Coulomb";
        let elbow = plain.find("\nelbow ");
        assert!(elbow.is_some() && plain.find(block) > elbow, "{plain}");
    }

    #[test]
    fn joints_that_lack_data_for_one_reason_are_told_together() {
        let mut sample = sample::arm();
        sample.diagnosis.findings.clear();
        for joint in &mut sample.diagnosis.joints {
            joint.verdict = Verdict::DataInadequate;
            joint.because = "the position of joint elbow is off".to_owned();
        }
        let plain = without_escapes(&text(&sample.report()));
        assert_eq!(plain.matches("the position of joint elbow is off").count(), 1, "{plain}");
        let names = sample.diagnosis.joints.iter().map(|joint| joint.name.clone());
        let names = names.collect::<Vec<_>>();
        let block = "all joints data inadequate\n    the position of joint elbow is off\n";
        assert!(plain.contains(block), "{plain}");
        sample.diagnosis.joints[0].verdict = Verdict::Consistent;
        sample.diagnosis.joints[0].because = "fits".to_owned();
        let plain = without_escapes(&text(&sample.report()));
        assert_eq!(plain.matches("the position of joint elbow is off").count(), 1, "{plain}");
        assert!(names.iter().all(|name| plain.contains(name.as_str())), "{plain}");
    }
}
