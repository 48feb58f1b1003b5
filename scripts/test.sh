#!/bin/sh
# Everything that must hold: format, lints, docs, Rust tests (with the check
# that the C header is current), and CTest against the installed tree.
#   sh scripts/test.sh          the daily run, at most 12 minutes on 2 cores
#   sh scripts/test.sh --full   with the long cases: bad input at the default options, and
#                               CTest under valgrind, with debug assertions and with the sanitizers
#   sh scripts/test.sh --all-codes  with every DEM code that reads our files and can be installed (LAMMPS
#                               always is; LIGGGHTS and YADE are large)
# Tests over third-party data run when MORULA_DATA names their folder.
set -u
cd "$(dirname "$0")/.." || exit 1
. scripts/need.sh

full=no
all_codes=no
for argument in "$@"; do
    case "$argument" in
    --full) full=yes ;;
    --all-codes) all_codes=yes ;;
    *)
        echo "usage: sh scripts/test.sh [--full] [--all-codes]" >&2
        exit 2
        ;;
    esac
done
[ "$full" = yes ] && export MORULA_FULL=1

need_rust
need cmake cmake
need make make
need g++ g++

logs=build/test-logs
mkdir -p "$logs" || exit 1
summary="$logs/summary"
: >"$summary"
failed=0

skip() { echo "skipped  $1: $2" >>"$summary"; }

# lacking STEP WHY: skipped on a person's machine, a failure in a continuous build.
lacking() {
    if [ -n "${CI:-}" ]; then
        echo "FAILED   $1: $2" >>"$summary"
        failed=1
    else
        skip "$1" "$2"
    fi
}

# step NAME COMMAND…: runs it, keeps its log, notes the outcome and the time.
step() {
    name=$1
    shift
    log="$logs/$(echo "$name" | tr ' ' '-').log"
    echo
    echo "== $name: $*"
    begin=$(date +%s)
    { "$@" 2>&1 </dev/null; echo $? >"$log.status"; } | tee "$log"
    took=$(($(date +%s) - begin))
    if [ "$(cat "$log.status")" = 0 ]; then
        echo "ok       $name ($took s)" >>"$summary"
    else
        echo "FAILED   $name ($took s), see $log" >>"$summary"
        failed=1
    fi
}

# component NAME: a part of the Rust toolchain, fetched when rustup can.
component() {
    cargo "$1" --version >/dev/null 2>&1 && return 0
    have rustup && rustup component add "${2:-$1}" >/dev/null 2>&1 &&
        cargo "$1" --version >/dev/null 2>&1
}

if component fmt rustfmt; then
    step "format" cargo fmt --check
else
    lacking "format" "rustfmt is not installed"
fi
if component clippy; then
    step "lints" cargo clippy --locked --all-targets -- -D warnings
    step "lints of the shipped library" \
        cargo clippy --locked --no-default-features --features io --lib -- -D warnings
    step "lints of the bare library" cargo clippy --locked --no-default-features --lib -- -D warnings
else
    lacking "lints" "clippy is not installed"
fi
step "docs" env RUSTDOCFLAGS=-Dwarnings cargo doc --locked --no-deps
# The made hard cases stand beside the third-party data, with their maker.
if [ -n "${MORULA_DATA:-}" ]; then
    python_with_numpy || { install python3-numpy && python_with_numpy; } ||
        skip "made hard cases" "no python3 with numpy (MORULA_PYTHON names one)"
fi
# Before the Rust tests, some of which compile for themselves: without a compiler they would pass
# having looked at nothing.
have gfortran || install gfortran || true
have gfortran || skip "Fortran cases, of the Rust tests and of CTest" "gfortran is not installed"
have clang++ || install clang || true
have clang++ || skip "C and C++ cases with clang" "clang++ is not installed"
have_pkg_config() { have pkg-config || have pkgconf; }
have_pkg_config || install pkg-config || true
have_pkg_config || skip "pkg-config cases of CTest" "pkg-config is not installed"
{ have mpicxx && have mpirun; } || install libopenmpi-dev openmpi-bin || true
have mpicxx || skip "MPI cases of CTest" "mpicxx is not installed (package libopenmpi-dev)"
python_with_numpy || { install python3-numpy && python_with_numpy; } ||
    skip "Python case of CTest" "no python3 with numpy (MORULA_PYTHON names one)"
have valgrind || install valgrind || true
have valgrind || skip "valgrind cases of CTest" "valgrind is not installed"
# DEM codes that read the files written for them.
have lmp || install lammps || true
have lmp || skip "what LAMMPS reads" "lmp is not installed (package lammps)"
have mpirun || install openmpi-bin || true
have mpirun || skip "LAMMPS on two ranks" "mpirun is not installed (package openmpi-bin)"
for code in liggghts yade; do
    have "$code" || { [ "$all_codes" = yes ] && install "$code"; } || true
    have "$code" && continue
    [ "$all_codes" = yes ] && why="the package $code cannot be installed" || why="run with --all-codes"
    skip "what $code reads" "$why"
done
skip "what MercuryDPM, Chrono DEM-Engine, MFiX and Kratos read" "Debian has none of them"
skip "what PFC and EDEM read" "they are not to be had freely"
have abidiff || install abigail-tools || true
# The dev profile: optimised, with debug assertions.
step "cargo test" cargo test --locked --no-fail-fast

tree=build/test
step "cmake configure" cmake -S . -B "$tree" -DCMAKE_BUILD_TYPE=Release \
    -DMORULA_CARGO_TARGET_DIR="$(pwd)/target" -DMORULA_VALGRIND=OFF
step "cmake build" cmake --build "$tree"
step "ctest" ctest --test-dir "$tree" --output-on-failure
if have abidiff; then
    step "abi" sh scripts/abi.sh --library "$tree/lib/libmorula.so"
else
    lacking "abi" "abidiff is not installed (package abigail-tools)"
fi

if [ "$full" = yes ]; then
    have valgrind && step "configure valgrind" cmake -S . -B "$tree" -DMORULA_VALGRIND=ON &&
        step "ctest valgrind" ctest --test-dir "$tree" -L valgrind --output-on-failure
    for preset in debug asan; do
        step "configure $preset" cmake --preset "$preset"
        step "build $preset" cmake --build --preset "$preset"
        step "ctest $preset" ctest --preset "$preset"
    done
fi

if cargo deny --version >/dev/null 2>&1; then
    # A word to the maintainers, never a condition.
    cargo deny --offline check licenses advisories >"$logs/licences.log" 2>&1 &&
        echo "ok       licences and advisories" >>"$summary" ||
        echo "noted    licences and advisories: see $logs/licences.log" >>"$summary"
else
    skip "licences" "cargo-deny is not installed"
fi
[ -n "${MORULA_DATA:-}" ] || skip "made hard cases, cases over third-party data" "MORULA_DATA is not set"
[ "$full" = yes ] || skip "long cases" "run with --full"

echo
echo "== summary"
cat "$summary"
passed=$(sed -n 's/^test result: [a-zA-Z]*\. \([0-9]*\) passed.*/\1/p' "$logs/cargo-test.log" |
    awk '{ n += $1 } END { print n + 0 }')
wrong=$(sed -n 's/^test result: .* passed; \([0-9]*\) failed.*/\1/p' "$logs/cargo-test.log" |
    awk '{ n += $1 } END { print n + 0 }')
echo "cargo test: $passed passed, $wrong failed"
echo "CTest: $(grep 'tests passed' "$logs/ctest.log" || echo 'no total')"
if [ "$failed" = 0 ]; then
    echo "all steps passed"
else
    echo "a step FAILED"
fi
exit "$failed"
