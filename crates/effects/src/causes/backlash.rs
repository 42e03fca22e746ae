use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::abilities::{BetweenEncoders, HasShape, ShapedDrive};
use crate::bounds::down_to_zero;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::motion::transmission::{Gap, LoadAlong, play};
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// Motor and link are apart by half the gap, on the side of the load. One weight a joint: the change of the gap (rad
/// or m).
///
/// The time that the link takes from side to side grows with the third root of the gap, and signals delayed by a tenth
/// of a second are uncorrelated with the undelayed ones. So a robot without a gap gets the column of a trial gap, and
/// a robot with one gets the difference between two gaps.
pub(crate) struct Backlash;

/// Trial gaps (rad or m), each one and a half times the one before. Gaps below the first are crossed as fast as the
/// first.
const TRIALS: [f64; 9] = [0.002, 0.003, 0.0045, 0.007, 0.01, 0.015, 0.022, 0.033, 0.05];

/// Gap of the column where no trial gap is set (rad or m).
const SMALL: f64 = 0.005;

/// Relative step of the gap in the central difference.
const STEP: f64 = 0.1;

impl Effect for Backlash {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::Backlash
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Exact,
            Location::BeforeTheLink,
            Weights::Direct,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("half the gap on the side of the load, eased where the load changes sign")
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        (drive.backlash > 0.0).then_some("backlash_rad")
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let carried = LoadAlong::at_motor(motion.rigid_load(j), &motion.slopes(j)[j]);
        vec![motion.twist_column(j, &play_per_gap(motion, j, carried))]
    }

    fn prior(&self, _: AtJoint, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.gap_sd]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        down_to_zero(robot.links()[j].actuator.backlash)
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        _: &Frame,
        _: &Priors,
    ) {
        let [change] = weights else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.backlash += change;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.backlash)]
    }

    fn shape(&self) -> Option<&dyn HasShape> {
        Some(self)
    }

    fn between_encoders(&self) -> Option<&dyn BetweenEncoders> {
        Some(self)
    }
}

impl HasShape for Backlash {
    fn shapes(&self, AtJoint(joint): AtJoint, robot: &Robot, _: &Scale, _: &Priors) -> Vec<f64> {
        let known = robot.links()[joint].actuator.backlash > 0.0;
        if known { Vec::new() } else { TRIALS.to_vec() }
    }

    fn set_shape(&self, _: usize, shaped: ShapedDrive<'_>, shape: f64) {
        *shaped.trial_gap = shape;
    }

    /// A trial gap is no part of the drive.
    fn drop_unused_shape(&self, _: &mut Actuator, _: &Actuator) {}
}

impl BetweenEncoders for Backlash {
    fn twist(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let ratio = motion.drives[j].transmission_ratio;
        let play =
            play_per_gap(motion, j, LoadAlong::at_link(&motion.load[j], &motion.slopes(j)[j]));
        vec![at_joint(j, play.into_iter().map(|x| x / ratio))]
    }
}

/// Change of `theta - q` at joint `j` per unit of gap.
fn play_per_gap(motion: &RunMotion, j: usize, carried: LoadAlong<'_>) -> Vec<f64> {
    let drive = &motion.drives[j];
    let at = |gap: f64| play(carried, Gap::of(drive, gap), motion.period_s);
    let (gap, trial) = (drive.backlash, motion.trial_gaps[j]);
    if gap > 0.0 {
        let (wide, narrow) = (at((1.0 + STEP) * gap), at((1.0 - STEP) * gap));
        wide.iter().zip(narrow).map(|(w, n)| (w - n) / (2.0 * STEP * gap)).collect()
    } else {
        let gap = if trial > 0.0 { trial } else { SMALL };
        at(gap).iter().map(|x| x / gap).collect()
    }
}
