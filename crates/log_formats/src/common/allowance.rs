/// Bytes that a packed log may still take when it is unpacked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Allowance {
    all: u64,
    left: u64,
}

/// Bytes that are allowed for a file of any size.
const ALWAYS: u64 = 1 << 26;
/// Bytes that are allowed per byte of the file. Measured numbers shrink to about a fifth when they are packed. A file
/// that shrinks to less than this share is refused as malicious.
const PER_BYTE: u64 = 200;
/// Most bytes that are ever allowed.
const NEVER: u64 = 1 << 33;

/// More bytes were needed than are allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Exceeded {
    /// Bytes that are allowed.
    pub allowed: u64,
}

impl Allowance {
    /// The allowance for a file of this length (bytes).
    pub(crate) fn of(length: u64) -> Self {
        let all = length.saturating_mul(PER_BYTE).saturating_add(ALWAYS).min(NEVER);
        Self { all, left: all }
    }

    /// Counts some bytes against the allowance.
    pub(crate) fn take(&mut self, bytes: u64) -> Result<(), Exceeded> {
        let exceeded = Exceeded { allowed: self.all };
        self.left = self.left.checked_sub(bytes).ok_or(exceeded)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_file_may_grow_and_a_large_one_not_without_end() {
        let mut small = Allowance::of(1000);
        assert_eq!(small.take(ALWAYS), Ok(()));
        assert_eq!(small.take(PER_BYTE * 1000), Ok(()));
        assert_eq!(small.take(1), Err(Exceeded { allowed: ALWAYS + PER_BYTE * 1000 }));
        assert_eq!(Allowance::of(u64::MAX).take(NEVER + 1), Err(Exceeded { allowed: NEVER }));
    }
}
