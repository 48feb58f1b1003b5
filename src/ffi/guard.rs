//! The border: panics stop here, pointers are checked here, and the thread's
//! last error lives here.
//!
//! A panic that a guarded call catches is told to the caller as a status, so it
//! must not be printed as well. Rust prints through one process-wide hook. The
//! first guarded call therefore puts a hook in front of the one it finds: it is
//! silent on threads that are inside a guarded call (and on the workers of such
//! a call) and not in a callback of the host's, and hands every other panic to
//! the hook that was there before. A
//! hook that the host installs later replaces ours, as the host asked. Programs
//! that use the crate from Rust without this room never get the hook.

use crate::error::{Error, Result};
use crate::run::QUIET;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;

#[cfg(not(panic = "unwind"))]
compile_error!("panics are caught at the C border: build with panic = \"unwind\"");

thread_local! {
    static LAST_ERROR: RefCell<Option<CString>> = const { RefCell::new(None) };
}

/// Runs the body of a C function: clears the thread's message, catches panics,
/// keeps the message of a failure, returns the status.
pub(super) fn guard(work: impl FnOnce() -> Result<()>) -> i32 {
    quiet_hook();
    set_message(None);
    let before = QUIET.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(|| super::fenv::default(work)));
    QUIET.set(before);
    let error = match outcome {
        Ok(Ok(())) => return super::MORULA_STATUS_OK,
        Ok(Err(error)) => error,
        Err(payload) => Error::Internal(format!(
            "a defect of the library was caught, please report it: {}",
            panic_text(payload)
        )),
    };
    set_message(Some(&error.to_string()));
    error.status()
}

/// Runs the body of a `_free` function, which has no status and keeps the message.
pub(super) fn guard_free(work: impl FnOnce()) {
    quiet_hook();
    let before = QUIET.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(|| super::fenv::default(work)));
    QUIET.set(before);
    if let Err(payload) = outcome {
        panic_text(payload);
    }
}

fn quiet_hook() {
    static ONCE: Once = Once::new();
    // `set_hook` panics on a panicking thread; a host that calls from a destructor
    // while it unwinds gets its hook silenced by a later call instead.
    if std::thread::panicking() {
        return;
    }
    ONCE.call_once(|| {
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if !QUIET.try_with(|q| q.get()).unwrap_or(false) {
                before(info);
            }
        }));
    });
}

fn panic_text(payload: Box<dyn Any + Send>) -> String {
    let payload = match payload.downcast::<String>() {
        Ok(text) => return *text,
        Err(payload) => payload,
    };
    match payload.downcast::<&str>() {
        Ok(text) => text.to_string(),
        Err(payload) => {
            // Its destructor may panic in its turn; it is small.
            std::mem::forget(payload);
            "no message".to_string()
        }
    }
}

fn set_message(text: Option<&str>) {
    let message = text.map(|t| CString::new(t.replace('\0', "?")).unwrap_or_default());
    // The thread may be ending: then nobody can ask for the message.
    let _ = LAST_ERROR.try_with(|slot| {
        if let Ok(mut slot) = slot.try_borrow_mut() {
            *slot = message;
        }
    });
}

/// The thread's message; lives until the thread's next guarded call.
pub(super) fn message() -> *const c_char {
    LAST_ERROR
        .try_with(|slot| slot.try_borrow().ok()?.as_ref().map(|m| m.as_ptr()))
        .ok()
        .flatten()
        .unwrap_or(c"".as_ptr())
}

/// Refuses NULL and misaligned pointers.
pub(super) fn require<T>(pointer: *const T, name: &str) -> Result<()> {
    if pointer.is_null() {
        return Err(Error::NullPointer(format!("{name} is NULL")));
    }
    if !pointer.is_aligned() {
        return Err(Error::InvalidArgument(format!(
            "{name} is not aligned to {} bytes",
            std::mem::align_of::<T>()
        )));
    }
    Ok(())
}

