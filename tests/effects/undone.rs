//! The compensation against the truth side: links that follow although everything gives way.

use checks::arms::wam;
use effects::{Compensated, Compensation};
use robot::{Machine, Reading, Robot, SensingSide};
use simulator::{Sensors, Simulator, Stepping};

const PERIOD_S: f64 = 0.002;
const STEPPING: Stepping = Stepping { step_s: 1e-4, steps_per_period: 20, stops: false };

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

fn asked(compensation: &Compensation, time_s: f64) -> Compensated {
    let h = Compensation::SPACING_S;
    let states = [time_s - h, time_s, time_s + h].map(motion);
    let states: Vec<[&[f64]; 3]> =
        states.iter().map(|s| [0, 1, 2].map(|i| s[i].as_slice())).collect();
    let needed = compensation.states_needed();
    let mut out = Compensated::zero(7);
    let first = (3 - needed) / 2;
    compensation.fill(&mut compensation.workspace(), &states[first..first + needed], &mut out);
    out
}

/// Error of the links (rad), RMS from 1 s on, when the worn arm is asked for what undoes `known`.
fn link_error(known: &Robot) -> Vec<f64> {
    let compensation = Compensation::new(known, vec![0.02; 7]);
    let mut arm = Simulator::new(&worn(), Vec::new(), Sensors::perfect(7), STEPPING).unwrap();
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
                let error = q[j] + lead.q_lead[j] - arm.motor_q_true()[j];
                let error_rate = qd[j] + lead.qd_lead[j] - arm.motor_qd_true()[j];
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
    let known = link_error(&worn());
    let unknown = link_error(&wam());
    let rigid = {
        let mut robot = worn();
        for j in [1, 3] {
            let a = &mut robot.link_mut(j).unwrap().actuator;
            (a.elasticity, a.backlash) = (None, 0.0);
        }
        link_error(&robot)
    };
    println!("known {known:?}\nrigid {rigid:?}\nunknown {unknown:?}");
    for j in 0..7 {
        assert!(10.0 * known[j] < unknown[j], "joint {j}: {} and {} rad", known[j], unknown[j]);
    }
    for j in [1, 3] {
        assert!(2.0 * known[j] < rigid[j], "joint {j}: {} and {} rad", known[j], rigid[j]);
    }
}
