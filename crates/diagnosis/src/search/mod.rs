//! Which hypotheses earn their place: by evidence and by what they predict, with one size that
//! holds for all of the logs.

pub(crate) mod conclusion;
pub(crate) mod constancy;
pub(crate) mod contest;
pub(crate) mod failed;
pub(crate) mod record;
pub(crate) mod rivals;
pub(crate) mod searched;
pub(crate) mod select;
pub(crate) mod settled;
pub(crate) mod study;
pub(crate) mod worse;
