use std::{
    sync::{Condvar, Mutex, MutexGuard, PoisonError, TryLockError},
    time::Duration,
};

/// A mailbox that keeps the newest letter and drops older ones.
///
/// Letters are swapped with the other side, so that nothing is allocated.
#[derive(Debug)]
pub(crate) struct Latest<T> {
    slot: Mutex<Slot<T>>,
    changed: Condvar,
}

#[derive(Debug)]
struct Slot<T> {
    letter: T,
    is_new: bool,
    is_closed: bool,
}

impl<T> Latest<T> {
    /// An empty mailbox; `letter` is swapped for the first one.
    pub fn new(letter: T) -> Self {
        let slot = Slot { letter, is_new: false, is_closed: false };
        Self { slot: Mutex::new(slot), changed: Condvar::new() }
    }

    /// Leaves a letter.
    pub fn put(&self, letter: &mut T) {
        self.slot().put(letter);
        self.changed.notify_all();
    }

    /// Leaves a letter unless the other side is at the box right now.
    pub fn try_put(&self, letter: &mut T) {
        if let Some(mut slot) = self.try_slot() {
            slot.put(letter);
            drop(slot);
            self.changed.notify_all();
        }
    }

    /// Whether `letter` is now a new one; it is not while the other side is at the box.
    pub fn try_take(&self, letter: &mut T) -> bool {
        self.try_slot().is_some_and(|mut slot| slot.take(letter))
    }

    /// Waits until `letter` is a new one, or gives up: the box was closed.
    pub fn wait(&self, letter: &mut T) -> bool {
        let waits = |slot: &mut Slot<T>| !(slot.is_new || slot.is_closed);
        let slot = self.changed.wait_while(self.slot(), waits);
        let mut slot = slot.unwrap_or_else(PoisonError::into_inner);
        !slot.is_closed && slot.take(letter)
    }

    /// Waits until `letter` is a new one, or gives up after some time.
    pub fn wait_for(&self, letter: &mut T, time: Duration) -> bool {
        let waits = |slot: &mut Slot<T>| !slot.is_new;
        let waited = self.changed.wait_timeout_while(self.slot(), time, waits);
        waited.unwrap_or_else(PoisonError::into_inner).0.take(letter)
    }

    /// Closes the mailbox: no more letters will come.
    pub fn close(&self) {
        self.slot().is_closed = true;
        self.changed.notify_all();
    }

    fn slot(&self) -> MutexGuard<'_, Slot<T>> {
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn try_slot(&self) -> Option<MutexGuard<'_, Slot<T>>> {
        match self.slot.try_lock() {
            Ok(slot) => Some(slot),
            Err(TryLockError::Poisoned(slot)) => Some(slot.into_inner()),
            Err(TryLockError::WouldBlock) => None,
        }
    }
}

impl<T> Slot<T> {
    fn put(&mut self, letter: &mut T) {
        std::mem::swap(&mut self.letter, letter);
        self.is_new = true;
    }

    fn take(&mut self, letter: &mut T) -> bool {
        let is_new = std::mem::take(&mut self.is_new);
        if is_new {
            std::mem::swap(&mut self.letter, letter);
        }
        is_new
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_newest_letter_is_found_and_only_once() {
        let latest = Latest::new(0);
        let mut letter = 0;
        assert!(!latest.try_take(&mut letter));
        latest.put(&mut 1);
        latest.try_put(&mut 2);
        assert!(latest.try_take(&mut letter) && letter == 2);
        assert!(!latest.try_take(&mut letter));
        assert!(!latest.wait_for(&mut letter, Duration::ZERO));
    }

    #[test]
    fn nobody_waits_at_a_box_in_use_or_at_a_closed_one() {
        let latest = Latest::new(0);
        let held = latest.slot();
        latest.try_put(&mut 1);
        assert!(!latest.try_take(&mut 0));
        drop(held);
        assert!(!latest.try_take(&mut 0), "the letter was not left");
        std::thread::scope(|scope| {
            let waits = scope.spawn(|| latest.wait(&mut 0));
            latest.close();
            assert!(!waits.join().unwrap());
        });
    }

    #[test]
    fn a_letter_wakes_who_waits_for_it() {
        let latest = Latest::new(0);
        std::thread::scope(|scope| {
            let waits = scope.spawn(|| {
                let mut letter = 0;
                (latest.wait(&mut letter), letter)
            });
            latest.put(&mut 7);
            assert_eq!(waits.join().unwrap(), (true, 7));
        });
    }
}
