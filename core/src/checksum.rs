//! The checksum of model files, slots in flash and vocabularies: CRC-32, as in Ethernet, zip and PNG. Beside it, a hash for tables of words.

/// Bytes of the CRC-32.
pub const CHECK_BYTES: usize = 4;

/// The FNV-1a hash of these values, one step for each.
#[cfg(any(feature = "layer", feature = "talk"))]
pub(crate) fn fnv(values: impl Iterator<Item = u32>) -> u32 {
    values.fold(0x811c_9dc5, |hash, value| (hash ^ value).wrapping_mul(0x0100_0193))
}

#[cfg(target_os = "none")]
pub(crate) use half_bytes::{CHECK, Check};
#[cfg(not(target_os = "none"))]
pub(crate) use library::{CHECK, Check};

/// A checksum under way, kept between calls.
#[derive(Clone)]
pub(crate) struct Running(Check);

impl Running {
    /// The checksum of no bytes.
    pub(crate) fn new() -> Self {
        Self(CHECK.digest())
    }

    pub(crate) fn update(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// The checksum of all bytes so far.
    pub(crate) fn value(&self) -> u32 {
        self.0.clone().finalize()
    }
}

impl core::fmt::Debug for Running {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("Running").field(&self.value()).finish()
    }
}

/// From the library: a byte at a time.
#[cfg(not(target_os = "none"))]
mod library {
    #[cfg(not(target_family = "wasm"))]
    type Steps = crc::Table<1>;
    /// Bit by bit, for the page: a table does not compress, so it would add its whole size to the page.
    #[cfg(target_family = "wasm")]
    type Steps = crc::NoTable;

    pub(crate) static CHECK: crc::Crc<u32, Steps> = crc::Crc::<u32, Steps>::new(&crc::CRC_32_ISO_HDLC);
    pub(crate) type Check = crc::Digest<'static, u32, Steps>;
}

/// Half a byte at a time, for controllers. The library's table takes 1 KB of flash, and without it the vocabulary's check takes a small
/// controller more than a quarter of a tick.
#[cfg(any(test, target_os = "none"))]
mod half_bytes {
    const TABLE: [u32; 16] = {
        let mut table = [0; 16];
        let mut at = 0;
        while at < table.len() {
            let (mut entry, mut bits) = (at as u32, 0);
            while bits < 4 {
                entry = (entry >> 1) ^ if entry & 1 == 1 { 0xedb8_8320 } else { 0 };
                bits += 1;
            }
            table[at] = entry;
            at += 1;
        }
        table
    };

    pub(crate) static CHECK: Crc32 = Crc32;
    pub(crate) struct Crc32;
    #[derive(Clone)]
    pub(crate) struct Check(u32);

    impl Crc32 {
        pub(crate) const fn digest(&self) -> Check {
            Check(u32::MAX)
        }

        pub(crate) fn checksum(&self, bytes: &[u8]) -> u32 {
            let mut check = self.digest();
            check.update(bytes);
            check.finalize()
        }
    }

    impl Check {
        pub(crate) fn update(&mut self, bytes: &[u8]) {
            let half = |check: u32| TABLE.get((check & 15) as usize).copied().unwrap_or(0) ^ (check >> 4);
            self.0 = bytes.iter().fold(self.0, |check, &byte| half(half(check ^ u32::from(byte))));
        }

        pub(crate) const fn finalize(self) -> u32 {
            !self.0
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn controllers_and_hosts_come_to_the_same_check() {
        for text in ["", "123456789", "agentInRoom\0room\0", "ein Stück weiter"] {
            assert_eq!(super::half_bytes::CHECK.checksum(text.as_bytes()), super::library::CHECK.checksum(text.as_bytes()), "{text}");
        }
        assert_eq!(super::half_bytes::CHECK.checksum(b"123456789"), 0xcbf4_3926);
    }
}
