use simulator::effects::{
    AsymmetricFriction, CoulombFriction, FrictionTemperatureDrift, LoadDependentFriction,
    PositionDependentFriction, PreslidingFriction, StribeckFriction, ViscousFriction,
};

use crate::panel::{Panel, Series, curve, linear, points, range, steps};
use crate::record::{Record, rate, velocity};
use crate::statics::gravity_torque;

/// Acceleration above which friction is not the only torque (rad/s²): half a newton metre per
/// rad/s² at the base joint.
const SLOW: f64 = 0.2;

/// Torque added at constant speeds, and the law that it should follow for positive and negative
/// ones.
fn over_velocity(record: &Record, joint: usize, law: impl Fn(f64) -> f64) -> [Vec<[f64; 2]>; 2] {
    let qd = velocity(&record.with.joints[joint]);
    let dots = points(&record.steady(), (qd, 1.0), &record.added(joint));
    let (low, high) = range(dots.iter().map(|p| p[0]));
    let ends = [1.1 * low, -1e-9, 1e-9, 1.1 * high];
    [dots, curve(&ends, law)]
}

fn speeds(name: &'static str, note: String, [dots, law]: [Vec<[f64; 2]>; 2]) -> Panel {
    Panel {
        name,
        note,
        x: linear("velocity (rad/s)"),
        y: linear("torque added (N·m)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![law],
    }
}

pub fn viscous(record: &Record, effect: &ViscousFriction) -> Panel {
    let slope = effect.viscous_nm_s_per_rad;
    let shown = over_velocity(record, record.joint(&effect.joint), |qd| slope * qd);
    speeds("viscous friction", format!("slope {slope} N·m·s/rad"), shown)
}

pub fn coulomb(record: &Record, effect: &CoulombFriction) -> Panel {
    let level = effect.level_nm;
    let shown = over_velocity(record, record.joint(&effect.joint), |qd| level.copysign(qd));
    speeds("Coulomb friction", format!("±{level} N·m"), shown)
}

pub fn asymmetric(record: &Record, effect: &AsymmetricFriction) -> Panel {
    let (forward, backward) = (effect.forward_nm, effect.backward_nm);
    let law = |qd: f64| if qd > 0.0 { forward } else { -backward };
    let shown = over_velocity(record, record.joint(&effect.joint), law);
    speeds("asymmetric friction", format!("{forward} and −{backward} N·m"), shown)
}

/// Where the joint jumps as it comes loose, inertia takes part and nothing is drawn.
pub fn stribeck(record: &Record, effect: &StribeckFriction) -> Panel {
    let joint = record.joint(&effect.joint);
    let (coulomb, breakaway) = (effect.coulomb_nm, effect.breakaway_nm);
    let law = |qd: f64| {
        let speed = qd / effect.stribeck_velocity_rad_per_s;
        (coulomb + (breakaway - coulomb) * (-speed * speed).exp()).copysign(qd)
    };
    let qd = velocity(&record.with.joints[joint]);
    let qdd = rate(&record.with.time, qd);
    let rows: Vec<usize> = (0..record.rows()).filter(|&i| qdd[i].abs() < SLOW).collect();
    let dots = points(&rows, (qd, 1.0), &record.added(joint));
    let (low, high) = range(dots.iter().map(|p| p[0]));
    let at = [steps(low, -1e-9, 60), steps(1e-9, high, 60)].concat();
    let note = format!("{breakaway} N·m to start, then {coulomb} N·m");
    speeds("Stribeck friction", note, [dots, curve(&at, law)])
}

/// The way in milliradians, and the loop of the largest swing: it has slid at both ends.
pub fn presliding(record: &Record, effect: &PreslidingFriction) -> Panel {
    let with = &record.with.joints[record.joint(&effect.joint)];
    let (level, stiffness) = (effect.level_nm, effect.stiffness_nm_per_rad);
    let (low, high) = range(with.position.iter().copied());
    let way = |x: f64| level * (1.0 - 2.0 * (-stiffness * x / level).exp());
    let at = steps(low, high, 100);
    let mm = |branch: Vec<[f64; 2]>| branch.iter().map(|[x, y]| [1e3 * x, *y]).collect();
    let rows: Vec<usize> = (0..with.position.len()).collect();
    Panel {
        name: "presliding friction",
        note: format!("{stiffness} N·m/rad, slides at {level} N·m"),
        x: linear("position (mrad)"),
        y: linear("torque (N·m)"),
        with: Series::Line(points(&rows, (&with.position, 1e3), &with.effort)),
        without: Vec::new(),
        expected: vec![mm(curve(&at, |x| way(x - low))), mm(curve(&at, |x| -way(high - x)))],
    }
}

pub fn load_dependent(record: &Record, effect: &LoadDependentFriction) -> Panel {
    let joint = record.joint(&effect.joint);
    let position = &record.with.joints[joint].position;
    let dots = points(&record.steady(), (position, 1.0), &record.added(joint));
    let (low, high) = range(dots.iter().map(|p| p[0]));
    let friction = |x: f64| {
        let mut q: Vec<f64> = record.with.joints.iter().map(|j| j.position[0]).collect();
        q[joint] = x;
        effect.coefficient * gravity_torque(&record.robot, &q, joint).abs()
    };
    let at = steps(low, high, 100);
    Panel {
        name: "load-dependent friction",
        note: format!("±{} of the gravity torque", effect.coefficient),
        x: linear("position (rad)"),
        y: linear("torque added (N·m)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&at, friction), curve(&at, |x| -friction(x))],
    }
}

pub fn position_dependent(record: &Record, effect: &PositionDependentFriction) -> Panel {
    let joint = record.joint(&effect.joint);
    let position = &record.with.joints[joint].position;
    let dots = points(&record.steady(), (position, 1.0), &record.added(joint));
    let (low, high) = range(dots.iter().map(|p| p[0]));
    let friction = |x: f64| {
        let angle = effect.periods_per_turn * x + effect.phase_rad;
        effect.level_nm * (1.0 + effect.share * angle.cos())
    };
    let at = steps(low, high, 150);
    Panel {
        name: "position-dependent friction",
        note: format!("±{} N·m, {:.0} % more or less", effect.level_nm, 100.0 * effect.share),
        x: linear("position (rad)"),
        y: linear("torque added (N·m)"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&at, friction), curve(&at, |x| -friction(x))],
    }
}

/// Work per way against the motion, period by period, over that of the cold joint.
pub fn temperature_drift(record: &Record, effect: &FrictionTemperatureDrift) -> Panel {
    const PERIOD_S: f64 = 10.0;
    let joint = effect.joint.as_deref().map_or(0, |name| record.joint(name));
    let work = |run: &logs::Run| {
        let channels = &run.joints[joint];
        let mut sums: Vec<f64> = Vec::new();
        for (i, &t) in run.time.iter().enumerate() {
            let period = (t / PERIOD_S) as usize;
            sums.resize(sums.len().max(period + 1), 0.0);
            sums[period] += channels.effort[i] * velocity(channels)[i];
        }
        sums
    };
    let (with, without) = (work(&record.with), work(&record.without));
    let minutes = |period: usize| (period as f64 + 0.5) * PERIOD_S / 60.0;
    // The first and the last period are the fades.
    let whole = 1..with.len().saturating_sub(2);
    let dots: Vec<[f64; 2]> = whole.map(|p| [minutes(p), with[p] / without[p]]).collect();
    let left = |t: f64| 1.0 - effect.share * (1.0 - (-60.0 * t / effect.time_constant_s).exp());
    Panel {
        name: "friction temperature drift",
        note: format!("{:.0} % less when warm", 100.0 * effect.share),
        x: linear("time (min)"),
        y: linear("friction, cold = 1"),
        with: Series::Dots(dots),
        without: Vec::new(),
        expected: vec![curve(&steps(0.0, 10.0, 60), left)],
    }
}
