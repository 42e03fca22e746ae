use crate::result::Verdict;

/// Share of a residual's power above which what a predictor finds in it counts as structure.
const STRUCTURED: f64 = 0.15;

/// RMS of structure that matters, as a share of the effort's RMS.
const MATTERS: f64 = 0.01;

/// What is known of one joint when its verdict is due.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Situation {
    pub moved: bool,
    /// Number of findings that lower its held-out error.
    pub findings: usize,
    /// RMS of the effort (N·m or N).
    pub torque_rms: f64,
    /// Held-out RMS error of the nominal and of the extended model.
    pub nominal_rms: f64,
    pub remaining_rms: f64,
    /// Noise floor.
    pub floor: f64,
    /// Share of the remaining residual's power that is predictable.
    pub structure: f64,
}

impl Situation {
    /// Share of the remaining residual's power that is not noise: what is predictable, or
    /// what repeats from run to run.
    pub fn unexplained(&self) -> f64 {
        let above = 1.0 - (self.floor / self.remaining_rms.max(f64::MIN_POSITIVE)).powi(2);
        self.structure.max(above).clamp(0.0, 1.0)
    }

    fn structure_is_left(&self) -> bool {
        let share = self.unexplained();
        share > STRUCTURED && share.sqrt() * self.remaining_rms > MATTERS * self.torque_rms
    }

    /// The verdict and why.
    pub fn verdict(&self) -> (Verdict, String) {
        if !self.moved {
            return (Verdict::DataInadequate, "the joint does not move in these logs".to_owned());
        }
        let left = format!(
            "{:.3} N m RMS remain over a noise floor of {:.3}",
            self.remaining_rms, self.floor
        );
        match (self.findings, self.structure_is_left()) {
            (0, false) => (
                Verdict::Consistent,
                format!(
                    "the nominal model leaves {:.3} N m RMS, its noise floor is {:.3}",
                    self.nominal_rms, self.floor
                ),
            ),
            (0, true) => (Verdict::Unexplained, format!("no named effect earns its place; {left}")),
            (_, false) => {
                (Verdict::Explained, format!("named effects bring the error to the noise; {left}"))
            }
            (_, true) => (
                Verdict::PartlyExplained,
                format!(
                    "{left}; {:.0} % of the remaining power is structure",
                    100.0 * self.unexplained()
                ),
            ),
        }
    }
}

/// The verdict over all joints.
pub(crate) fn overall(joints: &[Verdict]) -> Verdict {
    use Verdict::{Consistent, DataInadequate, Explained, PartlyExplained, Unexplained};
    let adequate: Vec<Verdict> = joints.iter().copied().filter(|v| *v != DataInadequate).collect();
    let has = |v: Verdict| adequate.contains(&v);
    if adequate.is_empty() {
        DataInadequate
    } else if has(PartlyExplained) || (has(Unexplained) && has(Explained)) {
        PartlyExplained
    } else if has(Unexplained) {
        Unexplained
    } else if has(Explained) {
        Explained
    } else {
        Consistent
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_overall_verdict_is_no_better_than_the_worst_adequate_joint() {
        use Verdict::{Consistent, DataInadequate, Explained, PartlyExplained, Unexplained};
        assert_eq!(overall(&[DataInadequate, Consistent]), Consistent);
        assert_eq!(overall(&[Explained, Consistent]), Explained);
        assert_eq!(overall(&[Unexplained, Consistent]), Unexplained);
        assert_eq!(overall(&[Unexplained, Explained]), PartlyExplained);
        assert_eq!(overall(&[DataInadequate]), DataInadequate);
    }
}
