use robot::Robot;

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::strangers::kind::StrangerKind;
use crate::strangers::truth::StrangerTruth;

/// Something at one place of a joint's range, strongest at or beside its centre.
pub(crate) struct Bump<'a> {
    pub joint: &'a str,
    /// Position of the centre (rad or m).
    pub centre: f64,
    /// Distance from the centre at which it counts (rad or m).
    pub width: f64,
    /// Largest torque or level of friction (N m or N).
    pub peak: f64,
}

impl Bump<'_> {
    pub(crate) fn truth(&self, kind: StrangerKind) -> StrangerTruth {
        let parameters = [("centre", self.centre), ("width", self.width), ("peak", self.peak)];
        StrangerTruth::at_joint(kind, self.joint, &parameters)
    }

    /// The index of its joint, once its values are those of an arm.
    ///
    /// # Errors
    ///
    /// [`Mistake`], the first found.
    pub(crate) fn check(&self, robot: &Robot) -> Result<usize, Mistake> {
        let joint = joint_of(robot, self.joint)?;
        within("centre_rad", self.centre, -100.0, 100.0)?;
        within("width_rad", self.width, 1e-4, 100.0)?;
        within("peak_nm", self.peak, 0.0, 1000.0)?;
        Ok(joint)
    }
}
