"""Laws that act in every step of an arm of MuJoCo: `law(moment, efforts)` with the names of `mujoco_arm`."""

import copy
import math
from collections import deque

import numpy as np

# How stiff an end of a backlash is, without a bounce.
STOP = {"solreflimit": "0.0004 1", "solimplimit": "0.95 0.99 0.0001"}


class Twist:
    """Link over motor: a joint of the same axis behind that of the motor."""

    def __init__(self):
        self.stiffness, self.damping, self.gap = 0.0, 0.0, 0.0

    def element(self, joint):
        """The joint of MJCF: a spring, or a range, or neither where the ends of a gap are springs."""
        twist = copy.deepcopy(joint)
        for key in ("armature", "frictionloss", "damping", "stiffness", "range", "actuatorfrcrange", "springref"):
            twist.attrib.pop(key, None)
        twist.set("name", joint.get("name") + "_twist")
        if self.gap <= 0.0:
            twist.set("stiffness", repr(self.stiffness))
            twist.set("damping", repr(self.damping))
        elif self.stiffness <= 0.0:
            twist.set("range", f"{-0.5 * self.gap!r} {0.5 * self.gap!r}")
            for key, value in STOP.items():
                twist.set(key, value)
        return twist

    def contact(self, deflection, rate):
        """Springs at the ends of a gap, which push alone (N m or N)."""
        if self.gap <= 0.0 or self.stiffness <= 0.0:
            return 0.0
        pressed = deflection - np.clip(deflection, -0.5 * self.gap, 0.5 * self.gap)
        torque = -self.stiffness * pressed - self.damping * rate
        return 0.0 if pressed == 0.0 else min(torque, 0.0) if pressed > 0.0 else max(torque, 0.0)


class Late:
    """A command on its way to the motor: cut off, delayed, and behind a first-order lag."""

    def __init__(self, drives):
        self.most, self.delay_s, self.lag_s = drives.most, drives.delay_s, drives.lag_s
        self.acts = bool(np.any(np.isfinite(self.most)) or np.any(self.delay_s > 0.0) or np.any(self.lag_s > 0.0))
        self.sent, self.last = deque(), None

    def start(self, step_s):
        """Whole steps and the rest of one of every delay, and what a lag keeps in a step of a command that is held."""
        steps = self.delay_s / step_s
        self.delays = [(j, int(steps[j]), steps[j] % 1.0) for j in np.flatnonzero(steps)]
        self.room = int(steps.max()) + 2
        self.kept = np.where(self.lag_s > 0.0, np.exp(-step_s / np.maximum(self.lag_s, 1e-9)), 0.0)

    def follow(self, command):
        if not self.acts:
            return command
        late = np.minimum(np.maximum(command, -self.most), self.most)
        # Before its start the first command was held.
        self.sent.extendleft([late] * (1 if self.sent else self.room))
        if len(self.sent) > self.room:
            self.sent.pop()
        if self.delays:
            late = late.copy()
        for j, whole, part in self.delays:
            late[j] = (1.0 - part) * self.sent[whole][j] + part * self.sent[whole + 1][j]
        self.last = late if self.last is None else self.kept * self.last + (1.0 - self.kept) * late
        return self.last


class Stribeck:
    """level = coulomb + (breakaway - coulomb) exp(-(qd / velocity)^2)"""

    def __init__(self, arm, values):
        self.joint, self.coulomb = arm.joint(values), values["coulomb_nm"]
        self.excess = values["breakaway_nm"] - self.coulomb
        self.velocity = values["stribeck_velocity_rad_per_s"]

    def __call__(self, at, efforts):
        level = self.coulomb + self.excess * math.exp(-((at.motor_qd[self.joint] / self.velocity) ** 2))
        efforts.forward[self.joint] += level
        efforts.backward[self.joint] += level


class PositionDependent:
    """level (1 + share cos(periods q + phase))"""

    def __init__(self, arm, values):
        self.joint, self.level, self.share = arm.joint(values), values["level_nm"], values["share"]
        self.periods, self.phase = values["periods_per_turn"], values["phase_rad"]

    def __call__(self, at, efforts):
        angle = self.periods * at.motor_q[self.joint] + self.phase
        level = self.level * (1.0 + self.share * math.cos(angle))
        efforts.forward[self.joint] += level
        efforts.backward[self.joint] += level


