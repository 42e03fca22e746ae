use numpy::PyArrayDyn;
use pyo3::prelude::*;

use crate::arrays::{SampleRows, TableColumns, same_rows, table};
use crate::robot::PyRobot;

/// The torque that moves the rigid bodies of `robot` so,
///
/// ```text
/// tau = M(q) qdd + C(q, qd) qd + g(q)
/// ```
///
/// without rotors and friction, which `Model.described` adds.
///
/// # Errors
///
/// Those of [`SampleRows::new`], and `ValueError` where the three arguments are not alike.
#[pyfunction]
pub fn inverse_dynamics<'py>(
    py: Python<'py>,
    robot: &PyRobot,
    q: &Bound<'py, PyAny>,
    qd: &Bound<'py, PyAny>,
    qdd: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let joints = robot.joints();
    let (n, columns) = (joints.len(), TableColumns::Joints(&joints));
    let q = SampleRows::new("q", q, columns)?;
    let qd = SampleRows::new("qd", qd, columns)?;
    let qdd = SampleRows::new("qdd", qdd, columns)?;
    same_rows([("q", &q), ("qd", &qd), ("qdd", &qdd)])?;
    let mut tau = vec![0.0; q.len() * n];
    if n > 0 {
        let states = [q.as_slice(), qd.as_slice(), qdd.as_slice()];
        let (dynamics, tau) = (robot.dynamics(), tau.as_mut_slice());
        py.detach(|| {
            let mut workspace = dynamics.workspace();
            let [q, qd, qdd] = states.map(|all| all.chunks_exact(n));
            for (((tau, q), qd), qdd) in tau.chunks_exact_mut(n).zip(q).zip(qd).zip(qdd) {
                dynamics.inverse_dynamics_into(&mut workspace, q, qd, qdd, tau);
            }
        });
    }
    table(py, tau, n, q.is_single)
}
