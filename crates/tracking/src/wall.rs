use std::{
    thread,
    time::{Duration, Instant},
};

use motion::Motion;

use crate::feedforward::{Feedforward, ask};
use crate::latest::Latest;
use crate::pace::{Pace, WallPace};
use crate::predictor::{Delivery, Predictor};
use crate::settings::{Ahead, WallClock};
use crate::timing::{Latency, WallClockTiming};
use crate::tracking::End;

/// Longest wait for the prediction before the run (s).
const FIRST_S: f64 = 5.0;
/// Weight of the newest latency in the running mean.
const NEWEST: f64 = 0.05;

/// A tick that asks for a prediction.
#[derive(Debug, Clone, Copy, Default)]
struct Request {
    time_s: f64,
    /// When it began; none before the run.
    began: Option<Instant>,
}

/// Runs `go` with a predictor in a thread of its own, which has ended when this returns.
pub(crate) fn on_the_wall(
    feedforward: &mut dyn Feedforward,
    motion: &Motion,
    clock: WallClock,
    period_s: f64,
    go: impl FnOnce(&mut dyn Predictor, &mut Pace) -> End,
) -> (End, WallClockTiming) {
    let requests = Latest::new(Request::default());
    let answers = Latest::new(Delivery::new(motion.joint_count()));
    let mut pace = Pace::Wall(WallPace::new(Duration::from_secs_f64(period_s)));
    let mut latencies_s = Vec::new();
    let end = thread::scope(|scope| {
        let mut server = Server {
            feedforward,
            motion,
            ahead: clock.ahead,
            period_s,
            mean_s: 0.0,
            latencies_s: &mut latencies_s,
        };
        let (requests, answers) = (&requests, &answers);
        scope.spawn(move || server.serve(requests, answers));
        // Also when `go` panics: the scope waits for the thread.
        let _closing = Closing(requests);
        go(&mut WallPredictor { requests, answers, period_s }, &mut pace)
    });
    let kept = match pace {
        Pace::Wall(pace) => pace.timing(),
        Pace::Free => WallClockTiming::default(),
    };
    let latency = Latency::of(&latencies_s);
    (end, WallClockTiming { predictions: latencies_s.len(), latency, ..kept })
}

struct Closing<'a>(&'a Latest<Request>);

impl Drop for Closing<'_> {
    fn drop(&mut self) {
        self.0.close();
    }
}

/// The loop's side of the predictor.
struct WallPredictor<'a> {
    requests: &'a Latest<Request>,
    answers: &'a Latest<Delivery>,
    period_s: f64,
}

impl Predictor for WallPredictor<'_> {
    fn first(&mut self, delivery: &mut Delivery) -> bool {
        self.requests.put(&mut Request::default());
        self.answers.wait_for(delivery, Duration::from_secs_f64(FIRST_S))
    }

    fn newest(&mut self, tick: usize, delivery: &mut Delivery) -> bool {
        let time_s = tick as f64 * self.period_s;
        self.requests.try_put(&mut Request { time_s, began: Some(Instant::now()) });
        self.answers.try_take(delivery)
    }
}

/// The predictor's side, in its own thread.
struct Server<'a> {
    feedforward: &'a mut dyn Feedforward,
    motion: &'a Motion,
    ahead: Ahead,
    period_s: f64,
    /// Running mean of the latency (s).
    mean_s: f64,
    latencies_s: &'a mut Vec<f64>,
}

impl Server<'_> {
    /// Answers the newest request until there are no more, or it dies.
    fn serve(&mut self, requests: &Latest<Request>, answers: &Latest<Delivery>) {
        let mut delivery = Delivery::new(self.motion.joint_count());
        let mut request = Request::default();
        while requests.wait(&mut request) {
            let time_s = request.time_s + self.ahead_periods(&request) * self.period_s;
            let asked = ask(self.feedforward, self.motion, time_s, &mut delivery.prediction);
            delivery.asked_s = request.time_s;
            delivery.died = asked.err();
            let died = delivery.died.is_some();
            if let Some(began) = request.began.filter(|_| !died) {
                self.note(began.elapsed().as_secs_f64());
            }
            answers.put(&mut delivery);
            if died {
                return;
            }
        }
    }

    fn ahead_periods(&self, request: &Request) -> f64 {
        let ticks = (self.mean_s / self.period_s).ceil().max(1.0);
        let wait = if request.began.is_some() { ticks } else { 0.0 };
        self.ahead.periods(wait, ticks)
    }

    fn note(&mut self, latency_s: f64) {
        let weight = if self.latencies_s.is_empty() { 1.0 } else { NEWEST };
        self.mean_s += weight * (latency_s - self.mean_s);
        self.latencies_s.push(latency_s);
    }
}

#[cfg(test)]
mod tests {
    use std::{
        sync::mpsc::{Receiver, Sender, channel},
        time::Instant,
    };

    use motion::Motion;
    use robot::{Machine, MachineFault, Reading};

    use super::*;
    use crate::rows::Signal;
    use crate::settings::{RunClock, TrackingSettings};
    use crate::testing::{Of, PERIOD_S, TestPlant, controller, rest, slider};
    use crate::track;
    use crate::tracking::Tracking;
    use crate::watch::Level;

    const TICKS: usize = 200;

    fn motion() -> Motion {
        rest(&slider(), 0.5, TICKS as f64 * PERIOD_S)
    }

