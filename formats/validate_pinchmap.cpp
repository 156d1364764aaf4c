// SPDX-License-Identifier: Apache-2.0 OR MIT
#include <algorithm>
#include <cmath>
#include <span>

#include "formats/bitmap_samples.h"
#include "formats/fbt_mip.h"
#include "formats/validate.h"

namespace fetex {
namespace {

bool side(std::uint32_t v) { return v >= 1 && v <= kPinchmapMaxSide; }

/// What is wrong with the sizes; nullptr: nothing. Precondition: the formats are known.
const char* wrong_size(const PinchmapTexture& t) {
    if (t.scale > kPinchmapMaxScale || !side(t.width) || !side(t.height) ||
        (std::uint64_t{std::max(t.width, t.height)} << t.scale) > kPinchmapMaxSide)
        return "sides of the signal outside 1 … 16384";
    const std::uint64_t texels = std::uint64_t{pinchmap_columns(t)} * pinchmap_rows(t),
                        samples = std::uint64_t{pinchmap_signal_width(t)} * pinchmap_signal_height(t);
    if (t.map.size() != texels * pinchmap_words(t.map_format)) return "the map hasn't (width+1)·(height+1) texels";
    if (t.signal.size() != samples * fbt_sample_words(silmap_fbt_format(t.sample_format)))
        return "the signal hasn't as many samples as its sides say";
    if (!t.mips.empty() && t.mips.size() != fbt_mip_samples(pinchmap_signal_width(t), pinchmap_signal_height(t)))
        return "the mips are neither empty nor all levels";
    return nullptr;
}

/// Texels of the map one by one, then with their neighbours: SPEC 8.1.
class MapChecker {
  public:
    MapChecker(const PinchmapTexture& t, std::size_t limit) : t_(t), limit_(limit) {}

    std::vector<Finding> check() {
        for (std::uint32_t j = 0; j <= t_.height; ++j)
            for (std::uint32_t i = 0; i <= t_.width; ++i)
                check_values(i, j);
        if (!findings_.empty()) return std::move(findings_); // neighbours mean nothing yet
        signs_.resize(std::size_t{t_.width} * t_.height);
        for (std::uint32_t j = 0; j < t_.height; ++j)
            for (std::uint32_t i = 0; i < t_.width; ++i)
                check_cluster(i, j);
        if (!findings_.empty()) return std::move(findings_);
        for (std::uint32_t j = 0; j <= t_.height; ++j)
            for (std::uint32_t i = 0; i <= t_.width; ++i)
                check_active(i, j);
        return std::move(findings_);
    }

  private:
    void report(FindingCode code, std::uint32_t i, std::uint32_t j, const char* message) {
        if (findings_.size() >= limit_) return;
        const std::uint64_t texel = std::uint64_t{j} * pinchmap_columns(t_) + i;
        findings_.push_back({code, texel * 4 * pinchmap_words(t_.map_format),
                             "map: texel (" + std::to_string(i) + "," + std::to_string(j) + "): " + message});
    }

    [[nodiscard]] bool active(std::uint32_t i, std::uint32_t j) const { return pinchmap_texel(t_, i, j).k == 0; }

    /// Of a cluster; beyond the border of the nearest.
    [[nodiscard]] int sign(std::int64_t i, std::int64_t j) const {
        const auto column = std::clamp<std::int64_t>(i, 0, t_.width - 1),
                   row = std::clamp<std::int64_t>(j, 0, t_.height - 1);
        return signs_[static_cast<std::size_t>(row * t_.width + column)];
    }

    void check_values(std::uint32_t i, std::uint32_t j) {
        const PinchmapTexel texel = pinchmap_texel(t_, i, j);
        const double largest = std::max({std::abs(texel.du), std::abs(texel.dv), std::abs(texel.k)});
        if (largest > 1 || std::abs(texel.gamma) >= 1)
            return report(FindingCode::PinchmapValue, i, j, "a value beyond 1, or a gamma of 1");
        if (texel.k != 0 && std::abs(texel.k) != 1) report(FindingCode::PinchmapValue, i, j, "k is none of -1, 0, 1");
        if (texel.k != 0 && (texel.du != 0 || texel.dv != 0))
            report(FindingCode::PinchmapValue, i, j, "a direction where k isn't 0");
    }

