#!/usr/bin/env bash
# A sweep under the launchers that people have gives the bytes of a sweep without any:
#   cluster.sh PROGRAM [parallel] [mpirun] [slurm]      without names all three
# GNU parallel, the real mpirun, and an array of jobs on a Slurm of one node, which is started here, with a
# munged, configuration and ports of its own, and ended again. Slurm wants root. Debian: parallel, openmpi-bin,
# slurmctld, slurmd, slurm-client, munge.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
program=$(realpath "$1")
shift
[[ $# -gt 0 ]] || set -- parallel mpirun slurm
work=$(mktemp -d /tmp/signorini-cluster.XXXXXX)
started=()  # processes of ours
finish() {
  for ((i = ${#started[@]} - 1; i >= 0; --i)); do
    kill "${started[i]}" 2>/dev/null || true
    wait "${started[i]}" 2>/dev/null || true
  done
  rm -rf "$work"
}
trap finish EXIT
chmod 755 "$work"
cd "$work"
cp "$here/../../models/belt.toml" .
sweep=("$program" sweep belt.toml --set run.engine=exact --vary 'contacts.belt.friction.static=1:2:0.05'
       --response residual:belt --no-plots --quiet)
"${sweep[@]}" -o alone

fail() { echo "cluster.sh: $*" >&2; exit 1; }

# Rows without what a clock says of them, in their order: a line has {"row":3, first.
rows() { sed -E 's/"wall_time":[^,]*,//; s/,"checksum":.*//' "$1"/rows.jsonl | sort -t : -k 2n; }

# compare NAME: the shares NAME-*, joined, are the sweep.
compare() {
  "$program" sweep --merge "$1"-*-of-* -o "$1" --no-plots --quiet || fail "$1: shares do not join"
  [[ $(wc -l <"$1"/rows.jsonl) == 21 ]] || fail "$1: rows are missing"
  cmp <(rows alone) <(rows "$1") || fail "$1: rows differ"
  echo "cluster.sh: $1: 21 rows in $(ls -d "$1"-*-of-* | wc -l) shares, the bytes of one sweep"
}

with_parallel() {
  parallel -j 2 "${sweep[@]@Q}" --share {}/3 -o parallel-{}-of-3 ::: 1 2 3
  compare parallel
}

with_mpirun() {
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  mkdir ranks
  ln -s ../belt.toml ranks/belt.toml
  (cd ranks && mpirun --oversubscribe -n 3 "${sweep[@]}" --share auto)
  for share in ranks/belt-sweep-*; do mv "$share" "mpirun-${share#ranks/belt-sweep-}"; done
  compare mpirun
}

# begin NAME COMMAND...: a process of ours, with its words in NAME.log.
begin() {
  "${@:2}" >"$1.log" 2>&1 &
  started+=($!)
}

# waiting WHAT COMMAND...: until the command succeeds.
waiting() {
  for ((i = 0; i < 300; ++i)); do
    "${@:2}" >/dev/null 2>&1 && return
    sleep 0.2
  done
  tail -n 5 ./*.log >&2
  fail "slurm: $1"
}

start_slurm() {
  mkdir -p node/state node/spool
  dd if=/dev/urandom of=node/key bs=32 count=1 status=none
  chmod 600 node/key
  begin munged munged --foreground --force --key-file="$work/node/key" --socket="$work/node/socket" \
    --pid-file="$work/node/munged.pid" --seed-file="$work/node/seed" --log-file="$work/node/munge.log"
  waiting "munged does not answer" munge -n -S "$work/node/socket"
  cat >node/slurm.conf <<END
ClusterName=one
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
AuthInfo=socket=$work/node/socket
CredType=cred/munge
StateSaveLocation=$work/node/state
SlurmdSpoolDir=$work/node/spool
SlurmctldPidFile=$work/node/slurmctld.pid
SlurmdPidFile=$work/node/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
  export SLURM_CONF=$work/node/slurm.conf
  begin slurmctld slurmctld -D
  waiting "slurmctld does not answer" scontrol ping
  begin slurmd slurmd -D
  waiting "no node is idle" bash -c 'sinfo -h -o %T | grep -qx idle'
}

with_slurm() {
  [[ $(id -u) -eq 0 ]] || fail "slurm: needs root"
  start_slurm
  mkdir array
  ln -s ../belt.toml array/belt.toml
  { echo '#!/bin/bash'; printf '%q ' "${sweep[@]}" --share auto; echo; } >job.sh
  sbatch --wait --quiet --array=1-3 --chdir="$work/array" --output="$work/job-%a.log" job.sh ||
    { tail -n 5 job-*.log >&2; fail "slurm: the jobs failed"; }
  for share in array/belt-sweep-*; do mv "$share" "slurm-${share#array/belt-sweep-}"; done
  compare slurm
}

for launcher in "$@"; do
  case "$launcher" in
    parallel | mpirun | slurm) "with_$launcher" ;;
    *) fail "no launcher is called '$launcher': parallel, mpirun, slurm" ;;
  esac
done
