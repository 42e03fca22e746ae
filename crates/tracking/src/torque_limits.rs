use crate::error::TrackingError;

/// Torque limits of the motors.
///
/// A joint with a motor of its own gives `|tau| <= limit`. Two joints `a`, `b` that share two
/// motors through a differential, `A` and `B` the limits of either alone, give the diamond
///
/// ```text
/// x = tau_a / A,   y = tau_b / B,   m1 = x - y,   m2 = x + y,   |m1| <= 1,   |m2| <= 1
/// ```
///
/// A torque outside is clipped motor by motor, as the motors themselves would do.
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueLimits {
    limits: Vec<f64>,
    pairs: Vec<[usize; 2]>,
}

impl TorqueLimits {
    /// Limits of every joint alone (N m or N, infinite where there is none), and the pairs of
    /// joints that share two motors.
    ///
    /// # Errors
    ///
    /// - [`TrackingError::OutOfRange`] when a limit is not above 0.
    /// - [`TrackingError::Pair`] when a pair is not of two joints of the robot, shares a joint
    ///   with another, or has a joint without a limit.
    pub fn new(limits: Vec<f64>, pairs: Vec<[usize; 2]>) -> Result<Self, TrackingError> {
        for (joint, &found) in limits.iter().enumerate() {
            if found.is_nan() || found <= 0.0 {
                let quantity = format!("the torque limit of joint {joint} (N m or N)");
                let expected = "a number above 0, or infinity";
                return Err(TrackingError::OutOfRange { quantity, found, expected });
            }
        }
        for (i, &[first, second]) in pairs.iter().enumerate() {
            let limited = |joint: usize| limits.get(joint).is_some_and(|limit| limit.is_finite());
            let shared = pairs[..i].iter().flatten().any(|j| *j == first || *j == second);
            let because = match () {
                () if first == second => "they are the same",
                () if first.max(second) >= limits.len() => "the robot does not have both",
                () if shared => "one of them is in another pair",
                () if !(limited(first) && limited(second)) => "both need a finite limit",
                () => continue,
            };
            return Err(TrackingError::Pair { first, second, because });
        }
        Ok(Self { limits, pairs })
    }

    /// No limit on any of the joints.
    pub fn none(joints: usize) -> Self {
        Self { limits: vec![f64::INFINITY; joints], pairs: Vec::new() }
    }

    /// Limit of every joint alone (N m or N).
    pub fn limits(&self) -> &[f64] {
        &self.limits
    }

    /// The pairs of joints that share two motors.
    pub fn pairs(&self) -> &[[usize; 2]] {
        &self.pairs
    }

    /// Brings `tau` (N m or N) within the limits and says of every joint whether it was
    /// outside; what lies within is left as it is to the last bit.
    ///
    /// # Panics
    ///
    /// When `tau` or `limited` is of another number of joints.
    pub fn apply(&self, tau: &mut [f64], limited: &mut [bool]) {
        limited.fill(false);
        for &[a, b] in &self.pairs {
            let (x, y) = (tau[a] / self.limits[a], tau[b] / self.limits[b]);
            let (m1, m2) = (x - y, x + y);
            if m1.abs() > 1.0 || m2.abs() > 1.0 {
                let (m1, m2) = (m1.clamp(-1.0, 1.0), m2.clamp(-1.0, 1.0));
                tau[a] = 0.5 * (m1 + m2) * self.limits[a];
                tau[b] = 0.5 * (m2 - m1) * self.limits[b];
                (limited[a], limited[b]) = (true, true);
            }
        }
        for ((tau, limit), limited) in tau.iter_mut().zip(&self.limits).zip(limited) {
            if tau.abs() > *limit {
                *tau = tau.clamp(-limit, *limit);
                *limited = true;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limit(limits: &TorqueLimits, mut tau: Vec<f64>) -> (Vec<f64>, Vec<bool>) {
        let mut limited = vec![false; tau.len()];
        limits.apply(&mut tau, &mut limited);
        (tau, limited)
    }

    #[test]
    fn a_joint_alone_stays_between_its_limits() {
        let limits = TorqueLimits::new(vec![2.0, f64::INFINITY], vec![]).unwrap();
        assert_eq!(limit(&limits, vec![-3.0, 1e9]), (vec![-2.0, 1e9], vec![true, false]));
        assert_eq!(limit(&limits, vec![1.9, -1e9]), (vec![1.9, -1e9], vec![false, false]));
    }

    #[test]
    fn a_pair_stays_in_its_diamond() {
        let limits = TorqueLimits::new(vec![1.0, 10.0, 4.0], vec![[1, 2]]).unwrap();
        // Within: untouched. On one axis: the limit of that joint alone.
        assert_eq!(limit(&limits, vec![0.1, 3.3, 2.2]).0, [0.1, 3.3, 2.2]);
        assert_eq!(limit(&limits, vec![0.0, 30.0, 0.0]).0, [0.0, 10.0, 0.0]);
        // Both at their limits: m1 = 0 stays, m2 = 2 becomes 1; half of either is left.
        let (tau, which) = limit(&limits, vec![0.0, 10.0, 4.0]);
        assert_eq!((tau, which), (vec![0.0, 5.0, 2.0], vec![false, true, true]));
        for i in 0..400 {
            let (x, y) = (f64::from(i % 20) - 9.5, f64::from(i / 20) - 9.5);
            let (tau, _) = limit(&limits, vec![0.0, 3.0 * x, y]);
            assert!((tau[1] / 10.0).abs() + (tau[2] / 4.0).abs() <= 1.0 + 1e-15, "{x} {y}");
        }
    }

    #[test]
    fn impossible_limits_are_refused() {
        let pair = |limits: &[f64], pairs: &[[usize; 2]]| {
            TorqueLimits::new(limits.to_vec(), pairs.to_vec()).unwrap_err().to_string()
        };
        assert!(pair(&[0.0], &[]).contains("torque limit of joint 0"));
        assert!(pair(&[f64::NAN], &[]).contains("NaN"));
        assert!(pair(&[1.0, 1.0], &[[1, 1]]).contains("same"));
        assert!(pair(&[1.0, 1.0], &[[0, 2]]).contains("does not have both"));
        assert!(pair(&[1.0, f64::INFINITY], &[[0, 1]]).contains("finite limit"));
        assert!(pair(&[1.0; 3], &[[0, 1], [1, 2]]).contains("another pair"));
    }
}
