// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/alternatives.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "compiler/diagnostics.h"
#include "compiler/measure/bilinear.h"
#include "compiler/measure/colors.h"
#include "compiler/measure/pictures.h"
#include "compiler/parallel.h"

namespace fetexc::measure {
namespace {

constexpr std::uint32_t kMostTexels = 16384; ///< a side

std::vector<ResultId> visible_results(const Truth& truth) {
    std::vector<ResultId> results;
    for (const VisibleEdge& e : truth.edges()) {
        results.push_back(e.left);
        results.push_back(e.right);
    }
    if (results.empty()) results.push_back(truth.result_at({0.5, 0.5}));
    std::sort(results.begin(), results.end());
    results.erase(std::unique(results.begin(), results.end()), results.end());
    return results;
}

/// The colour of more alpha is above, else the darker one: black on white, ink on nothing.
struct TwoColors {
    ResultId above_result = 0;
    Rgba below, above;
};

TwoColors two_colors(const Truth& truth) {
    const std::vector<ResultId> results = visible_results(truth);
    assert(results.size() == 2);
    const Rgba a = truth.color(results[0], {0.5, 0.5}), b = truth.color(results[1], {0.5, 0.5});
    const auto light = [](const Rgba& c) { return c.r + c.g + c.b; };
    const bool a_above = a.a != b.a ? a.a > b.a : light(a) < light(b);
    return a_above ? TwoColors{results[0], b, a} : TwoColors{results[1], a, b};
}

/// Share of `above` in a mix of both.
double coverage(const TwoColors& colors, const Rgba& mix) {
    const Rgba &p = colors.below, &q = colors.above;
    const double r = q.r - p.r, g = q.g - p.g, b = q.b - p.b, a = q.a - p.a;
    return ((mix.r - p.r) * r + (mix.g - p.g) * g + (mix.b - p.b) * b + (mix.a - p.a) * a) /
           (r * r + g * g + b * b + a * a);
}

Result<std::unique_ptr<Picture>> bitmap(const Truth& truth, GridSize size, unsigned threads) {
    const auto picture = truth.picture(size, threads);
    if (!picture) return picture.error();
    std::vector<std::uint8_t> rgba;
    rgba.reserve(picture.value().size() * 4);
    for (const Rgba& c : picture.value())
        for (const double channel : {c.r, c.g, c.b, c.a})
            rgba.push_back(to_byte(channel));
    return std::unique_ptr<Picture>(
        std::make_unique<BitmapPicture>(size, std::move(rgba), BitmapPicture::Filter::Bilinear));
}

Result<std::unique_ptr<Picture>> box_threshold(const Truth& truth, GridSize size, unsigned threads) {
    const auto picture = truth.picture(size, threads);
    if (!picture) return picture.error();
    const TwoColors colors = two_colors(truth);
    std::vector<std::uint8_t> values;
    values.reserve(picture.value().size());
    for (const Rgba& c : picture.value())
        values.push_back(to_byte(coverage(colors, c)));
    return std::unique_ptr<Picture>(
        std::make_unique<FieldPicture>(size, std::move(values), colors.below, colors.above, 0));
}

Result<std::unique_ptr<Picture>> distance_field(const Truth& truth, GridSize size, double range, unsigned threads) {
    const TwoColors colors = two_colors(truth);
    std::vector<std::uint8_t> values(std::size_t{size.width} * size.height);
    parallel_for(size.height, threads, [&](std::size_t row) {
        for (std::uint32_t column = 0; column < size.width; ++column) {
            const TexturePoint center{(column + 0.5) / size.width, (static_cast<double>(row) + 0.5) / size.height};
            const EdgePoint nearest = truth.nearest_edge(center, range / size.width);
            const double share = nearest.edge == kNone ? 1 : nearest.distance * size.width / range;
            const bool inside = truth.result_at(center) == colors.above_result;
            values[row * size.width + column] = to_byte(inside ? 0.5 + share : 0.5 - share);
        }
    });
    return std::unique_ptr<Picture>(
        std::make_unique<FieldPicture>(size, std::move(values), colors.below, colors.above, range));
}

} // namespace

const char* alternative_name(Alternative kind) {
    switch (kind) {
    case Alternative::Bitmap:
        return "bilinear RGBA8";
    case Alternative::BoxThreshold:
        return "box threshold R8";
    case Alternative::DistanceField:
        return "distance field R8";
    }
    return "";
}

unsigned bytes_per_texel(Alternative kind) { return kind == Alternative::Bitmap ? 4 : 1; }

std::string why_not(const Truth& truth, Alternative kind) {
    if (kind == Alternative::Bitmap) return {};
    const std::vector<ResultId> results = visible_results(truth);
    if (!std::all_of(results.begin(), results.end(), [&](ResultId r) { return truth.is_solid(r); }))
        return "not applicable: colours that vary";
    if (results.size() == 2) return {};
    return "not applicable: " + std::to_string(results.size()) + (results.size() == 1 ? " colour" : " colours");
}

GridSize grid_of_bytes(double aspect, std::uint64_t bytes, unsigned bytes_per_texel) {
    const auto height_of = [&](std::uint32_t width) {
        return static_cast<std::uint32_t>(std::clamp(std::round(width * aspect), 1.0, double{kMostTexels}));
    };
    const double texels = static_cast<double>(bytes) / bytes_per_texel;
    // Half a row more than the ideal one may still fit, by rounding its height down.
    const double widest = std::clamp(std::sqrt(texels / aspect) + 1 / aspect + 1, 1.0, double{kMostTexels});
    auto width = static_cast<std::uint32_t>(widest);
    while (width > 1 && (static_cast<double>(width) * height_of(width) > texels || width * aspect > kMostTexels))
        --width;
    return {width, height_of(width)};
}

FieldPicture::FieldPicture(GridSize size, std::vector<std::uint8_t> values, Rgba below, Rgba above, double range)
    : size_(size), values_(std::move(values)), below_(below), above_(above), range_(range) {
    assert(values_.size() == std::size_t{size.width} * size.height);
}

Rgba FieldPicture::at(TexturePoint p) const {
    const TexelWeights x(p.u, size_.width), y(p.v, size_.height);
    const auto along_row = [&](int j) {
        const auto texel = [&](int i) {
            return static_cast<double>(values_[std::size_t{y.index[j]} * size_.width + x.index[i]]);
        };
        return texel(0) + (texel(1) - texel(0)) * x.offset;
    };
    return along_row(0) + (along_row(1) - along_row(0)) * y.offset >= 127.5 ? above_ : below_;
}

Result<std::unique_ptr<Picture>> make_alternative(const Truth& truth, Alternative kind, GridSize size, unsigned threads,
                                                  double range) {
    if (std::string no = why_not(truth, kind); !no.empty())
        return Error{ErrorClass::Usage, diag::kBadUsage, std::move(no), {}};
    if (kind == Alternative::Bitmap) return bitmap(truth, size, threads);
    return kind == Alternative::BoxThreshold ? box_threshold(truth, size, threads)
                                             : distance_field(truth, size, range, threads);
}

} // namespace fetexc::measure
