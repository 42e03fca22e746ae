//! Floors, walls and file sizes.
