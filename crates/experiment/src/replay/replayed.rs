use diagnosis::DiagnosisProgress;
use logs::PreparedRun;
use robot::Robot;
use simulator::{ForwardReplay, SimulatorError, Windows, replay_torque};

/// Lengths of time for which the models are simulated from a measured state (s), the longest first.
const WINDOWS_S: [f64; 4] = [1.0, 0.5, 0.2, 0.1];

/// Median drift over the joints of the nominal model at the end of a window (rad or m) above which a shorter window
/// is taken: once a simulation spins, its drift shows no error.
const LARGEST_DRIFT: f64 = 0.5;

/// Total time of all runs that is simulated (s).
const TOTAL_S: f64 = 120.0;

/// Both models, simulated under the measured torques.
pub(crate) struct Replayed {
    /// Time after which a simulation starts anew from the measured state (s).
    pub window_s: f64,
    /// Simulated time of each run, from its start (s).
    pub simulated_s: f64,
    /// The nominal model, one entry a run.
    pub nominal: Vec<Simulated>,
    /// The extended model, one entry a run.
    pub extended: Vec<Simulated>,
}

/// One run, simulated with one model.
pub(crate) struct Simulated {
    /// Positions of all joints at all samples of the record, row-major (rad or m); NaN where nothing was simulated.
    pub q: Vec<f64>,
    /// Why parts of the run, or all of it, could not be simulated.
    pub trouble: Option<String>,
}

impl Replayed {
    /// Simulates both models under the measured torques.
    pub fn of(
        robots: [&Robot; 2],
        records: &[PreparedRun],
        progress: &dyn DiagnosisProgress,
    ) -> Self {
        let simulated_s = TOTAL_S / records.len().max(1) as f64;
        let parts: Vec<PreparedRun> = records.iter().map(|r| first(r, simulated_s)).collect();
        let roll = |robot: &Robot, window_s: f64, model: &str| -> Vec<_> {
            let stage = format!("simulating {window_s} s of the {model} model");
            progress.stage(&stage, parts.len());
            let one = |part| {
                let replay = replay_torque(robot, part, Windows::of(window_s));
                progress.step();
                replay
            };
            parts.iter().map(one).collect()
        };
        let [longest_s, shorter @ ..] = WINDOWS_S;
        let (mut window_s, mut nominal) = (longest_s, roll(robots[0], longest_s, "nominal"));
        for shorter_s in shorter {
            if middle_drift(&nominal).is_none_or(|drift| drift <= LARGEST_DRIFT) {
                break;
            }
            (window_s, nominal) = (shorter_s, roll(robots[0], shorter_s, "nominal"));
        }
        let extended = roll(robots[1], window_s, "extended");
        let simulate_all = |replays: Vec<_>| -> Vec<Simulated> {
            records.iter().zip(replays).map(|(r, replay)| Simulated::new(r, replay)).collect()
        };
        let (nominal, extended) = (simulate_all(nominal), simulate_all(extended));
        Self { window_s, simulated_s, nominal, extended }
    }
}

impl Simulated {
    fn new(record: &PreparedRun, replay: Result<ForwardReplay, SimulatorError>) -> Self {
        let joints = record.joints.len();
        let mut q = vec![f64::NAN; record.time.len() * joints];
        let replay = match replay {
            Ok(replay) => replay,
            Err(error) => return Self { q, trouble: Some(error.to_string()) },
        };
        let start_s = record.time.first().copied().unwrap_or(0.0);
        for (row, time_s) in replay.motion.time.iter().enumerate() {
            let sample = ((time_s - start_s) * record.rate_hz).round() as usize;
            for (j, joint) in replay.motion.joints.iter().enumerate() {
                q[sample * joints + j] = joint.position[row];
            }
        }
        let (found, windows) = (replay.runaways.len(), replay.starts.len());
        let first = replay.runaways.first();
        let trouble =
            first.map(|fault| format!("{found} of {windows} windows ended early: {fault}"));
        Self { q, trouble }
    }
}

/// Median over joints and runs of the drift at the ends of windows (rad or m); `None` where nothing was simulated.
fn middle_drift(replays: &[Result<ForwardReplay, SimulatorError>]) -> Option<f64> {
    let of_run = |replay: &ForwardReplay| {
        let joints = replay.motion.joints.len();
        replay.drift_rms.clone().unwrap_or_else(|| vec![f64::INFINITY; joints])
    };
    let mut drifts: Vec<f64> = replays.iter().flatten().flat_map(of_run).collect();
    drifts.sort_by(f64::total_cmp);
    drifts.get(drifts.len() / 2).copied()
}

/// A record up to some time after its start (s).
pub(crate) fn first(record: &PreparedRun, duration_s: f64) -> PreparedRun {
    record.part(0..(duration_s * record.rate_hz) as usize + 1)
}
