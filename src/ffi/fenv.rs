//! The floating-point environment: the host's stays the host's.
//!
//! Rust code, and what it calls, counts on the default environment: rounding to
//! nearest, subnormal numbers kept, no traps. A Fortran host may trap invalid
//! operations, a host built with `-ffast-math` may flush subnormals to zero. So
//! a guarded call works in the default environment, which also makes its result
//! the same bytes under every host, and puts the host's back, flags included,
//! when it ends and while it calls the host. (The host's panics are printed
//! again meanwhile: see guard.rs.) Threads inherit the environment of
//! the thread that starts them, so that the pool works in the default one too.

use crate::run::QUIET;
use std::cell::Cell;

/// Room for any platform's `fenv_t`.
#[derive(Clone, Copy)]
#[repr(C, align(16))]
struct Environment([u64; 32]);

thread_local! {
    /// The host's environment while a guarded call runs.
    static HOST: Cell<Option<Environment>> = const { Cell::new(None) };
}

/// Runs `work` in the default environment.
pub(super) fn default<T>(work: impl FnOnce() -> T) -> T {
    // Inside a callback that calls back, the host's environment is the current one again.
    let _back = Back { outer: HOST.get(), current: save() };
    HOST.set(_back.current);
    set_default();
    work()
}

/// Runs `call`, which is the host's, in the host's environment.
pub(super) fn host<T>(call: impl FnOnce() -> T) -> T {
    let _back = Back { outer: HOST.get(), current: save() };
    let _quiet = Quiet(QUIET.replace(false));
    if let Some(host) = HOST.get() {
        restore(&host);
    }
    call()
}

/// Whether panics were kept silent: a host's own are not, while its code runs.
struct Quiet(bool);

impl Drop for Quiet {
    fn drop(&mut self) {
        QUIET.set(self.0);
    }
}

/// Puts things back at the end, also when a panic passes.
struct Back {
    outer: Option<Environment>,
    current: Option<Environment>,
}

impl Drop for Back {
    fn drop(&mut self) {
        if let Some(environment) = &self.current {
            restore(environment);
        }
        HOST.set(self.outer);
    }
}

#[cfg(any(
    all(target_os = "linux", any(target_arch = "x86_64", target_arch = "aarch64")),
    target_os = "macos"
))]
mod platform {
    use super::Environment;
    use std::ffi::{c_int, c_void};

    #[cfg_attr(target_os = "linux", link(name = "m"))]
    unsafe extern "C" {
        fn fegetenv(environment: *mut c_void) -> c_int;
        fn fesetenv(environment: *const c_void) -> c_int;
        #[cfg(target_os = "macos")]
        static _FE_DFL_ENV: c_void;
    }

    pub(super) fn save() -> Option<Environment> {
        let mut environment = Environment([0; 32]);
        let failed = unsafe { fegetenv((&raw mut environment).cast()) };
        (failed == 0).then_some(environment)
    }

    pub(super) fn restore(environment: &Environment) {
        unsafe { fesetenv((&raw const *environment).cast()) };
    }

    pub(super) fn set_default() {
        // FE_DFL_ENV of the C library.
        #[cfg(target_os = "linux")]
        let default = std::ptr::without_provenance(usize::MAX);
        #[cfg(target_os = "macos")]
        let default = &raw const _FE_DFL_ENV;
        unsafe { fesetenv(default) };
    }
}

/// Elsewhere the environment is left alone.
#[cfg(not(any(
    all(target_os = "linux", any(target_arch = "x86_64", target_arch = "aarch64")),
    target_os = "macos"
)))]
mod platform {
    use super::Environment;

    pub(super) fn save() -> Option<Environment> {
        None
    }
    pub(super) fn restore(_: &Environment) {}
    pub(super) fn set_default() {}
}

use platform::{restore, save, set_default};
