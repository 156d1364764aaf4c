#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Pinchmaps: what one is made of over what it shows, beside a bitmap of eight times the bytes; and a normal map with creases,
# lit, beside an ordinary one of the same bytes. FETEXC: the program.
set -euo pipefail
fetexc=${FETEXC:?the program to run}
art=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=${1:-out/demo}
backend=${2:-osmesa}
mkdir -p "$out"

"$fetexc" compile "$art/alternatives/glyph_g.svg" -o "$out/glyph_g.fetex" --repr pinchmap --size 32 -q
# 128 x 128 texels of an ordinary texture; a part of 10 x 10 clusters.
"$fetexc" compile "$art/alternatives/glyph_g.svg" -o "$out/glyph_g_128.fetex" --size 256 -q
"$fetexc" render "$out/glyph_g_128.fetex" -o "$out/glyph_g_128.png" --size 128 --supersample 16 --backend "$backend" -q
part=0.46875,0.4375,0.3125,0.3125
"$fetexc" render "$out/glyph_g.fetex" -o "$out/glyph_g_overlay.png" --view $part --size 360 --overlay --backend "$backend" -q
python3 "$art/photo/before_after.py" "$out/glyph_g_128.png" "$out/glyph_g_overlay.png" "$out/pinchmap_glyph.png" 60 56 40 40

"$fetexc" compile --image "$art/normals/hood.png" --data --features "$art/normals/hood_creases.svg" -o "$out/hood.fetex" --repr pinchmap --size 32 --samples rgb8 -q
"$fetexc" render "$out/hood.fetex" -o "$out/hood_lit.png" --light=-1,-2,2 --size 360 --beside bilinear --backend "$backend" -q
