//! Motions one after the other.

use checks::synthetic::wam;
use motion::Motion;

use crate::support::{build, sinusoids};

/// The largest step of any signal over twice `step_s` at times a step apart.
fn largest_jump(motion: &Motion, step_s: f64) -> [f64; 3] {
    let count = (motion.duration_s() / step_s) as usize + 2;
    let mut largest = [0.0; 3];
    let mut before = motion.at(-step_s);
    for k in 0..count {
        let now = motion.at(step_s * k as f64);
        let pairs = [(&before.q, &now.q), (&before.qd, &now.qd), (&before.qdd, &now.qdd)];
        for (largest, (x, y)) in largest.iter_mut().zip(pairs) {
            let jump = x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            *largest = f64::max(*largest, jump);
        }
        before = now;
    }
    largest
}

#[test]
fn position_velocity_and_acceleration_are_continuous_where_motions_join() {
    // Without fades the two motions meet at speed.
    let part = |seed: u64| {
        let table = sinusoids(seed).replace("[sinusoids]", "[[sequence]]\n[sequence.sinusoids]");
        table.replace("20.0", "4.0") + "fade_s = 0.0\nvelocity_share = 0.3\n"
    };
    let whole = "[[sequence]]\nhold = { duration_s = 1.0 }\n".to_owned()
        + &part(1)
        + &part(2)
        + "[[sequence]]\nsequence = [{ hold = { duration_s = 0.5 } }]\n";
    let motion = build(&wam(), &whole).unwrap();
    let (coarse, fine) = (largest_jump(&motion, 1e-3), largest_jump(&motion, 1e-4));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(fine < 0.11 * coarse, "a jump stays: {coarse:e} {fine:e}");
    }
}

#[test]
fn a_motion_that_begins_where_the_last_one_ends_follows_at_once() {
    let toml = "[[sequence]]\nhold = { duration_s = 1.0 }\n[[sequence]]\nramp = { \
                to_rad = { j1_base_yaw = 0.5 }, duration_s = 2.0 }\n";
    let motion = build(&wam(), toml).unwrap();
    assert!((motion.duration_s() - 3.0).abs() < 1e-12);
}

#[test]
fn a_move_between_two_motions_takes_half_the_speed_of_the_slowest_joint() {
    let hold = |q: f64| {
        format!("{{ hold = {{ posture_rad = {{ j1_base_yaw = {q} }}, duration_s = 1.0 }} }}")
    };
    let motion = build(&wam(), &format!("sequence = [{}, {}]", hold(-2.0), hold(2.0))).unwrap();
    // 10 u^3 - 15 u^4 + 6 u^5 over 4 rad peaks at 15/8 of 4 rad in its time: at 1.25 rad/s.
    assert!((motion.duration_s() - (2.0 + 1.875 * 4.0 / 1.25)).abs() < 1e-12);
    assert!((motion.at(4.0).qd[0] - 1.25).abs() < 1e-12);
}

#[test]
fn a_sweep_passes_its_range_at_each_of_its_speeds_and_rests_where_it_turns() {
    let toml = "[sweep]\nspeeds_rad_per_s = [0.25, 1.0]\njoints = [\"j1_base_yaw\"]\n\
                range_rad = { j1_base_yaw = [-1.0, 1.0] }\ndwell_s = 0.5\n";
    let motion = build(&wam(), toml).unwrap();
    let (mut at, mut rest, mut fastest) = ([0.0; 2], 0.0, 0.0_f64);
    let step = 1e-3;
    for k in 0..=(motion.duration_s() / step) as usize {
        let state = motion.at(step * k as f64);
        let (q, qd) = (state.q[0], state.qd[0]);
        at[0] += if (qd.abs() - 0.25).abs() < 1e-9 { step } else { 0.0 };
        at[1] += if (qd.abs() - 1.0).abs() < 1e-9 { step } else { 0.0 };
        rest += if qd.abs() < 1e-12 && q.abs() > 0.999_999 { step } else { 0.0 };
        fastest = fastest.max(state.qdd[0].abs());
        assert!(state.qd[1..].iter().all(|qd| qd.abs() < 1e-12));
    }
    // Two strokes of 2 rad at each speed, less 1.5 v² / a of blends; five rests of 0.5 s.
    for (time, speed) in at.into_iter().zip([0.25, 1.0]) {
        let expected = 2.0 * (2.0 - 0.75 * speed * speed) / speed;
        assert!((time - expected).abs() < 0.02, "{time} s beside {expected} s at {speed}");
    }
    assert!((rest - 2.5).abs() < 0.1, "{rest}");
    assert!((fastest - 2.0).abs() < 1e-3, "{fastest}");
}

#[test]
fn waypoints_are_passed_at_their_times() {
    for via in ["pass", "stop"] {
        let toml = format!(
            "[waypoints]\ntimes_s = [0.0, 1.0, 3.0, 4.5]\nvia = \"{via}\"\n\
            positions_rad = {{ j1_base_yaw = [0.1, 0.8, -0.4, 0.0] }}\n"
        );
        let motion = build(&wam(), &toml).unwrap();
        for (t, q) in [(0.0, 0.1), (1.0, 0.8), (3.0, -0.4), (4.5, 0.0)] {
            let state = motion.at(t);
            assert!((state.q[0] - q).abs() < 1e-12, "{via} {t}");
            let rests = state.qd[0].abs() < 1e-12;
            assert!(
                rests == (via == "stop" || !(0.5..4.0).contains(&t)),
                "{via} {t} {}",
                state.qd[0]
            );
        }
    }
}
