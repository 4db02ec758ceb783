#!/usr/bin/env bash
# The same sweep with GNU parallel, on one machine or, with --sshlogin, on several that share their files.
#
#   cases/cluster/parallel.sh [PARTS]
#
# Whatever ends it, the same command goes on from there.
set -euo pipefail

parts=${1:-8}
percoat=${PERCOAT:-percoat}

status=0
parallel --halt never --joblog out-parallel.log \
    "$percoat" sweep fig2 \
    --set layers.0.thickness=0.05:2:25:log --set layers.0.shear_ratio=0.5,1,2,4 --set grid.points="${POINTS:-128}" \
    --shard "{}/$parts" --resume --threads 1 --quiet --no-pictures -o "out/study/part-{}" \
    ::: $(seq "$parts") || status=$?
((status == 0)) || echo "$status parts ended with an error, see out-parallel.log; what they have done is joined" >&2
"$percoat" merge out/study/part-* -o out/study
