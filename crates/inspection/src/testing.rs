//! Runs by closed forms, for the tests of this crate.

use std::f64::consts::TAU;

use logs::{Channels, Run};
use robot::Robot;

/// Rate of the runs (Hz).
pub const RATE_HZ: f64 = 250.0;

/// A point of 2 kg at 0.5 m on a horizontal hinge, hanging at position zero.
pub fn pendulum() -> Robot {
    let text = r#"<robot name="pendulum"><link name="base"/>
        <link name="arm"><inertial><origin xyz="0 0 -0.5"/><mass value="2"/>
        <inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"/></inertial></link>
        <joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/></joint>
        </robot>"#;
    Robot::from_urdf(text).unwrap()
}

/// The pendulum at `q = 0.9 sin(2 pi 0.3 t) + 0.4 sin(2 pi 0.7 t + phase)` for 20 s, with .3 N m of dry friction.
///
/// ```text
/// effort = m l² qdd + m g l sin(q) + 0.3 tanh(50 qd)
/// ```
pub fn swing(phase: f64) -> Run {
    let wave = |a: f64, f: f64, phase: f64, t: f64| {
        let (w, x) = (TAU * f, TAU * f * t + phase);
        [a * x.sin(), a * w * x.cos(), -a * w * w * x.sin()]
    };
    let time: Vec<f64> = (0..5000).map(|k| f64::from(k) / RATE_HZ).collect();
    let state = |t: &f64| {
        let (a, b) = (wave(0.9, 0.3, 0.0, *t), wave(0.4, 0.7, phase, *t));
        [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
    };
    let states: Vec<[f64; 3]> = time.iter().map(state).collect();
    let effort = |[q, qd, qdd]: &[f64; 3]| 0.5 * qdd + 9.81 * q.sin() + 0.3 * (50.0 * qd).tanh();
    let joint = Channels {
        name: "hinge".to_owned(),
        position: states.iter().map(|s| s[0]).collect(),
        effort: states.iter().map(effort).collect(),
        velocity: Some(states.iter().map(|s| s[1]).collect()),
        ..Channels::default()
    };
    Run {
        name: format!("swing {phase}"),
        source: Default::default(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time,
        joints: vec![joint],
        extra: Default::default(),
    }
}
