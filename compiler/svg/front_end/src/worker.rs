// SPDX-License-Identifier: GPL-3.0-or-later
//! Runs the loader on a thread of its own: with a stack for the deepest allowed nesting, panics caught, and a clock. usvg
//! and resvg can't be interrupted, so a thread that is over time is left behind; it ends by itself or with the process.

use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::mpsc::{channel, RecvTimeoutError};
use std::thread::Builder;
use std::time::Duration;

use crate::budget::{Code, Failure};
use crate::document::Drawing;
use crate::load::{load, Settings};

/// Address space only: pages are taken as they are used.
const STACK: usize = 256 << 20;

/// Our own loops notice the deadline first and say where they are; this is for the libraries.
const GRACE: Duration = Duration::from_millis(500);

pub fn load_guarded(data: Vec<u8>, settings: Settings) -> Result<Drawing, Failure> {
    let time = settings.time + GRACE;
    let (sender, receiver) = channel();
    let work = move || {
        let result = catch_unwind(AssertUnwindSafe(|| load(&data, &settings)));
        let result = result.unwrap_or_else(|panic| Err(Failure::new(Code::Internal, panic_text(panic.as_ref()))));
        let _ = sender.send(result); // nobody listens any more after a timeout
    };
    let thread = Builder::new().name("fetexc-svg".into()).stack_size(STACK).spawn(work);
    let thread = thread.map_err(|e| Failure::new(Code::Internal, format!("no thread for reading the SVG: {e}")))?;
    match receiver.recv_timeout(time) {
        Ok(result) => {
            let _ = thread.join();
            result
        }
        Err(RecvTimeoutError::Timeout) => {
            Err(Failure::new(Code::Timeout, format!("not read within {} ms", settings_ms(time - GRACE))))
        }
        Err(RecvTimeoutError::Disconnected) => Err(Failure::new(Code::Internal, "the reading thread ended early")),
    }
}

fn settings_ms(time: Duration) -> u128 {
    time.as_millis()
}

fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| s.to_string()).or_else(|| panic.downcast_ref::<String>().cloned());
    format!("the SVG library failed: {}", crate::names::shorten(&text.unwrap_or_default()))
}
