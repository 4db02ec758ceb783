//! The texts that JavaScript writes into the memory of the module and reads from it.
//!
//! `allocate(n)` makes room for a request of n bytes and returns its address; `compute()` answers the text that stands there;
//! `address()` and `length()` are those of the answer. What is known of it before the rest is computed goes to the imported function
//! `page.begun(address, length)`. A module serves one request at a time.

use crate::page::Page;
use std::cell::RefCell;

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static PAGE: RefCell<Page> = RefCell::new(Page::default());
}

#[cfg(target_arch = "wasm32")]
#[allow(unsafe_code, reason = "a function of JavaScript")]
#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Takes the first part of an answer.
    safe fn begun(address: *const u8, length: usize);
}

/// Elsewhere nothing takes it.
#[cfg(not(target_arch = "wasm32"))]
fn begun(_address: *const u8, _length: usize) {}

/// Makes room for a request of so many bytes; returns its address.
#[allow(unsafe_code, reason = "a name that JavaScript finds")]
#[unsafe(no_mangle)]
pub extern "C" fn allocate(bytes: usize) -> *mut u8 {
    REQUEST.with_borrow_mut(|request| {
        *request = vec![0; bytes];
        request.as_mut_ptr()
    })
}

/// Answers the request.
#[allow(unsafe_code, reason = "a name that JavaScript finds")]
#[unsafe(no_mangle)]
pub extern "C" fn compute() {
    let answer = REQUEST.with_borrow(|request| PAGE.with_borrow_mut(|page| page.answer(request, &mut first_part)));
    ANSWER.set(answer);
}

fn first_part(answer: &[u8]) {
    begun(answer.as_ptr(), answer.len());
}

/// Address of the answer.
#[allow(unsafe_code, reason = "a name that JavaScript finds")]
#[unsafe(no_mangle)]
pub extern "C" fn address() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.as_ptr())
}

/// Length of the answer, bytes.
#[allow(unsafe_code, reason = "a name that JavaScript finds")]
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    ANSWER.with_borrow(Vec::len)
}
