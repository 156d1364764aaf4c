#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A silhouette map with what it is made of drawn over it, beside an ordinary texture of the same bytes. FETEXC: the program.
set -euo pipefail
fetexc=${FETEXC:?the program to run}
art=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=${1:-out/demo}
backend=${2:-osmesa}
mkdir -p "$out"

"$fetexc" compile "$art/stop_sign.svg" -o "$out/stop_sign.fetex" --repr silmap --size 48 -q
# 10 x 10 of the 48 x 48 texels: the S and a part of the T.
"$fetexc" render "$out/stop_sign.fetex" -o "$out/stop_sign_overlay.png" --view 0.15,0.35,0.208333,0.208333 --size 640 --overlay --beside bilinear --backend "$backend" -q
