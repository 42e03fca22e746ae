use robot::{Machine, MachineFault, Reading, Robot};

use crate::effects::described::described_effects;
use crate::error::SimulatorError;
use crate::mechanics::arm::EngineArm;
use crate::mechanics::inject::{Efforts, Inject, Moment};
use crate::mechanics::plant::Plant;
use crate::mechanics::step_order::StepOrder;
use crate::sensors::{EffortSource, PositionSide, Sensors};

/// Speed above which a joint counts as run away (rad/s or m/s): ten times the speed of arms.
const RUNAWAY_SPEED: f64 = 200.0;

/// Largest `omega dt` of a spring that is applied step by step: its frequency is then off by
/// less than 0.2 % `((omega dt)^2 / 24)`.
const LARGEST_PHASE_STEP: f64 = 0.2;

/// How the engine is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    /// Length of the engine's step (s).
    pub step_s: f64,
    /// Steps for which a command is held.
    pub steps_per_period: usize,
    /// Whether joints stop at their limits.
    pub stops: bool,
    /// Power of the step with which the error falls.
    pub order: StepOrder,
}

/// A simulated arm, moved by rapier, changed by effects and measured by sensors.
///
/// ```text
/// M(q) qdd + C(q, qd) qd + g(q) + effects = tau
/// ```
///
/// A command is held for one period of the controller (zero-order hold). The engine takes many
/// steps per period.
pub struct Simulator {
    joints: Vec<Joint>,
    arm: EngineArm,
    effects: Vec<Box<dyn Inject>>,
    sensors: Sensors,
    steps_per_period: usize,
    steps: i64,
    needs_load: bool,
    goal_delay_s: f64,
    command: Option<Vec<f64>>,
    tau: Vec<f64>,
    efforts: Efforts,
    motor_torque: Vec<f64>,
    effort_at_read: Vec<f64>,
    links_at_read: Vec<Option<f64>>,
}

/// Constants of a joint.
#[derive(Debug, Clone)]
struct Joint {
    name: String,
    turns: bool,
    torque_gain: f64,
    torque_offset: f64,
    dry_forward: f64,
    dry_backward: f64,
    viscous: f64,
}

impl Simulator {
    /// Builds a simulated arm. Effects act in the order given, after those of the robot's description.
    ///
    /// # Errors
    ///
    /// [`SimulatorError`] when the arm with its effects cannot be simulated: a joint without
    /// inertia, or a spring too stiff for the step.
    pub fn new(
        robot: &Robot,
        effects: Vec<Box<dyn Inject>>,
        sensors: Sensors,
        stepping: Stepping,
    ) -> Result<Self, SimulatorError> {
        let mut effects: Vec<Box<dyn Inject>> = described_effects(robot).chain(effects).collect();
        let mut plant = Plant::new(robot.clone());
        for effect in &mut effects {
            effect.on_build(&mut plant);
        }
        if !stepping.stops {
            for i in 0..plant.robot.joint_count() {
                if let Some(link) = plant.robot.link_mut(i) {
                    link.joint.limits.position = None;
                }
            }
        }
        check_motors(&plant)?;
        let mut arm = EngineArm::new(&plant, stepping.step_s, stepping.order)
            .ok_or_else(|| SimulatorError::NoTree { robot: robot.name().to_owned() })?;
        let joints: Vec<Joint> = plant.robot.links().iter().map(Joint::of).collect();
        let mut springs: Vec<(usize, f64)> = effects.iter().flat_map(|e| e.springs()).collect();
        let elastic = plant.transmissions.iter().enumerate();
        springs.extend(elastic.filter_map(|(i, t)| Some((i, t.stiffness?))));
        check_inertias(&joints, &arm.inverse_inertia(), &springs, stepping.step_s)?;
        let count = joints.len();
        let needs_load =
            effects.iter().any(|e| e.needs_load()) || sensors.effort_source() == EffortSource::Link;
        Ok(Self {
            joints,
            arm,
            needs_load,
            goal_delay_s: effects.iter().map(|e| e.goal_delay_s()).sum(),
            effects,
            sensors,
            steps_per_period: stepping.steps_per_period.max(1),
            steps: 0,
            command: None,
            tau: vec![0.0; count],
            efforts: Efforts::none(count),
            motor_torque: vec![0.0; count],
            effort_at_read: vec![0.0; count],
            links_at_read: vec![None; count],
        })
    }

