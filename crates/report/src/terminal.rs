use anstyle::{AnsiColor, Style};
use diagnosis::{EffectAt, Estimate, Finding, JointReport, Verdict};

use crate::Report;
use crate::numbers::{interval, percent, significant};
use crate::places::{JointUnits, counted, findings_of, listed};
use crate::sentence::{bottom_line, verdict_sentence};

/// Columns of the terminal that the text fills.
const WIDTH: usize = 100;

/// Parameters of one finding that are printed; the report has them all.
const MOST_PARAMETERS: usize = 4;

const BOLD: Style = Style::new().bold();
const FAINT: Style = Style::new().dimmed();

/// The verdict as text for a terminal of 100 columns, with colours as escape codes that
/// `anstream` removes where they are not wanted.
///
/// The first line is the verdict in a sentence, the second what it buys; then one block a
/// joint, with its findings, their rivals and what is left.
pub fn text(report: &Report) -> String {
    let diagnosis = report.diagnosis;
    let style = style_of(diagnosis.verdict).bold();
    let mut out = String::new();
    for line in wrapped(&format!("{}.", verdict_sentence(diagnosis)), 0) {
        out.push_str(&format!("{style}{line}{style:#}\n"));
    }
    for line in wrapped(&format!("{}.", bottom_line(report)), 0) {
        out.push_str(&format!("{line}\n"));
    }
    let whole = findings_of(report, None);
    if !whole.is_empty() {
        out.push_str(&format!("\n{BOLD}whole robot{BOLD:#}\n"));
        whole.iter().for_each(|f| finding(&mut out, f));
    }
    for (index, joint) in diagnosis.joints.iter().enumerate() {
        block(&mut out, report, index, joint);
    }
    warnings(&mut out, &diagnosis.warnings);
    out
}

fn block(out: &mut String, report: &Report, index: usize, joint: &JointReport) {
    let gain = &report.diagnosis.gain.inverse;
    let number = |values: &[f64]| significant(values.get(index).copied().unwrap_or(f64::NAN), 3);
    let unit = JointUnits::of(report.robot, &joint.name).effort;
    let style = style_of(joint.verdict);
    let verdict = joint.verdict.words();
    let gap = " ".repeat(17_usize.saturating_sub(verdict.len()));
    out.push_str(&format!(
        "\n{BOLD}{:<18}{BOLD:#} {style}{verdict}{style:#}{gap} error {} -> {} of {} {unit} RMS, noise floor {}\n",
        joint.name,
        number(&gain.rms_before_nm),
        number(&gain.rms_after_nm),
        significant(joint.torque_rms_nm, 3),
        significant(joint.noise_floor_rms_nm, 3),
    ));
    let found = findings_of(report, Some(index));
    if found.is_empty() {
        note(out, &joint.because);
    }
    found.iter().for_each(|f| finding(out, f));
    for left in report.diagnosis.unexplained.iter().filter(|u| u.joint == joint.name) {
        let signals: Vec<String> = left
            .depends_on
            .iter()
            .map(|d| format!("{} ({})", d.signal, percent(d.share)))
            .collect();
        let follows = if signals.is_empty() {
            "follows no signal of the log".to_owned()
        } else {
            format!("follows {}", listed(&signals))
        };
        note(out, &format!("left: {} of the gap has no name, it {follows}", percent(left.share)));
    }
}

