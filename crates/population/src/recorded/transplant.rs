use catalogue::EffectKind;
use logs::Run;
use robot::Robot;
use simulator::Truth;

use crate::recorded::law::AddedLaw;
use crate::recorded::signals::average;
use crate::recorded::size::{Added, Measured, Own};
use crate::sheet::{CauseRole, Strength, TrueCause, TrueStranger};

/// A cause added to the efforts of recorded logs as a closed form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transplant {
    /// The torque.
    pub law: AddedLaw,
    /// Index of the joint where it acts; unused by laws of all joints.
    pub joint: usize,
}

/// The entry of a transplant in a sheet.
pub(super) enum AddedCause {
    /// An effect of the catalogue.
    Named(TrueCause),
    /// An effect outside the catalogue.
    Stranger(TrueStranger),
}

impl Transplant {
    /// Adds it to the efforts of a run.
    pub fn add(&self, robot: &Robot, run: &mut Run) {
        let torque = self.law.torque(robot, run, self.joint);
        for (channels, torque) in run.joints.iter_mut().zip(&torque) {
            channels.effort.iter_mut().zip(torque).for_each(|(effort, more)| *effort += more);
        }
    }

    /// Its visibility in the logs without it, see [`Strength`]. Since the true arm is unknown, only a constant, the
    /// velocity, its direction and the acceleration of the same joint may explain it instead, and noise is estimated
    /// from changes of the effort within 60 ms. Joints that move less than .1 rad or 1 cm do not count.
    pub fn strength(&self, robot: &Robot, runs: &[Run]) -> Strength {
        Measured::new(robot, runs).strength(&self.added_torque(robot, runs), self.own())
    }

    /// Its torque in runs. A skew acts on efforts averaged over 20 ms to either side, so that shifted noise does
    /// not count.
    pub(super) fn added_torque(&self, robot: &Robot, runs: &[Run]) -> Added {
        let added = |run: &Run| match self.law {
            AddedLaw::Late { .. } => self.law.torque(robot, &smooth(run), self.joint),
            _ => self.law.torque(robot, run, self.joint),
        };
        runs.iter().map(added).collect()
    }

    /// The everyday column that it is itself. Asymmetric friction is dry friction with two levels.
    fn own(&self) -> Own {
        match self.law {
            AddedLaw::Coulomb { .. } | AddedLaw::Asymmetric { .. } => Own::Direction,
            AddedLaw::Viscous { .. } => Own::Velocity,
            AddedLaw::Offset { .. } => Own::Constant,
            _ => Own::Nothing,
        }
    }

    /// Its entry in a sheet, with parameters under the catalogue's names.
    pub(super) fn cause(&self, robot: &Robot, strength: Strength) -> AddedCause {
        let here = robot.links()[self.joint].joint.name.as_str();
        let tip = robot.links().last().map_or("", |link| link.name.as_str());
        let at = |effect, parameters: &[(&str, f64)]| Truth::at_joint(effect, here, parameters);
        let stranger = |name: &str| {
            let joint = Some(here.to_owned());
            AddedCause::Stranger(TrueStranger {
                name: name.to_owned(),
                joint,
                strength,
                spoiling: None,
            })
        };
        let truth = match self.law {
            AddedLaw::Coulomb { level } => at(EffectKind::CoulombFriction, &[("level", level)]),
            AddedLaw::Viscous { viscous } => {
                at(EffectKind::ViscousFriction, &[("viscous", viscous)])
            }
            AddedLaw::Asymmetric { forward, backward } => {
                at(EffectKind::AsymmetricFriction, &[("forward", forward), ("backward", backward)])
            }
            AddedLaw::Offset { offset } => at(EffectKind::TorqueOffset, &[("offset", offset)]),
            AddedLaw::Gain { gain } => at(EffectKind::TorqueConstant, &[("gain", gain)]),
            AddedLaw::Spring { stiffness, rest } => {
                let loop_of_none = [("cubic", 0.0), ("hysteresis", 0.0)];
                let spring = [("stiffness", stiffness), ("rest", rest)];
                at(EffectKind::CableSpring, &[spring, loop_of_none].concat())
            }
            AddedLaw::Load { coefficient } => {
                at(EffectKind::LoadDependentFriction, &[("coefficient", coefficient)])
            }
            AddedLaw::Ripple { amplitude, periods, phase } => at(
                EffectKind::TorqueRipple,
                &[("amplitude", amplitude), ("periods_per_turn", periods), ("phase", phase)],
            ),
            AddedLaw::PointMass(body) => {
                let [x, y, z] = body.com;
                let parameters = [("mass", body.mass), ("com_x", x), ("com_y", y), ("com_z", z)];
                Truth::at_link(EffectKind::Payload, tip, &parameters)
            }
            AddedLaw::Late { skew } => Truth::everywhere(EffectKind::TimeSkew, &[("skew", skew)]),
            AddedLaw::Drag { .. } => return stranger("square_drag"),
            AddedLaw::Well { .. } => return stranger("magnet_well"),
        };
        AddedCause::Named(TrueCause { role: CauseRole::Hidden, truth, strength })
    }
}

/// A run with its efforts averaged over 20 ms either side.
fn smooth(run: &Run) -> Run {
    let mut run = run.clone();
    for channels in &mut run.joints {
        channels.effort = average(&run.time, &channels.effort);
    }
    run
}
