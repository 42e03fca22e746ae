/// How large things are in a set of logs: what the priors of the weights are made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    /// RMS of the measured effort of each joint (N·m or N).
    pub effort: Vec<f64>,
    /// Largest speed of each joint (rad/s or m/s).
    pub speed: Vec<f64>,
    /// Largest acceleration of each joint (rad/s² or m/s²).
    pub acceleration: Vec<f64>,
    /// Range of motion of each joint (rad or m).
    pub range: Vec<f64>,
    /// Mean mass of a moving link (kg).
    pub link_mass: f64,
    /// Mean distance between neighbouring joints (m).
    pub link_length: f64,
}

impl Scale {
    /// Effort of `joint` per unit of `of`, zero for a joint that did not move.
    pub(crate) fn effort_per(&self, joint: usize, of: &[f64]) -> f64 {
        let unit = of.get(joint).copied().unwrap_or(0.0);
        let effort = self.effort.get(joint).copied().unwrap_or(0.0);
        if unit > 0.0 { effort / unit } else { 0.0 }
    }
}
