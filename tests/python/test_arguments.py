"""What the functions of ``plumbline`` take, and what they refuse. ``PLUMBLINE_ROOT`` is the folder of the repository."""

import os
import sys
import unittest
from pathlib import Path

import numpy as np

import plumbline

ROOT = Path(os.environ["PLUMBLINE_ROOT"])
WAM = ROOT / "robots/wam7/robot.toml"
HIDDEN = ROOT / "scenarios/demos/wam.toml"
JOINTS = 7


def states(samples):
    random = np.random.default_rng(1)
    return [random.normal(size=(samples, JOINTS)) for _ in range(3)]


class InverseDynamics(unittest.TestCase):
    def setUp(self):
        self.robot = plumbline.Robot(WAM)

    def torque(self, *arrays):
        return plumbline.inverse_dynamics(self.robot, *arrays)

    def test_one_state_is_a_row_of_many(self):
        q, qd, qdd = states(5)
        tau = self.torque(q, qd, qdd)
        self.assertEqual(tau.shape, (5, JOINTS))
        np.testing.assert_array_equal(self.torque(q[2], qd[2], qdd[2]), tau[2])

    def test_a_robot_at_rest_holds_itself_and_moves_linearly_in_its_acceleration(self):
        q, _, qdd = states(4)
        rest = np.zeros_like(q)
        held = self.torque(q, rest, rest)
        once, twice = self.torque(q, rest, qdd), self.torque(q, rest, 2 * qdd)
        np.testing.assert_allclose(twice - held, 2 * (once - held), atol=1e-9)
        self.assertGreater(np.abs(held).max(), 1.0)

    def test_every_order_in_memory_and_every_real_type_gives_the_same(self):
        q, qd, qdd = (np.round(16 * x) / 16 for x in states(6))
        expected = self.torque(q, qd, qdd)
        np.testing.assert_array_equal(self.torque(np.asfortranarray(q), qd, qdd), expected)
        np.testing.assert_array_equal(self.torque(q[::2], qd[::2], qdd[::2]), expected[::2])
        np.testing.assert_array_equal(self.torque(q[::-1], qd[::-1], qdd[::-1]), expected[::-1])
        np.testing.assert_array_equal(self.torque(q.astype(np.float32), qd, qdd), expected)
        np.testing.assert_array_equal(self.torque(q.tolist(), qd.astype(">f8"), qdd), expected)
        np.testing.assert_array_equal(self.torque(q.astype(np.longdouble), qd, qdd), expected)
        shifted = np.frombuffer(b"0" + q.tobytes(), offset=1).reshape(q.shape)
        np.testing.assert_array_equal(self.torque(shifted, qd, qdd), expected)
        fixed = q.copy()
        fixed.flags.writeable = False
        np.testing.assert_array_equal(self.torque(fixed, fixed, fixed), self.torque(q, q, q))
        repeated = np.broadcast_to(q[0], q.shape)
        np.testing.assert_array_equal(self.torque(repeated, qd, qdd), self.torque(repeated.copy(), qd, qdd))
        self.assertEqual(self.torque(q[:0], qd[:0], qdd[:0]).shape, (0, JOINTS))

    def test_bad_arrays_are_exceptions_that_name_the_argument(self):
        q, qd, qdd = states(4)
        holed = qdd.copy()
        holed[2, 1] = np.nan
        cases = [
            (ValueError, "q", (q[:, :3], qd, qdd)),
            (ValueError, "q", (q[None], qd, qdd)),
            (ValueError, "q", (1.0, qd, qdd)),
            (ValueError, "qd", (q, qd[:2], qdd)),
            (ValueError, "qd", (q, qd[0], qdd)),
            (ValueError, "qdd", (q, qd, holed)),
            (ValueError, "qdd", (q, qd, np.where(qdd > 1, np.inf, qdd))),
            (TypeError, "qd", (q, qd * 1j, qdd)),
            (TypeError, "qd", (q, qd > 0, qdd)),
            (TypeError, "qd", (q, qd.astype(object), qdd)),
            (TypeError, "q", ("a posture", qd, qdd)),
            (TypeError, "q", (None, qd, qdd)),
            (TypeError, "q", ([[1, 2], [3]], qd, qdd)),
            (TypeError, "q", (q.astype("datetime64[s]"), qd, qdd)),
            (TypeError, "q", ((row for row in q), qd, qdd)),
            (ValueError, "q", (np.ma.masked_greater(q, 0), qd, qdd)),
            (ValueError, "q", (q.T, qd, qdd)),
            (ValueError, "q", ([], [], [])),
            (ValueError, "q", (q[:, :0], qd, qdd)),
        ]
        for error, argument, arrays in cases:
            with self.subTest(argument=argument, error=error):
                self.assertRaisesRegex(error, f"^{argument}: ", self.torque, *arrays)
        self.assertRaisesRegex(ValueError, "row 2, joint j2_shoulder_pitch: found NaN", self.torque, q, qd, holed)
        self.assertRaisesRegex(TypeError, "^robot: ", plumbline.inverse_dynamics, str(WAM), q, qd, qdd)


