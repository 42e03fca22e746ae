"""A run of an arm of MuJoCo: the motion that is asked for, the controller, the sensors, the rows of the log."""

import math

import mujoco
import numpy as np

from mujoco_causes import LeftOut

# Longest step (s): the error of a semi-implicit step grows with it; a tenth of a millisecond is the shortest of
# the population's simulator. Where laws act in every step it is that of the trial, if that is between the two.
STEP_S = 1e-4
STEP_OF_LAWS_S = 2.5e-4
# Faster than this (rad/s or m/s) an arm has run away: ten times the speed of arms.
RUNAWAY = 200.0


class Reference:
    """The motion of a log between its rows: the polynomial of degree 5 with position, velocity and acceleration of
    both ends."""

    def __init__(self, table, names, rate_hz):
        stamps = np.array(table["time"])
        # Jitter is far below half a period, so that a stamp tells its tick.
        self.times = np.round(stamps * rate_hz) / rate_hz
        column = lambda kind: np.stack([np.array(table[f"{name}.desired_{kind}"]) for name in names], axis=1)
        self.q, self.qd, self.qdd = column("position"), column("velocity"), column("acceleration")

    def end_s(self):
        return self.times[-1]

    def at(self, t):
        k = int(np.clip(np.searchsorted(self.times, t, side="right") - 1, 0, len(self.times) - 2))
        h = self.times[k + 1] - self.times[k]
        x = (t - self.times[k]) / h
        a0, a1, a2 = self.q[k], self.qd[k] * h, 0.5 * self.qdd[k] * h * h
        p = self.q[k + 1] - a0 - a1 - a2
        v = self.qd[k + 1] * h - a1 - 2.0 * a2
        a = self.qdd[k + 1] * h * h - 2.0 * a2
        a3, a4, a5 = 10 * p - 4 * v + 0.5 * a, -15 * p + 7 * v - a, 6 * p - 3 * v + 0.5 * a
        q = a0 + x * (a1 + x * (a2 + x * (a3 + x * (a4 + x * a5))))
        qd = (a1 + x * (2 * a2 + x * (3 * a3 + x * (4 * a4 + x * 5 * a5)))) / h
        qdd = (2 * a2 + x * (6 * a3 + x * (12 * a4 + x * 20 * a5))) / (h * h)
        return q, qd, qdd


class Sensors:
    """What controller and log read, in the words of `truth/scenario.toml`."""

    def __init__(self, scenario, names, random):
        stated = scenario["sensors"]
        of = lambda key: np.array([stated.get(key, {}).get(name, 0.0) for name in names])
        self.link_lag_s = 1e-3 * stated.get("link_position_lag_ms", 0.0)
        self.step, self.noise = of("position_resolution_rad"), of("position_noise_rad")
        self.link_step, self.link_noise = of("link_position_resolution_rad"), of("link_position_noise_rad")
        self.effort_step, self.effort_noise = of("effort_resolution_nm"), of("effort_noise_nm")
        self.velocity, self.random = stated["velocity"], random
        self.last, self.low = None, np.zeros(len(names))

    def read(self, q, qd, period_s):
        measured = rounded(q + self.noise * self.random.standard_normal(len(q)), self.step)
        if self.velocity == "ideal":
            return measured, qd
        cutoff_hz = self.velocity["filtered_difference"]["cutoff_hz"]
        kept = math.exp(-2.0 * math.pi * cutoff_hz * period_s)
        if self.last is not None:
            self.low = kept * self.low + (1.0 - kept) * (measured - self.last) / period_s
        self.last = measured
        return measured, self.low

    def effort(self, effort):
        return rounded(effort + self.effort_noise * self.random.standard_normal(effort.shape), self.effort_step)

    def link(self, q):
        return rounded(q + self.link_noise * self.random.standard_normal(q.shape), self.link_step)


class Perfect:
    """Sensors without error, of a held-out log."""

    link_lag_s = 0.0

    def read(self, q, qd, _period_s):
        return q, qd

    def effort(self, effort):
        return effort

    def link(self, q):
        return q


def rounded(values, step):
    safe = np.where(step > 0.0, step, 1.0)
    return np.where(step > 0.0, safe * np.round(values / safe), values)


