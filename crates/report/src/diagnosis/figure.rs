use askama::Template;
use diagnosis::{Estimate, Finding, Verdict};

use crate::diagnosis::estimate::value;
use crate::diagnosis::joint_charts::worst_of;
use crate::diagnosis::places::{JointUnits, acting_on};
use crate::diagnosis::report::Report;
use crate::diagnosis::sentence::{short_bottom_line, title};
use crate::diagnosis::tables::{JointRow, has_no_size, joint_rows, name_beside_joint, size, sizes};
use pages::{Chart, Medium, Palette, ReportError, Stacked, join_names, pack, shorten, stack, wrap};

/// Width of the right panel (px); the left one stands in the template.
const RIGHT: f64 = 452.0;

/// Upper edge of what the panels show, height of a joint, of a line of text, and least
/// height of the chart (px).
const TOP: f64 = 156.0;
const ROW: [f64; 2] = [42.0, 54.0];
const LINE: f64 = 18.0;
const LEAST_CHART: f64 = 220.0;

/// Joints in the left panel; of more, those where the nominal model errs most.
const MOST_JOINTS: usize = 12;

/// Findings in the right panel.
const MOST_FINDINGS: usize = 5;

/// Characters of the title, of the name of a joint or run, and of a line of a panel.
const TITLE_CHARACTERS: usize = 68;
const NAME_CHARACTERS: usize = 28;
const LEFT_CHARACTERS: usize = 56;
const RIGHT_CHARACTERS: usize = 66;

/// Least nominal error, as a share of the torque, of the joint in the right panel.
const VISIBLE: f64 = 0.1;

/// `figure.svg`: error by joint before and after, and the torque of the joint that gains
/// most, in one drawing that stands alone.
///
/// It brings its own background, colours and fonts and asks for no other file. Joints are
/// compared by their error over their torque, on held-out data.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn figure(report: &Report) -> Result<String, ReportError> {
    Poster::new(report)?
        .render()
        .map_err(|e| ReportError::Format { format: "SVG", reason: e.to_string() })
}

#[derive(Template)]
#[template(path = "diagnosis/figure.svg")]
struct Poster {
    height: f64,
    colours: Palette,
    title: String,
    subtitle: String,
    joints: Vec<Stacked<JointRow>>,
    notes: Vec<Stacked<String>>,
    best: Option<Best>,
}

/// The joint that gains most.
struct Best {
    joint: String,
    run: String,
    load: &'static str,
    chart: String,
    lines: Vec<Stacked<TextLine>>,
}

/// A line of text that begins with bold words.
#[derive(Debug, Clone, PartialEq, Eq)]
struct TextLine {
    bold: String,
    plain: String,
}

impl Poster {
    fn new(report: &Report) -> Result<Self, ReportError> {
        let (joints, notes) = rows(report);
        let best = best(report);
        let lines = best.map(|joint| lines(&acting_on(report, joint))).unwrap_or_default();

        // The panel with less to show stretches until both end at the same height.
        let text = LINE * lines.len() as f64 + 14.0;
        let notes_height = LINE * notes.len() as f64;
        let count = joints.len().max(1) as f64;
        let row = ((LEAST_CHART + text - notes_height) / count).clamp(ROW[0], ROW[1]);
        let left = row * joints.len() as f64 + notes_height;
        let chart = (left - text).max(LEAST_CHART);
        Ok(Self {
            height: TOP + left.max(chart + text) + 14.0,
            colours: Medium::Alone.palette(),
            title: shorten(&title(report.diagnosis), TITLE_CHARACTERS),
            subtitle: short_bottom_line(report),
            notes: stack(notes, TOP + row * joints.len() as f64 + 12.0, LINE),
            joints: stack(joints, TOP, row),
            best: match best {
                Some(joint) => Best::new(report, joint, (RIGHT, chart), lines)?,
                None => None,
            },
        })
    }
}

