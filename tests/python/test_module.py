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
HIDDEN = ROOT / "scenarios/demos/wam.toml"


def with_whole_paths(document, folder):
    """A diagnosis.json whose files are named from the root: the file in a folder names them from there."""
    for file in document["provenance"]["files"]:
        place = Path(folder, file["path"])
        # A log that was never a file has a name alone.
        file["path"] = os.path.realpath(place) if place.exists() else file["path"]
    return document


class LockedJointsTest(unittest.TestCase):
    def test_a_joint_is_locked_where_it_stands_and_carries_what_hangs_on_it(self):
        whole, part = plumbline.Robot(WAM), plumbline.Robot(WAM, locked={"j4_elbow_pitch": 1.2})
        self.assertEqual(part.locked, {"j4_elbow_pitch": 1.2})
        moving = [k for k, name in enumerate(whole.joints) if name != "j4_elbow_pitch"]
        self.assertEqual(part.joints, [whole.joints[k] for k in moving])
        q = np.zeros((1, len(whole.joints)))
        q[0, whole.joints.index("j4_elbow_pitch")] = 1.2
        q[0, 1] = 0.7
        rest = np.zeros_like(q)
        expected = plumbline.inverse_dynamics(whole, q, rest, rest)[:, moving]
        found = plumbline.inverse_dynamics(part, q[:, moving], rest[:, moving], rest[:, moving])
        np.testing.assert_allclose(found, expected, atol=1e-9)


class SeveralFiles(unittest.TestCase):
    def test_a_file_a_signal_is_one_run(self):
        robot = plumbline.Robot(WAM)
        t = np.arange(300) * 0.01
        q = np.sin(t[:, None] + np.arange(len(robot.joints)))
        with tempfile.TemporaryDirectory() as folder:
            for name, array in (("q", q), ("tau", 2.0 * q), ("t", t)):
                np.save(Path(folder, f"{name}.npy"), array)
            with self.assertRaisesRegex(plumbline.PlumblineError, "gone.npy: there is no such file"):
                plumbline.Log.read(Path(folder, "q.npy+gone.npy+t.npy")).on(robot)
            log = plumbline.Log.read(Path(folder, "q.npy+tau.npy+t.npy"))
            self.assertEqual(log.name, "q+tau+t")
            np.testing.assert_array_equal(log.on(robot).tau, 2.0 * q)


class Episodes(unittest.TestCase):
    """Two episodes of a dataset, which the caller has written."""

    def setUp(self):
        self.robot = plumbline.Robot(WAM)
        self.dataset = Path(os.environ["PLUMBLINE_DATASET"])

    def test_an_episode_is_read_by_its_number(self):
        starts = [float(start) for start in os.environ["PLUMBLINE_STARTS"].split()]
        self.assertNotAlmostEqual(*starts, places=3)
        for number, start in enumerate(starts):
            log = plumbline.Log.read(self.dataset, episode=number).on(self.robot)
            self.assertAlmostEqual(log.q[0, 0], start)

    def test_one_that_is_not_there_and_one_of_several_are_refused(self):
        for episode in (None, 2):
            with self.subTest(episode=episode):
                log = plumbline.Log.read(self.dataset, episode=episode)
                self.assertRaisesRegex(plumbline.PlumblineError, "episode", log.on, self.robot)


ARM = """<robot name="arm"><link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="3"/>
    <inertia ixx="0.01" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.15 0 0"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.03" izz="0.03" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <axis xyz="0 -1 0"/><limit lower="-2.9" upper="2.9" effort="80" velocity="6"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/>
    <origin xyz="0.4 0 0"/><axis xyz="0 -1 0"/>
    <limit lower="-2.9" upper="2.9" effort="40" velocity="6"/></joint></robot>"""


