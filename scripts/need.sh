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

# need_rust: cargo cannot come from apt (too old): says where it comes from.
need_rust() {
    have cargo && return 0
    if [ -x "$HOME/.cargo/bin/cargo" ]; then
        PATH="$HOME/.cargo/bin:$PATH"
        export PATH
        return 0
    fi
    echo "$0: cargo is missing: install Rust 1.89 or later (https://rustup.rs)" >&2
    exit 1
}
