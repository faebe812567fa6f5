#!/usr/bin/env bash
# Does the shards of a plan on this machine, or on some that ssh reaches, by GNU parallel, and joins the results.
#
#   ./parallel.sh [LIST] [options of parallel...]
#
# LIST, such as 3,17-19, names shards; without one, all are done. A shard that was stopped goes on where it was. Options
# such as --sshloginfile FILE and --eta are handed to parallel. A machine does one shard at a time, because two would
# disturb each other's measurements. Every machine must see the plan's folder and the program by the same path, and
# machines that do not answer are left out.

set -euo pipefail

say() { printf 'parallel.sh: %s\n' "$*" >&2; }
fail() {
  say "$*"
  exit 2
}

# shard FOLDER NUMBER: what parallel runs, here or on another machine.
shard() {
  [[ -r $1/plan.sh ]] || fail "$(hostname) does not see $1; expected the plan in a folder that all machines share"
  # shellcheck source=/dev/null
  source "$1/plan.sh"
  [[ -x $PROGRAM ]] || fail "$(hostname) does not see $PROGRAM; expected the program in a folder that all machines share"
  local status=0
  export TOUCHSTONE_LOG=$PLAN/logs/parallel-$2.log
  # Parallel sends SIGTERM to the program too. The script stays until the program has ended.
  trap : TERM
  "$PROGRAM" run --plan "$PLAN" --shard "$2" >>"$TOUCHSTONE_LOG" 2>&1 || status=$?
  # The shard is done and has found something wrong, which the merge tells.
  if ((status == 1)); then status=0; fi
  if ((status == 0)); then
    echo "shard $2 is done"
  else
    say "shard $2 is not done, status $status on $(hostname); its output is in $TOUCHSTONE_LOG"
  fi
  return "$status"
}

if [[ ${1:-} == --shard ]]; then
  status=0
  shard "$2" "$3" || status=$?
  exit "$status"
fi

here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
case ${1:-} in
  -h | --help)
    sed -n '2,/^$/s/^# \{0,1\}//p' "$here/parallel.sh"
    exit 0
    ;;
esac
[[ -r $here/plan.sh ]] || fail "there is no plan.sh beside it; expected the copy of this script that \`touchstone shards plan\` made"
# shellcheck source=/dev/null
source "$here/plan.sh"
[[ $PLAN -ef $here ]] || fail "the plan was made in $PLAN; expected it there, and not in $here"
command -v parallel >/dev/null || fail "GNU parallel is not installed (Debian: parallel); without it, a shard is done by:
  $(printf '%q run --plan %q' "$PROGRAM" "$PLAN") --shard 0"
[[ $(parallel --version 2>/dev/null) == GNU* ]] || fail "this \`parallel\` is another than GNU parallel (Debian: parallel)"
mkdir -p "$PLAN/logs"

options=()
list=0-$((SHARDS - 1))
if [[ ${1:-} == [0-9]* ]]; then
  list=$1
  shift
else
  # The log tells which shards are done. It counts them by their place in the list, which is the same each time.
  log=$PLAN/parallel.joblog
  options+=("--joblog=$log" --resume-failed)
  # A line that was cut off would be an error.
  if [[ -s $log && -n $(tail -c 1 "$log") ]]; then sed -i '$d' "$log"; fi
fi
[[ $list =~ ^[0-9]+(-[0-9]+)?(,[0-9]+(-[0-9]+)?)*$ ]] || fail "'$list' is no list of shards; expected one such as 3,17-19"
for range in ${list//,/ }; do
  ((10#${range%-*} <= 10#${range#*-} && 10#${range#*-} < SHARDS)) ||
    fail "$range is no range of shards; the plan has the shards 0-$((SHARDS - 1))"
done
for option in "$@"; do
  case $option in
    -S* | --sshlogin* | --slf*) options+=(--filter-hosts) ;;
  esac
done

# Otherwise parallel takes the shell that SHELL names on each machine, which a service may not have set.
export PARALLEL_SHELL=$BASH
# The last number of jobs counts. A shard that is told to stop has a minute for that.
printf -v command '%q ' bash "$PLAN/parallel.sh" --shard "$PLAN"
status=0
for range in ${list//,/ }; do seq "$((10#${range%-*}))" "$((10#${range#*-}))"; done |
  parallel "${options[@]}" --termseq TERM,60000,KILL,1000 "$@" --jobs 1 "$command{}" || status=$?
((status <= 101)) || fail "parallel itself failed, status $status; its reason is above"

# The merge tells what is missing, if something is.
status=0
"$PROGRAM" shards merge "$PLAN" --out "$PLAN/results" || status=$?
if ((status == 2)); then
  say "if shards are missing: $(printf '%q' "$PLAN/parallel.sh") takes their list too, and without it does all but those that it did"
fi
exit "$status"
