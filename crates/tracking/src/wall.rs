use std::{
    thread,
    time::{Duration, Instant},
};

use motion::Motion;

use crate::{
    Ahead, End, Feedforward, Latency, WallClock, WallTiming,
    feedforward::ask,
    latest::Latest,
    pace::{Pace, WallPace},
    predictor::{Delivery, Predictor},
};

/// Longest wait for the prediction before the run (s).
const FIRST_S: f64 = 5.0;
/// Weight of the newest latency in the running mean.
const NEWEST: f64 = 0.05;

/// A tick that asks for a prediction.
#[derive(Debug, Clone, Copy)]
struct Request {
    time_s: f64,
    asked: Instant,
    when: When,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum When {
    BeforeTheRun,
    InTheRun,
}

/// Runs `go` with a predictor in a thread of its own, which has ended when this returns.
pub(crate) fn on_the_wall(
    feedforward: &mut dyn Feedforward,
    motion: &Motion,
    clock: WallClock,
    period_s: f64,
    go: impl FnOnce(&mut dyn Predictor, &mut Pace) -> End,
) -> (End, WallTiming) {
    let asleep = Request { time_s: 0.0, asked: Instant::now(), when: When::BeforeTheRun };
    let requests = Latest::new(asleep);
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
        Pace::Free => WallTiming::default(),
    };
    let latency = Latency::of(&latencies_s);
    (end, WallTiming { predictions: latencies_s.len(), latency, ..kept })
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
        let asked = Instant::now();
        self.requests.put(&mut Request { time_s: 0.0, asked, when: When::BeforeTheRun });
        self.answers.wait_for(delivery, Duration::from_secs_f64(FIRST_S))
    }

    fn newest(&mut self, tick: usize, delivery: &mut Delivery) -> bool {
        let time_s = tick as f64 * self.period_s;
        let asked = Instant::now();
        self.requests.try_put(&mut Request { time_s, asked, when: When::InTheRun });
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
        let mut request = Request { time_s: 0.0, asked: Instant::now(), when: When::BeforeTheRun };
        while requests.wait(&mut request) {
            let ahead_s = self.ahead_periods(request.when) * self.period_s;
            let time_s = request.time_s + ahead_s;
            let asked = ask(self.feedforward, self.motion, time_s, &mut delivery.prediction);
            delivery.asked_s = request.time_s;
            delivery.died = asked.err();
            let died = delivery.died.is_some();
            if request.when == When::InTheRun && !died {
                self.note(request.asked.elapsed().as_secs_f64());
            }
            answers.put(&mut delivery);
            if died {
                return;
            }
        }
    }

    fn ahead_periods(&self, when: When) -> f64 {
        let ticks = (self.mean_s / self.period_s).ceil().max(1.0);
        match when {
            When::BeforeTheRun => self.ahead.periods(0.0, ticks),
            When::InTheRun => self.ahead.periods(ticks, ticks),
        }
    }

    fn note(&mut self, latency_s: f64) {
        self.mean_s +=
            if self.latencies_s.is_empty() { 1.0 } else { NEWEST } * (latency_s - self.mean_s);
        self.latencies_s.push(latency_s);
    }
}
