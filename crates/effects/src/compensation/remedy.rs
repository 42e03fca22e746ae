//! How each effect is compensated, tested against [`Compensation`](crate::Compensation).

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use robot::{Actuator, CounterbalanceTerm, Coupling, FrictionWave, Ripple, Robot, Stribeck};

    use crate::compensation::feedforward::{Compensation, FeedforwardEfforts};
    use crate::model::remedy;
    use catalogue::EffectKind;

    fn pendulum() -> Robot {
        Robot::from_urdf(
            r#"<robot name="pendulum"><link name="base"/>
            <link name="arm"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
              <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
            <joint name="joint" type="continuous"><parent link="base"/><child link="arm"/>
              <axis xyz="0 1 0"/></joint></robot>"#,
        )
        .unwrap()
    }

    /// The pendulum with an effect that its description can hold.
    fn with(kind: EffectKind) -> Option<Robot> {
        use EffectKind as K;
        let mut robot = pendulum();
        let change: fn(&mut Actuator) = match kind {
            K::ViscousFriction => |a| a.viscous = 0.3,
            K::CoulombFriction => |a| (a.coulomb_forward, a.coulomb_backward) = (0.5, 0.5),
            K::AsymmetricFriction => |a| a.coulomb_forward = 0.5,
            K::Backlash => |a| a.backlash = 0.01,
            K::JointElasticity => |a| a.elasticity = Some(300.0),
            K::RotorInertia => |a| a.rotor_inertia = 0.1,
            K::CableSpring => |a| a.spring_stiffness = 0.7,
            K::Counterbalance => {
                |a| a.counterbalance = Some(CounterbalanceTerm { amplitude: 0.7, phase: 0.3 })
            }
            K::TorqueConstant => |a| a.torque_gain = 1.1,
            // One joint stands for both.
            K::DifferentialCoupling => |a| {
                let [level, viscous] = [[0.3, 0.2], [0.0; 2]];
                a.coupling = Some(Coupling { other: 0, ratio: 0.5, level, viscous });
            },
            K::TorqueOffset => |a| a.torque_offset = 0.2,
            K::ActuatorDelay => |a| a.delay_s = 0.004,
            K::StribeckFriction => |a| a.stribeck = Some(Stribeck { excess: 0.3, velocity: 1.0 }),
            K::PreslidingFriction => |a| {
                (a.coulomb_forward, a.coulomb_backward) = (0.5, 0.5);
                a.presliding = Some(0.001);
            },
            K::LoadDependentFriction => |a| a.load_friction = 0.05,
            K::PositionDependentFriction => |a| {
                (a.coulomb_forward, a.coulomb_backward) = (0.5, 0.5);
                a.friction_wave = Some(FrictionWave { share: 0.3, periods: 3.0, phase: 0.0 });
            },
            K::TorqueRipple => {
                |a| a.ripple = Some(Ripple { amplitude: 0.1, periods: 60.0, phase: 0.0 })
            }
            K::EncoderOffset => |a| a.encoder_offset = 0.01,
            K::ActuatorLag => |a| a.lag_s = 0.004,
            K::TransmissionRatio => |a| a.transmission_ratio = 1.02,
            K::Payload | K::InertialParameters => {
                robot.link_mut(0)?.inertia.mass += 0.5;
                return Some(robot);
            }
            K::GravityDirection => return Some(robot.with_gravity(Vector3::new(1.0, 0.0, -9.7))),
            _ => return None,
        };
        change(&mut robot.link_mut(0)?.actuator);
        Some(robot)
    }

    fn feedforward_of(robot: &Robot) -> (FeedforwardEfforts, Vec<f64>) {
        let compensation = Compensation::new(robot, vec![0.02]);
        let count = compensation.state_count();
        let (qd, qdd): (f64, f64) = (0.7, -3.0);
        let at = |k: usize| {
            let t = Compensation::SPACING_S * (k as f64 - (count / 2) as f64);
            [[0.4 + t * (qd + 0.5 * t * qdd)], [qd + t * qdd], [qdd]]
        };
        let states: Vec<[[f64; 1]; 3]> = (0..count).map(at).collect();
        let states: Vec<[&[f64]; 3]> =
            states.iter().map(|s| [0, 1, 2].map(|i| &s[i][..])).collect();
        let mut out = FeedforwardEfforts::zero(1);
        compensation.fill(&mut compensation.workspace(), &states, &mut out);
        (out, compensation.delay_s().to_vec())
    }

    /// What the table promises changes what is asked for; what it does not has no key.
    #[test]
    fn the_table_holds_for_every_effect_of_the_catalogue() {
        let ideal = feedforward_of(&pendulum());
        for kind in EffectKind::ALL {
            let undone = with(kind).is_some_and(|robot| feedforward_of(&robot) != ideal);
            assert_eq!(undone, remedy(kind).is_ok(), "{kind}");
        }
    }
}
