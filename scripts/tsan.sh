#!/bin/sh
# Programs of many threads under ThreadSanitizer, the library and Rust's standard library built with it:
# sh scripts/tsan.sh [PROGRAM…]. Needs clang and rustup (for the sources of the standard library).
set -u
cd "$(dirname "$0")/.." || exit 1
. scripts/need.sh
[ $# -gt 0 ] || set -- stress many reentrant cancel
need_rust
need clang clang
rustup component add rust-src >/dev/null 2>&1 ||
    { echo "rust-src cannot be installed: rustup component add rust-src" >&2; exit 1; }
tree=$(pwd)/build/tsan
host=$(rustc -vV | sed -n 's/^host: //p')
# Sanitizers are not stable yet; everything else here is.
RUSTC_BOOTSTRAP=1 RUSTFLAGS=-Zsanitizer=thread cargo build --locked --lib --release -Zbuild-std \
    --target "$host" --target-dir "$tree" --no-default-features --features io \
    --config profile.release.opt-level=1 --config 'profile.release.debug="line-tables-only"' || exit 1
runtime=$(ls "$(rustc --print sysroot)/lib/rustlib/$host/lib"/librustc*_rt.tsan.a | head -1)
status=0
for program in "$@"; do
    clang -g -O1 -fsanitize=thread -c -Iinclude "c_examples/c/$program.c" -o "$tree/$program.o" &&
        clang "$tree/$program.o" "$tree/$host/release/libmorula.a" -Wl,--whole-archive "$runtime" \
            -Wl,--no-whole-archive -lpthread -lm -ldl -lrt -lgcc_s -rdynamic -o "$tree/$program" || exit 1
    echo "== $program"
    # Its shadow memory wants the addresses where they always are.
    setarch -R "$tree/$program" || status=1
done
exit $status
