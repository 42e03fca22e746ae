use learner::{Samples, TrainedModel};
use robot::Robot;

/// Number of signals named for one joint.
const LISTED: usize = 3;

/// A signal on which a Gaussian process depends.
#[derive(Debug, Clone, PartialEq)]
pub struct Relevance {
    /// The signal, such as `position of elbow`.
    pub signal: String,
    /// Length scale of the process over the range of the signal, below one. The shorter it is, the more the process
    /// varies with the signal.
    pub share_of_range: f64,
}

/// The signals on which the process of joint `joint` depends most: those whose length scales are shortest relative to
/// their ranges in `samples`, and shorter than these.
pub(crate) fn relevance(
    fitted: &TrainedModel,
    joint: usize,
    robot: &Robot,
    samples: &Samples,
) -> Vec<Relevance> {
    let kernel = fitted.joints.get(joint).and_then(|fit| fit.kernel.as_ref());
    let (Some(found), Some(process)) = (kernel, &fitted.model.process) else { return Vec::new() };
    // Inputs are in standard deviations, and so are length scales.
    let (points, width) = (process.inputs.points(samples), process.inputs.width());
    let range = |d: usize| {
        let column = points.iter().skip(d).step_by(width);
        let [low, high] = column.fold([f64::MAX, f64::MIN], |[l, h], &x| [l.min(x), h.max(x)]);
        high - low
    };
    let scales = found.kernel.length_scales.iter().enumerate();
    let mut all: Vec<(usize, f64)> = scales.map(|(d, l)| (d, l / range(d))).collect();
    all.retain(|(_, share)| *share < 1.0);
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all.truncate(LISTED);
    let relevance = |(d, share_of_range)| Relevance { signal: words(d, robot), share_of_range };
    all.into_iter().map(relevance).collect()
}

/// Name of input `d` of a process: positions, then velocities, then accelerations.
fn words(d: usize, robot: &Robot) -> String {
    let joints = robot.joint_count();
    let signal = ["position", "velocity", "acceleration"][d / joints];
    format!("{signal} of {}", robot.links()[d % joints].joint.name)
}
