use crate::learning::comparison::ComparedJoint;
use crate::tracking::comparison::{TrackedModel, TrackingComparison, WallTiming};
use pages::{
    BOLD, Cell, GridColumn, TABLE_DIGITS, TERMINAL_WIDTH, mark_least, percent, percent_range,
    push_entry, push_first_warnings, push_notes, significant, text_grid, wrap,
};

/// What stands below the errors, row by row; the last two only where time was measured.
const COSTS: [&str; 7] = [
    "",
    "end effector, RMS (mm)",
    "end effector, most (mm)",
    "share of feedback",
    "largest jump",
    "prediction (µs)",
    "missed deadlines",
];

/// Events of a run that are shown; the JSON holds them all.
const MOST_EVENTS: usize = 3;

impl TrackingComparison {
    /// The comparison as text for a terminal of 100 columns: one sentence, then one column a
    /// model; one row a joint with the error, then what it means at the end effector, what the
    /// feedback had to do and what a prediction costs.
    pub fn text(&self) -> String {
        let labels: Vec<String> = self.joints.iter().map(|j| self.label(j)).collect();
        let costs = self.cost_labels().iter().map(|&label| label.to_owned());
        let labels: Vec<String> = labels.into_iter().chain(costs).collect();
        let errors: Vec<Vec<Cell>> =
            (0..self.joints.len()).map(|joint| mark_least(&self.errors(joint))).collect();
        let columns: Vec<GridColumn> = self
            .models
            .iter()
            .enumerate()
            .map(|(place, model)| GridColumn {
                header: format!("{} ", model.name),
                cells: errors
                    .iter()
                    .map(|row| row[place].clone())
                    .chain(self.costs(model))
                    .collect(),
            })
            .collect();
        let mut out = String::new();
        for line in wrap(&self.sentence(), TERMINAL_WIDTH) {
            out.push_str(&format!("{BOLD}{line}{BOLD:#}\n"));
        }
        out.push('\n');
        out.push_str(&text_grid(&self.corner(), &labels, &columns));
        out.push('\n');
        self.legend(&mut out);
        push_notes(&mut out, &self.notes());
        push_first_warnings(&mut out, &self.warnings, "tracking.json");
        out
    }

    /// The errors of all runs at a joint (mrad or mm).
    pub(crate) fn errors(&self, joint: usize) -> Vec<f64> {
        self.models.iter().map(|model| 1e3 * model.error(joint)).collect()
    }

    /// A joint, with its unit where joints differ.
    pub(crate) fn label(&self, joint: &ComparedJoint) -> String {
        match self.thousandths() {
            "mrad" | "mm" => joint.name.clone(),
            _ => format!("{} (m{})", joint.name, joint.position_unit()),
        }
    }

    fn corner(&self) -> String {
        match self.thousandths() {
            same @ ("mrad" | "mm") => format!("RMS error ({same})"),
            _ => "RMS error".to_owned(),
        }
    }