    /// Puts the arm at rest at `q` (rad or m) and sets its clock to zero.
    pub fn start(&mut self, q: &[f64]) {
        self.start_moving(q, &vec![0.0; q.len()]);
    }

    /// Puts the arm at positions `q` (rad or m) with velocities `qd` (rad/s or m/s) and sets its clock
    /// to zero.
    pub fn start_moving(&mut self, q: &[f64], qd: &[f64]) {
        self.start_with_deflection(q, qd, &vec![0.0; q.len()]);
    }

    /// The same with compliant transmissions deflected: link minus motor position is `twist` (rad or m).
    pub(crate) fn start_with_deflection(&mut self, q: &[f64], qd: &[f64], twist: &[f64]) {
        self.arm.set_state(q, qd, twist);
        self.steps = 0;
        self.command = None;
        self.motor_torque.fill(0.0);
        self.effort_at_read.fill(0.0);
        for effect in &mut self.effects {
            effect.on_start(q);
        }
        self.sensors.start();
    }

    /// Sets the clock to a number of periods before time zero.
    pub(crate) fn count_down(&mut self, periods: usize) {
        self.steps = -((periods * self.steps_per_period) as i64);
    }

    /// Feeds the commands before time zero through delays and lags, without moving the arm.
    pub(crate) fn send_past_commands(&mut self, past: &[Vec<f64>]) {
        self.count_down(past.len());
        for command in past {
            let before = self.command.take().unwrap_or_else(|| command.clone());
            for step in 0..self.steps_per_period {
                ask(&mut self.tau, step, &before, command);
                let moment = moment(&self.arm, self.steps);
                for effect in &mut self.effects {
                    effect.on_command(&moment, &mut self.tau);
                }
                self.steps += 1;
            }
            self.command = Some(command.clone());
        }
    }

    /// Time by which goals reach the controller late (s), the sum over all effects.
    pub(crate) fn goal_delay_s(&self) -> f64 {
        self.goal_delay_s
    }

    /// Apparent inertia of each joint at its present position, other joints free, rotor included
    /// (kg m² or kg).
    pub(crate) fn inertia(&mut self) -> Vec<f64> {
        self.arm.inverse_inertia().into_iter().map(f64::recip).collect()
    }

    /// Time since the start (s).
    pub fn time_s(&self) -> f64 {
        self.steps as f64 * self.arm.step_s()
    }

    /// True positions of the links (rad or m).
    pub fn q_true(&self) -> &[f64] {
        self.arm.q()
    }

    /// True velocities of the links (rad/s or m/s).
    pub fn qd_true(&self) -> &[f64] {
        self.arm.qd()
    }

    /// True positions of the motors, referred to the joint (rad or m).
    pub fn motor_q_true(&self) -> &[f64] {
        self.arm.motor_q()
    }

    /// True velocities of the motors, referred to the joint (rad/s or m/s).
    pub fn motor_qd_true(&self) -> &[f64] {
        self.arm.motor_qd()
    }

    /// Torque of the motors in the last step (N m or N).
    pub fn motor_torque_true(&self) -> &[f64] {
        &self.motor_torque
    }

    /// Torque that each transmission carried in the last step (N m or N); zero unless something needs it.
    pub(crate) fn load_true(&self) -> &[f64] {
        self.arm.transmitted_torque()
    }

