//! The two halves of the model side: what explains an effect in a log is what the extended
//! robot adds.
#![allow(clippy::unwrap_used, reason = "a broken fixture should stop the test")]

mod described;
mod every_kind;
mod turning;
mod undone;

use catalogue::EffectKind;
use checks::synthetic::wam;
use effects::{
    ColumnPart, Compensation, EffectColumn, Encoders, FeedforwardEfforts, Frame, Hypothesis, Place,
    Priors, RunMotion, Scale, hypotheses, model,
};
use logs::GoalEffort;
use robot::{Coupling, FrictionWave, PdGain, Robot, Stribeck, TorqueSource, Warming};

const SAMPLES: usize = 40;

/// Effects of which a robot without them can only have more.
const STARTS_AT_ZERO: [EffectKind; 4] = [
    EffectKind::Backlash,
    EffectKind::JointElasticity,
    EffectKind::ActuatorLag,
    EffectKind::PreslidingFriction,
];

/// Effects that move efforts in time, between samples by pieces of cubics.
const TIMES: [EffectKind; 3] =
    [EffectKind::TimeSkew, EffectKind::ActuatorDelay, EffectKind::GoalDelay];

/// Described delay of the goals (s).
const GOAL_DELAY_S: f64 = 0.01;

/// Step of the central difference, in standard deviations of the prior: the truncation is
/// second order, the rounding 1e-16 over it.
const STEP: f64 = 1e-4;

/// Largest difference, as a share of the largest value of the column.
const TOLERANCE: f64 = 1e-6;

/// Rounding of an effort (N m).
const ROUNDING: f64 = 1e-13;

/// A WAM whose drives have a bit of everything.
fn worn() -> Robot {
    let mut robot = wam();
    for j in 0..robot.joint_count() {
        let a = &mut robot.link_mut(j).unwrap().actuator;
        (a.viscous, a.coulomb_forward, a.coulomb_backward) = (0.5, 0.4, 0.3);
        (a.spring_stiffness, a.spring_rest) = (0.2, 0.1);
        (a.spring_cubic, a.spring_hysteresis) = (0.15, 0.02);
        (a.torque_gain, a.torque_offset) = (1.1, 0.05);
        (a.delay_s, a.effort_skew_s) = (0.003, 0.003);
        (a.encoder_offset, a.transmission_ratio) = (0.02, 1.05);
        a.load_friction = 0.1;
        (a.position_loop, a.goal_delay_s) = (Some(PdGain { kp: 3.0, kd: 0.1 }), GOAL_DELAY_S);
        a.torque_source = TorqueSource::Commanded;
    }
    robot
}

/// The same with friction of every shape, of `size` or only as trial shapes of it.
fn shaped(size: f64) -> Robot {
    let mut robot = worn();
    for j in 0..robot.joint_count() {
        let a = &mut robot.link_mut(j).unwrap().actuator;
        a.stribeck = Some(Stribeck { excess: 0.3 * size, velocity: 0.2 });
        a.friction_wave = Some(FrictionWave { share: 0.4 * size, periods: 5.0, phase: 0.3 });
        let [viscous_lost, coulomb_lost] = [0.2 * size, 0.1 * size];
        a.warming = Some(Warming { viscous_lost, coulomb_lost, time_constant_s: 3.0 });
        let [level, viscous] = [[0.2, 0.1], [0.05, 0.1]].map(|of| of.map(|v| size * v));
        a.coupling = Some(Coupling { other: (j + 1) % 7, ratio: 0.8, level, viscous });
    }
    robot
}

/// The same with friction that builds up over a way, damped.
fn bristly() -> Robot {
    let mut robot = worn();
    for j in 0..robot.joint_count() {
        let a = &mut robot.link_mut(j).unwrap().actuator;
        (a.coulomb_forward, a.coulomb_backward, a.load_friction) = (0.35, 0.35, 0.0);
        (a.presliding, a.presliding_damping) = (Some(0.4), Some(0.3));
    }
    robot
}

