#!/usr/bin/env bash
# Iterations and convolutions of the default solver and of the baseline against the number of points.
# Prints the table of README.md; the finest grids take half a GiB and a few minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."
cargo build --release --quiet
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
loads=(fig2=0.06 fig3a=0.008 fig3b=0.008 fig4=0.01 fig5=0.08)
value() { grep -m1 "\"$1\":" "$out/summary.json" | sed 's/.*: *//; s/,.*//' ; }
run() { # method, points: iterations (convolutions) of each case
    printf '| %s | %s ' "$1" "$2"
    for load in "${loads[@]}"; do
        target/release/percoat solve "${load%=*}" --quiet --output "$out" --set "load.mean_pressure=${load#*=}" \
            --set "grid.points=$2" --set "solver.method=$1"
        printf '| %s (%.0f) ' "$(value iterations)" "$(value convolutions)"
    done
    printf '|\n'
}
for points in 128 256 512 1024 2048; do run preconditioned "$points"; done
for points in 128 256 512 1024; do run polonsky-keer "$points"; done
