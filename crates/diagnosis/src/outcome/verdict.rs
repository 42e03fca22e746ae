use robot::TorqueSource;

use crate::outcome::size::size;
use crate::result::{NoiseFloorSource, Verdict};
use crate::search::friction_error::FrictionError;
use crate::thresholds::verdict::VerdictThresholds;

/// Whether dry friction too small to be seen may matter. Then the logs say nothing of a joint, however small its
/// residual.
pub(crate) fn hides_friction(unseen: f64, torque_rms: f64, t: &VerdictThresholds) -> bool {
    unseen > t.unseen * torque_rms
}

/// All inputs of the verdict of one joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Situation<'a> {
    /// Why the logs say nothing of the joint.
    pub inadequate: Option<String>,
    /// Number of findings that lower the held-out error of the joint.
    pub findings: usize,
    /// Number of these findings that are oscillations: their errors are those of a wider band.
    pub tones: usize,
    /// Number of these findings that are causes of this joint alone.
    pub own: usize,
    /// Number of findings between the two encoders of the joint.
    pub between_encoders: usize,
    /// Whether the joint keeps its description because a fit predicts worse.
    pub keeps_nominal: bool,
    /// The smallest level of dry friction that the logs would have shown, where none was found (N·m or N).
    pub unseen: f64,
    /// RMS of the effort (N·m or N).
    pub torque_rms: f64,
    /// Held-out RMS error of the nominal and of the extended model.
    pub nominal_rms: f64,
    pub remaining_rms: f64,
    /// Number of independent samples of noise behind these errors.
    pub samples: f64,
    /// Noise of the effort, and its source.
    pub noise: (f64, NoiseFloorSource),
    /// What the effort is.
    pub source: TorqueSource,
    /// What the law of described dry friction may err by.
    pub friction: FrictionError,
    /// Held-out RMS error of the extended model while the joint slides (N·m or N).
    pub sliding_rms: f64,
    /// Share of the effort below which a residual does not matter.
    pub practical: f64,
    /// Share of the residual's power that is predictable.
    pub structure: f64,
    /// Frequency above which most of the residual lies, and bandwidth of the motion (Hz).
    pub above_hz: Option<f64>,
    pub motion_hz: f64,
    pub thresholds: &'a VerdictThresholds,
}

