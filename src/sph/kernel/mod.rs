//! Smoothing kernels: one file each. So far the Wendland C2 kernel of the paper.

mod wendland_c2;

pub use wendland_c2::WendlandC2;
