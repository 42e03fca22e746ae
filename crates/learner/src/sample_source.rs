use crate::error::LearnerError;
use crate::samples::Samples;

/// Samples that are handed over at a time: 8192 of seven joints are 1.8 MB.
pub(crate) const BLOCK: usize = 8192;

/// Samples that are gone through block by block: [`Samples`] in memory, or those of a
/// [`SampleFile`](crate::SampleFile) of any length, of which no more than a block is held.
pub trait SampleSource: Sync {
    /// Number of joints.
    fn joints(&self) -> usize;

    /// Number of samples.
    fn len(&self) -> usize;

    /// Whether there is no sample.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Hands over all samples in order, a block at a time.
    ///
    /// # Errors
    ///
    /// The first of `take`, and those of reading.
    fn blocks(
        &self,
        take: &mut dyn FnMut(&Samples) -> Result<(), LearnerError>,
    ) -> Result<(), LearnerError>;

    /// At most `points` samples, evenly spread over all, as by [`Samples::thin`].
    ///
    /// # Errors
    ///
    /// Those of reading.
    fn thin(&self, points: usize) -> Result<Samples, LearnerError>;
}

impl SampleSource for Samples {
    fn joints(&self) -> usize {
        Samples::joints(self)
    }

    fn len(&self) -> usize {
        Samples::len(self)
    }

    fn blocks(
        &self,
        take: &mut dyn FnMut(&Samples) -> Result<(), LearnerError>,
    ) -> Result<(), LearnerError> {
        let n = Samples::len(self);
        for start in (0..n).step_by(BLOCK) {
            take(&self.select(start..(start + BLOCK).min(n)))?;
        }
        Ok(())
    }

    fn thin(&self, points: usize) -> Result<Samples, LearnerError> {
        Ok(self.thin(points))
    }
}
