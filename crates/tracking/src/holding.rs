use dynamics::Dynamics;
use motion::Motion;
use nalgebra::DMatrix;
use robot::{PdGain, Robot};

/// Time between the positions of a motion that are looked at (s).
const SPACING_S: f64 = 0.1;

/// Step of the differences of gravity (rad or m): off by `h² / 6` of a torque that turns with a
/// joint.
const STEP: f64 = 1e-4;

/// Whether the feedback can hold a robot against gravity wherever a motion passes:
///
/// ```text
/// diag(kp) + dg/dq(q_ref(t)) positive definite
/// ```
///
/// A feedforward does not depend on the position of the arm. Where the weight pulls the arm away
/// from the reference by more than `kp` pulls it back, as on a pendulum held upright, the arm falls
/// with any feedforward. A comparison of feedforwards means little there.
///
/// # Panics
///
/// When robot, gains and motion are not of one number of joints.
///
/// # Source
///
/// Kelly 1997, whose condition for PD control with the gravity of the reference is
/// `kp > |dg/dq|`; here along a motion.
pub fn holds(robot: &Robot, gains: &[PdGain], motion: &Motion) -> bool {
    assert_eq!(gains.len(), robot.joint_count(), "one gain a joint");
    let dynamics = Dynamics::new(robot);
    let mut ws = dynamics.workspace();
    let mut gravity = |q: &[f64]| {
        let mut tau = vec![0.0; gains.len()];
        dynamics.gravity_into(&mut ws, q, &mut tau);
        tau
    };
    let instants = (motion.duration_s() / SPACING_S) as usize;
    (0..=instants).all(|k| {
        let mut q = motion.at(k as f64 * SPACING_S).q;
        let mut stiffness = DMatrix::<f64>::zeros(gains.len(), gains.len());
        for (j, gain) in gains.iter().enumerate() {
            let here = q[j];
            let [below, above] = [-STEP, STEP].map(|step| {
                q[j] = here + step;
                gravity(&q)
            });
            q[j] = here;
            for (i, (below, above)) in below.into_iter().zip(above).enumerate() {
                // Gravity has a potential, so what is not symmetric is rounding.
                let half = 0.5 * (above - below) / (2.0 * STEP);
                stiffness[(i, j)] += half;
                stiffness[(j, i)] += half;
            }
            stiffness[(j, j)] += gain.kp;
        }
        stiffness.cholesky().is_some()
    })
}

#[cfg(test)]
mod tests {
    use motion::MotionSpec;

    use super::*;

    /// Two points of 2 kg on arms of 0.5 m, one upon the other, about axes that lie level;
    /// upright at zero.
    fn pendulum() -> Robot {
        let link = |name: &str| {
            format!(
                r#"<link name="{name}"><inertial><origin xyz="0 0 0.5"/><mass value="2"/>
                <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>"#
            )
        };
        let joint = |name: &str, [parent, child]: [&str; 2], z: f64| {
            format!(
                r#"<joint name="{name}" type="revolute"><parent link="{parent}"/>
                <child link="{child}"/><origin xyz="0 0 {z}"/><axis xyz="0 1 0"/>
                <limit lower="-4" upper="4" velocity="9" effort="99"/></joint>"#
            )
        };
        let [a, b] = [joint("a", ["base", "lower"], 0.0), joint("b", ["lower", "upper"], 0.5)];
        let [lower, upper] = [link("lower"), link("upper")];
        let text = format!(r#"<robot name="p"><link name="base"/>{lower}{upper}{a}{b}</robot>"#);
        Robot::from_urdf(&text).unwrap()
    }

    /// From 0.1 rad off to `to` at the first joint, the second straight.
    fn motion(robot: &Robot, to: f64) -> Motion {
        let text = format!(
            "[waypoints]\ntimes_s = [0.0, 1.0]\n\
             positions_rad = {{ a = [{}, {to}], b = [0.0, 0.0] }}",
            to - 0.1
        );
        toml::from_str::<MotionSpec>(&text).unwrap().build(robot, ".".as_ref()).unwrap()
    }

    /// With `m g l` of each point, upright
    ///
    /// ```text
    /// dg/dq = -m g l [[3, 1], [1, 1]]
    /// ```
    ///
    /// so `diag(k1, k2)` holds it where `k2 > m g l` and `(k1 - 3 m g l)(k2 - m g l) > (m g l)²`;
    /// hanging it holds itself.
    #[test]
    fn oracle_an_upright_pendulum_is_held_from_the_stiffness_of_its_weight_on() {
        let robot = pendulum();
        let weight = 2.0 * 9.81 * 0.5;
        let gains = |k: [f64; 2]| k.map(|k| PdGain { kp: weight * k, kd: 0.0 });
        let upright = motion(&robot, 0.0);
        for (k, expected) in [([5.05, 1.5], true), ([4.95, 1.5], false), ([9.0, 0.9], false)] {
            assert_eq!(holds(&robot, &gains(k), &upright), expected, "{k:?}");
        }
        let hanging = motion(&robot, std::f64::consts::PI);
        assert!(holds(&robot, &gains([0.01, 0.01]), &hanging));
    }
}