    /// A cluster's texel that isn't active tells its side.
    void check_cluster(std::uint32_t i, std::uint32_t j) {
        int least = 1, most = -1;
        bool is_active[2][2];
        for (std::uint32_t below = 0; below < 2; ++below)
            for (std::uint32_t right = 0; right < 2; ++right) {
                const int k = static_cast<int>(pinchmap_texel(t_, i + right, j + below).k);
                is_active[below][right] = k == 0;
                if (k != 0) least = std::min(least, k), most = std::max(most, k);
            }
        const bool across = is_active[0][0] == is_active[1][1] && is_active[0][1] == is_active[1][0] &&
                            is_active[0][0] != is_active[0][1];
        if (least != most || across)
            return report(FindingCode::PinchmapCluster, i, j,
                          "the cluster below on the right has four active texels, two across, or both sides");
        signs_[std::size_t{j} * t_.width + i] = static_cast<signed char>(least);
    }

    void check_active(std::uint32_t i, std::uint32_t j) {
        if (!active(i, j)) return;
        const std::int64_t x = i, y = j;
        const int nw = sign(x - 1, y - 1), ne = sign(x, y - 1), sw = sign(x - 1, y), se = sign(x, y);
        const int to_x = ne + se - nw - sw, to_y = sw + se - nw - ne; // towards +1
        const PinchmapTexel texel = pinchmap_texel(t_, i, j);
        const bool wrong_way = texel.du * to_x < 0 || texel.dv * to_y < 0 || (to_x == 0 && texel.du != 0) ||
                               (to_y == 0 && texel.dv != 0) ||
                               (to_x != 0 && to_y != 0 && std::abs(texel.du) != std::abs(texel.dv));
        if (nw == ne && ne == sw && sw == se) {
            report(FindingCode::PinchmapDirection, i, j, "active between clusters of one side");
        } else if (wrong_way) {
            report(FindingCode::PinchmapDirection, i, j, "the direction isn't from the side -1 to the side +1");
        } else if ((i < t_.width && active(i + 1, j) && ne == se) || (j < t_.height && active(i, j + 1) && sw == se)) {
            report(FindingCode::PinchmapDirection, i, j, "active as its neighbour, and no line goes there");
        }
    }

    const PinchmapTexture& t_;
    std::size_t limit_;
    std::vector<signed char> signs_;
    std::vector<Finding> findings_;
};

FindingCode code_of(SampleFault fault) {
    return fault == SampleFault::NotPremultiplied ? FindingCode::PinchmapNotPremultiplied
                                                  : FindingCode::PinchmapSampleValue;
}

} // namespace

std::vector<Finding> validate_pinchmap(const PinchmapTexture& texture, std::size_t limit) {
    limit = std::max<std::size_t>(limit, 1);
    if (texture.map_format > PinchmapFormat::Bits16 || texture.sample_format > PinchmapSampleFormat::Rgb8)
        return {{FindingCode::PinchmapFormat, 0, "header: unknown map format or sample format"}};
    if (const char* wrong = wrong_size(texture))
        return {{FindingCode::PinchmapDimensions, 0, std::string("header: ") + wrong}};
    if (texture.line_width > kPinchmapLineUnit)
        return {{FindingCode::PinchmapFormat, 0, "header: a line wider than a texel"}};
    if (const SampleFault fault = bitmap_sample_fault(&texture.line_color, PinchmapSampleFormat::Rgba8);
        fault != SampleFault::None)
        return {{code_of(fault), 0, std::string("header: line") + sample_fault_text(fault)}};
    std::vector<Finding> findings = MapChecker(texture, limit).check();
    const auto check = [&](std::span<const std::uint32_t> words, PinchmapSampleFormat format, const std::string& part) {
        const std::size_t step = fbt_sample_words(silmap_fbt_format(format));
        for (std::size_t k = 0; k < words.size() && findings.size() < limit; k += step) {
            const SampleFault fault = bitmap_sample_fault(&words[k], format);
            if (fault == SampleFault::None) continue;
            const std::size_t bytes = format == PinchmapSampleFormat::Rgb8 ? 3 : 4;
            findings.push_back({code_of(fault), bytes * std::uint64_t{k}, part + sample_fault_text(fault)});
        }
    };
    check(texture.signal, texture.sample_format, "signal");
    check(texture.mips, PinchmapSampleFormat::Rgba8, "mips");
    return findings;
}

} // namespace fetex
