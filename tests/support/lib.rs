//! Support for the tests: golden files, synthetic logs, the built program.