/// The WAM of [`worn`] with a spring at joint `j`.
fn springy(j: usize) -> Robot {
    let mut robot = worn();
    robot.link_mut(j).unwrap().actuator.elasticity = Some(30_000.0);
    robot
}

fn frame(robot: &Robot) -> Frame {
    let n = robot.joint_count();
    let centre = (0..n).map(|j| 0.1 * j as f64).collect();
    Frame {
        rest_speed: vec![0.01; n],
        centre,
        reach: vec![1.0; n],
        resolution: vec![0.0; n],
        trial_gaps: vec![0.0; n],
        trial_springs: vec![None; n],
        trial_lateness_s: 0.0,
    }
}

fn scale(robot: &Robot) -> Scale {
    let same = |value: f64| vec![value; robot.joint_count()];
    Scale {
        effort: same(2.0),
        speed: same(1.0),
        acceleration: same(3.0),
        range: same(2.0),
        session_s: 1000.0,
        link_mass: 2.0,
        link_length: 0.2,
    }
}

/// Position, velocity and acceleration as reported.
fn state(robot: &Robot) -> [Vec<Vec<f64>>; 3] {
    let signal = |amplitude: f64, phase: f64| -> Vec<Vec<f64>> {
        let at = |j: usize, t: usize| {
            amplitude * (0.37 * (t as f64) * (1.0 + 0.1 * j as f64) + phase + j as f64).sin()
        };
        (0..robot.joint_count()).map(|j| (0..SAMPLES).map(|t| at(j, t)).collect()).collect()
    };
    [signal(0.8, 0.0), signal(1.0, 1.3), signal(2.0, 0.7)]
}

/// The parts of efforts that follow goals, computed with the described delay.
fn goal_efforts(robot: &Robot) -> Vec<Option<GoalEffort>> {
    let goal = |q: &Vec<f64>| {
        let values = q.iter().map(|q| 3.0 * (1.2 * q).sin()).collect();
        Some(GoalEffort { values, lead: 0, delay_s: GOAL_DELAY_S })
    };
    state(robot)[0].iter().map(goal).collect()
}

fn motion(robot: &Robot) -> RunMotion {
    let (reported, links) = (state(robot), vec![None; robot.joint_count()]);
    let goal_efforts = goal_efforts(robot);
    let encoders = Encoders { reported, links, goal_efforts, since_cold_s: 0.0 };
    RunMotion::from_encoders(robot, &frame(robot), encoders, 0.05)
}

/// The same motion, with encoders at the links that do not quite say the same.
fn seen(robot: &Robot) -> RunMotion {
    let reported = state(robot);
    let link = |j: usize| {
        let [q, qd, qdd] = reported.each_ref().map(|x| &x[j]);
        let scaled = |x: &Vec<f64>| x.iter().map(|x| 0.97 * x).collect::<Vec<f64>>();
        Some([q.iter().map(|q| 0.97 * q + 0.01).collect(), scaled(qd), scaled(qdd)])
    };
    let links = (0..robot.joint_count()).map(link).collect();
    let goal_efforts = goal_efforts(robot);
    RunMotion::from_encoders(
        robot,
        &frame(robot),
        Encoders { reported, links, goal_efforts, since_cold_s: 0.0 },
        0.05,
    )
}

/// The WAM of [`worn`] with transmissions that give.
fn soft() -> Robot {
    let mut robot = worn();
    for j in 0..robot.joint_count() {
        let drive = &mut robot.link_mut(j).unwrap().actuator;
        (drive.elasticity, drive.backlash) = (Some(300.0), 0.01);
    }
    robot
}

