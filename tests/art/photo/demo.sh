#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# An image with features at 16 pixels a texel, beside what bilinear filtering shows of it. FETEXC: the program.
set -euo pipefail
fetexc=${FETEXC:?the program to run}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=${1:-out/demo}
backend=${2:-osmesa}
mkdir -p "$out"

"$fetexc" compile --image "$here/still_life.png" --features "$here/still_life_edges.svg" -o "$out/still_life.fetex" -q
# 40 x 40 of the 192 x 128 pixels, from (84, 42): the leaf's stem, the orange's side, a corner of the box.
"$fetexc" render "$out/still_life.fetex" -o "$out/still_life_part.png" --view 0.4375,0.328125,0.208333333333,0.3125 --size 640 --backend "$backend" -q
python3 "$here/before_after.py" "$here/still_life.png" "$out/still_life_part.png" "$out/still_life_16x.png" 84 42 40 40
