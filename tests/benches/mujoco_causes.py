"""The causes of `truth/scenario.toml`, put into an arm of MuJoCo: `CAUSES[kind](arm, values)`."""

import math

import mujoco
import numpy as np

import mujoco_laws as laws

# Density of what hangs on an arm (kg/m3): a payload without a stated inertia is a ball of steel.
STEEL = 7850.0


class LeftOut(Exception):
    """Why a trial cannot be made with MuJoCo."""


def steiner(r):
    """r . r E - r r^T"""
    return r @ r * np.eye(3) - np.outer(r, r)


def symmetric(values):
    xx, yy, zz, xy, xz, yz = values
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def ball(mass):
    """2/5 m r^2 of a ball of steel (kg m2)."""
    radius = (3.0 * mass / (4.0 * math.pi * STEEL)) ** (1.0 / 3.0)
    return 0.4 * mass * radius**2 * np.eye(3)


def twist(arm, values):
    return arm.twists.setdefault(values["joint"], laws.Twist())


def elasticity(arm, values):
    one = twist(arm, values)
    if one.stiffness > 0.0:
        raise LeftOut(f"two springs in the drive of {values['joint']}")
    one.stiffness, one.damping = values["stiffness_nm_per_rad"], values["damping_nm_s_per_rad"]


def backlash(arm, values):
    twist(arm, values).gap += values["gap_rad"]


def coulomb(arm, values):
    arm.dry[:, arm.joint(values)] += values["level_nm"]


def asymmetric(arm, values):
    """-forward for qd > 0, backward for qd < 0."""
    arm.dry[:, arm.joint(values)] += [values["forward_nm"], values["backward_nm"]]


def viscous(arm, values):
    arm.viscous[arm.joint(values)] += values["viscous_nm_s_per_rad"]


def rotor(arm, values):
    arm.rotors[arm.joint(values)] += values["inertia_kg_m2"]


def law(kind):
    return lambda arm, values: arm.laws.append(kind(arm, values))


def load_dependent(arm, values):
    arm.needs_load = True
    arm.laws.append(laws.LoadDependent(arm, values))


def drift(arm, values):
    if arm.tendons:
        raise LeftOut("the friction of a differential does not drift here")
    arm.laws.append(laws.Drift(arm, values))


def differential(arm, values):
    """Friction on the sum and on the difference of two joints: two tendons."""
    first, second, ratio = values["joint_a"], values["joint_b"], values["ratio"]
    arm.tendons.append(([(first, 1.0), (second, ratio)], values["level_sum_nm"]))
    arm.tendons.append(([(first, 1.0), (second, -ratio)], values["level_difference_nm"]))


def payload(arm, values):
    stated = values.get("inertia_kg_m2")
    about_com = ball(values["mass_kg"]) if stated is None else symmetric(stated)
    arm.add_body(values["link"], values["mass_kg"], np.array(values["com_m"]), about_com)


def bodies(arm, values):
    """The body that a link truly has, in place of the described one."""
    mass, com, described = arm.body_of(values["link"])
    stated = values.get("inertia_kg_m2")
    about_com = values["mass_kg"] / mass * described if stated is None else symmetric(stated)
    arm.add_body(values["link"], values["mass_kg"], np.array(values["com_m"]), about_com)
    arm.add_body(values["link"], -mass, com, -described)


def tilt(arm, values):
    """g = exp((tilt_1 e_1 + tilt_2 e_2) x) g, e_1 the level part of x (of y where x is within 26 degrees of the
    vertical), e_2 = up x e_1."""
    gravity = arm.bare.opt.gravity.copy()
    up = -gravity / np.linalg.norm(gravity)
    first = np.eye(3)[0 if abs(up[0]) <= 0.9 else 1]
    first = first - up * (up @ first)
    first /= np.linalg.norm(first)
    turn = values["tilt_x_rad"] * first + values["tilt_y_rad"] * np.cross(up, first)
    angle = np.linalg.norm(turn)
    if angle > 0.0:
        quat, turned = np.zeros(4), np.zeros(3)
        mujoco.mju_axisAngle2Quat(quat, turn / angle, angle)
        mujoco.mju_rotVecQuat(turned, gravity, quat)
        arm.bare.opt.gravity[:] = turned


def torque_constant(arm, values):
    arm.drives.gain[arm.joint(values)] *= values["gain"]


def torque_offset(arm, values):
    arm.drives.offset[arm.joint(values)] += values["offset_nm"]


def transmission(arm, values):
    """Reported positions are q / ratio, and the torque is effort / ratio."""
    arm.drives.gain[arm.joint(values)] *= values["ratio"]
    arm.drives.ratio[arm.joint(values)] *= values["ratio"]


def encoder_zero(arm, values):
    arm.drives.zero[arm.joint(values)] += values["offset_rad"]


def saturation(arm, values):
    most = arm.drives.most
    most[arm.joint(values)] = min(most[arm.joint(values)], values["limit_nm"])


def delay(arm, values):
    arm.drives.delay_s[arm.joint(values)] += 1e-3 * values["delay_ms"]


def lag(arm, values):
    joint = arm.joint(values)
    if arm.drives.lag_s[joint] > 0.0:
        raise LeftOut(f"two lags in the drive of {values['joint']}")
    arm.drives.lag_s[joint] = 1e-3 * values["time_constant_ms"]


def skew(arm, values):
    at = slice(None) if values.get("joint") is None else arm.joint(values)
    if np.any(arm.skew_s[at] != 0.0):
        raise LeftOut("two skews of one joint")
    arm.skew_s[at] = 1e-3 * values["skew_ms"]


def goal_delay(arm, values):
    arm.goal_delay_s += 1e-3 * values["delay_ms"]


def disturbance(arm, values):
    (kind, of), = values.items()
    arm.laws.append({"periodic": laws.Periodic, "push": laws.Push}[kind](arm, of))


CAUSES = {
    "actuator_delay": delay,
    "actuator_lag": lag,
    "asymmetric_friction": asymmetric,
    "backlash": backlash,
    "cable_spring": law(laws.Cable),
    "coulomb_friction": coulomb,
    "counterbalance": law(laws.Counterbalance),
    "differential_coupling": differential,
    "encoder_offset": encoder_zero,
    "external_disturbance": disturbance,
    "friction_temperature_drift": drift,
    "goal_delay": goal_delay,
    "gravity_direction": tilt,
    "inertial_parameters": bodies,
    "joint_elasticity": elasticity,
    "load_dependent_friction": load_dependent,
    "payload": payload,
    "position_dependent_friction": law(laws.PositionDependent),
    "presliding_friction": law(laws.Presliding),
    "rotor_inertia": rotor,
    "stribeck_friction": law(laws.Stribeck),
    "time_skew": skew,
    "torque_constant": torque_constant,
    "torque_offset": torque_offset,
    "torque_ripple": law(laws.Ripple),
    "torque_saturation": saturation,
    "transmission_ratio": transmission,
    "viscous_friction": viscous,
}