impl Situation<'_> {
    /// Share of the residual's power that exceeds the noise, over all samples or while the joint slides: the larger of both.
    pub fn unexplained_share(&self) -> f64 {
        let beyond = |[rms, floor]: [f64; 2]| 1.0 - (floor / rms.max(f64::MIN_POSITIVE)).powi(2);
        self.errors_and_floors().map(beyond).fold(0.0, f64::max).min(1.0)
    }

    /// Held-out RMS errors and what no model can predict of them (N·m or N): over all samples, and, where dry friction is
    /// described, while the joint slides.
    fn errors_and_floors(&self) -> impl Iterator<Item = [f64; 2]> {
        let of = |rms, unpredictable| [rms, self.noise.0.hypot(unpredictable)];
        let FrictionError { all, sliding, .. } = self.friction;
        let while_sliding = (sliding > 0.0).then(|| of(self.sliding_rms, sliding));
        std::iter::once(of(self.remaining_rms, all)).chain(while_sliding)
    }

    /// Whether an error is at most `most` times a floor, plus some standard errors of an RMS.
    fn is_within(&self, most: f64, [rms, floor]: [f64; 2]) -> bool {
        let error = (2.0 * self.samples.max(1.0)).sqrt().recip();
        rms <= (most + self.thresholds.rms_errors * error) * floor
    }

    /// Whether the residual may be noise.
    fn is_noise(&self) -> bool {
        let most = self.thresholds.noise_factor_of(self.source);
        self.errors_and_floors().all(|error| self.is_within(most, error))
    }

    /// Whether the residual may be noise but is large enough to contain an effect that matters.
    ///
    /// For a joint with a cause of its own this holds for any noise. For other joints the residual must also exceed
    /// the effort's own noise: it then passes as noise only because commands and changes of direction are allowed
    /// more.
    pub fn is_drowned(&self) -> bool {
        self.is_noise()
            && self.remaining_rms > self.thresholds.drowned * self.torque_rms
            && (self.own > 0
                || !self
                    .is_within(self.thresholds.noise_factor, [self.remaining_rms, self.noise.0]))
    }

    /// Whether the residual beyond the noise is too small to matter.
    fn is_small(&self) -> bool {
        self.unexplained_share().sqrt() * self.remaining_rms <= self.practical * self.torque_rms
    }

    /// The verdict and the reason for it.
    ///
    /// A joint is closed where the residual is within the noise or within a share of the effort that does not matter,
    /// unless the noise is large enough to hide causes. It is explained only where the error fell and is smaller than
    /// the effort. A joint that keeps its description because a fit predicts worse is never consistent.
    pub fn verdict(&self) -> (Verdict, String) {
        if let Some(reason) = &self.inadequate {
            return (Verdict::DataInadequate, reason.clone());
        }
        let closed = !self.is_drowned() && (self.is_noise() || self.is_small());
        // A tone above the band lowers no error in it.
        let fell = self.remaining_rms < self.nominal_rms || self.findings == self.tones;
        let is_sane = fell && self.remaining_rms < self.torque_rms;
        let blind = hides_friction(self.unseen, self.torque_rms, self.thresholds);
        let verdict = match (self.findings + self.between_encoders > 0, closed) {
            // There was an error to fit, but the parts of the logs disagree about it.
            (false, true) if self.keeps_nominal || blind => Verdict::DataInadequate,
            (false, true) => Verdict::Consistent,
            (true, true) if is_sane && !blind => Verdict::Explained,
            // The description predicts the joint as well as the findings, which are causes of the whole arm.
            (true, true) if !fell && self.remaining_rms < self.torque_rms && !blind => {
                Verdict::Consistent
            }
            (true, _) if is_sane => Verdict::PartlyExplained,
            (false, false) if self.is_drowned() => Verdict::DataInadequate,
            _ => Verdict::Unexplained,
        };
        let because = self.because(verdict);
        if closed && blind {
            return (verdict, format!("{because}; {}", self.of_unseen()));
        }
        (verdict, because)
    }

    fn of_unseen(&self) -> String {
        if !self.unseen.is_finite() {
            return "these logs show no friction of this joint, however large".to_owned();
        }
        let percent = 100.0 * self.unseen / self.torque_rms;
        format!(
            "dry friction of up to {} N m, {percent:.0} % of its effort, would go unseen",
            size(self.unseen)
        )
    }

    fn because(&self, verdict: Verdict) -> String {
        let subject = match (self.findings, self.between_encoders) {
            (0, 1..) => "its two encoders show the cause; the effort is left with",
            (0, 0) if self.keeps_nominal => {
                "what was fitted predicts worse than the description, which is kept and leaves"
            }
            (0, 0) if verdict == Verdict::Unexplained => {
                "no named effect earns its place; the description leaves"
            }
            (0, 0) => "the description leaves",
            _ => "the findings leave",
        };
        let left = format!("{subject} {} N m RMS while it moves", size(self.remaining_rms));
        if self.is_drowned() {
            let percent = 100.0 * self.remaining_rms / self.torque_rms;
            return format!(
                "{left}, {percent:.0} % of its effort, in which noise and a cause cannot be told apart: {}",
                self.of_noise()
            );
        }
        if self.is_noise() {
            return format!("{left}, within the noise: {}", self.of_noise());
        }
        if self.is_small() {
            let percent = 100.0 * self.practical;
            return format!(
                "{left}, beyond the noise less than {percent:.0} % of its effort ({})",
                self.of_noise()
            );
        }
        let share = 100.0 * (self.remaining_rms / self.nominal_rms.max(f64::MIN_POSITIVE)).powi(2);
        let gap = if self.findings > 0 {
            format!(", {share:.0} % of the gap's power")
        } else {
            String::new()
        };
        format!("{left}{gap}; {}{}", self.of_noise(), self.origin())
    }

    fn of_noise(&self) -> String {
        let (rms, source) = self.noise;
        let noise = match source {
            NoiseFloorSource::Unknown => "of its noise the logs tell nothing".to_owned(),
            _ => format!("{} N m {}", size(rms), source.words()),
        };
        if self.friction.all > rms {
            return format!(
                "{noise}, {} N m of dry friction while it turns",
                size(self.friction.all)
            );
        }
        noise
    }

    /// Words for a residual that no function of the motion predicts.
    fn origin(&self) -> String {
        let fast =
            self.above_hz.filter(|hz| *hz > self.motion_hz && self.structure < self.practical);
        fast.map_or_else(String::new, |hz| {
            format!(
                ". It is vibration or noise of unknown origin: nine tenths of its power lie above {hz:.1} Hz, faster than the motion, and no function of the motion predicts it"
            )
        })
    }
}

