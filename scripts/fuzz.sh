#!/bin/sh
# Fuzzes what comes from outside: sh scripts/fuzz.sh SECONDS [TARGET…]
# Corpora grow in fuzz/corpus; a crash is left in fuzz/artifacts. Needs cargo-fuzz.
set -u
cd "$(dirname "$0")/.." || exit 1
. scripts/need.sh
[ $# -ge 1 ] || {
    echo "usage: sh scripts/fuzz.sh SECONDS [TARGET…]" >&2
    exit 2
}
seconds=$1
shift
[ $# -gt 0 ] || set -- meshes voxels serial calls
need_rust
cargo fuzz --version >/dev/null 2>&1 || cargo install cargo-fuzz --locked || exit 1
# Sanitizers are not stable yet; everything else here is.
export RUSTC_BOOTSTRAP=1
status=0
for target in "$@"; do
    mkdir -p "fuzz/corpus/$target"
    echo "== $target"
    cargo fuzz run --fuzz-dir fuzz "$target" "fuzz/corpus/$target" "tests/fuzz_regressions/$target" -- \
        -max_total_time="$seconds" -timeout=60 -rss_limit_mb=2048 -max_len=4096 -print_final_stats=1 ||
        status=1
done
exit $status