class Logs(unittest.TestCase):
    def setUp(self):
        self.robot = plumbline.Robot(WAM)
        self.time = np.arange(0, 2, 0.01)
        self.q = np.sin(self.time)[:, None] * np.linspace(0.1, 0.5, JOINTS)
        self.tau = 2 * self.q

    def test_signals_come_back_as_they_were(self):
        log = plumbline.Log(self.time, self.q, self.tau, joints=self.robot.joints).on(self.robot)
        np.testing.assert_array_equal(log.q, self.q)
        np.testing.assert_array_equal(log.tau, self.tau)
        self.assertIsNone(log.qd)

    def test_joints_are_found_by_name(self):
        turned = list(reversed(self.robot.joints))
        log = plumbline.Log(self.time, self.q[:, ::-1], self.tau[:, ::-1], joints=turned)
        np.testing.assert_array_equal(log.on(self.robot).q, self.q)

    def test_a_frame_is_a_log(self):
        frame = {"time": self.time, "note": ["a"] * len(self.time)}
        for j, joint in enumerate(self.robot.joints):
            frame[f"{joint}.position"], frame[f"{joint}.effort"] = self.q[:, j], self.tau[:, j]
        frames = [frame]
        for library in ("pandas", "polars"):
            try:
                frames.append(__import__(library).DataFrame(frame))
            except ImportError:
                print(f"no {library} here: its frames are left out", file=sys.stderr)
        for frame in frames:
            np.testing.assert_array_equal(plumbline.Log.from_frame(frame).on(self.robot).q, self.q)
        self.assertRaises(TypeError, plumbline.Log.from_frame, 3)
        self.assertRaisesRegex(KeyError, "time", plumbline.Log.from_frame, {"a.position": self.q[:, 0]})

    def test_bad_logs_are_exceptions_that_name_the_argument(self):
        time, q, tau, robot = self.time, self.q, self.tau, self.robot
        back = time.copy()
        back[7] = 0.0
        holed = q.copy()
        holed[3, 2] = np.nan
        cases = [
            ("q: ", lambda: plumbline.Log(time, q[:5], tau)),
            ("q: ", lambda: plumbline.Log(time, holed, tau)),
            (r"q: row 3, column 2", lambda: plumbline.Log(time, holed, tau)),
            (r"q: .*\(samples, joints\)", lambda: plumbline.Log(time, q[:, 0], tau)),
            (r"q: .*\(samples, joints\)", lambda: plumbline.Log(time, q[None], tau)),
            ("q: ", lambda: plumbline.Log(time, np.ma.masked_greater(q, 0.1), tau)),
            ("qd: ", lambda: plumbline.Log(time, q, tau, qd=q[:3])),
            ("time: ", lambda: plumbline.Log(q, q, tau)),
            ("time: ", lambda: plumbline.Log(np.where(time > 1, np.nan, time), q, tau)),
            ("tau: ", lambda: plumbline.Log(time, q, tau[:, :3])),
            ("joints: ", lambda: plumbline.Log(time, q, tau, joints=["a"] * JOINTS)),
            ("joints: ", lambda: plumbline.Log(time, q, tau, joints=[])),
            ("name: ", lambda: plumbline.Log(time, q, tau, name="\ud800")),
            ("at least 2", lambda: plumbline.Log(time[:0], q[:0], tau[:0]).on(robot)),
            ("a.effort", lambda: plumbline.Log.from_frame({"time": time, "a.effort": q})),
            ("joints: ", lambda: plumbline.Log(time, q, tau, joints=list("abcdefg")).on(robot)),
            ("q: ", lambda: plumbline.Log(time, q[:, :3], tau[:, :3]).on(robot)),
            ("time", lambda: plumbline.Log(back, q, tau).on(robot)),
            ("no such file", lambda: plumbline.Log.read("absent.csv")),
            ("log.on", lambda: plumbline.Log.read(__file__).q),
            ("cutoff_hz: ", lambda: plumbline.diagnose(robot, plumbline.Log(time, q, tau), cutoff_hz=-1.0)),
            ("absent", lambda: plumbline.Robot(WAM, joints=["absent"])),
            ("format: ", lambda: robot.export("obj")),
        ]
        for words, call in cases:
            with self.subTest(words=words):
                self.assertRaisesRegex(ValueError, words, call)

    def test_lists_are_arrays_and_a_generator_is_a_list(self):
        log = plumbline.Log(self.time.tolist(), self.q.tolist(), self.tau.astype(np.float32))
        np.testing.assert_array_equal(log.on(self.robot).q, self.q)
        # It gets as far as the length of the log.
        logs = (log for _ in "a")
        diagnose = plumbline.diagnose
        self.assertRaisesRegex(plumbline.PlumblineError, "stretches", diagnose, self.robot, logs, progress=False)