    /// The names of the rows of [`Self::costs`].
    pub(crate) fn cost_labels(&self) -> &'static [&'static str] {
        let is_measured = self.models.iter().any(|model| model.timing.is_some());
        &COSTS[..if is_measured { COSTS.len() } else { COSTS.len() - 1 }]
    }

    /// What a run cost beside its errors.
    pub(crate) fn costs(&self, model: &TrackedModel) -> Vec<Cell> {
        let tip = |tip: Option<f64>| {
            let tip = tip.filter(|_| model.stopped.is_none());
            tip.map_or("-".to_owned(), |m| significant(1e3 * m, TABLE_DIGITS))
        };
        let jumps = shares(&model.largest_jump_nm, &model.effort_rms_nm);
        let costs = [
            String::new(),
            tip(model.tip_rmse_m),
            tip(model.tip_max_m),
            percent_range(&shares(&model.feedback_rms_nm, &model.effort_rms_nm)),
            percent(jumps.into_iter().reduce(f64::max).unwrap_or(f64::NAN)),
            significant(model.prediction_us, TABLE_DIGITS),
            model.timing.as_ref().map_or("-".to_owned(), missed_deadlines),
        ];
        let shown = costs.into_iter().take(self.cost_labels().len());
        shown.map(|cost| Cell::plain(cost + " ")).collect()
    }

    /// What ended runs early, and what happened in them.
    pub(crate) fn notes(&self) -> Vec<String> {
        let notes = self.models.iter().flat_map(|model| {
            let stopped = model.stopped.iter().map(|why| format!("was stopped: {why}"));
            let events = model.events.iter().take(MOST_EVENTS).cloned();
            let more = model.events.len().saturating_sub(MOST_EVENTS);
            let more = (more > 0).then(|| format!("and {more} more events in tracking.json"));
            let all = stopped.chain(events).chain(more);
            all.map(|note| format!("{}: {note}", model.name))
        });
        notes.collect()
    }

    /// What the words of the table mean and what the runs have in common.
    fn legend(&self, out: &mut String) {
        push_entry(out, "*", "the least error at the joint");
        push_entry(
            out,
            "share of feedback",
            "RMS effort of the feedback over that of all, least to most of a joint",
        );
        push_entry(
            out,
            "largest jump",
            "of the feedforward between two samples, over the RMS effort of its joint",
        );
        let common = [("motion", &self.motion), ("clock", &self.clock)];
        let models = self.models.iter().map(|model| (model.name.as_str(), &model.words));
        for (word, words) in models.chain(common) {
            for (i, line) in wrap(words, TERMINAL_WIDTH - 19).iter().enumerate() {
                push_entry(out, if i == 0 { word } else { "" }, line);
            }
        }
        push_entry(out, "duration", &format!("{} s", significant(self.duration_s, TABLE_DIGITS)));
        let gains = |gains: &[f64]| {
            gains.iter().map(|&k| significant(k, TABLE_DIGITS)).collect::<Vec<_>>().join(" ")
        };
        push_entry(out, "Kp", &gains(&self.gains.kp));
        push_entry(out, "Kd", &gains(&self.gains.kd));
    }
}

/// One number over another, joint by joint, where that is a number.
fn shares(parts: &[f64], wholes: &[f64]) -> Vec<f64> {
    let shares = parts.iter().zip(wholes).map(|(part, whole)| part / whole);
    shares.filter(|share| share.is_finite()).collect()
}

/// Deadlines that a loop missed, as a share of all.
fn missed_deadlines(timing: &WallTiming) -> String {
    percent(timing.missed_deadlines as f64 / timing.ticks as f64)
}

#[cfg(test)]
const EXPECTED: &str = "\
RMS error of the end effector of arm at the gains low: 2.50 mm with gp-rbd and 10.0 mm with rbd.

RMS error                 none         rbd      gp-rbd
shoulder (mrad)              -        20.0        5.00*
slide (mm)                   -        4.00        1.00*

end effector, RMS (mm)       -        10.0        2.50
end effector, most (mm)      -        30.0        7.50
share of feedback         40 %   3.0-4.0 %   0.8-1.0 %
largest jump             1.3 %       1.3 %       1.3 %
prediction (µs)           12.5        12.5        12.5

*                  the least error at the joint
share of feedback  RMS effort of the feedback over that of all, least to most of a joint
largest jump       of the feedforward between two samples, over the RMS effort of its joint
none               what it is
rbd                what it is
gp-rbd             what it is
motion             a sine of 0.5 Hz
clock              a prediction takes no time
duration           60.0 s
Kp                 20.0 300
Kd                 1.50 7.00

none: was stopped: slide: its encoder failed after 12 s

warning: shoulder: its gains are below what friction needs
";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tracking::sample;
    use pages::without_escapes;

    #[test]
    fn the_table_marks_the_least_error_of_a_joint_and_leaves_a_stopped_run_out() {
        let plain = without_escapes(&sample::comparison().text());
        assert_eq!(plain, EXPECTED);
        assert!(plain.lines().all(|line| line.chars().count() <= TERMINAL_WIDTH));
    }

    #[test]
    fn a_loop_on_the_clock_of_the_wall_says_how_often_it_was_late() {
        let mut comparison = sample::comparison();
        comparison.models[1].timing = Some(WallTiming {
            ticks: 30_000,
            missed_deadlines: 300,
            worst_late_us: 3100.0,
            missed_updates: 12,
            latency_99_us: 80.0,
            latency_max_us: 900.0,
        });
        comparison.models[1].events = (1..6).map(|i| format!("event {i}")).collect();
        let plain = without_escapes(&comparison.text());
        let row = plain.lines().find(|line| line.starts_with("missed deadlines")).unwrap();
        let cells: Vec<&str> = row.split_whitespace().collect();
        assert_eq!(cells, ["missed", "deadlines", "-", "1.0", "%", "-"]);
        assert!(plain.contains("rbd: event 3\nrbd: and 2 more events in tracking.json"), "{plain}");
    }
}
