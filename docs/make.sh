#!/usr/bin/env bash
# Makes the pictures of the README anew, with the commands that stand beside them there. Run it when
# what they show has changed. Four minutes on two cores; ./quartet builds first if it must.
set -euo pipefail
cd "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")"
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
quartet=$PWD/../quartet
docs=$PWD
cd "$work"

"$quartet" reference cornell-checker --size 480x270 --spp 512 -o ref.exr
"$quartet" screenshot cornell-checker --render-size 480x270 --passes 15 --size 1600x1000 \
  --reference ref.exr -o lab.png
"$quartet" figure cornell-checker --size 480x270 --out out
"$quartet" sweep cornell-checker --size 240x135 --thresholds 5 --seeds 3 --reference-spp 1024 \
  --out sweep
"$quartet" stability --out stability
"$quartet" needs cornell-checker --size 240x135 --out needs

mv lab.png "$docs/lab.png"
mv out/heatmaps.png "$docs/heatmaps.png"
mv sweep/sweep.png "$docs/sweep.png"
mv sweep/thresholds.png "$docs/thresholds.png"
mv stability/matrix.png "$docs/stability.png"
mv needs/needs.png "$docs/needs.png"
