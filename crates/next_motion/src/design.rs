use std::ops::RangeInclusive;

use logs::{Prepared, PreparedRun, of_run};
use motion::{Motion, MotionSpec};

use crate::aim::{Aim, Goal, Question};
use crate::error::NextMotionError;
use crate::known::Known;
use crate::limits::usable;
use crate::search::Search;

/// Lengths of a motion (s). More information comes from running it several times.
const DURATION_S: RangeInclusive<f64> = 1.0..=120.0;

/// How a motion is searched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DesignSettings {
    /// Length of the motion (s), 1 to 120.
    pub duration_s: f64,
    /// Seed of every random draw.
    pub seed: u64,
}

impl Default for DesignSettings {
    fn default() -> Self {
        Self { duration_s: 20.0, seed: 1 }
    }
}

/// The answer to a [`Question`].
#[derive(Debug, Clone, PartialEq)]
pub struct ExcitationDesign {
    /// One entry a goal.
    pub prospects: Vec<Prospect>,
    /// The motion; none where no motion helps any goal.
    pub motion: Option<DesignedMotion>,
}

/// A motion that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignedMotion {
    /// Its description in a scenario.
    pub spec: MotionSpec,
    /// The motion itself.
    pub motion: Motion,
}

/// What the logs and the motion tell about one goal (nats).
///
/// For two rivals: the expected log evidence against the wrong one. For a cause to determine: the
/// information gained on its parameters; every `ln 2` halves the width of one interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prospect {
    /// The goal.
    pub goal: Goal,
    /// From the logs; 0 without logs.
    pub before: f64,
    /// From the motion; for a cause to determine, from logs and motion together. None where no
    /// motion can settle the goal.
    pub after: Option<f64>,
}

/// Log evidence at which the diagnosis tells rivals apart nineteen times in twenty (nats).
///
/// With `D` twice the expected log evidence, what a log says is `D` with a standard deviation
/// of `2 sqrt(D)`, and the diagnosis asks for twice that: `D - 1.64 2 sqrt(D) = 2 2 sqrt(D)`.
pub const SEPARATING_NATS: f64 = 26.6;

/// Most repetitions of a motion that are proposed.
const MOST_RUNS: f64 = 10.0;

impl Prospect {
    /// How many times the motion is to be run to reach the goal; none where it does not help.
    pub fn runs(&self) -> Option<usize> {
        let after = self.after?;
        let runs = match self.goal {
            Goal::Separate { .. } => (SEPARATING_NATS / after).ceil(),
            // One interval of half the width.
            Goal::Determine { .. } if after - self.before >= std::f64::consts::LN_2 => 1.0,
            Goal::Determine { .. } => return None,
        };
        (runs <= MOST_RUNS).then_some(runs as usize)
    }
}

/// The motion for which the goal of a question that it tells least about is told most.
///
/// Rivals have the sizes at which they explain `logs` best; without logs, a tenth of their prior
/// standard deviations. The same input and seed give the same motion, whatever the number of
/// threads.
///
/// # Errors
///
/// [`NextMotionError`] for goals, logs or settings that cannot be used, and where no motion
/// keeps to the effort limits. Goals that no motion serves are no error.
pub fn design(
    question: &Question,
    logs: Option<&Prepared>,
    settings: &DesignSettings,
) -> Result<ExcitationDesign, NextMotionError> {
    check(question, logs, settings)?;
    let layout = question.layout();
    let known = match logs {
        Some(logs) => Known::of_logs(question.shaped, &layout, logs)?,
        None => Known::of_limits(question.shaped, &layout),
    };
    let search = Search {
        robot: &question.shaped.robot,
        layout: &layout,
        frame: &known.frame,
        usable: &usable(&question.shaped.robot),
        duration_s: settings.duration_s,
        seed: settings.seed,
    };
    let drawn = search.draw()?;
    let aims: Vec<Vec<Aim>> =
        question.goals.iter().map(|&goal| Aim::of(goal, question, &layout, &known)).collect();
    let open: Vec<Vec<&Aim>> = aims.iter().map(|a| search.within_reach(a, &drawn)).collect();
    let all: Vec<&Aim> = open.iter().flatten().copied().collect();
    let best = if all.is_empty() { None } else { search.improve(&all, drawn)? };
    let found = best.as_ref().map(|c| search.information_of(&c.motion)).transpose()?.flatten();
    let prospect = |(goal, aims): (&Goal, &Vec<&Aim>)| {
        let before = aims.iter().map(|aim| aim.nats_before(&known.information)).reduce(f64::min);
        let after = |found| aims.iter().map(|aim| aim.nats(found)).reduce(f64::min);
        Prospect {
            goal: *goal,
            before: before.unwrap_or(0.0),
            after: found.as_ref().and_then(after),
        }
    };
    Ok(ExcitationDesign {
        prospects: question.goals.iter().zip(&open).map(prospect).collect(),
        motion: best.map(|c| DesignedMotion { spec: c.spec, motion: c.motion }),
    })
}

