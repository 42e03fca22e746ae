use crate::tracking::comparison::{TrackedModel, TrackingComparison};
use pages::significant;

/// The error that runs are ranked by.
enum Measure {
    /// Distance of the end effector (m).
    Tip,
    /// Root of the mean square over the joints that turn, or of those that slide where none
    /// turns (rad or m).
    Joints { unit: &'static str },
}

impl TrackingComparison {
    /// What one would tell a colleague: how far off the best run is, the next best and the last.
    ///
    /// By the end effector, where its error is known of every run; by the joints elsewhere.
    /// Runs that were stopped are left out.
    pub fn sentence(&self) -> String {
        let whole = || self.models.iter().filter(|model| model.stopped.is_none());
        let measure = if whole().all(|model| model.tip_rmse_m.is_some()) {
            Measure::Tip
        } else {
            let turns = self.joints.iter().any(|joint| joint.position_unit() == "rad");
            Measure::Joints { unit: if turns { "rad" } else { "m" } }
        };
        let (subject, unit) = match measure {
            Measure::Tip => ("the end effector", "mm"),
            Measure::Joints { unit: "m" } => ("the joints", "mm"),
            Measure::Joints { .. } => ("the joints", "mrad"),
        };
        let mut ranked: Vec<(&TrackedModel, f64)> = whole()
            .map(|model| (model, self.of_run(&measure, model)))
            .filter(|(_, error)| error.is_finite())
            .collect();
        ranked.sort_by(|a, b| a.1.total_cmp(&b.1));
        let name_and_error = |(model, error): &(&TrackedModel, f64)| {
            format!("{} {unit} with {}", significant(1e3 * error, 3), model.name)
        };
        let errors = match ranked.as_slice() {
            [] => return "No run came to its end.".to_owned(),
            [best, next, .., last] => format!(
                "{}, {}, the next best, and {}, the last",
                name_and_error(best),
                name_and_error(next),
                name_and_error(last)
            ),
            few => few.iter().map(name_and_error).collect::<Vec<_>>().join(" and "),
        };
        format!(
            "RMS error of {subject} of {} at the gains {}: {errors}.",
            self.robot, self.gains.name
        )
    }

    /// The error of a run (m or rad).
    fn of_run(&self, measure: &Measure, model: &TrackedModel) -> f64 {
        let unit = match measure {
            Measure::Tip => return model.tip_rmse_m.unwrap_or(f64::NAN),
            Measure::Joints { unit } => *unit,
        };
        let joints = self.joints.iter().enumerate().filter(|(_, j)| j.position_unit() == unit);
        let squares: Vec<f64> = joints.map(|(i, _)| model.error(i).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use crate::tracking::sample;

    #[test]
    fn the_best_is_told_beside_the_next_and_the_last_and_a_stopped_run_is_none_of_them() {
        let mut comparison = sample::comparison();
        let expected = "RMS error of the end effector of arm at the gains low: 2.50 mm with \
                        gp-rbd and 10.0 mm with rbd.";
        assert_eq!(comparison.sentence(), expected);
        comparison.models[0].stopped = None;
        assert!(comparison.sentence().contains(
            "2.50 mm with gp-rbd, 10.0 mm with rbd, the next best, and 100 mm with none, the last"
        ));
        comparison.models.clear();
        assert_eq!(comparison.sentence(), "No run came to its end.");
    }

    #[test]
    fn without_an_end_effector_the_joints_that_turn_are_told() {
        let mut comparison = sample::comparison();
        comparison.models[1].tip_rmse_m = None;
        assert!(
            comparison
                .sentence()
                .contains("error of the joints of arm at the gains low: 5.00 mrad with gp-rbd")
        );
        comparison.joints[0].effort_unit = "N";
        // The root of (5² + 1²) / 2.
        assert!(comparison.sentence().contains("3.61 mm with gp-rbd"));
    }
}
