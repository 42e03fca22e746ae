/// Calls a macro with every effect, in the order in which random draws count them: a sentence on what it is,
/// the variant of [`EffectKind`](crate::EffectKind), the name in files, and the code.
///
/// ```
/// macro_rules! count {
///     ($($(#[$meaning:meta])* $variant:ident $name:ident $code:literal;)*) => {
///         [$($code),*].len()
///     };
/// }
/// assert_eq!(catalogue::for_each_effect!(count), catalogue::EffectKind::ALL.len());
/// ```
///
/// A code is for good: it never becomes another effect's, and an effect never gets another one, not even when
/// it is renamed or moves to another family. A new effect takes the next number of its family, and the number
/// of one that is taken out stays unused.
#[macro_export]
macro_rules! for_each_effect {
    ($callback:ident) => {
        $callback! {
            /// Torque against the motion in proportion to velocity.
            ViscousFriction viscous_friction "FR01";
            /// Torque of constant size against the motion.
            CoulombFriction coulomb_friction "FR02";
            /// Dry friction with one level for each direction.
            AsymmetricFriction asymmetric_friction "FR03";
            /// Dry friction that is larger at rest.
            StribeckFriction stribeck_friction "FR04";
            /// Dry friction that gives like a spring before it slides.
            PreslidingFriction presliding_friction "FR05";
            /// Dry friction that grows with the torque carried.
            LoadDependentFriction load_dependent_friction "FR06";
            /// Dry friction that varies with position.
            PositionDependentFriction position_dependent_friction "FR07";
            /// Friction that falls while the drive warms up.
            FrictionTemperatureDrift friction_temperature_drift "FR08";
            /// Free play between motor and link.
            Backlash backlash "TR01";
            /// A spring with damping between motor and link.
            JointElasticity joint_elasticity "TR02";
            /// Inertia of the motor beyond the description.
            RotorInertia rotor_inertia "IN03";
            /// Dry friction at the two motors of a differential.
            DifferentialCoupling differential_coupling "TR03";
            /// A body fixed to a link.
            Payload payload "IN01";
            /// What a link truly weighs.
            InertialParameters inertial_parameters "IN02";
            /// A base that does not stand as described.
            GravityDirection gravity_direction "EN01";
            /// A hose or cable that pulls at a joint.
            CableSpring cable_spring "EN02";
            /// Torque of the motor that its angle decides.
            TorqueRipple torque_ripple "DR01";
            /// Effort in a wrong unit of torque.
            TorqueConstant torque_constant "DR02";
            /// A constant in the reported effort.
            TorqueOffset torque_offset "DR03";
            /// Torque that follows its command as through a filter.
            ActuatorLag actuator_lag "DR04";
            /// Torque that comes a fixed time after its command.
            ActuatorDelay actuator_delay "DR05";
            /// A drive that gives no more than its limit.
            TorqueSaturation torque_saturation "DR06";
            /// An encoder whose zero is not the joint's.
            EncoderOffset encoder_offset "SE01";
            /// A gear ratio that is not the one the drive was told.
            TransmissionRatio transmission_ratio "TR04";
            /// Effort and position of different instants in one row.
            TimeSkew time_skew "SE02";
            /// A torque or force from the world around.
            ExternalDisturbance external_disturbance "EN03";
            /// A spring or weight that carries part of the weight of what a joint lifts.
            Counterbalance counterbalance "EN04";
            /// Goals that reach a servo's position loop later than they are logged.
            GoalDelay goal_delay "DR07";
        }
    };
}
