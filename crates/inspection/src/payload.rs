use dynamics::{Dynamics, PARAMETERS_PER_LINK};

use crate::fit::Drive;
use crate::judge::Judge;

/// Shares of the effort that the nominal torque leaves with an unknown tool at the last link: mass and centre
/// of mass that fit best. `None` where no arm carries such a tool.
///
/// ```text
/// tau = tau_nominal + Y_last (m, m c)
/// ```
pub(crate) fn shares_with_a_tool(judge: &Judge, drive: Drive) -> Option<Vec<f64>> {
    let columns = tool_columns(judge);
    let borrowed: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let found = judge.fit_pooled(&judge.whole, &borrowed)?;
    let arm: f64 = judge.robot.links().iter().map(|link| link.inertia.mass).sum();
    let moment = found[1..].iter().map(|h| h * h).sum::<f64>().sqrt();
    let heaviest = judge.thresholds.heaviest_tool * arm;
    let last = judge.robot.links().last()?.inertia.mass;
    if found[0] > heaviest
        || found[0] < -last
        || moment > judge.thresholds.farthest_tool_m * heaviest
    {
        return None;
    }
    let mut tau = judge.whole.clone();
    for (column, x) in columns.iter().zip(found) {
        tau.iter_mut().zip(column).for_each(|(tau, c)| *tau += x * c);
    }
    Some(judge.fits(&judge.samples, &tau, drive).iter().map(|fit| fit.share).collect())
}

/// Torque of each joint per mass and first moment of the last link, row-major, `rows x joints`.
fn tool_columns(judge: &Judge) -> [Vec<f64>; 4] {
    let n = judge.samples.joints;
    let dynamics = Dynamics::new(&judge.robot);
    let mut workspace = dynamics.workspace();
    let width = n * PARAMETERS_PER_LINK;
    let mut y = vec![0.0; n * width];
    let mut columns = [const { Vec::new() }; 4];
    let [q, qd, qdd] = &judge.samples.motion;
    for ((q, qd), qdd) in q.chunks_exact(n).zip(qd.chunks_exact(n)).zip(qdd.chunks_exact(n)) {
        dynamics.torque_regressor_into(&mut workspace, q, qd, qdd, &mut y);
        for (p, column) in columns.iter_mut().enumerate() {
            column.extend((0..n).map(|j| y[j * width + (n - 1) * PARAMETERS_PER_LINK + p]));
        }
    }
    columns
}
