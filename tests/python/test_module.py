"""The module ``plumbline`` as its users meet it. ``PLUMBLINE_ROOT`` is the folder of the repository."""

import ast
import inspect
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy as np

import plumbline
from plumbline import _plumbline

ROOT = Path(os.environ["PLUMBLINE_ROOT"])
WAM = ROOT / "robots/wam7/robot.toml"
HIDDEN = ROOT / "scenarios/demo.toml"
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
            ("time: ", lambda: plumbline.Log(q, q, tau)),
            ("time: ", lambda: plumbline.Log(np.where(time > 1, np.nan, time), q, tau)),
            ("tau: ", lambda: plumbline.Log(time, q, tau[:, :3])),
            ("joints: ", lambda: plumbline.Log(time, q, tau, joints=["a"] * JOINTS)),
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
        with open(__file__) as file:
            pass
        self.assertRaises(TypeError, plumbline.Log.read, file)
        self.assertRaisesRegex(TypeError, "^logs: ", plumbline.diagnose, robot, [3])
        self.assertRaisesRegex(TypeError, "^logs: ", plumbline.diagnose, robot, "run.csv")


class Answer(unittest.TestCase):
    """One diagnosis of a simulated arm from arrays and one from files."""

    @classmethod
    def setUpClass(cls):
        cls.simulation = plumbline.simulate(HIDDEN, progress=False)
        logs = cls.simulation.logs[:2]
        cls.logs = [plumbline.Log(log.time, log.q, log.tau, name=log.name) for log in logs]
        cls.found = plumbline.diagnose(cls.simulation.robot, cls.logs, progress=False)

    def test_what_is_hidden_is_named_from_arrays(self):
        named = {(finding.code, finding.joint) for finding in self.found.findings}
        self.assertLessEqual({("FR02", "j4_elbow_pitch"), ("FR01", "j2_shoulder_pitch")}, named)
        self.assertIn(self.found.verdict, ("explained", "partly_explained"))

    def test_the_extended_robot_needs_less(self):
        log = self.simulation.logs[2]
        nominal, extended = (
            plumbline.Model.described(robot).error(log)
            for robot in (self.simulation.robot, self.found.robot)
        )
        self.assertLess(np.linalg.norm(extended), 0.5 * np.linalg.norm(nominal))

    def test_formats_and_report_are_there(self):
        self.assertIn("<mujoco", self.found.export("mjcf").text)
        self.assertIn("<robot", self.found.export("urdf").text)
        self.assertIn("<sdf", self.found.export("sdf").text)
        cell = self.found._repr_html_()
        self.assertIn("Coulomb friction", cell)
        with tempfile.TemporaryDirectory() as folder:
            self.found.report(folder, recording=False)
            self.assertEqual(Path(folder, "diagnosis.json").read_text(), self.found.json())
            again = plumbline.Robot(Path(folder, "extended.toml"))
            self.assertEqual(again.joints, self.found.robot.joints)

    def test_files_give_the_bytes_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            self.simulation.save(folder)
            paths = [str(Path(folder, f"{log.name}.parquet")) for log in self.simulation.logs[:2]]
            out = Path(folder, "out")
            command = ["diagnose", "--robot", str(WAM), "--log", *paths, "--out", str(out)]
            command += ["--no-recording", "--quiet"]
            ended = subprocess.run([sys.executable, "-m", "plumbline", *command], check=False)
            self.assertIn(ended.returncode, (0, 1))
            robot, logs = plumbline.Robot(WAM), [plumbline.Log.read(path) for path in paths]
            ours = json.loads(plumbline.diagnose(robot, logs, progress=False).json())
            theirs = json.loads(Path(out, "diagnosis.json").read_text())
            for document in (ours, theirs):
                document["provenance"].pop("command")
            self.assertEqual(ours, theirs)

    def test_other_threads_run_meanwhile_and_progress_is_told(self):
        seen, counted = [], []
        stop = threading.Event()

        def count():
            while not stop.is_set():
                counted.append(None)
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        plumbline.diagnose(
            self.simulation.robot, self.logs, progress=lambda *step: seen.append(step)
        )
        stop.set()
        thread.join()
        self.assertGreater(len(counted), 10)
        self.assertTrue(seen and all(len(step) == 3 for step in seen))

    def test_an_exception_of_progress_ends_the_work(self):
        def ends(*_):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            plumbline.diagnose(self.simulation.robot, self.logs, progress=ends)

    def test_ctrl_c_ends_the_work(self):
        # A shell starts what goes on in the background without Ctrl-C.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            while time.monotonic() < begin + 60:
                plumbline.diagnose(self.simulation.robot, self.logs, progress=False)

    def test_a_model_is_learned_saved_and_read(self):
        model = plumbline.learn(self.simulation.robot, self.logs, "rbd", progress=False)
        q, qd, qdd = states(3)
        with tempfile.TemporaryDirectory() as folder:
            model.save(Path(folder, "rbd.parquet"))
            again = plumbline.Model.load(Path(folder, "rbd.parquet"), self.simulation.robot)
        np.testing.assert_array_equal(again.predict(q, qd, qdd), model.predict(q, qd, qdd))
        self.assertRaisesRegex(ValueError, "^model: ", plumbline.learn, self.simulation.robot, self.logs, "oracle")
        self.assertRaises(plumbline.PlumblineError, plumbline.Model.load, __file__, self.simulation.robot)


class Stubs(unittest.TestCase):
    """The stubs say what is there: every name, and the parameters of every function."""

    def test_stubs_and_module_agree(self):
        path = Path(_plumbline.__file__).with_name("_plumbline.pyi")
        stated, there = {}, {}
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef):
                for item in node.body:
                    if isinstance(item, ast.FunctionDef):
                        stated[f"{node.name}.{item.name}"] = self.parameters(item)
            elif isinstance(node, ast.FunctionDef):
                stated[node.name] = self.parameters(node)
        for name, value in vars(_plumbline).items():
            if inspect.isclass(value) and not issubclass(value, Exception):
                for member, item in vars(value).items():
                    if member == "__new__" and value in (_plumbline.Robot, _plumbline.Log):
                        there[f"{name}.{member}"] = ["cls", *inspect.signature(value).parameters]
                    elif not member.startswith("_"):
                        there[f"{name}.{member}"] = self.names(getattr(value, member), item)
            elif callable(value) and not inspect.isclass(value) and not name.startswith("_"):
                there[name] = list(inspect.signature(value).parameters)
        self.assertEqual(stated, there)

    @staticmethod
    def parameters(function):
        every = function.args.posonlyargs + function.args.args + function.args.kwonlyargs
        return [argument.arg for argument in every]

    @staticmethod
    def names(value, item):
        return ["self"] if inspect.isdatadescriptor(item) else list(inspect.signature(value).parameters)


if __name__ == "__main__":
    unittest.main()
