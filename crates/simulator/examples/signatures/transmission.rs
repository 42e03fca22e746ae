use std::f64::consts::TAU;

use nalgebra::Complex;
use simulator::effects::{Backlash, DifferentialCoupling, JointElasticity, RotorInertia};

use crate::panel::{Panel, Series, curve, linear, logarithmic, points, range, steps};
use crate::record::{Record, frequencies, rate, spectrum, velocity};
use crate::statics::gravity_torque;

/// The link hangs, or lies at one end of the gap.
pub fn backlash(record: &Record, effect: &Backlash) -> Panel {
    let joint = record.joint(&effect.joint);
    let with = &record.with.joints[joint];
    let posture: Vec<f64> = record.with.joints.iter().map(|j| j.position[0]).collect();
    let gravity = |x: f64| {
        let mut q = posture.clone();
        q[joint] = x;
        gravity_torque(&record.robot, &q, joint)
    };
    let (low, high) = range(with.position.iter().copied());
    // Where it hangs, by bisection: gravity pulls it there from both sides.
    let (mut below, mut above) = (low, high);
    for _ in 0..50 {
        let middle = 0.5 * (below + above);
        if gravity(middle) < 0.0 { below = middle } else { above = middle }
    }
    let half = 0.5 * effect.gap_rad;
    let carried = |x: f64| gravity(x - (x - below).clamp(-half, half));
    let about = |line: Vec<[f64; 2]>| line.iter().map(|[x, y]| [1e3 * (x - below), *y]).collect();
    let rows = record.steady();
    let here = |run: &logs::Run| {
        about(points(&rows, (&run.joints[joint].position, 1.0), &run.joints[joint].effort))
    };
    Panel {
        name: "backlash",
        note: format!("nothing carried over {} mrad", 1e3 * effect.gap_rad),
        x: linear("motor, from hanging (mrad)"),
        y: linear("torque (N·m)"),
        with: Series::Dots(here(&record.with)),
        without: here(&record.without),
        expected: vec![about(curve(&steps(low, high, 200), carried))],
    }
}

/// The motor's apparent inertia, `torque / acceleration`, of two masses with a spring between:
///
/// ```text
/// rotor + link (k + i w d) / (k - link w^2 + i w d)
/// ```
///
/// The link's inertia is what the rigid joint shows, less the rotor's.
pub fn elasticity(record: &Record, effect: &JointElasticity) -> Panel {
    let joint = record.joint(&effect.joint);
    let inertia = |run: &logs::Run, hz: f64| {
        let channels = &run.joints[joint];
        let torque = spectrum(&run.time, &channels.effort, hz);
        (torque / spectrum(&run.time, &channels.position, hz)).norm() / (TAU * hz).powi(2)
    };
    let at = frequencies();
    let rotor = record.robot.links()[joint].actuator.rotor_inertia;
    let link = inertia(&record.without, 10.0) - rotor;
    let (k, d) = (effect.stiffness_nm_per_rad, effect.damping_nm_s_per_rad);
    let law = |hz: f64| {
        let w = TAU * hz;
        let spring = Complex::new(k, w * d);
        (spring * link / (spring - link * w * w) + rotor).norm()
    };
    let antiresonance = (k / link).sqrt() / TAU;
    let resonance = (k / link + k / rotor).sqrt() / TAU;
    Panel {
        name: "joint elasticity",
        note: format!("stops at {antiresonance:.0} Hz, resonates at {resonance:.0} Hz"),
        x: logarithmic("frequency (Hz)"),
        y: logarithmic("apparent inertia (kg·m²)"),
        with: Series::Dots(curve(&at, |hz| inertia(&record.with, hz))),
        without: curve(&at, |hz| inertia(&record.without, hz)),
        expected: vec![curve(&at, law)],
    }
}

pub fn rotor(record: &Record, effect: &RotorInertia) -> Panel {
    let joint = record.joint(&effect.joint);
    let qdd = rate(&record.with.time, velocity(&record.with.joints[joint]));
    let rows: Vec<usize> = (0..record.rows()).collect();
    let dots = points(&rows, (&qdd, 1.0), &record.added(joint));
    let (low, high) = range(dots.iter().map(|p| p[0]));
    Panel {
        name: "rotor inertia",
        note: format!("slope {} kg·m²", effect.inertia_kg_m2),
        x: linear("acceleration (rad/s²)"),
        y: linear("torque added (N·m)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&[low, high], |qdd| effect.inertia_kg_m2 * qdd)],
    }
}

/// While joint a goes forward: the motor of the difference turns back once joint b is faster than
/// `qd_a / ratio`, that of the sum once it is slower than minus that.
pub fn differential(record: &Record, effect: &DifferentialCoupling) -> Panel {
    let (a, b) = (record.joint(&effect.joint_a), record.joint(&effect.joint_b));
    let [qd_a, qd_b] = [a, b].map(|joint| velocity(&record.with.joints[joint]));
    let (sum, difference) = (effect.level_sum_nm, effect.level_difference_nm);
    let forward = record.steady().into_iter().filter(|&i| qd_a[i] > 0.0);
    let rows: Vec<usize> = forward.collect();
    let dots = points(&rows, (qd_b, 1.0), &record.added(a));
    let (low, high) = range(dots.iter().map(|p| p[0]));
    let mean = rows.iter().map(|&i| qd_a[i]).sum::<f64>() / rows.len().max(1) as f64;
    let edge = mean / effect.ratio;
    let law = |qd_b: f64| sum.copysign(qd_b + edge) + difference.copysign(edge - qd_b);
    let near = 1e-6;
    let at = [low, -edge - near, -edge + near, edge - near, edge + near, high];
    Panel {
        name: "differential coupling",
        note: format!("{sum} + {difference} N·m while joint 2 leads"),
        x: linear("velocity of joint 3 (rad/s)"),
        y: linear("added at joint 2 (N·m)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&at, law)],
    }
}
