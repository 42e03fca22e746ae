use std::f64::consts::TAU;

use crate::oscillations::spectral_lines::AROUND;
use crate::signals::rest::Rest;
use crate::thresholds::tones::ToneThresholds;

/// The runs in which a joint moves, for tones in its residual effort.
pub(crate) struct MovingRuns<'a> {
    /// Index of the joint.
    pub joint: usize,
    pub runs: Vec<&'a Rest<'a>>,
    /// Residual effort, `[run][sample]` (N·m or N). While a joint stands, dry friction holds it with any part of its level,
    /// which would pass for a sine: it is zero then.
    pub left: Vec<Vec<f64>>,
    /// The highest phase per way at which a sample counts, `[run][sample]` (1 or rad/m).
    pub highest_by_position: Vec<Vec<f64>>,
    /// The highest phase per time (rad/s).
    pub highest_by_clock: Vec<Vec<f64>>,
}

impl<'a> MovingRuns<'a> {
    /// The runs of joint `j` in efforts with the cut-off `cutoff_hz`.
    pub fn new(runs: &'a [Rest<'a>], j: usize, cutoff_hz: f64, t: &ToneThresholds) -> Self {
        let moves = |run: &&Rest| run.stands[j].iter().filter(|stands| !**stands).count() >= AROUND;
        let runs: Vec<&Rest> = runs.iter().filter(moves).collect();
        let highest = TAU * t.highest * cutoff_hz;
        let while_moving = |signal: &dyn Fn(&Rest, usize) -> f64| -> Vec<Vec<f64>> {
            let of_run = |run: &&Rest| {
                let at = |(t, stands): (usize, &bool)| if *stands { 0.0 } else { signal(run, t) };
                run.stands[j].iter().enumerate().map(at).collect()
            };
            runs.iter().map(of_run).collect()
        };
        Self {
            joint: j,
            left: while_moving(&|run, t| run.left[j][t]),
            highest_by_position: while_moving(&|run, t| highest / run.qd[j][t].abs().max(1e-9)),
            highest_by_clock: while_moving(&|_, _| highest),
            runs,
        }
    }
}
