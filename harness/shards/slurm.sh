#!/usr/bin/env bash
# Gives the shards of a plan to Slurm: a task of a job array does a shard, and a last job joins the results.
#
#   ./slurm.sh [LIST] [options of sbatch...]
#
# LIST, such as 3,17-19, names shards; without one, all are submitted. A shard that is done is left as it is, and one that
# was stopped goes on where it was. Options such as --partition, --account and --constraint are handed to sbatch for every
# job; its variables SBATCH_... count as usual. Every node must see the plan's folder and the program by the same path.

# Slurm reads the lines below. It puts a task back into the queue if its node fails, and it tells the script a minute
# before the time limit, so that the shard can stop where nothing is lost.
#SBATCH --nodes=1 --ntasks=1
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@60
set -euo pipefail

say() { printf 'slurm.sh: %s\n' "$*" >&2; }
fail() {
  say "$*"
  exit 2
}

# attend COMMAND...: runs it and hands SIGTERM on to it, because Slurm sends the early one to this script alone.
attend() {
  local child='' told=yes status=0
  trap 'told=yes; if [[ -n $child ]]; then kill -TERM "$child" 2>/dev/null || true; fi' TERM
  "$@" &
  child=$!
  # A signal ends `wait` before the command has ended.
  while [[ -n $told ]]; do
    told=''
    status=0
    wait "$child" || status=$?
  done
  return "$status"
}

# job FOLDER OFFSET|merge: what a job runs. A task does the shard OFFSET + its index, because indices are limited.
job() {
  [[ -r $1/plan.sh ]] || fail "$(hostname) does not see $1; expected the plan in a folder that all nodes share"
  # shellcheck source=/dev/null
  source "$1/plan.sh"
  [[ -x $PROGRAM ]] || fail "$(hostname) does not see $PROGRAM; expected the program in a folder that all nodes share"
  if [[ $2 == merge ]]; then
    attend "$PROGRAM" shards merge "$PLAN" --out "$PLAN/results"
    return
  fi
  local log status=0
  log=$(readlink -f "/proc/$$/fd/1") || log=''
  if [[ -f $log ]]; then export TOUCHSTONE_LOG=$log; fi
  attend "$PROGRAM" run --plan "$PLAN" --shard $(($2 + SLURM_ARRAY_TASK_ID)) || status=$?
  # The shard is done and has found something wrong, which the merge tells.
  if ((status == 1)); then status=0; fi
  return "$status"
}

if [[ ${1:-} == --job ]]; then
  status=0
  job "$2" "$3" || status=$?
  exit "$status"
fi

here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
[[ -r $here/plan.sh ]] || fail "there is no plan.sh beside it; expected the copy of this script that \`touchstone shards plan\` made"
# shellcheck source=/dev/null
source "$here/plan.sh"
[[ $PLAN -ef $here ]] || fail "the plan was made in $PLAN; expected it there, and not in $here"
case ${1:-} in
  -h | --help)
    sed -n '2,/^$/s/^# \{0,1\}//p' "$here/slurm.sh"
    exit 0
    ;;
esac
command -v sbatch >/dev/null || fail "sbatch is not here; expected a machine from which jobs are submitted to Slurm"

list=0-$((SHARDS - 1))
if [[ ${1:-} == [0-9]* ]]; then
  list=$1
  shift
fi
[[ $list =~ ^[0-9]+(-[0-9]+)?(,[0-9]+(-[0-9]+)?)*$ ]] || fail "'$list' is no list of shards; expected one such as 3,17-19"
for option in "$@"; do
  case $option in
    -a* | --array*) fail "$option is this script's own option; expected a list of shards, such as 3,17-19" ;;
    --wrap* | --parsable*) fail "$option is this script's own option" ;;
  esac
done

most=$(scontrol show config | awk '$1 == "MaxArraySize" { print $3 }') || fail "Slurm's controller does not answer; see above"
[[ $most =~ ^[1-9][0-9]*$ ]] || fail "MaxArraySize of \`scontrol show config\` is '$most'; expected job arrays"

# Cuts the list into arrays whose indices are below the most that Slurm allows: an offset is a multiple of that.
indices=()
parts=()
for range in ${list//,/ }; do
  first=$((10#${range%-*}))
  last=$((10#${range#*-}))
  ((first <= last && last < SHARDS)) || fail "$range is no range of shards; the plan has the shards 0-$((SHARDS - 1))"
  while ((first <= last)); do
    part=$((first / most))
    end=$((last < (part + 1) * most ? last : (part + 1) * most - 1))
    indices[part]+=${indices[part]:+,}$((first - part * most))-$((end - part * most))
    parts[part]+=${parts[part]:+,}$first-$end
    first=$((end + 1))
  done
done

defaults=()
# by_default VARIABLE OPTION: an option that a variable of sbatch replaces.
by_default() { if [[ -z ${!1:-} ]]; then defaults+=("$2"); fi; }
by_default SBATCH_JOB_NAME "--job-name=$NAME"
mkdir -p "$PLAN/logs"
by_default SBATCH_OUTPUT "--output=$PLAN/logs/slurm-%A_%a.log"
by_default SBATCH_TIMELIMIT "--time=$MINUTES"
if [[ -n $CPUS ]]; then
  defaults+=("--cpus-per-task=$CPUS")
else
  by_default SBATCH_EXCLUSIVE --exclusive
fi

jobs=()
refused=''
for part in "${!indices[@]}"; do
  if [[ -z $refused ]] && job=$(sbatch "${defaults[@]}" "$@" --parsable --array="${indices[part]}" \
                                  "$PLAN/slurm.sh" --job "$PLAN" $((part * most))); then
    jobs+=("${job%%;*}")
    echo "shards ${parts[part]}: job ${job%%;*}"
  else
    refused+=${refused:+,}${parts[part]}
  fi
done

if [[ -n $refused ]]; then
  printf -v options ' %q' "$@"
  say "Slurm refused the shards $refused; its reason is above. To submit them later, when there is room:"
  say "  $(printf '%q' "$PLAN/slurm.sh") $refused${*:+$options}"
  say "A part of this list will do too. When all shards are done: $(printf '%q shards merge %q' "$PROGRAM" "$PLAN")"
  exit 1
fi

# The results are joined after the tasks, whatever became of them: the merge tells which shards are missing.
by_merge=("--job-name=$NAME-merge" "--output=$PLAN/logs/merge-%j.log")
depends=afterany
for job in "${jobs[@]}"; do depends+=:$job; done
if ! job=$(sbatch "${by_merge[@]}" "$@" --parsable --dependency="$depends" "$PLAN/slurm.sh" --job "$PLAN" merge); then
  say "Slurm refused the job that joins the results; when all shards are done, run:"
  say "  $(printf '%q shards merge %q' "$PROGRAM" "$PLAN")"
  exit 1
fi
echo "results:  job ${job%%;*}, in $PLAN/results; what it says is in $PLAN/logs/merge-${job%%;*}.log"
echo "progress: $(printf '%q shards status %q' "$PROGRAM" "$PLAN")"
