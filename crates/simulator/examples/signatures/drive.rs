use std::f64::consts::TAU;

use nalgebra::Complex;
use simulator::effects::{
    ActuatorDelay, ActuatorLag, GoalDelay, TorqueConstant, TorqueOffset, TorqueRipple,
    TorqueSaturation,
};

use crate::panel::{Panel, Series, curve, linear, logarithmic, points, range, steps};
use crate::record::{Record, frequencies, rate, spectrum, velocity};

/// A window of the way, small enough for the periods to be seen.
pub fn ripple(record: &Record, effect: &TorqueRipple) -> Panel {
    const WINDOW_RAD: f64 = 0.05;
    let joint = record.joint(&effect.joint);
    let position = &record.with.joints[joint].position;
    let inside = |&i: &usize| position[i].abs() < WINDOW_RAD;
    let rows: Vec<usize> = record.steady().into_iter().filter(inside).collect();
    let law = |x: f64| {
        effect.amplitude_nm * (1e-3 * effect.periods_per_turn * x + effect.phase_rad).sin()
    };
    let edge = 1e3 * WINDOW_RAD;
    Panel {
        name: "torque ripple",
        note: format!("{} N·m, {} periods a turn", effect.amplitude_nm, effect.periods_per_turn),
        x: linear("position (mrad)"),
        y: linear("torque added (N·m)"),
        with: Series::Dots(points(&rows, (position, 1e3), &record.added(joint))),
        without: Vec::new(),
        expected: vec![curve(&steps(-edge, edge, 200), law)],
    }
}

pub fn constant(record: &Record, effect: &TorqueConstant) -> Panel {
    let joint = record.joint(&effect.joint);
    let needed = &record.without.joints[joint].effort;
    let rows = record.steady();
    let dots = points(&rows, (needed, 1.0), &record.with.joints[joint].effort);
    let (low, high) = range(dots.iter().map(|p| p[0]));
    Panel {
        name: "torque constant",
        note: format!("slope {}", effect.gain),
        x: linear("torque needed (N·m)"),
        y: linear("effort (N·m)"),
        with: Series::Dots(dots),
        without: vec![[low, low], [high, high]],
        expected: vec![curve(&[low, high], |tau| effect.gain * tau)],
    }
}

pub fn offset(record: &Record, effect: &TorqueOffset) -> Panel {
    let joint = record.joint(&effect.joint);
    let qd = velocity(&record.with.joints[joint]);
    let dots = points(&record.steady(), (qd, 1.0), &record.added(joint));
    let (low, high) = range(dots.iter().map(|p| p[0]));
    Panel {
        name: "torque offset",
        note: format!("{} N·m at every speed", effect.offset_nm),
        x: linear("velocity (rad/s)"),
        y: linear("effort added (N·m)"),
        with: Series::Dots(dots),
        without: vec![[low, 0.0], [high, 0.0]],
        expected: vec![curve(&[1.1 * low, 1.1 * high], |_| effect.offset_nm)],
    }
}

pub fn saturation(record: &Record, effect: &TorqueSaturation) -> Panel {
    let joint = record.joint(&effect.joint);
    let channels = &record.with.joints[joint];
    let command = channels.commanded_effort.as_deref().unwrap_or_default();
    let rows: Vec<usize> = (0..record.rows()).collect();
    let dots = points(&rows, (command, 1.0), &channels.effort);
    let (low, high) = range(dots.iter().map(|p| p[0]));
    let limit = effect.limit_nm;
    Panel {
        name: "torque saturation",
        note: format!("no more than ±{limit} N·m"),
        x: linear("command (N·m)"),
        y: linear("motor torque (N·m)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&[low, -limit, limit, high], |u| u.clamp(-limit, limit))],
    }
}

/// Phase from command to torque, less that of holding the command, which the arm has anyway.
fn phase(record: &Record, joint: usize) -> Vec<[f64; 2]> {
    let answer = |run: &logs::Run, hz: f64| -> Complex<f64> {
        let channels = &run.joints[joint];
        let command = channels.commanded_effort.as_deref().unwrap_or_default();
        spectrum(&run.time, &channels.effort, hz) / spectrum(&run.time, command, hz)
    };
    curve(&frequencies(), |hz| {
        (answer(&record.with, hz) / answer(&record.without, hz)).arg().to_degrees()
    })
}

fn phases(name: &'static str, dots: Vec<[f64; 2]>, law: impl Fn(f64) -> f64) -> Panel {
    Panel {
        name,
        note: String::new(),
        x: logarithmic("frequency (Hz)"),
        y: linear("phase of torque (°)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&frequencies(), |hz| law(hz).to_degrees())],
    }
}

pub fn lag(record: &Record, effect: &ActuatorLag) -> Panel {
    let lag_s = 1e-3 * effect.time_constant_ms;
    let dots = phase(record, record.joint(&effect.joint));
    Panel {
        note: format!("−arctan(2πf · {} ms)", effect.time_constant_ms),
        ..phases("actuator lag", dots, |hz| -(TAU * hz * lag_s).atan())
    }
}

pub fn delay(record: &Record, effect: &ActuatorDelay) -> Panel {
    let delay_s = 1e-3 * effect.delay_ms;
    let dots = phase(record, record.joint(&effect.joint));
    Panel {
        note: format!("−2πf · {} ms", effect.delay_ms),
        ..phases("actuator delay", dots, |hz| -TAU * hz * delay_s)
    }
}

/// The first joint follows its goals later.
pub fn goal_delay(record: &Record, effect: &GoalDelay) -> Panel {
    let delay_s = 1e-3 * effect.delay_ms;
    let [with, without] = [&record.with, &record.without].map(|run| &run.joints[0].position);
    let behind: Vec<f64> = without.iter().zip(with).map(|(on_time, late)| on_time - late).collect();
    let slope = rate(&record.without.time, without);
    let rows: Vec<usize> = (0..record.rows()).collect();
    let dots = points(&rows, (&slope, 1.0), &behind);
    let (low, high) = range(dots.iter().map(|p| p[0]));
    Panel {
        name: "goal delay",
        note: format!("slope {} ms", effect.delay_ms),
        x: linear("velocity (rad/s)"),
        y: linear("position behind (rad)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&[low, high], |rate| delay_s * rate)],
    }
}
