use super::comparison::{Comparison, DataSet, ModelRow};
use super::grid::{Cell, Column, grid};
use crate::numbers::{percent, significant};
use crate::terminal::{BOLD, WIDTH, entry, notes, warnings};
use crate::wrap::wrapped;

/// Significant digits of every number of the table.
const DIGITS: usize = 3;

/// Warnings that are shown; the JSON holds them all.
const MOST_WARNINGS: usize = 6;

/// What stands below the errors, row by row.
const COSTS: [&str; 6] =
    ["", "points", "training (s)", "prediction (µs)", "log likelihood", "in 95 % interval"];

impl Comparison {
    /// The comparison as text for a terminal of 100 columns: one column a model; one row a
    /// joint with the error, then what the model costs and how sure it is.
    pub fn text(&self) -> String {
        let names = self.joints.iter().map(|joint| joint.name.as_str());
        let labels: Vec<String> = names.chain(COSTS).map(str::to_owned).collect();
        let columns: Vec<Column> = self.models.iter().map(|model| self.column(model)).collect();
        let mut out = format!("{BOLD}Learned models of {}{BOLD:#}\n\n", self.robot);
        out.push_str(&grid("nMSE", &labels, &columns));
        out.push('\n');
        self.legend(&mut out);
        let remarks = self.models.iter().flat_map(|model| {
            model.remarks.iter().map(|remark| format!("{}: {remark}", model.name))
        });
        notes(&mut out, &remarks.collect::<Vec<_>>());
        let shown = self.warnings.len().min(MOST_WARNINGS);
        warnings(&mut out, &self.warnings[..shown]);
        if shown < self.warnings.len() {
            let more = self.warnings.len() - shown;
            out.push_str(&format!("         and {more} more in learning.json\n"));
        }
        out
    }

    /// One model: its errors, a star at those that are the least of their joint, and its costs.
    fn column(&self, model: &ModelRow) -> Column {
        let errors = (0..self.joints.len()).map(|joint| {
            let shown = error(model, joint);
            let is_least = shown != "-" && self.least(joint) == shown;
            if is_least { Cell::best(shown + "*") } else { Cell::plain(shown + " ") }
        });
        let costs = [
            String::new(),
            if model.points == 0 { "-".to_owned() } else { model.points.to_string() },
            significant(model.training_s, DIGITS),
            significant(model.prediction_us, DIGITS),
            model.log_likelihood.map_or("-".to_owned(), log_likelihood),
            model.coverage_95.as_ref().map_or("-".to_owned(), |c| coverage(c)),
        ];
        let costs = costs.into_iter().map(|cost| Cell::plain(cost + " "));
        Column { header: format!("{} ", model.name), cells: errors.chain(costs).collect() }
    }

    /// The least error at a joint, as it is shown.
    fn least(&self, joint: usize) -> String {
        let errors = self.models.iter().filter(|m| m.nmse.get(joint).is_some_and(|e| !e.is_nan()));
        let least = errors.min_by(|a, b| a.nmse[joint].total_cmp(&b.nmse[joint]));
        least.map_or(String::new(), |model| error(model, joint))
    }

    /// What the words of the table mean and what it is made from.
    fn legend(&self, out: &mut String) {
        entry(out, "nMSE", "mean square error over the variance of the effort, on held-out logs");
        entry(out, "*", "the least error at the joint");
        entry(out, "points", "training or inducing points that a prediction visits");
        entry(
            out,
            "log likelihood",
            "log marginal likelihood of the samples learned from, all joints",
        );
        entry(out, "in 95 % interval", "share of the held-out samples, least to most of a joint");
        for model in &self.models {
            for (i, line) in wrapped(&model.words, WIDTH - 19).iter().enumerate() {
                entry(out, if i == 0 { &model.name } else { "" }, line);
            }
        }
        entry(out, "rigid bodies from", &samples(&self.regression));
        entry(out, "trained on", &samples(&self.train));
        entry(out, "tested on", &samples(&self.test));
        for (i, line) in wrapped(&self.thinning, WIDTH - 19).iter().enumerate() {
            entry(out, if i == 0 { "thinning" } else { "" }, line);
        }
    }
}

fn error(model: &ModelRow, joint: usize) -> String {
    model.nmse.get(joint).map_or("-".to_owned(), |&error| significant(error, DIGITS))
}

/// With one decimal: what counts is a difference of some.
fn log_likelihood(value: f64) -> String {
    if value.is_finite() { format!("{value:.1}") } else { "-".to_owned() }
}

/// Least and largest share of a joint.
fn coverage(by_joint: &[f64]) -> String {
    let low = by_joint.iter().copied().fold(f64::INFINITY, f64::min);
    let high = by_joint.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let [low, high] = [low, high].map(percent);
    if low == high { low } else { format!("{}-{high}", low.trim_end_matches(" %")) }
}

/// How many samples of what.
fn samples(data: &DataSet) -> String {
    let count = data.logs.len();
    let plural = if count == 1 { "" } else { "s" };
    format!("{} of {} samples of {count} log{plural}", data.points, data.rows)
}

#[cfg(test)]
mod tests {
    use crate::learning::sample;
    use crate::terminal::{WIDTH, without_escapes};

    const EXPECTED: &str = "\
Learned models of arm

nMSE                rbd        gp    gp-rbd
shoulder          0.100    0.0100   0.00100*
elbow                 -    0.0200*   0.0200*

points                -      3000      3000
training (s)       12.3      12.3      12.3
prediction (µs)    23.8      23.8      23.8
log likelihood        -    -749.8    -749.8
in 95 % interval      -   91-96 %   91-96 %

nMSE               mean square error over the variance of the effort, on held-out logs
*                  the least error at the joint
points             training or inducing points that a prediction visits
log likelihood     log marginal likelihood of the samples learned from, all joints
in 95 % interval   share of the held-out samples, least to most of a joint
rbd                what it is
gp                 what it is
gp-rbd             what it is
rigid bodies from  6000 of 6000 samples of 1 log
trained on         3000 of 6000 samples of 1 log
tested on          4000 of 4000 samples of 1 log
thinning           sample floor(i n / points) of n

gp: the search at elbow was stopped
gp-rbd: the search at elbow was stopped

warning: elbow: quantised in steps of 0.01 N m
";

    #[test]
    fn many_warnings_are_cut_short() {
        let mut comparison = sample::comparison();
        comparison.warnings = (0..9).map(|i| format!("warning {i}")).collect();
        let plain = without_escapes(&comparison.text());
        assert_eq!(plain.matches("warning: warning").count(), 6);
        assert!(plain.ends_with("         and 3 more in learning.json\n"), "{plain}");
    }

    #[test]
    fn the_table_marks_the_least_error_of_a_joint() {
        let plain = without_escapes(&sample::comparison().text());
        assert_eq!(plain, EXPECTED);
        assert!(plain.lines().all(|line| line.chars().count() <= WIDTH));
    }
}
