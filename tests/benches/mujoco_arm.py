"""An arm in MuJoCo, with the causes of a trial by MuJoCo's own means where it has them.

    elasticity            a second joint of the same axis with stiffness and damping; the first carries the rotor
    backlash              the range of that second joint
    dry friction          `frictionloss`, set anew in every step where its level varies; of a differential on tendons
    bristles, ripple, cables, disturbances    forces on the joints
    bodies, gravity, rotors, viscous friction the model's

    motor  M qdd + C qd + g + friction = tau,   q_link = q_motor + twist
"""

import xml.etree.ElementTree as tree

import mujoco
import numpy as np

from mujoco_causes import CAUSES, LeftOut, steiner
from mujoco_laws import Late


class Drives:
    """What stands between the controller and the joints, by joint."""

    def __init__(self, names, described):
        joints, count = described.get("joint", {}), len(names)
        lacks = [name for name in names if "kp_nm_per_rad" not in joints.get(name, {})]
        if lacks:
            raise LeftOut(f"joint {lacks[0]} has no gains")
        self.kp = np.array([joints[name]["kp_nm_per_rad"] for name in names])
        self.kd = np.array([joints[name]["kd_nm_s_per_rad"] for name in names])
        self.gain, self.offset = np.ones(count), np.zeros(count)
        # What an encoder reads of a true position: q / ratio + zero.
        self.ratio, self.zero = np.ones(count), np.zeros(count)
        # Most that a drive gives of its command; time (s) by which it is late, and of its lag.
        self.most, self.delay_s, self.lag_s = np.full(count, np.inf), np.zeros(count), np.zeros(count)


class Moment:
    """State at the beginning of a step: motors, links, torque that the drives carried in the step before."""

    def __init__(self, count):
        self.time_s, self.step_s = 0.0, 0.0
        self.motor_q, self.motor_qd, self.q, self.qd, self.load = (np.zeros(count) for _ in range(5))


class Efforts:
    """Torques of one step (N m or N), and the levels of dry and viscous friction at the motors."""

    def __init__(self, motor, dry, viscous, count):
        self.motor, self.link, self.bristles = motor.copy(), np.zeros(count), np.zeros(count)
        self.forward, self.backward, self.viscous = dry[0].copy(), dry[1].copy(), viscous.copy()
        # Force (N) and link, in the frame of the base.
        self.pushes = []


