use nalgebra::Vector3;

/// The smallest box that holds all points that were seen (m).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct BoundingBox {
    ends: Option<[Vector3<f64>; 2]>,
}

/// From the middle of the box to the eye, whose view spans about 55° up and down: a ball about the
/// box of half its diagonal `r` fits from `r / sin(27.5°) = 2.2 r` on.
const DISTANCE: f64 = 2.2;

/// Where the eye stands seen from the middle.
const DIRECTION: Vector3<f64> = Vector3::new(0.62, -0.68, 0.4);

impl BoundingBox {
    /// Takes the points of an arm.
    pub fn push(&mut self, points: &[Vector3<f64>]) {
        for point in points.iter().filter(|point| point.iter().all(|x| x.is_finite())) {
            let [low, high] = self.ends.unwrap_or([*point; 2]);
            self.ends = Some([low.inf(point), high.sup(point)]);
        }
    }

    /// Where the eye stands and what it looks at, so that all that was seen fits the picture, with
    /// `room_m` about it; none where nothing was seen.
    pub fn eye(&self, room_m: f64) -> Option<[Vector3<f64>; 2]> {
        let [low, high] = self.ends?;
        let middle = 0.5 * (low + high);
        let radius = 0.5 * (high - low).norm() + room_m;
        Some([middle + DISTANCE * radius * DIRECTION.normalize(), middle])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_is_within_the_view_of_the_eye() {
        let mut seen = BoundingBox::default();
        assert!(seen.eye(0.1).is_none());
        let points: Vec<Vector3<f64>> = (0..50)
            .map(|k| f64::from(k) * 0.3)
            .map(|a| Vector3::new(a.cos(), 0.4 * a.sin(), 0.8 + 0.3 * (2.0 * a).sin()))
            .collect();
        seen.push(&points);
        seen.push(&[Vector3::new(f64::NAN, 9.0, 9.0)]);
        let [eye, target] = seen.eye(0.0).unwrap();
        let least = 27.5_f64.to_radians().cos();
        for point in points {
            let cosine = (target - eye).normalize().dot(&(point - eye).normalize());
            assert!(cosine > least, "{point} {cosine}");
        }
    }
}