class Arguments(unittest.TestCase):
    """What is no array either: each exception begins with the name of the argument."""

    def setUp(self):
        time = np.arange(0, 2, 0.01)
        q = np.sin(time)[:, None] * np.linspace(0.1, 0.5, JOINTS)
        self.robot, self.log = plumbline.Robot(WAM), plumbline.Log(time, q, q)
        self.arrays = (time, q, q)
        with open(__file__) as self.closed:
            pass

    def test_of_another_type(self):
        robot, log, arrays, closed = self.robot, self.log, self.arrays, self.closed
        model = plumbline.Model.described(robot)
        cases = [
            ("path", lambda: plumbline.Log.read(closed)),
            ("path", lambda: plumbline.Log.read(b"run.csv")),
            ("path", lambda: plumbline.Robot(closed)),
            ("path", lambda: plumbline.Robot(None)),
            ("path", lambda: plumbline.Model.load(closed, robot)),
            ("path", lambda: model.save(closed)),
            ("path", lambda: robot.export("urdf").save(closed)),
            ("scenario", lambda: plumbline.simulate(closed)),
            ("scenario", lambda: plumbline.track(closed)),
            ("out", lambda: plumbline.track(HIDDEN, closed)),
            ("map", lambda: plumbline.Log.read(__file__, map=3)),
            ("effort", lambda: plumbline.Log.read(__file__, effort=3)),
            ("topic", lambda: plumbline.Log.read(__file__, topic=3)),
            ("episode", lambda: plumbline.Log.read(__file__, episode="1")),
            ("until_damage", lambda: plumbline.Log.read(__file__, until_damage="yes")),
            ("name", lambda: plumbline.Log(*arrays, name=3)),
            ("joints", lambda: plumbline.Log(*arrays, joints="abcdefg")),
            ("joints", lambda: plumbline.Log(*arrays, joints=[1] * JOINTS)),
            ("joints", lambda: plumbline.Robot(WAM, joints="j1_base_yaw")),
            ("locked", lambda: plumbline.Robot(WAM, locked=["j1_base_yaw"])),
            ("locked", lambda: plumbline.Robot(WAM, locked={"j1_base_yaw": "here"})),
            ("packages", lambda: plumbline.Robot(WAM, packages=3)),
            ("packages", lambda: plumbline.Robot(WAM, packages={"arm": closed})),
            ("allow_outside", lambda: plumbline.Robot(WAM, allow_outside=1)),
            ("robot", lambda: log.on(WAM)),
            ("robot", lambda: plumbline.diagnose(WAM, log)),
            ("robot", lambda: plumbline.inverse_dynamics(None, *arrays)),
            ("named", lambda: plumbline.learn(robot, log, "rbd", named=WAM)),
            ("format", lambda: robot.export(3)),
            ("logs", lambda: plumbline.diagnose(robot, [3])),
            ("logs", lambda: plumbline.diagnose(robot, "run.csv")),
            ("logs", lambda: plumbline.diagnose(robot, None)),
            ("logs", lambda: model.error("run.csv")),
            ("cutoff_hz", lambda: plumbline.diagnose(robot, log, cutoff_hz="10")),
            ("without", lambda: plumbline.diagnose(robot, log, without="FR01")),
            ("without", lambda: plumbline.compare(robot, log, log, without=[1])),
            ("progress", lambda: plumbline.diagnose(robot, log, progress=3)),
            ("progress", lambda: plumbline.diagnose(robot, log, progress=arrays[1])),
            ("model", lambda: plumbline.learn(robot, log, 3)),
            ("points", lambda: plumbline.learn(robot, log, "gp", points=3.5)),
            ("rest_speed", lambda: plumbline.Model.described(robot, rest_speed="slow")),
            ("seed", lambda: plumbline.simulate(HIDDEN, seed="one")),
            ("set", lambda: plumbline.simulate(HIDDEN, set="seed=1")),
            ("duration_s", lambda: plumbline.design(robot, separate=("FR01@a", "FR02@a"), duration_s="5")),
            ("name", lambda: log.signal(3)),
        ]
        for argument, call in cases:
            with self.subTest(argument=argument):
                self.assertRaisesRegex(TypeError, f"^{argument}: found .* expected$", call)

    def test_of_another_value(self):
        robot, log = self.robot, self.log
        cases = [
            ("episode", lambda: plumbline.Log.read(__file__, episode=-1)),
            ("episode", lambda: plumbline.Log.read(__file__, episode=2**80)),
            ("points", lambda: plumbline.learn(robot, log, "gp", points=-1)),
            ("seed", lambda: plumbline.simulate(HIDDEN, seed=-1)),
            ("cutoff_hz", lambda: plumbline.diagnose(robot, log, cutoff_hz=float("nan"))),
            ("cutoff_hz", lambda: plumbline.diagnose(robot, log, cutoff_hz=0)),
            ("rest_speed", lambda: plumbline.Model.described(robot, rest_speed=0)),
            ("duration_s", lambda: plumbline.design(robot, separate=("FR01@a", "FR02@a"), duration_s=np.nan)),
            ("separate", lambda: plumbline.design(robot, separate=["FR01@a"])),
            ("name", lambda: log.signal("effort")),
        ]
        for argument, call in cases:
            with self.subTest(argument=argument):
                self.assertRaisesRegex(ValueError, f"^{argument}: found .* expected$", call)

    def test_a_file_that_is_not_there_is_told_once(self):
        self.assertRaisesRegex(plumbline.PlumblineError, "^absent.toml: ", plumbline.simulate, "absent.toml")


if __name__ == "__main__":
    unittest.main()
