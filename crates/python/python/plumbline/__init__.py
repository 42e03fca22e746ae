"""Names what a robot's model gets wrong, from logs of the real arm::

    robot = plumbline.Robot("arm.urdf")
    log = plumbline.Log(time, q, tau)
    found = plumbline.diagnose(robot, [log])
    found.findings.to_pandas()
    found.export("mjcf").save("arm.xml")

SI units and radians; arrays have one column a joint, in the order of ``robot.joints``.
"""

from plumbline._design import Design, Prospect, design
from plumbline._diagnosis import Comparison, Diagnosis, compare, diagnose
from plumbline._effect import Effect, effects, explain
from plumbline._findings import Finding, Findings, Parameter
from plumbline._log import Log
from plumbline._model import Model, inverse_dynamics, learn
from plumbline._plumbline import PlumblineError, __version__
from plumbline._replay import Replay, replay
from plumbline._robot import Export, Robot
from plumbline._simulation import Simulation, simulate
from plumbline._torques import RunTorques
from plumbline._tracking import Tracking, track

__all__ = [
    "Comparison",
    "Design",
    "Diagnosis",
    "Effect",
    "Export",
    "Finding",
    "Findings",
    "Log",
    "Model",
    "Parameter",
    "PlumblineError",
    "Prospect",
    "Replay",
    "Robot",
    "RunTorques",
    "Simulation",
    "Tracking",
    "__version__",
    "compare",
    "design",
    "diagnose",
    "effects",
    "explain",
    "inverse_dynamics",
    "learn",
    "replay",
    "simulate",
    "track",
]
