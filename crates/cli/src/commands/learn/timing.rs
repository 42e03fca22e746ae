use std::hint::black_box;

use experiment::median_time_s;
use learner::{Samples, TorqueModel};

/// Median time of one prediction for all joints, over states of `samples` in turn (us).
pub fn median_query_us(model: &dyn TorqueModel, samples: &Samples) -> f64 {
    let mut ws = model.workspace();
    let mut tau = vec![0.0; model.joints()];
    let states = samples.len().max(1);
    median_us(|index| {
        model.torque_into(&mut ws, samples.state(index % states), &mut tau);
        black_box(&mut tau);
    })
}

/// Median time of a call (us); what is called is told the number of the call.
pub fn median_us(call: impl FnMut(usize)) -> f64 {
    1e6 * median_time_s(call)
}
