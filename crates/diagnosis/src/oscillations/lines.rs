use crate::signals::tone::{Beat, Tone};
use crate::thresholds::tones::ToneThresholds;

/// A band in which a joint oscillates: a process with a width, such as a resonance or vibration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RingingBand {
    /// Index of the joint.
    pub joint: usize,
    /// Lowest and highest line of the band (Hz).
    pub hz: [f64; 2],
}

/// Oscillations in the logs.
#[derive(Debug, Default)]
pub(crate) struct Oscillations {
    /// Oscillations of one period each.
    pub tones: Vec<Tone>,
    /// Bands of joints that ring.
    pub ringing: Vec<RingingBand>,
}

impl Oscillations {
    /// Adds the lines of one joint, the strongest first.
    ///
    /// Weak lines beside a strong one come from its varying amplitude and are left out. Lines of similar amplitude are
    /// a band in which the joint rings: two side by side, or three within a wider band.
    pub fn add(&mut self, lines: Vec<Tone>, t: &ToneThresholds) {
        for (i, line) in lines.iter().enumerate() {
            if lines[..i].iter().any(|stronger| are_within(t.one_line, line, stronger)) {
                continue;
            }
            let Some(hz) = frequency_hz(line) else {
                self.tones.push(line.clone());
                continue;
            };
            if self.is_in_a_band(line) {
                continue;
            }
            let least = t.ringing * line.amplitude();
            let is_similar = |weaker: &&Tone| weaker.amplitude() > least;
            let within = |width: f64| -> Vec<f64> {
                let near = lines[i + 1..].iter().filter(|weaker| are_within(width, weaker, line));
                near.filter(is_similar).filter_map(frequency_hz).collect()
            };
            let [beside, near] = [t.one_line, t.one_band].map(within);
            if beside.is_empty() && near.len() < t.band_lines - 1 {
                self.tones.push(line.clone());
                continue;
            }
            let all = beside.iter().chain(&near).copied();
            let ends = all.fold([hz, hz], |[low, high], hz| [low.min(hz), high.max(hz)]);
            self.ringing.push(RingingBand { joint: line.joint, hz: ends });
        }
    }

    /// Whether a line is inside a band in which its joint rings.
    pub fn is_in_a_band(&self, line: &Tone) -> bool {
        let of_joint = || self.ringing.iter().filter(|band| band.joint == line.joint);
        frequency_hz(line).is_some_and(|hz| of_joint().any(|band| is_in(band, hz)))
    }
}

/// Whether two lines follow the same variable and differ by less than `width` of the second.
fn are_within(width: f64, a: &Tone, b: &Tone) -> bool {
    match (a.beat, b.beat) {
        (Beat::Clock(a), Beat::Clock(b)) | (Beat::Position(a), Beat::Position(b)) => {
            (a - b).abs() < width * b
        }
        _ => false,
    }
}

/// The frequency of a line that keeps time with the clock (Hz).
fn frequency_hz(line: &Tone) -> Option<f64> {
    match line.beat {
        Beat::Clock(hz) => Some(hz),
        Beat::Position(_) => None,
    }
}

/// Whether a frequency is in a band (Hz).
fn is_in(band: &RingingBand, hz: f64) -> bool {
    (band.hz[0]..=band.hz[1]).contains(&hz)
}

#[cfg(test)]
mod tests {
    use nalgebra::Complex;

    use super::*;

    /// Tones and joints that ring in lines of one joint, the strongest first.
    fn oscillations(lines: &[(Beat, f64)]) -> (Vec<Beat>, Vec<[f64; 2]>) {
        let line = |&(beat, amplitude): &(Beat, f64)| {
            let z = vec![Complex::from_polar(amplitude, 0.3); 2];
            Tone { joint: 4, beat, z, error: [0.0; 3], stands_out: 0.0, share: 0.0 }
        };
        let mut found = Oscillations::default();
        found.add(lines.iter().map(line).collect(), &ToneThresholds::default());
        assert!(found.ringing.iter().all(|band| band.joint == 4));
        let beats = found.tones.iter().map(|tone| tone.beat).collect();
        (beats, found.ringing.iter().map(|band| band.hz).collect())
    }

    #[test]
    fn lines_far_apart_are_tones_each() {
        let lines = [(Beat::Clock(4.0), 1.0), (Beat::Position(4.1), 0.9), (Beat::Clock(8.0), 0.1)];
        let beats: Vec<Beat> = lines.iter().map(|(beat, _)| *beat).collect();
        assert_eq!(oscillations(&lines), (beats, vec![]));
    }

    #[test]
    fn what_a_strong_line_leaves_beside_it_is_no_tone() {
        let ripple = Beat::Position(232.0);
        assert_eq!(
            oscillations(&[(ripple, 1.1), (Beat::Position(230.9), 0.05)]),
            (vec![ripple], vec![])
        );
        let hum = Beat::Clock(10.0);
        assert_eq!(oscillations(&[(hum, 1.0), (Beat::Clock(10.3), 0.1)]), (vec![hum], vec![]));
    }

    #[test]
    fn lines_of_one_size_side_by_side_are_a_band_that_rings() {
        let band = [(Beat::Clock(24.3), 7.2), (Beat::Clock(24.7), 5.8), (Beat::Clock(25.1), 5.7)];
        assert_eq!(oscillations(&band), (vec![], vec![[24.3, 25.1]]));
    }

    /// Three lines of the elbow of a UR10, of .82, .67 and .57 N m, are one band; two of them may be two tones, and so
    /// may three of unlike amplitude.
    #[test]
    fn three_lines_of_similar_amplitude_within_a_third_of_an_octave_are_a_band() {
        let lines = |third: f64| {
            [(Beat::Clock(2.549), 0.82), (Beat::Clock(2.406), 0.67), (Beat::Clock(3.051), third)]
        };
        assert_eq!(oscillations(&lines(0.57)), (vec![], vec![[2.406, 3.051]]));
        let beats: Vec<Beat> = lines(0.3).iter().map(|(beat, _)| *beat).collect();
        assert_eq!(oscillations(&lines(0.57)[..2]), (beats[..2].to_vec(), vec![]));
        assert_eq!(oscillations(&lines(0.3)), (beats, vec![]));
        let far = [(Beat::Clock(2.0), 0.82), (Beat::Clock(3.0), 0.67), (Beat::Clock(4.5), 0.57)];
        assert_eq!(oscillations(&far).1, Vec::<[f64; 2]>::new());
    }
}
