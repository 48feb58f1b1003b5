#!/bin/sh
# The figures of the method best, what accuracy costs in time, and the picture at the top of the README.
#   [MORULA_DATA=<data folder>] [MORULA_PEER_PYTHON=<python>] sh scripts/figures.sh [--full] [--no-peers]
# Writes docs/best_figures.md, docs/best_figures.csv, docs/stone.png, docs/cost.md, docs/cost_peers.csv, docs/cost_mean.svg and
# docs/cost.png; names what is missing and goes on
# (numpy, the data, the programs of others). --full: effort thorough as well, some minutes more.
# Ends with 1 where a demand is not met.
set -eu
LC_ALL=C
export LC_ALL
cd "$(dirname "$0")/.."
. scripts/need.sh

need_rust
need python3 python3
cargo build --release --locked --bin morula
morula=${CARGO_TARGET_DIR:-target}/release/morula

"$morula" compare sample:stone,seed=7 --methods best -n 10,30,100 --scale 5 --size 1200x350 -q -o docs/stone.png

# The evaluator wants numpy: the peers' interpreter has it as well.
python=python3
peers=${MORULA_PEER_PYTHON:-}
if [ -n "$peers" ] && ! python3 -c 'import numpy' 2>/dev/null && "$peers" -c 'import numpy' 2>/dev/null; then
    python=$peers
fi
cost_peers=
case " $* " in *" --no-peers "*) cost_peers=--no-peers ;; esac
python3 scripts/cost.py "$morula" $cost_peers
"$python" scripts/figures.py "$morula" "$@"
