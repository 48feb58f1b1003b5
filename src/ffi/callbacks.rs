//! What the library calls: progress, and the log sink.

use super::fenv;
use crate::error::{Error, Result};
use crate::run::Run;
use std::ffi::{CString, c_char, c_void};
use std::sync::RwLock;

/// Called now and then during a long call, only on the thread that made the
/// call, with a fraction in [0, 1] that never falls. Return 0 to go on, any
/// other number to cancel: then the call returns MORULA_STATUS_CANCELLED, or,
/// when a clump has spheres already, MORULA_STATUS_OK with what there is and
/// MORULA_STOPPED_CANCELLED. It must return normally: no exception, no longjmp.
pub type morula_progress = Option<unsafe extern "C" fn(fraction: f64, user: *mut c_void) -> i32>;

/// Receives one line of log: `level` is one of MORULA_LOG_*, `text` lives until
/// the sink returns. Called on the thread that made the call, maybe from
/// several threads at the same time when several threads make calls. It must
/// return normally: no exception, no longjmp.
pub type morula_log =
    Option<unsafe extern "C" fn(level: i32, text: *const c_char, user: *mut c_void)>;

/// Log level: what a call did.
pub const MORULA_LOG_INFO: i32 = 0;
/// Log level: something in the input that a user should know.
pub const MORULA_LOG_WARNING: i32 = 1;

#[derive(Clone, Copy)]
struct Sink {
    call: morula_log,
    user: *mut c_void,
}
// The sink's contract is that it may be called on any thread that makes calls.
unsafe impl Send for Sink {}
unsafe impl Sync for Sink {}

static SINK: RwLock<Sink> = RwLock::new(Sink { call: None, user: std::ptr::null_mut() });

/// Sets where the library's log lines go. There is none at first: the library
/// never prints.
///
/// Parameters: `sink` is called with each line (NULL: no log any more); `user`
/// is handed to it. Both must stay valid until another sink is set and every
/// call that was running then has returned.
/// Returns: MORULA_STATUS_OK.
/// Threads: any thread; the sink is one for the whole process.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn morula_set_log(sink: morula_log, user: *mut c_void) -> i32 {
    super::guard::guard(|| {
        *SINK.write().unwrap_or_else(|e| e.into_inner()) = Sink { call: sink, user };
        Ok(())
    })
}

/// Hands a line to the sink, if there is one. The text is made only then.
pub(super) fn log(level: i32, text: impl FnOnce() -> String) {
    // Copied, so that the lock is free while the sink runs and may set another.
    let sink = *SINK.read().unwrap_or_else(|e| e.into_inner());
    if let Some(call) = sink.call {
        let text = CString::new(text().replace('\0', "?")).unwrap_or_default();
        fenv::host(|| unsafe { call(level, text.as_ptr(), sink.user) });
    }
}

/// Hands the notes on an input to the sink.
pub(super) fn log_notes(notes: &[String]) {
    for note in notes {
        log(MORULA_LOG_WARNING, || note.clone());
    }
}

/// The run of a call.
pub(super) fn run<'a>(
    threads: i32,
    progress: morula_progress,
    user: *mut c_void,
) -> Result<Run<'a>> {
    let threads = usize::try_from(threads)
        .map_err(|_| Error::InvalidArgument(format!("threads is {threads}, less than 0")))?;
    let run = Run::new(threads)?;
    Ok(match progress {
        Some(call) => run.with_progress(Box::new(move |fraction| {
            fenv::host(|| unsafe { call(fraction, user) }) != 0
        })),
        None => run,
    })
}
