//! Links Embree where it is asked for.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var_os("CARGO_FEATURE_EMBREE").is_some() {
        println!("cargo::rustc-link-lib=dylib=embree3");
    }
}
