//! The motion log: its files, checks, resampling, filters and derivatives.