/// What a handle points to.
pub(super) unsafe fn borrow<'a, T>(pointer: *const T, name: &str) -> Result<&'a T> {
    require(pointer, name)?;
    Ok(unsafe { &*pointer })
}

/// A caller's array of `len` elements; NULL is an array of none.
pub(super) unsafe fn slice<'a, T>(pointer: *const T, len: usize, name: &str) -> Result<&'a [T]> {
    if len == 0 {
        return Ok(&[]);
    }
    require(pointer, name)?;
    check_bytes::<T>(len, name)?;
    Ok(unsafe { std::slice::from_raw_parts(pointer, len) })
}

/// Whether an array of `len` elements can exist at all.
pub(super) fn check_bytes<T>(len: usize, name: &str) -> Result<()> {
    match len.checked_mul(std::mem::size_of::<T>()) {
        Some(bytes) if bytes <= isize::MAX as usize => Ok(()),
        _ => Err(Error::TooLarge(format!(
            "{name} would hold {len} elements of {} bytes, more than memory can address",
            std::mem::size_of::<T>()
        ))),
    }
}

/// A fixed array that the caller may leave out.
pub(super) unsafe fn array_or<T: Copy, const N: usize>(
    pointer: *const T,
    default: [T; N],
    name: &str,
) -> Result<[T; N]> {
    if pointer.is_null() {
        return Ok(default);
    }
    require(pointer, name)?;
    Ok(unsafe { pointer.cast::<[T; N]>().read() })
}

/// A caller's C string.
pub(super) unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Result<&'a str> {
    require(pointer, name)?;
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| Error::InvalidArgument(format!("{name} is not UTF-8 text")))
}

/// Hands a new object to the caller.
pub(super) unsafe fn give<T>(out: *mut *mut T, object: T) {
    unsafe { out.write(Box::into_raw(Box::new(object))) };
}

/// Takes an object back and drops it; NULL is nothing.
pub(super) unsafe fn take<T>(pointer: *mut T) {
    guard_free(|| {
        if !pointer.is_null() {
            drop(unsafe { Box::from_raw(pointer) });
        }
    });
}

/// Copies an array into the caller's.
pub(super) unsafe fn copy_out<T: Copy>(
    from: &[T],
    capacity: usize,
    to: *mut T,
    name: &str,
) -> Result<()> {
    if capacity < from.len() {
        return Err(Error::BufferTooSmall(format!(
            "{name} has room for {capacity} of {} elements",
            from.len()
        )));
    }
    if from.is_empty() {
        return Ok(());
    }
    require(to, name)?;
    unsafe { std::ptr::copy_nonoverlapping(from.as_ptr(), to, from.len()) };
    Ok(())
}

