//! The C ABI. The only room with `unsafe`.
#![allow(unsafe_code)]