/// The rows of at most [`MOST_JOINTS`] joints, those with the longest bars, in their order;
/// and a note on the others.
fn rows(report: &Report) -> (Vec<JointRow>, Vec<String>) {
    let all = joint_rows(report).into_iter().enumerate();
    let (mut rows, silent): (Vec<_>, Vec<_>) = all.partition(|(_, row)| row.adequate);
    rows.sort_by(|(_, a), (_, b)| b.bars[0].total_cmp(&a.bars[0]));
    let hidden = rows.len().saturating_sub(MOST_JOINTS);
    rows.truncate(MOST_JOINTS);
    rows.sort_by_key(|(index, _)| *index);

    let mut notes = Vec::new();
    if hidden > 0 {
        notes.push(format!("and {hidden} joints where the error is smaller"));
    }
    if !silent.is_empty() {
        let names: Vec<String> = silent.into_iter().map(|(_, row)| row.name).collect();
        let sentence = format!("These logs show too little of {}.", join_names(&names));
        notes.extend(wrap(&sentence, LEFT_CHARACTERS));
    }
    let short =
        |(_, row): (usize, JointRow)| JointRow { name: shorten(&row.name, NAME_CHARACTERS), ..row };
    (rows.into_iter().map(short).collect(), notes)
}

/// The joint with a [`VISIBLE`] error that loses the largest part of it; of all joints,
/// where none has one.
fn best(report: &Report) -> Option<usize> {
    let diagnosis = report.diagnosis;
    let gain = &diagnosis.gain.inverse;
    let errors = gain.rms_before_nm.iter().zip(&gain.rms_after_nm);
    let falls =
        diagnosis.joints.iter().zip(errors).enumerate().filter_map(|(i, (joint, error))| {
            let fall = 1.0 - error.1 / error.0;
            let is_visible = *error.0 > VISIBLE * joint.torque_rms_nm;
            let is_known = joint.verdict != Verdict::DataInadequate && fall.is_finite();
            is_known.then_some((i, is_visible, fall))
        });
    let order =
        |a: &(usize, bool, f64), b: &(usize, bool, f64)| a.1.cmp(&b.1).then(a.2.total_cmp(&b.2));
    falls.max_by(order).map(|(i, ..)| i)
}

impl Best {
    fn new(
        report: &Report,
        joint: usize,
        size: (f64, f64),
        lines: Vec<TextLine>,
    ) -> Result<Option<Self>, ReportError> {
        let name = report.diagnosis.joints.get(joint).map(|joint| &joint.name);
        let Some((name, (chart, run))) = name.zip(worst_of(report, joint)) else {
            return Ok(None);
        };
        let chart = Chart { size, ..chart };
        Ok(Some(Self {
            joint: shorten(name, NAME_CHARACTERS),
            run: shorten(run, NAME_CHARACTERS),
            load: JointUnits::of(report.robot, name).load,
            chart: chart.draw_at([0.0, 150.0], Medium::Alone)?,
            lines: stack(lines, TOP + size.1 + 16.0, LINE),
        }))
    }
}

/// Names and sizes of the findings, on lines that fit the panel.
fn lines(findings: &[&Finding]) -> Vec<TextLine> {
    let line = |bold: &str, plain: &str| TextLine { bold: bold.into(), plain: plain.into() };
    if findings.is_empty() {
        return vec![line("", "No named effect acts on it.")];
    }
    let mut lines: Vec<TextLine> =
        findings.iter().take(MOST_FINDINGS).flat_map(|finding| lines_of(finding)).collect();
    if findings.len() > MOST_FINDINGS {
        let more = findings.len() - MOST_FINDINGS;
        lines.push(line("", &format!("and {more} more in report.html")));
    }
    lines
}

