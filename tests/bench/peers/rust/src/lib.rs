// SPDX-License-Identifier: MIT
//! Controllers of engines that come as Rust crates, behind tests/bench/method.h. One feature each, built one at a time:
//! the library of a feature is copied to peer_NAME.so. The crate that carries Jolt's sources is only fetched.
#[cfg_attr(not(any(feature = "rapier", feature = "physx")), allow(dead_code))]
mod method;
#[cfg(feature = "physx")]
mod physx;
#[cfg(feature = "rapier")]
mod rapier;