#[test]
fn contract_twists_are_the_derivative_of_what_the_extended_robot_has_between_two_encoders() {
    let robot = soft();
    let nominal = seen(&robot);
    let mut looked_at = 0;
    for h in hypotheses(&robot) {
        let columns = h.twist(&nominal);
        let Some(j) = h.before_the_link() else {
            assert!(columns.is_empty(), "{h:?}");
            continue;
        };
        // The shape of a gap is compared over a tenth of it, as its column is.
        let step = match h.kind {
            EffectKind::Backlash => 0.1 * robot.links()[j].actuator.backlash,
            _ => 1e-4 * h.prior(&robot, &scale(&robot), &Priors::default())[0],
        };
        let twist = |sign: f64| {
            let mut changed = robot.clone();
            h.extend(&mut changed, &[sign * step], &frame(&robot), &Priors::default());
            seen(&changed).twist(j)
        };
        let (up, down) = (twist(1.0), twist(-1.0));
        let [part] = columns[0].as_slice() else { unreachable!("{h:?} is of one joint") };
        assert_eq!((columns.len(), part.joint), (1, j));
        let largest = part.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        assert!(largest > 0.0, "{h:?}");
        for (t, value) in part.values.iter().enumerate() {
            let slope = (up[t] - down[t]) / (2.0 * step);
            assert!((value - slope).abs() < 1e-5 * largest, "{h:?} at {t}: {value}, not {slope}");
        }
        looked_at += 1;
    }
    assert_eq!(looked_at, 4 * robot.joint_count());
}

/// Where both sides of a transmission are measured, the effort needs no word of what is between.
#[test]
fn contract_twist_and_play_change_no_effort_where_both_sides_are_measured() {
    assert_eq!(seen(&worn()).effort, seen(&soft()).effort);
    assert_ne!(motion(&worn()).effort, motion(&soft()).effort);
}

/// `d effort / d weight` of one weight by a central difference through the extended robot.
fn derivative(robot: &Robot, h: Hypothesis, weight: usize, step: f64) -> Vec<Vec<f64>> {
    let count = h.prior(robot, &scale(robot), &Priors::default()).len();
    let effort = |sign: f64| {
        let mut weights = vec![0.0; count];
        weights[weight] = sign * step;
        let mut changed = robot.clone();
        h.extend(&mut changed, &weights, &frame(robot), &Priors::default());
        motion(&changed).effort
    };
    let (up, down) = (effort(1.0), effort(-1.0));
    let slope = |(u, d): (&Vec<f64>, &Vec<f64>)| {
        u.iter().zip(d).map(|(u, d)| (u - d) / (2.0 * step)).collect()
    };
    up.iter().zip(&down).map(slope).collect()
}

#[test]
fn contract_columns_are_the_derivative_of_what_the_extended_robot_adds() {
    check_columns(&worn(), |h| !STARTS_AT_ZERO.contains(&h.kind));
    let frictions = [
        EffectKind::ViscousFriction,
        EffectKind::CoulombFriction,
        EffectKind::AsymmetricFriction,
        EffectKind::StribeckFriction,
        EffectKind::PositionDependentFriction,
        EffectKind::DifferentialCoupling,
    ];
    // Where friction varies with position, what moves a position moves it as well, to first order.
    for robot in [shaped(0.0), shaped(1.0)] {
        check_columns(&robot, |h| frictions.contains(&h.kind));
    }
    // No friction is gained: about a robot without a loss there is no other side.
    check_columns(&shaped(1.0), |h| h.kind == EffectKind::FrictionTemperatureDrift);
    check_columns(&bristly(), |h| h.kind == EffectKind::PreslidingFriction);
    for j in [0, 1, 3] {
        let of_spring = Hypothesis { kind: EffectKind::JointElasticity, place: Place::Joint(j) };
        check_columns(&springy(j), |h| h == of_spring);
    }
}

