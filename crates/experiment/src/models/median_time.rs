use std::time::{Duration, Instant};

/// Least and largest number of calls that are timed, and the time after which calls beyond the least end.
const CALLS: [usize; 2] = [101, 2001];
const PATIENCE: Duration = Duration::from_millis(500);

/// Median time of a call (s). `call` receives the index of the call.
pub fn median_time_s(mut call: impl FnMut(usize)) -> f64 {
    let [least, most] = CALLS;
    // The first calls fill the caches.
    (0..least / 10).for_each(&mut call);
    let (begin, mut times) = (Instant::now(), Vec::with_capacity(most));
    while times.len() < least || times.len() < most && begin.elapsed() < PATIENCE {
        let start = Instant::now();
        call(times.len());
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
