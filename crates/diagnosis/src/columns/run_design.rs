use nalgebra::DMatrix;

use crate::columns::readings::Readings;
use crate::columns::stratum::Stratum;

/// One run of a [`crate::columns::design::Design`].
#[derive(Debug, Clone)]
pub(crate) struct RunDesign {
    /// Name of the run.
    pub name: String,
    /// Time (s).
    pub time: Vec<f64>,
    /// One entry a joint.
    pub joints: Vec<JointDesign>,
}

/// One joint of a [`RunDesign`], all signals low-passed alike. While the joint stands, its efforts, their known part
/// and its columns are zero.
#[derive(Debug, Clone)]
pub(crate) struct JointDesign {
    /// Samples by local columns.
    pub x: DMatrix<f64>,
    /// Measured effort (N·m or N). In a design of the twist: the position that the first encoder reports minus that
    /// of the link (rad or m).
    pub measured: Vec<f64>,
    /// Part of the effort that tones, a torque limit or second encoders explain already (N·m or N); empty where there
    /// is none.
    pub known: Vec<f64>,
    /// The same signal of the nominal robot.
    pub nominal: Vec<f64>,
    /// Position, velocity and acceleration.
    pub state: [Vec<f64>; 3],
    /// Whether a sample is informative about the effort: most of the signal that the low-pass mixes into it comes
    /// from the moving joint. While the joint stands, dry friction holds it with any part of its level.
    pub is_informative: Vec<bool>,
    /// Whether the joint slides. Near rest dry friction has any value up to its level, which no model can predict.
    pub slides: Vec<bool>,
}

impl RunDesign {
    /// The readings of the run.
    pub fn readings(&self) -> Readings {
        let joints = || self.joints.iter();
        Readings {
            measured: joints().map(|joint| joint.measured.clone()).collect(),
            is_informative: joints().map(|joint| joint.is_informative.clone()).collect(),
            slides: joints().map(|joint| joint.slides.clone()).collect(),
        }
    }

    /// Which joints move in more than a share `least` of the samples.
    pub fn moves(&self, least: f64) -> Vec<bool> {
        let moves = |joint: &JointDesign| {
            let informative = joint.is_informative.iter().filter(|t| **t).count();
            informative as f64 > least * joint.is_informative.len() as f64
        };
        self.joints.iter().map(moves).collect()
    }
}

impl JointDesign {
    /// The informative samples of a signal of the joint.
    pub fn informative<'a, T: Copy>(
        &'a self,
        signal: impl IntoIterator<Item = T> + 'a,
    ) -> impl Iterator<Item = T> + 'a {
        signal.into_iter().zip(&self.is_informative).filter(|(_, is)| **is).map(|(value, _)| value)
    }

    /// The informative samples of a signal in which the joint slides.
    pub fn sliding<'a>(&'a self, signal: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let slides = |(t, _): &(usize, &f64)| self.is_informative[*t] && self.slides[*t];
        signal.iter().enumerate().filter(slides).map(|(_, value)| *value)
    }

    /// The stratum of sample `t` of joint `j`, which these signals are of; `None` where it is not informative.
    pub fn stratum(&self, j: usize, t: usize) -> Option<Stratum> {
        let of = if self.slides[t] { Stratum::sliding } else { Stratum::near_rest };
        self.is_informative[t].then(|| of(j))
    }

    /// Measured minus nominal effort (N·m or N).
    pub fn gap(&self) -> impl Iterator<Item = f64> + '_ {
        self.measured.iter().zip(&self.nominal).map(|(m, n)| m - n)
    }

    /// The same minus the part that is explained already.
    pub fn residual(&self) -> impl Iterator<Item = f64> + '_ {
        let known = self.known.iter().copied().chain(std::iter::repeat(0.0));
        self.gap().zip(known).map(|(gap, known)| gap - known)
    }
}
