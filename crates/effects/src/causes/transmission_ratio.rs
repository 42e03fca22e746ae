use catalogue::EffectKind;
use robot::Robot;

use crate::column::{Column, at_joint};
use crate::effect::Explain;
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::{Place, every_joint};
use crate::quantity::{Quantity, actuator_quantity};
use crate::traits::{Law, Linearity, Nature, Relation, Seat, Weights};

/// `ratio tau(ratio q, ratio qd, ratio qdd) - tau(q, qd, qdd)`: one weight a joint, the change of
/// the ratio.
pub(crate) struct TransmissionRatio;

/// Standard deviation of a ratio before any data: published ratios of one arm differ by up to
/// 4.3 per cent (Barrett WAM).
const RATIO_SD: f64 = 0.03;

/// Largest believable relative error of a ratio: more than that of a pulley that was taken for
/// another one.
const RATIO_LIMIT: f64 = 0.25;

impl Explain for TransmissionRatio {
    fn kind(&self) -> EffectKind {
        EffectKind::TransmissionRatio
    }

    fn nature(&self) -> Nature {
        const RELATIONS: &[Relation] = &[Relation::PlainerHere(EffectKind::TorqueConstant)];
        Nature::new(Linearity::Doubtful, Law::Firm, Seat::BeforeTheLink, Weights::Direct, RELATIONS)
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let drive = &motion.drives[j];
        let over =
            |x: &Vec<f64>| -> Vec<f64> { x.iter().map(|x| x / drive.transmission_ratio).collect() };
        let [q, qd, qdd] = [&motion.q[j], &motion.qd[j], &motion.qdd[j]].map(over);
        let mut column = motion.displaced(j, [&q, &qd, &qdd]);
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

    fn twist(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let drive = &motion.drives[j];
        let reported = motion.twist(j).into_iter().zip(&motion.link[0][j]);
        let turned = reported.map(|(twist, q)| twist + q - drive.encoder_offset);
        vec![at_joint(j, turned.map(|turned| -turned / drive.transmission_ratio))]
    }

    fn prior(&self, _: Place, _: &Robot, _: &Scale) -> Vec<f64> {
        vec![RATIO_SD]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        let largest = RATIO_LIMIT * robot.links()[j].actuator.transmission_ratio;
        vec![(-largest, largest)]
    }

    /// A ratio at the limit of what is believable is no explanation.
    fn admissible(&self, place: Place, robot: &Robot, weights: &[f64]) -> bool {
        let (Place::Joint(j), [change]) = (place, weights) else { return false };
        let ratio = robot.links()[j].actuator.transmission_ratio;
        change.abs() < (1.0 - 1e-9) * RATIO_LIMIT * ratio
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.transmission_ratio += change;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.transmission_ratio)]
    }
}
