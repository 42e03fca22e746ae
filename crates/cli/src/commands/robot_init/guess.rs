use dynamics::Dynamics;
use nalgebra::DMatrix;
use robot::{PdGain, Robot};

/// Postures that inertia and weight are looked at in.
const POSTURES: usize = 48;
/// Rotor inertia per limit of effort (s²): that of drives from a hobby servo to an arm of 20 kg
/// lies between a fifth and three times this.
const ROTOR_PER_EFFORT: f64 = 1e-3;
/// Least share of the largest inertia of a joint that its rotor has.
const LEAST_ROTOR_SHARE: f64 = 0.05;
/// Frequency of a joint under its controller (rad/s): 3 Hz.
const NATURAL: f64 = 19.0;
/// The highest one, where the joint is lightest (rad/s): 10 Hz.
const HIGHEST: f64 = 60.0;
/// Error that the weight may make (rad or m).
const SAG: f64 = 0.02;
/// Damping over critical damping.
const DAMPING: f64 = 0.8;
/// Share of the speed that the damping may take away within a period of the controller.
const DAMPED_A_PERIOD: f64 = 0.3;

/// Rotor and gains of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveGuess {
    /// Inertia of the rotor (kg m² or kg).
    pub rotor: f64,
    /// Gains of the controller.
    pub gain: PdGain,
    /// Whether the rotor is a guess.
    pub rotor_guessed: bool,
    /// Whether the gains are.
    pub gain_guessed: bool,
}

/// Rotors and gains of all joints; what is known already stays.
///
/// ```text
/// rotor = max(rotor_per_effort limit, 0.05 max M_jj)
/// kp    = max(natural² (max M_jj + rotor), max |g_j| / sag), up to highest² m_j
/// kd    = min(2 damping sqrt(kp (max M_jj + rotor)), 0.3 rate m_j),  m_j = min 1 / (M + rotors)⁻¹_jj
/// ```
///
/// the extremes over postures within the limits.
pub fn drives(robot: &Robot, known: &[Option<PdGain>], rate_hz: f64) -> Vec<DriveGuess> {
    let n = robot.joint_count();
    let dynamics = Dynamics::new(robot);
    let postures: Vec<Vec<f64>> = (0..POSTURES).map(|k| posture(robot, k)).collect();
    // Postures are finite and of the right length: nothing is refused.
    let masses: Vec<DMatrix<f64>> =
        postures.iter().filter_map(|q| dynamics.mass_matrix(q).ok()).collect();
    let weights: Vec<_> = postures.iter().filter_map(|q| dynamics.gravity(q).ok()).collect();
    let largest = |j: usize| masses.iter().map(|m| m[(j, j)]).fold(0.0, f64::max);
    let weight = |j: usize| weights.iter().map(|g| g[j].abs()).fold(0.0, f64::max);
    let rotors: Vec<f64> = robot
        .links()
        .iter()
        .enumerate()
        .map(|(j, link)| {
            let given = link.actuator.rotor_inertia;
            let by_effort = ROTOR_PER_EFFORT * link.joint.limits.effort.unwrap_or(0.0);
            let guessed = by_effort.max(LEAST_ROTOR_SHARE * largest(j)).max(1e-5);
            if given > 0.0 { given } else { round(guessed) }
        })
        .collect();
    let least = least_inertias(&masses, &rotors);
    (0..n)
        .map(|j| {
            let inertia = largest(j) + rotors[j];
            let wanted = (NATURAL * NATURAL * inertia).max(weight(j) / SAG);
            let kp = wanted.min(HIGHEST * HIGHEST * least[j]);
            let kd = 2.0 * DAMPING * (kp * inertia).sqrt();
            let kd = kd.min(DAMPED_A_PERIOD * rate_hz * least[j]);
            let given = known.get(j).copied().flatten();
            DriveGuess {
                rotor: rotors[j],
                gain: given.unwrap_or(PdGain { kp: round(kp), kd: round(kd) }),
                rotor_guessed: robot.links()[j].actuator.rotor_inertia <= 0.0,
                gain_guessed: given.is_none(),
            }
        })
        .collect()
}

/// The robot with these rotors.
pub fn with_rotors(robot: &Robot, drives: &[DriveGuess]) -> Robot {
    let mut robot = robot.clone();
    for (index, drive) in drives.iter().enumerate() {
        if let Some(link) = robot.link_mut(index) {
            link.actuator.rotor_inertia = drive.rotor;
        }
    }
    robot
}

/// The least inertia that a joint's torque alone moves: the others give way.
fn least_inertias(masses: &[DMatrix<f64>], rotors: &[f64]) -> Vec<f64> {
    let mut least = vec![f64::INFINITY; rotors.len()];
    for mass in masses {
        let mut mass = mass.clone();
        rotors.iter().enumerate().for_each(|(j, rotor)| mass[(j, j)] += rotor);
        if let Some(inverse) = mass.try_inverse() {
            for (j, least) in least.iter_mut().enumerate() {
                *least = least.min(1.0 / inverse[(j, j)].max(f64::MIN_POSITIVE));
            }
        }
    }
    let known = least.into_iter().zip(rotors);
    known.map(|(least, rotor)| if least.is_finite() { least } else { *rotor }).collect()
}

/// Posture `k` of a sequence that fills the ranges evenly (rad or m).
fn posture(robot: &Robot, k: usize) -> Vec<f64> {
    // Multiples of the powers of one irrational number are spread evenly.
    const STEP: f64 = 0.618_033_988_749_894_9;
    let mut step = STEP;
    let mut share = || {
        step = (step * 1.324_717_957_244_746).fract();
        (0.5 + step * (k as f64 + 1.0)).fract()
    };
    let ranges = robot.links().iter().map(|link| {
        let free = if link.joint.kind.is_rotation() { std::f64::consts::PI } else { 0.1 };
        link.joint.limits.position.unwrap_or((-free, free))
    });
    ranges.map(|(low, high)| low + share() * (high - low)).collect()
}

/// Two digits: a guess is no more exact.
fn round(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wam() -> Robot {
        let text = include_str!("../../../../../robots/wam7/robot.urdf");
        Robot::from_urdf(text).unwrap()
    }

    /// The maker's figures of a WAM (robots/wam7): rotors 0.205 to 0.00032 kg m², gains 2500 to 8.
    #[test]
    fn guesses_for_a_wam_are_of_the_size_of_its_own() {
        let rotors = [0.205, 0.189, 0.067, 0.0346, 0.0032, 0.0032, 0.00032];
        let gains = [900.0, 2500.0, 600.0, 500.0, 50.0, 50.0, 8.0];
        for (j, drive) in drives(&wam(), &[], 500.0).iter().enumerate() {
            let within = |found: f64, known: f64| found < 20.0 * known && known < 20.0 * found;
            assert!(within(drive.rotor, rotors[j]), "{j}: {drive:?} {}", rotors[j]);
            assert!(within(drive.gain.kp, gains[j]), "{j}: {drive:?} {}", gains[j]);
        }
    }

    #[test]
    fn what_is_known_stays() {
        let mut robot = wam();
        robot.link_mut(0).unwrap().actuator.rotor_inertia = 0.5;
        let known = [None, Some(PdGain { kp: 7.0, kd: 1.0 })];
        let drives = drives(&robot, &known, 500.0);
        assert!((drives[0].rotor - 0.5).abs() < 1e-15 && !drives[0].rotor_guessed);
        assert_eq!(drives[1].gain, PdGain { kp: 7.0, kd: 1.0 });
        assert!(drives[0].gain_guessed && !drives[1].gain_guessed);
    }
}
