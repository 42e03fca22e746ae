"""What the module reads: frames, parts of files, robots that have no ``robot.toml`` yet, the catalogue. ``PLUMBLINE_ROOT`` is
the folder of the repository."""

import os
import re
import sys
import tempfile
import threading
import time
import unittest
import warnings
from pathlib import Path

import numpy as np

import plumbline

ROOT = Path(os.environ["PLUMBLINE_ROOT"])
WAM = ROOT / "robots/wam7/robot.toml"
UR5E = ROOT / "robots/ur5e/robot.urdf"

# Column map of a log that calls its columns otherwise.
MAP = """time = { column = "stamp", unit = "ms" }
position = { column = "p_{i}", unit = "deg" }
effort = "current_{i}"
"""


class Frames(unittest.TestCase):
    """The same run as a frame of several kinds."""

    def setUp(self):
        self.robot = plumbline.Robot(WAM)
        self.time = np.arange(0, 2, 0.01)
        self.q = np.sin(self.time)[:, None] * np.linspace(0.1, 0.5, len(self.robot.joints))
        self.signals = {}
        for j, joint in enumerate(self.robot.joints):
            self.signals[f"{joint}.position"], self.signals[f"{joint}.effort"] = self.q[:, j], 2 * self.q[:, j]

    def held(self, log):
        read = log.on(self.robot)
        np.testing.assert_allclose(read.time - read.time[0], self.time, atol=1e-9)
        np.testing.assert_array_equal(read.q, self.q)

    def moments(self):
        return np.datetime64("2026-11-29T20:15:00", "ns") + np.round(1e9 * self.time).astype("timedelta64[ns]")

    def test_dates_and_durations_are_times(self):
        moments = self.moments()
        self.held(plumbline.Log.from_frame({"time": moments, **self.signals}))
        self.held(plumbline.Log.from_frame({"time": moments - moments[0], **self.signals}))
        moments[7] = "NaT"
        frame = {"time": moments, **self.signals}
        self.assertRaisesRegex(ValueError, "^time: row 7: found NaT", plumbline.Log.from_frame, frame)

    def test_an_index_of_pandas_is_the_time(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("no pandas here: its indices are left out")
        moments = pandas.DatetimeIndex(self.moments())
        for index in (moments, moments.tz_localize("Europe/Berlin"), moments - moments[0]):
            with self.subTest(index=type(index), dtype=index.dtype):
                self.held(plumbline.Log.from_frame(pandas.DataFrame(self.signals, index=index)))
        zoned = pandas.DataFrame({"time": moments.tz_localize("UTC"), **{k: list(v) for k, v in self.signals.items()}})
        self.held(plumbline.Log.from_frame(zoned))
        rows = pandas.DataFrame(self.signals)
        self.assertRaisesRegex(KeyError, "time", plumbline.Log.from_frame, rows)

    def test_dates_of_polars_are_times(self):
        try:
            import polars
        except ImportError:
            self.skipTest("no polars here: its frames are left out")
        frame = polars.DataFrame({"time": self.moments(), **self.signals})
        self.held(plumbline.Log.from_frame(frame))

    def test_a_map_names_the_columns_and_their_units(self):
        frame = {"stamp": 1e3 * self.time}
        for j, joint in enumerate(self.robot.joints):
            frame[f"p_{j}"], frame[f"current_{j}"] = np.degrees(self.q[:, j]), 2 * self.q[:, j]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "map.toml")
            path.write_text(MAP)
            log = plumbline.Log.from_frame(frame, map=path)
            self.assertRaisesRegex(plumbline.PlumblineError, "p_0", plumbline.Log.from_frame({"stamp": self.time}, map=path).on, self.robot)
        self.assertIsNone(log.joints)
        self.assertRaisesRegex(ValueError, "log.on", lambda: log.q)
        np.testing.assert_allclose(log.on(self.robot).q, self.q, atol=1e-12)
        np.testing.assert_allclose(log.on(self.robot).time, self.time, atol=1e-12)
        self.assertRaisesRegex(plumbline.PlumblineError, "absent.toml", plumbline.Log.from_frame, frame, map="absent.toml")
        self.assertRaisesRegex(TypeError, "^map: ", plumbline.Log.from_frame, frame, map=3)

    def test_a_part_of_a_file_is_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "run.npz")
            np.savez(path, time=self.time, **self.signals)
            whole, part = (plumbline.Log.read(path, **limits).on(self.robot) for limits in ({}, {"from_s": 0.5, "to_s": 1.5}))
            self.assertEqual(len(whole.time), 200)
            self.assertEqual(len(part.time), 101)
            np.testing.assert_array_equal(part.q, self.q[50:151])
            for name in ("from_s", "to_s"):
                self.assertRaisesRegex(ValueError, f"^{name}: found -1", plumbline.Log.read, path, **{name: -1})
                self.assertRaisesRegex(TypeError, f"^{name}: ", plumbline.Log.read, path, **{name: "1"})
            self.assertRaises(plumbline.PlumblineError, plumbline.Log.read(path, from_s=5).on, self.robot)


