#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Tiles on a real Slurm: slurm_demo.sh [GABLE] [BUILDINGS], as root. Starts a controller and two nodes on
# this machine, submits a plan to them, and does what happens to clusters: a node dies, a process is
# killed, the disk fills up, a tile is damaged. The result must be that of one process, byte for byte.
# Installs Slurm and munge where they are missing. Not part of ./test, which tests the same without
# Slurm (tests/cli/tiles_test.py).
set -euo pipefail
cd "$(dirname "$0")/.."
gable=$(realpath "${1:-build/release/gable}")
count=${2:-60000}
home=$(mktemp -d /tmp/gable-slurm.XXXXXX)
say() { printf '%6s s  %s\n' "$SECONDS" "$*"; }

install() {
  local missing=()
  for package in slurmctld slurmd slurm-client munge gdal-bin; do
    dpkg -s "$package" >/dev/null 2>&1 || missing+=("$package")
  done
  [ ${#missing[@]} = 0 ] || apt-get install -y --no-install-recommends "${missing[@]}" >/dev/null
}

pids=()
finish() {
  scancel --quiet --user root 2>/dev/null || true
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  sleep 1
  umount "$home/small" 2>/dev/null || true
  [ -n "${GABLE_KEEP:-}" ] || rm -rf "$home"
}
trap finish EXIT

start_node() {
  slurmd -D -f "$SLURM_CONF" -N "$1" >>"$home/slurmd-$1.log" 2>&1 &
  pids+=($!)
  echo $! >"$home/$1.pid"
}

start_slurm() {
  export SLURM_CONF=$home/slurm.conf
  mkdir -p "$home"/{state,spool-n1,spool-n2,munge}
  dd if=/dev/urandom of="$home/munge/key" bs=128 count=1 2>/dev/null
  chown -R munge: "$home/munge"
  chmod 755 "$home"
  chmod 700 "$home/munge"
  chmod 400 "$home/munge/key"
  mkdir -p /run/munge
  chown munge: /run/munge
  local socket=/run/munge/gable.socket
  runuser -u munge -- munged --force --foreground --key-file="$home/munge/key" --socket=$socket \
    --pid-file="$home/munge/pid" --seed-file="$home/munge/seed" --log-file="$home/munge/log" 2>/dev/null &
  pids+=($!)
  cat >"$SLURM_CONF" <<TEXT
ClusterName=gable
SlurmctldHost=$(hostname -s)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation=$home/state
SlurmdSpoolDir=$home/spool-%n
SlurmctldPidFile=$home/ctld.pid
SlurmdPidFile=$home/slurmd-%n.pid
SlurmctldPort=16817
SlurmctldTimeout=10
SlurmdTimeout=10
InactiveLimit=0
KillWait=5
CompleteWait=0
MinJobAge=600
ReturnToService=2
JobRequeue=1
SchedulerParameters=bf_interval=2,sched_interval=2
MaxArraySize=1001
NodeName=n1 NodeHostname=$(hostname -s) Port=16818 CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$(hostname -s) Port=16819 CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
TEXT
  sleep 1
  slurmctld -D -c -f "$SLURM_CONF" >"$home/slurmctld.log" 2>&1 &
  pids+=($!)
  start_node n1
  start_node n2
  for _ in $(seq 60); do
    [ "$(sinfo -h -o %t -t idle -N 2>/dev/null | wc -l)" = 2 ] && return
    sleep 0.5
  done
  sinfo || true
  tail -n 5 "$home"/slurm*.log >&2
  say "Slurm does not come up" && exit 1
}

running() { squeue -h -n gable-tiles -t R -o %N 2>/dev/null | grep -c . || true; }
left() { squeue -h 2>/dev/null | grep -c . || true; }
await() { # SECONDS WHAT COMMAND...
  local until=$((SECONDS + $1)) what=$2
  shift 2
  until "$@"; do
    [ $SECONDS -lt $until ] || { say "waited in vain: $what" && squeue && tail -n 20 "$home/many/plan/logs/"* && exit 1; }
    sleep 0.5
  done
}
done_parts() { [ "$(find "$1/plan/done" -name '*.part' 2>/dev/null | wc -l)" -ge "$2" ]; }
is_running() { [ "$(running)" -ge 2 ]; }
is_over() { [ "$(left)" = 0 ]; }
# The daemon of a node and all that it has started: the watcher of each job, its script, our program.
kill_node() {
  local pid script
  kill -9 "$(cat "$home/$1.pid")"
  for pid in $(pgrep -f "^$gable tiles job $home"); do
    grep -qz "SLURMD_NODENAME=$1" "/proc/$pid/environ" 2>/dev/null || continue
    script=$(ps -o ppid= -p "$pid" | tr -d ' ')
    kill -9 "$(ps -o ppid= -p "$script" | tr -d ' ')" "$script" "$pid" 2>/dev/null || true
  done
}
is_down() { sinfo -h -N -n n2 -o %t 2>/dev/null | grep -q down; }
plan() { "$gable" tiles plan bench/million.cga --shapes "$home/map/$count.geojson" --job-shapes 4096 -o "$1"; }
same() { # FOLDER
  diff -r "$home/one" "$1" >"$home/diff" || { head "$home/diff" && say "$1 differs" && exit 1; }
  say "the same $(find "$1" -type f | wc -l) files, byte for byte"
}

install
start_slurm
say "Slurm $(sinfo --version | cut -d' ' -f2) runs with the nodes $(sinfo -h -N -o %N | tr '\n' ' ')"
mkdir "$home/map"
python3 -c "
import sys
from pathlib import Path
sys.path.insert(0, 'bench')
import million
million.write_map(Path(sys.argv[1]), int(sys.argv[2]))" "$home/map/$count.geojson" "$count"
"$gable" tiles bench/million.cga --shapes "$home/map/$count.geojson" -o "$home/one"
say "one process has made the tiles of $count buildings"

plan "$home/many"
"$gable" tiles submit "$home/many" --slurm
await 60 "two tasks that run" is_running
kill_node n2
say "node n2 is dead, with what ran on it"
sleep 1
victim=$(pgrep -f "^$gable tiles job $home/many" | head -n 1 || true)
[ -z "$victim" ] || kill -9 "$victim"
say "a process is killed on node n1"
await 120 "a finished unit" done_parts "$home/many" 2
tile=$(find "$home/many/tiles" -name '*.glb' | sort | head -n 1)
printf 'x' | dd of="$tile" bs=1 seek=1000 conv=notrunc 2>/dev/null
say "a tile is damaged: ${tile#"$home/"}"
await 120 "the controller to miss n2" is_down
say "Slurm has given n2 up and queued its job again: $(squeue -h -n gable-tiles -o '%i %r' | head -n 3 | tr '\n' ',')"
start_node n2
say "node n2 is back"
await 600 "the end" is_over
same "$home/many"

# A disk that has no room for all, and gets it while tasks fail.
size=$(du -sk "$home/one" | cut -f1)
mkdir "$home/small"
mount -t tmpfs -o "size=$((size * 3 / 4))k" tmpfs "$home/small"
plan "$home/small/many"
"$gable" tiles submit "$home/small/many" --slurm
failed() { grep -lq "file-unwritable" "$home/small/many/plan/logs/"*.txt 2>/dev/null; }
await 300 "a full disk" failed
say "the disk is full: $(grep -h file-unwritable "$home/small/many/plan/logs/"*.txt | head -n 1 | cut -c1-100)"
mount -o "remount,size=$((size * 4))k" "$home/small"
await 600 "the end" is_over
same "$home/small/many"
say "done"
