#!/usr/bin/env bash
# The same sweep with HyperQueue: a server and its workers run already (hq server start; hq worker start).
#
#   cases/cluster/hyperqueue.sh
#   percoat merge out/study/part-* -o out/study          # when `hq job wait last` says so
#
# A part whose worker is lost is started again and goes on where it ended.
set -euo pipefail

parts=8
percoat=${PERCOAT:-percoat}

hq submit --array "1-$parts" --cpus 2 --crash-limit 5 --name percoat -- \
    bash -c '"$0" sweep fig2 \
        --set layers.0.thickness=0.05:2:25:log --set layers.0.shear_ratio=0.5,1,2,4 --set grid.points=128 \
        --shard "$HQ_TASK_ID/$1" --resume --threads 2 --no-pictures -o "out/study/part-$HQ_TASK_ID"' "$percoat" "$parts"
