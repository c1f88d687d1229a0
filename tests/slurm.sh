#!/usr/bin/env bash
# The graph on Slurm: a cluster of one node on the loopback device, made here, runs a study through srun; its files are those of a
# local run, bit by bit, also after a launcher has failed midway. Everything that is started here is stopped here.
#
# Run by `make test-slurm`, which sets SLURM=run; `make test` names it as skipped.
source tests/cases
if [ "${SLURM:-}" != run ]; then
  echo "skipped: a study on a Slurm cluster of one node (make deps-slurm test-slurm runs it)"
  exit 0
fi
for program in munged slurmctld slurmd srun salloc scontrol; do
  command -v $program > /dev/null || { echo "skipped: a study on a Slurm cluster of one node: $program is not installed (make deps-slurm)"; exit 0; }
done

base=$(mktemp -d)
chmod 755 "$base"
started=()
stop() {
  scancel --state=RUNNING --user="$(id -un)" 2> /dev/null
  for ((i = ${#started[@]} - 1; i >= 0; i--)); do kill "${started[i]}" 2> /dev/null && wait "${started[i]}" 2> /dev/null; done
  rm -rf "$base"
}
trap stop EXIT

# --- a cluster of one node: its own key, sockets, ports and folders; no cgroups, no systemd
node=$(hostname -s)
free_port() { for port in $(seq "$1" $(($1 + 200))); do (: < "/dev/tcp/127.0.0.1/$port") 2> /dev/null || { echo "$port"; return; }; done; }
mkdir -p "$base"/{state,spool,run}
(umask 077; head -c 128 /dev/urandom > "$base/munge.key")
cat > "$base/slurm.conf" <<CONF
ClusterName=whine
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$(free_port 16817)
SlurmdPort=$(free_port 17818)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$base/run/munge.socket
CredType=cred/munge
StateSaveLocation=$base/state
SlurmdSpoolDir=$base/spool
SlurmctldPidFile=$base/run/slurmctld.pid
SlurmdPidFile=$base/run/slurmd.pid
SlurmctldLogFile=$base/slurmctld.log
SlurmdLogFile=$base/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
KillWait=1
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SlurmdParameters=config_overrides
NodeName=$node NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$base/slurm.conf
munged --foreground --force --key-file="$base/munge.key" --socket="$base/run/munge.socket" --pid-file="$base/run/munged.pid" \
  --log-file="$base/munged.log" --seed-file="$base/munged.seed" > "$base/munged.out" 2>&1 &
started+=($!)
for _ in $(seq 100); do [ ! -S "$base/run/munge.socket" ] || break; sleep 0.1; done
slurmctld -D -f "$SLURM_CONF" > "$base/slurmctld.out" 2>&1 &
started+=($!)
slurmd -D -f "$SLURM_CONF" > "$base/slurmd.out" 2>&1 &
started+=($!)
node_is() { for _ in $(seq 300); do sinfo -h -o %T 2> /dev/null | grep -q -E "^($1)" && return; sleep 0.1; done; return 1; }
if node_is idle; then ok "munged, slurmctld and slurmd run a cluster of one node on the loopback device"; else
  wrong "a cluster of one node" "$(tail -qn 2 "$base"/*.log "$base"/*.out | tr '\n' ' ')"
  exit 1
fi

# --- a tree of its own with the real programs, a coarse scene, and a study of it with two bodies
tree=$base/tree log=$base/log
mkdir -p "$tree/$B"
cp -a Makefile pipelines common tools tests data "$tree"
cp -a "$B/bin" "$B/id" "$B/settings" "$tree/$B"
cd "$tree" || exit 1
cat > own.toml <<'STUDY'
scene = "data/scenes/parker2000.toml"
stage = "sweep"
[set]
"discretisation.element_mm" = 1.5
"discretisation.element_order" = 1
"discretisation.positions" = 32
"discretisation.steps_per_period" = 32
"discretisation.min_sample_rate_kHz" = 50
"fidelity.modes" = 5
"operation.mesh_frequency_Hz" = { from = 2000, to = 2200, step = 100 }
[[vary]]
key = "bore_radius_mm"
values = [38, 40]
[[vary]]
key = "operation.torque_Nm"
values = [100, 150, 200]
STUDY
make_() { make $sanitize -j2 STUDY=own.toml "$@" > "$log" 2>&1; }
contents() { find out -type f -name '*.h5' -print0 | sort -z | xargs -0 -r sha256sum; }
if ! make_ study; then wrong "the study runs here" "$(grep -m1 -E 'error|\*\*\*' "$log")"; exit 1; fi
expected=$(contents)
[ "$(grep -c '/variants/' <<< "$expected")" = 6 ] && [ "$(grep -c 'body.h5' <<< "$expected")" = 2 ] || wrong "the study has 6 variants and 2 bodies" "$expected"
parts() { find out -name '*.tmp.*'; }
# same <claim>: what is there now is what the local run has made
same() {
  local found
  found=$(contents)
  if [ "$found" != "$expected" ]; then wrong "$1" "other files: $(diff <(echo "$expected") <(echo "$found") | head -n 3 | tr '\n' ' ')"
  elif [ -n "$(parts)" ]; then wrong "$1" "left: $(parts | head -n 1)"
  else ok "$1"; fi
}
# broken <claim> <pattern in the log>: the make before has failed, said so, and left no part of a file
broken() {
  local status=$?
  if [ $status = 0 ]; then wrong "$1" "make ended with status 0"
  elif ! grep -q -E "$2" "$log"; then wrong "$1" "no '$2' in: $(tail -n 3 "$log" | tr '\n' ' ')"
  elif contents | grep -v -x -F -f <(echo "$expected"); then wrong "$1" "a file is another one"
  else ok "$1"; fi
}

rm -rf out
if salloc -Q -n2 make $sanitize -j2 STUDY=own.toml LAUNCH='srun -n1 --exact -Q' study > "$log" 2>&1; then
  [ "$(grep -c '^srun -n1 --exact -Q .*/gear-' "$log")" = 10 ] && same "in an allocation srun carries 2 meshes, 2 reductions and 6 variants: the same bytes as here" ||
    wrong "srun carries every stage" "$(grep -c '^srun' "$log") stages"
else wrong "a study through srun" "$(tail -n 3 "$log" | tr '\n' ' ')"; fi
rm -rf out/studies
make_ LAUNCH='srun -n1 -Q' study && same "each stage as a job of its own: the same bytes" || wrong "each stage as a job" "$(tail -n 2 "$log")"

# --- launchers that fail midway
rm -rf out
make_ LAUNCH='srun -n1 -Q' LAUNCH_variant=false study
broken "a launcher that fails for one stage ends make, named by the stage's file" 'variants/.*\.h5.*Error 1'
[ "$(contents | grep -c body.h5)" = 2 ] && ok "what other stages have made stays" || wrong "what other stages have made stays" "$(contents)"
make_ LAUNCH_variant=true LAUNCH_WAIT=1 study
broken "a launcher that ends well without having run anything is found out" "the launcher 'true' has ended, but its result is not there"
make_ LAUNCH='srun -n1 -Q' study && same "the next make goes on and ends with the same bytes" || wrong "the next make" "$(tail -n 2 "$log")"

# Programs that take their time, so that something can happen to them.
cat > slowly <<'LAUNCHER'
#!/bin/sh
echo $$ >> sruns
exec srun -n1 -Q sh -c 'sleep 5; exec "$@"' sh "$@"
LAUNCHER
chmod +x slowly
running() { for _ in $(seq 200); do [ "$(squeue -h -t RUNNING | wc -l)" -ge 1 ] && return; sleep 0.1; done; }
rm -rf out/studies
make_ LAUNCH="$PWD/slowly" study & job=$!
running; scancel --state=RUNNING --user="$(id -un)"; wait $job
broken "cancelled jobs end make" 'variants/.*\.h5.*Error'
rm -rf out/studies sruns
make_ LAUNCH="$PWD/slowly" study & job=$!
running; xargs kill -KILL < sruns 2> /dev/null; wait $job
broken "an srun that is killed ends make" 'variants/.*\.h5.*(Error|Killed)'
scancel --state=RUNNING --user="$(id -un)" 2> /dev/null; node_is idle
rm -rf out/studies
make_ LAUNCH="$PWD/slowly" study & job=$!
running; scontrol update nodename="$node" state=down reason=test; wait $job
broken "a node that goes down ends make" 'variants/.*\.h5.*Error'
scontrol update nodename="$node" state=resume 2> /dev/null
node_is idle
make_ LAUNCH='srun -n1 -Q' study && same "and when it is back, make goes on and ends with the same bytes" || wrong "make after a node was down" "$(tail -n 2 "$log")"
