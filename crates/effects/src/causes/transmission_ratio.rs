use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::abilities::{BetweenEncoders, IsRestricted};
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, Traits, Weights};

/// `ratio tau(ratio q, ratio qd, ratio qdd) - tau(q, qd, qdd)`: one weight a joint, the change of
/// the ratio.
pub(crate) struct TransmissionRatio;

impl Effect for TransmissionRatio {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::TransmissionRatio
    }

    fn traits(&self) -> Traits {
        const RELATIONS: &[Relation] = &[Relation::PlainerHere(EffectKind::TorqueConstant)];
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Exact,
            Location::BeforeTheLink,
            Weights::Direct,
            RELATIONS,
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("reference and torque in the units that the drive believes in")
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        drive.transmission_ratio.total_cmp(&1.0).is_ne().then_some("transmission_ratio")
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let drive = &motion.drives[j];
        let over =
            |x: &Vec<f64>| -> Vec<f64> { x.iter().map(|x| x / drive.transmission_ratio).collect() };
        let [q, qd, qdd] = [&motion.q[j], &motion.qd[j], &motion.qdd[j]].map(over);
        let mut column = motion.displacement_column(j, [&q, &qd, &qdd]);
        let gain = motion.gain[j];
        // Effort for the same torque, and what the drive itself needs to move otherwise.
        for part in column.iter_mut().filter(|part| part.joint == j) {
            for (t, value) in part.values.iter_mut().enumerate() {
                let own = drive.viscous * qd[t] + drive.rotor_inertia * qdd[t];
                *value += gain * (motion.torque[j][t] / drive.transmission_ratio + own);
            }
        }
        vec![column]
    }

    fn prior(&self, _: AtJoint, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.transmission_ratio_sd]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, priors: &Priors) -> Vec<(f64, f64)> {
        let largest =
            priors.transmission_ratio_limit * robot.links()[j].actuator.transmission_ratio;
        vec![(-largest, largest)]
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
            link.actuator.transmission_ratio += change;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.transmission_ratio)]
    }

    fn between_encoders(&self) -> Option<&dyn BetweenEncoders> {
        Some(self)
    }

    fn restriction(&self) -> Option<&dyn IsRestricted<AtJoint>> {
        Some(self)
    }
}

impl BetweenEncoders for TransmissionRatio {
    fn twist(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let drive = &motion.drives[j];
        let reported = motion.twist(j).into_iter().zip(&motion.link[0][j]);
        let turned = reported.map(|(twist, q)| twist + q - drive.encoder_offset);
        vec![at_joint(j, turned.map(|turned| -turned / drive.transmission_ratio))]
    }
}

impl IsRestricted<AtJoint> for TransmissionRatio {
    /// A ratio at its limit is rejected.
    fn admissible(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        weights: &[f64],
        priors: &Priors,
    ) -> bool {
        let [change] = weights else { return false };
        let ratio = robot.links()[j].actuator.transmission_ratio;
        change.abs() < (1.0 - 1e-9) * priors.transmission_ratio_limit * ratio
    }
}
