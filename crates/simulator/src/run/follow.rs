use motion::State;
use robot::{Machine, MachineFault, PdGain, Reading, Robot};

use crate::effects::spec::EffectSpec;
use crate::error::SimulatorError;
use crate::mechanics::inject::Inject;
use crate::run::arm_state::ArmState;
use crate::run::goals::Goals;
use crate::scenario::check::ScenarioRun;
use crate::scenario::spec::ServoSpec;
use crate::sensors::Sensors;
use crate::simulator::{Simulator, Stepping};
use crate::strangers::spec::StrangerSpec;
use crate::{effects, strangers};

/// The effects and strangers in an arm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArmCauses<'a> {
    pub effects: &'a [EffectSpec],
    pub strangers: &'a [StrangerSpec],
}

/// One row of a log, with the reference or goal that was sent.
#[derive(Debug, Clone)]
pub(crate) struct ControlRow {
    pub reading: Reading,
    /// Readings of the encoders at the links; `None` for a joint without one.
    pub links: Vec<Option<f64>>,
    pub command: Vec<f64>,
    pub reference: State,
    /// What the arm did at the instant of the reading.
    pub state: ArmState,
}

/// A motion and the controller that follows it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Following<'a> {
    pub gains: &'a [PdGain],
    pub robot: &'a Robot,
    pub run: &'a ScenarioRun,
    /// The servos that follow it; `None` for a controller that knows the velocity of the motion.
    pub servo: Option<ServoSpec>,
    /// Longest part of the motion that is followed (s).
    pub longest_s: f64,
}

/// Builds a simulator. Strangers of the drive act first, then the effects, then all other strangers.
pub(crate) fn simulator(
    robot: &Robot,
    causes: ArmCauses<'_>,
    sensors: Sensors,
    stepping: Stepping,
) -> Result<Simulator, SimulatorError> {
    Simulator::new(robot, all_laws(robot, causes)?, sensors, stepping)
}

/// The laws of effects and strangers, in the order in which they act.
pub(crate) fn all_laws(
    robot: &Robot,
    causes: ArmCauses<'_>,
) -> Result<Vec<Box<dyn Inject>>, SimulatorError> {
    let ArmCauses { effects, strangers } = causes;
    let injected: Vec<Box<dyn Inject>> =
        effects::chain::inject_all(effects, robot).map_err(|(index, mistake)| {
            SimulatorError::Effect {
                effect: effects[index].kind(),
                key: mistake.key.to_owned(),
                found: mistake.found,
            }
        })?;
    let around = strangers::chain::inject_all(strangers, robot).map_err(|(index, mistake)| {
        SimulatorError::Stranger {
            stranger: strangers[index].kind(),
            key: mistake.key.to_owned(),
            found: mistake.found,
        }
    })?;
    Ok(around.ahead.into_iter().chain(injected).chain(around.behind).collect())
}

/// Follows a motion with `tau = kp (q_ref - q) + kd (qd_ref - qd)`, or its goals as a [`ServoSpec`] says, within the
/// torque limits.
///
/// A motion that starts at rest is held at its start for the lead-in before time zero. Any other
/// motion starts without a lead-in.
pub(crate) fn follow(
    simulator: &mut Simulator,
    following: &Following<'_>,
    on_second: &dyn Fn(),
) -> Result<Vec<ControlRow>, MachineFault> {
    let Following { gains, robot, run, servo, longest_s } = *following;
    let period_s = simulator.period_s();
    let mut goals = Goals::new(&run.motion, servo, simulator.goal_delay_s());
    let reference = run.motion.at(0.0);
    let at_rest = reference.qd.iter().all(|qd| qd.abs() <= 1e-9);
    let lead_in = if at_rest { (run.lead_in_s / period_s).round() as usize } else { 0 };
    simulator.start_moving(&reference.q, &reference.qd);
    simulator.count_down(lead_in);
    let count = (run.motion.duration_s().min(longest_s) / period_s).round() as usize + 1;
    let mut reading = Reading::zero(robot.joint_count());
    let mut command = vec![0.0; robot.joint_count()];
    let mut rows = Vec::with_capacity(count);
    for tick in 0..lead_in + count {
        let time_s = (tick as f64 - lead_in as f64) * period_s;
        goals.advance(time_s.max(0.0));
        simulator.read(&mut reading)?;
        let state = (tick >= lead_in).then(|| ArmState::of(simulator));
        feedback(gains, robot, goals.of_loop(), &reading, &mut command);
        simulator.actuate(&command)?;
        let mut row = Reading::default();
        simulator.record(&reading, &mut row);
        let links = simulator.record_links(&reading);
        if let Some(state) = state {
            row.time_s = time_s;
            let (command, reference) = (command.clone(), goals.of_log().clone());
            rows.push(ControlRow { reading: row, links, command, reference, state });
            if (time_s + period_s).floor() > time_s.floor() {
                on_second();
            }
        }
    }
    Ok(rows)
}

fn feedback(
    gains: &[PdGain],
    robot: &Robot,
    reference: &State,
    reading: &Reading,
    command: &mut [f64],
) {
    for (i, (gain, link)) in gains.iter().zip(robot.links()).enumerate() {
        let limit = link.joint.limits.effort.unwrap_or(f64::INFINITY);
        let tau =
            gain.kp * (reference.q[i] - reading.q[i]) + gain.kd * (reference.qd[i] - reading.qd[i]);
        command[i] = tau.clamp(-limit, limit);
    }
}
