// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/image_samples.h"

#include <algorithm>
#include <array>

#include "formats/validate.h"

namespace fetexc {
namespace {

Channels channels_of(const Rgba& c) { return {c.r, c.g, c.b, c.a}; }

class RegionColorFinder {
  public:
    RegionColorFinder(const RasterImage& image, const ImageRegions& regions, std::vector<std::uint8_t>& valid,
                      const Grid& grid)
        : image_(image), regions_(regions), valid_(valid), grid_(grid), n_(regions.graph.vertices()) {}

    RegionColors find() {
        out_.color.assign(n_, Channels{});
        out_.origin.assign(n_, RegionColors::Origin::Copied);
        list_neighbours();
        take_prefiltered_where_nothing_else_is();
        merge_pixels();
        fill_holes();
        return std::move(out_);
    }

  private:
    void list_neighbours() {
        start_.assign(n_ + 1, 0);
        for (const ReachLink& l : regions_.graph.links())
            ++start_[l.a + 1], ++start_[l.b + 1];
        for (std::size_t k = 1; k < start_.size(); ++k)
            start_[k] += start_[k - 1];
        neighbours_.resize(start_.back());
        std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
        for (const ReachLink& l : regions_.graph.links())
            neighbours_[next[l.a]++] = l.b, neighbours_[next[l.b]++] = l.a;
    }

    /// Parts of the picture without a valid pixel: all their pixels count after all, or the one around a point.
    void take_prefiltered_where_nothing_else_is() {
        const std::vector<std::uint32_t>& part = regions_.graph.components();
        std::vector<bool> sampled(n_, false), has_pixel(n_, false);
        for (std::size_t k = 0; k < valid_.size(); ++k) {
            if (valid_[k] != 0) sampled[part[regions_.region_of_pixel[k]]] = true;
        }
        for (std::size_t k = 0; k < valid_.size(); ++k) {
            const std::uint32_t region = regions_.region_of_pixel[k];
            if (sampled[part[region]]) continue;
            valid_[k] = 1, has_pixel[part[region]] = true;
            out_.origin[region] = RegionColors::Origin::Prefiltered;
        }
        for (std::uint32_t v = 0; v < n_; ++v) {
            if (sampled[part[v]]) continue;
            if (part[v] == v && out_.parts_unsampled++ == 0) out_.first_unsampled = regions_.inside[v];
            if (has_pixel[part[v]]) continue;
            out_.origin[v] = RegionColors::Origin::Prefiltered;
            out_.color[v] = channels_of(pixel_around(regions_.inside[v]));
        }
    }

    [[nodiscard]] Rgba pixel_around(const TexelPoint& p) const {
        const auto pixel = [](double v, std::uint32_t texels, std::uint32_t pixels) {
            return static_cast<std::uint32_t>(std::clamp(v * pixels / texels, 0.0, pixels - 1.0));
        };
        return image_.at(pixel(p.x, grid_.width, image_.width), pixel(p.y, grid_.height, image_.height));
    }

    void merge_pixels() {
        std::vector<std::uint32_t> count(n_, 0);
        for (std::uint32_t y = 0; y < image_.height; ++y) {
            for (std::uint32_t x = 0; x < image_.width; ++x) {
                const std::size_t k = std::size_t{y} * image_.width + x;
                if (valid_[k] == 0) continue;
                const std::uint32_t region = regions_.region_of_pixel[k];
                const Channels c = channels_of(image_.at(x, y));
                for (std::size_t i = 0; i < 4; ++i)
                    out_.color[region][i] += c[i];
                ++count[region];
            }
        }
        for (std::uint32_t v = 0; v < n_; ++v) {
            if (count[v] == 0) continue;
            for (double& c : out_.color[v])
                c /= count[v];
            if (out_.origin[v] != RegionColors::Origin::Prefiltered) out_.origin[v] = RegionColors::Origin::Pixels;
        }
    }

    /// From the sampled regions outwards, a link at a time: each hole takes over the source of one of its neighbours
    /// that have one, the source nearest to it.
    void fill_holes() {
        source_.assign(n_, kNone);
        std::vector<std::uint32_t> front, next;
        for (std::uint32_t v = 0; v < n_; ++v) {
            if (out_.origin[v] == RegionColors::Origin::Copied) continue;
            source_[v] = v;
            front.push_back(v);
        }
        while (!front.empty()) {
            next.clear();
            for (const std::uint32_t v : front) {
                for (const std::uint32_t hole : neighbours_of(v)) {
                    if (source_[hole] == kNone) next.push_back(hole);
                }
            }
            std::ranges::sort(next);
            next.erase(std::unique(next.begin(), next.end()), next.end());
            std::vector<std::uint32_t> found;
            for (const std::uint32_t hole : next)
                found.push_back(nearest_source(hole));
            for (std::size_t k = 0; k < next.size(); ++k)
                source_[next[k]] = found[k];
            front.swap(next);
        }
        for (std::uint32_t v = 0; v < n_; ++v) {
            if (out_.origin[v] != RegionColors::Origin::Copied) continue;
            out_.color[v] = out_.color[source_[v]];
            ++out_.holes;
        }
    }

