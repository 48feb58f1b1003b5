#!/bin/sh
# What an installation holds, and how large it is: docs/embedding.md has its output.
#   sh scripts/installed.sh [BUILD]     BUILD: a CMake build tree of the library, default build/test
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/test}
[ -f "$build/cmake_install.cmake" ] || {
    echo "$0: $build is not a build tree: cmake -S . -B $build -DCMAKE_BUILD_TYPE=Release && cmake --build $build" >&2
    exit 1
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >/dev/null
cd "$work/prefix"
find . -type f -o -type l | LC_ALL=C sort | while read -r file; do
    if [ -L "$file" ]; then
        printf '%10s  %s -> %s\n' '' "${file#./}" "$(readlink "$file")"
    else
        printf '%10d  %s\n' "$(wc -c <"$file")" "${file#./}"
    fi
done
shared=$(find . -type f -name 'libmorula.so.*')
static=$(find . -type f -name 'libmorula.a')
strip --strip-unneeded "$shared" -o "$work/stripped.so"
strip --strip-debug "$static" -o "$work/stripped.a"
mib() { awk -v b="$(wc -c <"$1")" 'BEGIN { printf "%.1f MiB", b / 1048576 }'; }
echo
echo "libmorula.so: $(mib "$shared"), stripped $(mib "$work/stripped.so")"
echo "libmorula.a: $(mib "$static"), without debug information $(mib "$work/stripped.a")"
printf '#include <morula.h>\nint main(void) { return morula_shape_from_file("", 0, 0, 0) == 0; }\n' >"$work/one.c"
# shellcheck disable=SC2046 # words are wanted
cc "$work/one.c" -I include "$static" $(sed -n 's/^Libs.private: //p' "$(find . -name morula.pc)") -s -o "$work/one"
echo "a program that reads a shape, static and stripped: $(mib "$work/one")"
readelf -d "$shared" | sed -n 's/.*(\(SONAME\|NEEDED\)).*: \[\(.*\)\]/\1 \2/p'
grep -e '^Libs' "$(find . -name morula.pc)"