class Planar(unittest.TestCase):
    """An arm of two links, whose elbow has dry friction that its description lacks."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.urdf = Path(folder.name, "arm.urdf")
        cls.urdf.write_text(ARM)
        cls.robot = plumbline.Robot(cls.urdf)
        cls.before = [cls.run_of(seed, 1.5) for seed in (1, 2, 3)]
        cls.found = plumbline.diagnose(cls.robot, cls.before, progress=False)

    @classmethod
    def run_of(cls, seed, level):
        random, time = np.random.default_rng(seed), np.arange(0, 12, 0.004)
        rate = 2 * np.pi * random.uniform(0.1, 0.6, (3, 2))
        size, phase = random.uniform(0.2, 0.5, (3, 2)), random.uniform(0, 6, (3, 2))
        angle = time[:, None, None] * rate + phase
        q, qd = (size * np.sin(angle)).sum(1), (size * rate * np.cos(angle)).sum(1)
        tau = plumbline.inverse_dynamics(cls.robot, q, qd, -(size * rate**2 * np.sin(angle)).sum(1))
        tau[:, 1] += level * np.sign(qd[:, 1])
        return plumbline.Log(time, q, tau + random.normal(scale=0.05, size=tau.shape), name=f"run_{seed}")

    def test_friction_that_grew_is_the_change(self):
        after = [self.run_of(seed, 2.0) for seed in (4, 5, 6)]
        compared = plumbline.compare(self.robot, self.before, after, progress=False)
        (change,) = compared.changes
        self.assertEqual((change.code, change.joint), ("FR02", "elbow"))
        self.assertAlmostEqual(change.parameters[0].value, 2.0, delta=0.02)
        self.assertAlmostEqual(change.parameters[0].nominal, 1.5, delta=0.02)
        self.assertEqual(compared.before.findings[0].parameters, self.found.findings[0].parameters)
        self.assertIn("1 changes", repr(compared))
        for shown in (str(compared), compared._repr_html_()):
            self.assertIn("FR02 Coulomb friction at elbow", shown)
            self.assertIn("in the first logs", shown)

    def test_nothing_changed_is_no_change_and_a_log_on_both_sides_is_refused(self):
        after = [self.run_of(seed, 1.5) for seed in (4, 5)]
        compared = plumbline.compare(self.robot, self.before, after, progress=False)
        self.assertEqual(len(compared.changes), 0)
        both = [self.before[0], after[0]]
        self.assertRaises(plumbline.PlumblineError, plumbline.compare, self.robot, self.before, both)
        self.assertRaisesRegex(TypeError, "^after: ", plumbline.compare, self.robot, self.before, "run.csv")

    def test_a_frame_has_a_row_a_parameter(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("no pandas here: frames of findings are left out")
        frame = self.found.findings.to_pandas()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(len(frame), sum(len(f.parameters) for f in self.found.findings))
        row, level = frame.iloc[0], self.found.findings[0].parameters[0]
        self.assertEqual((row.code, row.joint, row.parameter, row.unit), ("FR02", "elbow", "level", "N m"))
        self.assertEqual((row.value, row.low, row.high), (level.value, *level.ci95))

    def test_torques_are_arrays_by_run_and_joint(self):
        self.assertEqual([run.name for run in self.found.torques], ["run_1", "run_2", "run_3"])
        for run, log in zip(self.found.torques, self.before):
            self.assertEqual(run.joints, ("shoulder", "elbow"))
            shape = (len(run.time), 2)
            for signal in (run.position, run.velocity, run.measured, run.nominal, run.extended):
                self.assertEqual(signal.shape, shape)
            at = np.searchsorted(log.time, run.time - 1e-9)
            np.testing.assert_allclose(run.time, log.time[at], atol=1e-9)
            # Behind the low-pass of the diagnosis the noise of .05 N m is gone and the sinusoids are there.
            np.testing.assert_allclose(run.position, log.q[at], atol=2e-3)
            left = {name: np.sqrt(np.mean((run.measured - getattr(run, name)) ** 2, axis=0)) for name in ("nominal", "extended")}
            self.assertGreater(left["nominal"][1], 1.2)
            self.assertLess(left["extended"][1], 0.3)

    def test_a_replay_drifts_less_with_the_findings(self):
        log = self.before[0]
        drifts = [
            plumbline.replay(robot, log, window_ms=[50, 200], progress=False)
            for robot in (self.robot, self.found.robot)
        ]
        nominal, extended = (replay.drift_rms["run_1"][200.0] for replay in drifts)
        self.assertEqual(nominal.shape, (2,))
        self.assertLess(extended[1], 0.2 * nominal[1])
        # Whole numbers of samples of 4 ms.
        self.assertEqual(list(drifts[0].drift_rms["run_1"]), [52.0, 200.0])
        self.assertIn("elbow", str(drifts[0]))
        with tempfile.TemporaryDirectory() as folder:
            drifts[0].save(Path(folder, "out"))
            self.assertEqual(Path(folder, "out/replay.json").read_text(), drifts[0].json())
            self.assertTrue(Path(folder, "out/run_1_forward_200ms.parquet").exists())
        self.assertRaisesRegex(ValueError, "^window_ms: ", plumbline.replay, self.robot, log, window_ms=[0])
        self.assertRaisesRegex(TypeError, "^window_ms: ", plumbline.replay, self.robot, log, window_ms=50)

    def test_a_plot_has_torque_and_error_of_every_joint(self):
        try:
            import matplotlib.figure
        except ImportError:
            self.skipTest("no matplotlib here: plots are left out")
        figure = self.found.plot(1)
        self.assertIsInstance(figure, matplotlib.figure.Figure)
        self.assertEqual([axes.get_title("left") for axes in figure.axes], ["shoulder", "", "elbow", ""])
        torque, left = figure.axes[2:]
        self.assertEqual([line.get_label() for line in torque.lines], ["measured", "nominal", "extended"])
        nominal, extended = (np.abs(line.get_ydata()).max() for line in left.lines)
        self.assertLess(extended, nominal)
        self.assertTrue(figure._repr_png_().startswith(b"\x89PNG"))
        self.assertRaises(IndexError, self.found.plot, 3)

    def test_a_design_is_the_motion_of_the_program(self):
        pair = ("FR01@elbow", "FR02@elbow")
        design = plumbline.design(self.robot, separate=pair, duration_s=5, progress=False)
        (prospect,) = design.prospects
        self.assertEqual(prospect.question, "FR01 viscous friction at elbow or FR02 Coulomb friction at elbow")
        self.assertGreater(prospect.after, 10)
        limits = self.robot.limits
        self.assertTrue((limits[:, 0] <= design.log.q).all() and (design.log.q <= limits[:, 1]).all())
        self.assertTrue((np.abs(design.log.qd) <= limits[:, 2]).all() and np.abs(design.log.qd[:, 1]).max() > 0)
        self.assertIn("this motion tells them apart", str(design))
        with tempfile.TemporaryDirectory() as folder:
            ours, theirs = Path(folder, "ours"), Path(folder, "theirs")
            design.save(ours)
            command = ["design", "--robot", self.urdf, "--separate", pair[0], "--from", pair[1]]
            command += ["--duration-s", "5", "--out", theirs, "--quiet"]
            subprocess.run([sys.executable, "-m", "plumbline", *command], check=True)
            for name in ("motion.csv", "motion.parquet", "motion.toml"):
                self.assertEqual((ours / name).read_bytes(), (theirs / name).read_bytes(), name)

    def test_a_design_beside_logs_knows_what_they_tell(self):
        pair = ("FR02@elbow", "FR04@elbow")
        design = plumbline.design(self.robot, self.found, separate=pair, duration_s=5, progress=False)
        self.assertGreater(design.prospects[0].before, 0)
        open_ones = plumbline.design(self.robot, self.found, duration_s=5, progress=False)
        rivals = [f"FR02 Coulomb friction at elbow or {rival}" for rival in ("FR04", "FR05", "FR07")]
        self.assertTrue(open_ones.prospects)
        for prospect in open_ones.prospects:
            self.assertTrue(prospect.question.startswith(tuple(rivals)), prospect)

    def test_a_design_without_a_question_is_refused(self):
        design, robot = plumbline.design, self.robot
        self.assertRaisesRegex(ValueError, "^diagnosis: ", design, robot)
        self.assertRaisesRegex(TypeError, "^diagnosis: ", design, robot, "out")
        self.assertRaisesRegex(TypeError, "^separate: ", design, robot, separate="FR01@elbow")
        self.assertRaisesRegex(ValueError, "^duration_s: ", design, robot, self.found, duration_s=-1)
        self.assertRaisesRegex(plumbline.PlumblineError, "elbow", design, robot, separate=("FR01@knee", "FR02@elbow"))
        self.assertRaisesRegex(plumbline.PlumblineError, "joints", design, plumbline.Robot(WAM), self.found)


class Tracks(unittest.TestCase):
    """A motion of a second, tracked by the simulated arm."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        sinusoids = "terms = 3, lowest_hz = 0.3, highest_hz = 1.0"
        Path(folder.name, "plant.toml").write_text(
            f'extends = "{ROOT.as_posix()}/scenarios/arms/real_wam.toml"\n[[run]]\nname = "training"\n'
            f"motion.sinusoids = {{ seed = 21, {sinusoids}, duration_s = 4.0 }}\n"
        )
        self.scenario = Path(folder.name, "tracking.toml")
        self.scenario.write_text(
            f'plant = "plant.toml"\nfeedforward = ["none", "rbd"]\ncontrol.gains = "low-quarter"\n'
            f"motion.sinusoids = {{ seed = 24, {sinusoids}, duration_s = 1.0, fade_s = 0.3 }}\n"
            f'learn = {{ train = ["training"], points = 40 }}\n'
        )

    def test_tracking_is_that_of_the_program(self):
        ours, theirs = self.folder / "ours", self.folder / "theirs"
        tracking = plumbline.track(self.scenario, ours, progress=False)
        self.assertLess(tracking.tip_rmse_m["rbd"], tracking.tip_rmse_m["none"])
        self.assertEqual((ours / "tracking.json").read_text(), tracking.json())
        self.assertTrue((ours / "recordings/rbd.rrd").exists() and (ours / "models/rbd.parquet").exists())
        command = ["track", str(self.scenario), "--out", str(theirs)]
        subprocess.run([sys.executable, "-m", "plumbline", *command], check=True, capture_output=True)
        program = json.loads((theirs / "tracking.json").read_text())
        for document in (program, tracking.document):
            for model in document["models"]:
                # What a clock has measured.
                model.pop("prediction_us")
        self.assertEqual(tracking.document, program)
        again = plumbline.track(self.scenario, learned=ours / "models", feedforward=["rbd"], progress=False)
        self.assertEqual(again.tip_rmse_m, {"rbd": tracking.tip_rmse_m["rbd"]})
        self.assertIsNone(again.out)

    def test_what_cannot_be_tracked_is_an_exception(self):
        track = plumbline.track
        self.assertRaisesRegex(ValueError, "^feedforward: ", track, self.scenario, feedforward=["oracle"])
        self.assertRaisesRegex(TypeError, "^feedforward: ", track, self.scenario, feedforward="rbd")
        self.assertRaisesRegex(TypeError, "^set: ", track, self.scenario, set="control.gains=stiff")
        self.assertRaisesRegex(plumbline.PlumblineError, "soft", track, self.scenario, set=["control.gains=soft"])
        self.assertRaises(plumbline.PlumblineError, track, self.folder / "absent.toml")


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

    def test_the_servos_of_a_robot_are_exported_alone(self):
        servos = plumbline.Robot(ROOT / "robots/so101/robot.toml")
        card = servos.export("actuator_mjcf")
        self.assertIn("<position", card.text)
        self.assertIn("integrator", card.text)
        self.assertIn("DelayedPDActuatorCfg", servos.export("actuator_isaac").text)
        self.assertIn("{", servos.export("actuator_bam").text)
        self.assertTrue(all(row["fate"] in ("exact", "approximated", "dropped") for row in card.quantities))
        cell = self.found._repr_html_()
        self.assertIn("Coulomb friction", cell)
        with tempfile.TemporaryDirectory() as folder:
            self.found.report(folder, recording=False)
            written = json.loads(Path(folder, "diagnosis.json").read_text())
            told = json.loads(self.found.json())
            self.assertEqual(with_whole_paths(written, folder), with_whole_paths(told, "."))
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
            self.assertEqual(with_whole_paths(ours, "."), with_whole_paths(theirs, out))

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
        q, qd, qdd = np.random.default_rng(1).normal(size=(3, 3, 7))
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
