//! Structures over arbitrary triangles, and arbitrary rays through them.
#![no_main]

use libfuzzer_sys::fuzz_target;
use oktant_fuzz::Case;

fuzz_target!(|case: Case| case.check());
