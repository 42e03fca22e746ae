"""A set of CauseBench for the entrants beside this file: trials read, signals differentiated, answers written.

Nothing of Plumbline is used: NumPy alone, Pinocchio for the bodies of an arm, and MuJoCo for the torque of an MJCF.
"""

import json
import os
import sys
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

CUTOFF_HZ = 10.0  # Of the motion that is differentiated, and of every signal that is compared with it.


# What a regression may name at a joint: effect, parameter, and the attribute of an MJCF joint that has its described value.
DRIVE = [("IN03", "inertia", "armature"), ("FR01", "viscous", "damping"), ("FR02", "level", "frictionloss"), ("DR03", "offset", None)]
# A parameter is named that many deviations and that share of the joint's effort off; its interval is Z deviations wide.
STANDARD_ERRORS, LEAST_SHARE, Z = 3.0, 0.02, 1.96


def low_pass(x, step, cutoff_hz=CUTOFF_HZ):
    """Gaussian low-pass without phase: `exp(-(f / cutoff)^2 / 2)` on the signal and its mirror image."""
    turned = np.concatenate([x, x[::-1]])
    frequency = np.fft.rfftfreq(len(turned), step)
    kept = np.exp(-0.5 * (frequency / cutoff_hz) ** 2)
    return np.fft.irfft(np.fft.rfft(turned, axis=0) * kept[:, None], len(turned), axis=0)[: len(x)]


class Log:
    """Signals of a log at even times: `q`, `qd`, `qdd`, `tau`, each [row, joint] (rad or m, per s, N m or N)."""

    def __init__(self, path, joints, cutoff_hz=CUTOFF_HZ):
        with np.load(path) as columns:
            self.rows = columns["time"]
            step = np.median(np.diff(self.rows))
            self.time = np.arange(self.rows[0], self.rows[-1], step)
            self.step = step
            at = lambda name: np.interp(self.time, self.rows, columns[name])
            position = np.stack([at(f"{joint}.position") for joint in joints], axis=1)
            has_effort = f"{joints[0]}.effort" in columns
            self.raw = np.stack([at(f"{joint}.effort") for joint in joints], axis=1) if has_effort else None
        self.q = low_pass(position, step, cutoff_hz)
        self.qd = np.gradient(self.q, step, axis=0)
        self.qdd = np.gradient(self.qd, step, axis=0)
        self.tau = None if self.raw is None else low_pass(self.raw, step, cutoff_hz)


class Trial:
    """A trial of the set: its logs, and the answer to it."""

    def __init__(self, folder, answers, entry):
        self.folder, self.answers, self.name = folder, answers, entry["name"]
        self.joints, self.links, self.source = entry["joints"], entry["links"], entry["effort_source"]
        self.urdf, self.mjcf, self.description = (folder / entry[k] for k in ("urdf", "mjcf", "description"))
        self.log_files = [folder / log["npz"] for log in entry["logs"]]
        self.held_out_file = folder / entry["held_out"]["npz"]

    def logs(self):
        return [Log(path, self.joints) for path in self.log_files]

    def held_out(self, cutoff_hz=50.0):
        """The held-out log: without noise, so that its motion is differentiated up to 50 Hz."""
        return Log(self.held_out_file, self.joints, cutoff_hz)

    def predict(self, log, tau):
        """Writes efforts [row, joint] at `log.time` as the prediction; returns its file."""
        columns = {"time": log.rows}
        for j, joint in enumerate(self.joints):
            columns[f"{joint}.effort"] = np.interp(log.rows, log.time, tau[:, j])
        name = f"{self.name}.prediction.npz"
        np.savez(self.answers / name, **columns)
        return name

    def hand_in(self, text):
        """Writes an MJCF as the model of the answer; returns its file."""
        name = f"{self.name}.model.xml"
        (self.answers / name).write_text(text)
        return name


