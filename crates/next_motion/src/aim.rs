use effects::{Hypothesis, ShapedRobot};
use nalgebra::{DMatrix, DVector};
use robot::Robot;

use crate::information::{ColumnInformation, ColumnLayout};
use crate::known::Known;
use crate::limits::efforts;

/// What a motion is wanted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Goal {
    /// To tell which of two causes it is.
    Separate {
        /// The cause that was named.
        finding: Hypothesis,
        /// The one that it cannot be told from.
        rival: Hypothesis,
    },
    /// To narrow down the parameters of a cause.
    Determine {
        /// The cause.
        finding: Hypothesis,
    },
}

/// What is asked of a motion, and of which robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Question<'a> {
    /// The robot, as [`with_trial_shapes`](crate::with_trial_shapes) has it.
    pub shaped: &'a ShapedRobot,
    /// What the motion is wanted for, all of it by the same motion.
    pub goals: Vec<Goal>,
    /// All causes that were named. Those that a goal does not concern have free sizes in it.
    pub findings: Vec<Hypothesis>,
    /// Noise of each joint: variance of what is left of its effort times the autocorrelation time
    /// ((N·m)² s or N² s). Joints whose noise is zero or not finite are left out.
    pub noise: Vec<f64>,
    /// Cut-off of the low-pass of the diagnosis (Hz).
    pub cutoff_hz: f64,
}

/// Noise without a log: the standard deviation as a share of a joint's effort limit, and its
/// autocorrelation time (s).
const SUPPOSED_NOISE: (f64, f64) = (0.01, 0.05);

/// Cut-off without a log (Hz).
const SUPPOSED_CUTOFF_HZ: f64 = 5.0;

impl<'a> Question<'a> {
    /// A question before there is any log: without findings, and with a noise of 1 per cent of the
    /// effort limits.
    pub fn without_logs(shaped: &'a ShapedRobot, goals: Vec<Goal>) -> Self {
        let (share, time_s) = SUPPOSED_NOISE;
        let noise =
            efforts(&shaped.robot).into_iter().map(|effort| (share * effort).powi(2) * time_s);
        let noise = noise.collect();
        let (findings, cutoff_hz) = (Vec::new(), SUPPOSED_CUTOFF_HZ);
        Self { shaped, goals, findings, noise, cutoff_hz }
    }
    /// All hypotheses of findings and goals, each once.
    pub(crate) fn layout(&self) -> ColumnLayout {
        let mut hypotheses = self.findings.clone();
        for goal in &self.goals {
            match *goal {
                Goal::Separate { finding, rival } => {
                    hypotheses.extend([finding, rival]);
                    hypotheses.extend([finding, rival].into_iter().filter_map(shared_part));
                }
                Goal::Determine { finding } => hypotheses.push(finding),
            }
        }
        hypotheses.sort_unstable();
        hypotheses.dedup();
        let noise = self.noise.iter().map(|&n| (n > 0.0 && n.is_finite()).then_some(n));
        let widths = hypotheses
            .iter()
            .map(|h| h.bounds(&self.shaped.robot, &effects::Priors::default()).len())
            .collect();
        ColumnLayout { hypotheses, widths, noise: noise.collect(), cutoff_hz: self.cutoff_hz }
    }

    /// The findings that change other parameters than `one` and `other`.
    fn other_findings(&self, one: Hypothesis, other: Hypothesis) -> Vec<Hypothesis> {
        let concerned =
            |h: &Hypothesis| [one, other].into_iter().any(|own| *h == own || h.excludes(own));
        self.findings.iter().copied().filter(|h| !concerned(h)).collect()
    }
}

/// The Coulomb friction that a cause has in common with its rivals. Only the rest is in dispute:
/// the asymmetry of an asymmetric friction, the variation of a friction whose level varies.
fn shared_part(cause: Hypothesis) -> Option<Hypothesis> {
    cause.together().first().copied().or_else(|| cause.varies())
}

/// Level of the Coulomb friction that the robot is described with (N·m or N).
fn friction(robot: &Robot, level: Hypothesis) -> f64 {
    let link = level.joint().and_then(|j| robot.links().get(j));
    link.map_or(0.0, |l| 0.5 * (l.actuator.coulomb_forward + l.actuator.coulomb_backward))
}

/// Share of the Coulomb friction that is taken to vary where no log shows it.
const VARYING: f64 = 0.5;

