use crate::feedforward::TorquePrediction;
use crate::predictor::Delivery;
use crate::settings::TrackingSettings;
use crate::watch::{Event, Level};

/// The newest prediction and how far it is trusted.
///
/// ```text
/// used = weight * newest,   d weight / dt = 1 / fade_s while trusted, -1 / fade_s otherwise
/// ```
///
/// with the weight between 0 and 1.
#[derive(Debug)]
pub(crate) struct Trust {
    settings: TrackingSettings,
    period_s: f64,
    newest: TorquePrediction,
    /// When its reference was taken (s); none without a prediction.
    asked_s: Option<f64>,
    arrived_s: f64,
    condition: Condition,
    weight: f64,
    used: TorquePrediction,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Condition {
    Trusted,
    /// Nothing new for too long.
    Stalled,
    /// The last prediction was not finite, at this time (s).
    Unusable(f64),
    Dead,
}

impl Trust {
    /// Before the first prediction.
    pub fn new(settings: &TrackingSettings, period_s: f64, joints: usize) -> Self {
        Self {
            settings: *settings,
            period_s,
            newest: TorquePrediction::zero(joints),
            asked_s: None,
            arrived_s: 0.0,
            condition: Condition::Trusted,
            weight: 0.0,
            used: TorquePrediction::zero(joints),
        }
    }

    /// Takes the prediction made before the run, if there is one: it counts in full at once.
    pub fn begin(&mut self, delivered: Option<&mut Delivery>) -> Option<Event> {
        let event = match delivered {
            Some(delivery) => self.take(0.0, delivery),
            None => {
                self.condition = Condition::Stalled;
                Some(self.distrust_event(0.0, "there is no prediction to begin with"))
            }
        };
        if self.condition == Condition::Trusted {
            self.weight = 1.0;
        }
        event
    }

    /// One tick: takes what arrived, if anything did, and puts what is to be used in place.
    pub fn tick(&mut self, time_s: f64, delivered: Option<&mut Delivery>) -> Option<Event> {
        let taken = delivered.and_then(|delivery| self.take(time_s, delivery));
        let event = taken.or_else(|| self.wait(time_s));
        let scale = |used: &mut [f64], newest: &[f64]| {
            for (used, newest) in used.iter_mut().zip(newest) {
                *used = self.weight * newest;
            }
        };
        scale(&mut self.used.tau, &self.newest.tau);
        scale(&mut self.used.q_lead, &self.newest.q_lead);
        scale(&mut self.used.qd_lead, &self.newest.qd_lead);
        let step = self.period_s / self.settings.fade_s;
        let step = if self.condition == Condition::Trusted { step } else { -step };
        self.weight = (self.weight + step).clamp(0.0, 1.0);
        event
    }

    /// The feedforward of this tick.
    pub fn feedforward(&self) -> &TorquePrediction {
        &self.used
    }

    /// Time since the newest prediction's reference was taken (s).
    pub fn age_s(&self, time_s: f64) -> Option<f64> {
        self.asked_s.map(|asked_s| time_s - asked_s)
    }

    fn take(&mut self, time_s: f64, delivery: &mut Delivery) -> Option<Event> {
        if let Some(because) = delivery.died.take() {
            self.condition = Condition::Dead;
            return Some(self.distrust_event(time_s, &format!("the predictor died ({because})")));
        }
        if !delivery.prediction.is_usable(self.newest.tau.len()) {
            let known = matches!(self.condition, Condition::Unusable(_));
            self.condition = Condition::Unusable(time_s);
            let words = "a prediction is not one finite number a joint";
            return (!known).then(|| self.distrust_event(time_s, words));
        }
        std::mem::swap(&mut self.newest, &mut delivery.prediction);
        self.asked_s = Some(delivery.asked_s);
        self.arrived_s = time_s;
        (self.condition == Condition::Stalled).then(|| self.regain_trust(time_s))
    }

    /// What time alone changes.
    fn wait(&mut self, time_s: f64) -> Option<Event> {
        let TrackingSettings { stall_s, .. } = self.settings;
        // Times of ticks are rounded.
        let patience_s = stall_s + 1e-6 * self.period_s;
        match self.condition {
            Condition::Trusted if time_s - self.arrived_s > patience_s => {
                self.condition = Condition::Stalled;
                let words = format!("no new prediction for {stall_s} s");
                Some(self.distrust_event(time_s, &words))
            }
            // As long without a bad prediction as a good one may take to come.
            Condition::Unusable(since) if time_s - since > patience_s && self.arrived_s > since => {
                Some(self.regain_trust(time_s))
            }
            _ => None,
        }
    }