    fn run(machine: &mut dyn Machine, feedforward: &mut dyn Feedforward, ahead: Ahead) -> Tracking {
        let settings = TrackingSettings {
            clock: RunClock::Wall(WallClock { ahead }),
            ..TrackingSettings::default()
        };
        track(machine, &motion(), &controller(90.0, 20.0), feedforward, &settings, &mut ()).unwrap()
    }

    /// Says when its last tick is over.
    struct Telling(TestPlant, usize, Sender<()>);

    impl Machine for Telling {
        fn joint_count(&self) -> usize {
            self.0.joint_count()
        }

        fn period_s(&self) -> f64 {
            self.0.period_s()
        }

        fn read(&mut self, reading: &mut Reading) -> Result<(), MachineFault> {
            self.0.read(reading)
        }

        fn actuate(&mut self, effort: &[f64]) -> Result<(), MachineFault> {
            self.1 += 1;
            if self.1 == TICKS {
                self.2.send(()).unwrap();
            }
            self.0.actuate(effort)
        }
    }

    /// Answers at once before the run, then once the last tick is over.
    fn once(over: Receiver<()>, in_vain: Sender<()>) -> impl FnMut(f64) -> f64 + Send {
        let mut asked = 0;
        move |_| {
            asked += 1;
            if asked == 2 && over.recv_timeout(Duration::from_secs(60)).is_err() {
                in_vain.send(()).unwrap();
            }
            4.0
        }
    }

    #[test]
    fn the_feedback_does_not_wait_for_a_predictor_that_waits_for_the_end_of_the_run() {
        let ((tell, over), (in_vain, waited)) = (channel(), channel());
        let mut machine = Telling(TestPlant::slider(&motion()), 0, tell);
        let tracking = run(&mut machine, &mut Of(once(over, in_vain)), Ahead::Now);
        assert!(waited.try_recv().is_err(), "the feedback waited for the predictor");
        assert_eq!((tracking.end, tracking.rows.len()), (End::Complete, TICKS));
        assert_eq!(tracking.timing.updates_missed, TICKS);
        // Stalled after 0.1 s: 0.4 s - 0.1 s of a fade of 0.5 s, and the slider is pushed back.
        assert_eq!(tracking.events.len(), 1, "{:?}", tracking.events);
        assert!(tracking.events[0].words.contains("no new prediction for 0.1 s"));
        let last = tracking.rows.row(TICKS - 1, Signal::Feedforward)[0];
        assert!((last - 4.0 * (1.0 - (TICKS - 1 - 51) as f64 * PERIOD_S / 0.5)).abs() < 1e-9);
        assert!(tracking.rows.row(TICKS - 1, Signal::Feedback)[0] < -1.0);
        let ages = tracking.rows.age_s().zip(tracking.rows.time_s());
        assert!(ages.clone().all(|(age, time)| age.to_bits() == time.to_bits()));
    }

    #[test]
    fn a_tick_lasts_a_period_and_predictions_are_of_ticks_gone_by() {
        let motion = motion();
        let started = Instant::now();
        let tracking = run(&mut TestPlant::slider(&motion), &mut Of(|time_s| time_s), Ahead::Now);
        // Never faster; how much slower depends on what else the computer does.
        assert!(started.elapsed().as_secs_f64() > (TICKS - 2) as f64 * PERIOD_S);
        let rows = &tracking.rows;
        let predicted = rows.column(Signal::Feedforward, 0);
        for ((time, age), of) in rows.time_s().zip(rows.age_s()).zip(predicted) {
            assert!(age >= 0.0 && (time - age - of).abs() < 1e-12, "{of} at {time}, {age} old");
        }
        let timing = tracking.timing.wall.unwrap();
        let latency = timing.latency;
        assert!(timing.predictions > 0 && latency.median_s > 0.0);
        assert!(latency.median_s <= latency.p99_s && latency.p99_s <= latency.max_s);
        assert!(timing.deadlines_missed_share <= timing.late_share && timing.late_share <= 1.0);
    }

    #[test]
    fn a_prediction_for_its_arrival_is_at_least_a_period_ahead() {
        let feedforward = &mut Of(|time_s| time_s);
        let tracking = run(&mut TestPlant::slider(&motion()), feedforward, Ahead::Arrival);
        let rows = &tracking.rows;
        let predicted = rows.column(Signal::Feedforward, 0);
        let asked = rows.time_s().zip(rows.age_s()).map(|(time, age)| time - age);
        for (of, asked) in predicted.zip(asked).filter(|(_, asked)| *asked > 0.0) {
            assert!(of - asked > PERIOD_S - 1e-12, "{of} asked for at {asked}");
        }
    }

    #[test]
    fn a_predictor_that_panics_is_told_of_and_the_run_goes_on() {
        let mut asked = 0;
        let dies = |_| {
            asked += 1;
            assert!(asked < 3, "no more");
            4.0
        };
        let tracking = run(&mut TestPlant::slider(&motion()), &mut Of(dies), Ahead::Now);
        assert_eq!((tracking.end, tracking.rows.len()), (End::Complete, TICKS));
        assert_eq!(tracking.events.len(), 1, "{:?}", tracking.events);
        assert_eq!(tracking.events[0].level, Level::Warning);
        assert!(tracking.events[0].words.contains("died (no more)"), "{:?}", tracking.events);
        assert!(tracking.rows.column(Signal::Command, 0).all(f64::is_finite));
    }
}
