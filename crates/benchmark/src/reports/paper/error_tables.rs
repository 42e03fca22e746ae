use pages::{
    Cell, Dots, GridColumn, JointDots, LegendKey, Medium, ReportError, TABLE_DIGITS, mark_least,
    significant,
};

use crate::paper::learning_errors::{LearningErrors, ModelErrors};

/// Errors of some models on one data set.
pub(super) struct ErrorTable<'a> {
    /// The data set, in a few words.
    pub title: String,
    /// Explanation of the data set.
    pub words: String,
    /// Names of the joints.
    pub joints: &'a [String],
    /// The models.
    pub models: &'a [ModelErrors],
}

impl ErrorTable<'_> {
    /// One row a joint, with a star at the least error; `more` is the rightmost column.
    pub fn columns(&self, more: Option<GridColumn>) -> Vec<GridColumn> {
        let rows: Vec<Vec<Cell>> = (0..self.joints.len())
            .map(|j| mark_least(&self.models.iter().map(|m| nmse(m, j)).collect::<Vec<_>>()))
            .collect();
        let columns = self.models.iter().enumerate().map(|(place, model)| GridColumn {
            header: format!("{} ", model.model),
            cells: rows.iter().map(|row| row[place].clone()).collect(),
        });
        columns.chain(more).collect()
    }

    /// The errors as dots on a logarithmic axis.
    pub fn dots(&self, place: Medium) -> Result<String, ReportError> {
        let joints = self.joints.iter().enumerate().map(|(j, joint)| JointDots {
            name: joint.clone(),
            values: self.models.iter().map(|model| nmse(model, j)).collect(),
            floor: None,
        });
        let dots = Dots {
            title: self.title.clone(),
            subtitle: format!("{}; logarithmic, lower is better", self.words),
            axis: "nMSE",
            keys: LegendKey::of_models(self.models.iter().map(|model| model.model.as_str())),
            joints: joints.collect(),
            mark: Some((1.0, "mean torque")),
        };
        dots.draw(place)
    }
}

/// Least error of a Gaussian process over that of the named effects, outside the training data, by joint.
pub(super) fn worse_than_named(errors: &LearningErrors) -> GridColumn {
    let cell = |j: usize| {
        let times = errors.outside_gain(j).map(|times| significant(times, TABLE_DIGITS) + "x");
        Cell::plain(times.unwrap_or_else(|| "-".to_owned()))
    };
    GridColumn {
        header: "best gp / named".to_owned(),
        cells: (0..errors.joints.len()).map(cell).collect(),
    }
}

fn nmse(model: &ModelErrors, joint: usize) -> f64 {
    model.nmse.get(joint).copied().flatten().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reports::paper::sample;
    use crate::reports::sample::text_of_xml;

    #[test]
    fn the_named_effects_are_compared_with_the_best_process() {
        let errors = sample::errors();
        let cells: Vec<String> =
            worse_than_named(&errors).cells.into_iter().map(|cell| cell.text).collect();
        // 0.2 over 0.01, and nothing is known of the processes at the elbow.
        assert_eq!(cells, ["20.0x", "-"]);
    }

    #[test]
    fn the_dots_are_xml_that_stands_alone() {
        let errors = sample::errors();
        let table = ErrorTable {
            title: "t".into(),
            words: "w".into(),
            joints: &errors.joints,
            models: &errors.outside,
        };
        let text = text_of_xml(&table.dots(Medium::Alone).unwrap());
        for expected in ["nMSE", "shoulder, gp-rbd: 0.200", "named", "mean torque"] {
            assert!(text.contains(expected), "{expected} is missing in {text}");
        }
    }
}
