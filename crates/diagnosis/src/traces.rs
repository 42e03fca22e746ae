use crate::design::{Design, JointDesign, RunDesign};

/// Signals behind a diagnosis, for figures: one run, on the regression's clock.
#[derive(Debug, Clone, PartialEq)]
pub struct RunTraces {
    /// Name of the run.
    pub name: String,
    /// Time (s).
    pub time: Vec<f64>,
    /// One entry a joint.
    pub joints: Vec<JointTraces>,
}

/// Signals of one joint, all low-passed alike.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTraces {
    /// Position (rad or m).
    pub position: Vec<f64>,
    /// Velocity (rad/s or m/s).
    pub velocity: Vec<f64>,
    /// Measured effort (N m or N).
    pub measured: Vec<f64>,
    /// Effort of the nominal model.
    pub nominal: Vec<f64>,
    /// Effort of the extended model, fitted without this run or block.
    pub extended: Vec<f64>,
}

/// The signals of every run; `residuals` are what is left by what was found without each,
/// `[joint][run][sample]`.
pub(crate) fn traces(design: &Design, residuals: &[Vec<Vec<f64>>]) -> Vec<RunTraces> {
    let run = |(r, run): (usize, &RunDesign)| RunTraces {
        name: run.name.clone(),
        time: run.time.clone(),
        joints: run.joints.iter().zip(residuals).map(|(j, left)| joint(j, left.get(r))).collect(),
    };
    design.runs.iter().enumerate().map(run).collect()
}

fn joint(design: &JointDesign, left: Option<&Vec<f64>>) -> JointTraces {
    let [position, velocity, _] = design.state.clone();
    let left = left.into_iter().flatten();
    let extended = design.measured.iter().zip(left).map(|(m, l)| m - l).collect();
    JointTraces {
        position,
        velocity,
        measured: design.measured.clone(),
        nominal: design.nominal.clone(),
        extended,
    }
}