/// A criterion of a goal (nats).
#[derive(Debug, Clone)]
pub(crate) enum Aim<'a> {
    /// A model cannot imitate a cause: half of the deviance that it leaves.
    Separate { truth: Vec<usize>, weights: DVector<f64>, model: Vec<usize> },
    /// Weights are known from logs and motion together: `1/2 ln det(1 + S M S)`, with `M` the
    /// information and `S` the prior standard deviations.
    Determine {
        columns: Vec<usize>,
        others: Vec<usize>,
        prior: Vec<f64>,
        logs: &'a ColumnInformation,
    },
}

impl<'a> Aim<'a> {
    /// The aims of a goal: a pair of rivals is to be told apart whichever is true.
    pub fn of(
        goal: Goal,
        question: &Question,
        layout: &ColumnLayout,
        known: &'a Known,
    ) -> Vec<Self> {
        match goal {
            Goal::Separate { finding, rival } => {
                let shared = [finding, rival].into_iter().find_map(shared_part);
                let mut besides = question.other_findings(finding, rival);
                besides.extend(shared.filter(|s| !besides.contains(s)));
                let ways = [[finding, rival], [rival, finding]].into_iter();
                // The shared friction is a special case of the rival, so no motion can show that it
                // is the whole cause.
                let ways = ways.filter(|[truth, _]| shared != Some(*truth));
                ways.map(|[truth, model]| {
                    Self::separate(truth, model, &besides, question, layout, known)
                })
                .collect()
            }
            Goal::Determine { finding } => vec![Self::Determine {
                columns: layout.columns(&[finding]),
                others: layout.columns(&question.other_findings(finding, finding)),
                prior: finding.prior(
                    &question.shaped.robot,
                    &known.scale,
                    &effects::Priors::default(),
                ),
                logs: &known.information,
            }],
        }
    }

    /// The aim that `model` and the other findings cannot imitate `truth`.
    fn separate(
        truth: Hypothesis,
        model: Hypothesis,
        besides: &[Hypothesis],
        question: &Question,
        layout: &ColumnLayout,
        known: &Known,
    ) -> Self {
        let of =
            |first| known.weights(layout, &question.shaped.robot, &[&[first], besides].concat());
        let columns = layout.columns(&[truth]);
        let weights = match truth.varies() {
            // No log has shown it yet: half of the level varies.
            Some(level) if level == model => {
                let mut weights = DVector::zeros(columns.len());
                weights[0] =
                    VARYING * (friction(&question.shaped.robot, level) + of(level)[0]).max(0.0);
                weights
            }
            _ => of(truth).rows(0, columns.len()).into_owned(),
        };
        let others: Vec<Hypothesis> = besides.iter().copied().filter(|h| *h != model).collect();
        let model = layout.columns(&[&[model], &others[..]].concat());
        Self::Separate { truth: columns, weights, model }
    }

    /// What the logs tell (nats).
    pub fn nats_before(&self, logs: &ColumnInformation) -> f64 {
        match self {
            Self::Separate { .. } => self.nats(logs),
            Self::Determine { columns, others, prior, logs } => {
                information_gain(logs, columns, others, prior)
            }
        }
    }

    /// What a motion tells (nats).
    pub fn nats(&self, motion: &ColumnInformation) -> f64 {
        match self {
            Self::Separate { truth, weights, model } => {
                0.5 * motion.deviance(&motion.residual_weights(truth, weights, model))
            }
            Self::Determine { columns, others, prior, logs } => {
                let both = ColumnInformation::sum(&[(*logs).clone(), motion.clone()]);
                both.map_or(0.0, |both| information_gain(&both, columns, others, prior))
            }
        }
    }

    /// What a motion tells without its most informative stretch (nats), as a single stretch may be
    /// chance.
    pub fn nats_without_best_stretch(
        &self,
        motion: &ColumnInformation,
        stretches: &[ColumnInformation],
    ) -> f64 {
        match self {
            Self::Separate { truth, weights, model } => {
                let left = motion.residual_weights(truth, weights, model);
                let parts = stretches.iter().map(|part| part.deviance(&left));
                0.5 * (motion.deviance(&left) - parts.fold(0.0, f64::max))
            }
            Self::Determine { .. } => self.nats(motion),
        }
    }

    /// Share of the cause that no part of the model imitates in a motion.
    pub fn unimitated_share(&self, motion: &ColumnInformation) -> f64 {
        match self {
            Self::Separate { truth, weights, model } => {
                let whole = motion.deviance(&motion.expand(truth, weights));
                let left = motion.deviance(&motion.residual_weights(truth, weights, model));
                if whole > 0.0 { left / whole } else { 0.0 }
            }
            Self::Determine { .. } => 1.0,
        }
    }
}

