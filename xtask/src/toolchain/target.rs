//! The targets that goodbot is built for besides the host.

use std::str::FromStr;

/// A target that goodbot is built for besides the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The browser.
    Wasm32,
    /// Cortex-M0 and M0+.
    Thumbv6m,
    /// Cortex-M3.
    Thumbv7m,
    /// Cortex-M4F and M7F: floats in registers of the floating-point unit.
    Thumbv7emHf,
}

impl Target {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Wasm32, Self::Thumbv6m, Self::Thumbv7m, Self::Thumbv7emHf];

    /// The name that rustc has for it.
    pub const fn triple(self) -> &'static str {
        match self {
            Self::Wasm32 => "wasm32-unknown-unknown",
            Self::Thumbv6m => "thumbv6m-none-eabi",
            Self::Thumbv7m => "thumbv7m-none-eabi",
            Self::Thumbv7emHf => "thumbv7em-none-eabihf",
        }
    }

    /// Whether the standard library is there beyond `core` and `alloc`.
    pub const fn has_std(self) -> bool {
        matches!(self, Self::Wasm32)
    }

    /// The environment variable by which cargo is told something about this
    /// target: `CARGO_TARGET_THUMBV7M_NONE_EABI_LINKER` for `LINKER`.
    pub fn cargo_variable(self, key: &str) -> String {
        let triple = self.triple().replace('-', "_").to_uppercase();
        format!("CARGO_TARGET_{triple}_{key}")
    }
}

impl FromStr for Target {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL
            .into_iter()
            .find(|target| target.triple() == name)
            .ok_or_else(|| format!("there are {}", Self::ALL.map(Self::triple).join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_is_known_by_its_name() {
        assert_eq!("thumbv6m-none-eabi".parse(), Ok(Target::Thumbv6m));
        assert!("thumbv9".parse::<Target>().unwrap_err().contains("thumbv7em-none-eabihf"));
    }

    #[test]
    fn cargo_is_told_of_a_target_by_its_name() {
        assert_eq!(Target::Thumbv7m.cargo_variable("LINKER"), "CARGO_TARGET_THUMBV7M_NONE_EABI_LINKER");
    }
}
