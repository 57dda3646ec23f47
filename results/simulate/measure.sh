#!/usr/bin/env bash
# How many simulated participants a minute: every shipped protocol, one job and two, side by side.
# Run from anywhere on an otherwise idle machine: results/simulate/measure.sh
# Writes speed.csv and speed.svg beside this file.
set -euo pipefail
cd "$(dirname "$0")/../.."
here=results/simulate
commit=$(git rev-parse --short HEAD)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
./heft --version >/dev/null # builds first, if need be

echo "protocol,jobs,participants,wall_s,participants_per_minute,ratio_to_one_job,commit,command" >"$here/speed.csv"
for protocol in quick sorting jnd paper recommended; do
  for jobs in 1 2; do
    n=26
    command="./heft simulate protocols/$protocol.toml --participants $n --jobs $jobs --seed 1 --db $protocol.db"
    said=$(./heft simulate "protocols/$protocol.toml" --participants $n --jobs $jobs --seed 1 \
      --db "$folder/$protocol-$jobs.db" 2>&1 | grep 'participants/min')
    wall=$(sed -E 's/.* in ([0-9.]+) s.*/\1/' <<<"$said")
    speed=$(sed -E 's|.*: ([0-9.]+) participants/min.*|\1|' <<<"$said")
    ((jobs == 1)) && single=$speed
    ratio=$(awk "BEGIN { printf \"%.2f\", $speed / $single }")
    echo "$protocol,$jobs,$n,$wall,$speed,$ratio,$commit,$command" >>"$here/speed.csv"
  done
done

gnuplot <<EOF
set terminal svg size 760,420 font "DejaVu Sans,13" background "white"
set output "$here/speed.svg"
set datafile separator ","
set title "Simulated participants a minute, seed 1, 26 participants"
set style data histograms
set style histogram clustered gap 1.5
set style fill solid 0.85 noborder
set boxwidth 0.9
set yrange [0:*]
set ylabel "participants a minute"
set grid y lc rgb "#e0e0e0"
set border 3
set tics nomirror
set key top right
set label 1 "Made by: results/simulate/measure.sh at commit $commit" at screen 0.01,0.03 font ",9" tc rgb "#777777"
set bmargin 4
plot "< awk -F, 'NR > 1 && \$2 == 1' $here/speed.csv" using 5:xtic(1) title "one job" lc rgb "#8a94a0", \
     "< awk -F, 'NR > 1 && \$2 == 2' $here/speed.csv" using 5 title "two jobs" lc rgb "#2f6db0"
EOF
cat "$here/speed.csv"
