use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::curve::Curve;
use crate::error::MotionError;
use crate::harmonics::{HarmonicSeries, Harmonics, Term};
use crate::motion::ClockedCurve;
use crate::site::Site;
use crate::spec::defaults::two_seconds;

/// A Fourier series at every joint (Swevers 1997). With `w = 2 pi base_hz`,
///
/// ```text
/// q  = offset + sum_k a_k / (w k) sin(k w t) - b_k / (w k) cos(k w t)
/// qd =          sum_k a_k cos(k w t) + b_k sin(k w t)
/// ```
///
/// A run of the series is periodic between its fades, so that what is measured can be
/// averaged over periods. Joints that the series does not name rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fourier {
    /// The series, or the file that holds it.
    pub coefficients: Coefficients,
    /// Length of the motion, fades included (s).
    pub duration_s: f64,
    /// Time over which the motion starts, and stops, smoothly (s). The series itself has
    /// run for `duration_s - fade_s` in the end.
    #[serde(default = "two_seconds")]
    pub fade_s: f64,
}

/// Where a Fourier series stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Coefficients {
    /// In a TOML file of its own, with the keys of `inline`.
    File(PathBuf),
    /// Here.
    Inline(FourierSeries),
}

/// The coefficients of a Fourier series.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FourierSeries {
    /// Base frequency (Hz): one over the period.
    pub base_hz: f64,
    /// The coefficients of each joint that moves.
    pub joint: BTreeMap<String, FourierJoint>,
}

/// The coefficients of one joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FourierJoint {
    /// Position about which it swings.
    pub offset_rad: f64,
    /// Cosines of the velocity, from the base frequency up.
    pub a_rad_per_s: Vec<f64>,
    /// Sines of the velocity, as many.
    pub b_rad_per_s: Vec<f64>,
}

/// Largest file of coefficients (bytes).
const LARGEST_FILE: u64 = 1 << 20;

impl Fourier {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        site.duration(self.duration_s)?;
        let clock = site.clock(self.duration_s, self.fade_s)?;
        let site_of = |name| site.within("coefficients").within(name);
        let curve = match &self.coefficients {
            Coefficients::Inline(series) => series.curve(&site_of("inline"), self.duration_s)?,
            Coefficients::File(file) => {
                let site = site_of("file");
                let path = site.folder.join(file);
                let wrong =
                    |reason| MotionError::File { key: site.key(&[]), path: path.clone(), reason };
                let series = read(&path).map_err(wrong)?;
                // A mistake in the file is the file's: the key in the spec is that of its name.
                let inside = Site::new(site.robot, site.folder);
                series.curve(&inside, self.duration_s).map_err(|e| wrong(e.to_string()))?
            }
        };
        site.part(curve, clock)
    }
}

fn read(path: &Path) -> Result<FourierSeries, String> {
    let text = files::text(path, LARGEST_FILE).map_err(|e| e.to_string())?;
    // What is no TOML is told without its text.
    let table: toml::Table = toml::from_str(&text).map_err(|e| {
        let start = text.floor_char_boundary(e.span().map_or(0, |span| span.start));
        format!("line {} is no TOML", text[..start].matches('\n').count() + 1)
    })?;
    table.try_into().map_err(|e: toml::de::Error| e.message().to_owned())
}

impl FourierSeries {
    fn curve(&self, site: &Site, duration_s: f64) -> Result<Curve, MotionError> {
        let rest = |offset| HarmonicSeries { offset, terms: Vec::new() };
        let middle = site.posture("joint", &BTreeMap::new())?;
        let mut joints: Vec<HarmonicSeries> = middle.into_iter().map(rest).collect();
        site.frequency("base_hz", self.base_hz, duration_s)?;
        for (name, joint) in &self.joint {
            let index = site.joint_index("joint", name)?;
            let site = site.within("joint").within(name);
            let harmonics = joint.a_rad_per_s.len();
            if joint.b_rad_per_s.len() != harmonics {
                return Err(MotionError::WrongLength {
                    key: site.key(&["b_rad_per_s"]),
                    found: joint.b_rad_per_s.len(),
                    expected: format!("{harmonics} as in a_rad_per_s were"),
                });
            }
            site.frequency("a_rad_per_s", self.base_hz * harmonics.max(1) as f64, duration_s)?;
            joints[index] = joint.series(&site, self.base_hz)?;
        }
        Ok(Curve::Harmonics(Harmonics { joints }))
    }
}

impl FourierJoint {
    fn series(&self, site: &Site, base_hz: f64) -> Result<HarmonicSeries, MotionError> {
        site.number(&["offset_rad"], self.offset_rad, ..)?;
        let mut terms = Vec::new();
        for (k, (&a, &b)) in self.a_rad_per_s.iter().zip(&self.b_rad_per_s).enumerate() {
            site.number(&["a_rad_per_s", &k.to_string()], a, ..)?;
            site.number(&["b_rad_per_s", &k.to_string()], b, ..)?;
            let hz = base_hz * (k + 1) as f64;
            let w = std::f64::consts::TAU * hz;
            terms.push(Term { hz, sin: a / w, cos: -b / w });
        }
        Ok(HarmonicSeries { offset: self.offset_rad, terms })
    }
}