/// Information gained on some weights, `1/2 ln det(1 + S M S)` (nats).
fn information_gain(
    known: &ColumnInformation,
    columns: &[usize],
    others: &[usize],
    prior: &[f64],
) -> f64 {
    let known = known.information_about(columns, others);
    let scaled =
        DMatrix::from_fn(prior.len(), prior.len(), |i, k| known[(i, k)] * prior[i] * prior[k]);
    let values = scaled.symmetric_eigenvalues();
    0.5 * values.iter().map(|v| v.max(0.0).ln_1p()).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use effects::Place;

    use catalogue::EffectKind;

    use super::*;
    use crate::testing::turntable;
    use crate::trial_shapes::with_trial_shapes;

    fn at(kind: EffectKind) -> Hypothesis {
        Hypothesis { kind, place: Place::Joint(0) }
    }

    /// Columns of truth and model of every aim of a pair, as hypotheses.
    fn aims(finding: EffectKind, rival: EffectKind) -> Vec<[Vec<EffectKind>; 2]> {
        let robot = with_trial_shapes(&turntable());
        let goal = Goal::Separate { finding: at(finding), rival: at(rival) };
        let mut question = Question::without_logs(&robot, vec![goal]);
        question.findings = vec![at(finding), at(EffectKind::CableSpring)];
        let layout = question.layout();
        let known = Known::of_limits(&robot, &layout);
        let kinds = |columns: &Vec<usize>| -> Vec<EffectKind> {
            let of = |h: &&Hypothesis| layout.columns(&[**h]).iter().any(|k| columns.contains(k));
            layout.hypotheses.iter().filter(of).map(|h| h.kind).collect()
        };
        let both = |aim: Aim| match aim {
            Aim::Separate { truth, model, .. } => [kinds(&truth), kinds(&model)],
            Aim::Determine { columns, others, .. } => [kinds(&columns), kinds(&others)],
        };
        Aim::of(goal, &question, &layout, &known).into_iter().map(both).collect()
    }

    #[test]
    fn either_rival_may_be_true_and_the_other_findings_are_free() {
        use EffectKind::{
            AsymmetricFriction, CableSpring, CoulombFriction, StribeckFriction, TorqueOffset,
            ViscousFriction,
        };
        let expected = [
            [vec![ViscousFriction], vec![CoulombFriction, CableSpring]],
            [vec![CoulombFriction], vec![ViscousFriction, CableSpring]],
        ];
        assert_eq!(aims(ViscousFriction, CoulombFriction), expected);
        // Only the asymmetry is in dispute.
        let expected = [
            [vec![AsymmetricFriction], vec![CoulombFriction, CableSpring, TorqueOffset]],
            [vec![TorqueOffset], vec![CoulombFriction, AsymmetricFriction, CableSpring]],
        ];
        assert_eq!(aims(AsymmetricFriction, TorqueOffset), expected);
        // Coulomb friction is a case of the other: only what is beyond it can be shown.
        let expected = [[vec![StribeckFriction], vec![CoulombFriction, CableSpring]]];
        assert_eq!(aims(CoulombFriction, StribeckFriction), expected);
        assert_eq!(aims(StribeckFriction, CoulombFriction), expected);
    }

    fn power(xx: f64) -> ColumnInformation {
        ColumnInformation { xx: DMatrix::from_element(1, 1, xx), xy: DVector::zeros(1) }
    }

    /// A cause with weight 3 that nothing imitates is worth `9/2 xx`.
    #[test]
    fn the_stretch_that_says_most_does_not_count_twice() {
        let weights = DVector::from_element(1, 3.0);
        let aim = Aim::Separate { truth: vec![0], weights, model: vec![] };
        let stretches = [power(1.0), power(6.0), power(2.0)];
        let whole = power(9.0);
        assert!((aim.nats(&whole) - 40.5).abs() < 1e-12);
        assert!((aim.nats_without_best_stretch(&whole, &stretches) - 13.5).abs() < 1e-12);
        assert!(
            (aim.unimitated_share(&whole) - 1.0).abs() < 1e-12
                && aim.unimitated_share(&power(0.0)) <= 0.0
        );
    }

    #[test]
    fn what_logs_and_motion_tell_of_a_weight_is_added_before_it_is_counted() {
        let logs = power(3.0);
        let aim =
            Aim::Determine { columns: vec![0], others: vec![], prior: vec![2.0], logs: &logs };
        assert!((aim.nats_before(&logs) - 0.5 * 13.0_f64.ln()).abs() < 1e-12);
        assert!((aim.nats(&power(5.0)) - 0.5 * 33.0_f64.ln()).abs() < 1e-12);
    }
}
