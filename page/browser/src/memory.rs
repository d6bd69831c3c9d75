//! Memory that the page and the module hand to each other.

/// Bytes before an answer: its status and its length.
const HEAD: usize = 8;

/// Memory of so many bytes, all zero.
pub(crate) fn of_length(length: usize) -> *mut u8 {
    Box::into_raw(vec![0_u8; length].into_boxed_slice()).cast()
}

/// Gives such memory back.
///
/// # Safety
/// It is of [`of_length`] or [`answer`], has this length, and is not used any more.
pub(crate) unsafe fn give_back(start: *mut u8, length: usize) {
    // SAFETY: the caller promises that this is a box of bytes of that length
    drop(unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(start, length)) });
}

/// The bytes that were written at a place.
///
/// # Safety
/// So many bytes are there.
pub(crate) unsafe fn bytes(start: *const u8, length: usize) -> Vec<u8> {
    // SAFETY: as the caller promises
    unsafe { std::slice::from_raw_parts(start, length) }.to_vec()
}

/// The text that was written at a place; what is no text is shown as such.
///
/// # Safety
/// So many bytes are there.
pub(crate) unsafe fn text(start: *const u8, length: usize) -> String {
    // SAFETY: as the caller promises
    let bytes = unsafe { bytes(start, length) };
    String::from_utf8(bytes)
        .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned())
}

/// An answer with its head.
pub(crate) fn answer(status: u32, text: &str) -> *mut u8 {
    let length = u32::try_from(text.len()).unwrap_or(u32::MAX);
    let mut block = Vec::with_capacity(HEAD + text.len());
    block.extend_from_slice(&status.to_le_bytes());
    block.extend_from_slice(&length.to_le_bytes());
    block.extend_from_slice(text.as_bytes());
    Box::into_raw(block.into_boxed_slice()).cast()
}
