use std::f64::consts::TAU;

use nalgebra::{Isometry3, Rotation3, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Link, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::gravity_direction::horizontal;
use crate::effects::mistake::{Mistake, within};
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::{Efforts, Inject, Moment};
use crate::mechanics::plant::Plant;
use crate::strangers::kind::StrangerKind;
use crate::strangers::scenario_stranger::ScenarioStranger;
use crate::strangers::truth::StrangerTruth;

/// A base that tilts under the weight of its arm, as one on rubber or on a thin table does.
///
/// ```text
/// phi'' = w² (m(q) / stiffness - phi) - 2 damping_ratio w phi',   w = 2 pi frequency
/// m(q)  = sum over the links of r_i x m_i g
/// force on link i at its centre of mass: m_i (exp(-phi) g - g) - m_i phi'' x r_i
/// ```
///
/// `phi` is the turn of the base about its two horizontal axes, those of the effect
/// `gravity_direction`, through its origin, and `r_i` leads from there to a centre of mass. The
/// mount feels weight alone: that the arm also pushes off its base where it speeds up is left
/// out, as are the turning inertia of the links under `phi''` and Coriolis terms of `phi'`. It
/// starts at rest where the weight of the first posture has put it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SoftMount {
    /// Moment per unit of tilt (N m/rad), 1 to 1e9.
    pub stiffness_nm_per_rad: f64,
    /// Frequency at which base and arm rock (Hz), 0.1 to 50.
    pub frequency_hz: f64,
    /// Damping over critical damping (no unit), 0 to 2.
    pub damping_ratio: f64,
}

impl ScenarioStranger for SoftMount {
    const KIND: StrangerKind = StrangerKind::SoftMount;

    fn truth(&self) -> StrangerTruth {
        let parameters = [
            ("stiffness", self.stiffness_nm_per_rad),
            ("frequency", self.frequency_hz),
            ("damping_ratio", self.damping_ratio),
        ];
        StrangerTruth::everywhere(Self::KIND, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        within("stiffness_nm_per_rad", self.stiffness_nm_per_rad, 1.0, 1e9)?;
        within("frequency_hz", self.frequency_hz, 0.1, 50.0)?;
        within("damping_ratio", self.damping_ratio, 0.0, 2.0)?;
        let mut mount = Mount {
            compliance: 1.0 / self.stiffness_nm_per_rad,
            omega: TAU * self.frequency_hz,
            damping_ratio: self.damping_ratio,
            links: Vec::new(),
            gravity: Vector3::zeros(),
            axes: [Vector3::zeros(); 2],
            reach: Vec::new(),
            poses: Vec::new(),
            tilt: [0.0; 2],
            rate: [0.0; 2],
        };
        mount.carry(robot);
        Ok(Box::new(mount))
    }

    /// The largest torque of a joint is about the moment of the weight, and a tilt changes torque
    /// by about its own angle.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let moment = at.joints.iter().map(|j| j.torque_rms).fold(at.torque_rms, f64::max);
        Self {
            stiffness_nm_per_rad: (moment / share.clamp(1e-6, 0.5)).clamp(1.0, 1e9),
            frequency_hz: random.random_range(3.0..15.0),
            damping_ratio: random.random_range(0.03..0.2),
        }
    }
}

struct Mount {
    compliance: f64,
    omega: f64,
    damping_ratio: f64,
    /// The moving links, payloads included.
    links: Vec<Link>,
    gravity: Vector3<f64>,
    axes: [Vector3<f64>; 2],
    /// Centre of mass of each link from the origin of the base (m).
    reach: Vec<Vector3<f64>>,
    poses: Vec<Isometry3<f64>>,
    /// Turn about each axis (rad), and its rate (rad/s).
    tilt: [f64; 2],
    rate: [f64; 2],
}

impl Mount {
    fn carry(&mut self, robot: &Robot) {
        self.links = robot.links().to_vec();
        self.gravity = robot.gravity_in_base();
        self.axes = horizontal(self.gravity);
    }

    /// Tilt under which the mount would carry the arm at rest at `q` (rad); finds the reach.
    fn rest(&mut self, q: &[f64]) -> [f64; 2] {
        self.poses.clear();
        self.reach.clear();
        let mut moment = Vector3::zeros();
        for (link, q) in self.links.iter().zip(q) {
            let parent = link.parent.and_then(|p| self.poses.get(p).copied());
            let pose =
                parent.unwrap_or_else(Isometry3::identity) * link.joint.parent_from_child(*q);
            let com = (pose * nalgebra::Point3::from(link.inertia.com_in_link)).coords;
            moment += com.cross(&(self.gravity * link.inertia.mass));
            self.poses.push(pose);
            self.reach.push(com);
        }
        self.axes.map(|axis| self.compliance * axis.dot(&moment))
    }

    /// The vector with two components along the horizontal axes.
    fn about(&self, [first, second]: [f64; 2]) -> Vector3<f64> {
        self.axes[0] * first + self.axes[1] * second
    }
}

impl Inject for Mount {
    fn on_build(&mut self, plant: &mut Plant) {
        self.carry(&plant.robot);
    }

    fn on_start(&mut self, q: &[f64]) {
        self.tilt = self.rest(q);
        self.rate = [0.0; 2];
    }

    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let rest = self.rest(moment.q);
        let (w, ratio) = (self.omega, self.damping_ratio);
        let speeding: [f64; 2] = std::array::from_fn(|i| {
            w * w * (rest[i] - self.tilt[i]) - 2.0 * ratio * w * self.rate[i]
        });
        let turned = Rotation3::new(-self.about(self.tilt)) * self.gravity - self.gravity;
        let rocking = self.about(speeding);
        for (i, link) in self.links.iter().enumerate() {
            let force = (turned - rocking.cross(&self.reach[i])) * link.inertia.mass;
            efforts.push(i, force, link.inertia.com_in_link);
        }
        for ((tilt, rate), speeding) in self.tilt.iter_mut().zip(&mut self.rate).zip(speeding) {
            *rate += moment.step_s * speeding;
            *tilt += moment.step_s * *rate;
        }
    }
}
