use logs::Run;
use robot::Robot;
use serde::Serialize;

use crate::account::place_account::{LookedFor, PlaceAccount};
use crate::diagnose::{Logs, with_inputs};
use crate::error::DiagnosisError;
use crate::outcome::effect_at::effect_at;
use crate::outcome::second_encoder::with_encoder_inputs;
use crate::outcome::torque_noise::TorqueNoise;
use crate::progress::Silent;
use crate::readiness::extent::range;
use crate::result::EffectAt;
use crate::search::inputs::Inputs;
use crate::settings::Settings;

/// What a search found in logs whose causes are known, and what became of each of some places.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SearchAccount {
    /// What the search found, before the tests of sizes: causes, lines of the spectrum and limits.
    pub found: Vec<EffectAt>,
    /// What these tests kept.
    pub kept: Vec<EffectAt>,
    /// Lowest and highest frequency at which lines are looked for (Hz); `None` where the logs are too slow.
    pub lines_hz: Option<[f64; 2]>,
    /// Cut-off of the low-pass (Hz).
    pub cutoff_hz: f64,
    /// The joints, in the order of the robot.
    pub joints: Vec<JointReach>,
    /// The places, in the order in which they were asked for.
    pub places: Vec<PlaceAccount>,
}

/// How a joint moved, and the known noise of its effort.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointReach {
    /// Name of the joint.
    pub name: String,
    /// Range of motion (rad or m).
    pub range: f64,
    /// RMS velocity (rad/s or m/s).
    pub speed: f64,
    /// RMS in the band of the effort's own noise, as the logs show it above the motion (N·m or N).
    pub effort_noise: f64,
    /// RMS in the band of the encoders' noise, carried to torque by the arm's inertia (N·m or N).
    pub encoder_noise: f64,
}

/// Searches the logs as [`diagnose`](crate::diagnose) does, and says of every place in `places` how far it came.
/// `truth` are all true names, of which `places` may hold some. The answer of a diagnosis does not depend on it.
///
/// ```text
/// beside_truth       the other true names in the model, noise: what they or the found names leave, the less
/// with_known_noise   the same, noise of known sources: sqrt(effort_noise^2 + encoder_noise^2)
/// beside_found       what the search found in the model, noise: what this leaves
/// ```
///
/// # Errors
///
/// Those of [`diagnose`](crate::diagnose).
pub fn account_for(
    robot: &Robot,
    runs: &[Run],
    settings: &Settings,
    truth: &[EffectAt],
    places: &[EffectAt],
) -> Result<SearchAccount, DiagnosisError> {
    let logs = Logs { runs, first: None };
    let (account, _) =
        with_inputs(robot, logs, settings, &Silent, |inputs| inputs.account_for(truth, places))?;
    Ok(account)
}

impl Inputs<'_> {
    fn account_for(
        &self,
        truth: &[EffectAt],
        places: &[EffectAt],
    ) -> Result<SearchAccount, DiagnosisError> {
        let joints = self.joint_reaches();
        let noise: Vec<f64> =
            joints.iter().map(|j| j.effort_noise.hypot(j.encoder_noise)).collect();
        let of_efforts = self.compare_with_truth(truth, places, &noise)?;
        let of_encoders = with_encoder_inputs(
            &of_efforts.extended,
            self.nominal,
            self.settings,
            &self.log,
            self.inadequate,
            |twist| twist.compare_with_truth(truth, places, &[]),
        )?;
        let lines = self.log.tones.iter().map(|tone| tone.hypothesis());
        let lines: Vec<EffectAt> = lines.map(|line| effect_at(self.robot, line)).collect();
        let between = of_encoders.as_ref();
        let found = between.map_or(&[][..], |of| &of.found);
        let kept = between.map_or(&[][..], |of| &of.kept);
        Ok(SearchAccount {
            found: [&of_efforts.found, found, &lines].concat(),
            kept: [&of_efforts.kept, kept, &lines].concat(),
            lines_hz: self.lines_hz(),
            cutoff_hz: self.log.prepared.cutoff_hz,
            joints,
            places: match of_encoders {
                Some(of) => {
                    of_efforts.places.into_iter().zip(of.places).map(pick_account).collect()
                }
                None => of_efforts.places,
            },
        })
    }

    fn joint_reaches(&self) -> Vec<JointReach> {
        let prepared = self.log.prepared;
        let t = &self.thresholds().signals;
        let noise = TorqueNoise::new(self.nominal, self.design, prepared, t);
        let reach = |(j, link): (usize, &robot::Link)| {
            let speeds = || prepared.runs.iter().flat_map(|run| &run.joints[j].qd);
            let square = speeds().map(|v| v * v).sum::<f64>() / speeds().count().max(1) as f64;
            let [effort_noise, encoder_noise] = noise.sources(j);
            JointReach {
                name: link.joint.name.clone(),
                range: range(prepared, j),
                speed: square.sqrt(),
                effort_noise,
                encoder_noise,
            }
        };
        self.nominal.links().iter().enumerate().map(reach).collect()
    }

    /// See [`SearchAccount::lines_hz`].
    fn lines_hz(&self) -> Option<[f64; 2]> {
        let t = &self.thresholds().tones;
        let prepared = self.log.prepared;
        let slowest = prepared.runs.iter().map(|run| run.rate_hz).fold(f64::INFINITY, f64::min);
        let wide_hz = t.cutoff_hz(slowest);
        let is_wide = wide_hz >= t.least_band * prepared.cutoff_hz;
        is_wide.then_some([t.lowest_hz, t.highest * wide_hz])
    }
}

/// Of the accounts of one place by efforts and by two encoders, that of the regression which has its columns.
fn pick_account((efforts, encoders): (PlaceAccount, PlaceAccount)) -> PlaceAccount {
    if encoders.looked_for == LookedFor::ByColumns { encoders } else { efforts }
}
