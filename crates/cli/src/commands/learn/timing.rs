use std::hint::black_box;
use std::time::{Duration, Instant};

use learner::{Samples, TorqueModel};

/// Predictions that are timed one by one, at least and at most, and time that more than the
/// least may take.
const QUERIES: [usize; 2] = [101, 2001];
const PATIENCE: Duration = Duration::from_millis(500);

/// Median time of one prediction for all joints, over states of `samples` in turn (us).
pub fn median_query_us(model: &dyn TorqueModel, samples: &Samples) -> f64 {
    let mut ws = model.workspace();
    let mut tau = vec![0.0; model.joints()];
    let states = samples.len().max(1);
    median_us(|index| {
        model.torque_into(&mut ws, samples.state(index % states), &mut tau);
        black_box(&mut tau);
    })
}

/// Median time of a call (us); what is called is told the number of the call.
pub fn median_us(mut call: impl FnMut(usize)) -> f64 {
    let [least, most] = QUERIES;
    // The first calls fill the caches.
    (0..least / 10).for_each(&mut call);
    let (begin, mut times) = (Instant::now(), Vec::with_capacity(most));
    while times.len() < least || times.len() < most && begin.elapsed() < PATIENCE {
        let start = Instant::now();
        call(times.len());
        times.push(1e6 * start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
