//! Recorded logs as members of the population, against closed forms of their raw columns.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::path::Path;

use catalogue::EffectKind;
use checks::recorded::folder;
use checks::synthetic::whole_run;
use logs::{Channels, Run};
use population::{
    AddedLaw, Knowledge, Origin, PointMass, PopulationError, RecordedTrial, Transplant, available,
    draw_recorded_trial, point_mass_torque,
};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robot::Robot;

/// Seeds among which every arm and every cause comes up.
const SEEDS: std::ops::Range<u64> = 0..80;

fn trial(data: &Path, origin: Origin, seed: u64) -> RecordedTrial {
    draw_recorded_trial(data, origin, seed, &mut ChaCha8Rng::seed_from_u64(seed)).unwrap()
}

fn rms<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    let (n, sum) = values.fold((0.0, 0.0), |(n, sum), x| (n + 1.0, sum + x * x));
    f64::sqrt(sum / n)
}

/// Files and times of all rows of runs.
fn samples(runs: &[Run]) -> BTreeSet<(&Path, u64)> {
    runs.iter()
        .flat_map(|run| run.time.iter().map(|t| (run.source.as_path(), t.to_bits())))
        .collect()
}

#[test]
fn every_recorded_arm_is_drawn_and_what_is_held_out_is_not_given() {
    let Some(data) = folder() else { return };
    let arms: BTreeSet<&str> = available(&data).iter().map(population::RecordedArm::name).collect();
    let mut drawn: BTreeMap<String, usize> = BTreeMap::new();
    for seed in SEEDS {
        let RecordedTrial { runs, held_out, sheet, .. } = trial(&data, Origin::Recorded, seed);
        let corner = &sheet.corner;
        let times = drawn.entry(corner.arm.clone()).or_default();
        *times += 1;
        if *times == 1 {
            let names = |runs: &[Run]| {
                let name = |run: &Run| {
                    format!("{} {:.1} s", run.name, run.time[run.time.len() - 1] - run.time[0])
                };
                runs.iter().map(name).collect::<Vec<_>>().join(", ")
            };
            println!("{corner:?}\n  given {}\n  held out {}", names(&runs), names(&held_out));
        }
        assert!(samples(&runs).is_disjoint(&samples(&held_out)), "{}", corner.arm);
        assert_eq!(sheet.knowledge, Knowledge::None);
        assert!(sheet.causes.is_empty() && sheet.strangers.is_empty());
        assert_eq!(runs.len(), corner.logs);
        assert!(corner.encoder_step > 0.0 && corner.encoder_step < 0.1, "{corner:?}");
        for run in runs.iter().chain(&held_out) {
            let length = run.time[run.time.len() - 1] - run.time[0];
            assert!((0.9..=60.0).contains(&length), "{} {length} s", run.name);
            assert!((run.time.len() as f64 - 1.0) / length < 376.0, "{}", run.name);
            assert_eq!(run.joints.len(), sheet.joints.len());
        }
    }
    println!("{drawn:?}");
    assert_eq!(drawn.keys().map(String::as_str).collect::<BTreeSet<_>>(), arms);
}

#[test]
fn every_log_of_an_arm_with_several_is_held_out_in_turn() {
    let Some(data) = folder() else { return };
    if available(&data).iter().all(|arm| arm.name() != "lwr4") {
        return;
    }
    let trials = SEEDS.map(|seed| trial(&data, Origin::Recorded, seed));
    let held_out: BTreeSet<String> = trials
        .filter(|trial| trial.sheet.corner.arm == "lwr4")
        .map(|trial| trial.held_out.iter().map(|run| run.name.clone()).collect())
        .collect();
    let all = ["measurements_1", "measurements_2", "measurements_3"].map(str::to_owned);
    assert_eq!(held_out, BTreeSet::from(all));
}

/// Direction of motion of a joint by hand: slope over 20 ms either side, in proportion below 10 mrad/s.
fn direction(run: &Run, joint: usize) -> Vec<f64> {
    let (t, q, n) = (&run.time, &run.joints[joint].position, run.time.len());
    let h = (0.02 * (n - 1) as f64 / (t[n - 1] - t[0])).round().max(1.0) as usize;
    let mut direction = Vec::new();
    for i in 0..n {
        let first = i.saturating_sub(h);
        let last = if i + h > n - 1 { n - 1 } else { i + h };
        let speed = (q[last] - q[first]) / (t[last] - t[first]);
        direction.push(if speed.abs() > 0.01 { speed.signum() } else { speed / 0.01 });
    }
    direction
}

