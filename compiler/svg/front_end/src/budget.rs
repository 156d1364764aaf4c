// SPDX-License-Identifier: GPL-3.0-or-later
//! Limits for hostile input, and the errors that name them.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The numbers of compiler/diagnostics.h (1xxx).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Code {
    Malformed = 1001,
    NotUtf8 = 1002,
    BadGzip = 1003,
    NoSize = 1004,
    TooManyBytes = 1005,
    TooManyElements = 1006,
    TooDeep = 1007,
    TooManySegments = 1008,
    Timeout = 1009,
    Internal = 1010,
    FontFile = 1011,
    TooManyPixels = 1012,
}

#[derive(Clone, Debug)]
pub struct Failure {
    pub code: Code,
    pub message: String,
    pub place: String,
}

impl Failure {
    pub fn new(code: Code, message: impl Into<String>) -> Self {
        Failure { code, message: message.into(), place: String::new() }
    }
}

/// What our own loops may still spend. Checked often and cheaply: the clock only every few hundred charges.
pub struct Budget {
    deadline: Instant,
    segments_left: Arc<AtomicU64>,
    segments_max: u64,
    ticks: u32,
    spent: u64,
}

impl Budget {
    pub fn new(segments: u64, time: Duration) -> Self {
        Budget {
            deadline: Instant::now() + time,
            segments_left: Arc::new(AtomicU64::new(segments)),
            segments_max: segments,
            ticks: 0,
            spent: 0,
        }
    }
    /// As much again, for work that may be thrown away.
    pub fn duplicate(&self) -> Self {
        let left = self.segments_left.load(Ordering::Relaxed);
        Budget { segments_left: Arc::new(AtomicU64::new(left)), spent: 0, ..*self }
    }
    /// Another hand in the same purse, for another thread.
    pub fn share(&self) -> Self {
        Budget { segments_left: self.segments_left.clone(), spent: 0, ..*self }
    }
    /// Segments charged through this budget.
    pub fn spent(&self) -> u64 {
        self.spent
    }
    pub fn charge(&mut self, segments: usize) -> Result<(), Failure> {
        self.ticks = self.ticks.wrapping_add(1);
        if self.ticks % 256 == 0 {
            self.check_time()?;
        }
        let segments = segments as u64;
        let take = |left: u64| left.checked_sub(segments);
        if self.segments_left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).is_err() {
            return Err(Failure::new(Code::TooManySegments, format!("more than {} path segments", self.segments_max)));
        }
        self.spent += segments;
        Ok(())
    }
    pub fn check_time(&self) -> Result<(), Failure> {
        if Instant::now() < self.deadline {
            return Ok(());
        }
        Err(Failure::new(Code::Timeout, "the time limit for reading the SVG is over"))
    }
}
