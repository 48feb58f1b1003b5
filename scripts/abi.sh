#!/bin/sh
# The ABI against its committed baseline, tests/abi/baseline.h, with abidiff: what was removed or
# changed fails, what was added passes and is listed.
#   sh scripts/abi.sh                      types and functions of include/morula.h
#   sh scripts/abi.sh --library FILE       and the symbols that a built libmorula.so has
#   sh scripts/abi.sh --header FILE        another header in the place of include/morula.h
#   sh scripts/abi.sh --release            makes the header of today the baseline (with a release)
# abidiff reads debug information. The shipped library has none, and its would be Rust's; so the
# header is compiled into a small library of the same functions, which has C's.
set -u
cd "$(dirname "$0")/.." || exit 1

baseline=tests/abi/baseline.h
header=include/morula.h
library=
release=no
while [ $# -gt 0 ]; do
    case "$1" in
    --library | --header)
        [ $# -gt 1 ] || { echo "$1 needs a file" >&2; exit 2; }
        [ "$1" = --library ] && library=$2 || header=$2
        shift
        ;;
    --release) release=yes ;;
    *)
        echo "usage: sh scripts/abi.sh [--library FILE] [--header FILE] [--release]" >&2
        exit 2
        ;;
    esac
    shift
done

# bare HEADER: without comments, and without the version, which each release changes.
bare() { grep -v -e '^ *//' -e '^ \*' -e '^/\*' -e 'MORULA_VERSION' -e '^  (1000000u' -e '^ *$' "$1"; }

if [ "$release" = yes ]; then
    bare "$header" >"$baseline"
    echo "$baseline is $header of $(sed -n 's/^#define MORULA_VERSION_STRING //p' "$header")"
    exit 0
fi

for tool in abidiff cc; do
    command -v "$tool" >/dev/null 2>&1 || { echo "abi.sh: $tool is not installed" >&2; exit 3; }
done
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

# stand_in NAME: a library with the functions of $work/morula.h, empty, and their types.
stand_in() {
    {
        echo '#include "morula.h"'
        tr '\n' ' ' <"$work/morula.h" | sed 's/;/;\n/g' |
            sed -n 's/^.*[ }]\(\(const char \*\|u\{0,1\}int32_t \|size_t \|void \)morula_[a-z0-9_]*([^()]*)\);$/\1/p' |
            sed -e 's/^void \(.*\)$/void \1 {}/' -e '/^void /!s/$/ { return 0; }/'
    } >"$work/stand_in.c"
    (cd "$work" && cc -std=c11 -g -O0 -w -shared -fPIC -Wl,-soname,libmorula.so.0 \
        -Wl,--build-id=none stand_in.c -o "$1")
}

# as_known OLD NEW: the new header with no more fields in a struct than the old one has. Fields are
# appended for ever (struct_size tells who knows which); with them left out every change is a break.
# (A suppression of "inserted at the end" also hides fields that change their type.)
as_known() {
    awk '
        /^typedef struct .* \{$/ { name = $3; n = 0 }
        /^\}/ { name = "" }
        name != "" && /;$/ { n++; if (NR == FNR) fields[name] = n }
        NR != FNR && !(name in fields && n > fields[name]) { print }
    ' "$1" "$2"
}

bare "$baseline" >"$work/old.h"
bare "$header" >"$work/new.h"
cp "$work/old.h" "$work/morula.h" && stand_in baseline.so || exit 2
as_known "$work/old.h" "$work/new.h" >"$work/morula.h" && stand_in known.so || exit 2
cp "$work/new.h" "$work/morula.h" && stand_in now.so || exit 2
functions=$(grep -c '^.*) {' "$work/stand_in.c")
[ "$functions" -gt 100 ] || { echo "abi.sh: only $functions functions found in $header" >&2; exit 2; }

echo "== $header beside $baseline: $functions functions"
abidiff --harmless --no-default-suppression "$work/baseline.so" "$work/now.so" >"$work/all"
sed -e 's/^/  /' -e '/^ *$/d' "$work/all"
failed=0
if abidiff --harmless --no-default-suppression --no-added-syms \
    "$work/baseline.so" "$work/known.so" >"$work/verdict" 2>&1; then
    if [ -s "$work/all" ]; then
        echo "added only: programs that are linked already go on"
    else
        echo "the same"
    fi
else
    echo "NOT COMPATIBLE: programs that are linked already would break"
    failed=1
fi

if [ -n "$library" ]; then
    # The symbols alone: the stand-in loses its debug information, as the library has none.
    strip --strip-debug "$work/now.so"
    echo "== $library beside $header"
    if abidiff --no-default-suppression "$work/now.so" "$library" >"$work/symbols" 2>&1; then
        echo "the same symbols, soname $(readelf -d "$library" | sed -n 's/.*soname: \[\(.*\)\]/\1/p')"
    else
        echo "NOT THE SAME"
        sed -e 's/^/  /' -e '/^ *$/d' "$work/symbols"
        failed=1
    fi
fi
exit "$failed"
