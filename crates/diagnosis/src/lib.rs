//! From logs to named causes with honest uncertainty, and the robot extended by them.
