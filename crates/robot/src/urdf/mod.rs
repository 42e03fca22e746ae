//! A URDF read into a [`Robot`] and its [`Looks`].

pub(crate) mod convert;
pub(crate) mod followers;
pub(crate) mod outline;
pub(crate) mod parse;
pub(crate) mod tree;
pub(crate) mod visual;
