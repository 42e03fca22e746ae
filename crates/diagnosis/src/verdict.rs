use crate::result::Verdict;

/// Share of a residual's power above which what is not noise in it counts as structure.
const STRUCTURED: f64 = 0.15;

/// RMS of structure that matters, as a share of the effort's RMS.
const MATTERS: f64 = 0.01;

/// Share of the nominal residual's power that may stay without a name where the rest has one.
const EXPLAINED: f64 = 0.05;

/// What is known of one joint when its verdict is due.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Situation {
    /// Why the logs say nothing of the joint.
    pub inadequate: Option<String>,
    /// Number of findings that lower its held-out error.
    pub findings: usize,
    /// Number of findings between its two encoders.
    pub between: usize,
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

    /// RMS of what is left without a name.
    fn left(&self) -> f64 {
        self.unexplained().sqrt() * self.remaining_rms
    }

    fn structure_is_left(&self) -> bool {
        let named = if self.findings > 0 { EXPLAINED } else { 0.0 };
        self.unexplained() > STRUCTURED
            && self.left() > MATTERS * self.torque_rms
            && self.left().powi(2) > named * self.nominal_rms.powi(2)
    }

    /// The verdict and why.
    pub fn verdict(&self) -> (Verdict, String) {
        if let Some(reason) = &self.inadequate {
            return (Verdict::DataInadequate, reason.clone());
        }
        let share = 100.0 * (self.remaining_rms / self.nominal_rms.max(f64::MIN_POSITIVE)).powi(2);
        let over =
            format!("{:.3} N m RMS over a noise floor of {:.3}", self.remaining_rms, self.floor);
        let left = match (self.findings, self.between) {
            (0, 1..) => format!("its two encoders show the cause; the effort is left with {over}"),
            _ => format!("{share:.1} % of the gap's power is left, {over}"),
        };
        match (self.findings + self.between, self.structure_is_left()) {
            (0, false) => (
                Verdict::Consistent,
                format!(
                    "the nominal model leaves {:.3} N m RMS over a noise floor of {:.3}",
                    self.nominal_rms, self.floor
                ),
            ),
            (0, true) => (
                Verdict::Unexplained,
                format!(
                    "no named effect earns its place; the nominal model leaves {:.3} N m RMS over a noise floor of {:.3}",
                    self.nominal_rms, self.floor
                ),
            ),
            (_, false) => (Verdict::Explained, left),
            (_, true) => {
                let structure = 100.0 * self.unexplained();
                (Verdict::PartlyExplained, format!("{left}; {structure:.0} % of that is no noise"))
            }
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
