// SPDX-License-Identifier: GPL-3.0-or-later
//! SVG bytes to flat arrays of exact geometry, behind the C ABI of svg_front_end.h.

// !(a <= b) is how limits refuse NaN as well.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod abi;
pub mod budget;
mod clip;
mod css;
mod dash;
pub mod document;
mod emit;
mod enclosing;
mod features;
mod ffi;
pub mod geom;
pub mod load;
mod names;
mod outline;
mod outlines_ahead;
mod paint;
mod parallel;
mod piece;
mod raster;
mod recover;
mod references;
mod report;
mod shapes;
pub mod stroke;
mod twin;
mod worker;
