//! To be filled by the commit that follows.
