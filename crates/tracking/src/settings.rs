use crate::error;
use crate::error::TrackingError;

/// Timing of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackingSettings {
    /// The clock of the run.
    pub clock: RunClock,
    /// Time without a new prediction after which the last one is no longer trusted (s). It must be
    /// longer than a prediction takes.
    pub stall_s: f64,
    /// Time in which a prediction that is no longer trusted fades to zero, and in which one
    /// that is trusted again fades in (s).
    pub fade_s: f64,
}

/// Which time a run goes by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RunClock {
    /// The machine's time, as fast as it can be simulated, with a given time for a prediction.
    /// Every run gives the same bits.
    Virtual(VirtualClock),
    /// Wall-clock time: one tick a period of the machine, and the predictor in its own thread.
    Wall(WallClock),
}

/// The predictor's timing in a run in the machine's time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct VirtualClock {
    /// Time that a prediction takes (s); 0 for none.
    pub prediction_time_s: f64,
    /// Of which time the reference is predicted.
    pub ahead: Ahead,
    /// When the predictor dies (s), if it does.
    pub stops_at_s: Option<f64>,
}

/// The predictor's timing in a run in wall-clock time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct WallClock {
    /// Of which time the reference is predicted.
    pub ahead: Ahead,
}

/// The time whose reference a prediction is computed for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ahead {
    /// The tick at which the predictor starts.
    #[default]
    Now,
    /// The middle of the ticks at which the prediction will be used,
    ///
    /// ```text
    /// t + (n + (h - 1) / 2) T,   n = ceil(prediction time / T),   h = max(n, 1)
    /// ```
    ///
    /// for a predictor that is started again as soon as it is done. On the wall's clock the
    /// prediction time is a running mean of what was measured. The hold of a command over the
    /// period `T` is not included: the lead of the feedforward accounts for it.
    Arrival,
}

impl Default for TrackingSettings {
    /// The machine's time, predictions at once; 0.1 s to a stall, 0.5 s to fade.
    fn default() -> Self {
        Self { clock: RunClock::Virtual(VirtualClock::default()), stall_s: 0.1, fade_s: 0.5 }
    }
}

impl TrackingSettings {
    pub(crate) fn check(&self) -> Result<(), TrackingError> {
        error::not_negative(|| "the time to a stall (s)".to_owned(), self.stall_s)?;
        error::not_negative(|| "the time of a fade (s)".to_owned(), self.fade_s)?;
        if let RunClock::Virtual(clock) = self.clock {
            let time_s = clock.prediction_time_s;
            error::not_negative(|| "the time of a prediction (s)".to_owned(), time_s)?;
            if let Some(stop_s) = clock.stops_at_s {
                error::not_negative(|| "the predictor's last time (s)".to_owned(), stop_s)?;
            }
        }
        Ok(())
    }
}

impl Ahead {
    /// Periods by which the reference is ahead, for a result that is used `wait` ticks later and
    /// during `held` ticks.
    pub(crate) fn periods(self, wait: f64, held: f64) -> f64 {
        match self {
            Self::Now => 0.0,
            Self::Arrival => wait + 0.5 * (held - 1.0),
        }
    }
}