class LoadDependent:
    """level = coefficient |load|, the load of the step before"""

    def __init__(self, arm, values):
        self.joint, self.coefficient = arm.joint(values), values["coefficient"]

    def __call__(self, at, efforts):
        level = self.coefficient * abs(at.load[self.joint])
        efforts.forward[self.joint] += level
        efforts.backward[self.joint] += level


class Presliding:
    """-(k z + d zd), zd = qd - k |qd| z / level: over a way the deflection goes to its end as exp(-k way / level)."""

    def __init__(self, arm, values):
        self.joint, self.level = arm.joint(values), values["level_nm"]
        self.stiffness, self.damping = values["stiffness_nm_per_rad"], values["damping_nm_s_per_rad"]
        self.share, self.last = 0.0, None

    def __call__(self, at, efforts):
        q, qd = at.motor_q[self.joint], at.motor_qd[self.joint]
        way = 0.0 if self.last is None else q - self.last
        self.last = q
        self.share += (math.copysign(1.0, way) - self.share) * -math.expm1(-abs(way) * self.stiffness / self.level)
        efforts.bristles[self.joint] -= self.level * self.share
        efforts.viscous[self.joint] += self.damping * (1.0 - math.copysign(1.0, qd) * self.share)


class Drift:
    """1 - share (1 - exp(-t / time constant)) of all friction"""

    def __init__(self, arm, values):
        self.joint = slice(None) if values.get("joint") is None else arm.joint(values)
        self.share, self.time_constant_s = values["share"], values["time_constant_s"]

    def __call__(self, at, efforts):
        left = 1.0 + self.share * math.expm1(-max(at.time_s, 0.0) / self.time_constant_s)
        for friction in (efforts.forward, efforts.backward, efforts.viscous, efforts.bristles):
            friction[self.joint] *= left


class Ripple:
    """amplitude sin(periods q + phase), against the motor"""

    def __init__(self, arm, values):
        self.joint, self.amplitude = arm.joint(values), values["amplitude_nm"]
        self.periods, self.phase = values["periods_per_turn"], values["phase_rad"]

    def __call__(self, at, efforts):
        angle = self.periods * at.motor_q[self.joint] + self.phase
        efforts.motor[self.joint] -= self.amplitude * math.sin(angle)


class Cable:
    """-(k x + cubic x^3 + h) at the link, h a second spring of the same stiffness that slides at the hysteresis"""

    def __init__(self, arm, values):
        self.joint, self.rest, self.pulls = arm.joint(values), values["rest_rad"], values.get("pulls", "both")
        self.stiffness, self.cubic = values["stiffness_nm_per_rad"], values.get("cubic_nm_per_rad3", 0.0)
        self.most, self.sliding, self.last = values.get("hysteresis_nm", 0.0), 0.0, None

    def one_sided(self, x):
        return {"both": x, "above": max(x, 0.0), "below": min(x, 0.0)}[self.pulls]

    def __call__(self, at, efforts):
        x = self.one_sided(at.q[self.joint] - self.rest)
        way = 0.0 if self.last is None else x - self.last
        self.last = x
        self.sliding = min(max(self.sliding + self.stiffness * way, -self.most), self.most)
        efforts.link[self.joint] -= self.one_sided(self.stiffness * x + self.cubic * x**3 + self.sliding)


class Counterbalance:
    """-amplitude sin(q + phase) at the link"""

    def __init__(self, arm, values):
        self.joint, self.amplitude, self.phase = arm.joint(values), values["amplitude_nm"], values["phase_rad"]

    def __call__(self, at, efforts):
        efforts.link[self.joint] -= self.amplitude * math.sin(at.q[self.joint] + self.phase)


class Periodic:
    """amplitude sin(2 pi frequency t + phase) at the link"""

    def __init__(self, arm, values):
        self.joint, self.amplitude = arm.joint(values), values["amplitude_nm"]
        self.omega, self.phase = 2.0 * math.pi * values["frequency_hz"], values["phase_rad"]

    def __call__(self, at, efforts):
        efforts.link[self.joint] += self.amplitude * math.sin(self.omega * at.time_s + self.phase)


class Push:
    """A force at the origin of a link for a while"""

    def __init__(self, _arm, values):
        self.link, self.force = values["link"], np.array(values["force_n"], dtype=float)
        self.start_s, self.end_s = values["start_s"], values["start_s"] + values["duration_s"]

    def __call__(self, at, efforts):
        if self.start_s <= at.time_s < self.end_s:
            efforts.pushes.append((self.link, self.force))
