// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/parts.h"

#include <algorithm>
#include <vector>

#include "compiler/bilevel/scan_lines.h"
#include "compiler/parallel.h"
#include "compiler/union_find.h"

namespace fetexc {
namespace {

struct Points {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> above; ///< row by row
};

std::uint32_t per_texel_for(const fetex::BilevelTexture& t) {
    const std::uint64_t texels = std::uint64_t{t.width} * t.height;
    return texels <= std::uint64_t{1} << 22 ? 4 : texels <= std::uint64_t{1} << 24 ? 2 : 1;
}

Points of_silhouette(const Silhouette& s, std::uint32_t width, std::uint32_t height, std::uint32_t per_texel) {
    const std::vector<OutlineSegment> outline = outline_in_texels(s, width, height);
    const ScannedOutline scanned(s, outline, width, height, per_texel);
    Points out{width * per_texel, height * per_texel, {}};
    out.above.resize(std::size_t{out.width} * out.height);
    for (std::uint32_t y = 0; y < out.height; ++y) {
        bool above = scanned.above_at_start(true, y);
        std::uint32_t x = 0;
        const auto fill_to = [&](double at) {
            for (; x < out.width && (x + 0.5) / per_texel < at; ++x)
                out.above[std::size_t{y} * out.width + x] = above ? 1 : 0;
        };
        for (const Crossing& c : scanned.rows().crossings(y)) {
            fill_to(c.at);
            above = c.enters;
        }
        fill_to(width);
    }
    return out;
}

Points of_texture(const fetex::BilevelTexture& t, std::uint32_t per_texel, unsigned threads) {
    Points out{t.width * per_texel, t.height * per_texel, {}};
    out.above.resize(std::size_t{out.width} * out.height);
    parallel_for(out.height, threads, [&](std::size_t y) {
        for (std::uint32_t x = 0; x < out.width; ++x) {
            const double t_at =
                fetex::bilevel_value(t, (x + 0.5) / per_texel, (static_cast<double>(y) + 0.5) / per_texel).t;
            out.above[y * out.width + x] = t_at > 0.5 ? 1 : 0;
        }
    });
    return out;
}

/// Parts of `of`, and those of which no point is alike in `other`.
std::pair<std::uint64_t, std::uint64_t> parts_unlike(const Points& of, const Points& other) {
    UnionFind sets(of.above.size());
    for (std::uint32_t y = 0; y < of.height; ++y) {
        for (std::uint32_t x = 0; x < of.width; ++x) {
            const std::uint32_t k = y * of.width + x;
            if (x > 0 && of.above[k] == of.above[k - 1]) sets.unite(k, k - 1);
            if (y > 0 && of.above[k] == of.above[k - of.width]) sets.unite(k, k - of.width);
        }
    }
    std::vector<std::uint8_t> alike(of.above.size(), 0);
    for (std::uint32_t k = 0; k < of.above.size(); ++k) {
        if (of.above[k] == other.above[k]) alike[sets.find(k)] = 1;
    }
    std::uint64_t parts = 0, unlike = 0;
    for (std::uint32_t k = 0; k < of.above.size(); ++k) {
        if (sets.find(k) != k) continue;
        ++parts, unlike += alike[k] == 0 ? 1 : 0;
    }
    return {parts, unlike};
}

} // namespace

PartCounts count_parts(const Silhouette& silhouette, const fetex::BilevelTexture& texture, unsigned threads) {
    const std::uint32_t per_texel = per_texel_for(texture);
    const Points wanted = of_silhouette(silhouette, texture.width, texture.height, per_texel);
    const Points drawn = of_texture(texture, per_texel, threads);
    const auto [parts, lost] = parts_unlike(wanted, drawn);
    return {parts, lost, parts_unlike(drawn, wanted).second};
}

} // namespace fetexc