/// The verdict over all joints of which the logs show enough. `hiding` joints move but may hide friction, which
/// leaves the whole arm open.
pub(crate) fn overall(joints: &[Verdict], hiding: usize) -> Verdict {
    use Verdict::{Consistent, DataInadequate, Explained, PartlyExplained, Unexplained};
    let adequate: Vec<Verdict> = joints.iter().copied().filter(|v| *v != DataInadequate).collect();
    let has = |v: Verdict| adequate.contains(&v);
    if adequate.is_empty() || (hiding > 0 && adequate.iter().all(|v| *v == Consistent)) {
        DataInadequate
    } else if has(PartlyExplained) || (has(Explained) && (hiding > 0 || has(Unexplained))) {
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
    use std::sync::LazyLock;

    use super::*;

    static DEFAULT: LazyLock<VerdictThresholds> = LazyLock::new(VerdictThresholds::default);

    /// A joint of 10 N m with a gap of 2 N m.
    fn joint(findings: usize, remaining_rms: f64, noise: f64) -> Situation<'static> {
        Situation {
            inadequate: None,
            findings,
            tones: 0,
            own: findings,
            between_encoders: 0,
            keeps_nominal: false,
            unseen: 0.0,
            torque_rms: 10.0,
            nominal_rms: 2.0,
            remaining_rms,
            samples: 450.0,
            noise: (noise, NoiseFloorSource::Effort),
            source: TorqueSource::Measured,
            friction: FrictionError::NONE,
            sliding_rms: remaining_rms,
            practical: 0.02,
            structure: 0.0,
            above_hz: Some(8.0),
            motion_hz: 1.0,
            thresholds: &DEFAULT,
        }
    }

    #[test]
    fn a_rest_within_its_noise_or_two_per_cent_of_the_effort_is_closed() {
        // 450 independent samples: 1.267 times the noise.
        assert_eq!(joint(0, 2.0, 1.6).verdict().0, Verdict::Consistent);
        assert_eq!(joint(0, 2.0, 1.56).verdict().0, Verdict::Unexplained);
        assert_eq!(joint(0, 0.19, 0.0).verdict().0, Verdict::Consistent);
        assert_eq!(joint(1, 0.19, 0.0).verdict().0, Verdict::Explained);
        assert_eq!(joint(0, 0.3, 0.1).verdict().0, Verdict::Unexplained);
        assert_eq!(joint(1, 0.3, 0.1).verdict().0, Verdict::PartlyExplained);
    }

    /// What is left is a fifth of the effort, and noise may be all of it.
    #[test]
    fn a_tone_above_the_band_explains_a_joint_whose_error_in_it_stays() {
        let with = |tones| Situation { tones, ..joint(1, 2.0, 1.9) }.verdict().0;
        assert_eq!(with(1), Verdict::PartlyExplained);
        assert_eq!(with(0), Verdict::Unexplained);
    }

    #[test]
    fn more_room_than_noise_has_closes_no_joint_of_which_it_is_a_sixth() {
        let command = |findings, torque_rms| {
            Situation { torque_rms, source: TorqueSource::Commanded, ..joint(findings, 1.7, 1.2) }
                .verdict()
                .0
        };
        assert_eq!(command(0, 12.0), Verdict::Consistent);
        assert_eq!(command(0, 11.0), Verdict::DataInadequate);
        assert_eq!(command(1, 12.0), Verdict::Explained);
        assert_eq!(command(1, 11.0), Verdict::PartlyExplained);
        let own = |findings, left| joint(findings, left, left).verdict().0;
        assert_eq!([own(0, 1.6), own(1, 1.4)], [Verdict::Consistent, Verdict::Explained]);
        assert_eq!(own(1, 1.6), Verdict::PartlyExplained);
        let of_the_arm = Situation { own: 0, ..joint(1, 1.6, 1.6) };
        assert_eq!(of_the_arm.verdict().0, Verdict::Explained);
        // Nor does the friction of a joint that often turns.
        let friction = FrictionError { all: 1.5, sliding: 0.6, level: 3.0 };
        let turning =
            |left| Situation { friction, sliding_rms: 0.1, ..joint(0, left, 0.1) }.verdict().0;
        assert_eq!(turning(1.4), Verdict::Consistent);
        assert_eq!(turning(1.6), Verdict::DataInadequate);
    }

    #[test]
    fn a_joint_whose_friction_would_go_unseen_is_not_closed() {
        let joint = |findings, unseen| Situation { unseen, ..joint(findings, 0.19, 0.0) }.verdict();
        assert_eq!(joint(0, 2.4).0, Verdict::Consistent);
        assert_eq!(joint(1, 2.4).0, Verdict::Explained);
        let (verdict, because) = joint(0, 2.6);
        assert_eq!(verdict, Verdict::DataInadequate);
        assert!(
            because
                .ends_with("dry friction of up to 2.600 N m, 26 % of its effort, would go unseen")
        );
        assert_eq!(joint(1, 2.6).0, Verdict::PartlyExplained);
        assert!(joint(0, f64::INFINITY).1.ends_with("no friction of this joint, however large"));
    }

    #[test]
    fn a_joint_whose_fit_failed_is_not_called_consistent() {
        let verdict_at =
            |noise| Situation { keeps_nominal: true, ..joint(0, 1.0, noise) }.verdict();
        assert_eq!(verdict_at(0.95).0, Verdict::DataInadequate);
        assert!(verdict_at(0.95).1.contains("predicts worse than the description"));
        assert_eq!(verdict_at(0.1).0, Verdict::Unexplained);
    }

    #[test]
    fn dry_friction_that_turns_may_be_anything_up_to_its_level() {
        let turning = |all, sliding_rms| {
            let friction = FrictionError { all, sliding: 0.15, level: 3.0 };
            Situation { friction, sliding_rms, ..joint(0, 0.5, 0.1) }.verdict().0
        };
        assert_eq!(turning(0.2, 0.1), Verdict::Unexplained);
        assert_eq!(turning(0.45, 0.1), Verdict::Consistent);
        // While it slides, its law errs by no more than .15 of its level: sqrt(.1^2 + .15^2) = .18.
        assert_eq!(turning(0.45, 0.2), Verdict::Consistent);
        assert_eq!(turning(0.45, 0.3), Verdict::Unexplained);
    }

    #[test]
    fn nothing_is_explained_by_an_error_that_rises_or_exceeds_the_effort() {
        assert_eq!(joint(1, 2.1, 2.0).verdict().0, Verdict::Unexplained);
        let as_described = Situation { torque_rms: 20.0, ..joint(1, 2.1, 2.0) };
        assert_eq!(as_described.verdict().0, Verdict::Consistent);
        let drowned = Situation { torque_rms: 0.1, ..joint(1, 1.9, 1.8) };
        assert_eq!(drowned.verdict().0, Verdict::Unexplained);
    }

    #[test]
    fn a_fast_rest_that_follows_nothing_is_said_to_be_vibration_or_noise() {
        let (_, because) = joint(0, 1.0, 0.1).verdict();
        assert!(because.contains("unknown origin: nine tenths of its power lie above 8.0 Hz"));
        let slow = Situation { above_hz: Some(0.5), ..joint(0, 1.0, 0.1) };
        assert!(!slow.verdict().1.contains("unknown origin"));
    }

    #[test]
    fn the_overall_verdict_is_no_better_than_the_worst_adequate_joint() {
        use Verdict::{Consistent, DataInadequate, Explained, PartlyExplained, Unexplained};
        assert_eq!(overall(&[DataInadequate, Consistent], 0), Consistent);
        assert_eq!(overall(&[DataInadequate, Consistent], 1), DataInadequate);
        assert_eq!(overall(&[DataInadequate, Explained], 1), PartlyExplained);
        assert_eq!(overall(&[DataInadequate, Unexplained], 1), Unexplained);
        assert_eq!(overall(&[Explained, Consistent], 0), Explained);
        assert_eq!(overall(&[Unexplained, Consistent], 0), Unexplained);
        assert_eq!(overall(&[Unexplained, Explained], 0), PartlyExplained);
        assert_eq!(overall(&[DataInadequate], 0), DataInadequate);
    }
}