/// Name and changes on one line; a name on its own line where they do not fit.
fn lines_of(finding: &Finding) -> Vec<TextLine> {
    let bold = shorten(&name_beside_joint(&finding.at), RIGHT_CHARACTERS - 8);
    let changes = changes(finding);
    let plain = changes.join(", ");
    if bold.chars().count() + plain.chars().count() + 2 <= RIGHT_CHARACTERS {
        return vec![TextLine { bold, plain }];
    }
    let below = pack(changes.iter().map(String::as_str), ", ", RIGHT_CHARACTERS);
    let below = below.into_iter().map(|plain| TextLine { bold: String::new(), plain });
    std::iter::once(TextLine { bold, plain: String::new() }).chain(below).collect()
}

/// The sizes that differ from the nominal ones by more than their interval: with it where
/// there is one, without it where there are several; words where there is none.
fn changes(finding: &Finding) -> Vec<String> {
    let differs = |p: &&Estimate| p.determined && !(p.ci95[0]..=p.ci95[1]).contains(&p.nominal);
    let changed: Vec<&Estimate> = finding.parameters.iter().filter(differs).collect();
    match changed.as_slice() {
        [] if has_no_size(finding) => vec!["of unknown size".to_owned()],
        [] if finding.parameters.len() == 1 => sizes(finding),
        [] => vec!["only jointly determined".to_owned()],
        [one] => vec![size(one, finding.parameters.len())],
        several => {
            several.iter().map(|p| format!("{} {}", p.name.replace('_', " "), value(p))).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::sample::{self, text_of_xml};

    #[test]
    fn the_figure_is_xml_that_stands_alone_and_names_the_joint_and_its_cause() {
        let sample = sample::arm();
        let svg = super::figure(&sample.report()).unwrap();
        let text = text_of_xml(&svg);
        for expected in ["arm: partly explained", "shoulder", "FR02 Coulomb friction", "2.00 N·m"]
        {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
        assert_eq!(svg.matches("http").count(), 1, "only the name space");
        assert!(!svg.contains("var(") && !svg.contains("NaN") && !svg.contains("<style"));
        assert!(svg.len() < 150_000, "{} bytes", svg.len());
    }

    #[test]
    fn a_name_is_text_and_a_diagnosis_without_signals_has_one_panel() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[0].name = "<b>&".into();
        sample.traces.clear();
        let svg = super::figure(&sample.report()).unwrap();
        text_of_xml(&svg);
        assert!(!svg.contains("<b>") && !svg.contains("aria-label=\"Torque of"));
    }

    #[test]
    fn a_joint_that_the_log_does_not_show_has_no_bar_and_is_not_the_best() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[0].verdict = diagnosis::Verdict::DataInadequate;
        let report = sample.report();
        assert_eq!(super::best(&report), Some(1));
        let (rows, notes) = super::rows(&report);
        assert_eq!((rows.len(), rows[0].name.as_str()), (1, "elbow"));
        assert_eq!(notes, ["These logs show too little of shoulder."]);
    }

    #[test]
    fn long_names_are_cut_to_fit() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[0].name = "shoulder".repeat(9);
        let svg = super::figure(&sample.report()).unwrap();
        assert!(svg.contains("shouldershouldershouldersho…: torque over time"));
        assert!(!svg.contains(&format!(">{}<", "shoulder".repeat(9))));
    }

    #[test]
    fn of_many_joints_the_worst_are_shown() {
        let mut sample = sample::arm();
        let joint = sample.diagnosis.joints[0].clone();
        sample.diagnosis.joints = vec![joint; 30];
        sample.diagnosis.gain.inverse.rms_before_nm = (0..30).map(|i| 0.1 * f64::from(i)).collect();
        let (rows, notes) = super::rows(&sample.report());
        assert_eq!(notes, ["and 18 joints where the error is smaller"]);
        let before: Vec<&str> = rows.iter().map(|row| row.before.as_str()).collect();
        assert_eq!((before.len(), before[0], before[11]), (12, "1.80", "2.90"));
    }
}
