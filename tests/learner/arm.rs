//! A planar arm of two links whose torque is written down here, not computed by this project.

use logs::{Prepared, PreparedJoint, PreparedRun};
use robot::Robot;

const URDF: &str = r#"<robot name="planar">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="3"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0.15 0 0"/><mass value="1.5"/>
    <inertia ixx="0.005" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
    <axis xyz="0 -1 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="0.4 0 0"/><axis xyz="0 -1 0"/></joint>
</robot>"#;

/// The arm of [`torque`].
pub fn robot() -> Robot {
    Robot::from_urdf(URDF).unwrap()
}

/// Torque of the two links in closed form, gravity along -z, both axes along -y.
pub fn rigid_bodies([q1, q2]: [f64; 2], [v1, v2]: [f64; 2], [a1, a2]: [f64; 2]) -> [f64; 2] {
    let (m1, m2, i1, i2) = (3.0, 1.5, 0.05, 0.02);
    let (l1, c1, c2, g) = (0.4, 0.2, 0.15, 9.81);
    let (cos, sin) = (q2.cos(), q2.sin());
    let m11 = i1 + m1 * c1 * c1 + i2 + m2 * (l1 * l1 + c2 * c2 + 2.0 * l1 * c2 * cos);
    let m12 = i2 + m2 * (c2 * c2 + l1 * c2 * cos);
    let m22 = i2 + m2 * c2 * c2;
    let h = m2 * l1 * c2 * sin;
    let g2 = m2 * g * c2 * (q1 + q2).cos();
    let g1 = (m1 * c1 + m2 * l1) * g * q1.cos() + g2;
    [
        m11 * a1 + m12 * a2 - h * (2.0 * v1 * v2 + v2 * v2) + g1,
        m12 * a1 + m22 * a2 + h * v1 * v1 + g2,
    ]
}

/// What no rigid body does: friction that sets in softly, and a wave over the shoulder.
pub fn beside([q1, _]: [f64; 2], [v1, v2]: [f64; 2]) -> [f64; 2] {
    [0.8 * (3.0 * v1).tanh() + 0.5 * (2.0 * q1).sin(), 0.6 * (3.0 * v2).tanh()]
}

/// One run at 50 Hz of two sines a joint, phases by `seed`; `share` of [`beside`] is in it.
pub fn run(seed: f64, samples: usize, share: f64) -> Prepared {
    let empty = PreparedJoint::exact([vec![], vec![], vec![]], vec![]);
    let mut joints = vec![empty.clone(), empty];
    let time: Vec<f64> = (0..samples).map(|i| 0.02 * i as f64).collect();
    for &t in &time {
        let wave = |j: f64, t: f64| {
            let (w1, w2) = (2.1 + 0.7 * j, 3.7 - 0.4 * j);
            let (p1, p2) = (1.3 * seed + j, 2.9 * seed - j);
            let (s1, s2) = (w1 * t + p1, w2 * t + p2);
            [
                0.7 * s1.sin() + 0.4 * s2.sin(),
                0.7 * w1 * s1.cos() + 0.4 * w2 * s2.cos(),
                -0.7 * w1 * w1 * s1.sin() - 0.4 * w2 * w2 * s2.sin(),
            ]
        };
        let (a, b) = (wave(0.0, t), wave(1.0, t));
        let [q, v, acc] = [0, 1, 2].map(|k| [a[k], b[k]]);
        let (rigid, rest) = (rigid_bodies(q, v, acc), beside(q, v));
        for (k, joint) in joints.iter_mut().enumerate() {
            joint.q.push(q[k]);
            joint.qd.push(v[k]);
            joint.qdd.push(acc[k]);
            joint.wide.qd.push(v[k]);
            // A ripple of 5 mN m stands for noise.
            let noise = 0.005 * (1e4 * t + seed + k as f64).sin();
            joint.effort.push(rigid[k] + share * rest[k] + noise);
        }
    }
    let run = PreparedRun {
        name: format!("run {seed}"),
        rate_hz: 50.0,
        time,
        session_start_s: 0.0,
        joints,
    };
    Prepared::exact(vec![run], 10.0)
}
