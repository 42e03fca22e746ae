use robot::Actuator;

/// Torque of the loop of a cable along a motion, and what its size and its stiffness change in it:
///
/// ```text
/// h' = clamp(h + stiffness dq, -hysteresis, hysteresis),  h = 0 at the start
/// ```
///
/// A spring that slides, as `cable spring` in the catalogue.
#[derive(Debug, Clone)]
pub(crate) struct Loop {
    /// `h` (N·m or N).
    pub torque: Vec<f64>,
    /// `dh / d stiffness` (rad or m).
    pub per_stiffness: Vec<f64>,
    /// `dh / d hysteresis`.
    pub per_hysteresis: Vec<f64>,
    /// Torque per unit of a way (N·m/rad or N/m): none where it slides.
    stiffness: Vec<f64>,
}

impl Loop {
    /// The loop of a drive whose link follows `q`; none of a spring that does not slide.
    pub fn of(drive: &Actuator, q: &[f64]) -> Option<Self> {
        let slides = drive.spring_hysteresis > 0.0;
        slides.then(|| Self::new(drive.spring_stiffness, drive.spring_hysteresis, q))
    }

    pub fn new(stiffness: f64, hysteresis: f64, q: &[f64]) -> Self {
        let mut torque = Vec::with_capacity(q.len());
        let (mut per_stiffness, mut per_hysteresis) = (torque.clone(), torque.clone());
        let mut sticks = torque.clone();
        let mut before = q.first().copied().unwrap_or(0.0);
        let [mut h, mut hk, mut hh] = [0.0; 3];
        for &q in q {
            let moved = q - std::mem::replace(&mut before, q);
            let dragged: f64 = h + stiffness * moved;
            if dragged.abs() < hysteresis {
                (h, hk) = (dragged, hk + moved);
                sticks.push(stiffness);
            } else {
                sticks.push(0.0);
                h = dragged.clamp(-hysteresis, hysteresis);
                (hk, hh) = (0.0, if dragged < 0.0 { -1.0 } else { 1.0 });
            }
            torque.push(h);
            per_stiffness.push(hk);
            per_hysteresis.push(hh);
        }
        Self { torque, per_stiffness, per_hysteresis, stiffness: sticks }
    }

    /// What a small displacement of the motion changes in the torque:
    /// `dh' = dh + stiffness ds` while it sticks, 0 where it slides.
    pub fn change_under(&self, s: &[f64]) -> Vec<f64> {
        let mut before = s.first().copied().unwrap_or(0.0);
        let mut change = 0.0;
        let step = |(s, stiffness): (&f64, &f64)| {
            let moved = s - std::mem::replace(&mut before, *s);
            change = if *stiffness > 0.0 { change + stiffness * moved } else { 0.0 };
            change
        };
        s.iter().zip(&self.stiffness).map(step).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// To and fro over 1 rad with 2 N·m/rad and 0.5 N·m: sliding after 0.25 rad, and half a radian
    /// after each turn.
    #[test]
    fn a_loop_sticks_for_twice_its_way_after_a_turn() {
        let there: Vec<f64> = (0..=100).map(|i| 0.01 * f64::from(i)).collect();
        let q: Vec<f64> = there.iter().chain(there.iter().rev()).copied().collect();
        let Loop { torque, per_stiffness, per_hysteresis, .. } = Loop::new(2.0, 0.5, &q);
        for (i, expected) in [(10, 0.2), (30, 0.5), (100, 0.5), (126, 0.0), (201, -0.5)] {
            assert!((torque[i] - expected).abs() < 1e-12, "{i}: {} and {expected}", torque[i]);
        }
        assert!((per_stiffness[10] - 0.1).abs() < 1e-12 && per_stiffness[100].abs() < 1e-12);
        assert!(per_hysteresis[10].abs() < 1e-12 && (per_hysteresis[201] + 1.0).abs() < 1e-12);
    }
}
