use nalgebra::{Rotation3, Vector3};
use robot::Robot;
use simulator::effects::{
    CableSpring, Counterbalance, GravityDirection, InertialParameters, Payload,
};

use crate::panel::{Panel, Series, curve, linear, points, range, steps};
use crate::record::Record;
use crate::statics::gravity_curve;

/// Torque over position at constant speed, with the effect, without it, and of the weights of
/// the robot as it truly is.
fn over_position(record: &Record, joint: usize, truth: &Robot) -> Panel {
    let rows = record.steady();
    let of = |run: &logs::Run| {
        points(&rows, (&run.joints[joint].position, 1.0), &run.joints[joint].effort)
    };
    let with = of(&record.with);
    let (low, high) = range(with.iter().map(|p| p[0]));
    let posture: Vec<f64> = record.with.joints.iter().map(|j| j.position[0]).collect();
    Panel {
        name: "",
        note: String::new(),
        x: linear("position (rad)"),
        y: linear("torque (N·m)"),
        with: Series::Dots(with),
        without: of(&record.without),
        expected: vec![gravity_curve(truth, &posture, joint, &steps(low, high, 100))],
    }
}

pub fn payload(record: &Record, effect: &Payload) -> Panel {
    let mut truth = record.robot.clone();
    if let Some(link) = truth.link_mut(record.joint(&effect.link)) {
        let (own, more) = (link.inertia.mass, effect.mass_kg);
        let moment = link.inertia.com_in_link * own + Vector3::from(effect.com_m) * more;
        link.inertia.mass = own + more;
        link.inertia.com_in_link = moment / (own + more);
    }
    let shoulder = 1;
    Panel {
        name: "payload",
        note: format!("{} kg in the hand, joint 2", effect.mass_kg),
        ..over_position(record, shoulder, &truth)
    }
}

pub fn inertial_parameters(record: &Record, effect: &InertialParameters) -> Panel {
    let joint = record.joint(&effect.link);
    let mut truth = record.robot.clone();
    let mut before = 0.0;
    if let Some(link) = truth.link_mut(joint) {
        before = link.inertia.mass;
        link.inertia.mass = effect.mass_kg;
        link.inertia.com_in_link = Vector3::from(effect.com_m);
    }
    Panel {
        name: "inertial parameters",
        note: format!("forearm of {} kg, not {before:.1} kg", effect.mass_kg),
        ..over_position(record, joint, &truth)
    }
}

pub fn gravity_direction(record: &Record, effect: &GravityDirection) -> Panel {
    let turn = Rotation3::new(Vector3::new(effect.tilt_x_rad, effect.tilt_y_rad, 0.0));
    let truth = record.robot.clone().with_gravity(turn * record.robot.gravity_in_base());
    let base = 0;
    Panel {
        name: "gravity direction",
        note: format!("tilt of {} rad, base joint", effect.tilt_x_rad),
        ..over_position(record, base, &truth)
    }
}

/// The sliding part turns round at the ends of the way.
pub fn cable(record: &Record, effect: &CableSpring) -> Panel {
    let joint = record.joint(&effect.joint);
    let (k, half) = (effect.stiffness_nm_per_rad, effect.hysteresis_nm);
    let spring = |q: f64| {
        let x = q - effect.rest_rad;
        k * x + effect.cubic_nm_per_rad3 * x.powi(3)
    };
    let (low, high) = range(record.with.joints[joint].position.iter().copied());
    let up = |q: f64| spring(q) + (k * (q - low) - half).min(half);
    let down = |q: f64| spring(q) - (k * (high - q) - half).min(half);
    let at = steps(low, high, 100);
    Panel {
        name: "cable spring",
        note: format!("{k} N·m/rad, loop of ±{half} N·m"),
        expected: vec![curve(&at, up), curve(&at, down)],
        ..over_position(record, joint, &record.robot)
    }
}

pub fn counterbalance(record: &Record, effect: &Counterbalance) -> Panel {
    let joint = record.joint(&effect.joint);
    let (low, high) = range(record.with.joints[joint].position.iter().copied());
    let torque = |q: f64| effect.amplitude_nm * (q + effect.phase_rad).sin();
    Panel {
        name: "counterbalance",
        note: format!("{} N·m", effect.amplitude_nm),
        expected: vec![curve(&steps(low, high, 100), torque)],
        ..over_position(record, joint, &record.robot)
    }
}
