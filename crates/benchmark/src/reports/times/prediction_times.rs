use pages::{
    Cell, GridColumn, Provenance, ReportError, push_notes, significant, text_grid, with_schema,
};
use serde::{Deserialize, Serialize};

/// Name and version of the schema of `prediction_times.json`.
const SCHEMA: &str = "plumbline.prediction_times/1";

/// Time of one prediction against the number of training points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PredictionTimes {
    /// Name of the robot.
    pub robot: String,
    /// Number of joints that one prediction covers.
    pub joints: usize,
    /// The computer, in words.
    pub machine: String,
    /// The measured times.
    pub curves: Vec<TimeCurve>,
    /// Times that were not measured, with the reason, and cautions about the numbers, in sentences.
    pub remarks: Vec<String>,
    /// Program, command and inputs behind the results.
    pub provenance: Provenance,
}

/// The times of one model or program.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TimeCurve {
    /// Its name.
    pub name: String,
    /// The program that the model belongs to.
    pub maker: Maker,
    /// The times, by rising number of points.
    pub points: Vec<TimePoint>,
}

/// The program that a model belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Maker {
    /// This program.
    Plumbline,
    /// Another program, measured for comparison.
    Peer,
}

/// A number of training points and the time of a prediction with them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TimePoint {
    /// Number of training points.
    pub n: usize,
    /// Median time of one prediction, all joints (us).
    pub microseconds: f64,
}

impl PredictionTimes {
    /// `prediction_times.json`, in the schema `plumbline.prediction_times/1`.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn json(&self) -> Result<String, ReportError> {
        with_schema(SCHEMA, self)
    }

    /// The times as a table for a terminal, one row a number of points.
    pub fn text(&self) -> String {
        let (labels, columns) = self.table();
        let mut out = format!(
            "Median time of one prediction for the {} joints of {} (us)\n{}\n\n",
            self.joints, self.robot, self.machine
        );
        out.push_str(&text_grid("points", &labels, &columns));
        push_notes(&mut out, &self.remarks);
        out
    }

    /// One row a number of points, one column a curve.
    pub(crate) fn table(&self) -> (Vec<String>, Vec<GridColumn>) {
        let rows = self.numbers();
        let labels: Vec<String> = rows.iter().map(|n| format!("{n:>6}")).collect();
        let columns = self.curves.iter().map(|curve| {
            let cells = rows.iter().map(|&n| {
                let point = curve.points.iter().find(|point| point.n == n);
                Cell::plain(point.map_or("-".to_owned(), |p| significant(p.microseconds, 3)))
            });
            GridColumn { header: curve.name.clone(), cells: cells.collect() }
        });
        (labels, columns.collect())
    }

    /// Every number of points of any curve, rising.
    fn numbers(&self) -> Vec<usize> {
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        let mut numbers: Vec<usize> = points.map(|point| point.n).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }
}

#[cfg(test)]
mod tests {
    use crate::reports::sample;
    use pages::without_escapes;

    #[test]
    fn the_table_has_a_row_a_number_of_points_and_a_dash_where_nothing_was_measured() {
        let plain = without_escapes(&sample::times().text());
        assert_eq!(
            plain,
            "\
Median time of one prediction for the 7 joints of arm (us)
a machine

points   rbd      gp  scikit-learn
   100  1.10    3.20           830
 10000  1.10  900000             -

numpy: not installed
"
        );
    }
}
