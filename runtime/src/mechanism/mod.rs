//! What a generated mechanism is: its kernels, its report, its handles.

pub(crate) mod blocks;
pub(crate) mod body;
pub(crate) mod handle;
pub(crate) mod joint_kernels;
pub(crate) mod joint_report;
pub(crate) mod kernels;
pub(crate) mod orientations;
pub(crate) mod readout;
pub(crate) mod report;
