use robot::Robot;

/// A drive whose torque is clipped at a limit of the effort in the log.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Limit {
    /// Index of the joint.
    pub joint: usize,
    /// Largest effort that became torque (N·m or N).
    pub limit: f64,
    /// 95 per cent interval of the limit.
    pub ci95: [f64; 2],
    /// Share of the residual of all other effects that the limit explains.
    pub share: f64,
    /// Log Bayes factor (nats) of the model with the limit, where `n` correlated samples count as `n / time`.
    pub log_evidence: f64,
}

impl Limit {
    /// The part of an effort that did not become torque.
    pub fn beyond(&self, effort: f64) -> f64 {
        effort - effort.clamp(-self.limit, self.limit)
    }

    /// Adds the limit to the joint of the robot.
    pub fn extend(&self, robot: &mut Robot) {
        if let Some(link) = robot.link_mut(self.joint) {
            link.joint.limits.effort = Some(self.limit);
        }
    }
}
