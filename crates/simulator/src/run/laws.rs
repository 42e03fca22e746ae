use robot::{Reading, Robot};

use crate::effects::described::described_effects;
use crate::effects::spec::EffectSpec;
use crate::error::SimulatorError;
use crate::mechanics::inject::{Efforts, Inject, Moment};
use crate::mechanics::plant::Plant;
use crate::run::arm_state::ArmState;
use crate::run::follow::{ArmCauses, all_laws};
use crate::run::true_run::{TrueRow, TrueRun};
use crate::sensors::PositionSide;
use crate::strangers::spec::StrangerSpec;

/// Longest time between two calls of a law (s), the longest step of a simulated trial.
const LONGEST_S: f64 = 2e-3;

/// The laws of effects and strangers, evaluated along a motion that is given: nothing moves because of them.
///
/// ```text
/// q, qd, command of every row --laws--> lost on the way to the motor, torque and friction, readings
/// ```
///
/// Along one motion the laws with and without an effect differ by what the effect adds, while in two simulations
/// every other torque differs too.
pub struct ActingLaws {
    plant: Plant,
    laws: Vec<Box<dyn Inject>>,
}

/// What the laws give at one row of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct LawRow {
    /// Command less what of it reaches the motor, in the unit of the command (N m or N).
    pub lost: Vec<f64>,
    /// Torques, levels of friction and forces.
    pub efforts: Efforts,
    /// What the encoder that the controller reads would say (rad or m, and per s).
    pub reading: Reading,
}

impl ActingLaws {
    /// The laws of a robot, its described effects included, in the order in which a simulation applies them.
    ///
    /// # Errors
    ///
    /// [`SimulatorError`] for an effect that the robot cannot have.
    pub fn new(
        robot: &Robot,
        effects: &[EffectSpec],
        strangers: &[StrangerSpec],
    ) -> Result<Self, SimulatorError> {
        let causes = all_laws(robot, ArmCauses { effects, strangers })?;
        let mut laws: Vec<Box<dyn Inject>> = described_effects(robot).chain(causes).collect();
        let mut plant = Plant::new(robot.clone());
        for law in &mut laws {
            law.on_build(&mut plant);
        }
        Ok(Self { plant, laws })
    }

    /// The arm with all that the effects change in it: bodies, gravity, levels of friction, gains, transmissions.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// Calls `on_row` with every row of a run. Between rows the motion is linear, in steps of at most 2 ms, and
    /// before the first one it is that of the first row.
    pub fn along(
        &mut self,
        run: &TrueRun,
        side: PositionSide,
        on_row: &mut dyn FnMut(usize, &LawRow),
    ) {
        let count = self.plant.robot.joint_count();
        let mut row = LawRow {
            lost: vec![0.0; count],
            efforts: Efforts::none(count),
            reading: Reading::zero(count),
        };
        self.laws.iter_mut().for_each(|law| law.on_start(&run.start_q));
        let Some(first) = run.rows.first() else { return };
        let held = (run.lead_in_s / LONGEST_S).round() as usize;
        for k in (1..=held).rev() {
            let time_s = first.time_s - k as f64 * LONGEST_S;
            self.act(&TrueRow { time_s, ..first.clone() }, LONGEST_S, &mut row);
        }
        let mut before = first;
        for (i, now) in run.rows.iter().enumerate() {
            let length_s = now.time_s - before.time_s;
            let steps = (length_s / LONGEST_S - 1e-6).ceil().max(1.0) as usize;
            let step_s = if i == 0 { LONGEST_S } else { length_s / steps as f64 };
            for k in 1..steps {
                self.act(&between(before, now, k as f64 / steps as f64), step_s, &mut row);
            }
            self.act(now, step_s, &mut row);
            self.read(&now.state, side, now.time_s, &mut row.reading);
            on_row(i, &row);
            before = now;
        }
    }

    fn act(&mut self, at: &TrueRow, step_s: f64, row: &mut LawRow) {
        let ArmState { motor_q, motor_qd, q, qd, load } = &at.state;
        let moment = Moment { time_s: at.time_s, step_s, motor_q, motor_qd, q, qd, load };
        let mut tau = at.command.clone();
        self.laws.iter_mut().for_each(|law| law.on_command(&moment, &mut tau));
        let pairs = at.command.iter().zip(&tau);
        row.lost.iter_mut().zip(pairs).for_each(|(lost, (asked, given))| *lost = asked - given);
        for (j, link) in self.plant.robot.links().iter().enumerate() {
            let (drive, efforts) = (&link.actuator, &mut row.efforts);
            (efforts.motor[j], efforts.link[j], efforts.bristles[j]) = (0.0, 0.0, 0.0);
            efforts.dry_forward[j] = drive.coulomb_forward;
            efforts.dry_backward[j] = drive.coulomb_backward;
            efforts.viscous[j] = drive.viscous;
        }
        row.efforts.pushes.clear();
        self.laws.iter_mut().for_each(|law| law.on_substep(&moment, &mut row.efforts));
    }

    fn read(&mut self, at: &ArmState, side: PositionSide, time_s: f64, reading: &mut Reading) {
        let (q, qd) = match side {
            PositionSide::Motor => (&at.motor_q, &at.motor_qd),
            PositionSide::Link => (&at.q, &at.qd),
        };
        reading.time_s = time_s;
        reading.q.clone_from(q);
        reading.qd.clone_from(qd);
        self.laws.iter_mut().for_each(|law| law.on_reading(reading));
    }
}

fn between(a: &TrueRow, b: &TrueRow, part: f64) -> TrueRow {
    let of = |a: &f64, b: &f64| a + part * (b - a);
    TrueRow {
        time_s: of(&a.time_s, &b.time_s),
        state: a.state.towards(&b.state, part),
        command: a.command.iter().zip(&b.command).map(|(a, b)| of(a, b)).collect(),
    }
}
