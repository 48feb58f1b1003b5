//! Gives the shared library its soname: programs linked against one ABI number
//! keep running with any later build of that number. Once loaded it stays: what
//! Rust's runtime and the thread pools keep for the whole process (13 KiB a load
//! with threads) would be lost at each unloading.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let target = std::env::var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    match target.as_str() {
        "linux" | "freebsd" | "netbsd" | "openbsd" | "dragonfly" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libmorula.so.0");
            println!("cargo::rustc-cdylib-link-arg=-Wl,-z,nodelete");
        }
        "macos" => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libmorula.0.dylib");
        }
        _ => {}
    }
}
