use crate::signals::tone::{Beat, Tone};
use crate::thresholds::tones::ToneThresholds;

/// Oscillations in the logs.
#[derive(Debug, Default)]
pub(crate) struct Oscillations {
    /// Oscillations of one period each.
    pub tones: Vec<Tone>,
    /// Joints, by index, that ring in a band, with the middle of the band (Hz).
    pub ringing: Vec<(usize, f64)>,
}

impl Oscillations {
    /// Adds the lines of one joint, the strongest first. Weak lines beside a strong one come from its varying
    /// amplitude and are left out. Lines of equal size side by side are a band in which the joint rings.
    pub fn add(&mut self, lines: Vec<Tone>, t: &ToneThresholds) {
        let is_beside = |a: &Tone, b: &Tone| match (a.beat, b.beat) {
            (Beat::Clock(a), Beat::Clock(b)) | (Beat::Position(a), Beat::Position(b)) => {
                (a - b).abs() < t.one_line * b
            }
            _ => false,
        };
        for (i, line) in lines.iter().enumerate() {
            if lines[..i].iter().any(|stronger| is_beside(line, stronger)) {
                continue;
            }
            let least = t.ringing * line.amplitude();
            let mut weaker = lines[i + 1..].iter().filter(|weaker| is_beside(weaker, line));
            match line.beat {
                Beat::Clock(hz) if weaker.any(|weaker| weaker.amplitude() > least) => {
                    self.ringing.push((line.joint, hz));
                }
                _ => self.tones.push(line.clone()),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Complex;

    use super::*;

    /// Tones and joints that ring in lines of one joint, the strongest first.
    fn oscillations(lines: &[(Beat, f64)]) -> (Vec<Beat>, Vec<f64>) {
        let line = |&(beat, amplitude): &(Beat, f64)| {
            let z = vec![Complex::from_polar(amplitude, 0.3); 2];
            Tone { joint: 4, beat, z, error: [0.0; 3], stands_out: 0.0, share: 0.0 }
        };
        let mut found = Oscillations::default();
        found.add(lines.iter().map(line).collect(), &ToneThresholds::default());
        assert!(found.ringing.iter().all(|(joint, _)| *joint == 4));
        let beats = found.tones.iter().map(|tone| tone.beat).collect();
        (beats, found.ringing.iter().map(|(_, hz)| *hz).collect())
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
        assert_eq!(oscillations(&band), (vec![], vec![24.3]));
    }
}
