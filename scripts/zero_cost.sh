#!/bin/sh
# What the code of an effect costs a scene that does not name it, in instructions (callgrind): the whole engine against one
# that is built without that effect. Prints a table; ends with 1 where the difference is beyond 3 % or the results differ.
#   sh scripts/zero_cost.sh [STEPS]
set -eu
LC_ALL=C
export LC_ALL
cd "$(dirname "$0")/.."
. scripts/need.sh

need_rust
need valgrind valgrind
steps=${1:-1000}
target=${CARGO_TARGET_DIR:-target}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Builds the engine without $1 (with all of it where that is empty).
build() {
    if [ -n "$1" ]; then
        MORULA_WITHOUT=$1
        export MORULA_WITHOUT
    else
        unset MORULA_WITHOUT
    fi
    CARGO_INCREMENTAL=1 cargo rustc --quiet --release --locked --lib --crate-type rlib \
        --no-default-features --features dem
    rustc --edition 2024 -C opt-level=3 -L "dependency=$target/release/deps" \
        --extern "morula=$target/release/libmorula.rlib" -o "$work/run" scripts/zero_cost.rs
}

# Instructions of scene $1; what it prints goes to $work/$2.
count() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$work/run" "$1" "$steps" \
        >"$work/$2" 2>"$work/log"
    awk '/Collected/ { print $NF }' "$work/log"
}

build ""
gas=$(count gas whole_gas)
fall=$(count fall whole_fall)
bad=0
echo "| effect | scene without it | instructions, whole engine | built without it | ratio |"
echo "| --- | --- | --- | --- | --- |"
for effect in gravity normal damping tangential rolling cohesion averaging drag insertion motion \
    fragmentation wear; do
    scene=gas
    whole=$gas
    if [ $effect = normal ]; then
        scene=fall
        whole=$fall
    fi
    build $effect
    own=$(count $scene own)
    cmp -s "$work/own" "$work/whole_$scene" || { echo "$effect: another result" >&2; bad=1; }
    ratio=$(awk "BEGIN { printf \"%.4f\", $whole / $own }")
    echo "| $effect | $scene | $whole | $own | $ratio |"
    awk "BEGIN { exit !($whole <= 1.03 * $own) }" || bad=1
done
exit $bad
