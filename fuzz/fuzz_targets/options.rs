#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| stillage_fuzz::options(bytes));
