//! Damaged files of every kind: no panic, bounded memory, one sentence.

use logs::ReadOptions;
use logs::read_run;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support::{Scratch, two_joints};

/// What a damaged file may take beside a multiple of its length (bytes).
const MEMORY: u64 = 200 << 20;

/// Reads `count` files that a few mistakes turned these bytes into.
pub fn read_all(bytes: &[u8], options: &ReadOptions, count: u64) {
    let file = Scratch::new("run", bytes);
    let mut refused = 0;
    for seed in 0..count {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let damaged = damage(bytes, &mut random);
        std::fs::write(&file.path, &damaged).unwrap();
        let mut result = None;
        let taken = allocation_counter::measure(|| {
            result = Some(read_run(&file.path, &two_joints(), options));
        });
        let allowed = MEMORY + 1000 * damaged.len() as u64;
        assert!(taken.bytes_max < allowed, "seed {seed}: {} bytes", taken.bytes_max);
        if let Some(Err(error)) = result {
            let told = error.to_string();
            refused += 1;
            let mut sentences = told.split(". ").skip(1);
            let is_one = !sentences.any(|next| next.starts_with(char::is_uppercase));
            assert!(is_one && !told.contains(char::is_control), "seed {seed}: {told}");
            assert!(told.chars().count() < 600, "seed {seed}: {told}");
        }
    }
    assert!(refused > count / 2, "{refused} of {count} are refused");
}

/// One to four bytes are set, bits turned, pieces cut out, doubled or written over.
fn damage(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    for _ in 0..random.random_range(1..5) {
        if damaged.is_empty() {
            break;
        }
        let at = random.random_range(0..damaged.len());
        let end = (at + random.random_range(1..40)).min(damaged.len());
        match random.random_range(0..7) {
            0 => damaged.truncate(at),
            1 => damaged[at] ^= 1 << random.random_range(0..8),
            2 => damaged[at] = random.random(),
            3 => drop(damaged.drain(at..end)),
            4 => {
                let piece = damaged[at..end].to_vec();
                damaged.splice(at..at, piece);
            }
            5 => damaged[at..end].fill([0, 0xff, 0x7f, 0x80][random.random_range(0..4)]),
            _ => {
                let other = random.random_range(0..damaged.len());
                let length = (end - at).min(damaged.len() - other);
                damaged.copy_within(at..at + length, other);
            }
        }
    }
    damaged
}
