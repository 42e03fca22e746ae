//! Superpositions of sinusoids: repeatable, different by seed, within their share.

use checks::synthetic::wam;
use motion::Motion;

use crate::support::{build, gantry, sinusoids};

fn sampled(motion: &Motion) -> impl Iterator<Item = motion::State> {
    (0..=20_000).map(|k| motion.at(motion.duration_s() * f64::from(k) / 20_000.0))
}

#[test]
fn the_same_seed_gives_the_same_motion_to_the_last_bit_and_another_seed_another() {
    let wam = wam();
    let motion = |seed| build(&wam, &sinusoids(seed)).unwrap();
    let [first, again, other] = [1, 1, 2].map(motion);
    let bits = |m: &Motion, t: f64| m.at(t).q.iter().map(|q| q.to_bits()).collect::<Vec<_>>();
    for t in [0.0, 3.3, 17.1] {
        assert_eq!(bits(&first, t), bits(&again, t));
    }
    let far = sampled(&first).zip(sampled(&other)).map(|(a, b)| (a.q[0] - b.q[0]).abs());
    assert!(far.fold(0.0, f64::max) > 0.5, "the motions are alike");
}

#[test]
fn every_joint_uses_its_share_of_position_or_of_velocity_and_no_more() {
    let wam = wam();
    for seed in 0..10 {
        for share in [0.3, 0.8, 1.0] {
            let toml =
                format!("{}position_share = {share}\nvelocity_share = 0.6\n", sinusoids(seed));
            let motion = build(&wam, &toml).unwrap();
            for (j, link) in wam.links().iter().enumerate() {
                let (low, high) = link.joint.limits.position.unwrap();
                let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
                let far = sampled(&motion).map(|s| (s.q[j] - middle).abs() / half);
                let far = far.fold(0.0, f64::max) / share;
                let fast = sampled(&motion).map(|s| s.qd[j].abs() / 2.5);
                let fast = fast.fold(0.0, f64::max) / 0.6;
                assert!(far <= 1.0 + 1e-9 && fast <= 1.0 + 1e-9, "{far} {fast}");
                // A peak within a fade is passed slowly, so a motion may stay a little below.
                assert!(far.max(fast) > 0.6, "seed {seed} joint {j}: {far} {fast}");
            }
        }
    }
}

#[test]
fn a_given_amplitude_is_reached_about_a_given_centre() {
    let toml = sinusoids(5)
        + "amplitude_rad = { wheel = 2.5, slide = 0.0 }\ncentre_rad = { wheel = -4.0, slide = 0.3 }";
    let motion = build(&gantry(), &toml).unwrap();
    let far = |j: usize, centre: f64| {
        sampled(&motion).map(|s| (s.q[j] - centre).abs()).fold(0.0, f64::max)
    };
    assert!(far(0, 0.3) < 1e-15);
    assert!((far(1, -4.0) - 2.5).abs() < 1e-5, "{}", far(1, -4.0));
}
