//! Parameters from the torques that Pinocchio computed for known bodies.

use checks::arms::wam;
use checks::golden::{Golden, State, golden};
use dynamics::{BaseParameters, ColumnSet, Dynamics};
use learner::{Regression, SampleSlices};
use robot::{Inertia, Robot};

const ROTOR: ColumnSet = ColumnSet { rotor: true, ..ColumnSet::INERTIAL };

/// The WAM described as heavier than it is, with its mass elsewhere.
fn mistaken(golden: &Golden) -> Robot {
    let mut robot = wam().with_gravity(golden.gravity.into());
    for (i, pi) in golden.inertial_parameters.iter().enumerate() {
        let link = robot.link_mut(i).unwrap();
        link.inertia = Inertia::from_parameters(pi);
        link.inertia.mass *= 1.3;
        link.inertia.com_in_link.x += 0.01;
        link.inertia.about_com *= 1.2;
        link.actuator.rotor_inertia *= 0.7;
    }
    robot
}

fn regression(robot: &Robot, states: &[State]) -> Regression {
    let flat = |signal: fn(&State) -> &Vec<f64>| -> Vec<f64> {
        states.iter().flat_map(signal).copied().collect()
    };
    let (q, qd, qdd) = (flat(|s| &s.q), flat(|s| &s.qd), flat(|s| &s.qdd));
    let tau = flat(|s| &s.tau_with_rotor);
    let mut regression = Regression::new(robot, ROTOR);
    regression.add(SampleSlices { q: &q, qd: &qd, qdd: &qdd, tau: &tau }).unwrap();
    regression
}

fn base_of(golden: &Golden, base: &BaseParameters) -> Vec<f64> {
    let bodies = golden.inertial_parameters.iter().flatten();
    let pi: Vec<f64> = bodies.chain(&golden.rotor_inertia).copied().collect();
    base.project(&pi).unwrap().iter().copied().collect()
}

#[test]
fn base_parameters_of_the_wam_come_back_from_pinocchio_s_torques() {
    let golden = golden("wam7");
    let fit = regression(&mistaken(&golden), &golden.states).fit(None).unwrap();
    assert_eq!((fit.rank, fit.undetermined.len()), (48, 0));
    let (found, _) = fit.base_parameters();
    for (i, expected) in base_of(&golden, &fit.base).into_iter().enumerate() {
        let name = fit.columns[fit.base.independent[i]];
        assert!((found[i] - expected).abs() < 1e-8, "{name}: {} and {expected}", found[i]);
    }
}

#[test]
fn torques_that_were_not_learned_from_are_those_of_pinocchio() {
    let golden = golden("wam7");
    let robot = mistaken(&golden);
    let (learned, asked) = golden.states.split_at(16);
    let fit = regression(&robot, learned).fit(None).unwrap();
    let width = fit.columns.len();
    let dynamics = Dynamics::new(&robot);
    let mut y = vec![0.0; 7 * width];
    for State { q, qd, qdd, tau_with_rotor, .. } in asked {
        dynamics.columns_into(&mut dynamics.workspace(), [q, qd, qdd], ROTOR, &mut y);
        for (row, expected) in y.chunks_exact(width).zip(tau_with_rotor) {
            let tau: f64 = row.iter().zip(&fit.parameters).map(|(y, p)| y * p).sum();
            assert!((tau - expected).abs() < 1e-6, "{tau} and {expected}");
        }
    }
}

#[test]
fn directions_that_four_states_leave_open_are_told() {
    let golden = golden("wam7");
    let fit = regression(&mistaken(&golden), &golden.states[..4]).fit(None).unwrap();
    assert_eq!(fit.rank + fit.undetermined.len(), 48);
    assert!(fit.rank <= 28, "{}", fit.rank);
    assert!(fit.parameters.iter().chain(&fit.standard_errors).all(|v| v.is_finite()));
}
