use robot::Robot;

/// A drive that gives no more than its limit of the effort in the log.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Limit {
    /// Index of the joint.
    pub joint: usize,
    /// Largest effort that became torque (N·m or N).
    pub limit: f64,
    /// 95 per cent interval of it.
    pub ci95: [f64; 2],
    /// Share of what all other effects leave.
    pub share: f64,
    /// Logarithm of how much more likely the logs are with it, `n` correlated samples counting as
    /// `n / time`.
    pub log_evidence: f64,
}

impl Limit {
    /// The part of an effort that became no torque.
    pub fn beyond(&self, effort: f64) -> f64 {
        effort - effort.clamp(-self.limit, self.limit)
    }

    /// Gives the joint the limit.
    pub fn extend(&self, robot: &mut Robot) {
        if let Some(link) = robot.link_mut(self.joint) {
            link.joint.limits.effort = Some(self.limit);
        }
    }
}
