// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/parts.h"

#include "compiler/bilevel/shown_parts.h"

namespace fetexc {

PartCounts count_parts(const Silhouette& silhouette, const fetex::BilevelTexture& texture, std::uint32_t per_texel,
                       unsigned threads) {
    const std::vector<OutlineSegment> outline = outline_in_texels(silhouette, texture.width, texture.height);
    const ScannedOutline scanned(silhouette, outline, texture.width, texture.height, per_texel);
    const PartJudge judge(scanned, outline, texture.height);
    const SilhouetteParts& wanted = judge.wanted();
    const Shown shown = judge.shown({texture.texels, texture.width, texture.height, texture.rule}, threads);
    const std::vector<PartExtent> lost = judge.lost(shown);
    PartCounts out{wanted.parts, lost.size() + wanted.unmet.size(), shown.invented.size()};
    const auto middle = [&](const PartExtent& e, double& u, double& v) {
        u = (e.from + e.to) / 2 / texture.width;
        v = (e.first_row + e.last_row + 1.0) / 2 / per_texel / texture.height;
    };
    if (!lost.empty()) {
        middle(lost[0], out.lost_u, out.lost_v);
    } else if (!wanted.unmet.empty()) {
        const OutlineSegment& s = outline[wanted.unmet[0]];
        out.lost_u = s.x0 / texture.width, out.lost_v = s.y0 / texture.height;
    }
    if (!shown.invented.empty()) middle(shown.invented[0], out.invented_u, out.invented_v);
    return out;
}

} // namespace fetexc