class Arm:
    """The model of a trial, and one without drives for the torque behind them."""

    def __init__(self, mjcf, effects, described):
        root = tree.fromstring(mjcf)
        self.names = [joint.get("name") for body in root.iter("body") for joint in body.findall("joint")]
        self.drives, count = Drives(self.names, described), len(self.names)
        self.dry, self.viscous = np.zeros((2, count)), np.zeros(count)
        self.twists, self.tendons, self.laws = {}, [], []
        self.rotors, self.skew_s, self.goal_delay_s = np.zeros(count), np.zeros(count), 0.0
        self.needs_load, self.at_links = False, np.zeros(count)
        self.bare = mujoco.MjModel.from_xml_string(mjcf)
        effects = [next(iter(effect.items())) for effect in effects]
        # A drift scales all friction that there is.
        for kind, values in sorted(effects, key=lambda effect: effect[0] == "friction_temperature_drift"):
            put = CAUSES.get(kind)
            if put is None:
                raise LeftOut(f"no {kind} is made here")
            put(self, values)
        self.build(root)
        self.behind, self.late = mujoco.MjData(self.bare), Late(self.drives)
        self.moment = Moment(count)
        # Nothing that varies from step to step: steps need not be taken one by one.
        self.is_plain = not (self.laws or self.twists or self.late.acts or self.needs_load)

    def build(self, root):
        for body in root.iter("body"):
            for place, joint in reversed(list(enumerate(body))):
                twist = self.twists.get(joint.get("name")) if joint.tag == "joint" else None
                if twist is not None:
                    body.insert(place + 1, twist.element(joint))
        if self.tendons:
            tendon = tree.SubElement(root, "tendon")
            for number, (joints, level) in enumerate(self.tendons):
                fixed = tree.SubElement(tendon, "fixed", name=f"motor_{number}", frictionloss=str(level))
                for name, turn in joints:
                    tree.SubElement(fixed, "joint", joint=name, coef=str(turn))
        self.model = mujoco.MjModel.from_xml_string(tree.tostring(root, encoding="unicode"))
        model, bare = self.model, self.bare
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        of = lambda name: model.jnt_dofadr[model.joint(name).id]
        self.motor = np.array([of(name) for name in self.names])
        twists = [(j, self.twists.get(name)) for j, name in enumerate(self.names)]
        self.elastic = [(j, of(self.names[j] + "_twist"), twist) for j, twist in twists if twist is not None]
        # Limits would push; the population's simulator has no joint stops.
        for name in self.names:
            model.jnt_limited[model.joint(name).id] = 0
        bare.jnt_limited[:] = 0
        limits = bare.jnt_actfrcrange
        self.limit = np.where(bare.jnt_actfrclimited[:] > 0, limits[:, 1], np.inf)
        # A described spring is at the link.
        self.springs = [(j, bare.jnt_stiffness[j], bare.qpos_spring[j]) for j, _, _ in self.elastic]
        for j, _, _ in self.elastic:
            model.jnt_stiffness[model.joint(self.names[j]).id] = 0.0
        model.dof_armature[self.motor] += self.rotors
        model.opt.gravity[:] = bare.opt.gravity
        for of in ("body_mass", "body_ipos", "body_iquat", "body_inertia"):
            getattr(model, of)[:] = getattr(bare, of)
        for of in ("dof_armature", "dof_damping", "dof_frictionloss"):
            getattr(bare, of)[:] = 0.0
        self.dry += model.dof_frictionloss[self.motor]
        self.viscous += model.dof_damping[self.motor]
        for one in (model, bare):
            mujoco.mj_setConst(one, mujoco.MjData(one))

    def joint(self, values, key="joint"):
        return self.names.index(values[key])

    def start(self, q, qd, step_s):
        """The arm in motion, to be moved in steps of a length (s)."""
        self.model.opt.timestep = step_s
        self.late.start(step_s)
        data = mujoco.MjData(self.model)
        data.qpos[self.motor], data.qvel[self.motor] = q, qd
        return data

    def observe(self, data):
        at = self.moment
        at.motor_q, at.motor_qd = data.qpos[self.motor], data.qvel[self.motor]
        at.q, at.qd = at.motor_q.copy(), at.motor_qd.copy()
        for j, dof, _ in self.elastic:
            at.q[j] += data.qpos[dof]
            at.qd[j] += data.qvel[dof]
        return at

    def step(self, data, command, time_s, wants_load):
        """One step under a command (N m or N of the controller): the torque of the motors. `moment.load` is that of
        this step where it is wanted."""
        at, drives = self.observe(data), self.drives
        at.time_s, at.step_s = time_s, self.model.opt.timestep
        torque = (self.late.follow(command) - drives.offset) / drives.gain
        efforts = Efforts(torque, self.dry, self.viscous, len(self.names))
        for law in self.laws:
            law(at, efforts)
        self.apply(data, at, efforts)
        mujoco.mj_step(self.model, data)
        if self.needs_load or wants_load:
            q, qd = at.q, at.qd
            after = self.observe(data)
            at.load = self.torque_behind_drives(q, qd, (after.qd - qd) / at.step_s) - self.at_links
        return torque

    def apply(self, data, at, efforts):
        shift = 0.5 * (efforts.forward - efforts.backward)
        self.model.dof_frictionloss[self.motor] = np.maximum(0.5 * (efforts.forward + efforts.backward), 0.0)
        self.model.dof_damping[self.motor] = np.maximum(efforts.viscous, 0.0)
        link = efforts.link
        for name, force in efforts.pushes:
            body, pushed = self.model.body(name).id, np.zeros(self.model.nv)
            mujoco.mj_applyFT(self.model, data, force, np.zeros(3), data.xpos[body], body, pushed)
            link = link + pushed[self.motor]
        self.at_links = link.copy()
        for j, stiffness, rest in self.springs:
            link[j] -= stiffness * (at.q[j] - rest)
        data.qfrc_applied[self.motor] = efforts.motor + efforts.bristles - shift + link
        for j, dof, twist in self.elastic:
            data.qfrc_applied[dof] = link[j] + twist.contact(data.qpos[dof], data.qvel[dof])

    def torque_behind_drives(self, q, qd, qdd):
        """M(q) qdd + C(q, qd) qd + g(q) + springs, without rotors and friction (N m or N)."""
        self.behind.qpos[:], self.behind.qvel[:], self.behind.qacc[:] = q, qd, qdd
        mujoco.mj_inverse(self.bare, self.behind)
        return self.behind.qfrc_inverse.copy()

    def body_of(self, link):
        """Mass, centre of mass and inertia about it, in the frame of the link."""
        body = self.bare.body(link).id
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, self.bare.body_iquat[body])
        turn = turn.reshape(3, 3)
        about_com = turn @ np.diag(self.bare.body_inertia[body]) @ turn.T
        return self.bare.body_mass[body], self.bare.body_ipos[body].copy(), about_com

    def add_body(self, link, mass, com, about_com):
        """Adds a body to a link; one that is taken away has a negative mass. Mass, first moment and inertia about
        the link's origin add."""
        parts = [self.body_of(link), (mass, com, about_com)]
        body, total = self.bare.body(link).id, sum(m for m, _, _ in parts)
        centre = sum(m * c for m, c, _ in parts) / total
        inertia = sum(i + m * steiner(c - centre) for m, c, i in parts)
        moments, axes = np.linalg.eigh(inertia)
        axes[:, 2] *= np.sign(np.linalg.det(axes))
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, axes.flatten())
        self.bare.body_mass[body], self.bare.body_ipos[body] = total, centre
        self.bare.body_inertia[body], self.bare.body_iquat[body] = moments, quat
