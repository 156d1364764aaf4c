// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/raster/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>

#include <potracelib.h>

#include "compiler/diagnostics.h"
#include "compiler/raster/edge_channel.h"

namespace fetexc {
namespace {

constexpr double kSmooth = 0.7;          ///< pixels: sigma of the mean that is compared …
constexpr double kSigma = 2;             ///< pixels: … with the mean around it
constexpr std::uint32_t kFiner = 4;      ///< bits of the bitmap a pixel, for edges between pixels
constexpr std::uint32_t kMargin = 3;     ///< pixels around the image, so that edges run on across its border
constexpr double kFloor = 1.0 / 8;       ///< of the contrast: noise below makes no outlines
constexpr double kCurveTolerance = 0.15; ///< pixels: by which Potrace may join curves
constexpr double kReach = 1.5;           ///< pixels to both sides between which contrast is measured
constexpr double kPieceLength = 3;       ///< pixels: contrast is measured for pieces of about this length
constexpr double kShortestRun = 3;       ///< pixels

struct FreeState {
    void operator()(potrace_state_t* state) const { potrace_state_free(state); }
};
struct FreeParam {
    void operator()(potrace_param_t* param) const { potrace_param_free(param); }
};

/// Bit set: brighter than around it. Row 0 is the image's top: Potrace's y then grows down, as ours.
class Bitmap {
  public:
    Bitmap(const EdgeChannel& band_pass, double threshold)
        : width_(kFiner * (band_pass.width() + 2 * kMargin)), height_(kFiner * (band_pass.height() + 2 * kMargin)),
          words_((width_ + kBits - 1) / kBits), map_(std::size_t{words_} * height_, 0) {
        for (std::uint32_t y = 0; y < height_; ++y) {
            for (std::uint32_t x = 0; x < width_; ++x) {
                if (band_pass.at(to_pixels(x + 0.5), to_pixels(y + 0.5)) <= threshold) continue;
                map_[std::size_t{y} * words_ + x / kBits] |= potrace_word{1} << (kBits - 1 - x % kBits);
            }
        }
    }
    static double to_pixels(double v) { return v / kFiner - kMargin; }
    [[nodiscard]] potrace_bitmap_t view() {
        return {static_cast<int>(width_), static_cast<int>(height_), static_cast<int>(words_), map_.data()};
    }

