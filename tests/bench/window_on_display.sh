#!/bin/sh
# What the lab window costs on a display: CPU when nothing happens, and how long it takes to close
# in the middle of rendering. Needs Xvfb and xdotool.
#   tests/bench/window_on_display.sh [PROGRAM]
set -eu
program=$(realpath "${1:-build/check/quartet}")
folder=$(mktemp -d)
mkfifo "$folder/number"
Xvfb -displayfd 3 -screen 0 1600x1000x24 -nolisten tcp 3> "$folder/number" 2> /dev/null &
server=$!
trap 'kill "$server"; rm -rf "$folder"' EXIT
read -r number < "$folder/number"
export DISPLAY=":$number" WAYLAND_DISPLAY='' XDG_CONFIG_HOME="$folder" XDG_CACHE_HOME="$folder"

# User and system time of the window's process, in ticks.
ticks() { awk '{ print $14 + $15 }' "/proc/$process/stat"; }
milliseconds() { date +%s%3N; }

start_window() {
    "$program" "$@" --ui-scale 1 2> "$folder/log" &
    process=$!
    until window=$(xdotool search --onlyvisible --name Quartet 2> /dev/null) && [ -n "$window" ]; do
        kill -0 "$process" || { cat "$folder/log"; exit 1; }
        sleep 0.1
    done
    xdotool windowmove "$window" 0 0 windowfocus "$window"
}

start_window cornell-checker
sleep 4 # in the middle of the first fifteen passes
before=$(milliseconds)
xdotool key q
wait "$process"
echo "closing while rendering: $(($(milliseconds) - before)) ms (target: under 500)"

start_window cornell-checker
busy=1
while [ "$busy" -gt 0 ]; do # until the passes are done
    last=$(ticks)
    sleep 2
    now=$(ticks)
    busy=$(((now - last) / 20))
done
last=$(ticks)
sleep 10
now=$(ticks)
echo "idle: $(((now - last) * 100 / (10 * $(getconf CLK_TCK)))) % of a core (target: under 5)"
xdotool key q
wait "$process"
