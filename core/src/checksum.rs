//! The check of model files, of slots in flash and of vocabularies.

/// Bytes of the CRC-32.
#[cfg(feature = "snapshot")]
pub const CHECK_BYTES: usize = 4;

/// Byte by byte.
#[cfg(not(any(target_family = "wasm", target_os = "none")))]
type Steps = crc::Table<1>;
/// Bit by bit: the table takes 1 KB of a controller's flash, and everybody who opens the page would load it.
#[cfg(any(target_family = "wasm", target_os = "none"))]
type Steps = crc::NoTable;

/// CRC-32 (the one of Ethernet, zip and PNG).
pub(crate) static CHECK: crc::Crc<u32, Steps> = crc::Crc::<u32, Steps>::new(&crc::CRC_32_ISO_HDLC);
/// A CRC-32 under way.
pub(crate) type Check = crc::Digest<'static, u32, Steps>;
