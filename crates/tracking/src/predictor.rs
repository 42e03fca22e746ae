use motion::Motion;

use crate::feedforward::{Feedforward, TorquePrediction, ask};
use crate::settings::{Ahead, VirtualClock};

/// A prediction on its way to the loop.
#[derive(Debug, Clone, Default)]
pub(crate) struct Delivery {
    /// When the reference was taken (s).
    pub asked_s: f64,
    pub prediction: TorquePrediction,
    /// The reason why no prediction follows, if none does.
    pub died: Option<String>,
}

impl Delivery {
    pub fn new(joints: usize) -> Self {
        Self { asked_s: 0.0, prediction: TorquePrediction::zero(joints), died: None }
    }
}

/// Predicts beside the loop. Neither method keeps the loop waiting once the run has begun.
pub(crate) trait Predictor {
    /// Predicts the first tick, before the run; whether `delivery` now holds it.
    fn first(&mut self, delivery: &mut Delivery) -> bool;

    /// Whether `delivery` now holds a new prediction.
    fn newest(&mut self, tick: usize, delivery: &mut Delivery) -> bool;
}

/// A predictor whose predictions take a given time of the machine's.
///
/// ```text
/// starts at tick k with its reference, is used from tick k + n, starts again there
/// n = ceil(prediction_time_s / T)
/// ```
pub(crate) struct VirtualPredictor<'a> {
    feedforward: &'a mut dyn Feedforward,
    motion: &'a Motion,
    period_s: f64,
    ahead: Ahead,
    /// Ticks that a prediction takes.
    ticks: usize,
    dies_at: Option<usize>,
    dead: bool,
    /// What is being worked on, and the tick at which it is done.
    begun: Option<usize>,
    work: Delivery,
}

/// Share of a period by which rounding may delay a time behind its tick.
const ROUNDING: f64 = 1e-6;

/// The first tick at or after a time (s).
pub(crate) fn tick_from(time_s: f64, period_s: f64) -> usize {
    (time_s / period_s - ROUNDING).ceil() as usize
}

impl<'a> VirtualPredictor<'a> {
    pub fn new(
        feedforward: &'a mut dyn Feedforward,
        motion: &'a Motion,
        clock: VirtualClock,
        period_s: f64,
    ) -> Self {
        Self {
            work: Delivery::new(motion.joint_count()),
            feedforward,
            motion,
            period_s,
            ahead: clock.ahead,
            ticks: tick_from(clock.prediction_time_s, period_s),
            dies_at: clock.stops_at_s.map(|stop_s| tick_from(stop_s, period_s)),
            dead: false,
            begun: None,
        }
    }

    /// Predicts into `work`, which keeps the message of a panic.
    fn predict(&mut self, asked_s: f64, ahead_periods: f64) {
        let time_s = asked_s + ahead_periods * self.period_s;
        self.work.asked_s = asked_s;
        let asked = ask(self.feedforward, self.motion, time_s, &mut self.work.prediction);
        self.work.died = asked.err();
        self.dead = self.work.died.is_some();
    }

    /// Ticks at which a prediction is used.
    fn ticks_in_use(&self) -> f64 {
        self.ticks.max(1) as f64
    }

    fn deliver(&mut self, delivery: &mut Delivery) -> bool {
        self.begun = None;
        std::mem::swap(&mut self.work, delivery);
        true
    }
}

impl Predictor for VirtualPredictor<'_> {
    fn first(&mut self, delivery: &mut Delivery) -> bool {
        self.predict(0.0, self.ahead.periods(0.0, self.ticks_in_use()));
        self.deliver(delivery)
    }

    fn newest(&mut self, tick: usize, delivery: &mut Delivery) -> bool {
        if self.dead {
            return false;
        }
        if self.dies_at.is_some_and(|last| tick >= last) {
            self.dead = true;
            self.work.died = Some("as the clock was told".to_owned());
            return self.deliver(delivery);
        }
        let done = self.begun.is_some_and(|done| tick >= done) && self.deliver(delivery);
        if self.begun.is_some() {
            return done;
        }
        let ahead = self.ahead.periods(self.ticks as f64, self.ticks_in_use());
        self.predict(tick as f64 * self.period_s, ahead);
        if self.ticks == 0 || self.dead {
            return self.deliver(delivery);
        }
        self.begun = Some(tick.saturating_add(self.ticks));
        done
    }
}
