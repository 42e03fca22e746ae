/// Calls a macro with every stranger, in the order in which random draws count them: a sentence on what it
/// is, its variant, and its name in files.
macro_rules! for_each_stranger {
    ($callback:ident) => {
        $callback! {
            /// Contact with something that gives.
            SoftWall soft_wall;
            /// A place that attracts.
            MagnetWell magnet_well;
            /// Torque from the speed of another joint.
            SpeedCrosstalk speed_crosstalk;
            /// A drive to which small commands are none.
            DriveDeadZone drive_dead_zone;
            /// Torque that changes no faster than it can.
            TorqueRateLimit torque_rate_limit;
            /// Dry friction that grows with the load of the neighbouring joints.
            TiltingBearing tilting_bearing;
            /// A base that tilts under the weight of its arm.
            SoftMount soft_mount;
            /// An encoder whose disc is off its centre.
            EccentricEncoder eccentric_encoder;
            /// Torque that is gone for moments.
            TorqueDropout torque_dropout;
            /// An integrator in the drive, up to its limit.
            IntegratorWindup integrator_windup;
            /// Drag with the square of the speed.
            SquareDrag square_drag;
            /// A place where the joint rubs.
            Snag snag;
        }
    };
}

pub(crate) use for_each_stranger;
