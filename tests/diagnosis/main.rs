//! The diagnosis on logs whose cause is known, and on recorded ones.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a broken fixture should stop the test")]

mod before_and_after;
mod blind;
mod clean;
mod compare;
mod constant;
mod counterbalance;
mod extended;
mod false_alarms;
mod formats;
mod found;
mod grafts;
mod held_out;
mod held_values;
mod hidden;
mod intervals;
mod late_goals;
mod ledger;
mod light_links;
mod long;
mod oscillations;
mod poor;
mod protocols;
mod read_so;
mod recorded;
mod repeatable;
mod repeats;
mod rivals;
mod second_encoder;
mod shared_motors;
mod supplement;
mod together;
mod transplants;
mod trials;
mod warming;
mod world;
