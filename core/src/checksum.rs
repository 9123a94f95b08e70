//! The check of model files, of slots in flash and of vocabularies.

/// Bytes of the CRC-32.
#[cfg(feature = "snapshot")]
pub const CHECK_BYTES: usize = 4;

/// CRC-32 (the one of Ethernet, zip and PNG), byte by byte: the table takes 1 KB of flash. Bit by bit, the vocabulary's check would be a
/// third of what a robot does when it begins to hear.
#[cfg(not(target_family = "wasm"))]
pub(crate) static CHECK: crc::Crc<u32> = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
/// The same, bit by bit: everybody who opens the page would load the table, which nothing packs.
#[cfg(target_family = "wasm")]
pub(crate) static CHECK: crc::Crc<u32, crc::NoTable> = crc::Crc::<u32, crc::NoTable>::new(&crc::CRC_32_ISO_HDLC);
