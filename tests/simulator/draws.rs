use catalogue::EffectKind;
use checks::arms::{generator, wam};
use simulator::effects::{EffectSpec, JointLevel, Surroundings};

const LEVELS: [JointLevel; 7] = [JointLevel { torque_rms: 5.0, speed_rms: 0.6 }; 7];

/// At every joint of the WAM, from a hundredth of the torque to more than all of it, and where a
/// joint did not move at all.
#[test]
fn whatever_is_drawn_can_be_put_in_and_is_drawn_again_from_the_same_seed() {
    let robot = wam();
    for joint in 0..robot.joint_count() {
        let moving = Surroundings {
            robot: &robot,
            joint,
            torque_rms: [12.0, 15.0, 5.0, 6.0, 0.3, 0.4, 0.05][joint],
            speed_rms: 0.6,
            acceleration_rms: 2.0,
            range: (-0.8, 1.1),
            torque_rate_rms: 20.0,
            inertia: [2.0, 2.0, 0.3, 0.2, 0.01, 0.01, 0.001][joint],
            joints: &LEVELS,
        };
        let still = Surroundings {
            speed_rms: 0.0,
            acceleration_rms: 0.0,
            range: (0.3, 0.3),
            torque_rate_rms: 0.0,
            ..moving
        };
        for (at, share) in [(moving, 0.01), (moving, 0.2), (moving, 3.0), (still, 0.1)] {
            for kind in EffectKind::ALL {
                let draw = || EffectSpec::draw(kind, &at, share, &mut generator(7));
                let effect = draw();
                assert_eq!(effect.kind(), kind);
                assert_eq!(effect, draw(), "{kind}");
                let refused = effect.inject(&robot).err();
                assert_eq!(refused, None, "{effect:?} at joint {joint}, share {share}");
                let named = effect.truth();
                for parameter in kind.entry().parameters {
                    let exists = named.parameters.contains_key(parameter.name);
                    let pushed = kind == EffectKind::ExternalDisturbance;
                    // What a share of the friction is in torque, the rest of the arm decides.
                    let of_a_share = parameter.name.ends_with("_lost");
                    assert!(exists || pushed || of_a_share, "{kind} without {}", parameter.name);
                }
            }
        }
    }
}
