#!/usr/bin/env bash
# The present tree beside another commit (the one before, unless named), in one run: `benches/quick.sh [COMMIT] [ROUNDS]`.
# Both programs are built, then short cases run by turns; printed is the ratio of the medians of their wall times.
# Above 1 the present tree is slower. Whoever else uses the machine disturbs both alike, but not evenly: repeat.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

commit=$(git rev-parse --short "${1:-HEAD^}")
rounds=${2:-7}
target=${CARGO_TARGET_DIR:-$PWD/target}
place=$(mktemp -d)
trap 'git worktree remove --force "$place/tree" 2>/dev/null || true; rm -rf "$place"' EXIT

git worktree add --quiet --detach "$place/tree" "$commit"
cargo build --release --locked --bin percoat --target-dir "$target"
(cd "$place/tree" && cargo build --release --locked --bin percoat --target-dir "$target/before")
now=$target/release/percoat
before=$target/before/release/percoat

cases=(
    "fig2 --set grid.points=512"
    "fig2 --set grid.points=1024"
    "fig2 --set grid.points=512 --set load.mean_pressure={from=0.003,to=0.06,steps=20}"
    "fig6b --set grid.points=512"
)

# Milliseconds of one run, at the end of a file.
run() {
    local file=$1 started ended
    shift
    started=$(date +%s%N)
    "$@" --quiet --no-pictures --output "$place/out" || [[ $? == 3 ]]
    ended=$(date +%s%N)
    echo $(((ended - started) / 1000000)) >>"$file"
}

median() { sort -n "$1" | awk '{ x[NR] = $1 } END { print (x[int((NR + 1) / 2)] + x[int(NR / 2) + 1]) / 2 }'; }

echo "present tree against $commit, $rounds rounds"
for case in "${cases[@]}"; do
    read -ra arguments <<<"$case"
    rm -f "$place"/{now,before,warm}
    for program in "$now" "$before"; do run "$place/warm" "$program" solve "${arguments[@]}"; done
    for ((round = 0; round < rounds; round++)); do
        run "$place/now" "$now" solve "${arguments[@]}"
        run "$place/before" "$before" solve "${arguments[@]}"
    done
    awk -v a="$(median "$place/now")" -v b="$(median "$place/before")" -v name="$case" \
        'BEGIN { printf "%6.3f  %6.0f ms, before %6.0f ms  %s\n", a / b, a, b, name }'
done