/// Effect and size on one line with share and gain, then rivals and open directions.
fn finding(out: &mut String, finding: &Finding) {
    let mut name = finding.at.effect.words().to_owned();
    if let Some(link) = &finding.at.link {
        name.push_str(&format!(" of {link}"));
    }
    let shown: Vec<&Estimate> =
        finding.parameters.iter().filter(|p| p.determined).take(MOST_PARAMETERS).collect();
    let mut sizes = shown.iter().map(|p| size(p, shown.len()));
    let first = sizes.next().unwrap_or_else(|| "size not determined".to_owned());
    let worth = format!(
        "{:>6} of the gap, gain {}",
        percent(finding.share_explained),
        percent(finding.held_out_gain)
    );
    // A long name or size takes a line of its own, so that the columns stay aligned.
    let wide = name.chars().count() > 22 || first.chars().count() > 40;
    if wide {
        out.push_str(&format!("  {name:<64}{worth}\n    {first}\n"));
    } else {
        out.push_str(&format!("  {name:<23} {first:<40}{worth}\n"));
    }
    let indent = if wide { 4 } else { 26 };
    sizes.for_each(|line| out.push_str(&format!("{:indent$}{line}\n", "")));
    let hidden = finding.parameters.iter().filter(|p| p.determined).count() - shown.len();
    if hidden > 0 {
        note(out, &format!("{} more in the report", counted(hidden, "parameter")));
    }
    if !finding.not_separable_from.is_empty() {
        let rivals: Vec<String> = finding.not_separable_from.iter().map(EffectAt::words).collect();
        let motion = finding.told_apart_by.map(|m| format!("; told apart by {m}"));
        note(out, &format!("or {}{}", rivals.join(", or "), motion.unwrap_or_default()));
    }
    if !finding.undetermined.is_empty() {
        note(out, &format!("left open by this log: {}", finding.undetermined.join("; ")));
    }
}

/// The size of a parameter and what it was, with its name where there are several.
fn size(parameter: &Estimate, count: usize) -> String {
    let was = if parameter.nominal.abs() > 0.0 {
        format!(", was {}", significant(parameter.nominal, 3))
    } else {
        String::new()
    };
    if count == 1 {
        return format!("{}{was}", interval(parameter));
    }
    format!("{} {}{was}", parameter.name.replace('_', " "), interval(parameter))
}

fn warnings(out: &mut String, warnings: &[String]) {
    if !warnings.is_empty() {
        out.push('\n');
    }
    for warning in warnings {
        let style = AnsiColor::Yellow.on_default();
        for (i, line) in wrapped(warning, 9).iter().enumerate() {
            let lead = if i == 0 { "warning:" } else { "        " };
            out.push_str(&format!("{style}{lead}{style:#} {line}\n"));
        }
    }
}

/// A faint line under a finding, wrapped.
fn note(out: &mut String, text: &str) {
    for line in wrapped(text, 4) {
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

/// Lines of at most [`WIDTH`] columns less the indent, broken at spaces.
fn wrapped(text: &str, indent: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() + 1 + indent <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    const EXPECTED: &str = "\
Partly explained: 2 named effects found in the model of arm, structure is left at joint elbow.
On held-out data (each run in turn) the torque error over all joints falls from 2.28 to 0.640 N·m
RMS (72 % less).

shoulder           explained         error 2.10 -> 0.400 of 5.00 N·m RMS, noise floor 0.350
  Coulomb friction        2.00 N·m (1.80 to 2.20)                   71 % of the gap, gain 62 %
    or viscous friction at shoulder; told apart by constant speeds, slow and fast, in both
    directions

elbow              partly explained  error 0.900 -> 0.500 of 5.00 N·m RMS, noise floor 0.350
  inertial parameters of elbow_link                                 71 % of the gap, gain 62 %
    2.50 kg (2.30 to 2.70)
    left open by this log: centre of mass along y
    left: 29 % of the gap has no name, it follows position of elbow (31 %)

warning: elbow: quantised in steps of 0.01 N m
";

    #[test]
    fn the_text_is_one_block_a_joint_within_the_width() {
        let sample = sample::arm();
        let coloured = text(&sample.report());
        assert!(coloured.contains("\u{1b}["));
        let plain = without_escapes(&coloured);
        assert_eq!(plain, EXPECTED);
        assert!(plain.lines().all(|line| line.chars().count() <= WIDTH));
    }

    fn without_escapes(text: &str) -> String {
        let mut pieces = text.split('\u{1b}');
        let first = pieces.next().unwrap_or_default().to_owned();
        pieces.fold(first, |out, piece| out + piece.split_once('m').map_or("", |(_, rest)| rest))
    }
}