  private:
    static constexpr std::uint32_t kBits = 8 * sizeof(potrace_word);
    std::uint32_t width_, height_, words_;
    std::vector<potrace_word> map_;
};

CanvasPoint to_point(const potrace_dpoint_t& p) { return {Bitmap::to_pixels(p.x), Bitmap::to_pixels(p.y)}; }

/// A closed outline's segments.
CanvasContour contour_of(const potrace_curve_t& curve) {
    CanvasContour out;
    if (curve.n < 1) return out;
    CanvasPoint pen = to_point(curve.c[curve.n - 1][2]);
    for (int k = 0; k < curve.n; ++k) {
        const CanvasPoint a = to_point(curve.c[k][0]), b = to_point(curve.c[k][1]), c = to_point(curve.c[k][2]);
        if (curve.tag[k] == POTRACE_CURVETO) {
            out.push_back({3, {pen, a, b, c}});
        } else {
            out.push_back({1, {pen, b}});
            out.push_back({1, {b, c}});
        }
        pen = c;
    }
    return out;
}

CanvasPoint between(CanvasPoint a, CanvasPoint b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

CanvasPoint point_at(const CanvasSegment& s, double t) {
    std::array<CanvasPoint, 4> p = s.p;
    for (int n = s.degree; n > 0; --n) {
        for (int k = 0; k < n; ++k)
            p[static_cast<std::size_t>(k)] =
                between(p[static_cast<std::size_t>(k)], p[static_cast<std::size_t>(k) + 1], t);
    }
    return p[0];
}

/// The part from t0 to t1, by its blossom.
CanvasSegment part_of(const CanvasSegment& s, double t0, double t1) {
    if (t0 <= 0 && t1 >= 1) return s;
    CanvasSegment out;
    out.degree = s.degree;
    for (int k = 0; k <= s.degree; ++k) {
        std::array<CanvasPoint, 4> p = s.p;
        for (int n = s.degree; n > 0; --n) {
            const double t = n > s.degree - k ? t1 : t0;
            for (int i = 0; i < n; ++i)
                p[static_cast<std::size_t>(i)] =
                    between(p[static_cast<std::size_t>(i)], p[static_cast<std::size_t>(i) + 1], t);
        }
        out.p[static_cast<std::size_t>(k)] = p[0];
    }
    return out;
}

double polygon_length(const CanvasSegment& s) {
    double length = 0;
    for (int k = 0; k < s.degree; ++k) {
        const CanvasPoint a = s.p[static_cast<std::size_t>(k)], b = s.p[static_cast<std::size_t>(k) + 1];
        length += std::hypot(b.x - a.x, b.y - a.y);
    }
    return length;
}

/// Part of an outline's segment.
struct Piece {
    std::size_t segment = 0;
    double t0 = 0, t1 = 1, length = 0, contrast = 0;
    bool kept = false;
};

/// Keeps the parts of an outline that follow an edge.
class EdgeFollower {
  public:
    EdgeFollower(const RasterImage& image, double contrast) : image_(image), contrast_(contrast) {}

    void follow(const CanvasContour& outline, std::vector<CanvasContour>& runs) {
        cut(outline);
        keep_strong_and_what_continues_them();
        write(outline, runs);
    }

  private:
    void cut(const CanvasContour& outline) {
        pieces_.clear();
        for (std::size_t k = 0; k < outline.size(); ++k) {
            const double length = polygon_length(outline[k]);
            const int n = std::max(1, static_cast<int>(std::lround(length / kPieceLength)));
            for (int i = 0; i < n; ++i) {
                Piece piece{k, static_cast<double>(i) / n, static_cast<double>(i + 1) / n, length / n, 0, false};
                piece.contrast = contrast_across(outline[k], piece);
                pieces_.push_back(piece);
            }
        }
    }

    [[nodiscard]] double contrast_across(const CanvasSegment& s, const Piece& piece) const {
        double sum = 0;
        for (const double u : {1.0 / 6, 0.5, 5.0 / 6}) {
            const double t = piece.t0 + u * (piece.t1 - piece.t0), h = (piece.t1 - piece.t0) / 6;
            const CanvasPoint p = point_at(s, t), a = point_at(s, t - h), b = point_at(s, t + h);
            const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
            if (length == 0) continue;
            const double nx = -dy / length * kReach, ny = dx / length * kReach;
            sum += difference({p.x + nx, p.y + ny}, {p.x - nx, p.y - ny});
        }
        return sum / 3;
    }

    /// The largest of a channel, between two points.
    [[nodiscard]] double difference(CanvasPoint p, CanvasPoint q) const {
        const Rgba a = bilinear(p), b = bilinear(q);
        return std::max({std::fabs(a.r - b.r), std::fabs(a.g - b.g), std::fabs(a.b - b.b), std::fabs(a.a - b.a)});
    }

    [[nodiscard]] Rgba bilinear(CanvasPoint p) const {
        const double u = std::clamp(p.x - 0.5, 0.0, image_.width - 1.0),
                     v = std::clamp(p.y - 0.5, 0.0, image_.height - 1.0);
        const auto i = static_cast<std::uint32_t>(u), j = static_cast<std::uint32_t>(v);
        Rgba sum;
        for (std::uint32_t k = 0; k < 4; ++k) {
            const double w = (k % 2 == 1 ? u - i : 1 - (u - i)) * (k / 2 == 1 ? v - j : 1 - (v - j));
            const Rgba c = image_.at(std::min(i + k % 2, image_.width - 1), std::min(j + k / 2, image_.height - 1));
            sum = {sum.r + w * c.r, sum.g + w * c.g, sum.b + w * c.b, sum.a + w * c.a};
        }
        return sum;
    }

    /// As Canny's hysteresis: once around in each direction, twice, as an outline has no beginning.
    void keep_strong_and_what_continues_them() {
        for (Piece& p : pieces_)
            p.kept = p.contrast >= contrast_;
        const auto spread = [&](auto first, auto last) {
            bool before = false;
            for (int round = 0; round < 2; ++round) {
                for (auto p = first; p != last; ++p)
                    before = p->kept = p->kept || (before && p->contrast >= 0.5 * contrast_);
            }
        };
        spread(pieces_.begin(), pieces_.end());
        spread(pieces_.rbegin(), pieces_.rend());
    }

    /// Runs of kept pieces; one that passes the outline's beginning is one run.
    void write(const CanvasContour& outline, std::vector<CanvasContour>& runs) {
        const auto gap = std::ranges::find(pieces_, false, &Piece::kept);
        std::rotate(pieces_.begin(), gap == pieces_.end() ? pieces_.begin() : gap, pieces_.end());
        for (std::size_t k = 0; k < pieces_.size();) {
            std::size_t end = k;
            double length = 0;
            while (end < pieces_.size() && pieces_[end].kept)
                length += pieces_[end++].length;
            if (length >= kShortestRun) runs.push_back(joined(outline, std::span(pieces_).subspan(k, end - k)));
            k = std::max(end, k + 1);
        }
    }

    static CanvasContour joined(const CanvasContour& outline, std::span<const Piece> pieces) {
        CanvasContour run;
        for (std::size_t k = 0; k < pieces.size();) {
            std::size_t last = k;
            while (last + 1 < pieces.size() && pieces[last + 1].segment == pieces[k].segment &&
                   pieces[last + 1].t0 == pieces[last].t1)
                ++last;
            CanvasSegment s = part_of(outline[pieces[k].segment], pieces[k].t0, pieces[last].t1);
            if (!run.empty()) s.p[0] = run.back().p[static_cast<std::size_t>(run.back().degree)];
            run.push_back(s);
            k = last + 1;
        }
        return run;
    }

    const RasterImage& image_;
    double contrast_;
    std::vector<Piece> pieces_;
};

} // namespace

Result<FeatureCurves> trace_features(const RasterImage& image, const TraceOptions& options) {
    Bitmap bitmap(EdgeChannel(image).band_pass(kSmooth, kSigma), kFloor * options.contrast);
    const std::unique_ptr<potrace_param_t, FreeParam> param(potrace_param_default());
    std::unique_ptr<potrace_state_t, FreeState> state;
    if (param != nullptr) {
        param->turdsize = static_cast<int>(options.speck * kFiner * kFiner);
        param->opttolerance = kCurveTolerance * kFiner;
        const potrace_bitmap_t view = bitmap.view();
        state.reset(potrace_trace(param.get(), &view));
    }
    if (state == nullptr || state->status != POTRACE_STATUS_OK)
        return Error{ErrorClass::Runtime, diag::kTraceFailed, "Potrace couldn't trace the image", "--trace"};
    FeatureCurves features{static_cast<double>(image.width), static_cast<double>(image.height), {}};
    EdgeFollower follower(image, options.contrast);
    for (const potrace_path_t* path = state->plist; path != nullptr; path = path->next)
        follower.follow(contour_of(path->curve), features.runs);
    return features;
}

} // namespace fetexc
