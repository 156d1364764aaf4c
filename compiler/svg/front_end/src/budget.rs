// SPDX-License-Identifier: GPL-3.0-or-later
//! Limits for hostile input, and the errors that name them.

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
    segments_left: u64,
    segments_max: u64,
    ticks: u32,
}

impl Budget {
    pub fn new(segments: u64, time: Duration) -> Self {
        let deadline = Instant::now() + time;
        Budget { deadline, segments_left: segments, segments_max: segments, ticks: 0 }
    }
    pub fn charge(&mut self, segments: usize) -> Result<(), Failure> {
        self.ticks = self.ticks.wrapping_add(1);
        if self.ticks % 256 == 0 {
            self.check_time()?;
        }
        match self.segments_left.checked_sub(segments as u64) {
            Some(left) => {
                self.segments_left = left;
                Ok(())
            }
            None => Err(Failure::new(Code::TooManySegments, format!("more than {} path segments", self.segments_max))),
        }
    }
    pub fn check_time(&self) -> Result<(), Failure> {
        if Instant::now() < self.deadline {
            return Ok(());
        }
        Err(Failure::new(Code::Timeout, "the time limit for reading the SVG is over"))
    }
}
