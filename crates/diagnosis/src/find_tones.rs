use logs::{PrepareSettings, Prepared, Run, centre_commands, prepare};
use robot::Robot;

use crate::columns::design::Design;
use crate::columns::repeats::have_one_spectrum;
use crate::columns::shapes::with_best_shapes;
use crate::error::DiagnosisError;
use crate::oscillations::lines::Oscillations;
use crate::oscillations::tones::{ToneQuestion, tones};
use crate::regression::fitted_springs::fit_trial_springs;
use crate::search::inputs::Inputs;
use crate::settings::Settings;
use crate::signals::log::Log;

/// A robot with the best trial shapes of effects, and the design about it.
#[derive(Debug)]
pub(crate) struct ShapedDesign {
    pub robot: Robot,
    pub design: Design,
}

impl ShapedDesign {
    fn new(robot: &Robot, log: &Log) -> Result<Self, DiagnosisError> {
        let mut shaped = with_best_shapes(robot, log)?;
        fit_trial_springs(&mut shaped, log)?;
        let design = Design::of_shaped(&shaped, log)?;
        Ok(Self { robot: shaped.robot, design })
    }
}

/// The search for tones in logs whose tones are unknown.
pub(crate) struct ToneSearch<'a> {
    pub nominal: &'a Robot,
    /// The robot whose efforts are subtracted.
    pub about: &'a Robot,
    pub settings: &'a Settings,
    pub log: Log<'a>,
    pub inadequate: &'a [Option<String>],
}

impl ToneSearch<'_> {
    /// The oscillations of the logs, and the design about a robot that includes them.
    ///
    /// The search for tones is repeated with the tones of the first search removed. Without them, other effects take
    /// the place of their cause, which hides some of the tones.
    ///
    /// Where the first search leaves no tone, those in the efforts that the robot as described leaves are removed: a
    /// wrong cause that took their place hides them. They are tones only if the second search leaves them as well;
    /// friction of a motion that repeats has lines too.
    pub fn find_tones(&self, runs: &[Run]) -> Result<(Oscillations, ShapedDesign), DiagnosisError> {
        let Self { nominal, about, settings, log, inadequate } = *self;
        let mut shaped = ShapedDesign::new(about, &log)?;
        let mut found = Oscillations::default();
        let mut candidates = Candidates::AlsoOfDescription;
        for _ in 0..settings.thresholds.tones.searches {
            let log = Log { tones: &found.tones, ..log };
            let ShapedDesign { robot, design } = &shaped;
            let inputs = Inputs { nominal, robot, settings, log, design, inadequate };
            let now = tones_left_by(&inputs, runs, candidates)?;
            candidates = Candidates::OfSearch;
            let has_none = now.tones.is_empty() && found.tones.is_empty();
            found = now;
            if has_none {
                break;
            }
            shaped = ShapedDesign::new(about, &Log { tones: &found.tones, ..self.log })?;
        }
        Ok((found, shaped))
    }
}

/// The residual efforts in which tones are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Candidates {
    /// Those of a search.
    OfSearch,
    /// Those of a search; where they have no tone, those of the robot as described.
    AlsoOfDescription,
}

/// The oscillations in the residual efforts, in a band much wider than that of the motion.
fn tones_left_by(
    inputs: &Inputs,
    runs: &[Run],
    candidates: Candidates,
) -> Result<Oscillations, DiagnosisError> {
    let (prepared, settings) = (inputs.log.prepared, inputs.settings);
    if wide_band_hz(prepared, settings).is_none() {
        return Ok(Oscillations::default());
    }
    let extended = inputs.extended_robot()?;
    let Some(wide) = in_wide_band(prepared, &extended, runs, settings)? else {
        return Ok(Oscillations::default());
    };
    // A line as slow as the motion may be the motion's, and a faster one too where the motion repeats.
    let motions = &inputs.design.motion;
    let all_differ = motions.len() >= 2
        && motions.iter().enumerate().all(|(r, m)| *m == r)
        && !have_one_spectrum(inputs.design.runs_to_compare(&settings.thresholds.signals));
    let slowest_hz = if all_differ { prepared.motion_hz } else { prepared.cutoff_hz };
    let (practical, open_share) = (&inputs.practical(), settings.open_share);
    let question = ToneQuestion { slowest_hz, practical, open_share };
    let mut found = tones([&extended, inputs.nominal], &wide, &inputs.log, &question)?;
    let looks_further = candidates == Candidates::AlsoOfDescription && found.tones.is_empty();
    if looks_further && extended != *inputs.nominal {
        let described = tones([inputs.nominal; 2], &wide, &inputs.log, &question)?;
        found.tones =
            described.tones.into_iter().filter(|tone| !found.is_in_a_band(tone)).collect();
    }
    Ok(found)
}

/// The cut-off of the band in which tones are looked for (Hz); `None` where it is hardly wider than that of the motion.
fn wide_band_hz(prepared: &Prepared, settings: &Settings) -> Option<f64> {
    let t = &settings.thresholds.tones;
    let slowest = prepared.runs.iter().map(|r| r.rate_hz).fold(f64::INFINITY, f64::min);
    let wide_hz = t.cutoff_hz(slowest);
    (wide_hz >= t.least_band * prepared.cutoff_hz).then_some(wide_hz)
}

/// The `prepared` ones of some runs in the band in which tones are looked for.
pub(crate) fn in_wide_band(
    prepared: &Prepared,
    robot: &Robot,
    runs: &[Run],
    settings: &Settings,
) -> Result<Option<Prepared>, DiagnosisError> {
    let Some(wide_hz) = wide_band_hz(prepared, settings) else { return Ok(None) };
    let mut wide = prepare(runs, &PrepareSettings { cutoff_hz: Some(wide_hz) })?;
    let is_known = |name: &String| prepared.runs.iter().any(|r| r.name == *name);
    wide.runs.retain(|run| is_known(&run.name));
    // Twice differentiated, the steps of an encoder at the link drown whatever is fast: the twist that was found
    // replaces it there.
    wide.runs.iter_mut().flat_map(|run| &mut run.joints).for_each(|joint| joint.link = None);
    centre_commands(robot, &mut wide.runs, settings.control_rate_hz);
    Ok(Some(wide))
}