/// Copies text with its closing NUL into the caller's buffer. `to` may be NULL
/// with a capacity of 0, to learn the length alone; `length` may be NULL.
pub(super) unsafe fn copy_text(
    from: &str,
    capacity: usize,
    to: *mut c_char,
    length: *mut usize,
) -> Result<()> {
    let asked = capacity == 0 && to.is_null() && !length.is_null();
    if !asked {
        require(to, "text")?;
        if capacity <= from.len() {
            return Err(Error::BufferTooSmall(format!(
                "text has room for {capacity} of {} bytes",
                from.len() + 1
            )));
        }
    }
    if !length.is_null() {
        require(length, "length")?;
        unsafe { length.write(from.len()) };
    }
    if !asked {
        unsafe {
            std::ptr::copy_nonoverlapping(from.as_ptr(), to.cast::<u8>(), from.len());
            to.add(from.len()).write(0);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Pool;
    use std::process::Command;

    fn last() -> String {
        unsafe { CStr::from_ptr(message()) }.to_str().unwrap().to_owned()
    }

    #[test]
    fn a_failure_leaves_its_sentence_and_the_next_call_clears_it() {
        assert_eq!(guard(|| Err(Error::Empty("no face\0at all".into()))), 5);
        assert_eq!(last(), "no face?at all");
        assert_eq!(guard(|| Ok(())), 0);
        assert_eq!(last(), "");
    }

    #[test]
    fn messages_belong_to_their_thread() {
        guard(|| Err(Error::Empty("mine".into())));
        std::thread::spawn(|| assert_eq!(last(), "")).join().unwrap();
        assert_eq!(last(), "mine");
    }

    #[test]
    fn a_panic_is_a_status_on_the_caller_and_on_workers() {
        assert_eq!(guard(|| panic!("one")), 20);
        assert!(last().ends_with("one"));
        let status = guard(|| {
            Pool::new(2)?.map(8, |i| assert_ne!(i, 5, "two"));
            Ok(())
        });
        assert_eq!(status, 20);
        assert!(last().contains("two"), "{}", last());
        assert_eq!(guard(|| std::panic::panic_any(3)), 20);
        assert!(last().ends_with("no message"));
    }

    // Run in a process of its own by the test below: stderr is the process's.
    #[test]
    fn panicking_child() {
        match std::env::var("MORULA_PANICKING_CHILD").as_deref() {
            Ok("guarded") => {
                guard(|| panic!("of the library"));
                guard(|| {
                    Pool::new(3)?.map(9, |i| assert_ne!(i, 4, "of the library"));
                    Ok(())
                });
            }
            Ok("host") => {
                guard(|| Ok(()));
                let _ = catch_unwind(|| panic!("of the host"));
                let _ = std::thread::spawn(|| panic!("of the host's thread")).join();
            }
            Ok("callback") => {
                guard(|| {
                    let theirs =
                        super::super::fenv::host(|| catch_unwind(|| panic!("of the callback")));
                    assert!(theirs.is_err());
                    panic!("of the library")
                });
            }
            _ => {}
        }
    }

    #[test]
    fn caught_panics_are_silent_and_the_hosts_own_are_not() {
        let stderr = |kind: &str| {
            let out = Command::new(std::env::current_exe().unwrap())
                .args(["--exact", "ffi::guard::tests::panicking_child", "--nocapture"])
                .env("MORULA_PANICKING_CHILD", kind)
                .output()
                .unwrap();
            assert!(out.status.success());
            String::from_utf8_lossy(&out.stderr).into_owned()
        };
        assert_eq!(stderr("guarded"), "");
        let host = stderr("host");
        assert!(host.contains("of the host\n") && host.contains("of the host's thread"), "{host}");
        let callback = stderr("callback");
        assert!(callback.contains("of the callback\n"), "{callback}");
        assert!(!callback.contains("of the library"), "{callback}");
    }

    #[test]
    fn counts_that_memory_cannot_hold_are_refused() {
        assert!(check_bytes::<[f64; 3]>(usize::MAX / 24, "v").is_err());
        assert!(check_bytes::<[f64; 3]>(usize::MAX, "v").is_err());
        assert!(check_bytes::<[f64; 3]>(isize::MAX as usize / 24, "v").is_ok());
    }

    #[test]
    fn text_is_copied_whole_or_not_at_all() {
        let mut buffer = [1 as c_char; 6];
        let mut length = 99;
        let put = |c, b: *mut c_char, l: *mut usize| unsafe { copy_text("hello", c, b, l) };
        assert!(put(5, buffer.as_mut_ptr(), &mut length).is_err());
        assert_eq!((length, buffer[0]), (99, 1));
        assert!(put(6, buffer.as_mut_ptr(), &mut length).is_ok());
        assert_eq!((length, buffer[5]), (5, 0));
        length = 0;
        assert!(put(0, std::ptr::null_mut(), &mut length).is_ok());
        assert_eq!(length, 5);
        assert!(put(0, std::ptr::null_mut(), std::ptr::null_mut()).is_err());
    }
}