/// What a plain run lacks of the same run with a cause, joint by joint.
fn difference(plain: &Run, with: &Run) -> Vec<Vec<f64>> {
    let of = |(a, b): (&Channels, &Channels)| {
        assert_eq!((&a.position, &a.velocity), (&b.position, &b.velocity));
        b.effort.iter().zip(&a.effort).map(|(b, a)| b - a).collect()
    };
    plain.joints.iter().zip(&with.joints).map(of).collect()
}

#[test]
fn a_transplant_is_the_plain_log_and_its_closed_form_at_one_joint() {
    let Some(data) = folder() else { return };
    if available(&data).is_empty() {
        return;
    }
    let mut checked = BTreeSet::new();
    for seed in SEEDS {
        let with = trial(&data, Origin::Transplant, seed);
        let plain = trial(&data, Origin::Recorded, seed);
        assert_eq!(
            (with.runs.len(), with.held_out.len()),
            (plain.runs.len(), plain.held_out.len())
        );
        assert_eq!(with.sheet.causes.len() + with.sheet.strangers.len(), 1);
        let Some(cause) = with.sheet.causes.first() else { continue };
        let (kind, size) = (cause.truth.effect, cause.truth.parameters.values().next());
        let Some(joint) = cause.truth.joint.as_ref() else { continue };
        if ![EffectKind::CoulombFriction, EffectKind::TorqueOffset].contains(&kind) {
            continue;
        }
        let joint = with.sheet.joints.iter().position(|name| name == joint).unwrap();
        let both = |trial: &RecordedTrial| [trial.runs.clone(), trial.held_out.clone()].concat();
        let mut added = Vec::new();
        for (plain, with) in both(&plain).iter().zip(&both(&with)) {
            let expected = match kind {
                EffectKind::TorqueOffset => vec![1.0; plain.time.len()],
                _ => direction(plain, joint),
            };
            for (other, found) in difference(plain, with).iter().enumerate() {
                for (found, unit) in found.iter().zip(&expected) {
                    let expected = if other == joint { unit * size.unwrap() } else { 0.0 };
                    assert!((found - expected).abs() < 1e-9, "{kind:?} {found} {expected}");
                }
            }
            added.extend(expected);
        }
        let effort = rms(plain.runs.iter().flat_map(|run| &run.joints[joint].effort));
        let share = size.unwrap().abs() * rms(added.iter()) / effort;
        assert!((0.01..1.0).contains(&share), "{share}");
        checked.insert(kind);
    }
    assert_eq!(checked.len(), 2, "{checked:?}");
}

#[test]
fn every_cause_is_drawn_with_a_strength_that_is_a_number() {
    let Some(data) = folder() else { return };
    if available(&data).is_empty() {
        return;
    }
    let mut names: BTreeMap<String, [usize; 2]> = BTreeMap::new();
    for seed in SEEDS {
        let RecordedTrial { sheet, .. } = trial(&data, Origin::Transplant, seed);
        let named = sheet.causes.iter().map(|c| (c.truth.effect.label(), c.strength));
        let strangers = sheet.strangers.iter().map(|s| (s.name.clone(), s.strength));
        for (name, strength) in named.chain(strangers) {
            println!(
                "{seed} {} {name} {strength:?} {:?}",
                sheet.corner.arm,
                sheet.causes.first().map(|c| &c.truth.parameters)
            );
            let numbers = [strength.sigmas, strength.share, strength.torque];
            assert!(numbers.iter().all(|x| x.is_finite() && *x >= 0.0), "{name} {strength:?}");
            assert!(strength.torque < 2.0, "{name} {strength:?}");
            assert!(strength.share <= strength.torque * (1.0 + 1e-9), "{name} {strength:?}");
            let [drawn, visible] = names.entry(name).or_default();
            *drawn += 1;
            *visible += usize::from(strength.visible());
        }
        assert_eq!(sheet.knowledge, Knowledge::Added);
    }
    println!("drawn and visible: {names:?}");
    assert_eq!(names.len(), 12);
    let [drawn, visible] = names.values().fold([0, 0], |[a, b], [c, d]| [a + c, b + d]);
    assert!(2 * visible > drawn, "{visible} of {drawn}");
}

#[test]
fn a_recorded_trial_follows_from_its_seed() {
    let Some(data) = folder() else { return };
    if available(&data).is_empty() {
        return;
    }
    let mut hidden = Vec::new();
    for seed in 0..6 {
        let [once, again] = [0, 1].map(|_| trial(&data, Origin::Transplant, seed));
        assert_eq!(once, again);
        hidden.push((once.sheet.causes, once.sheet.strangers));
    }
    for (number, one) in hidden.iter().enumerate() {
        assert!(!hidden[..number].contains(one), "{one:?}");
    }
}

