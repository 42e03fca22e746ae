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
