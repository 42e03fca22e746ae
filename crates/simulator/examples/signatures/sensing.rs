use std::f64::consts::TAU;

use simulator::effects::{EncoderOffset, ExternalDisturbance, TimeSkew, TransmissionRatio};

use crate::panel::{Panel, Series, curve, linear, points, range, steps};
use crate::record::{Record, rate};
use crate::statics::gravity_torque;

/// Torque added over reported position, where the torque for a reported position `x` is
/// `factor` times that of gravity at `truth(x)`.
///
/// Other torques move the controlled arm a little, so that both runs count where they are.
fn misread(record: &Record, joint: usize, factor: f64, truth: impl Fn(f64) -> f64) -> Panel {
    let [with, without] = [&record.with, &record.without].map(|run| &run.joints[joint].position);
    let rows = record.steady();
    let mut q: Vec<f64> = record.with.joints.iter().map(|j| j.position[0]).collect();
    let mut gravity = |x: f64| {
        q[joint] = x;
        gravity_torque(&record.robot, &q, joint)
    };
    let law = |&i: &usize| [with[i], factor * gravity(truth(with[i])) - gravity(without[i])];
    // Once over the way, up.
    let expected = rows[..rows.len() / 2].iter().map(law).collect();
    Panel {
        name: "",
        note: String::new(),
        x: linear("position reported (rad)"),
        y: linear("torque added (N·m)"),
        with: Series::Dots(points(&rows, (with, 1.0), &record.added(joint))),
        without: Vec::new(),
        expected: vec![expected],
    }
}

pub fn encoder_offset(record: &Record, effect: &EncoderOffset) -> Panel {
    let joint = record.joint(&effect.joint);
    Panel {
        name: "encoder offset",
        note: format!("gravity of {} rad before", effect.offset_rad),
        ..misread(record, joint, 1.0, |x| x - effect.offset_rad)
    }
}

pub fn ratio(record: &Record, effect: &TransmissionRatio) -> Panel {
    let joint = record.joint(&effect.joint);
    Panel {
        name: "transmission ratio",
        note: format!("{} of the way and of the torque", effect.ratio),
        ..misread(record, joint, effect.ratio, |x| effect.ratio * x)
    }
}

pub fn skew(record: &Record, effect: &TimeSkew) -> Panel {
    let joint = effect.joint.as_deref().map_or(0, |name| record.joint(name));
    let skew_s = 1e-3 * effect.skew_ms;
    let needed = &record.without.joints[joint].effort;
    let slope = rate(&record.without.time, needed);
    let rows: Vec<usize> = (0..record.rows()).collect();
    let dots = points(&rows, (&slope, 1.0), &record.added(joint));
    let (low, high) = range(dots.iter().map(|p| p[0]));
    Panel {
        name: "time skew",
        note: format!("slope −{} ms", effect.skew_ms),
        x: linear("rate of torque (N·m/s)"),
        y: linear("effort added (N·m)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&[low, high], |rate| -skew_s * rate)],
    }
}

/// The motor holds against it; where a push is drawn instead, nothing is expected.
pub fn disturbance(record: &Record, effect: &ExternalDisturbance) -> Panel {
    let (joint, law): (usize, Box<dyn Fn(f64) -> f64>) = match effect {
        ExternalDisturbance::Periodic { joint, amplitude_nm, frequency_hz, phase_rad } => {
            let law = move |t: f64| -amplitude_nm * (TAU * frequency_hz * t + phase_rad).sin();
            (record.joint(joint), Box::new(law))
        }
        ExternalDisturbance::Push { link, .. } => (record.joint(link), Box::new(|_| 0.0)),
    };
    let rows: Vec<usize> = (0..record.rows()).collect();
    let end = record.with.time.last().copied().unwrap_or_default();
    Panel {
        name: "external disturbance",
        note: "the same whatever the arm does".to_owned(),
        x: linear("time (s)"),
        y: linear("torque added (N·m)"),
        with: Series::Dots(points(&rows, (&record.with.time, 1.0), &record.added(joint))),
        without: Vec::new(),
        expected: vec![curve(&steps(0.0, end, 200), law)],
    }
}
