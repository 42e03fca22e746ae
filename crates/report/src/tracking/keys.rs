use crate::learning::comparison::ComparedJoint;
use crate::tracking::comparison::{TrackedModel, TrackingComparison};
use pages::{Ink, LegendKey, significant};

impl ComparedJoint {
    /// Unit of its position.
    pub(crate) fn position_unit(&self) -> &'static str {
        if self.effort_unit == "N" { "m" } else { "rad" }
    }
}

impl TrackingComparison {
    /// The colours of the models, which are the same in every figure.
    pub(crate) fn inks(&self) -> Vec<Ink> {
        Ink::of_models(self.models.iter().map(|model| model.name.as_str()))
    }

    /// The colour of a model; that of a first one for a name that no run has.
    pub(crate) fn ink_of(&self, name: &str) -> Ink {
        let mut models = self.models.iter().zip(self.inks());
        models.find(|(model, _)| model.name == name).map_or(Ink::Model(0), |(_, ink)| ink)
    }

    /// The models as names of a legend; one whose run was stopped says so.
    pub(crate) fn keys(&self) -> Vec<LegendKey> {
        let key = |(model, ink): (&TrackedModel, Ink)| {
            let stopped = if model.stopped.is_some() { " (stopped)" } else { "" };
            LegendKey { name: format!("{}{stopped}", model.name), ink }
        };
        self.models.iter().zip(self.inks()).map(key).collect()
    }

    /// Unit of a thousandth of a position, of all joints.
    pub(crate) fn thousandths(&self) -> &'static str {
        let slides = self.joints.iter().filter(|joint| joint.position_unit() == "m").count();
        match slides {
            0 => "mrad",
            all if all == self.joints.len() => "mm",
            _ => "mrad or mm",
        }
    }

    /// Motion, time and gains of all runs, in words.
    pub(crate) fn circumstances(&self) -> String {
        let time = significant(self.duration_s, 3);
        format!("{}, {time} s, gains {}, {}", self.motion, self.gains.name, self.clock)
    }
}

impl TrackedModel {
    /// The error at a joint over a run that is whole (rad); not a number otherwise.
    pub(crate) fn error(&self, joint: usize) -> f64 {
        let error = self.rmse_rad.get(joint).filter(|_| self.stopped.is_none());
        error.copied().unwrap_or(f64::NAN)
    }
}
