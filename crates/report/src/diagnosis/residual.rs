use schemars::JsonSchema;
use serde::Serialize;

use pages::{count_noun, join_names, percent};

/// A learned model of the error that the findings leave.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ResidualModel {
    /// Its short name, such as `named-gp`.
    pub model: &'static str,
    /// What it is, in words.
    pub words: &'static str,
    /// Its file in the output folder.
    pub file: String,
    /// Points that a prediction visits.
    pub points: usize,
    /// Parts of the logs that were held out in turn.
    pub parts: usize,
    /// One entry a joint, in the order of the robot.
    pub joints: Vec<ResidualJointRow>,
    /// What to know of it, in sentences.
    pub remarks: Vec<String>,
}

/// The error at one joint on held-out data, with and without the residual model.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ResidualJointRow {
    /// Name of the joint.
    pub name: String,
    /// RMS error of the extended model (N m or N).
    pub extended_rms_nm: f64,
    /// The same with the residual model.
    pub with_residual_rms_nm: f64,
    /// Share of the extended model's error power that the residual model predicts; negative where
    /// the error grows.
    pub share: f64,
    /// Number of held-out parts in which the error falls.
    pub better_in: usize,
    /// Whether it is used at this joint.
    pub is_used: bool,
    /// Length scales over the range of their signals, the shortest first.
    pub length_scales: Vec<LengthScale>,
}

/// How quickly a model bends with a signal.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LengthScale {
    /// The signal, such as `position of elbow`.
    pub signal: String,
    /// Length scale over the range of the signal.
    pub share_of_range: f64,
}

impl ResidualModel {
    fn used_joints(&self) -> impl Iterator<Item = &ResidualJointRow> {
        self.joints.iter().filter(|joint| joint.is_used)
    }

    /// What it is worth, in a sentence.
    pub(crate) fn sentence(&self) -> String {
        let at = |j: &ResidualJointRow| format!("{} at {}", percent(j.share), j.name);
        let shares: Vec<String> = self.used_joints().map(at).collect();
        if shares.is_empty() {
            return "On held-out data a Gaussian process predicts nothing of what is left: \
                    the residual model is the extended model"
                .to_owned();
        }
        let without = self.joints.len() - shares.len();
        let elsewhere = match without {
            0 => String::new(),
            n => format!("; at {} it is not used", count_noun(n, "joint")),
        };
        format!(
            "Of what is left a Gaussian process predicts {} on held-out data{elsewhere}",
            join_names(&shares)
        )
    }

    /// The joint with this name, if the model is used there.
    pub(crate) fn used_at(&self, name: &str) -> Option<&ResidualJointRow> {
        self.used_joints().find(|joint| joint.name == name)
    }
}

impl ResidualJointRow {
    /// What it bends with, in words.
    pub(crate) fn bends_with(&self) -> String {
        let one =
            |l: &LengthScale| format!("{} ({} of its range)", l.signal, percent(l.share_of_range));
        join_names(&self.length_scales.iter().map(one).collect::<Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use crate::sample;

    #[test]
    fn the_sentence_names_the_joints_where_the_model_is_used_and_counts_the_others() {
        let mut model = sample::residual();
        assert_eq!(
            model.sentence(),
            "Of what is left a Gaussian process predicts 59 % at elbow on held-out data; \
             at 1 joint it is not used"
        );
        model.joints[1].is_used = false;
        assert!(model.sentence().ends_with("the residual model is the extended model"));
    }

    #[test]
    fn a_model_is_spoken_of_only_where_it_is_used() {
        let model = sample::residual();
        assert!(model.used_at("shoulder").is_none());
        let elbow = model.used_at("elbow").unwrap();
        assert_eq!(elbow.bends_with(), "position of elbow (21 % of its range)");
    }
}
