//! An MJCF read into what a URDF is read into: bodies, hinges and slides, inertias, friction,
//! armature and the gains of servos. What is not understood is a warning.

pub(crate) mod actuators;
pub(crate) mod body;
pub(crate) mod classes;
pub(crate) mod compiler;
pub(crate) mod element;
pub(crate) mod geom;
pub(crate) mod joint;
pub(crate) mod parse;
pub(crate) mod unread;
pub(crate) mod view;
