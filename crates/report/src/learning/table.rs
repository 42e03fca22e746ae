use crate::learning::comparison::{DataSet, LearningComparison, ModelRow};
use pages::{
    BOLD, Cell, GridColumn, TABLE_DIGITS, TERMINAL_WIDTH, mark_least, percent_range, push_entry,
    push_first_warnings, push_notes, significant, text_grid, wrap,
};

/// What stands below the errors, row by row.
const COSTS: [&str; 6] =
    ["", "points", "training (s)", "prediction (µs)", "log likelihood", "in 95 % interval"];

impl LearningComparison {
    /// The comparison as text for a terminal of 100 columns: one column a model; one row a
    /// joint with the error, then what the model costs and how sure it is.
    pub fn text(&self) -> String {
        let names = self.joints.iter().map(|joint| joint.name.as_str());
        let labels: Vec<String> = names.chain(COSTS).map(str::to_owned).collect();
        let errors: Vec<Vec<Cell>> = (0..self.joints.len()).map(|i| self.errors(i)).collect();
        let column = |(place, model)| Self::column(model, errors.iter().map(|row| &row[place]));
        let columns: Vec<GridColumn> = self.models.iter().enumerate().map(column).collect();
        let mut out = format!("{BOLD}Learned models of {}{BOLD:#}\n\n", self.robot);
        out.push_str(&text_grid("nMSE", &labels, &columns));
        out.push('\n');
        self.legend(&mut out);
        let remarks = self.models.iter().flat_map(|model| {
            model.remarks.iter().map(|remark| format!("{}: {remark}", model.name))
        });
        push_notes(&mut out, &remarks.collect::<Vec<_>>());
        push_first_warnings(&mut out, &self.warnings, "learning.json");
        out
    }

    /// The errors of all models at a joint, a star at those that are the least.
    fn errors(&self, joint: usize) -> Vec<Cell> {
        let errors = self.models.iter().map(|model| model.nmse.get(joint).copied());
        mark_least(&errors.map(|error| error.unwrap_or(f64::NAN)).collect::<Vec<_>>())
    }

    /// One model: its errors and its costs.
    fn column<'a>(model: &ModelRow, errors: impl Iterator<Item = &'a Cell>) -> GridColumn {
        let costs = [
            String::new(),
            if model.points == 0 { "-".to_owned() } else { model.points.to_string() },
            significant(model.training_s, TABLE_DIGITS),
            significant(model.prediction_us, TABLE_DIGITS),
            model.log_likelihood.map_or("-".to_owned(), log_likelihood),
            model.coverage_95.as_ref().map_or("-".to_owned(), |c| percent_range(c)),
        ];
        let costs = costs.into_iter().map(|cost| Cell::plain(cost + " "));
        GridColumn {
            header: format!("{} ", model.name),
            cells: errors.cloned().chain(costs).collect(),
        }
    }

    /// What the words of the table mean and what it is made from.
    fn legend(&self, out: &mut String) {
        push_entry(
            out,
            "nMSE",
            "mean square error over the variance of the effort, on held-out logs",
        );
        push_entry(out, "*", "the least error at the joint");
        push_entry(out, "points", "training or inducing points that a prediction visits");
        push_entry(
            out,
            "log likelihood",
            "log marginal likelihood of the samples learned from, all joints",
        );
        push_entry(
            out,
            "in 95 % interval",
            "share of the held-out samples, least to most of a joint",
        );
        for model in &self.models {
            for (i, line) in wrap(&model.words, TERMINAL_WIDTH - 19).iter().enumerate() {
                push_entry(out, if i == 0 { &model.name } else { "" }, line);
            }
        }
        push_entry(out, "rigid bodies from", &samples(&self.regression));
        push_entry(out, "trained on", &samples(&self.train));
        push_entry(out, "tested on", &samples(&self.test));
        for (i, line) in wrap(&self.thinning, TERMINAL_WIDTH - 19).iter().enumerate() {
            push_entry(out, if i == 0 { "thinning" } else { "" }, line);
        }
    }
}

/// With one decimal: what counts is a difference of some.
fn log_likelihood(value: f64) -> String {
    if value.is_finite() { format!("{value:.1}") } else { "-".to_owned() }
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
    use pages::{TERMINAL_WIDTH, without_escapes};

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
        assert!(plain.lines().all(|line| line.chars().count() <= TERMINAL_WIDTH));
    }
}
