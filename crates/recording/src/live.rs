use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::time::{Duration, Instant};

use rerun::log::LogMsg;
use rerun::sink::{GrpcSink, LogSink, SinkFlushError};

use crate::scene::{Listener, Live};

/// Longest wait for a viewer to answer.
const GREETING: Duration = Duration::from_millis(200);
/// Longest wait for a viewer to take the last messages.
const FAREWELL: Duration = Duration::from_secs(2);
/// Messages that wait for a viewer before further ones are left out.
const WAITING: usize = 4096;

/// The viewer beside the file.
///
/// The library's own sink blocks when a viewer does not keep up. Here a thread of its own
/// feeds it, from a queue that drops what does not fit.
pub(crate) enum Viewer {
    NotAsked,
    Nobody,
    Listens { left_out: Arc<AtomicU64>, done: Receiver<()> },
}

/// The end of the queue that the recording writes to.
pub(crate) struct Queue {
    sender: SyncSender<LogMsg>,
    left_out: Arc<AtomicU64>,
}

impl Viewer {
    /// Asks whether a viewer listens.
    pub fn find(live: Live) -> (Self, Option<Queue>) {
        if live == Live::Off {
            return (Self::NotAsked, None);
        }
        let address = SocketAddr::from(([127, 0, 0, 1], rerun::DEFAULT_SERVER_PORT));
        if TcpStream::connect_timeout(&address, GREETING).is_err() {
            return (Self::Nobody, None);
        }
        let left_out = Arc::new(AtomicU64::new(0));
        let (sender, waiting) = sync_channel(WAITING);
        let (finished, done) = sync_channel(1);
        std::thread::spawn(move || {
            let viewer = GrpcSink::default();
            waiting.into_iter().for_each(|message| viewer.send(message));
            // Nothing can be done about a viewer that went away; the file is the truth.
            let _ = viewer.flush_blocking(FAREWELL);
            let _ = finished.send(());
        });
        let queue = Queue { sender, left_out: left_out.clone() };
        (Self::Listens { left_out, done }, Some(queue))
    }

    /// Who listened, after the recording has closed its end of the queue.
    pub fn close(self) -> Listener {
        match self {
            Self::NotAsked => Listener::NotAsked,
            Self::Nobody => Listener::Nobody,
            Self::Listens { left_out, done } => {
                let deadline = Instant::now() + FAREWELL;
                let _ = done.recv_timeout(deadline.saturating_duration_since(Instant::now()));
                Listener::Viewer { left_out: left_out.load(Ordering::Relaxed) }
            }
        }
    }
}

impl LogSink for Queue {
    fn send(&self, message: LogMsg) {
        if self.sender.try_send(message).is_err() {
            self.left_out.fetch_add(1, Ordering::Relaxed);
        }
    }

    fn flush_blocking(&self, _: Duration) -> Result<(), SinkFlushError> {
        Ok(())
    }
}
