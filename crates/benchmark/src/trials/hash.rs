use std::fmt::Write as _;

use sha2::{Digest, Sha256};

/// Seed of a trial: the first 63 bits of a hash, which fit into an integer of TOML.
pub(crate) fn seed_of(seed: u64, kind: &str, number: usize) -> u64 {
    let digest = Sha256::digest(format!("{seed}/{kind}/{number}"));
    digest.iter().take(8).fold(0, |bits, byte| bits << 8 | u64::from(*byte)) >> 1
}

/// SHA-256 of a text, in hexadecimal.
pub(crate) fn hexadecimal(text: &str) -> String {
    Sha256::digest(text).iter().fold(String::new(), |mut all, byte| {
        // A String takes everything.
        let _ = write!(all, "{byte:02x}");
        all
    })
}
