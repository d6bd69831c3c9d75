//! The program behind the live page in a browser alone: calls as JSON, in and out of the memory of a
//! WebAssembly module. It imports nothing, so that it has neither a clock nor a disk nor threads, and
//! its figures are those of the baseline path of any machine.

mod calls;
mod memory;

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Files that were handed over, which models may name.
static HELD: Mutex<Vec<(String, Vec<u8>)>> = Mutex::new(Vec::new());

fn held() -> MutexGuard<'static, Vec<(String, Vec<u8>)>> {
    HELD.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Memory for what the page hands over.
#[unsafe(no_mangle)]
pub extern "C" fn alloc(length: usize) -> *mut u8 {
    memory::of_length(length)
}

/// Gives memory back: what [`alloc`] gave, or an answer of [`call`] with its eight bytes before it.
///
/// # Safety
/// `start` and `length` are those of such a piece of memory, which nobody uses any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dealloc(start: *mut u8, length: usize) {
    // SAFETY: as the caller promises
    unsafe { memory::give_back(start, length) }
}

/// Answers a call: its name and its request are texts in memory. The answer begins with its status (0
/// done, 1 the request is at fault, 2 the program is) and its length, both of 32 bits, and is a JSON
/// text.
///
/// # Safety
/// Starts and lengths are those of memory of [`alloc`] that was written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn call(
    name: *const u8,
    name_length: usize,
    request: *const u8,
    request_length: usize,
) -> *mut u8 {
    // SAFETY: as the caller promises
    let (name, request) =
        unsafe { (memory::text(name, name_length), memory::text(request, request_length)) };
    let (status, answer) = match calls::answer(&name, &request, &held()) {
        Ok(answer) => (0, answer),
        Err(fault) => fault.told(),
    };
    memory::answer(status, &answer)
}

/// Keeps a file that models may name, in place of one of the same name.
///
/// # Safety
/// As of [`call`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn hold(
    name: *const u8,
    name_length: usize,
    content: *const u8,
    content_length: usize,
) {
    // SAFETY: as the caller promises
    let (name, content) =
        unsafe { (memory::text(name, name_length), memory::bytes(content, content_length)) };
    let mut held = held();
    held.retain(|(of, _)| *of != name);
    held.push((name, content));
}

/// Forgets all files.
#[unsafe(no_mangle)]
pub extern "C" fn forget() {
    held().clear();
}
