// SPDX-License-Identifier: GPL-3.0-or-later
//! Numbered findings: our own, and those that usvg and resvg only say through `log`.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Once;

/// The numbers of compiler/diagnostics.h (2xxx): warnings below 2100, notes from 2100 on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Finding {
    TextWithoutFonts = 2001,
    FontNotFound = 2002,
    Animation = 2003,
    Script = 2004,
    SvgFont = 2005,
    VectorEffect = 2006,
    MediaQuery = 2007,
    MeshOrHatch = 2008,
    ExternalReference = 2009,
    ForeignObject = 2010,
    ParserMessage = 2011,
    BadGeometry = 2012,
    PlusLighter = 2013,
    DashTooFine = 2015,
    ImageDropped = 2016,
    RasterReduced = 2017,
    FilterRasterised = 2101,
    PatternRasterised = 2102,
    BitmapImage = 2103,
}

#[derive(Clone, Debug)]
pub struct Entry {
    pub code: u32,
    pub message: String,
    pub place: String,
}

/// Keeps the first few findings of each number in full and counts the rest.
#[derive(Default)]
pub struct Report {
    entries: Vec<Entry>,
    seen: HashMap<u32, usize>,
    /// Without fonts every text is reported by name; that a font is missing says no more.
    pub without_fonts: bool,
}

const IN_FULL: usize = 20;

impl Report {
    pub fn new(without_fonts: bool) -> Self {
        Report { without_fonts, ..Report::default() }
    }
    pub fn add(&mut self, finding: Finding, message: impl Into<String>, place: impl Into<String>) {
        let code = finding as u32;
        let count = self.seen.entry(code).or_insert(0);
        *count += 1;
        if *count <= IN_FULL {
            self.entries.push(Entry { code, message: message.into(), place: place.into() });
        }
    }
    pub fn finish(mut self) -> Vec<Entry> {
        let mut more: Vec<(u32, usize)> = self.seen.into_iter().filter(|(_, n)| *n > IN_FULL).collect();
        more.sort_unstable();
        for (code, n) in more {
            self.entries.push(Entry { code, message: format!("{} more like this", n - IN_FULL), place: String::new() });
        }
        self.entries
    }
    /// Takes over what usvg and resvg logged on this thread since the last call.
    pub fn take_log(&mut self) {
        for message in LOGGED.with(|l| std::mem::take(&mut *l.borrow_mut())) {
            let font = message.contains("font") || message.contains("glyph");
            if font && self.without_fonts {
                continue;
            }
            let finding = if font { Finding::FontNotFound } else { Finding::ParserMessage };
            self.add(finding, crate::names::shorten(&message), "");
        }
    }
}

thread_local! {
    static LOGGED: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

struct Capture;

impl log::Log for Capture {
    fn enabled(&self, metadata: &log::Metadata) -> bool {
        metadata.level() <= log::Level::Warn
    }
    fn log(&self, record: &log::Record) {
        const MOST: usize = 1000;
        LOGGED.with(|l| {
            let mut messages = l.borrow_mut();
            if self.enabled(record.metadata()) && messages.len() < MOST {
                messages.push(record.args().to_string());
            }
        });
    }
    fn flush(&self) {}
}

/// Idempotent. If the process has another logger already, messages of the parser are lost to us but harm nothing.
pub fn install_log_capture() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // Panics of the libraries are caught and become an error with a number; nothing is printed for them.
        std::panic::set_hook(Box::new(|_| {}));
        if log::set_logger(&Capture).is_ok() {
            log::set_max_level(log::LevelFilter::Warn);
        }
    });
}
