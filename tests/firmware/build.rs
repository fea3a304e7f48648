//! Tells the linker where the memory of the boards is described.

fn main() {
    let set = |name| std::env::var(name).expect("cargo sets it");
    let (here, processor) = (set("CARGO_MANIFEST_DIR"), set("CARGO_CFG_TARGET_ARCH"));
    println!("cargo:rustc-link-search={here}/memory/{processor}");
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    println!("cargo:rerun-if-changed=memory");
}
