//! Inverse and forward dynamics, the torque regressor, base and physically consistent parameters.
