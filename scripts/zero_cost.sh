#!/bin/sh
# What the code of effects costs a scene that does not name them, in instructions (callgrind): the whole engine against one
# that is built without them. Prints a table; ends with 1 where a ratio is beyond 1.03 or the results differ.
#   sh scripts/zero_cost.sh [--each] [STEPS]
# All that a scene does not name are left out together; with --each, one after the other as well (13 more builds).
set -eu
LC_ALL=C
export LC_ALL
cd "$(dirname "$0")/.."
. scripts/need.sh

need_rust
need valgrind valgrind
each=
if [ "${1:-}" = --each ]; then
    each=yes
    shift
fi
steps=${1:-1000}
target=${CARGO_TARGET_DIR:-target}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Builds the engine without $1, names with commas (with all of it where that is empty), and the program $2.
build() {
    if [ -n "$1" ]; then
        MORULA_WITHOUT=$1
        export MORULA_WITHOUT
    else
        unset MORULA_WITHOUT
    fi
    # One unit, so that no effect changes what is inlined where by how code is dealt among units.
    cargo rustc --quiet --release --locked --lib --crate-type rlib --no-default-features \
        --features dem -- -C codegen-units=1
    rustc --edition 2024 -C opt-level=3 -L "dependency=$target/release/deps" \
        --extern "morula=$target/release/libmorula.rlib" -o "$work/$2" scripts/zero_cost.rs
}

# Instructions of program $1 with scene $2; what it prints goes to $work/$1_$2.
count() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$work/$1" "$2" "$steps" \
        >"$work/$1_$2" 2>"$work/log"
    awk '/Collected/ { print $NF }' "$work/log"
}

bad=0
# A line for scene $1, without the effects $2.
row() {
    build "$2" without
    if [ "$1" = gas ]; then whole=$gas; else whole=$fall; fi
    own=$(count without "$1")
    cmp -s "$work/without_$1" "$work/whole_$1" || { echo "$2: another result" >&2; bad=1; }
    ratio=$(awk "BEGIN { printf \"%.4f\", $whole / $own }")
    echo "| $1 | $2 | $whole | $own | $ratio |"
    awk "BEGIN { exit !($whole <= 1.03 * $own) }" || bad=1
}

build "" whole
gas=$(count whole gas)
fall=$(count whole fall)
echo "| scene | built without | instructions, whole engine | without them | ratio |"
echo "| --- | --- | --- | --- | --- |"
contact=damping,tangential,rolling,cohesion,averaging
others=drag,insertion,motion,fragmentation,wear
row gas "$contact,$others,gravity"
row fall "normal,$contact,$others"
if [ -n "$each" ]; then
    for effect in gravity damping tangential rolling cohesion averaging drag insertion motion \
        fragmentation wear; do
        row gas $effect
    done
    row fall normal
fi
exit $bad
