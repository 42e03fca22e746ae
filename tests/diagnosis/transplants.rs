//! Transplants: effects put into recorded logs of real arms, whose noise and whose faults no
//! simulation knows. What the diagnosis says of a log with the effect is held against what it
//! says of the log without.
//!
//! There is no ground truth for what the arms had before, so a false alarm is a finding that
//! comes with the effect and is another one, or that comes when a part of an untouched log is
//! left out.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use checks::recorded::folder;
use diagnosis::{Diagnosis, EffectAt, Settings, Silent, diagnose};
use logs::{Channels, ReadOptions, Run, read_run};
use rayon::prelude::*;
use robot::Robot;

use crate::before_and_after::{Named, Seen, is_new, seen};
use crate::grafts::{GRAFTS, Graft, Law, add, add_point_mass, rms, shift, unit};

/// RMS of what an effect adds to a joint, over the RMS that the diagnosis of the untouched logs
/// leaves there.
const STRENGTHS: [f64; 2] = [1.0, 3.0];

/// Masses (kg) and delays (s), which act on all joints.
const MASSES: [f64; 2] = [0.5, 2.0];
const DELAYS_S: [f64; 2] = [0.005, 0.02];

/// Of 48 cases, how many must be named, themselves or as a rival of what is named. Those that are not are
/// mostly of effects that the bodies and frictions which the descriptions of these arms lack can stand in for.
const NAMED_AT_LEAST: usize = 27;

/// New findings besides in all 48 logs that no part of the log without the effect has either. Others
/// come and go as a part of the log does.
const STRAYS_AT_MOST: usize = 17;

/// Share of the cases in which the same effect is named at the same place when only a part of
/// the untouched log is left out.
const FALSE_ALARMS_AT_MOST: f64 = 0.05;

/// An arm, its recorded runs, the joints that get effects, and what is said of it untouched:
/// of all there is, and where a part is left out.
struct Arm {
    name: &'static str,
    robot: Robot,
    runs: Vec<Run>,
    joints: [usize; 2],
    untouched: Diagnosis,
    less: Vec<Diagnosis>,
}

/// The name of an arm's folder, its runs and the joints that get effects.
type Recorded = (&'static str, &'static [&'static str], [usize; 2]);

const ARMS: [Recorded; 3] = [
    (
        "kinova_gen3",
        &[
            "Trajectory1",
            "RunTrajectory1",
            "RecordTrajectory_quadratic",
            "opti_traj_testing1",
            "opti_traj_testing2",
        ],
        [1, 3],
    ),
    ("kuka_lwr4", &["measurements_1", "measurements_2", "measurements_3"], [1, 3]),
    ("staubli_tx40", &["excitation"], [0, 2]),
];

fn look(robot: &Robot, runs: &[Run]) -> Diagnosis {
    diagnose(robot, runs, &Settings::default(), &Silent).unwrap().diagnosis
}

impl Arm {
    fn read(folder: &Path, (name, runs, joints): Recorded) -> Self {
        let folder = folder.join(name);
        let robot = Robot::load(&folder.join("robot.urdf")).unwrap().robot;
        let path = |run: &str| folder.join(format!("{run}.parquet"));
        let read = |run: &&str| read_run(&path(run), &robot, &ReadOptions::default()).unwrap();
        let runs: Vec<Run> = runs.iter().map(read).collect();
        let untouched = look(&robot, &runs);
        let less = with_less(&runs).par_iter().map(|runs| look(&robot, runs)).collect();
        Self { name, robot, runs, joints, untouched, less }
    }

    /// Whether a finding is there without any effect put in, where a part of the log is left out.
    fn has_in_part(&self, at: &EffectAt) -> bool {
        self.less.iter().any(|part| part.findings.iter().any(|f| f.at == *at))
    }

    fn cases(&self) -> Vec<Case<'_>> {
        let last = [self.robot.joint_count() - 1];
        let places = |graft: Graft| match graft.law {
            Law::Joint(_) => &self.joints[..],
            Law::PointMass | Law::Late => &last[..],
        };
        // Every effect at every joint: weak at one and strong at the other, and the next effect the other way round.
        let all = GRAFTS.iter().flat_map(|&graft| places(graft).iter().map(move |&j| (graft, j)));
        let case =
            |(i, (graft, joint))| Case { arm: self, graft, joint, strength: (i + i / 2) % 2 };
        all.enumerate().map(case).collect()
    }
}

/// Logs with one part left out: a run, or a third of the only one.
fn with_less(runs: &[Run]) -> Vec<Vec<Run>> {
    if let [run] = runs {
        let (n, third) = (run.time.len(), run.time.len() / 3);
        return vec![vec![part(run, 0..n - third)], vec![part(run, third..n)]];
    }
    let without = |k| {
        let kept = runs.iter().enumerate().filter(|(i, _)| *i != k);
        kept.map(|(_, run)| run.clone()).collect()
    };
    (0..runs.len()).map(without).collect()
}

/// A stretch of a run.
fn part(run: &Run, samples: Range<usize>) -> Run {
    let of = |joint: &Channels| Channels {
        name: joint.name.clone(),
        position: joint.position[samples.clone()].to_vec(),
        effort: joint.effort[samples.clone()].to_vec(),
        ..Channels::default()
    };
    let (time, joints) = (run.time[samples.clone()].to_vec(), run.joints.iter().map(of).collect());
    Run { time, joints, extra: BTreeMap::new(), ..run.clone() }
}

/// One effect in one log.
struct Case<'a> {
    arm: &'a Arm,
    graft: Graft,
    joint: usize,
    strength: usize,
}

