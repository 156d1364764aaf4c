#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What `./dev demo` shows: the hero drawing as a texture, close up, beside an ordinary texture of the same bytes. FETEXC: the program.
set -euo pipefail
fetexc=${FETEXC:?the program to run}
art=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=${1:-out/demo}
backend=${2:-osmesa}
mkdir -p "$out"

"$fetexc" compile "$art/lighthouse.svg" -o "$out/lighthouse.fetex" --size 256 --report text

# The keyhole lies at (571, 553.5) of 800; a view of w texels of 256 has 768 pixels: 48 texels at 16x, 3 at 256x.
"$fetexc" render "$out/lighthouse.fetex" -o "$out/lighthouse_1x.png" --size 256 --beside bilinear --backend "$backend"
"$fetexc" render "$out/lighthouse.fetex" -o "$out/lighthouse_16x.png" --view 0.62,0.5625,0.1875,0.1875 --size 768 --beside bilinear --backend "$backend" -q
"$fetexc" render "$out/lighthouse.fetex" -o "$out/lighthouse_256x.png" --view 0.708,0.686,0.01171875,0.01171875 --size 768 --beside bilinear --backend "$backend" -q

cat <<TEXT

Look at these ($backend; left our texture, right an ordinary bilinear texture of the same bytes):
  $out/lighthouse_1x.png     one pixel a texel
  $out/lighthouse_16x.png    16 pixels a texel: the door
  $out/lighthouse_256x.png   256 pixels a texel: the keyhole in the lock plate of that door
TEXT