/// What is said to be exact has the same columns about a robot that has it, with all that is exact
/// besides; a tangent has others.
#[test]
fn exact_columns_stay_where_effects_grow_and_tangents_turn() {
    let grown = |robot: &mut Robot, h: Hypothesis| {
        let weights: Vec<f64> =
            h.prior(robot, &scale(robot), &Priors::default()).iter().map(|w| 0.1 * w).collect();
        h.extend(robot, &weights, &frame(robot), &Priors::default());
    };
    let mut before = worn();
    // Friction that grows with the load makes columns of all that loads.
    (0..7).for_each(|j| before.link_mut(j).unwrap().actuator.load_friction = 0.0);
    let mut exact = before.clone();
    let all = hypotheses(&before);
    all.iter().filter(|h| !h.is_tangent()).for_each(|h| grown(&mut exact, *h));
    let nominal = motion(&before);
    for h in all.into_iter().filter(|h| !h.is_imitable()) {
        let mut after = exact.clone();
        if h.is_tangent() {
            grown(&mut after, h);
        }
        let values = |columns: Vec<EffectColumn>| -> Vec<f64> {
            columns.into_iter().flatten().flat_map(|part| part.values).collect()
        };
        let [first, last] = [h.columns(&nominal), h.columns(&motion(&after))].map(values);
        let largest = first.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        let differs = first.iter().zip(&last).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let share = differs / largest;
        assert!(if h.is_tangent() { share > 1e-4 } else { share < 1e-9 }, "{h:?}: {share}");
    }
}

/// Friction that is gone before the direction of motion is known has neither height nor width in a
/// log, so its velocity stays above twice the speed of rest.
#[test]
fn the_velocity_of_stribeck_friction_stays_where_logs_show_it() {
    let (before, frame) = (shaped(1.0), frame(&worn()));
    let h = Hypothesis { kind: EffectKind::StribeckFriction, place: Place::Joint(2) };
    for (step, expected) in [(-0.19, 0.02), (-0.1, 0.1), (0.1, 0.3)] {
        let mut after = before.clone();
        h.extend(&mut after, &[0.05, step], &frame, &Priors::default());
        let stribeck = after.links()[2].actuator.stribeck.unwrap();
        assert!((stribeck.velocity - expected).abs() < 1e-12, "{stribeck:?}");
        assert!((stribeck.excess - 0.35).abs() < 1e-12, "{stribeck:?}");
    }
}

fn check_columns(robot: &Robot, looked_at: impl Fn(Hypothesis) -> bool) {
    let nominal = motion(robot);
    for h in hypotheses(robot).into_iter().filter(|h| looked_at(*h)) {
        let prior = h.prior(robot, &scale(robot), &Priors::default());
        let tolerance = match h.kind {
            kind if TIMES.contains(&kind) => 1e-3,
            // How a spring gives is known along the measured motion, not along the link's.
            EffectKind::JointElasticity => 0.003,
            _ => TOLERANCE,
        };
        for (weight, column) in h.columns(&nominal).iter().enumerate() {
            // The ratio of a coupling is compared over a fiftieth of itself, here as there: motors
            // turn back at moments that move with it.
            let is_ratio = h.kind == EffectKind::DifferentialCoupling && weight == 4;
            // A loop that grows slides later: a step must not reach the next sample.
            let is_loop = h.kind == EffectKind::CableSpring && weight == 2;
            // The way of bristles is compared over a tenth of itself, as its column is.
            let is_way = h.kind == EffectKind::PreslidingFriction && weight == 0;
            let step = match () {
                () if is_ratio => 0.02 * 0.8,
                () if is_loop => 1e-6,
                () if is_way => 0.1 * 0.4,
                () => STEP * prior[weight],
            };
            let slope = derivative(robot, h, weight, step);
            let largest = slope.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
            for (joint, slope) in slope.iter().enumerate() {
                let part = column.iter().find(|p| p.joint == joint);
                for (t, expected) in slope.iter().enumerate() {
                    let value = part.map_or(0.0, |p| p.values[t]);
                    assert!(
                        (value - expected).abs() <= tolerance * largest + ROUNDING / step,
                        "{h:?} weight {weight} joint {joint} sample {t}: {value} and {expected}"
                    );
                }
            }
        }
    }
}

