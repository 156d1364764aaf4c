// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/painted_rows.h"

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "compiler/bilevel/scan_lines.h"
#include "compiler/planar/visible_edges.h"
#include "compiler/scene/compositor.h"

namespace fetexc {
namespace {

/// Along a row the result changes where it crosses a visible edge, and only there.
class ScenePainter {
  public:
    ScenePainter(const Scene& scene, PointGrid grid) : scene_(scene), grid_(grid), compositor_(scene) {}

    Status prepare(unsigned threads) {
        ResultId somewhere = 0;
        auto found = visible_edges(scene_, compositor_, threads, &somewhere);
        if (!found) return found.error();
        edges_ = std::move(found).value();
        add_segments();
        rows_ = std::make_unique<ScanLines>(segments_, grid_.rows, 1, true);
        find_starts(somewhere);
        return {};
    }

    void operator()(std::uint32_t row, std::span<PaintedPoint> points) const {
        const std::span<const Crossing> crossings = rows_->crossings(row);
        ResultId now = starts_[row];
        std::size_t next = 0;
        const Paint* paint = &paint_of(now);
        for (std::uint32_t k = 0; k < points.size(); ++k) {
            const double x = k + 0.5;
            const ResultId before = now;
            for (; next < crossings.size() && crossings[next].at <= x; ++next)
                now = after(crossings[next]);
            if (now != before) paint = &paint_of(now);
            points[k] = {paint->solid ? paint->color : compositor_.color(now, canvas_point(x, row + 0.5)), true};
        }
    }

  private:
    struct Paint {
        bool solid = true;
        Rgba color;
    };

    [[nodiscard]] CanvasPoint canvas_point(double x, double y) const {
        return {x / grid_.columns * scene_.extent.width, y / grid_.rows * scene_.extent.height};
    }

    /// Chord by chord, with the edges that they are of.
    void add_segments() {
        Silhouette one;
        one.height = scene_.extent.height / scene_.extent.width, one.edges.resize(1);
        for (std::uint32_t k = 0; k < edges_.size(); ++k) {
            one.edges[0] = edges_[k];
            for (const OutlineSegment& s : outline_in_texels(one, grid_.columns, grid_.rows))
                segments_.push_back(s), edge_of_.push_back(k);
            for (const ResultId r : {edges_[k].left, edges_[k].right})
                see(r);
        }
    }
    void see(ResultId r) {
        const bool solid = compositor_.is_solid(r);
        paints_.try_emplace(r, Paint{solid, solid ? compositor_.color(r, {}) : Rgba{}});
    }
    [[nodiscard]] const Paint& paint_of(ResultId r) const { return paints_.at(r); }

    [[nodiscard]] ResultId after(const Crossing& c) const {
        const VisibleEdge& e = edges_[edge_of_[c.segment]];
        return c.enters ? e.left : e.right;
    }
    [[nodiscard]] ResultId before(const Crossing& c) const {
        const VisibleEdge& e = edges_[edge_of_[c.segment]];
        return c.enters ? e.right : e.left;
    }

    /// A row that crosses nothing has one result: of any column that crosses something what it has there.
    void find_starts(ResultId somewhere) {
        see(somewhere);
        const ScanLines columns(segments_, grid_.columns, 1, false);
        std::uint32_t other = 0;
        while (other < columns.size() && columns.crossings(other).empty())
            ++other;
        for (std::uint32_t n = 0; n < grid_.rows; ++n) {
            const std::span<const Crossing> row = rows_->crossings(n);
            ResultId start = somewhere;
            if (!row.empty()) {
                start = before(row[0]);
            } else if (other < columns.size()) {
                const std::span<const Crossing> all = columns.crossings(other);
                start = before(all[0]);
                for (const Crossing& c : all) {
                    if (c.at <= n + 0.5) start = after(c);
                }
            }
            starts_.push_back(start);
        }
    }

    const Scene& scene_;
    PointGrid grid_;
    Compositor compositor_;
    std::vector<VisibleEdge> edges_;
    std::vector<OutlineSegment> segments_;
    std::vector<std::uint32_t> edge_of_; ///< of segments
    std::unique_ptr<ScanLines> rows_;
    std::vector<ResultId> starts_;
    std::map<ResultId, Paint> paints_;
};

class ImagePainter {
  public:
    ImagePainter(const RasterImage& image, const Silhouette& silhouette, PointGrid grid)
        : image_(image), grid_(grid), mixed_(std::size_t{image.width} * image.height) {
        const double to_pixels = image.width;
        for (const VisibleEdge& e : silhouette.edges) {
            const WidthPoint a = e.p[0], b = e.p[static_cast<std::size_t>(e.degree)];
            mark((a.x + b.x) / 2 * to_pixels, (a.y + b.y) / 2 * to_pixels);
        }
    }

    void operator()(std::uint32_t row, std::span<PaintedPoint> points) const {
        const std::uint32_t y = pixel(row, grid_.rows, image_.height);
        for (std::uint32_t k = 0; k < points.size(); ++k) {
            const std::uint32_t x = pixel(k, grid_.columns, image_.width);
            points[k] = {image_.at(x, y), mixed_[std::size_t{y} * image_.width + x] == 0};
        }
    }

  private:
    static std::uint32_t pixel(std::uint32_t n, std::uint32_t points, std::uint32_t pixels) {
        return static_cast<std::uint32_t>((2 * std::uint64_t{n} + 1) * pixels / (2 * std::uint64_t{points}));
    }

    /// A piece of the outline of an image is no longer than the way between two pixels' centres.
    void mark(double x, double y) {
        const auto i = static_cast<std::int64_t>(x), j = static_cast<std::int64_t>(y);
        for (std::int64_t b = std::max<std::int64_t>(j - 1, 0); b <= std::min<std::int64_t>(j + 1, image_.height - 1);
             ++b) {
            for (std::int64_t a = std::max<std::int64_t>(i - 1, 0);
                 a <= std::min<std::int64_t>(i + 1, image_.width - 1); ++a)
                mixed_[static_cast<std::size_t>(b) * image_.width + static_cast<std::size_t>(a)] = 1;
        }
    }

    const RasterImage& image_;
    PointGrid grid_;
    std::vector<std::uint8_t> mixed_;
};

} // namespace

Result<RowPainter> scene_painter(const Scene& scene, PointGrid grid, unsigned threads) {
    const auto painter = std::make_shared<ScenePainter>(scene, grid);
    if (const Status ready = painter->prepare(threads); !ready) return ready.error();
    return RowPainter([painter](std::uint32_t row, std::span<PaintedPoint> points) { (*painter)(row, points); });
}

RowPainter image_painter(const RasterImage& image, const Silhouette& silhouette, PointGrid grid) {
    const auto painter = std::make_shared<const ImagePainter>(image, silhouette, grid);
    return [painter](std::uint32_t row, std::span<PaintedPoint> points) { (*painter)(row, points); };
}

} // namespace fetexc