    /// The log row of the last [`read`](Machine::read): positions and velocities as read, effort of the
    /// same instant. To be called after [`actuate`](Machine::actuate).
    pub fn record(&mut self, read: &Reading, row: &mut Reading) {
        row.clone_from(read);
        row.effort.clone_from(&self.effort_at_read);
        for effect in &mut self.effects {
            effect.on_record(row);
        }
        self.sensors.add_effort_noise(&mut row.effort);
    }

    /// Readings of the encoders at the links in the same row, in the order of the robot; `None` for a
    /// joint without one.
    pub fn record_links(&mut self, read: &Reading) -> Vec<Option<f64>> {
        let mut links = self.links_at_read.clone();
        for effect in &mut self.effects {
            effect.on_record_links(read.time_s, &mut links);
        }
        links
    }

    /// One step of the engine under the commanded torque, averaged over the step (N m or N).
    fn step(&mut self) -> Result<(), MachineFault> {
        let moment = moment(&self.arm, self.steps);
        for effect in &mut self.effects {
            effect.on_command(&moment, &mut self.tau);
        }
        for (i, joint) in self.joints.iter().enumerate() {
            self.tau[i] = (self.tau[i] - joint.torque_offset) / joint.torque_gain;
            joint.start(&mut self.efforts, i, self.tau[i]);
        }
        self.efforts.pushes.clear();
        self.motor_torque.copy_from_slice(&self.tau);
        for effect in &mut self.effects {
            effect.on_substep(&moment, &mut self.efforts);
        }
        self.arm.step(&self.efforts);
        self.steps += 1;
        self.sensors.watch_links(self.steps as f64 * self.arm.step_s(), self.arm.q());
        if self.needs_load {
            self.arm.measure_load(&self.efforts);
        }
        self.check()
    }

    fn check(&self) -> Result<(), MachineFault> {
        for (i, joint) in self.joints.iter().enumerate() {
            let (q, speed) = (self.arm.q()[i], self.arm.qd()[i]);
            if q.is_finite() && speed.abs() <= RUNAWAY_SPEED {
                continue;
            }
            let unit = if joint.turns { "rad/s" } else { "m/s" };
            let readable = speed.abs() < 1e6;
            let speed = if readable { format!("{speed:.1}") } else { format!("{speed:.1e}") };
            return Err(MachineFault {
                time_s: self.time_s(),
                joint: joint.name.clone(),
                found: format!("its speed is {speed} {unit}, at most {RUNAWAY_SPEED} {unit} was expected"),
                advice: "lower the gains or the torques, give the joint's motor its rotor inertia, or shorten the engine's step".to_owned(),
            });
        }
        Ok(())
    }

    /// Records the effort at the instant of the last read (N m or N).
    fn sample_effort(&mut self, command: &[f64]) {
        let source = self.sensors.effort_source();
        for (i, joint) in self.joints.iter().enumerate() {
            let reported = |tau: f64| joint.torque_gain * tau + joint.torque_offset;
            self.effort_at_read[i] = match source {
                EffortSource::Commanded => command[i],
                EffortSource::Motor => reported(self.motor_torque[i]),
                EffortSource::Link => reported(self.arm.transmitted_torque()[i]),
            };
        }
    }
}

impl Machine for Simulator {
    fn joint_count(&self) -> usize {
        self.joints.len()
    }

    fn period_s(&self) -> f64 {
        self.steps_per_period as f64 * self.arm.step_s()
    }

    fn read(&mut self, reading: &mut Reading) -> Result<(), MachineFault> {
        reading.time_s = self.time_s();
        let (q, qd) = match self.sensors.position_side() {
            PositionSide::Motor => (self.arm.motor_q(), self.arm.motor_qd()),
            PositionSide::Link => (self.arm.q(), self.arm.qd()),
        };
        reading.q.clear();
        reading.q.extend_from_slice(q);
        reading.qd.clear();
        reading.qd.extend_from_slice(qd);
        reading.effort.clone_from(&self.effort_at_read);
        for effect in &mut self.effects {
            effect.on_reading(reading);
        }
        let period_s = self.period_s();
        self.sensors.measure(reading, period_s);
        self.links_at_read = self.sensors.measure_links(reading.time_s, self.arm.q());
        Ok(())
    }