class DescribedArm:
    """The bodies of a trial for Pinocchio (`model`), and its drives as the MJCF describes them."""

    dry = staticmethod(np.sign)  # Dry friction over its level, by the velocity.

    def __init__(self, trial):
        import pinocchio

        text = trial.urdf.read_text().replace('type="continuous"', 'type="revolute"')
        self.model, self.joints = pinocchio.buildModelFromXML(text), trial.joints
        self.xml = ET.fromstring(trial.mjcf.read_text())
        option = self.xml.find("option")
        gravity = option.get("gravity", "0 0 -9.81") if option is not None else "0 0 -9.81"
        self.model.gravity.linear = np.array([float(x) for x in gravity.split()])
        self.at = [self.model.joints[self.model.getJointId(name)].idx_v for name in trial.joints]
        self.in_xml = {one.get("name"): one for one in self.xml.iter("joint")}

    def described(self, joint, attribute):
        """The described value of an attribute of a joint, 0 where there is none."""
        at = self.in_xml.get(joint)
        return 0.0 if attribute is None or at is None else float((at.get(attribute) or "0").split()[0])

    def motion(self, log):
        """q, qd and qdd, each [row, joint of the model]."""
        every = [np.zeros((len(log.q), self.model.nv)) for _ in range(3)]
        for one, of in zip(every, (log.q, log.qd, log.qdd)):
            one[:, self.at] = of
        return every

    def name(self, logs, found):
        """Names of the drives' parameters, and their values into the MJCF.

        `found` has value, standard deviation and whether it may be named by (joint, effect).
        """
        every = [np.concatenate([getattr(log, key) for log in logs]) for key in ("qdd", "qd", "tau")]
        names = []
        for j, joint in enumerate(self.joints):
            qdd, qd, tau = (one[:, j] for one in every)
            rms = [np.sqrt((one**2).mean()) for one in (qdd, qd, self.dry(qd), np.ones(1))]
            for share, (effect, parameter, attribute) in zip(rms, DRIVE):
                if (joint, effect) not in found:
                    continue
                value, error, may_be_named = found[joint, effect]
                described = self.described(joint, attribute)
                off, least = abs(value - described), LEAST_SHARE * np.sqrt((tau**2).mean())
                if attribute:
                    self.in_xml[joint].set(attribute, repr(max(float(value), 0.0)))
                if may_be_named and off > STANDARD_ERRORS * error and off * share > least:
                    interval = [float(value - Z * error), float(value + Z * error)]
                    size = {"parameter": parameter, "value": float(value), "interval": interval, "described": described}
                    names.append({"effect": effect, "joint": joint, "sizes": [size]})
        return names

    def as_described(self, trial):
        """The answer where no log has efforts: no name, and the torque of the described arm."""
        import pinocchio

        log, data = trial.held_out(), self.model.createData()
        rows = zip(*self.motion(log))
        tau = np.stack([pinocchio.rnea(self.model, data, *row)[self.at] for row in rows])
        for j, joint in enumerate(self.joints):
            drive = [log.qdd[:, j], log.qd[:, j], self.dry(log.qd[:, j]), 0.0]
            tau[:, j] += sum(self.described(joint, one[2]) * signal for one, signal in zip(DRIVE, drive))
        return {"names": [], "prediction": trial.predict(log, tau), "model": trial.hand_in(self.text())}

    def text(self):
        """The MJCF with what `name` found."""
        return ET.tostring(self.xml, encoding="unicode")


def sparse(log):
    """Every which row of a log is taken: twice the cut-off of its signals."""
    return max(1, round(1 / (2 * CUTOFF_HZ * log.step)))


def answer_all(answer):
    """Answers every trial of the set that the command line names; a trial that fails has no answer, and says why.

    On a cluster, where CAUSE_BENCH_PART is K/N, a part of them, and of these what has no answer yet.
    """
    folder, answers = map(Path, sys.argv[1:3])
    answers.mkdir(parents=True, exist_ok=True)
    of_cluster = os.environ.get("CAUSE_BENCH_PART")
    part, parts = map(int, (of_cluster or "1/1").split("/"))
    for entry in json.loads((folder / "manifest.json").read_text())["trials"][part - 1 :: parts]:
        if of_cluster and (answers / f"{entry['name']}.json").exists():
            continue
        trial, begin = Trial(folder, answers, entry), time.process_time()
        try:
            said = answer(trial)
        except Exception as error:  # Whatever stops a method at a trial: the others are still answered.
            print(f"{trial.name}: {type(error).__name__}: {error}", flush=True)
            continue
        said.setdefault("seconds", time.process_time() - begin)
        # The answer comes last and whole: what a killed entrant leaves is no answer.
        begun = answers / f"{trial.name}.json.begun"
        begun.write_text(json.dumps(said))
        begun.replace(answers / f"{trial.name}.json")


def mjcf_torque(model, joints, log):
    """Efforts [row, joint] (N m or N) along a motion by an MJCF:

    tau = inverse dynamics of the bodies with armature + damping qd + frictionloss sign(qd)
    """
    import mujoco

    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data = mujoco.MjData(model)
    ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, joint) for joint in joints]
    at, dof = model.jnt_qposadr[ids], model.jnt_dofadr[ids]
    tau = np.empty_like(log.q)
    for k in range(len(log.q)):
        data.qpos[at], data.qvel[dof], data.qacc[dof] = log.q[k], log.qd[k], log.qdd[k]
        mujoco.mj_inverse(model, data)
        tau[k] = data.qfrc_inverse[dof]
    # Dry friction is a constraint of MuJoCo, which is switched off above: here it acts in full.
    return tau + model.dof_frictionloss[dof] * np.tanh(log.qd / 1e-3)
