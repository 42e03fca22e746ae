use std::path::PathBuf;

use logs::{ColumnMap, PrepareSettings, PreparedRun, ReadOptions, prepare, read_run};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::curve::Curve;
use crate::error::MotionError;
use crate::knots::Knots;
use crate::motion::ClockedCurve;
use crate::site::Site;
use crate::spec::defaults::two_seconds;
use crate::spline::smoothest;

/// The positions of a recorded log, low-passed, from its first sample to its last.
///
/// Between the samples stands the curve of least jerk through them, so that velocity and
/// acceleration are derivatives of the position at all times. The ends of the log, where
/// its filter settles, are left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Recorded {
    /// The log, of any kind that is read.
    pub file: PathBuf,
    /// Column map of a log with names or units of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<PathBuf>,
    /// Cut-off of the low-pass (Hz); chosen from the log by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff_hz: Option<f64>,
    /// Time over which the motion starts, and stops, smoothly (s). It lasts this much
    /// longer than the log.
    #[serde(default = "two_seconds")]
    pub fade_s: f64,
}

impl Recorded {
    pub(super) fn parts(&self, site: &Site) -> Result<Vec<ClockedCurve>, MotionError> {
        let wrong = |key: &str| {
            let key = site.key(&[key]);
            move |problem| MotionError::Log { key, problem: Box::new(problem) }
        };
        let map = self.map.as_ref().map(|file| ColumnMap::load(&site.folder.join(file)));
        let map = map.transpose().map_err(wrong("map"))?;
        let options = ReadOptions { map: map.as_ref(), ..ReadOptions::default() };
        let path = site.folder.join(&self.file);
        let run = read_run(&path, site.robot, &options).map_err(wrong("file"))?;
        let settings = PrepareSettings { cutoff_hz: self.cutoff_hz };
        let key = if self.cutoff_hz.is_some() { "cutoff_hz" } else { "file" };
        let prepared = prepare(&[run], &settings).map_err(wrong(key))?;
        let [run] = prepared.runs.as_slice() else {
            let found = prepared.runs.len();
            return Err(MotionError::Split { key: site.key(&["file"]), found });
        };
        let knots = through(run);
        let duration_s = knots.duration_s() + self.fade_s;
        site.short_enough(&["file"], duration_s)?;
        let clock = site.clock(duration_s, self.fade_s)?;
        site.part(Curve::Knots(knots), clock)
    }
}

/// The curve through the positions of a run, which is on a uniform clock.
fn through(run: &PreparedRun) -> Knots {
    let times: Vec<f64> = (0..run.time.len()).map(|k| k as f64 / run.rate_hz).collect();
    let mut states = vec![Vec::with_capacity(run.joints.len()); times.len()];
    for joint in &run.joints {
        let end = |k: Option<usize>| {
            let k = k.unwrap_or_default();
            [joint.qd.get(k), joint.qdd.get(k)].map(|x| x.copied().unwrap_or_default())
        };
        let ends = [end(Some(0)), end(times.len().checked_sub(1))];
        let curve = smoothest(&times, &joint.q, ends);
        states.iter_mut().zip(curve).for_each(|(state, here)| state.push(here));
    }
    Knots::new(times, states)
}
