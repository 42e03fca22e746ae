/// How logs are cut into blocks, the unit of replication, and which blocks are held out together.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockThresholds {
    /// Fewest blocks of all logs: three for each of the five folds, and one more. The errors of the sizes come from
    /// the scores of this many blocks.
    pub fewest: usize,
    /// Number of blocks in which each joint should move, where the logs are long enough.
    pub wanted: f64,
    /// Most blocks of all logs: each costs the memory of a matrix for every joint.
    pub most: f64,
    /// Least length of a block, in autocorrelation times (1): neighbouring blocks are then nearly independent.
    pub autocorrelation_times: f64,
    /// Least length of a block (samples).
    pub fewest_samples: f64,
    /// Number of folds where parts of runs are held out; whole runs are held out in up to twice as many.
    pub folds: usize,
    /// Fewest motions of every joint for whole motions to be held out in turn: with two, each fit would know only
    /// one.
    pub fewest_motions: usize,
    /// Largest share of a joint's informative samples in one direction that a fold may withhold from its fit (1).
    pub most_held_out: f64,
    /// Least share of a joint's informative samples in one direction for that direction to count (1).
    pub least_direction: f64,
    /// Fewest blocks of a held-out stretch: the gaps around it cost the fit two blocks.
    pub fewest_in_stretch: usize,
}

impl Default for BlockThresholds {
    fn default() -> Self {
        Self {
            fewest: 16,
            wanted: 24.0,
            most: 240.0,
            autocorrelation_times: 5.0,
            fewest_samples: 2.0,
            folds: 5,
            fewest_motions: 3,
            most_held_out: 0.5,
            least_direction: 0.1,
            fewest_in_stretch: 3,
        }
    }
}