def follow(arm, reference, sensors, scenario, control_hz):
    """The rows of a run at the controller's rate: time, position, velocity, effort, command, link position."""
    period_s = 1.0 / control_hz
    stated_s = 1e-3 * scenario.get("engine", {}).get("step_ms", 0.1)
    longest_s = STEP_S if arm.is_plain else max(STEP_S, min(stated_s, STEP_OF_LAWS_S))
    substeps = math.ceil(period_s / longest_s - 1e-9)
    step_s = period_s / substeps
    drives, source = arm.drives, scenario["sensors"].get("effort", "commanded")
    at_motor = scenario["sensors"].get("position", "motor") == "motor"
    q, qd, _ = reference.at(0.0)
    data = arm.start(q, qd, step_s)
    at_rest = np.all(np.abs(qd) <= 1e-9)
    lead_in = round(max(run.get("lead_in_s", 1.0) for run in scenario["run"]) * control_hz) if at_rest else 0
    before, rows = None, []
    for tick in range(-lead_in, round(reference.end_s() * control_hz) + 1):
        time_s = tick * period_s
        q_ref, qd_ref, _ = reference.at(max(time_s - arm.goal_delay_s, 0.0))
        truth = arm.observe(data)
        q, qd = (truth.motor_q, truth.motor_qd) if at_motor else (truth.q, truth.qd)
        link = truth.q
        measured = sensors.read(q / drives.ratio + drives.zero, qd / drives.ratio, period_s)
        command = np.clip(drives.kp * (q_ref - measured[0]) + drives.kd * (qd_ref - measured[1]), -arm.limit, arm.limit)
        # The velocity of a semi-implicit step belongs to its middle: the first torque is that of both periods.
        mean = command if before is None else 0.5 * (before + command)
        torque = arm.step(data, mean, time_s, source == "link")
        effort = command
        if source != "commanded":
            effort = drives.gain * (torque if source == "motor" else arm.moment.load) + drives.offset
        if arm.is_plain and substeps > 1:
            data.qfrc_applied[arm.motor] += (command - mean) / drives.gain
            mujoco.mj_step(arm.model, data, substeps - 1)
        elif not arm.is_plain:
            for step in range(1, substeps):
                arm.step(data, command, time_s + step * step_s, False)
        before = command
        if not np.all(np.abs(data.qvel) < RUNAWAY):
            raise LeftOut("the arm runs away")
        rows.append((time_s, *measured, effort, command, link))
    columns = late_rows(arm, [np.array(column) for column in zip(*rows)], sensors)
    return [column[lead_in:] for column in columns]


def late_rows(arm, columns, sensors):
    """What is logged late: encoders at the links, and efforts or positions of joints with a skew. The noise of an
    effort comes on top."""
    time, q, qd, effort, command, link = columns
    if sensors.link_lag_s > 0.0:
        link = earlier(time, link, np.full(link.shape[1], sensors.link_lag_s))
    link = sensors.link(link)
    effort = earlier(time, effort, np.maximum(arm.skew_s, 0.0))
    q, qd, link = (earlier(time, signal, np.maximum(-arm.skew_s, 0.0)) for signal in (q, qd, link))
    return time, q, qd, sensors.effort(effort), command, link


def earlier(time, signal, by_s):
    """Every column as it was a time before, linear between rows; the first row's before the first."""
    if not np.any(by_s > 0.0):
        return signal
    return np.stack([np.interp(time - late, time, column) for late, column in zip(by_s, signal.T)], axis=1)


def kept_rows(count, every, sensors, rate_hz, random):
    """Rows that a logger keeps, and what its clock adds to their times (s)."""
    ticks = np.arange(0, count, every)
    kept = random.random(len(ticks)) >= sensors.get("dropped_share", 0.0)
    dropouts = sensors.get("dropouts")
    if dropouts:
        start_s = random.exponential(60.0 / dropouts["per_minute"])
        while start_s <= ticks[-1] / (every * rate_hz):
            at_s = ticks / (every * rate_hz)
            kept &= ~((start_s <= at_s) & (at_s < start_s + 1e-3 * dropouts["length_ms"]))
            start_s += random.exponential(60.0 / dropouts["per_minute"])
    return ticks[kept], 1e-3 * sensors.get("time_jitter_ms", 0.0) * random.standard_normal(kept.sum())
