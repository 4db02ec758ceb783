#!/usr/bin/env bash
# A sweep on a cluster with Slurm: one task a part, each part many combinations.
#
#   sbatch cases/cluster/slurm.sh
#   percoat merge out/study/part-*          # when all are done; -o says where
#
# A part that is killed, by its time limit or with its node, goes on where it ended when it is submitted again:
#   sbatch --array=3,7 cases/cluster/slurm.sh
#SBATCH --job-name=percoat
#SBATCH --array=1-8
#SBATCH --cpus-per-task=2
#SBATCH --mem=4G
#SBATCH --time=02:00:00
#SBATCH --requeue
set -euo pipefail

parts=${PARTS:-8}      # as many as in --array above, also when a few are submitted again
part=${SLURM_ARRAY_TASK_ID:?this is a job array: submit it with sbatch}
percoat=${PERCOAT:-percoat}

exec "$percoat" sweep fig2 \
    --set layers.0.thickness=0.05:2:25:log --set layers.0.shear_ratio=0.5,1,2,4 --set grid.points=128 \
    --shard "$part/$parts" --resume --threads "${SLURM_CPUS_PER_TASK:-1}" --no-pictures -o "out/study/part-$part"
