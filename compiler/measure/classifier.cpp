// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/classifier.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/measure/edge_index.h"

namespace fetexc::measure {

double texel_side(const Truth& truth, const Picture& picture) {
    const GridSize texels = picture.texels();
    return std::max(1.0 / texels.width, truth.height() / texels.height);
}

Classifier::Classifier(const Truth& truth, double reach, double min_contrast)
    : truth_(truth), reach_(reach), min_contrast_(min_contrast) {
    side_ = std::max(reach / 2, std::max(1.0, truth.height()) / 512);
    columns_ = static_cast<std::size_t>(std::ceil(1 / side_));
    rows_ = static_cast<std::size_t>(std::ceil(truth.height() / side_));
    cells_.resize(columns_ * rows_);
    const std::span<const VisibleEdge> edges = truth.edges();
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const WidthBox box = box_of(edges[e]);
        const std::size_t x0 = index_of(box.x0 - reach, columns_), x1 = index_of(box.x1 + reach, columns_);
        const std::size_t y0 = index_of(box.y0 - reach, rows_), y1 = index_of(box.y1 + reach, rows_);
        for (std::size_t y = y0; y <= y1; ++y) {
            for (std::size_t x = x0; x <= x1; ++x) {
                Cell& cell = cells_[y * columns_ + x];
                for (const ResultId result : {edges[e].left, edges[e].right}) {
                    auto at =
                        std::find_if(cell.begin(), cell.end(), [&](const Candidate& c) { return c.result == result; });
                    if (at == cell.end()) at = cell.insert(at, {result, {}});
                    at->edges.push_back(e);
                }
            }
        }
    }
}

std::size_t Classifier::index_of(double v, std::size_t cells) const {
    return static_cast<std::size_t>(std::clamp(std::floor(v / side_), 0.0, static_cast<double>(cells - 1)));
}

bool Classifier::within_reach(const Candidate& candidate, TexturePoint p) const {
    return std::any_of(candidate.edges.begin(), candidate.edges.end(), [&](std::uint32_t e) {
        return box_of(truth_.edges()[e]).distance(truth_.to_width(p)) < reach_ &&
               truth_.nearest_on(e, p, reach_).edge != kNone;
    });
}

Classifier::Class Classifier::classify(TexturePoint p, ResultId expected, const Rgba& sampled) const {
    const Rgba truth = truth_.color(expected, p);
    double best = color_distance(sampled, truth);
    if (best == 0) return {expected, 0};
    ResultId result = expected;
    const WidthPoint w = truth_.to_width(p);
    for (const Candidate& candidate : cells_[index_of(w.y, rows_) * columns_ + index_of(w.x, columns_)]) {
        if (candidate.result == expected) continue;
        const Rgba color = truth_.color(candidate.result, p);
        const double distance = color_distance(sampled, color);
        if (!(distance < best - budget::kColorDistanceTie) || contrast(color, truth) < min_contrast_ ||
            !within_reach(candidate, p))
            continue;
        best = distance, result = candidate.result;
    }
    return {result, contrast(sampled, truth)};
}

} // namespace fetexc::measure
