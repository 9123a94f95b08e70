//! All posteriors of a run as one number, by which runs are compared bit for bit.

/// FNV-1a over the bits of floats, 32 bits wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(pub u32);

impl Digest {
    /// The digest of no value.
    pub const EMPTY: Self = Self(0x811c_9dc5);

    /// Takes in the bits of one float.
    pub fn take(&mut self, value: f32) {
        for byte in value.to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    }
}
