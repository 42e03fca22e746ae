//! Ends the program where an input keeps it at work without an end. What counts is time on the processor: a program that
//! waits for its turn beside others is no slower for it.

use std::fs::{self, File};
use std::io::{Read, Seek};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Work of the whole program, on all its threads, after which an input hangs (s of processor).
const MOST_S: f64 = 240.0;
/// Between two looks, each of which takes the processor for a tenth of an input.
const PAUSE: Duration = Duration::from_millis(500);

/// Watches one thread that takes inputs one after the other.
#[derive(Debug)]
pub struct Watch {
    current: Arc<Current>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug, Default)]
struct Current {
    /// Inputs that were begun.
    begun: AtomicU64,
    /// The seed of the last of them.
    seed: AtomicU64,
    is_over: AtomicBool,
}

impl Watch {
    /// Begins to watch over a reader.
    pub fn start(reader: &str) -> Self {
        let current = Arc::new(Current::default());
        let (watched, reader) = (Arc::clone(&current), reader.to_owned());
        let thread = thread::spawn(move || {
            let mut patience = Patience::default();
            while !watched.is_over.load(Ordering::Acquire) {
                // Where the system does not tell it, nothing is watched.
                let Some(work_s) = processor_s() else { return };
                if patience.is_at_its_end(watched.begun.load(Ordering::Acquire), work_s) {
                    let seed = watched.seed.load(Ordering::Acquire);
                    eprintln!("{reader}: seed {seed} takes over {MOST_S} s of processor");
                    std::process::abort();
                }
                thread::park_timeout(PAUSE);
            }
        });
        Self { current, thread: Some(thread) }
    }

    /// An input begins.
    pub fn begin(&self, seed: u64) {
        self.current.seed.store(seed, Ordering::Release);
        self.current.begun.fetch_add(1, Ordering::Release);
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.current.is_over.store(true, Ordering::Release);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            let _ = thread.join();
        }
    }
}

/// The input that is read, and the work of the program when it was first seen.
#[derive(Debug, Default)]
struct Patience {
    begun: u64,
    since_s: f64,
}

impl Patience {
    fn is_at_its_end(&mut self, begun: u64, work_s: f64) -> bool {
        if begun != self.begun {
            *self = Self { begun, since_s: work_s };
        }
        begun > 0 && work_s - self.since_s > MOST_S
    }
}

/// Time of all threads of this program on the processor (s; utime and stime of proc(5), in hundredths), where the system
/// tells it.
pub fn processor_s() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // The second field is a name in parentheses.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |at: usize| fields.get(at)?.parse::<u64>().ok();
    Some((ticks(11)? + ticks(12)?) as f64 / 100.0)
}

/// Time of a thread on the processor (schedstat of proc(5), in ns), where the system tells it.
#[derive(Debug)]
pub struct ThreadClock(Option<File>);

impl ThreadClock {
    /// That of this thread.
    pub fn of_this_thread() -> Self {
        Self(File::open("/proc/thread-self/schedstat").ok())
    }

    /// The time until now.
    pub fn now(&mut self) -> Option<Duration> {
        let file = self.0.as_mut()?;
        let mut text = [0; 64];
        file.rewind().ok()?;
        let length = file.read(&mut text).ok()?;
        let first = text[..length].split(|byte| *byte == b' ').next()?;
        std::str::from_utf8(first).ok()?.parse().ok().map(Duration::from_nanos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patience_begins_anew_with_every_input() {
        let mut patience = Patience::default();
        assert!(!patience.is_at_its_end(0, 2.0 * MOST_S), "no input yet");
        assert!(!patience.is_at_its_end(1, 2.0 * MOST_S));
        assert!(!patience.is_at_its_end(1, 3.0 * MOST_S));
        assert!(!patience.is_at_its_end(2, 3.5 * MOST_S));
        assert!(!patience.is_at_its_end(2, 4.5 * MOST_S));
        assert!(patience.is_at_its_end(2, 4.6 * MOST_S));
    }

    #[test]
    fn work_is_counted() {
        let mut clock = ThreadClock::of_this_thread();
        let (Some(before), Some(begun)) = (processor_s(), clock.now()) else { return };
        let mut sum = 0_u64;
        while processor_s().is_some_and(|now| now < before + 0.02) {
            sum = (0..100_000_u64).fold(sum, |sum, k| std::hint::black_box(sum ^ k));
        }
        assert!(clock.now() > Some(begun + Duration::from_millis(5)), "{sum}");
    }
}
