// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/pinch_frame.h"

namespace fetexc {
namespace {

int sign_of(int v) { return (v > 0) - (v < 0); }

fetex::PinchmapTexel frame_texel(const CornerSides& s) {
    if (!s.active()) return {0, 0, s.nw != 0 ? 1.0 : -1.0, 0};
    // Towards the side 1, of which the sides are 0 and 1 here.
    return {static_cast<double>(sign_of(s.ne + s.se - s.nw - s.sw)),
            static_cast<double>(sign_of(s.sw + s.se - s.nw - s.ne)), 0, 0};
}

} // namespace

std::vector<fetex::PinchmapTexel> pinch_frame(const ZoneMask& mask) {
    std::vector<fetex::PinchmapTexel> out;
    out.reserve((std::size_t{mask.width} + 1) * (std::size_t{mask.height} + 1));
    for (std::uint32_t j = 0; j <= mask.height; ++j) {
        for (std::uint32_t i = 0; i <= mask.width; ++i)
            out.push_back(frame_texel(sides_around(mask, i, j)));
    }
    return out;
}

} // namespace fetexc
