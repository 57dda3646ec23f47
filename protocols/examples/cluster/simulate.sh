#!/bin/bash
#SBATCH --job-name=heft
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#
# Simulates participants on a Slurm cluster: an array of jobs, each with a shard of the participants,
# then a job that joins the shards to one log. On a login node, in the folder for the results:
#
#   bash simulate.sh
#
# Change the values below, or give others: PARTICIPANTS=100000 SHARDS=200 bash simulate.sh
# After a failure or a time limit the same command continues: no participant is simulated twice.
set -euo pipefail
here=$(dirname "$(realpath "$0")")

export HEFT=${HEFT:-heft}                               # the program
export PROTOCOL=${PROTOCOL:-$here/../../quick.toml}     # what is simulated
export RESPONDER=${RESPONDER:-simulated}                # NAME or NAME:FILE, as in heft simulate
export PARTICIPANTS=${PARTICIPANTS:-1000}               # of all shards together
export SHARDS=${SHARDS:-10}                             # jobs of the array
export SEED=${SEED:-1}
export FOLDER=${FOLDER:-$PWD/simulation}                # on a disk that all nodes share

case ${1:-submit} in
  submit)
    mkdir -p "$FOLDER"
    array=$(sbatch --parsable --array="1-$SHARDS" --output="$FOLDER/shard-%a.txt" "$0" shard)
    merge=$(sbatch --parsable --dependency="afterok:${array%;*}" --kill-on-invalid-dep=yes \
      --output="$FOLDER/merge.txt" "$0" merge)
    echo "array ${array%;*}, merge ${merge%;*}; the result will be $FOLDER/all.db"
    ;;
  shard)
    exec "$HEFT" simulate "$PROTOCOL" --responder "$RESPONDER" --participants "$PARTICIPANTS" \
      --seed "$SEED" --shard "$SLURM_ARRAY_TASK_ID/$SHARDS" --jobs "$SLURM_CPUS_PER_TASK" \
      --db "$FOLDER/shard-$SLURM_ARRAY_TASK_ID.db"
    ;;
  merge)
    shards=()
    for ((i = 1; i <= SHARDS; i++)); do shards+=("$FOLDER/shard-$i.db"); done
    exec "$HEFT" merge "$FOLDER/all.db" "${shards[@]}"
    ;;
esac
