//! The version of the interface.

/// The version of this interface. It rises when a program that was compiled with an older header would go wrong.
pub const GOODBOT_API_VERSION: u32 = 2;

/// The version of the library that is linked: compare it with `GOODBOT_API_VERSION`.
#[unsafe(no_mangle)]
pub extern "C" fn goodbot_api_version() -> u32 {
    GOODBOT_API_VERSION
}
