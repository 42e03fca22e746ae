//! The model side of every effect: the columns that explain it and its place in the robot.
