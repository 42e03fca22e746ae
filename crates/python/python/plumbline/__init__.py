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
from plumbline._findings import Finding, Findings, Parameter
from plumbline._log import Log
from plumbline._model import Model, inverse_dynamics, learn
from plumbline._plumbline import PlumblineError
from plumbline._robot import Export, Robot
from plumbline._simulation import Simulation, simulate
from plumbline._tracking import Tracking, track

__all__ = [
    "Comparison",
    "Design",
    "Diagnosis",
    "Export",
    "Finding",
    "Findings",
    "Log",
    "Model",
    "Parameter",
    "PlumblineError",
    "Prospect",
    "Robot",
    "Simulation",
    "Tracking",
    "compare",
    "design",
    "diagnose",
    "inverse_dynamics",
    "learn",
    "simulate",
    "track",
]
