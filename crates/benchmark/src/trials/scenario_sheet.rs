use catalogue::EffectKind;
use experiment::Blinded;
use logs::Run;
use motion::MotionSpec;
use population::{
    CauseRole, Corner, EffortClass, Knowledge, MotionClass, Origin, Strength, TrueCause,
    TrueStranger, TruthSheet,
};
use robot::Loaded;
use simulator::EffortSource;
use simulator::scenario::Scenario;

/// The strength of what a scenario hides: visible by construction.
///
/// A scenario draws every effect at a share of its joint's torque (`hidden.torque_share`) for motions in which all
/// effects show, and no oracle weighs it. So each counts as visible, and as much as any other.
const HIDDEN_ON_PURPOSE: Strength = Strength { sigmas: f64::MAX, share: 1.0, torque: 1.0 };

/// The sheet of a trial that hides effects in the arm of a scenario. Effects that the diagnosis does not look for are
/// strangers to it.
pub(super) fn scenario_sheet(
    truth: &Blinded,
    without: &[EffectKind],
    scenario: &Scenario,
    (loaded, given): (&Loaded, &[Run]),
) -> TruthSheet {
    let strength = HIDDEN_ON_PURPOSE;
    let cause = |truth: &simulator::Truth| TrueCause {
        role: CauseRole::Hidden,
        truth: truth.clone(),
        strength,
    };
    let stranger = |name: String, joint: &Option<String>| TrueStranger {
        name,
        joint: joint.clone(),
        strength,
        spoiling: None,
    };
    let (unknown, known): (Vec<_>, Vec<_>) =
        truth.effects.iter().partition(|truth| without.contains(&truth.effect));
    let unknown = unknown
        .into_iter()
        .map(|truth| stranger(format!("not looked for: {}", truth.effect.label()), &truth.joint));
    let strange = truth.strangers.iter();
    let strange = strange.map(|other| stranger(other.stranger.name().to_owned(), &other.joint));
    TruthSheet {
        seed: truth.seed,
        corner: corner(scenario, loaded, given),
        knowledge: Knowledge::Whole,
        joints: loaded.robot.joint_names().map(str::to_owned).collect(),
        torque_rms: (0..loaded.robot.joint_count()).map(|j| effort_rms(given, j)).collect(),
        causes: known.into_iter().map(cause).collect(),
        strangers: unknown.chain(strange).collect(),
    }
}

/// RMS of the effort of a joint over all logs (N m or N).
fn effort_rms(runs: &[Run], j: usize) -> f64 {
    let efforts = || runs.iter().flat_map(|run| run.joints.get(j)).flat_map(|joint| &joint.effort);
    (efforts().map(|tau| tau * tau).sum::<f64>() / efforts().count().max(1) as f64).sqrt()
}

fn corner(scenario: &Scenario, loaded: &Loaded, given: &[Run]) -> Corner {
    let (sensors, specs) = (&scenario.spec().sensors, &scenario.spec().run);
    let length = |run: &Run| run.time.last().unwrap_or(&0.0) - run.time.first().unwrap_or(&0.0);
    let length_s: f64 = given.iter().map(length).sum();
    let samples: usize = given.iter().map(|run| run.time.len().saturating_sub(1)).sum();
    Corner {
        origin: Origin::Simulated,
        arm: loaded.robot.name().to_owned(),
        motion: specs.first().map_or(MotionClass::PointToPoint, |run| class(&run.motion)),
        effort: match sensors.effort {
            EffortSource::Commanded => EffortClass::Command,
            EffortSource::Motor => EffortClass::Current,
            EffortSource::Link => EffortClass::JointTorque,
        },
        joints: loaded.robot.joint_count(),
        encoder_step: sensors.position_resolution_rad.values().copied().fold(0.0, f64::max),
        rate_hz: if length_s > 0.0 { samples as f64 / length_s } else { 0.0 },
        logs: given.len(),
        length_s,
        repeats: specs.len() > 1 && specs.iter().all(|run| run.motion == specs[0].motion),
        field: Vec::new(),
        log_kinds: Vec::new(),
        goal_delay_ms: None,
    }
}

/// The kind of a motion; of a sequence that of the first.
fn class(motion: &MotionSpec) -> MotionClass {
    match motion {
        MotionSpec::Sinusoids(_) | MotionSpec::Fourier(_) => MotionClass::Sinusoids,
        MotionSpec::Sweep(_) => MotionClass::JointByJoint,
        MotionSpec::Chirp(_) => MotionClass::Sweep,
        MotionSpec::Ramp(_) | MotionSpec::Hold(_) | MotionSpec::Waypoints(_) => {
            MotionClass::PointToPoint
        }
        MotionSpec::Rhythm(_) => MotionClass::Repeated,
        MotionSpec::Recorded(_) => MotionClass::LedByHand,
        MotionSpec::Sequence(all) => all.first().map_or(MotionClass::PointToPoint, class),
    }
}
