//! Network and direct simulation together: comparison, coupling, states handed from one to the other, throats verified.

#[path = "../support/mod.rs"]
mod support;

mod compare;
mod couple;
mod handover;
mod verified;
mod verify;