#[test]
fn without_recorded_logs_no_trial_of_them_is_drawn() {
    let empty = tempfile::tempdir().unwrap();
    let data = empty.path();
    assert!(available(data).is_empty());
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut drawn = |origin| draw_recorded_trial(data, origin, 1, &mut random).unwrap_err();
    let missing = PopulationError::NoRecordedLogs { data: data.to_owned() };
    assert_eq!(drawn(Origin::Recorded), missing);
    assert_eq!(drawn(Origin::Transplant), missing);
    assert_eq!(drawn(Origin::Simulated), PopulationError::OriginSimulated);
}

/// A pendulum that hangs down at zero and turns about `y`, on a carriage that rises along `z`.
const CARRIAGE: &str = "<robot name='carriage'><link name='base'/>
<link name='carriage'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>
<link name='arm'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>
<joint name='rise' type='prismatic'><parent link='base'/><child link='carriage'/><axis xyz='0 0 1'/><limit lower='-9' upper='9' effort='9' velocity='9'/></joint>
<joint name='swing' type='revolute'><parent link='carriage'/><child link='arm'/><axis xyz='0 1 0'/><limit lower='-9' upper='9' effort='9' velocity='9'/></joint>
</robot>";

/// A run of the carriage at 250 Hz: `amplitudes` at 0.5 Hz, efforts of 2 N m RMS with noise of 0.02 N m.
fn carriage_run(amplitudes: [f64; 2]) -> (Robot, Run) {
    let robot = Robot::from_urdf(CARRIAGE).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let time: Vec<f64> = (0..2500).map(|i| 0.004 * f64::from(i)).collect();
    let mut joint = |name: &str, amplitude: f64| Channels {
        name: name.to_owned(),
        position: time.iter().map(|t| amplitude * (0.5 * TAU * t).sin()).collect(),
        effort: time
            .iter()
            .map(|t| 8.0_f64.sqrt() * (0.5 * TAU * t).sin() + random.random_range(-0.035..0.035))
            .collect(),
        ..Channels::default()
    };
    let joints = vec![joint("rise", amplitudes[0]), joint("swing", amplitudes[1])];
    (robot, whole_run("run", time, joints))
}

/// Averages and differences over 20 ms make a motion of 0.5 Hz, and twice of it, smaller by 1 in 300.
const SMOOTHED: f64 = 0.005;

#[test]
fn a_point_mass_takes_the_torque_of_a_pendulum() {
    let (mass, length, g) = (1.5, 0.4, 9.81);
    let (robot, run) = carriage_run([0.0, 1.2]);
    let body = PointMass { mass, com: [0.0, 0.0, -length] };
    let torque = point_mass_torque(&robot, &run, &body);
    let w = 0.5 * TAU;
    let mut largest: f64 = 0.0;
    for (t, found) in run.time.iter().zip(&torque[1]).skip(5).take(2490) {
        let q = 1.2 * (w * t).sin();
        let qdd = -w * w * q;
        let expected = mass * g * length * q.sin() + mass * length * length * qdd;
        assert!((found - expected).abs() < SMOOTHED * mass * g * length, "{t} {found} {expected}");
        largest = largest.max(expected.abs());
    }
    assert!(largest > 2.0, "{largest}");
}

#[test]
fn a_point_mass_on_a_lift_takes_its_weight_and_inertia() {
    let (mass, g, w) = (2.0, 9.81, 0.5 * TAU);
    let (robot, run) = carriage_run([0.7, 0.0]);
    let body = PointMass { mass, com: [0.1, 0.0, 0.0] };
    let [rise, swing] = point_mass_torque(&robot, &run, &body).try_into().unwrap();
    for (i, t) in run.time.iter().enumerate().skip(5).take(2490) {
        let force = mass * (g - w * w * 0.7 * (w * t).sin());
        assert!((rise[i] - force).abs() < SMOOTHED * mass * g, "{} {force}", rise[i]);
        assert!((swing[i] + 0.1 * force).abs() < SMOOTHED * mass * g, "{} {force}", swing[i]);
    }
}

