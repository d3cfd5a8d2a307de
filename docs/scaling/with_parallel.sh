#!/bin/sh
# Does a study in parts, as many at a time as the machine has cores, and joins them.
# Usage: with_parallel.sh PARTS DIR STUDY [FLAG ...]; repeated after an interruption it goes on.
set -eu
parts=$1
dir=$2
shift 2
seq "$parts" | parallel -q --halt soon,fail=1 ninebit study "$@" -o "$dir" --shard "{}/$parts" --threads 1 --quiet
ninebit study merge "$dir"/part-*-of-"$parts".jsonl -o "$dir"