fn check(
    question: &Question,
    logs: Option<&Prepared>,
    settings: &DesignSettings,
) -> Result<(), NextMotionError> {
    let expected = question.shaped.robot.joint_count();
    let wrong =
        |what: String, found: usize| Err(NextMotionError::WrongJoints { what, found, expected });
    if question.goals.is_empty() {
        return Err(NextMotionError::NoGoal);
    }
    let runs = logs.map(|logs| logs.runs.as_slice());
    if runs.is_some_and(<[PreparedRun]>::is_empty) {
        return Err(NextMotionError::NoRuns);
    }
    if question.noise.len() != expected {
        return wrong("the noise".to_owned(), question.noise.len());
    }
    let mut runs = runs.unwrap_or_default().iter();
    if let Some(run) = runs.find(|run| run.joints.len() != expected) {
        return wrong(of_run(&run.name), run.joints.len());
    }
    let refuse = |name, found, expected| Err(NextMotionError::Setting { name, found, expected });
    if !DURATION_S.contains(&settings.duration_s) {
        return refuse("duration", settings.duration_s, "1 to 120 s");
    }
    if !question.noise.iter().any(|&noise| noise > 0.0 && noise.is_finite()) {
        let found = question.noise.iter().copied().fold(0.0, f64::max);
        return refuse("noise", found, "a positive number at one joint at least");
    }
    if !(question.cutoff_hz > 0.0 && question.cutoff_hz.is_finite()) {
        return refuse("cut-off", question.cutoff_hz, "a positive number of hertz");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use catalogue::EffectKind;
    use effects::{Frame, Hypothesis, Place, ShapedRobot};
    use robot::Robot;

    use super::*;
    use crate::motion_record::MotionRecord;
    use crate::testing::{RATE_HZ, arm, log, turntable};

    fn at(kind: EffectKind, joint: usize) -> Hypothesis {
        Hypothesis { kind, place: Place::Joint(joint) }
    }

    /// The robot without trial shapes.
    fn shaped(robot: &Robot) -> ShapedRobot {
        ShapedRobot::new(robot.clone())
    }

    fn question(shaped: &ShapedRobot, goal: Goal) -> Question<'_> {
        let (Goal::Separate { finding, .. } | Goal::Determine { finding }) = goal;
        Question {
            shaped,
            goals: vec![goal],
            findings: vec![finding],
            noise: vec![1e-3; shaped.robot.joint_count()],
            cutoff_hz: 4.0,
        }
    }

    fn friction(joint: usize) -> Goal {
        Goal::Separate {
            finding: at(EffectKind::ViscousFriction, joint),
            rival: at(EffectKind::CoulombFriction, joint),
        }
    }

    const SHORT: DesignSettings = DesignSettings { duration_s: 8.0, seed: 3 };

    #[test]
    fn a_motion_tells_viscous_from_coulomb_friction_and_moves_no_joint_in_vain() {
        let robot = arm();
        let logs = log(&robot, |v| 0.2 * v);
        let found = design(&question(&shaped(&robot), friction(1)), Some(&logs), &SHORT).unwrap();
        let [prospect] = found.prospects.try_into().unwrap();
        let after = prospect.after.unwrap();
        // The log is 30 s long.
        assert!(after / 8.0 > 4.0 * prospect.before / 30.0, "{prospect:?}");
        let motion = found.motion.unwrap().motion;
        let shoulder: Vec<f64> = (0..80).map(|k| motion.at(0.1 * f64::from(k)).q[0]).collect();
        assert!(shoulder.iter().all(|q| (q - shoulder[0]).abs() < 1e-12), "{shoulder:?}");
    }

    #[test]
    fn a_motion_keeps_to_the_effort_limits_of_a_weak_arm() {
        // Level, its links ask for 16.7 and 2.9 N·m.
        let mut robot = arm();
        let limits = [18.0, 4.0];
        for (joint, effort) in limits.into_iter().enumerate() {
            robot.link_mut(joint).unwrap().joint.limits.effort = Some(effort);
        }
        let logs = log(&robot, |v| 0.2 * v);
        let found = design(&question(&shaped(&robot), friction(1)), Some(&logs), &SHORT).unwrap();
        let frame = Frame {
            rest_speed: vec![1e-3; 2],
            centre: vec![0.0; 2],
            reach: vec![1.0; 2],
            resolution: vec![0.0; 2],
            trial_gaps: vec![0.0; 2],
            trial_springs: vec![None; 2],
            trial_lateness_s: 0.0,
        };
        let motion = found.motion.unwrap().motion;
        let along = MotionRecord::of_motion(&motion, 500.0).evaluate(&robot, &frame);
        for (torque, limit) in along.torque.iter().zip(limits) {
            let largest = torque.iter().fold(0.0, |m: f64, t| m.max(t.abs()));
            assert!(largest < 0.81 * limit, "{largest}");
        }
    }

    /// Before there is a log: the motion is worth something, a log nothing.
    #[test]
    fn a_pair_is_told_apart_without_logs_at_supposed_sizes() {
        let shaped = ShapedRobot::new(arm());
        let question = Question::without_logs(&shaped, vec![friction(1)]);
        let found = design(&question, None, &SHORT).unwrap();
        let [prospect] = found.prospects.try_into().unwrap();
        assert!(prospect.before <= 0.0 && prospect.after > Some(SEPARATING_NATS), "{prospect:?}");
        assert!(found.motion.is_some());
    }

    #[test]
    fn the_same_seed_gives_the_same_motion_on_any_number_of_threads() {
        let robot = turntable();
        let logs = log(&robot, |v| 0.2 * v);
        let with = |threads: usize, seed: u64| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let settings = DesignSettings { seed, ..SHORT };
            pool.install(|| design(&question(&shaped(&robot), friction(0)), Some(&logs), &settings))
                .unwrap()
        };
        let one = with(1, 3);
        assert_eq!(one, with(3, 3));
        assert_ne!(one, with(1, 4));
    }

    #[test]
    fn what_adds_the_same_torque_is_told_apart_by_no_motion() {
        let robot = arm();
        let goal = Goal::Separate {
            finding: Hypothesis { kind: EffectKind::Payload, place: Place::Link(1) },
            rival: Hypothesis { kind: EffectKind::InertialParameters, place: Place::Link(1) },
        };
        let found =
            design(&question(&shaped(&robot), goal), Some(&log(&robot, |_| 0.3)), &SHORT).unwrap();
        assert!(found.motion.is_none() && found.prospects[0].after.is_none());
        assert_eq!(found.prospects[0].runs(), None);
    }

    /// One weight believed to be 0 give or take `s` is learned by `1/2 ln(1 + s^2 / sd^2)` nats.
    #[test]
    fn what_is_learned_of_one_weight_is_the_closed_form() {
        let robot = turntable();
        let logs = log(&robot, |v| 0.2 * v);
        let finding = at(EffectKind::ViscousFriction, 0);
        let goal = Goal::Determine { finding };
        let found = design(&question(&shaped(&robot), goal), Some(&logs), &SHORT).unwrap();
        let qd = &logs.runs[0].joints[0].qd;
        let power = qd.iter().map(|v| v * v).sum::<f64>() / RATE_HZ / 1e-3;
        let s = finding.prior(
            &robot,
            &effects::Scale::of_logs(&robot, &logs),
            &effects::Priors::default(),
        )[0];
        let expected = 0.5 * (s * s * power).ln_1p();
        let [prospect] = found.prospects.try_into().unwrap();
        assert!((prospect.before - expected).abs() < 1e-3, "{prospect:?} {expected}");
        assert!(prospect.after.unwrap() > prospect.before && prospect.runs() == Some(1));
    }

    #[test]
    fn an_arm_that_cannot_hold_itself_has_no_motion() {
        let mut robot = arm();
        for joint in 0..2 {
            robot.link_mut(joint).unwrap().joint.limits.effort = Some(1e-3);
        }
        let logs = log(&robot, |v| 0.2 * v);
        let found = design(&question(&shaped(&robot), friction(1)), Some(&logs), &SHORT);
        assert!(matches!(found, Err(NextMotionError::TooHeavy { share }) if share > 1.0));
    }

    #[test]
    fn questions_that_cannot_be_answered_are_refused() {
        let robot = turntable();
        let logs = log(&robot, |v| v);
        let shaped = shaped(&robot);
        let whole = question(&shaped, friction(0));
        let refused = |question: Question, logs: &Prepared, settings: DesignSettings| {
            design(&question, Some(logs), &settings).unwrap_err().to_string()
        };
        let none = Question { goals: vec![], ..whole.clone() };
        assert!(refused(none, &logs, SHORT).starts_with("no goal was given"));
        let deaf = Question { noise: vec![f64::NAN], ..whole.clone() };
        assert!(refused(deaf, &logs, SHORT).starts_with("noise: found 0"));
        let wide = Question { noise: vec![1.0; 2], ..whole.clone() };
        assert!(refused(wide, &logs, SHORT).starts_with("the noise has 2 joints"));
        let empty = Prepared { runs: vec![], ..logs.clone() };
        assert!(refused(whole.clone(), &empty, SHORT).starts_with("no log was given"));
        for duration_s in [f64::NAN, 0.5, 1e9] {
            let settings = DesignSettings { duration_s, ..SHORT };
            assert!(refused(whole.clone(), &logs, settings).starts_with("duration: found"));
        }
        let still = Question { cutoff_hz: 0.0, ..whole };
        assert!(refused(still, &logs, SHORT).starts_with("cut-off: found 0"));
    }

    /// `D` and its standard deviation `2 sqrt(D)`: nineteen times in twenty above twice that.
    #[test]
    fn the_evidence_needed_is_where_the_margin_meets_the_test() {
        let d = 2.0 * SEPARATING_NATS;
        assert!((d - 1.645 * 2.0 * d.sqrt() - 2.0 * 2.0 * d.sqrt()).abs() < 0.1);
        let goal = friction(0);
        let runs = |after| Prospect { goal, before: 1.0, after }.runs();
        assert_eq!(runs(Some(30.0)), Some(1));
        assert_eq!(runs(Some(9.0)), Some(3));
        assert_eq!((runs(Some(2.0)), runs(Some(0.0)), runs(None)), (None, None, None));
    }
}
