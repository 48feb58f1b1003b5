# Sourced by the other scripts: finds programs, installs what is missing.

# have NAME: whether a program is there.
have() { command -v "$1" >/dev/null 2>&1; }

# as_root COMMAND…: runs it as root, when that is possible without a question.
as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif have sudo && sudo -n true 2>/dev/null; then
        sudo -n "$@"
    else
        return 1
    fi
}

# install PACKAGE…: with apt-get, quietly; fails when that is not possible.
install() {
    have apt-get || return 1
    echo "installing: $*"
    DEBIAN_FRONTEND=noninteractive
    export DEBIAN_FRONTEND
    as_root apt-get install -y --no-install-recommends "$@" >/dev/null 2>&1 </dev/null && return 0
    as_root apt-get update >/dev/null 2>&1 </dev/null &&
        as_root apt-get install -y --no-install-recommends "$@" >/dev/null 2>&1 </dev/null
}

# need PROGRAM PACKAGE: makes sure that a program is there, or ends with one clear line.
need() {
    have "$1" && return 0
    install "$2" && have "$1" && return 0
    echo "$0: $1 is missing and could not be installed: install the package $2 (as root: apt-get install $2)" >&2
    exit 1
}

# rust_is_new: whether cargo is at least $wanted.
rust_is_new() {
    present=$(cargo --version 2>/dev/null | sed -n 's/^cargo \([0-9]*\.[0-9]*\).*/\1/p')
    printf '%s.%s\n' "$present" "$wanted" | awk -F. '{ exit !($1 > $3 || ($1 == $3 && $2 >= $4)) }'
}

# need_rust: cargo cannot come from apt (too old): says where it comes from.
need_rust() {
    wanted=$(sed -n 's/^rust-version = "\([0-9.]*\)".*/\1/p' Cargo.toml)
    have cargo && rust_is_new && return 0
    if [ -x "${HOME:-}/.cargo/bin/cargo" ]; then
        PATH="$HOME/.cargo/bin:$PATH"
        export PATH
        rust_is_new && return 0
    fi
    if have cargo; then
        echo "$0: $(cargo --version 2>&1 | head -n 1) is older than Rust $wanted: run rustup update (https://rustup.rs)" >&2
    else
        echo "$0: cargo is missing: install Rust $wanted or later (https://rustup.rs)" >&2
    fi
    exit 1
}

# python_with_numpy: one that has it, in MORULA_PYTHON. The python3 on PATH need not be the
# system's, which is the one that packages are installed for.
python_with_numpy() {
    for python in "${MORULA_PYTHON:-python3}" python3 /usr/bin/python3; do
        if "$python" -c 'import numpy' >/dev/null 2>&1 </dev/null; then
            MORULA_PYTHON=$python
            export MORULA_PYTHON
            return 0
        fi
    done
    return 1
}
