//! Gives the linker the chip's memory, as `esp-hal` lays it out.

fn main() {
    println!("cargo::rustc-link-arg-bins=-Tlinkall.x");
    println!("cargo::rerun-if-changed=build.rs");
}
