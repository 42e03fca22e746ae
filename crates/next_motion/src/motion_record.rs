use effects::{Frame, RunMotion};
use logs::PreparedRun;
use robot::Robot;

/// Rate at which logs and the motion that is found are evaluated, in cut-off frequencies: that
/// of the diagnosis.
pub(crate) const EVALUATION_RATE: f64 = 16.0;

/// Positions, velocities and accelerations of all joints on a uniform clock, recorded or
/// planned, each `[joint][sample]`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MotionRecord {
    /// Position, velocity, acceleration.
    pub state: [Vec<Vec<f64>>; 3],
    /// Time between samples (s).
    pub period_s: f64,
}

impl MotionRecord {
    /// A run, every `stride`-th sample.
    pub fn of_run(run: &PreparedRun, stride: usize) -> Self {
        let every = |x: &Vec<f64>| x.iter().step_by(stride).copied().collect::<Vec<f64>>();
        Self {
            state: [
                run.joints.iter().map(|j| every(&j.wide.q)).collect(),
                run.joints.iter().map(|j| every(&j.wide.qd)).collect(),
                run.joints.iter().map(|j| every(&j.wide.qdd)).collect(),
            ],
            period_s: stride as f64 / run.rate_hz,
        }
    }

    /// A planned motion, which is exact.
    pub fn of_motion(motion: &motion::Motion, rate_hz: f64) -> Self {
        let samples = (motion.duration_s() * rate_hz).floor() as usize + 1;
        let empty = || vec![Vec::with_capacity(samples); motion.joint_count()];
        let mut signals = [empty(), empty(), empty()];
        let mut state = motion::State::default();
        for k in 0..samples {
            motion.sample(k as f64 / rate_hz, &mut state);
            for (signal, now) in signals.iter_mut().zip([&state.q, &state.qd, &state.qdd]) {
                signal.iter_mut().zip(now).for_each(|(x, value)| x.push(*value));
            }
        }
        Self { state: signals, period_s: rate_hz.recip() }
    }

    /// The nominal robot along it.
    pub fn evaluate(self, robot: &Robot, frame: &Frame) -> RunMotion {
        RunMotion::new(robot, frame, self.state, self.period_s)
    }
}
