//! Error of a simulated second against the length of its steps, and the time that it takes:
//!
//! ```text
//! cargo run --release -p simulator --example steps -- CASE.json ...
//! ```
//!
//! prints one line of JSON a case, order and step; `CASE.json second 0.1` simulates one second in that order and step (ms). `crates/simulator/benches/mujoco_steps.py` makes the cases, and puts
//! MuJoCo's figures beside these.

use std::path::PathBuf;
use std::time::Instant;

use nalgebra::{Isometry3, Point3};
use robot::{Machine, MachineFault, Reading, Robot};
use serde::{Deserialize, Serialize};
use simulator::{Sensors, Simulator, StepOrder, Stepping};

/// Time from one command to the next (s).
const PERIOD_S: f64 = 2e-3;

/// Commands in the second that is simulated.
const PERIODS: usize = 500;

/// Steps (ms), the finest first.
const STEPS_MS: [f64; 8] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0];

/// The same second is simulated for at least this time (s); the quickest one counts.
const MEASURED_S: f64 = 0.4;

/// An arm under a controller without a model: `tau = kp (q_ref - q) - kd qd + tau_ff`, held for 2 ms.
#[derive(Deserialize)]
struct Case {
    name: String,
    robot: PathBuf,
    q0_rad: Vec<f64>,
    amplitude_rad: Vec<f64>,
    frequency_rad_per_s: Vec<f64>,
    kp_nm_per_rad: Vec<f64>,
    kd_nm_s_per_rad: Vec<f64>,
    tau_ff_nm: Vec<f64>,
    coulomb_nm: Vec<f64>,
    /// A point of the last link, in its frame (m).
    tip_in_link_m: [f64; 3],
}

/// What one order and step gave.
#[derive(Serialize)]
struct Outcome<'a> {
    case: &'a str,
    order: StepOrder,
    step_ms: f64,
    q_rad: Vec<f64>,
    tip_m: [f64; 3],
    us_per_step: f64,
}

impl Case {
    fn robot(&self) -> Result<Robot, String> {
        let mut robot = Robot::load(&self.robot).map_err(|e| e.to_string())?.robot;
        for (i, level) in self.coulomb_nm.iter().enumerate() {
            if let Some(link) = robot.link_mut(i) {
                link.actuator.coulomb_forward = *level;
                link.actuator.coulomb_backward = *level;
                link.actuator.viscous = 0.0;
            }
        }
        Ok(robot)
    }

    fn arm(&self, robot: &Robot, order: StepOrder, step_ms: f64) -> Result<Simulator, String> {
        let step_s = 1e-3 * step_ms;
        let steps_per_period = (PERIOD_S / step_s).round() as usize;
        let stepping = Stepping { step_s, steps_per_period, stops: false, order };
        let sensors = Sensors::perfect(robot.joint_count());
        Simulator::new(robot, Vec::new(), sensors, stepping).map_err(|e| e.to_string())
    }

    fn second(&self, arm: &mut Simulator) -> Result<(), MachineFault> {
        arm.start(&self.q0_rad);
        let mut reading = Reading::zero(self.q0_rad.len());
        let mut tau = self.tau_ff_nm.clone();
        for tick in 0..PERIODS {
            arm.read(&mut reading)?;
            let time_s = tick as f64 * PERIOD_S;
            for (i, tau) in tau.iter_mut().enumerate() {
                let swing = 1.0 - (self.frequency_rad_per_s[i] * time_s).cos();
                let q_ref = self.q0_rad[i] + self.amplitude_rad[i] * swing;
                *tau = self.kp_nm_per_rad[i] * (q_ref - reading.q[i])
                    - self.kd_nm_s_per_rad[i] * reading.qd[i]
                    + self.tau_ff_nm[i];
            }
            arm.actuate(&tau)?;
        }
        Ok(())
    }

    fn tip(&self, robot: &Robot, q: &[f64]) -> [f64; 3] {
        let mut poses: Vec<Isometry3<f64>> = Vec::new();
        for (link, &q) in robot.links().iter().zip(q) {
            let parent = link.parent.map_or_else(Isometry3::identity, |p| poses[p]);
            poses.push(parent * link.joint.parent_from_child(q));
        }
        let last = poses.last().copied().unwrap_or_else(Isometry3::identity);
        let tip = last * Point3::from(self.tip_in_link_m);
        [tip.x, tip.y, tip.z]
    }

    fn outcome(
        &self,
        robot: &Robot,
        order: StepOrder,
        step_ms: f64,
    ) -> Result<Outcome<'_>, String> {
        let mut arm = self.arm(robot, order, step_ms)?;
        let steps = PERIODS as f64 * (1e3 * PERIOD_S / step_ms).round();
        let (mut quickest_s, begin) = (f64::INFINITY, Instant::now());
        while begin.elapsed().as_secs_f64() < MEASURED_S {
            let start = Instant::now();
            self.second(&mut arm)
                .map_err(|e| format!("{} {step_ms} ms: {}", self.name, e.found))?;
            quickest_s = quickest_s.min(start.elapsed().as_secs_f64());
        }
        let q_rad = arm.q_true().to_vec();
        Ok(Outcome {
            case: &self.name,
            order,
            step_ms,
            tip_m: self.tip(robot, &q_rad),
            q_rad,
            us_per_step: 1e6 * quickest_s / steps,
        })
    }
}

fn read_case(file: &str) -> Result<Case, String> {
    let text = std::fs::read_to_string(file).map_err(|e| format!("{file}: {e}"))?;
    serde_json::from_str(&text).map_err(|e| format!("{file}: {e}"))
}

/// One second in one order and step, for a count of instructions.
fn once(file: &str, order: &str, step_ms: f64) -> Result<(), String> {
    let case = read_case(file)?;
    let order = if order == "second" { StepOrder::Second } else { StepOrder::First };
    let mut arm = case.arm(&case.robot()?, order, step_ms)?;
    case.second(&mut arm).map_err(|fault| fault.found)
}

fn main() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [file, order, step] = &arguments[..]
        && let Ok(step_ms) = step.parse()
    {
        return once(file, order, step_ms);
    }
    for file in arguments {
        let case = read_case(&file)?;
        let robot = case.robot()?;
        for order in [StepOrder::First, StepOrder::Second] {
            for step_ms in STEPS_MS {
                match case.outcome(&robot, order, step_ms) {
                    Ok(outcome) => {
                        println!("{}", serde_json::to_string(&outcome).map_err(|e| e.to_string())?);
                    }
                    Err(fault) => eprintln!("{fault}"),
                }
            }
        }
    }
    Ok(())
}
