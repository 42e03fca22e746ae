use nalgebra::DMatrix;

use crate::columns::readings::Readings;

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

/// One joint of a [`RunDesign`], all signals low-passed alike; efforts, columns and what is known of
/// efforts are those of the joint while it moves, and none while it stands.
#[derive(Debug, Clone)]
pub(crate) struct JointDesign {
    /// Samples by local columns.
    pub x: DMatrix<f64>,
    /// Measured effort (N·m or N); or what the first encoder reports beyond the position of the
    /// link (rad or m), in a design of that.
    pub measured: Vec<f64>,
    /// What tones may have in it, what became no torque and what second encoders have shown of it
    /// (N·m or N); empty where there is none of these.
    pub known: Vec<f64>,
    /// The same as the nominal robot has it.
    pub nominal: Vec<f64>,
    /// Position, velocity and acceleration.
    pub state: [Vec<f64>; 3],
    /// Whether a sample tells of the effort: two thirds of what the low-pass takes into it, or more, are of
    /// the joint while it moves. One that stands is held by any part of its dry friction.
    pub tells: Vec<bool>,
    /// Whether the joint slides: where it turns, dry friction is anything up to its level, and what is
    /// left there is nobody's fault.
    pub slides: Vec<bool>,
}

/// Least share of a run's samples in which a joint moves that moves in it.
const MOVES: f64 = 0.05;

impl RunDesign {
    /// What the logs say of it.
    pub fn readings(&self) -> Readings {
        let joints = || self.joints.iter();
        Readings {
            measured: joints().map(|joint| joint.measured.clone()).collect(),
            tells: joints().map(|joint| joint.tells.clone()).collect(),
            slides: joints().map(|joint| joint.slides.clone()).collect(),
        }
    }

    /// Which joints move.
    pub fn moves(&self) -> Vec<bool> {
        let moves = |joint: &JointDesign| {
            let tells = joint.tells.iter().filter(|t| **t).count();
            tells as f64 > MOVES * joint.tells.len() as f64
        };
        self.joints.iter().map(moves).collect()
    }
}

impl JointDesign {
    /// Of a signal of the joint, the samples that tell of its effort.
    pub fn told<'a, T: Copy>(
        &'a self,
        signal: impl IntoIterator<Item = T> + 'a,
    ) -> impl Iterator<Item = T> + 'a {
        signal.into_iter().zip(&self.tells).filter(|(_, tells)| **tells).map(|(value, _)| value)
    }

    /// Measured minus nominal effort (N·m or N).
    pub fn gap(&self) -> impl Iterator<Item = f64> + '_ {
        self.measured.iter().zip(&self.nominal).map(|(m, n)| m - n)
    }

    /// The same without the tones and without what became no torque.
    pub fn residual(&self) -> impl Iterator<Item = f64> + '_ {
        let known = self.known.iter().copied().chain(std::iter::repeat(0.0));
        self.gap().zip(known).map(|(gap, known)| gap - known)
    }
}
