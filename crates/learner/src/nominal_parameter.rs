use dynamics::RegressorColumn;
use robot::Robot;

/// The parameter of `column` as the robot is described.
pub(crate) fn nominal_parameter(robot: &Robot, column: RegressorColumn) -> f64 {
    let actuator = |joint: usize| &robot.links()[joint].actuator;
    match column {
        RegressorColumn::Inertial { link, parameter } => {
            robot.links()[link].inertia.parameters()[parameter]
        }
        RegressorColumn::Rotor { joint } => actuator(joint).rotor_inertia,
        RegressorColumn::Viscous { joint } => actuator(joint).viscous,
        RegressorColumn::Coulomb { joint } => {
            0.5 * (actuator(joint).coulomb_forward + actuator(joint).coulomb_backward)
        }
        RegressorColumn::Offset { joint } => {
            let a = actuator(joint);
            a.torque_offset + 0.5 * (a.coulomb_forward - a.coulomb_backward)
        }
    }
}

/// The scale of the parameter of `column`: an error as large as this makes the description useless.
/// For inertial parameters it is the bound that the pseudo-inertia `[S h; h' m]` sets,
///
/// ```text
/// m for the mass,   sqrt(m tr S) for first moments,   tr S for second moments
/// ```
///
/// the rotor's inertia for the rotor, and the unit (SI) for friction, offsets and whatever is
/// described as zero.
pub(crate) fn size(robot: &Robot, column: RegressorColumn) -> f64 {
    let size = match column {
        RegressorColumn::Inertial { link, parameter } => {
            let [mass, _, _, _, xx, _, yy, _, _, zz] = robot.links()[link].inertia.parameters();
            let spread = 0.5 * (xx + yy + zz);
            match parameter {
                0 => mass,
                1..=3 => (mass * spread).max(0.0).sqrt(),
                _ => spread,
            }
        }
        RegressorColumn::Rotor { .. } => nominal_parameter(robot, column),
        RegressorColumn::Viscous { .. }
        | RegressorColumn::Coulomb { .. }
        | RegressorColumn::Offset { .. } => 1.0,
    };
    if size > 0.0 { size } else { 1.0 }
}
