//! The texts that JavaScript writes into the memory of the module and reads from it.
//!
//! `allocate(n)` makes room for a request of n bytes and returns its address; `compute()` answers the text that stands there;
//! `address()` and `length()` are those of the answer. A module serves one request at a time.

use crate::page::Page;
use std::cell::RefCell;

thread_local! {
    static REQUEST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static PAGE: RefCell<Page> = RefCell::new(Page::default());
}

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
    let answer = REQUEST.with_borrow(|request| PAGE.with_borrow_mut(|page| page.answer(request)));
    ANSWER.set(answer);
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
