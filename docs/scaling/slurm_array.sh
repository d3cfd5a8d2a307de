#!/bin/sh
# One part of a study, for sbatch --array=1-PARTS.
# Usage: sbatch --array=1-PARTS slurm_array.sh DIR STUDY [FLAG ...]
#SBATCH --job-name=ninebit
#SBATCH --cpus-per-task=1
#SBATCH --requeue
set -eu
dir=$1
shift
ninebit study "$@" -o "$dir" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --threads "$SLURM_CPUS_PER_TASK" \
  --quiet