class Robots(unittest.TestCase):
    def test_a_robot_begins_with_files_that_are_guessed(self):
        with tempfile.TemporaryDirectory() as folder:
            first = Path(folder, "ur5e")
            with warnings.catch_warnings(record=True):
                warnings.simplefilter("always")
                robot = plumbline.Robot.init(UR5E, first)
            self.assertEqual(robot.path, first / "robot.toml")
            self.assertEqual(len(robot.joints), 6)
            self.assertIn("guess", (first / "robot.toml").read_text())
            self.assertTrue((first / "scenario.toml").exists())
            self.assertRaisesRegex(plumbline.PlumblineError, "robot.toml", plumbline.Robot.init, UR5E, first)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                part = plumbline.Robot.init(UR5E, first, ["elbow_joint"], force=True)
            self.assertEqual(part.joints, ["elbow_joint"])
        self.assertRaisesRegex(TypeError, "^force: ", plumbline.Robot.init, UR5E, "out", force=1)
        self.assertRaisesRegex(TypeError, "^folder: ", plumbline.Robot.init, UR5E, None)


class Catalogue(unittest.TestCase):
    def test_an_effect_is_explained_by_code_and_name(self):
        effect = plumbline.explain("FR02")
        self.assertEqual((effect.code, effect.name), ("FR02", "coulomb_friction"))
        self.assertEqual(plumbline.explain("coulomb_friction"), effect)
        self.assertIn("FR04 Stribeck friction", effect.facts["confused with"])
        self.assertTrue(str(effect).startswith("FR02 Coulomb friction (coulomb_friction)\n"))
        self.assertNotIn("\x1b", str(effect))
        every = plumbline.effects()
        self.assertIn(effect, every)
        self.assertEqual(len({effect.code for effect in every}), len(every))
        self.assertRaisesRegex(plumbline.PlumblineError, "FR99", plumbline.explain, "FR99")
        self.assertRaisesRegex(TypeError, "^effect: ", plumbline.explain, 2)

    def test_the_version_is_that_of_the_workspace(self):
        stated = re.search(r'\[workspace.package\]\nversion = "(.*)"', (ROOT / "Cargo.toml").read_text())
        self.assertEqual(plumbline.__version__, stated.group(1))


class Threads(unittest.TestCase):
    """An array that another thread writes while its torque is computed."""

    def test_the_torque_is_that_of_the_numbers_that_were_given(self):
        robot = plumbline.Robot(WAM)
        given = np.random.default_rng(3).normal(size=(3, 200_000, len(robot.joints)))
        expected = plumbline.inverse_dynamics(robot, *given)
        # From here on this thread waits for the lock until the other one lets go of it, which is where its work begins.
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(100)
        # The other thread may have let go before; a function that reads what is written meanwhile is wrong each time.
        self.assertTrue(any(self.is_held(robot, given.copy(), expected) for _ in range(5)))

    @staticmethod
    def is_held(robot, given, expected):
        begin, results = threading.Event(), []

        def work():
            begin.wait()
            results.append(plumbline.inverse_dynamics(robot, *given))

        thread = threading.Thread(target=work)
        thread.start()
        begin.set()
        time.sleep(0.001)
        given[:] = 0.0
        thread.join()
        return np.array_equal(results[0], expected)


if __name__ == "__main__":
    unittest.main()
