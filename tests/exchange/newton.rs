//! Newton, the engine of Isaac Lab that PyPI has, loads the USD layer and needs the same torque; where it is not
//! installed these tests say so.

use std::process::Command;

use exchange::{Format, export};

use crate::python::ask;
use crate::rich::{DRIVES, states, torque, urdf, wam_with};

/// Torques by the equations of motion that Newton gives MuJoCo, of joints in the order of the layer. Its dry friction
/// and the stiffness of its drives are added as it read them: MuJoCo softens the one and leaves out the other.
const SCRIPT: &str = "
import json, sys
import numpy, warp
warp.config.quiet = True
import mujoco, newton
question = json.load(sys.stdin)
builder = newton.ModelBuilder()
builder.add_usd(question['layer'])
model = builder.finalize(device='cpu')
solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
body = solver.mj_model
body.dof_frictionloss[:] = 0
body.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_LIMIT | mujoco.mjtDisableBit.mjDSBL_CONTACT
data = mujoco.MjData(body)
friction, stiffness, rest = (
    numpy.array(model_array.numpy(), dtype=float)
    for model_array in (model.joint_friction, model.joint_target_ke, model.joint_target_q)
)
answer = []
for q, qd, qdd in question['states']:
    data.qpos[:], data.qvel[:], data.qacc[:] = q, qd, qdd
    mujoco.mj_inverse(body, data)
    drive = stiffness * (rest - numpy.array(q))
    answer.append(list(data.qfrc_inverse + friction * numpy.sign(qd) - drive))
json.dump(answer, sys.stdout)
";

/// Largest difference of a torque over the largest torque: Newton counts in 32 bits.
const TOLERANCE: f64 = 1e-5;

fn is_there() -> bool {
    let module = "import newton, newton_usd_schemas, pxr, mujoco_warp";
    let found = Command::new("python3").args(["-c", module]).output();
    let there = found.is_ok_and(|output| output.status.success());
    if !there {
        println!("skipped: python3 has no newton, pip install newton[importers,sim] brings it");
    }
    there
}

#[test]
fn oracle_newton_needs_the_torque_of_the_robot_that_a_usd_layer_holds() {
    if !is_there() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let loaded = wam_with(folder.path(), DRIVES);
    let written = export(&loaded, &urdf(), Format::Isaac).unwrap();
    let layer = folder.path().join("extended.usda");
    std::fs::write(&layer, &written.text).unwrap();
    let states = states(7, 20);
    let question = serde_json::json!({ "layer": layer, "states": states });
    // Warp tells of what it compiles above the answer.
    let told = ask(SCRIPT, &question, &format!("Newton refuses\n{}", written.text));
    let theirs: Vec<Vec<f64>> = serde_json::from_str(told.lines().last().unwrap()).unwrap();
    let (mut off, mut largest) = (0.0_f64, 0.0_f64);
    for (state, theirs) in states.iter().zip(&theirs) {
        for (ours, theirs) in torque(&written.robot, state).iter().zip(theirs) {
            off = off.max((ours - theirs).abs());
            largest = largest.max(ours.abs());
        }
    }
    println!("largest difference over largest torque: {:.2e}", off / largest);
    assert!(off < TOLERANCE * largest, "{off} N·m of {largest}");
}
