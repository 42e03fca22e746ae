use std::path::{Path, PathBuf};

use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::MotionError;
use crate::motion::{ClockedCurve, Motion};
use crate::site::Site;
use crate::spec::chirp::Chirp;
use crate::spec::fourier::{Coefficients, Fourier};
use crate::spec::hold::Hold;
use crate::spec::ramp::Ramp;
use crate::spec::recorded::Recorded;
use crate::spec::rhythm::Rhythm;
use crate::spec::sequence;
use crate::spec::sinusoids::Sinusoids;
use crate::spec::sweep::Sweep;
use crate::spec::waypoints::Waypoints;

/// A reference motion.
///
/// Joints are named; one that is not named rests in the middle of its position range, or at
/// 0 where it has none. At a prismatic joint `rad` in a key stands for m.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MotionSpec {
    /// A superposition of sinusoids drawn from a seed.
    Sinusoids(Sinusoids),
    /// A Fourier series with given coefficients, such as an optimised excitation.
    Fourier(Fourier),
    /// One joint after the other back and forth over its range at constant speeds.
    Sweep(Sweep),
    /// From one posture to another at constant speed.
    Ramp(Ramp),
    /// Rest in a posture.
    Hold(Hold),
    /// Sines whose frequency changes from one end of a band to the other.
    Chirp(Chirp),
    /// Through given positions at given times.
    Waypoints(Waypoints),
    /// A point of the last link follows a figure again and again.
    Rhythm(Rhythm),
    /// The positions of a recorded log.
    Recorded(Recorded),
    /// Motions one after the other, each reached by a smooth move from the one before.
    Sequence(Vec<MotionSpec>),
}

impl MotionSpec {
    /// The motion for a robot; relative paths in the spec start from `folder`.
    ///
    /// # Errors
    ///
    /// Every [`MotionError`]; its key says which value of the spec is at fault.
    pub fn build(&self, robot: &Robot, folder: &Path) -> Result<Motion, MotionError> {
        let parts = self.parts(&Site::new(robot, folder))?;
        Ok(Motion::new(robot.joint_count(), parts))
    }

    /// Makes paths that start from `folder` absolute, so that the spec can be read from anywhere.
    pub fn anchor(&mut self, folder: &Path) {
        let anchored = |path: &Path| {
            let path = folder.join(path);
            path.canonicalize().unwrap_or(path)
        };
        self.files_mut().into_iter().for_each(|file| *file = anchored(file));
    }

    /// The files that it names.
    pub fn files_mut(&mut self) -> Vec<&mut PathBuf> {
        match self {
            Self::Recorded(recorded) => {
                std::iter::once(&mut recorded.file).chain(&mut recorded.map).collect()
            }
            Self::Fourier(fourier) => match &mut fourier.coefficients {
                Coefficients::File(file) => vec![file],
                Coefficients::Inline(_) => Vec::new(),
            },
            Self::Sequence(motions) => motions.iter_mut().flat_map(Self::files_mut).collect(),
            _ => Vec::new(),
        }
    }

    fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        match self {
            Self::Sinusoids(spec) => spec.parts(&site.within("sinusoids")),
            Self::Fourier(spec) => spec.parts(&site.within("fourier")),
            Self::Sweep(spec) => spec.parts(&site.within("sweep")),
            Self::Ramp(spec) => spec.parts(&site.within("ramp")),
            Self::Hold(spec) => spec.parts(&site.within("hold")),
            Self::Chirp(spec) => spec.parts(&site.within("chirp")),
            Self::Waypoints(spec) => spec.parts(&site.within("waypoints")),
            Self::Rhythm(spec) => spec.parts(&site.within("rhythm")),
            Self::Recorded(spec) => spec.parts(&site.within("recorded")),
            Self::Sequence(specs) => {
                let site = site.within("sequence");
                sequence::check(specs.len(), &site)?;
                let mut parts = Vec::new();
                for (k, spec) in specs.iter().enumerate() {
                    let site = site.within(&k.to_string());
                    sequence::append(&mut parts, spec.parts(&site)?, &site)?;
                }
                sequence::check_length(&parts, &site)?;
                Ok(parts)
            }
        }
    }
}