    [[nodiscard]] std::uint32_t nearest_source(std::uint32_t hole) const {
        std::uint32_t best = kNone;
        double least = 0;
        const TexelPoint p = regions_.inside[hole];
        for (const std::uint32_t v : neighbours_of(hole)) {
            const std::uint32_t source = source_[v];
            if (source == kNone) continue;
            const double dx = regions_.inside[source].x - p.x, dy = regions_.inside[source].y - p.y;
            const double distance = dx * dx + dy * dy;
            if (best != kNone && (distance > least || (distance == least && source >= best))) continue;
            best = source, least = distance;
        }
        return best;
    }

    [[nodiscard]] std::span<const std::uint32_t> neighbours_of(std::uint32_t v) const {
        return std::span(neighbours_).subspan(start_[v], start_[v + 1] - start_[v]);
    }

    const RasterImage& image_;
    const ImageRegions& regions_;
    std::vector<std::uint8_t>& valid_;
    const Grid& grid_;
    std::size_t n_;
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> neighbours_, source_;
    RegionColors out_;
};

} // namespace

RegionColors region_colors(const RasterImage& image, const ImageRegions& regions, std::vector<std::uint8_t>& valid,
                           const Grid& grid) {
    return RegionColorFinder(image, regions, valid, grid).find();
}

ImageSamples::ImageSamples(const ReachabilityGraph& graph, const CornerFit& fit, const std::vector<Channels>& values,
                           const Grid& grid, fetex::FbtSampleFormat format)
    : graph_(graph), fit_(fit), values_(values), width_(grid.width), height_(grid.height), format_(format) {
    if (std::max(width_, height_) + 1 <= fetex::kFbtMaxSide) choose_corners();
}

/// At each corner the unknown that most of the texels around it, of those with one region, have there; of equally many
/// the smallest.
void ImageSamples::choose_corners() {
    corners_.assign((std::size_t{width_} + 1) * (height_ + 1), kNone);
    const auto whole_region = [&](std::uint32_t i, std::uint32_t j) {
        const std::uint32_t first = graph_.first_vertex(i, j);
        const bool only = first + 1 == graph_.row_start(j + 1) || graph_.column(first + 1) != i;
        return only ? first : kNone;
    };
    std::vector<std::array<std::uint32_t, 4>> seen(corners_.size(), {kNone, kNone, kNone, kNone});
    for (std::uint32_t j = 0; j < height_; ++j) {
        for (std::uint32_t i = 0; i < width_; ++i) {
            const std::uint32_t region = whole_region(i, j);
            if (region == kNone) continue;
            for (std::uint32_t k = 0; k < 4; ++k)
                seen[(std::size_t{j} + k / 2) * (width_ + 1) + i + k % 2][3 - k] = fit_.unknown(region, k);
        }
    }
    for (std::size_t c = 0; c < corners_.size(); ++c) {
        std::ranges::sort(seen[c]); // kNone last
        std::ptrdiff_t most = 0;
        for (const std::uint32_t u : seen[c]) {
            const std::ptrdiff_t times = std::ranges::count(seen[c], u);
            if (u == kNone || times <= most) continue;
            corners_[c] = u, most = times;
        }
        if (corners_[c] == kNone) corners_[c] = any_unknown(c);
    }
}

/// Of a corner between texels with several regions: no texel asks for it, but it must be some colour.
std::uint32_t ImageSamples::any_unknown(std::size_t corner) const {
    const auto x = static_cast<std::uint32_t>(corner % (width_ + 1)),
               y = static_cast<std::uint32_t>(corner / (width_ + 1));
    const std::uint32_t i = std::min(x, width_ - 1), j = std::min(y, height_ - 1);
    return fit_.unknown(graph_.first_vertex(i, j), (x - i) + 2 * (y - j));
}

Rgba ImageSamples::color(std::uint32_t unknown) const {
    const Channels& v = values_[unknown];
    const double alpha = std::clamp(v[3], 0.0, 1.0);
    const double most = format_ == fetex::FbtSampleFormat::Rgba16F ? fetex::kFbtMaxHalf : alpha;
    return {std::clamp(v[0], 0.0, most), std::clamp(v[1], 0.0, most), std::clamp(v[2], 0.0, most), alpha};
}

Rgba ImageSamples::corner(std::uint32_t i, std::uint32_t j) const {
    return color(corners_[std::size_t{j} * (width_ + 1) + i]);
}

RegionSample ImageSamples::sample_of(std::uint32_t region, std::uint32_t i, std::uint32_t j) const {
    std::array<Rgba, 4> colors;
    bool common = !corners_.empty();
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t unknown = fit_.unknown(region, k);
        colors[k] = color(unknown);
        common = common && corners_[(std::size_t{j} + k / 2) * (width_ + 1) + i + k % 2] == unknown;
    }
    const RegionSample sample = patch_sample(colors, format_);
    if (sample.model == fetex::kFbtModelPatch && common) return {fetex::kFbtModelCorners, 0, {}};
    return sample;
}

RegionSample ImageSamples::whole(std::uint32_t i, std::uint32_t j) const {
    return sample_of(graph_.first_vertex(i, j), i, j);
}

RegionSample ImageSamples::region(const TexelMap& texel, const TexelFeatures&, std::uint32_t r) const {
    return sample_of(graph_.first_vertex(texel.i, texel.j) + r, texel.i, texel.j);
}

} // namespace fetexc
