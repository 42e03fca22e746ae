//! The gap effects by name: parameters, units, equations and what each is confused with.