    fn link_positions(&self) -> Option<&[f64]> {
        Some(self.arm.q())
    }

    fn actuate(&mut self, effort: &[f64]) -> Result<(), MachineFault> {
        let before = self.command.take().unwrap_or_else(|| effort.to_vec());
        for step in 0..self.steps_per_period {
            ask(&mut self.tau, step, &before, effort);
            self.step()?;
            if step == 0 {
                self.sample_effort(effort);
            }
        }
        self.command = Some(effort.to_vec());
        Ok(())
    }
}

impl Joint {
    /// Initialises the efforts of joint `i` with the motor torque and the actuator's friction.
    fn start(&self, efforts: &mut Efforts, i: usize, tau: f64) {
        efforts.motor[i] = tau;
        efforts.link[i] = 0.0;
        efforts.dry_forward[i] = self.dry_forward;
        efforts.dry_backward[i] = self.dry_backward;
        efforts.viscous[i] = self.viscous;
        efforts.bristles[i] = 0.0;
    }

    fn of(link: &robot::Link) -> Self {
        Self {
            name: link.joint.name.clone(),
            turns: link.joint.kind.is_rotation(),
            torque_gain: link.actuator.torque_gain,
            torque_offset: link.actuator.torque_offset,
            dry_forward: link.actuator.coulomb_forward,
            dry_backward: link.actuator.coulomb_backward,
            viscous: link.actuator.viscous,
        }
    }
}

/// State of the arm at the beginning of a step.
fn moment(arm: &EngineArm, steps: i64) -> Moment<'_> {
    Moment {
        time_s: steps as f64 * arm.step_s(),
        step_s: arm.step_s(),
        motor_q: arm.motor_q(),
        motor_qd: arm.motor_qd(),
        q: arm.q(),
        qd: arm.qd(),
        load: arm.transmitted_torque(),
    }
}

/// The commanded torque, averaged over step `step` of a period.
///
/// The command changes in the middle of the first step, which therefore gets the mean of both.
fn ask(tau: &mut [f64], step: usize, before: &[f64], command: &[f64]) {
    let old = if step == 0 { 0.5 } else { 0.0 };
    for (tau, (b, c)) in tau.iter_mut().zip(before.iter().zip(command)) {
        *tau = old * b + (1.0 - old) * c;
    }
}

/// Refuses a motor without inertia behind a compliant transmission.
fn check_motors(plant: &Plant) -> Result<(), SimulatorError> {
    for (link, transmission) in plant.robot.links().iter().zip(&plant.transmissions) {
        let inertia = link.actuator.rotor_inertia;
        if !transmission.is_rigid() && inertia <= 0.0 {
            return Err(SimulatorError::NoRotorInertia { joint: link.joint.name.clone(), inertia });
        }
    }
    Ok(())
}

fn check_inertias(
    joints: &[Joint],
    inverse_inertia: &[f64],
    springs: &[(usize, f64)],
    step_s: f64,
) -> Result<(), SimulatorError> {
    for (joint, &inverse) in joints.iter().zip(inverse_inertia) {
        if !(inverse.is_finite() && inverse > 0.0) {
            return Err(SimulatorError::NoInertia { joint: joint.name.clone() });
        }
    }
    for (i, joint) in joints.iter().enumerate() {
        let stiffness: f64 = springs.iter().filter(|s| s.0 == i).map(|s| s.1).sum();
        let omega = (stiffness * inverse_inertia[i]).sqrt();
        if omega * step_s > LARGEST_PHASE_STEP {
            return Err(SimulatorError::SpringTooStiff {
                joint: joint.name.clone(),
                stiffness,
                frequency_hz: omega / std::f64::consts::TAU,
                step_ms: 1e3 * step_s,
                longest_step_ms: 1e3 * LARGEST_PHASE_STEP / omega,
            });
        }
    }
    Ok(())
}