    fn distrust_event(&self, time_s: f64, found: &str) -> Event {
        let TrackingSettings { fade_s, .. } = self.settings;
        let words = match self.asked_s {
            Some(_) => format!("{found}: the last fades to zero over {fade_s} s"),
            None => format!("{found}: there is none to use"),
        };
        Event { time_s, level: Level::Warning, words: words + ", the feedback goes on" }
    }

    fn regain_trust(&mut self, time_s: f64) -> Event {
        self.condition = Condition::Trusted;
        let words = format!("predictions fade in over {} s", self.settings.fade_s);
        Event { time_s, level: Level::Info, words }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD_S: f64 = 0.01;

    fn delivery(tau: f64) -> Delivery {
        let prediction = TorquePrediction { tau: vec![tau], ..TorquePrediction::zero(1) };
        Delivery { asked_s: 0.0, prediction, died: None }
    }

    /// The torque used in every tick, and the events, when `arrives` says what comes in each.
    fn torque_and_events(arrives: impl Fn(usize) -> Option<Delivery>) -> (Vec<f64>, Vec<Event>) {
        let mut trust = Trust::new(&TrackingSettings::default(), PERIOD_S, 1);
        let mut events = Vec::from_iter(trust.begin(Some(&mut delivery(2.0))));
        let mut tick = |k: usize| {
            events.extend(trust.tick(k as f64 * PERIOD_S, arrives(k).as_mut()));
            trust.feedforward().tau[0]
        };
        ((0..200).map(&mut tick).collect(), events)
    }

    fn tick_of(event: &Event) -> usize {
        (event.time_s / PERIOD_S).round() as usize
    }

    /// Whether what is used goes from 2 to 0 within 50 ticks, or back.
    fn assert_fades(used: &[f64], from: f64, per_tick: f64) {
        for (k, used) in used.iter().enumerate() {
            let expected = (from + per_tick * k as f64).clamp(0.0, 2.0);
            assert!((used - expected).abs() < 1e-12, "{k} ticks on: {used}");
        }
    }

    #[test]
    fn a_stall_fades_out_and_what_comes_after_it_fades_in() {
        let (used, events) = torque_and_events(|k| (k <= 10 || k >= 120).then(|| delivery(2.0)));
        let told: Vec<_> = events.iter().map(|e| (tick_of(e), e.level)).collect();
        assert_eq!(told, [(21, Level::Warning), (120, Level::Info)]);
        assert_fades(&used[..21], 2.0, 0.0);
        assert_fades(&used[21..120], 2.0, -0.04);
        assert_fades(&used[120..], 0.0, 0.04);
    }

    #[test]
    fn a_death_fades_out_at_once_and_for_good() {
        let died = || Some(Delivery { died: Some("gone".to_owned()), ..delivery(5.0) });
        let (used, events) =
            torque_and_events(|k| if k == 30 { died() } else { Some(delivery(2.0)) });
        assert_eq!(events.len(), 1, "{events:?}");
        assert!(events[0].words.contains("died (gone)"), "{}", events[0].words);
        assert_fades(&used[30..], 2.0, -0.04);
    }

    #[test]
    fn what_is_not_finite_is_never_used_and_distrusted_for_the_time_of_a_stall() {
        let bad = |k| (50..60).contains(&k) && k % 2 == 0;
        let (used, events) =
            torque_and_events(|k| Some(delivery(if bad(k) { f64::NAN } else { 2.0 })));
        assert!(used.iter().all(|used| (0.0..=2.0).contains(used)));
        let told: Vec<_> = events.iter().map(|e| (tick_of(e), e.level)).collect();
        assert_eq!(told, [(50, Level::Warning), (69, Level::Info)]);
        assert_fades(&used[50..69], 2.0, -0.04);
        assert_fades(&used[69..], 2.0 - 19.0 * 0.04, 0.04);
    }

    #[test]
    fn without_a_first_prediction_a_run_begins_on_feedback_and_the_first_fades_in() {
        let mut trust = Trust::new(&TrackingSettings::default(), PERIOD_S, 1);
        assert!(trust.begin(None).unwrap().words.contains("no prediction to begin with"));
        assert!(trust.tick(0.0, None).is_none());
        assert_eq!((trust.feedforward().tau[0], trust.age_s(0.0)), (0.0, None));
        assert!(trust.tick(0.01, Some(&mut delivery(2.0))).unwrap().words.contains("fade in"));
        assert_eq!((trust.feedforward().tau[0], trust.age_s(0.01)), (0.0, Some(0.01)));
        trust.tick(0.02, Some(&mut delivery(2.0)));
        assert!((trust.feedforward().tau[0] - 0.04).abs() < 1e-15);
    }
}
