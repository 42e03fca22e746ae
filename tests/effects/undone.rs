//! The compensation against the truth side: links that follow although everything gives way.

use checks::arms::wam;
use effects::{Compensation, FeedforwardEfforts};
use robot::{Actuator, FrictionWave, Machine, Reading, Ripple, Robot, SensingSide, Stribeck};
use simulator::{
    EffortSource, JointSensor, PositionSide, Sensors, Simulator, StepOrder, Stepping,
    VelocitySource,
};

const PERIOD_S: f64 = 0.002;
const STEPPING: Stepping =
    Stepping { step_s: 1e-4, steps_per_period: 20, stops: false, order: StepOrder::First };

/// A WAM whose drives rub, give way and are late.
fn worn() -> Robot {
    let mut robot = wam();
    let coulomb = [1.6, 0.5, 0.4, 0.6, 0.04, 0.07, 0.012];
    for (j, level) in coulomb.into_iter().enumerate() {
        let a = &mut robot.link_mut(j).unwrap().actuator;
        (a.coulomb_forward, a.coulomb_backward, a.viscous) = (level, level, level);
        (a.delay_s, a.sensing) = (0.004, SensingSide::Motor);
    }
    let a = &mut robot.link_mut(1).unwrap().actuator;
    (a.elasticity, a.backlash) = (Some(4000.0), 0.001);
    let a = &mut robot.link_mut(3).unwrap().actuator;
    (a.elasticity, a.backlash) = (Some(1500.0), 0.002);
    robot
}

/// The same with all else that a drive can say, at joints that give way and at joints that do not.
fn worn_out() -> Robot {
    let mut robot = worn();
    for (j, level) in [(0, 1.6), (1, 0.5), (3, 0.6)] {
        let a = &mut robot.link_mut(j).unwrap().actuator;
        a.stribeck = Some(Stribeck { excess: 0.5 * level, velocity: 0.2 });
        a.load_friction = 0.1;
        a.friction_wave = Some(FrictionWave { share: 0.4, periods: 5.0, phase: 1.0 });
        a.ripple = Some(Ripple { amplitude: 0.3 * level, periods: 12.0, phase: 0.5 });
        a.lag_s = 0.012;
        (a.encoder_offset, a.transmission_ratio) = (0.02, 1.02);
    }
    robot
}

/// Every joint swings from rest at a rate of its own: `q = A (1 - cos(w t))`, about a pose in
/// which gravity keeps elbow and shoulder loaded.
fn motion(time_s: f64) -> [Vec<f64>; 3] {
    let rest = [0.0, 0.5, 0.0, 1.3, 0.0, -0.3, 0.0];
    let at = |(j, rest): (usize, f64)| {
        let (omega, amplitude) = (2.0 + 0.3 * j as f64, 0.2);
        let (sin, cos) = (omega * time_s).sin_cos();
        [rest + amplitude * (1.0 - cos), amplitude * omega * sin, amplitude * omega * omega * cos]
    };
    let joints: Vec<[f64; 3]> = rest.into_iter().enumerate().map(at).collect();
    [0, 1, 2].map(|i| joints.iter().map(|state| state[i]).collect())
}

fn asked(compensation: &Compensation, time_s: f64) -> FeedforwardEfforts {
    let h = Compensation::SPACING_S;
    let states = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| motion(time_s + k * h));
    let states: Vec<[&[f64]; 3]> =
        states.iter().map(|s| [0, 1, 2].map(|i| s[i].as_slice())).collect();
    let needed = compensation.state_count();
    let mut out = FeedforwardEfforts::zero(7);
    let first = (Compensation::MOST_STATES - needed) / 2;
    compensation.fill(&mut compensation.workspace(), &states[first..first + needed], &mut out);
    out
}

