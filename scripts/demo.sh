#!/bin/sh
# From a fresh machine with Rust to clumps one can look at.
#   sh scripts/demo.sh            the built-in tablet, M&M, ellipsoid and a stone
#   sh scripts/demo.sh MESH [N]   your own mesh, with N spheres (default 50)
# Installs what is missing (cmake, make, g++), builds and stages the library,
# runs the C++ example against it and the command line, prints a table, and
# writes clumps and pictures into ./out.
set -eu
# awk reads and prints a decimal point.
LC_ALL=C
export LC_ALL
here=$(pwd)
cd "$(dirname "$0")/.."
. scripts/need.sh

mesh=${1:-}
spheres=${2:-50}
density=1.0
if [ -n "$mesh" ]; then
    case "$mesh" in
    /*) ;;
    *) mesh=$here/$mesh ;;
    esac
    if [ ! -r "$mesh" ]; then
        echo "$0: $mesh cannot be read" >&2
        exit 1
    fi
fi

need_rust
need cmake cmake
need make make
need g++ g++

root=$(pwd)
out=$here/out
stage=$root/build/stage
mkdir -p "$out" build
log=$root/build/demo.log
: >"$log"

# quietly WHAT COMMAND…: the log is shown only when the command fails.
quietly() {
    echo "$1 …"
    shift
    if ! "$@" >>"$log" 2>&1 </dev/null; then
        tail -n 30 "$log" >&2
        echo "$0: failed: $* (whole log: $log)" >&2
        exit 1
    fi
}

quietly "configuring" cmake -S . -B build/demo -DCMAKE_BUILD_TYPE=Release \
    -DMORULA_TESTS=OFF -DMORULA_CARGO_TARGET_DIR="$root/target"
quietly "building the library (the first time takes some minutes)" cmake --build build/demo
quietly "staging it into build/stage" cmake --install build/demo --prefix "$stage"
quietly "building the command line" cargo build --release --locked --bin morula
quietly "configuring the C++ example" cmake -S c_examples/cpp -B build/demo-cpp \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$stage"
quietly "building the C++ example" cmake --build build/demo-cpp
morula=${CARGO_TARGET_DIR:-target}/release/morula

echo
echo "The C++ example (one thread), linked with the staged library; ms: grid and spheres"
if [ -n "$mesh" ]; then
    build/demo-cpp/cpp_driver "$mesh" -n "$spheres" --density "$density" --csv "$out/cpp"
else
    build/demo-cpp/cpp_driver -n "$spheres" --density "$density" --csv "$out/cpp"
fi

# value KEY: a number out of one line of JSON.
value() {
    printf '%s\n' "$json" | sed -n "s/.*\"$1\":\([-+.0-9eE]*\).*/\1/p"
}

echo
echo "The command line (all cores)"
printf '%-12s %7s %8s %8s %10s %12s %8s\n' shape spheres D coverage protrusion mass ms
failed=0
# row NAME INPUT: makes the clump, writes its files, prints a line of the table.
row() {
    base=$out/$1
    if ! json=$("$morula" clump "$2" -n "$spheres" --density "$density" --json -o "$base.csv"); then
        failed=1
        return 0
    fi
    printf '%s\n' "$json" >"$base.figures.json"
    awk -v name="$1" -v n="$(value n)" -v d="$(value D)" -v c="$(value coverage)" \
        -v p="$(value protrusion)" -v m="$(value mass)" \
        -v grid="$(value solid)" -v made="$(value generate)" 'BEGIN {
            ms = 1000 * (grid + made)
            printf "%-12s %7d %8.4f %8.4f %10.4g %12.5g %8.1f\n", name, n, d, c, p, m, ms
        }'
    "$morula" clump "$2" -n "$spheres" --quality none -q -o "$base.vtp" || failed=1
    "$morula" view "$2" "$base.csv" -o "$base.png" || failed=1
}
if [ -n "$mesh" ]; then
    name=$(basename "$mesh")
    row "${name%.*}" "$mesh"
else
    for name in tablet mandm ellipsoid; do
        row "$name" "sample:$name"
    done
    row stone "sample:stone,seed=7"
    "$morula" sample stone --seed 7 -q -o "$out/stone.stl"
fi

echo
echo "Written to $out:"
ls "$out"
exit "$failed"