/// Play and twist of a robot without them go one way only, and their columns are those of a
/// small change: a gap of 5 mrad, a twist of 1e-4 of what a newton metre is believed to do. So
/// is friction that builds up.
#[test]
fn contract_play_and_twist_add_what_their_columns_say() {
    // Friction that builds up takes the rest of dry friction along.
    let mut robot = worn();
    for j in 0..robot.joint_count() {
        let a = &mut robot.link_mut(j).unwrap().actuator;
        (a.coulomb_forward, a.coulomb_backward, a.load_friction) = (0.35, 0.35, 0.0);
    }
    let nominal = motion(&robot);
    let starting = hypotheses(&robot).into_iter().filter(|h| STARTS_AT_ZERO.contains(&h.kind));
    for h in starting {
        let small = match h.kind {
            EffectKind::Backlash => 0.005,
            // All of the friction, over the small way.
            EffectKind::PreslidingFriction => 0.35,
            _ => 1e-6,
        };
        let mut changed = robot.clone();
        h.extend(&mut changed, &[small], &frame(&robot), &Priors::default());
        let with = motion(&changed).effort;
        let columns = h.columns(&nominal);
        let added = |part: &ColumnPart, t: usize| {
            (with[part.joint][t] - nominal.effort[part.joint][t]) / small
        };
        let all = || columns[0].iter().flat_map(|p| (0..SAMPLES).map(move |t| (p, t)));
        let largest = all().fold(0.0_f64, |m, (p, t)| m.max(p.values[t].abs()));
        for (part, t) in all() {
            let (value, expected) = (part.values[t], added(part, t));
            assert!(
                (value - expected).abs() < 0.2 * largest,
                "{h:?} joint {}: {value} and {expected}",
                part.joint
            );
        }
    }
}

#[test]
fn no_change_is_no_change_and_bounds_hold_it() {
    for h in hypotheses(&shaped(1.0)) {
        let robot = shaped(1.0);
        let zero = vec![0.0; h.prior(&robot, &scale(&robot), &Priors::default()).len()];
        let mut same = robot.clone();
        h.extend(&mut same, &zero, &frame(&robot), &Priors::default());
        let difference = |(a, b): (&Vec<f64>, &Vec<f64>)| {
            a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()))
        };
        let (before, after) = (motion(&robot).effort, motion(&same).effort);
        assert!(before.iter().zip(&after).map(difference).fold(0.0, f64::max) < 1e-12, "{h:?}");
        for (low, high) in h.bounds(&robot, &Priors::default()) {
            assert!(low <= 0.0 && high >= 0.0, "{h:?}");
        }
    }
}

#[test]
fn parameters_carry_the_names_of_the_catalogue() {
    let robot = shaped(1.0);
    for h in hypotheses(&robot) {
        let names: Vec<_> = h.quantities(&robot, &robot).iter().map(|q| q.name).collect();
        let known: Vec<_> = model(h.kind).unwrap().parameters().iter().map(|p| p.name).collect();
        assert_eq!(names, known, "{h:?}");
    }
}

#[test]
fn the_compensation_allocates_nothing() {
    let mut robot = worn();
    for j in 0..robot.joint_count() {
        let a = &mut robot.link_mut(j).unwrap().actuator;
        (a.backlash, a.elasticity, a.lag_s) = (0.001, Some(1000.0), 0.001);
    }
    let n = robot.joint_count();
    let compensation = Compensation::new(&robot, vec![0.01; n]);
    let (mut ws, mut out) = (compensation.workspace(), FeedforwardEfforts::zero(n));
    let (q, qd, qdd) = (vec![0.3; n], vec![0.7; n], vec![-0.2; n]);
    let state: [&[f64]; 3] = [&q, &qd, &qdd];
    let counted = allocation_counter::measure(|| compensation.fill(&mut ws, &[state; 5], &mut out));
    assert_eq!(counted.count_total, 0);
    assert!(out.tau.iter().all(|tau| tau.abs() > 0.1));
}
