use std::f64::consts::TAU;

use nalgebra::{DVector, Point3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::curve::Curve;
use crate::error::MotionError;
use crate::harmonics::{HarmonicSeries, Harmonics};
use crate::kinematics::{REACHED_M, Tip};
use crate::motion::ClockedCurve;
use crate::site::{Site, above};
use crate::spec::defaults::{ByJoint, two_seconds};

/// A point of the robot's last link follows a figure in a plane again and again, around
/// where it is in a posture. Its orientation is left free.
///
/// Of all postures in which the point is at its place, the one nearest to `posture_rad` is
/// taken. Over one cycle these are closed curves of the joints; the motion is their Fourier
/// series, with as many harmonics as keep the point within 1e-5 m of the figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rhythm {
    /// The figure.
    pub figure: Figure,
    /// The plane of the base frame that the figure lies in; its first axis is the long one.
    #[serde(default)]
    pub plane: Plane,
    /// Half the extent of the figure along the first axis (m).
    pub radius_m: f64,
    /// How often the figure is followed in a second (Hz), at most 100.
    pub cycle_hz: f64,
    /// Length of the motion, fades included (s).
    pub duration_s: f64,
    /// Posture around whose point the figure lies. A posture in which the arm is stretched
    /// leaves no room.
    #[serde(default, skip_serializing_if = "ByJoint::is_empty")]
    pub posture_rad: ByJoint,
    /// The point in the frame of the last link (m).
    #[serde(default)]
    pub point_m: [f64; 3],
    /// Time over which the motion starts, and stops, smoothly (s).
    #[serde(default = "two_seconds")]
    pub fade_s: f64,
}

/// A closed figure; `phi` runs from 0 to 2 pi in one cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Figure {
    /// `radius (cos phi, sin phi)`
    Circle,
    /// `radius (sin phi, sin(2 phi) / 2)`
    Eight,
    /// `radius (sin phi, 0)`
    Line,
}

/// A plane, by its first and second axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Plane {
    /// Level: a line lies along x.
    #[default]
    Xy,
    /// Upright: a line lies along y.
    Yz,
    /// Upright: a line lies along z.
    Zx,
}

/// Postures per cycle to begin with, and at most.
const POSTURES: [usize; 2] = [32, 1024];
/// How far the point may be from the figure (m).
const TOLERANCE_M: f64 = 1e-5;

impl Rhythm {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        site.number(&["radius_m"], self.radius_m, above(0.0))?;
        site.duration(self.duration_s)?;
        site.frequency("cycle_hz", self.cycle_hz, self.duration_s)?;
        for (k, &x) in self.point_m.iter().enumerate() {
            site.number(&["point_m", &k.to_string()], x, ..)?;
        }
        let clock = site.clock(self.duration_s, self.fade_s)?;
        let home = DVector::from(site.posture("posture_rad", &self.posture_rad)?);
        let tip = Tip::new(site.robot, Point3::from(self.point_m));
        let centre = tip.position(&home);

        let mut count = POSTURES[0];
        loop {
            let curve = self.curve(site, &tip, &home, count)?;
            // The farthest from the figure are the points between two postures.
            let worst = self.farthest(&tip, &centre, &curve, count);
            if worst.1 < TOLERANCE_M {
                return site.part(Curve::Harmonics(curve), clock);
            }
            if count >= POSTURES[1] {
                return Err(self.unreachable(site, &centre, worst.0, worst.1));
            }
            count *= 2;
        }
    }

    /// The series through `count` postures of one cycle.
    fn curve(
        &self,
        site: &Site,
        tip: &Tip,
        home: &DVector<f64>,
        count: usize,
    ) -> Result<Harmonics, MotionError> {
        let centre = tip.position(home);
        let mut samples = vec![Vec::with_capacity(count); home.len()];
        let mut q = home.clone();
        for k in 0..count {
            let share = k as f64 / count as f64;
            let (posture, miss) = tip.reach(&self.point(&centre, share), &q, home);
            if miss > REACHED_M {
                return Err(self.unreachable(site, &centre, share, miss));
            }
            q = posture;
            samples.iter_mut().zip(q.iter()).for_each(|(list, &q)| list.push(q));
        }
        let series = samples.iter().map(|list| HarmonicSeries::through(list, self.cycle_hz));
        Ok(Harmonics { joints: series.collect() })
    }

    /// Where the figure is missed the most, and by how much (m).
    fn farthest(
        &self,
        tip: &Tip,
        centre: &Point3<f64>,
        curve: &Harmonics,
        count: usize,
    ) -> (f64, f64) {
        let miss = |k: usize| {
            let share = (k as f64 + 0.5) / count as f64;
            let joints = 0..curve.joints.len();
            let q: Vec<f64> = joints.map(|j| curve.at(j, share / self.cycle_hz)[0]).collect();
            (share, (self.point(centre, share) - tip.position(&DVector::from(q))).norm())
        };
        (0..count)
            .map(miss)
            .fold((0.0, 0.0), |worst, here| if here.1 > worst.1 { here } else { worst })
    }

    /// The point of the figure after a share of a cycle (m, base frame).
    fn point(&self, centre: &Point3<f64>, share: f64) -> Point3<f64> {
        let (sin, cos) = (TAU * share).sin_cos();
        let (first, second) = match self.figure {
            Figure::Circle => (cos, sin),
            Figure::Eight => (sin, sin * cos),
            Figure::Line => (sin, 0.0),
        };
        let (u, v) = match self.plane {
            Plane::Xy => (Vector3::x(), Vector3::y()),
            Plane::Yz => (Vector3::y(), Vector3::z()),
            Plane::Zx => (Vector3::z(), Vector3::x()),
        };
        centre + self.radius_m * (first * u + second * v)
    }

    fn unreachable(
        &self,
        site: &Site,
        centre: &Point3<f64>,
        share: f64,
        miss_m: f64,
    ) -> MotionError {
        let point_m = self.point(centre, share).coords.into();
        MotionError::Unreachable { key: site.key(&["radius_m"]), point_m, share, miss_m }
    }
}
