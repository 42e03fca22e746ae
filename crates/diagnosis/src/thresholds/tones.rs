/// Which lines of the spectrum over time or position stand out, and which of them become findings.
#[derive(Debug, Clone, PartialEq)]
pub struct ToneThresholds {
    /// Cut-off of the band in which tones are looked for, as a share of the sampling rate (1).
    pub band: f64,
    /// Least cut-off of that band where the rate allows it (Hz): above the mains.
    pub band_hz: f64,
    /// Largest cut-off of that band, as a share of the sampling rate (1).
    pub widest: f64,
    /// Least width of that band, in cut-offs of the diagnosis (1): a narrower one shows nothing beyond the search.
    pub least_band: f64,
    /// Highest frequency that is searched, as a share of the cut-off of the band (1): above it the low-pass
    /// attenuates too much.
    pub highest: f64,
    /// Lowest frequency that is searched (Hz).
    pub lowest_hz: f64,
    /// Fewest waves over the range of motion: with fewer, any dependence on position looks like a wave.
    pub fewest_waves: f64,
    /// Most waves over the range of motion.
    pub most_waves: f64,
    /// Most tones of one joint.
    pub most_tones: usize,
    /// Number of searches for tones where there are any: other effects at first take the place of some tones, which
    /// hides them.
    pub searches: usize,
    /// Least surprisal of a line in noise, over all runs in which the joint moves (nats): one of `exp(20)` frequencies of
    /// noise exceeds it. With 40 instead of 20, one cause less in 18 trials.
    pub above_spectrum: f64,
    /// Largest difference between the frequencies of two lines that count as one, over that of the stronger (1).
    pub one_line: f64,
    /// Least amplitude of a tone over its amplitude in another run (1), for it to be the same tone. Without it, a law
    /// that is in no catalogue becomes a disturbance (`tests/diagnosis/constant.rs`).
    pub same_in_runs: f64,
    /// Least amplitude of the common fit over the least amplitude in a run (1), for the runs to share a phase.
    pub same_phase: f64,
    /// Largest difference between the frequencies of lines of one band, over that of the strongest (1): a third of an
    /// octave. The lines of the UR10's elbow lie between .94 and 1.20 of the strongest.
    pub one_band: f64,
    /// Fewest lines of a band that are further apart than [`Self::one_line`]: two may be two tones.
    pub band_lines: usize,
    /// Ratio of the amplitudes of a weaker and a stronger line of a band, above which they are a band that rings
    /// (1).
    pub ringing: f64,
    /// Least length of the mean of the unit phasors of all runs for a phase to be reported (1).
    pub common_phase: f64,
    /// Least share (RMS, 1) of the residual in the band of the diagnosis that a tone there must explain: an effect
    /// that is not found also has lines in that band, from the motion.
    pub share_in_band: f64,
    /// Least share (power, 1) of the residual in every window that a tone as slow as the motion must explain. With
    /// .25, five false findings more in 18 trials.
    pub share_of_slow: f64,
    /// Share (power, 1) of a joint's velocity at the frequency of a slow tone above which the tone may come from the
    /// motion.
    pub share_of_motion: f64,
    /// Cut-off of what a slow tone is compared with, in bandwidths of the motion (1).
    pub slow_band: f64,
    /// Most power of a tone over that of the difference between measured and nominal effort in the same band (1). What is
    /// larger is made up by a wrong cause that the tone cancels.
    pub most_of_gap: f64,
    /// Length of a window in which a slow tone is compared, in periods of the tone (1).
    pub window_periods: f64,
    /// Least length of such a window (s).
    pub window_s: f64,
    /// Fewest windows in which no joint moves at the frequency of a slow tone.
    pub fewest_still: usize,
}

impl Default for ToneThresholds {
    fn default() -> Self {
        Self {
            band: 0.1,
            band_hz: 60.0,
            widest: 0.45,
            least_band: 1.5,
            highest: 0.85,
            lowest_hz: 0.3,
            fewest_waves: 8.0,
            most_waves: 1000.0,
            most_tones: 3,
            searches: 2,
            above_spectrum: 20.0,
            one_line: 0.05,
            one_band: 0.26,
            band_lines: 3,
            same_in_runs: 0.5,
            same_phase: 0.5,
            ringing: 0.5,
            common_phase: 0.95,
            share_in_band: 0.5,
            share_of_slow: 0.5,
            share_of_motion: 0.5,
            slow_band: 2.0,
            most_of_gap: 2.0,
            window_periods: 4.0,
            window_s: 2.0,
            fewest_still: 2,
        }
    }
}

impl ToneThresholds {
    /// Cut-off of the band in which tones are looked for, in logs of a sampling rate (Hz).
    pub(crate) fn cutoff_hz(&self, rate_hz: f64) -> f64 {
        (self.band * rate_hz).max(self.band_hz.min(self.widest * rate_hz))
    }
}
