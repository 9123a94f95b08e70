//! The check of model files, of slots in flash and of vocabularies.

/// Bytes of the CRC-32.
#[cfg(feature = "snapshot")]
pub const CHECK_BYTES: usize = 4;

/// CRC-32 (the one of Ethernet, zip and PNG), bit by bit: no table in flash.
pub(crate) const CHECK: crc::Crc<u32, crc::NoTable> = crc::Crc::<u32, crc::NoTable>::new(&crc::CRC_32_ISO_HDLC);
