//! Friction of motors that two joints share.

use checks::synthetic::Noise;
use logs::Run;

use crate::world::{World, against_nominal, named, sign};

/// The joints that share motors: wrist yaw and wrist pitch.
const SHARE: [usize; 2] = [4, 5];

const NAME: &str = "TR03 differential coupling at j5_wrist_yaw";

/// Logs of a WAM, with friction (N m) of two motors that turn with the sum and the difference of two joints.
fn logs(levels: [f64; 2], seed: u64) -> Vec<Run> {
    let mut runs = World::nominal().runs(3, 20.0, &Noise::of_a_wam(), seed);
    for run in &mut runs {
        let speed = SHARE.map(|j| run.joints[j].velocity.clone().unwrap());
        for (t, (a, b)) in speed[0].iter().zip(&speed[1]).enumerate() {
            let [sum, difference] = [levels[0] * sign(a + b), levels[1] * sign(a - b)];
            run.joints[SHARE[0]].effort[t] += sum + difference;
            run.joints[SHARE[1]].effort[t] += sum - difference;
        }
    }
    runs
}

/// The effects that are named with `level` (N m) at the motor that turns with the sum, and a third of it at the other.
fn names(level: f64, seed: u64) -> Vec<String> {
    let names = named(&against_nominal(&logs([level, 0.3 * level], seed)).diagnosis);
    println!("{level} N m: {names:?}");
    names
}

#[test]
fn shared_motors_are_named_where_the_logs_leave_no_doubt() {
    for seed in [7, 8, 9] {
        assert!(names(0.005, seed).contains(&NAME.to_owned()));
    }
}

/// Few arms have them, so that as much evidence as another cause needs is too little.
#[test]
fn shared_motors_have_no_name_where_friction_of_each_joint_is_almost_as_good() {
    for seed in [7, 8, 9] {
        let names = names(0.001, seed);
        assert!(!names.is_empty() && !names.contains(&NAME.to_owned()), "{names:?}");
    }
}