#[test]
fn a_large_transplant_is_visible_and_a_tiny_one_is_not() {
    let (robot, run) = carriage_run([0.0, 1.2]);
    let strength = |law| Transplant { law, joint: 1 }.strength(&robot, std::slice::from_ref(&run));
    let large = [
        AddedLaw::Coulomb { level: 0.5 },
        AddedLaw::Offset { offset: -0.5 },
        AddedLaw::Viscous { viscous: 0.5 },
        AddedLaw::Load { coefficient: 0.3 },
        AddedLaw::Ripple { amplitude: 0.3, periods: 40.0, phase: 1.0 },
        AddedLaw::Well { peak: 1.0, centre: 0.3, width: 0.1 },
        AddedLaw::Drag { coefficient: 0.2 },
    ];
    for law in large {
        let found = strength(law);
        println!("{law:?} {found:?}");
        assert!(found.visible(), "{law:?} {found:?}");
    }
    let tiny = [
        AddedLaw::Coulomb { level: 0.002 },
        AddedLaw::Offset { offset: 0.002 },
        AddedLaw::Ripple { amplitude: 0.002, periods: 40.0, phase: 1.0 },
        AddedLaw::Well { peak: 0.002, centre: 0.3, width: 0.1 },
    ];
    for law in tiny {
        let found = strength(law);
        assert!(!found.visible(), "{law:?} {found:?}");
    }
}

/// What stands for `sin(wt)` up to sign is no new thing beside `qdd` of the same joint; a share that is left
/// comes from the run's ends.
#[test]
fn a_transplant_that_everyday_columns_make_up_is_not_visible_however_large() {
    let (robot, run) = carriage_run([0.0, 1.2]);
    let spring = Transplant { law: AddedLaw::Spring { stiffness: 1.0, rest: 0.4 }, joint: 1 };
    let found = spring.strength(&robot, std::slice::from_ref(&run));
    assert!(found.torque > 0.3 && found.share < 0.02 && !found.visible(), "{found:?}");
}

#[test]
fn the_share_and_weight_of_an_offset_are_its_size_over_the_effort() {
    let (robot, run) = carriage_run([0.0, 1.2]);
    let offset = Transplant { law: AddedLaw::Offset { offset: 1.0 }, joint: 1 };
    let found = offset.strength(&robot, std::slice::from_ref(&run));
    let with = rms(run.joints[1].effort.iter().map(|e| e + 1.0).collect::<Vec<_>>().iter());
    assert!((found.torque - 1.0 / with).abs() < 1e-9, "{found:?}");
    assert!((found.share / found.torque - 1.0).abs() < 0.05, "{found:?}");
    let noise = 0.035 / 3.0_f64.sqrt();
    let expected = (2500.0_f64 / 5.0).sqrt() / noise;
    assert!((found.sigmas / expected - 1.0).abs() < 0.15, "{} {expected}", found.sigmas);
}

#[test]
fn a_late_effort_is_that_of_before() {
    let (robot, mut run) = carriage_run([0.3, 1.2]);
    let before = run.clone();
    Transplant { law: AddedLaw::Late { skew: 0.010 }, joint: 0 }.add(&robot, &mut run);
    for (with, plain) in run.joints.iter().zip(&before.joints) {
        let halfway = |i: usize| 0.5 * (plain.effort[i - 3] + plain.effort[i - 2]);
        let worst = (3..2500).map(|i| (with.effort[i] - halfway(i)).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-9, "{worst}");
        assert!((with.effort[0] - plain.effort[0]).abs() < 1e-12);
    }
}

#[test]
fn a_magnet_pulls_most_a_width_from_its_middle_and_drag_grows_with_the_square_of_speed() {
    let (robot, run) = carriage_run([0.0, 1.2]);
    let at = |law: AddedLaw| law.torque(&robot, &run, 1);
    let [rise, well] =
        at(AddedLaw::Well { peak: 2.0, centre: 0.3, width: 0.1 }).try_into().unwrap();
    assert!(rise.iter().all(|torque| torque.abs() < 1e-12));
    let largest = well.iter().copied().fold(0.0, f64::max);
    assert!((largest - 2.0).abs() < 0.02, "{largest}");
    for (q, torque) in run.joints[1].position.iter().zip(&well) {
        let x = (q - 0.3) / 0.1;
        assert!(x * torque >= 0.0 && (x.abs() < 6.0 || torque.abs() < 1e-5), "{q} {torque}");
        if (x.abs() - 1.0).abs() < 0.05 {
            assert!((torque.abs() - 2.0).abs() < 0.02, "{q} {torque}");
        }
    }
    let drag = &at(AddedLaw::Drag { coefficient: 0.5 })[1];
    let w = 0.5 * TAU;
    for (t, torque) in run.time.iter().zip(drag).skip(5).take(2490) {
        let qd = 1.2 * w * (w * t).cos();
        assert!((torque - 0.5 * qd * qd.abs()).abs() < 0.05, "{torque} {qd}");
    }
}