/// Error of the links (rad), RMS from 1 s on, when an arm is asked for what undoes `known`.
fn link_error(arm: &Robot, known: &Robot) -> Vec<f64> {
    let compensation = Compensation::new(known, vec![0.02; 7]);
    let sensors = Sensors::new(
        PositionSide::Motor,
        EffortSource::Commanded,
        VelocitySource::Ideal,
        vec![JointSensor { resolution: 0.0, position_noise: 0.0, effort_noise: 0.0 }; 7],
        0,
    );
    let mut arm = Simulator::new(arm, Vec::new(), sensors, STEPPING).unwrap();
    arm.start(&motion(0.0)[0]);
    let (kp, kd) =
        ([20.0, 30.0, 10.0, 10.0, 1.0, 1.0, 0.25], [2.2, 4.7, 1.6, 0.8, 0.1, 0.1, 0.016]);
    let (mut reading, mut squares, mut count) = (Reading::zero(7), [0.0; 7], 0.0);
    for tick in 0..3000 {
        let t = PERIOD_S * f64::from(tick);
        arm.read(&mut reading).unwrap();
        // A command is held for a period: on the mean it is half of one late.
        let tau = asked(&compensation, t + 0.5 * PERIOD_S + compensation.delay_s()[0]).tau;
        let lead = asked(&compensation, t);
        let [q, qd, _] = motion(t);
        let effort: Vec<f64> = (0..7)
            .map(|j| {
                let error = q[j] + lead.q_lead[j] - reading.q[j];
                let error_rate = qd[j] + lead.qd_lead[j] - reading.qd[j];
                tau[j] + kp[j] * error + kd[j] * error_rate
            })
            .collect();
        if t > 1.0 {
            count += 1.0;
            for j in 0..7 {
                squares[j] += (arm.q_true()[j] - q[j]).powi(2);
            }
        }
        arm.actuate(&effort).unwrap();
    }
    squares.map(|s| f64::sqrt(s / count)).to_vec()
}

#[test]
fn oracle_links_of_a_worn_arm_follow_at_low_gains_when_what_is_worn_is_known() {
    let known = link_error(&worn(), &worn());
    let unknown = link_error(&worn(), &wam());
    let rigid = {
        let mut robot = worn();
        for j in [1, 3] {
            let a = &mut robot.link_mut(j).unwrap().actuator;
            (a.elasticity, a.backlash) = (None, 0.0);
        }
        link_error(&worn(), &robot)
    };
    println!("known {known:?}\nrigid {rigid:?}\nunknown {unknown:?}");
    for j in 0..7 {
        assert!(10.0 * known[j] < unknown[j], "joint {j}: {} and {} rad", known[j], unknown[j]);
    }
    for j in [1, 3] {
        assert!(2.0 * known[j] < rigid[j], "joint {j}: {} and {} rad", known[j], rigid[j]);
    }
}

/// Each key alone counts: without it the joints that have it follow less well.
#[test]
fn oracle_links_of_an_arm_with_all_that_a_drive_can_say_follow_when_it_is_said() {
    let worst = |errors: Vec<f64>| [0, 1, 3].map(|j| errors[j]).into_iter().fold(0.0, f64::max);
    let known = worst(link_error(&worn_out(), &worn_out()));
    type Silence = fn(&mut Actuator);
    let silent: [(&str, Silence); 7] = [
        ("stribeck_excess_nm", |a| a.stribeck = None),
        ("load_friction", |a| a.load_friction = 0.0),
        ("friction_wave", |a| a.friction_wave = None),
        ("torque_ripple", |a| a.ripple = None),
        ("actuator_lag_ms", |a| a.lag_s = 0.0),
        ("encoder_offset_rad", |a| a.encoder_offset = 0.0),
        ("transmission_ratio", |a| a.transmission_ratio = 1.0),
    ];
    println!("known {known}");
    for (key, silence) in silent {
        let mut robot = worn_out();
        for j in 0..7 {
            silence(&mut robot.link_mut(j).unwrap().actuator);
        }
        let without = worst(link_error(&worn_out(), &robot));
        println!("without {key} {without}");
        assert!(2.0 * known < without, "{key}: {known} rad, {without} rad without");
    }
}