impl Case<'_> {
    /// The effect and where it is put, as a finding would say it.
    fn at(&self) -> EffectAt {
        let link = &self.arm.robot.links()[self.joint];
        let (joint, link) = match self.graft.law {
            Law::Joint(_) => (Some(link.joint.name.clone()), None),
            Law::PointMass => (None, Some(link.name.clone())),
            Law::Late => (None, None),
        };
        EffectAt { effect: self.graft.kind, joint, link }
    }

    /// The logs with the effect, and its size.
    fn runs(&self) -> (Vec<Run>, f64) {
        let mut runs = self.arm.runs.clone();
        let size = match self.graft.law {
            Law::Joint(law) => {
                let unit = unit(&runs, self.joint, law);
                let left = self.arm.untouched.joints[self.joint].remaining_rms_nm;
                let size = STRENGTHS[self.strength] * left / rms(&unit);
                add(&mut runs, self.joint, &unit, size);
                size
            }
            Law::PointMass => {
                add_point_mass(&mut runs, &self.arm.robot, MASSES[self.strength]);
                MASSES[self.strength]
            }
            Law::Late => shift(&mut runs, DELAYS_S[self.strength]),
        };
        (runs, size)
    }

    fn seen(&self) -> Seen {
        let (runs, size) = self.runs();
        let after = look(&self.arm.robot, &runs);
        seen([&self.arm.untouched, &after], &self.at(), (self.graft.size, size))
    }
}

#[test]
fn recorded_logs_with_an_effect_put_in_are_told_from_those_without() {
    let Some(folder) = folder() else { return };
    let arms: Vec<Arm> = ARMS.par_iter().map(|arm| Arm::read(&folder, *arm)).collect();
    for arm in &arms {
        let named: Vec<String> = arm.untouched.findings.iter().map(|f| f.at.words()).collect();
        println!("{} untouched: {named:?}", arm.name);
    }
    let cases: Vec<Case> = arms.iter().flat_map(Arm::cases).collect();
    let seen: Vec<Seen> = cases.par_iter().map(Case::seen).collect();
    for (case, seen) in cases.iter().zip(&seen) {
        println!("{:<13} {:<42} {}", case.arm.name, case.at().words(), seen.words());
    }
    print_counts(&cases, &seen);
    let besides =
        || cases.iter().zip(&seen).flat_map(|(c, s)| s.strays.iter().map(|at| (c.arm, at)));
    let strays = besides().filter(|(arm, at)| !arm.has_in_part(at)).count();
    println!(
        "findings besides: {} in {} logs, {strays} of them in no part of the log without the effect",
        besides().count(),
        seen.len()
    );
    let (alarms, asked) = false_alarms(&arms, &cases);
    println!("false alarms of the same kinds at the same places: {alarms} of {asked}");

    let named = seen.iter().filter(|s| s.named != Named::Missed).count();
    assert!(named >= NAMED_AT_LEAST, "{named}");
    assert!(strays <= STRAYS_AT_MOST, "{strays}");
    assert!(alarms as f64 <= FALSE_ALARMS_AT_MOST * asked as f64, "{alarms} of {asked}");
}

/// How often each effect is named, by its strength.
fn print_counts(cases: &[Case], seen: &[Seen]) {
    let all = [Named::First, Named::Any, Named::Rival, Named::Missed];
    let counts = |of: &dyn Fn(&Case) -> bool| {
        let named: Vec<Named> =
            cases.iter().zip(seen).filter(|(case, _)| of(case)).map(|(_, s)| s.named).collect();
        all.map(|n| format!("{n:?} {}", named.iter().filter(|m| **m == n).count())).join(", ")
    };
    for strength in [0, 1] {
        for graft in GRAFTS {
            let of = |case: &Case| case.graft.kind == graft.kind && case.strength == strength;
            println!("strength {strength} {:<27} {}", graft.kind.label(), counts(&of));
        }
        println!("strength {strength}: {}", counts(&|case| case.strength == strength));
    }
}

/// How often the effects of the cases are new findings at their places where nothing was put
/// in and a part of the log is left out, and of how many questions.
fn false_alarms(arms: &[Arm], cases: &[Case]) -> (usize, usize) {
    let (mut alarms, mut asked) = (0, 0);
    let found = arms.iter().flat_map(|arm| arm.less.iter().map(move |less| (arm, less)));
    for (arm, diagnosis) in found {
        let new = diagnosis.findings.iter().filter(|f| is_new(&arm.untouched, f));
        let new: Vec<&EffectAt> = new.map(|f| &f.at).collect();
        let words: Vec<String> = new.iter().map(|at| at.words()).collect();
        println!("{} with a part left out: {words:?}", arm.name);
        for case in cases.iter().filter(|case| case.arm.name == arm.name) {
            asked += 1;
            alarms += usize::from(new.contains(&&case.at()));
        }
    }
    (alarms, asked)
}
